/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes as bytes that outlive the process. A file is a head, a note of the caller's, the objects,
 * and the state of the built scene or the memory of an edited one. A scene that is not built is
 * saved as it is, because building it between two edits would give other bits. */
#include "save/file.h"

#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "body/build.h"
#include "body/hold.h"
#include "body/touching.h"
#include "link/joint.h"
#include "save/life.h"
#include "save/save.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/wire.h"
#include "scene/world.h"

typedef struct head {
  char magic[16];
  uint32_t version, order; /* order: this machine's byte order */
  uint64_t size, sum;      /* of all bytes [B]; checksum of all that follows the head */
} head;

static const char MAGIC[16] = "SoftWorld scene";
enum { VERSION = 33, ORDER = 0x01020304 };

/* --- writing --------------------------------------------------------------------------- */

static sw_status check_drive(const sw_scene *s, const sw_drive *d, const char *name,
                             sw_error *err) {
  if (!d->motion || !sw_motion_is_function(d->motion)) return SW_OK;
  const double end = d->start + sw_motion_end(d->motion);
  if (s->time >= end) return SW_OK;
  if (isfinite(end))
    return sw_fail(
        err, SW_EINVAL,
        "scene '%s' cannot be saved at t = %.6g s: '%s' follows a Lua function until t = "
        "%.6g s; save it after that, or give the trajectory as points",
        s->name, s->time, name, end);
  return sw_fail(err, SW_EINVAL,
                 "scene '%s' cannot be saved: '%s' follows a Lua function without an end; give the "
                 "function a duration and save after that time, or give the trajectory as points",
                 s->name, name);
}

/* Refuses forces and motions that are functions: they cannot leave the process. */
static sw_status check_functions(const sw_scene *s, sw_error *err) {
  for (size_t k = 0; k < s->force_count; k++) {
    const sw_scene_force *f = &s->forces[k];
    if (!f->alive || f->cls != sw_force_find("callback")) continue;
    return sw_fail(err, SW_EINVAL,
                   "scene '%s' cannot be saved: force %zu, on %s%s, is a Lua function; remove it "
                   "before saving, or use one of the kinds of scene:force",
                   s->name, k + 1, f->wire < 0 ? "all wires" : "wire ",
                   f->wire < 0 ? "" : s->wires[f->wire].name);
  }
  SW_EACH(hold, h, s) SW_TRY(check_drive(s, &h->drive, h->name, err));
  SW_EACH(obstacle, o, s)
    if (o->alive) SW_TRY(check_drive(s, &o->drive, o->name, err));
  SW_EACH(tool, t, s)
    if (t->alive) SW_TRY(check_drive(s, &t->drive, t->name, err));
  return SW_OK;
}

static void write_all(sw_tape *t, sw_scene *s, const void *note, size_t note_size) {
  head h = {.version = VERSION, .order = ORDER};
  sw_live live;
  int built;
  memcpy(h.magic, MAGIC, sizeof h.magic);
  sw_tape_raw(t, &h, sizeof h);
  sw_tape_size(t, &note_size);
  sw_tape_raw(t, (void *)(uintptr_t)note, note_size);
  sw_tape_scene(t, s, &built, &live);
  if (!sw_tape_good(t)) return;
  h.size = t->size;
  h.sum = sw_sum(SW_SUM_START, t->bytes + sizeof h, t->size - sizeof h);
  memcpy(t->bytes, &h, sizeof h);
}

/* --- reading --------------------------------------------------------------------------- */

