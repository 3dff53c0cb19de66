/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Removes wires, objects of particles and tools from a scene. With a body go its links: clamps and
 * grips release it, its joins and forces end, rules of contact forget it. The slots of bodies close
 * up, because they number the system's bodies. Frames number bodies in the order in which they were
 * made, so that earlier frames stay valid. The energy that leaves counts in the ledger as a change
 * of the scene. */
#include "edit/leave.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "body/build.h"
#include "body/history.h"
#include "body/obstacle_log.h"
#include "body/touching.h"
#include "edit/edit.h"
#include "grip/frozen.h"
#include "link/joint.h"
#include "scene/drive.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/lookup.h"
#include "scene/wire.h"
#include "scene/world.h"

/* --- links of a body -------------------------------------------------------------------------- */

static size_t less(size_t slot, size_t gone) {
  return slot == gone ? SIZE_MAX : slot - (slot > gone && slot != SIZE_MAX);
}

static void release_hold(sw_hold *h) {
  h->alive = 0;
  sw_drive_free(&h->drive);
}

/* Notes the poses of holds at their release. Only this may fail, because it may call a user's
 * function. */
static sw_status note_poses(sw_scene *s, size_t wire, size_t tool, sw_error *err) {
  SW_EACH(hold, h, s) {
    sw_motion_state now;
    if (!h->alive || (h->wire != wire && h->drive.tool != tool)) continue;
    SW_TRY(sw_drive_eval(s, &h->drive, s->time, &now, err));
    h->last_pose = now.pose;
  }
  return SW_OK;
}

static void leave_holds(sw_scene *s, size_t wire) {
  SW_EACH(hold, h, s) {
    if (h->alive && h->wire == wire) release_hold(h);
    h->wire = less(h->wire, wire);
  }
}

static void leave_joins(sw_scene *s, size_t wire) {
  SW_EACH(join, j, s)
    SW_ITEMS(sw_joint_end, e, j->ends, j->count) {
      if (e->wire == wire) j->alive = 0;
      e->wire = less(e->wire, wire);
    }
}

static void leave_forces(sw_scene *s, size_t wire) {
  SW_EACH(force, f, s) {
    if (f->wire == (long)wire) f->alive = 0, f->wire = -1;
    f->wire -= f->wire > (long)wire;
  }
}

/* Removes the wire from rules. A rule of this wire alone goes, because a rule without wires means
 * all wires. */
static void leave_rules(sw_scene *s, size_t wire) {
  size_t kept = 0;
  SW_ITEMS(sw_scene_rule, r, s->rules.list, s->rules.count) {
    const int of_all = r->count == 0;
    size_t n = 0;
    for (size_t i = 0; i < r->count; i++)
      if (r->wires[i] != wire) r->wires[n++] = (uint32_t)less(r->wires[i], wire);
    r->count = n;
    if (n || of_all)
      s->rules.list[kept++] = *r;
    else
      sw_free(r->wires);
  }
  s->rules.count = kept;
}

static void leave_memory(sw_scene *s, size_t wire) {
  size_t kept = 0;
  for (size_t w = 0; s->kept.memory && w < s->kept.wires; w++)
    s->kept.now[w] = less(s->kept.now[w], wire);
  SW_ITEMS(sw_kept_history, h, s->histories.list, s->histories.count) {
    if (h->wire == wire) {
      sw_plan_release(h->plan);
      sw_free(h->data);
      continue;
    }
    h->wire = less(h->wire, wire);
    s->histories.list[kept++] = *h;
  }
  s->histories.count = kept;
}

static void pads_on(sw_scene *s, const sw_tool *t) {
  for (size_t k = 0; k < t->pads; k++) s->obstacles[t->pad[k].obstacle].off = 0;
}

/* Gives tools that hold the wire rigidly their pads back. */
static void leave_tools(sw_scene *s, uint32_t generation) {
  SW_EACH(tool, t, s) {
    if (!t->frozen || t->frozen->wire.generation != generation) continue;
    if (t->alive) pads_on(s, t);
    sw_frozen_release(t->frozen);
    t->frozen = NULL;
  }
}

