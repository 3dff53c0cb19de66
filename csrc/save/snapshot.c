/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots: the scene on a tape that stays in the process. Restoring gives the same bits as if
 * nothing had happened in between. */

#include "base/alloc.h"
#include "body/build.h"
#include "body/hold.h"
#include "link/joint.h"
#include "mutual/through.h"
#include "read/kept_frames.h"
#include "record/wear.h"
#include "save/life.h"
#include "save/save.h"
#include "scene/forces.h"
#include "scene/obstacle.h"
#include "scene/scene.h"
#include "scene/wire.h"
#include "scene/world.h"

struct sw_snapshot {
  sw_scene *scene; /* NULL once the scene is gone */
  sw_snapshot *next;
  sw_tape tape;
  double time; /* [s] */
  size_t build, holds, obstacles, tools, forces, joins, rules, zones, frames, frame_stride;
  uint32_t *force; /* (forces) generations of living forces; 0 for others */
  sw_frame end;    /* copy of the frame of a run's end; without data: there was none */
  sw_frames kept;  /* copies of the frames, if it keeps any */
  int keeps;       /* 0: restoring only drops later frames */
};

int sw_snapshot_busy(const sw_snapshot *p) { return p->scene && p->scene->restoring == p; }

double sw_snapshot_time(const sw_snapshot *p) { return p->time; }

int sw_scene_force_needed(const sw_scene *s, sw_handle h) {
  if (h.slot < s->force_count && s->forces[h.slot].generation == h.generation &&
      s->forces[h.slot].alive)
    return 1;
  for (const sw_snapshot *p = s->snapshots; p; p = p->next)
    if (h.slot < p->forces && p->force[h.slot] == h.generation) return 1;
  return 0;
}

void sw_scene_orphan_snapshots(sw_scene *s) {
  for (; s->snapshots; s->snapshots = s->snapshots->next) s->snapshots->scene = NULL;
}

static void unlink_snapshot(sw_snapshot *p) {
  if (!p->scene) return;
  sw_snapshot **at = &p->scene->snapshots;
  while (*at && *at != p) at = &(*at)->next;
  if (*at) *at = p->next;
}

void sw_snapshot_free(sw_snapshot *p) {
  if (!p) return;
  unlink_snapshot(p);
  sw_tape_free(&p->tape);
  sw_free(p->force);
  sw_free(p->end.data);
  sw_frames_free(&p->kept);
  sw_free(p);
}

/* Estimates the bytes of the scene; the tape grows if it needs more. */
static size_t size_of(const sw_scene *s) {
  const sw_live live = sw_live_of(s);
  size_t size = sw_live_size(&live) + sizeof *s + s->events.count * sizeof *s->events.list;
  SW_EACH(wire, wire, s) {
    const size_t records = wire->window.marks ? (2 + wire->window.marks) * wire->window.edges : 0;
    const size_t each = wire->mesh.rest ? 17 : 7; /* doubles per node */
    size += sizeof *wire + (each * wire->mesh.n + records) * sizeof(double);
    size += wire->wear.count * (sizeof(sw_wear_place) + SW_WEAR_SIGNALS * sizeof(double));
    size += (2 + wire->wear.pressed.marks) * wire->wear.pressed.edges * sizeof(double);
  }
  return size + s->hold_count * sizeof *s->holds + s->obstacle_count * sizeof *s->obstacles +
         s->tool_count * sizeof *s->tools + s->force_count * sizeof *s->forces +
         s->join_count * sizeof *s->joins + s->watches.count * 64;
}

sw_status sw_scene_snapshot(sw_scene *s, sw_snapshot **out, sw_error *err) {
  sw_live live;
  int built;
  SW_TRY(sw_scene_still(s, err));
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_build(s, err));
  sw_scene_undo_holds(s);
  sw_snapshot *p = sw_alloc(1, sizeof *p);
  uint32_t *force = sw_alloc(s->force_count, sizeof *force);
  if (!p || !force) {
    sw_free(p);
    sw_free(force);
    return sw_fail(err, SW_ENOMEM, "snapshot: out of memory");
  }
  *p = (sw_snapshot){.force = force, .time = s->time, .build = s->build};
  p->zones = s->zones.count;
  p->holds = s->hold_count, p->obstacles = s->obstacle_count, p->tools = s->tool_count;
  p->forces = s->force_count, p->joins = s->join_count, p->rules = s->rules.count;
  const size_t closed = (size_t)sw_frames_closed(&s->frames);
  p->frames = s->frames.count - closed, p->frame_stride = s->frames.stride;
  for (size_t k = 0; k < s->force_count; k++)
    if (s->forces[k].alive) force[k] = s->forces[k].generation;
  p->tape = sw_tape_at_home(size_of(s), NULL);
  sw_tape_scene(&p->tape, s, &built, &live);
  if (!sw_tape_good(&p->tape) ||
      (closed && sw_frame_copy(&s->frames.list[p->frames], &p->end) != SW_OK)) {
    sw_snapshot_free(p);
    return sw_fail(err, SW_ENOMEM, "snapshot: out of memory");
  }
  p->scene = s;
  p->next = s->snapshots;
  s->snapshots = p;
  *out = p;
  return SW_OK;
}