static sw_status check_head(const void *bytes, size_t size, sw_error *err) {
  head h;
  if (size < sizeof MAGIC || memcmp(bytes, MAGIC, sizeof MAGIC) != 0)
    return sw_fail(err, SW_EFORMAT, "it is not a scene saved by SoftWorld");
  if (size < sizeof h) return sw_fail(err, SW_EFORMAT, "it is cut off after %zu bytes", size);
  memcpy(&h, bytes, sizeof h);
  if (h.order != ORDER)
    return sw_fail(err, SW_EFORMAT, "it was written on a machine with another byte order");
  if (h.version != VERSION)
    return sw_fail(
        err, SW_EFORMAT,
        "it has version %lu of the file format, and this SoftWorld reads version %d; write it "
        "again with the scene's script, or read it with the SoftWorld that wrote it",
        (unsigned long)h.version, VERSION);
  if (h.size > size)
    return sw_fail(err, SW_EFORMAT, "it is cut off: %zu of its %llu bytes are there", size,
                   (unsigned long long)h.size);
  if (h.size < size ||
      h.sum != sw_sum(SW_SUM_START, (const char *)bytes + sizeof h, size - sizeof h))
    return sw_fail(err, SW_EFORMAT, "it is damaged: its checksum does not match its content");
  return SW_OK;
}

/* Checks the head; returns the note, and the tape at the start of the scene. */
static sw_status open_tape(const void *bytes, size_t size, const void **note, size_t *note_size,
                           sw_tape *t, sw_error *err) {
  SW_TRY(check_head(bytes, size, err));
  *t = sw_tape_reader(bytes, size, err);
  t->at = sizeof(head);
  sw_tape_count(t, note_size, 1);
  if (!sw_tape_good(t)) return t->status;
  *note = (const char *)bytes + t->at;
  t->at += *note_size;
  return SW_OK;
}

sw_status sw_saved_note(const void *bytes, size_t size, const void **note, size_t *note_size,
                        sw_error *err) {
  sw_tape t;
  return open_tape(bytes, size, note, note_size, &t, err);
}

static sw_status read_scene(const void *bytes, size_t size, sw_scene *s, sw_live *live, int *built,
                            sw_error *err) {
  const void *note;
  size_t note_size;
  sw_tape t;
  SW_TRY(open_tape(bytes, size, &note, &note_size, &t, err));
  sw_tape_scene(&t, s, built, live);
  sw_tape_expect(&t, t.at == t.size, "more than a scene");
  if (sw_tape_good(&t)) sw_tape_check_scene(&t, s);
  return t.status;
}

/* Reads the written bytes back, so that an unreadable file is found at once and not when it is
 * needed. */
static sw_status read_back(const sw_tape *t, sw_error *err) {
  sw_live live = {0};
  int built = 0;
  sw_scene *copy = sw_alloc(1, sizeof *copy);
  if (!copy) return sw_fail(err, SW_ENOMEM, "out of memory");
  const sw_status status = read_scene(t->bytes, t->size, copy, &live, &built, err);
  sw_scene_free(copy);
  return status;
}

sw_status sw_scene_save(sw_scene *s, const void *note, size_t note_size, unsigned char **out,
                        size_t *size, sw_error *err) {
  sw_error why = {""};
  SW_TRY(sw_scene_measurable(s, err));
  SW_TRY(check_functions(s, err));
  if (s->waiting) SW_TRY(sw_scene_unbuild(s));
  if (s->built) sw_scene_undo_holds(s);
  sw_tape t = sw_tape_writer(&why);
  write_all(&t, s, note, note_size);
  if (!sw_tape_good(&t)) {
    sw_tape_free(&t);
    if (t.status == SW_ECALLBACK) return sw_fail(err, t.status, "%s", why.text);
    return sw_fail(err, t.status, "scene '%s' cannot be saved: %.400s", s->name, why.text);
  }
  const sw_status status = read_back(&t, &why);
  if (status != SW_OK) {
    sw_tape_free(&t);
    return sw_fail(err, status, "scene '%s' cannot be saved: read again, %.400s", s->name,
                   why.text);
  }
  *out = t.bytes;
  *size = t.size;
  return SW_OK;
}

sw_status sw_scene_load(const void *bytes, size_t size, sw_scene **out, sw_error *err) {
  sw_scene *s = sw_alloc(1, sizeof *s);
  if (!s) return sw_fail(err, SW_ENOMEM, "out of memory");
  const sw_status status = sw_scene_resume(s, bytes, size, err);
  if (status == SW_OK)
    *out = s;
  else
    sw_scene_free(s);
  return status;
}

