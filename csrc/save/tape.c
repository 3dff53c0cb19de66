/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a scene on a tape, the only form for a file, a snapshot or another process: its objects, and
 * the state of the built scene or the memory of an edited one. A scene that is not built is written
 * as it is, because building it between two edits would give other bits. */
#include "base/alloc.h"
#include "body/build.h"
#include "body/history.h"
#include "body/live.h"
#include "body/touching.h"
#include "edit/leave.h"
#include "grip/jaws.h"
#include "link/joint.h"
#include "read/kept_frames.h"
#include "save/save.h"
#include "scene/forces.h"
#include "scene/obstacle.h"
#include "scene/world.h"
#include "watch/observe.h"
#include "watch/zone.h"

enum { LEAST = 32 }; /* smallest size of an object on a tape [B] */

/* Writes or reads the count of a list of slots, and makes room when reading. The caller then counts
 * the slots one by one, so that those that exist are freed in any case. */
static size_t tape_list(sw_tape *t, void *list_pointer, size_t *count, size_t *capacity,
                        size_t item) {
  size_t n = *count;
  sw_tape_count(t, &n, LEAST);
  if (!sw_tape_reads(t) || !sw_tape_good(t)) return n;
  if (sw_grow(list_pointer, capacity, n, item) != SW_OK) sw_tape_fail(t, SW_ENOMEM);
  return n;
}

#define LIST(list, count, capacity, call)                                               \
  do {                                                                                  \
    const size_t n_ = tape_list(t, &s->list, &s->count, &s->capacity, sizeof *s->list); \
    for (size_t k = 0; k < n_ && sw_tape_good(t); k++) {                                \
      if (sw_tape_reads(t) && s->count <= k) s->count = k + 1;                          \
      call;                                                                             \
    }                                                                                   \
  } while (0)

static void tape_numbers(sw_tape *t, sw_scene *s) {
  SW_TAPE_STRUCT(t, sw_scene, 3768);
  sw_tape_name(t, s->name);
  sw_tape_uint32(t, &s->serial);
  sw_tape_vec(t, &s->gravity);
  sw_tape_double(t, &s->time), sw_tape_double(t, &s->course.span),
      sw_tape_double(t, &s->course.window), sw_tape_double(t, &s->course.blow_part),
      sw_tape_double(t, &s->course.blow_since), sw_tape_double(t, &s->course.blow_until),
      sw_tape_double(t, &s->course.part), sw_tape_double(t, &s->course.next_dt),
      sw_tape_double(t, &s->course.stop_until), sw_tape_double(t, &s->frames.next);
  sw_tape_expect(t, s->course.span >= 0 && s->course.span <= 1e9, "the length of a step");
  sw_tape_expect(t, s->course.window >= 0 && s->course.window <= 1e9, "a window");
  sw_tape_expect(t,
                 s->course.blow_part >= 0 && s->course.blow_part <= 1e9 &&
                     !isnan(s->course.blow_since) && !isnan(s->course.blow_until) &&
                     s->course.part >= 0 && s->course.part <= 1e9 && !isnan(s->course.stop_until),
                 "a blow");
  sw_tape_int(t, &s->course.next), sw_tape_int(t, &s->course.means);
  sw_tape_extreme(t, &s->deepest);
  sw_tape_int(t, &s->wears);
}

/* Memory of the last system, of a scene that is not built. */
static void tape_kept(sw_tape *t, sw_scene *s) {
  sw_tape_kept_contact(t, s);
  size_t unused = s->histories.count;
  const size_t n =
      tape_list(t, &s->histories.list, &s->histories.count, &unused, sizeof *s->histories.list);
  for (size_t k = 0; k < n && sw_tape_good(t); k++) {
    if (sw_tape_reads(t)) s->histories.count = k + 1;
    sw_tape_kept_history(t, s, &s->histories.list[k]);
  }
}

/* Only on tapes that leave the process. A restored scene keeps its frames and only drops later
 * ones. A frame of a run's end stays behind: it is made anew (lua/softworld/scene/save.lua). */
