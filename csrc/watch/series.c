/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Starts, finds and reads the series of wires, forces and ties. */
#include "watch/series.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "body/hold.h"
#include "body/obstacle_log.h"
#include "grip/tool.h"
#include "link/hold.h"
#include "link/joint.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/lists.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/scene.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/observe.h"

enum { OF_WIRE, OF_FORCE, OF_TIE };

struct sw_watch {
  int kind;
  sw_handle of;
  sw_log log;
};

static size_t width_of(int kind) { return kind == OF_WIRE ? SW_LOG_WIRE_SIZE : SW_LOG_FORCE_SIZE; }

static sw_watch *find(sw_watches *w, int kind, sw_handle of) {
  for (size_t tried = 0; tried < w->count; tried++, w->next++) {
    if (w->next >= w->count) w->next = 0;
    sw_watch *one = &w->list[w->next];
    if (one->kind != kind || one->of.generation != of.generation) continue;
    w->next++;
    return one;
  }
  return NULL;
}

static sw_status add(sw_scene *s, int kind, sw_handle of, const double *row, const char *name,
                     sw_error *err) {
  sw_watches *w = sw_scene_watches_of(s);
  sw_watch *one = find(w, kind, of);
  sw_status status = SW_OK;
  if (!one) {
    status = SW_GROW(w->list, w->capacity, w->count + 1);
    if (status == SW_OK) {
      one = &w->list[w->count++];
      *one = (sw_watch){.kind = kind, .of = of};
    }
  }
  if (status == SW_OK) status = sw_log_add(&one->log, row, width_of(kind));
  if (status == SW_OK) return SW_OK;
  return sw_fail(err, SW_ENOMEM, "out of memory for the series of '%s'", name);
}

sw_status sw_watch_wire(sw_scene *s, size_t slot, const sw_wire_extremes *now, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, slot);
  const double row[SW_LOG_WIRE_SIZE] = {sw_scene_time(s), now->tension.value, now->curvature.value};
  if (sw_scene_is_loose(w)) return SW_OK; /* an object of particles */
  return add(s, OF_WIRE, (sw_handle){(uint32_t)slot, w->generation}, row, w->name, err);
}

/* Returns the index of force_x among the force's read-outs; -1: it has none. */
static int place_of_force(const sw_force_class *cls) {
  for (int k = 0; cls->read && cls->outputs[k]; k++)
    if (strcmp(cls->outputs[k], "force_x") == 0) return k;
  return -1;
}

static sw_vec force_of(const sw_scene *s, size_t slot, int place) {
  sw_system *system = sw_scene_system(s);
  double values[SW_FORCE_OUTPUTS_MAX];
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t b = 0; b < system->body_count; b++)
    SW_ITEMS(const sw_term, term, system->bodies[b].terms, system->bodies[b].term_count) {
      if (term->id != (long)slot) continue;
      term->cls->read(term->args, &system->bodies[b].field, term->history, values);
      sum = sw_add(sum, sw_load(values + place));
    }
  return sum;
}

sw_status sw_watch_forces(sw_scene *s, sw_error *err) {
  for (size_t k = 0; k < sw_scene_force_slots(s); k++) {
    const sw_scene_force *f = sw_scene_force_in(s, k);
    const int place = f->alive ? place_of_force(f->cls) : -1;
    double row[SW_LOG_FORCE_SIZE] = {sw_scene_time(s)};
    if (place < 0) continue;
    sw_store(row + 1, force_of(s, k, place));
    SW_TRY(add(s, OF_FORCE, (sw_handle){(uint32_t)k, f->generation}, row, f->cls->name, err));
  }
  return SW_OK;
}

sw_status sw_watch_ties(sw_scene *s, sw_error *err) {
  for (size_t k = 0; k < sw_scene_join_slots(s); k++) {
    const sw_joint *j = sw_scene_join_in(s, k);
    double row[SW_LOG_FORCE_SIZE] = {sw_scene_time(s)};
    if (!j->alive || !j->cls->joint->pull || !sw_scene_system(s)->joins) continue;
    sw_vec force, moment;
    const sw_link_wire w = sw_scene_link_wire(s, j->ends[0].wire);
    j->cls->joint->force(j, &w, sw_scene_system(s)->x, 0, &force, &moment);
    if (j->evened) force = j->bears[0];
    sw_store(row + 1, j->fate[SW_TIE_BROKEN] > 0 ? sw_v(0, 0, 0) : force);
    SW_TRY(add(s, OF_TIE, (sw_handle){(uint32_t)k, j->generation}, row, j->name, err));
  }
  return SW_OK;
}