sw_status sw_scene_resume(sw_scene *s, const void *bytes, size_t size, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_live live = {0};
  int built = 0;
  sw_scene *other = sw_alloc(1, sizeof *other);
  if (!other) return sw_fail(err, SW_ENOMEM, "out of memory");
  sw_status status = read_scene(bytes, size, other, &live, &built, err);
  if (status == SW_OK) status = sw_scene_take_place(s, other, &live, built, NULL, err);
  sw_scene_free(other);
  return status;
}

/* --- fingerprints of objects ------------------------------------------------------------- */

static void sum_name(sw_tape *t, const char *name) {
  char word[SW_NAME_SIZE];
  sw_tape_word(t, name, word);
}

/* Adds springs and masses of an object that was put together by hand. */
static void sum_web(sw_tape *t, const sw_scene_wire *w) {
  if (!sw_scene_is_loose(w)) return;
  sw_web *web = w->strand.web;
  sw_tape_raw(t, web->link, web->links * sizeof *web->link);
  sw_tape_raw(t, web->mass, web->particles * sizeof *web->mass);
}

static void item(sw_scene_item *out, const char *kind, const char *name) {
  snprintf(out->kind, sizeof out->kind, "%s", kind);
  snprintf(out->name, sizeof out->name, "%s", name);
}

static void sum_object(sw_tape *t, sw_scene *s, size_t k, sw_scene_item *out) {
  char name[SW_NAME_SIZE];
  if (k < s->wire_count) {
    sw_scene_wire *w = &s->wires[k];
    item(out, sw_scene_is_loose(w) ? "particles" : "wire", w->name);
    sw_tape_uint32(t, &w->generation), sw_tape_beam_of(t, w), sum_web(t, w);
    sum_name(t, w->cls->name);
    sw_tape_size(t, &w->mesh.n);
  } else if ((k -= s->wire_count) < s->obstacle_count) {
    sw_scene_obstacle *o = &s->obstacles[k];
    item(out, "obstacle", o->name);
    sw_tape_uint32(t, &o->generation), sw_tape_shape(t, &o->shape);
    sw_tape_double(t, &o->friction), sw_tape_double(t, &o->restitution);
  } else if ((k -= s->obstacle_count) < s->hold_count) {
    sw_hold *h = &s->holds[k];
    item(out, h->cls->name, h->name);
    sw_tape_uint32(t, &h->generation), sw_tape_size(t, &h->wire), sw_tape_hold_args(t, &h->args);
  } else if ((k -= s->hold_count) < s->force_count) {
    snprintf(name, sizeof name, "%zu (%s)", k + 1, s->forces[k].cls->name);
    item(out, "force", name);
    sw_tape_force(t, &s->forces[k]);
  } else if ((k -= s->force_count) < s->tool_count) {
    sw_tool *tool = &s->tools[k];
    item(out, "tool", tool->name);
    sw_tape_uint32(t, &tool->generation);
    for (size_t i = 0; i < tool->pads; i++) sw_tape_size(t, &tool->pad[i].obstacle);
  } else if ((k -= s->tool_count) < s->join_count) {
    item(out, "join", s->joins[k].name);
    sw_tape_join(t, &s->joins[k]);
  } else {
    k -= s->join_count;
    snprintf(name, sizeof name, "%zu", k + 1);
    item(out, "wire_contact", name);
    sw_tape_rule(t, &s->rules.list[k]);
  }
}

size_t sw_scene_items(const sw_scene *s) {
  return s->wire_count + s->obstacle_count + s->hold_count + s->force_count + s->tool_count +
         s->join_count + s->rules.count;
}

sw_scene_item sw_scene_item_at(sw_scene *s, size_t k) {
  sw_scene_item out = {"", "", 0};
  sw_tape t = sw_tape_summer();
  sum_object(&t, s, k, &out);
  sum_name(&t, out.name);
  out.sum = t.sum;
  return out;
}