static void tape_frames(sw_tape *t, sw_scene *s) {
  const int closed = !sw_tape_reads(t) && sw_frames_closed(&s->frames);
  const double left_out = closed ? sw_frame_bytes(&s->frames.list[s->frames.count - 1]) : 0;
  s->frames.count -= (size_t)closed, s->frames.bytes -= left_out;
  LIST(frames.list, frames.count, frames.capacity, sw_tape_frame(t, s, &s->frames.list[k]));
  sw_tape_size(t, &s->frames.stride), sw_tape_double(t, &s->frames.bytes);
  s->frames.count += (size_t)closed, s->frames.bytes += left_out;
  sw_tape_expect(t, s->frames.stride >= 1 && s->frames.stride < 1u << 30 && s->frames.bytes >= 0,
                 "frames");
}

static void tape_objects(sw_tape *t, sw_scene *s, int built) {
  if (sw_tape_reads(t)) s->contact_steps.count = 0; /* series on tapes are complete */
  tape_numbers(t, s);
  LIST(rules.list, rules.count, rules.capacity, sw_tape_rule(t, &s->rules.list[k]));
  LIST(wires, wire_count, wire_capacity, sw_tape_wire(t, &s->wires[k], !built));
  LIST(gone, gone_count, gone_capacity, sw_tape_gone(t, &s->gone[k]));
  LIST(holds, hold_count, hold_capacity, sw_tape_hold(t, s, &s->holds[k]));
  LIST(obstacles, obstacle_count, obstacle_capacity, sw_tape_obstacle(t, s, &s->obstacles[k]));
  if (sw_tape_reads(t)) sw_scene_find_driven(s);
  LIST(tools, tool_count, tool_capacity, sw_tape_tool(t, s, &s->tools[k]));
  LIST(forces, force_count, force_capacity, sw_tape_force(t, &s->forces[k]));
  LIST(zones.list, zones.count, zones.capacity, sw_tape_zone(t, &s->zones.list[k]));
  LIST(joins, join_count, join_capacity, sw_tape_join(t, &s->joins[k]));
  if (!t->home) tape_frames(t, s);
  if (sw_tape_reads(t)) s->events.count = 0; /* events own no memory */
  LIST(events.list, events.count, events.capacity, sw_tape_event(t, &s->events.list[k]));
  sw_tape_size(t, &s->events.dropped);
  sw_tape_watches(t, &s->watches);
  sw_tape_ledger(t, &s->books);
  if (!built) tape_kept(t, s);
}

void sw_tape_scene(sw_tape *t, sw_scene *s, int *built, sw_live *live) {
  if (!sw_tape_reads(t)) *built = s->built;
  sw_tape_int(t, built);
  tape_objects(t, s, *built);
  if (!*built) return;
  if (!sw_tape_reads(t)) *live = sw_live_of(s);
  sw_tape_live(t, live);
}

/* Continues at the state of the tape's scene. What was edited after it was built remains to be
 * built. */
static sw_status go_on(sw_scene *s, const sw_live *live, int built, sw_error *err) {
  static const char OFF[] = "its state does not go with its objects";
  const int next = s->course.next;
  if (!built) return SW_OK;
  const sw_status status = sw_live_place(s, live);
  if (status == SW_EINVAL) return sw_fail(err, SW_EFORMAT, OFF);
  SW_TRY(status);
  SW_TRY(sw_scene_build(s, err));
  if (!sw_live_fits(s, live)) return sw_fail(err, SW_EFORMAT, OFF);
  SW_TRY(sw_live_put(s, live, err));
  s->course.next = next;
  return SW_OK;
}

sw_status sw_scene_take_place(sw_scene *s, sw_scene *other, const sw_live *live, int built,
                              const sw_snapshot *restoring, sw_error *err) {
  sw_scene old = *s;
  *s = *other;
  s->frames.memory = old.frames.memory; /* the present run's limit stays */
  s->restoring =
      restoring; /* placing the holds may call a user's function, which may close others */
  if (restoring) s->snapshots = old.snapshots;
  const sw_status status = go_on(s, live, built, err);
  s->restoring = NULL;
  if (restoring && status == SW_OK) old.snapshots = NULL;
  if (restoring && status != SW_OK) old.snapshots = s->snapshots, s->snapshots = NULL;
  *other = status == SW_OK ? old : *s;
  if (status != SW_OK) *s = old;
  return status;
}