void sw_watches_clear(sw_watches *w) {
  for (size_t k = 0; k < w->count; k++) sw_log_free(&w->list[k].log);
  sw_free(w->list);
  *w = (sw_watches){0};
}

/* Returns the log of a wire, also of one that was removed, a force or a tie. NULL with err when
 * there is no such object. */
static const sw_log *watched(sw_scene *s, sw_kind kind, sw_handle of, sw_error *err) {
  static const sw_log empty;
  double gone;
  const int what = kind == SW_OF_BODY ? OF_WIRE : kind == SW_OF_FORCE ? OF_FORCE : OF_TIE;
  const int known = what == OF_FORCE ? sw_scene_find_force(s, of, err) != NULL
                    : what == OF_TIE ? sw_scene_find_join(s, of, err) != NULL
                                     : sw_scene_gone_name(s, of, &gone) != NULL ||
                                           sw_scene_find_body(s, of, err) != NULL;
  const sw_watch *one = find(sw_scene_watches_of(s), what, of);
  return !known ? NULL : one ? &one->log : &empty;
}

static const sw_log *log_of(sw_scene *s, sw_kind kind, sw_handle of, sw_error *err) {
  if (kind == SW_OF_HOLD) {
    const sw_hold *h = sw_scene_find_hold(s, of, err);
    return h ? &h->log : NULL;
  }
  if (kind == SW_OF_TOOL) {
    const sw_tool *t = sw_scene_any_tool(s, of, err);
    return t ? &t->log : NULL;
  }
  if (kind != SW_OF_OBSTACLE) return watched(s, kind, of, err);
  sw_scene_obstacle *o = sw_scene_any_obstacle(s, of, err);
  if (!o || sw_obstacle_log_fill(s, o) == SW_OK) return o ? &o->log : NULL;
  sw_fail(err, SW_ENOMEM, "out of memory for the series of '%s'", o->name);
  return NULL;
}

sw_status sw_scene_log(sw_scene *s, sw_kind kind, sw_handle of, const double **rows, size_t *count,
                       sw_error *err) {
  static const size_t width[] = {
      [SW_OF_BODY] = SW_LOG_WIRE_SIZE,         [SW_OF_HOLD] = SW_LOG_SIZE,
      [SW_OF_OBSTACLE] = SW_LOG_OBSTACLE_SIZE, [SW_OF_TOOL] = SW_LOG_TOOL_SIZE,
      [SW_OF_FORCE] = SW_LOG_FORCE_SIZE,       [SW_OF_JOIN] = SW_LOG_FORCE_SIZE};
  SW_TRY(sw_scene_readable(s, err));
  SW_FIND(const sw_log, log, log_of(s, kind, of, err));
  *rows = log->rows;
  *count = log->count / width[kind];
  return SW_OK;
}

void sw_tape_watches(sw_tape *t, sw_watches *w) {
  size_t n = w->count;
  SW_TAPE_STRUCT(t, sw_watch, 40);
  sw_tape_count(t, &n, 16);
  if (sw_tape_reads(t) && sw_tape_good(t) && SW_GROW(w->list, w->capacity, n) != SW_OK)
    sw_tape_fail(t, SW_ENOMEM);
  if (sw_tape_reads(t) && sw_tape_good(t))
    while (w->count > n) sw_log_free(&w->list[--w->count].log);
  for (size_t k = 0; k < n && sw_tape_good(t); k++) {
    if (k == w->count) w->list[w->count++] = (sw_watch){0};
    sw_watch *x = &w->list[k];
    sw_tape_int(t, &x->kind), sw_tape_uint32(t, &x->of.slot), sw_tape_uint32(t, &x->of.generation);
    sw_tape_log(t, &x->log);
    sw_tape_expect(t, x->kind >= OF_WIRE && x->kind <= OF_TIE, "a record");
    sw_tape_expect(t, x->log.count % width_of(x->kind) == 0, "a record");
  }
}