static void leave_list(sw_scene *s, size_t wire) {
  sw_scene_wire *w = &s->wires[wire];
  sw_gone *g = &s->gone[s->gone_count++];
  *g = (sw_gone){.generation = w->generation,
                 .loose = sw_scene_is_loose(w),
                 .number = w->number,
                 .radius = w->beam.radius,
                 .time = s->time};
  memcpy(g->name, w->name, sizeof g->name);
  sw_scene_clear_body(w);
  memmove(w, w + 1, (--s->wire_count - wire) * sizeof *w);
}

sw_status sw_scene_remove_body(sw_scene *s, sw_handle body, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  if (!sw_scene_find_body(s, body, err)) return SW_EDEAD;
  const size_t wire = body.slot;
  SW_TRY(note_poses(s, wire, SIZE_MAX, err));
  sw_status status = SW_GROW(s->gone, s->gone_capacity, s->gone_count + 1);
  if (status == SW_OK) status = sw_scene_unbuild(s);
  if (status != SW_OK) return sw_fail(err, status, "scene:remove: %s", sw_status_text(status));
  leave_holds(s, wire);
  leave_joins(s, wire);
  leave_forces(s, wire);
  leave_rules(s, wire);
  leave_memory(s, wire);
  leave_tools(s, body.generation);
  leave_list(s, wire);
  sw_course_jump(&s->course);
  return SW_OK;
}

/* --- tools ---------------------------------------------------------------------------------- */

sw_status sw_scene_remove_tool(sw_scene *s, sw_handle tool, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_tool *t = sw_scene_find_tool(s, tool, err);
  sw_motion_state now;
  if (!t) return SW_EDEAD;
  SW_TRY(sw_drive_eval(s, &t->drive, s->time, &now, err));
  SW_TRY(note_poses(s, SIZE_MAX, 1 + tool.slot, err));
  sw_status status = sw_scene_unbuild(s);
  for (size_t k = 0; k < t->pads && status == SW_OK; k++)
    status = sw_obstacle_log_fill(s, &s->obstacles[t->pad[k].obstacle]);
  if (status != SW_OK) return sw_fail(err, status, "scene:remove: %s", sw_status_text(status));
  SW_EACH(hold, h, s)
    if (h->alive && h->drive.tool == 1 + tool.slot) release_hold(h);
  for (size_t k = 0; k < t->pads; k++) s->obstacles[t->pad[k].obstacle].alive = 0;
  sw_drive_free(&t->drive); /* it stays in place, because its pads refer to it in frames */
  t->drive = (sw_drive){.pose = now.pose};
  t->jaw.opening = sw_jaw_at(&t->jaw, s->time);
  t->jaw.since = s->time, t->jaw.speed = 0, t->jaw.mode = SW_JAW_STILL;
  sw_frozen_release(t->frozen);
  t->frozen = NULL;
  t->alive = 0;
  sw_course_jump(&s->course);
  return SW_OK;
}

/* --- on a tape ------------------------------------------------------------------------------ */

void sw_tape_gone(sw_tape *t, sw_gone *x) {
  SW_TAPE_STRUCT(t, sw_gone, 96);
  sw_tape_uint32(t, &x->generation), sw_tape_int(t, &x->loose), sw_tape_size(t, &x->number);
  sw_tape_double(t, &x->radius), sw_tape_double(t, &x->time), sw_tape_name(t, x->name);
  sw_tape_expect(t, isfinite(x->radius) && isfinite(x->time), "a wire that was taken away");
}

/* Checks that the numbers of all bodies ever made are unique and in order. */
void sw_tape_check_numbers(sw_tape *t, const sw_scene *s) {
  const size_t made = sw_scene_bodies_made(s);
  unsigned char *taken SW_LOCAL = sw_alloc(made, 1);
  if (!taken) {
    sw_tape_fail(t, SW_ENOMEM);
    return;
  }
  for (size_t k = 0; k < made && sw_tape_good(t); k++) {
    const size_t number =
        k < s->wire_count ? s->wires[k].number : s->gone[k - s->wire_count].number;
    const int in_order = !k || k >= s->wire_count || s->wires[k - 1].number < number;
    sw_tape_expect(t, number < made && in_order && !taken[number]++, "the numbers of wires");
  }
}