sw_status sw_snapshot_keep_frames(sw_snapshot *p, sw_error *err) {
  if (p->keeps || !p->scene) return SW_OK;
  if (sw_frames_copy(&p->scene->frames, &p->kept) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "snapshot: out of memory for its frames");
  p->keeps = 1;
  return SW_OK;
}

/* Gives the scene the snapshot's frames instead of its own. */
static sw_status put_frames(sw_scene *s, const sw_snapshot *p) {
  sw_frames frames;
  SW_TRY(sw_frames_copy(&p->kept, &frames));
  sw_frames_free(&s->frames);
  s->frames = frames;
  return SW_OK;
}

/* 1 if the built system is still the snapshot's. A feed moves its nodes, so with a feed it is
 * not. */
static int same_system(const sw_scene *s, const sw_snapshot *p) {
  if (!sw_scene_is_built(s) || s->build != p->build || s->hold_count != p->holds) return 0;
  SW_EACH(hold, h, s)
    if (h->alive && sw_hold_passes(h)) return 0;
  return s->obstacle_count == p->obstacles && s->tool_count == p->tools &&
         s->force_count == p->forces && s->join_count == p->joins && s->rules.count == p->rules &&
         s->zones.count == p->zones;
}

/* Restores into the existing system. */
static sw_status put_back(sw_scene *s, const sw_snapshot *p, sw_error *err) {
  sw_live live = {0};
  int built;
  const uint32_t serial = s->serial;
  sw_tape t = sw_tape_read_home(&p->tape, err);
  sw_tape_scene(&t, s, &built, &live);
  s->serial = serial;
  const int next = s->course.next;
  sw_status status = t.status;
  s->restoring = p; /* placing the holds may call a user's function */
  if (status == SW_OK) status = sw_scene_build(s, err);
  if (status == SW_OK) status = sw_live_put(s, &live, err);
  s->restoring = NULL;
  s->course.next = next;
  if (status == SW_OK) status = sw_through_begin(&s->through, &s->system, s->pairs, s->time);
  return status;
}

/* Restores by making a new scene that takes the place of this one. */
static sw_status make_anew(sw_scene *s, const sw_snapshot *p, sw_error *err) {
  sw_live live = {0};
  int built;
  sw_scene *other = sw_alloc(1, sizeof *other);
  if (!other) return SW_ENOMEM;
  sw_tape t = sw_tape_read_home(&p->tape, err);
  sw_tape_scene(&t, other, &built, &live);
  other->builds = s->builds;
  sw_status status = t.status;
  if (status == SW_OK) status = sw_scene_take_place(s, other, &live, built, p, err);
  if (status == SW_OK) {
    s->builds = other->builds > s->builds ? other->builds : s->builds;
    s->build = p->build, s->serial = other->serial;
    sw_frames *f = &other->frames;
    f->next = s->frames.next, f->memory = s->frames.memory;
    s->frames = *f;
    f->list = NULL, f->count = f->capacity = 0;
  }
  sw_scene_free(other);
  return status;
}

sw_status sw_scene_restore(sw_scene *s, const sw_snapshot *p, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  if (!p->scene)
    return sw_fail(err, SW_EINVAL,
                   "restore: the snapshot is of the scene as it was before a file took its place");
  if (p->scene != s) return sw_fail(err, SW_EINVAL, "restore: the snapshot is of another scene");
  sw_status status = same_system(s, p) ? put_back(s, p, err) : make_anew(s, p, err);
  if (status == SW_OK && p->keeps) status = put_frames(s, p);
  if (status == SW_ENOMEM) return sw_fail(err, status, "restore: out of memory");
  SW_TRY(status);
  s->diverged = 0;
  if (p->keeps) return SW_OK;
  sw_scene_reopen_frames(s);
  sw_scene_frames_back_to(s, p->frames, p->frame_stride);
  if (p->end.data && sw_scene_reclose_frames(s, &p->end) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "restore: out of memory");
  return SW_OK;
}
