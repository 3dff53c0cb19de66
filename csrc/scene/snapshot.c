/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Snapshots: everything that a run changes, exactly. Restoring gives the same
 * bits as if nothing had happened in between. */
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"

typedef struct saved_hold {
  int alive;
  sw_drive drive;
  sw_vec force, moment;
  sw_pose last_pose;
  sw_hold_watch watch;
  size_t log_count;
  sw_scene_hold shape; /* where and how it holds, nothing else of it */
  double s1, s2;       /* of a hold that feeds they change [m] */
  sw_feed feed;        /* its motion retained, its shape not owned */
} saved_hold;

typedef struct saved_obstacle {
  int alive, off;
  sw_drive drive;
  size_t log_count;
  sw_contact_past past;
  double friction, kinetic, restitution; /* [-] */
} saved_obstacle;

struct sw_snapshot {
  sw_scene *scene; /* NULL once it is gone */
  sw_snapshot *next;
  double time, span, window, next_dt, blow_part, blow_since, blow_until, next_frame;
  sw_vec gravity;
  size_t wires, holds, obstacles, forces, frames, frame_stride;
  sw_mesh *meshes;
  sw_strand *strands;           /* (wires), their places those of some state or other */
  const sw_wire_class **models; /* (wires) */
  sw_wire_extremes *extremes;   /* (wires) */
  sw_window *windows;           /* (wires) */
  int *untwisted;               /* (wires) */
  saved_hold *hold;
  saved_obstacle *obstacle;
  sw_tool *tool; /* (tools): their motions retained, their logs not owned */
  size_t tools;
  int *force_alive;
  sw_scene_join *join; /* (joins) */
  size_t joins;
  size_t *watched; /* (watches) lengths of logs [-] */
  size_t watches;
  sw_live live;
  int discontinuous, diverged;
  sw_error why;
  sw_extreme deepest;
  size_t rules;
};

int sw_snapshot_busy(const sw_snapshot *p) { return p->scene && p->scene->restoring == p; }

double sw_snapshot_time(const sw_snapshot *p) { return p->time; }

int sw_scene_force_needed(const sw_scene *s, sw_handle h) {
  if (!sw_scene_force_class(s, h)) return 0;
  if (s->forces[h.slot].alive) return 1;
  for (const sw_snapshot *p = s->snapshots; p; p = p->next)
    if (h.slot < p->forces && p->force_alive[h.slot]) return 1;
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
  for (size_t w = 0; p->meshes && w < p->wires; w++) sw_mesh_free(&p->meshes[w]);
  for (size_t w = 0; p->strands && w < p->wires; w++) sw_strand_free(&p->strands[w]);
  for (size_t w = 0; p->windows && w < p->wires; w++) sw_window_free(&p->windows[w]);
  for (size_t k = 0; p->hold && k < p->holds; k++) {
    sw_drive_free(&p->hold[k].drive);
    sw_scene_clear_hold(&p->hold[k].shape);
    sw_motion_release(p->hold[k].feed.motion);
  }
  for (size_t k = 0; p->obstacle && k < p->obstacles; k++) sw_drive_free(&p->obstacle[k].drive);
  for (size_t k = 0; p->tool && k < p->tools; k++) {
    sw_drive_free(&p->tool[k].drive);
    sw_frozen_release(p->tool[k].frozen);
  }
  sw_free(p->meshes);
  sw_free(p->strands);
  sw_free(p->models);
  sw_free(p->extremes);
  sw_free(p->windows);
  sw_free(p->untwisted);
  sw_free(p->hold);
  sw_free(p->obstacle);
  sw_free(p->tool);
  sw_free(p->force_alive);
  sw_free(p->join);
  sw_free(p->watched);
  sw_live_free(&p->live);
  sw_free(p);
}

static sw_status copy_block(const void *from, size_t bytes, void *to_pointer) {
  void *copy = sw_alloc(bytes, 1);
  if (!copy) return SW_ENOMEM;
  if (bytes) memcpy(copy, from, bytes);
  *(void **)to_pointer = copy;
  return SW_OK;
}

static sw_drive copy_drive(const sw_drive *d) {
  sw_drive copy = *d;
  sw_motion_retain(copy.motion);
  return copy;
}

static sw_status copy_objects(const sw_scene *s, sw_snapshot *p) {
  p->meshes = sw_alloc(s->wire_count, sizeof *p->meshes);
  p->strands = sw_alloc(s->wire_count, sizeof *p->strands);
  p->models = sw_alloc(s->wire_count, sizeof(const sw_wire_class *));
  p->extremes = sw_alloc(s->wire_count, sizeof *p->extremes);
  p->windows = sw_alloc(s->wire_count, sizeof *p->windows);
  p->untwisted = sw_alloc(s->wire_count, sizeof *p->untwisted);
  p->hold = sw_alloc(s->hold_count, sizeof *p->hold);
  p->obstacle = sw_alloc(s->obstacle_count, sizeof *p->obstacle);
  p->force_alive = sw_alloc(s->force_count, sizeof *p->force_alive);
  if (!p->meshes || !p->strands || !p->models || !p->extremes || !p->windows || !p->untwisted ||
      !p->hold || !p->obstacle || !p->force_alive)
    return SW_ENOMEM;
  for (size_t w = 0; w < s->wire_count; w++) {
    SW_TRY(sw_mesh_copy(&s->wires[w].mesh, &p->meshes[w]));
    p->wires = w + 1;
    SW_TRY(sw_strand_copy(&s->wires[w].strand, &p->strands[w]));
    SW_TRY(sw_window_copy(&s->wires[w].window, &p->windows[w]));
    p->models[w] = s->wires[w].cls;
    p->extremes[w] = s->wires[w].extremes;
    p->untwisted[w] = s->wires[w].untwisted;
  }
  for (; p->holds < s->hold_count; p->holds++) {
    const sw_scene_hold *h = &s->holds[p->holds];
    saved_hold *kept = &p->hold[p->holds];
    SW_TRY(sw_scene_copy_shape(h, &kept->shape));
    kept->alive = h->alive, kept->drive = copy_drive(&h->drive);
    kept->force = h->force, kept->moment = h->moment;
    kept->last_pose = h->last_pose, kept->log_count = h->log.count;
    kept->watch = h->watch;
    kept->s1 = h->s1, kept->s2 = h->s2, kept->feed = h->feed;
    sw_motion_retain(h->feed.motion);
  }
  for (; p->obstacles < s->obstacle_count; p->obstacles++) {
    const sw_scene_obstacle *o = &s->obstacles[p->obstacles];
    p->obstacle[p->obstacles] =
        (saved_obstacle){o->alive,    o->off,     copy_drive(&o->drive), o->log.count, o->past,
                         o->friction, o->kinetic, o->restitution};
  }
  SW_TRY(copy_block(s->tools, s->tool_count * sizeof *p->tool, &p->tool));
  for (; p->tools < s->tool_count; p->tools++) {
    sw_motion_retain(p->tool[p->tools].drive.motion);
    sw_frozen_retain(p->tool[p->tools].frozen);
  }
  SW_TRY(copy_block(s->joins, s->join_count * sizeof *p->join, &p->join));
  p->joins = s->join_count;
  SW_TRY(sw_watches_measure(&s->watches, &p->watched));
  p->watches = s->watches.count;
  for (; p->forces < s->force_count; p->forces++)
    p->force_alive[p->forces] = s->forces[p->forces].alive;
  return SW_OK;
}

sw_status sw_scene_snapshot(sw_scene *s, sw_snapshot **out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_build(s, err));
  sw_feed_undo(s);
  sw_snapshot *p = sw_alloc(1, sizeof *p);
  if (!p) return sw_fail(err, SW_ENOMEM, "snapshot: out of memory");
  p->time = s->time, p->span = s->span, p->window = s->window;
  p->blow_part = s->blow_part, p->blow_since = s->blow_since, p->blow_until = s->blow_until;
  p->next_dt = s->next_dt, p->next_frame = s->next_frame;
  p->gravity = s->gravity;
  p->discontinuous = s->discontinuous;
  p->deepest = s->deepest;
  p->frames = s->frame_count, p->frame_stride = s->frame_stride;
  p->rules = s->rule_count;
  sw_status status = sw_obstacle_log_fill_all(s);
  if (status == SW_OK) status = copy_objects(s, p);
  if (status == SW_OK) status = sw_live_take(s, &p->live);
  if (status != SW_OK) {
    sw_snapshot_free(p);
    return sw_fail(err, status, "snapshot: out of memory");
  }
  p->scene = s;
  p->next = s->snapshots;
  s->snapshots = p;
  *out = p;
  return SW_OK;
}

static int same_surface(const sw_scene_obstacle *o, const saved_obstacle *saved) {
  return o->friction == saved->friction && o->kinetic == saved->kinetic &&
         o->restitution == saved->restitution;
}

/* Is the built system of the same plan as the snapshot's? */
static int same_plan(const sw_scene *s, const sw_snapshot *p) {
  if (!s->built || s->wire_count != p->wires || s->rule_count != p->rules) return 0;
  for (size_t w = 0; w < p->wires; w++)
    if (s->wires[w].cls != p->models[w] || s->wires[w].strand.web != p->strands[w].web ||
        s->wires[w].mesh.n != p->meshes[w].n || s->wires[w].mesh.scale != p->meshes[w].scale ||
        memcmp(s->wires[w].mesh.s, p->meshes[w].s, p->meshes[w].n * sizeof(double)) != 0)
      return 0;
  for (size_t k = 0; k < s->hold_count; k++)
    if (s->holds[k].alive != (k < p->holds && p->hold[k].alive) ||
        (k < p->holds && s->holds[k].shape != p->hold[k].shape.shape))
      return 0;
  for (size_t k = 0; k < s->obstacle_count; k++)
    if (s->obstacles[k].alive != (k < p->obstacles && p->obstacle[k].alive) ||
        (k < p->obstacles && (s->obstacles[k].off != p->obstacle[k].off ||
                              !same_surface(&s->obstacles[k], &p->obstacle[k]))))
      return 0;
  for (size_t k = 0; k < s->force_count; k++)
    if (s->forces[k].alive != (k < p->forces && p->force_alive[k])) return 0;
  for (size_t k = 0; k < s->join_count; k++)
    if (s->joins[k].alive != (k < p->joins && p->join[k].alive) ||
        (k < p->joins && s->joins[k].broken != p->join[k].broken))
      return 0;
  return 1;
}

static void put_drive(sw_drive *to, const sw_drive *from) {
  sw_drive copy = copy_drive(from);
  sw_drive_free(to);
  *to = copy;
}

static void put_feed(sw_scene_hold *h, const saved_hold *saved) {
  const sw_mesh shape = h->feed.shape; /* never changes */
  const size_t node = h->feed.node, number = h->feed.number;
  if (!h->cls->feeds) return;
  sw_motion_retain(saved->feed.motion);
  sw_motion_release(h->feed.motion);
  h->feed = saved->feed;
  h->feed.shape = shape;
  h->feed.node = node, h->feed.number = number;
  h->s1 = saved->s1, h->s2 = saved->s2;
  h->s[0] = h->s1;
  if (shape.rest) sw_feed_rest(h, h->s1);
}

static void put_tool(sw_tool *to, const sw_tool *saved) {
  sw_log log = to->log;
  to->alive = 0;
  if (!saved) return;
  if (log.count > saved->log.count) log.count = saved->log.count;
  put_drive(&to->drive, &saved->drive);
  sw_frozen_retain(saved->frozen);
  sw_frozen_release(to->frozen);
  const sw_drive drive = to->drive;
  *to = *saved;
  to->drive = drive;
  to->log = log;
}

/* Objects made after the snapshot go away; the others get their old state. */
static void put_objects(sw_scene *s, const sw_snapshot *p) {
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_scene_hold *h = &s->holds[k];
    if (k >= p->holds) {
      h->alive = 0;
      continue;
    }
    h->alive = p->hold[k].alive;
    h->force = p->hold[k].force, h->moment = p->hold[k].moment;
    h->last_pose = p->hold[k].last_pose;
    h->watch = p->hold[k].watch;
    if (h->log.count > p->hold[k].log_count) h->log.count = p->hold[k].log_count;
    put_drive(&h->drive, &p->hold[k].drive);
    put_feed(h, &p->hold[k]);
  }
  s->contact_steps.count = 0; /* series in snapshots are complete */
  for (size_t k = 0; k < s->obstacle_count; k++) {
    sw_scene_obstacle *o = &s->obstacles[k];
    o->alive = k < p->obstacles && p->obstacle[k].alive;
    sw_obstacle_log_begin(s, o);
    if (k >= p->obstacles) continue;
    if (o->log.count > p->obstacle[k].log_count) o->log.count = p->obstacle[k].log_count;
    o->off = p->obstacle[k].off;
    o->friction = p->obstacle[k].friction, o->kinetic = p->obstacle[k].kinetic;
    o->restitution = p->obstacle[k].restitution;
    o->past = p->obstacle[k].past;
    put_drive(&o->drive, &p->obstacle[k].drive);
  }
  for (size_t k = 0; k < s->tool_count; k++)
    put_tool(&s->tools[k], k < p->tools ? &p->tool[k] : NULL);
  for (size_t k = 0; k < s->force_count; k++)
    s->forces[k].alive = k < p->forces && p->force_alive[k];
  for (size_t k = 0; k < s->join_count; k++) {
    if (k < p->joins)
      s->joins[k] = p->join[k];
    else
      s->joins[k].alive = 0;
  }
  for (size_t w = 0; w < p->wires; w++) s->wires[w].extremes = p->extremes[w];
}

/* Slots beyond what any living snapshot knows are free again. */
static void drop_newer(sw_scene *s, const sw_snapshot *p) {
  size_t holds = 0, obstacles = 0, forces = 0, joins = 0, tools = 0, watches = 0;
  for (const sw_snapshot *q = s->snapshots; q; q = q->next) {
    if (q->holds > holds) holds = q->holds;
    if (q->obstacles > obstacles) obstacles = q->obstacles;
    if (q->forces > forces) forces = q->forces;
    if (q->joins > joins) joins = q->joins;
    if (q->tools > tools) tools = q->tools;
    if (q->watches > watches) watches = q->watches;
  }
  sw_watches_back_to(&s->watches, p->watched, p->watches, watches);
  while (s->hold_count > holds) sw_scene_clear_hold(&s->holds[--s->hold_count]);
  while (s->obstacle_count > obstacles) sw_scene_clear_obstacle(&s->obstacles[--s->obstacle_count]);
  while (s->force_count > forces) sw_scene_clear_force(&s->forces[--s->force_count]);
  while (s->tool_count > tools) sw_scene_clear_tool(&s->tools[--s->tool_count]);
  if (s->join_count > joins) s->join_count = joins;
}

/* What the scene's meshes and holds were, allocated before anything is changed. */
typedef struct copies {
  sw_mesh *meshes;      /* (wires) */
  sw_strand *strands;   /* (wires) */
  sw_scene_hold *holds; /* (holds): shapes of those that were taken anew since */
} copies;

static sw_status make_copies(const sw_scene *s, const sw_snapshot *p, copies *c) {
  c->meshes = sw_alloc(p->wires, sizeof *c->meshes);
  c->strands = sw_alloc(p->wires, sizeof *c->strands);
  c->holds = sw_alloc(p->holds, sizeof *c->holds);
  if (!c->meshes || !c->strands || !c->holds) return SW_ENOMEM;
  for (size_t w = 0; w < p->wires; w++) {
    SW_TRY(sw_mesh_copy(&p->meshes[w], &c->meshes[w]));
    SW_TRY(sw_strand_copy(&p->strands[w], &c->strands[w]));
  }
  for (size_t k = 0; k < p->holds; k++)
    if (s->holds[k].shape != p->hold[k].shape.shape)
      SW_TRY(sw_scene_copy_shape(&p->hold[k].shape, &c->holds[k]));
  return SW_OK;
}

static void free_copies(const sw_snapshot *p, copies *c) {
  for (size_t w = 0; c->meshes && w < p->wires; w++) sw_mesh_free(&c->meshes[w]);
  for (size_t w = 0; c->strands && w < p->wires; w++) sw_strand_free(&c->strands[w]);
  for (size_t k = 0; c->holds && k < p->holds; k++) sw_scene_clear_hold(&c->holds[k]);
  sw_free(c->meshes);
  sw_free(c->strands);
  sw_free(c->holds);
}

static void swap_shape(sw_scene_hold *h, sw_scene_hold *copy) {
  double *s = h->s, *local = h->local;
  uint32_t *particle = h->particle;
  h->shape = copy->shape, h->s1 = copy->s1, h->s2 = copy->s2, h->count = copy->count;
  memcpy(h->director, copy->director, sizeof h->director);
  memcpy(h->frame, copy->frame, sizeof h->frame);
  memcpy(h->give, copy->give, sizeof h->give);
  h->formed = copy->formed;
  h->s = copy->s, h->local = copy->local, h->particle = copy->particle;
  copy->s = s, copy->local = local, copy->particle = particle;
}

/* Meshes and holds as they were, in a scene that is not built. */
static sw_status put_meshes(sw_scene *s, const sw_snapshot *p) {
  copies c = {0};
  const sw_status status = make_copies(s, p, &c);
  if (status == SW_OK) {
    for (size_t w = 0; w < p->wires; w++) {
      const sw_mesh now = s->wires[w].mesh;
      const sw_strand strand = s->wires[w].strand;
      s->wires[w].mesh = c.meshes[w];
      s->wires[w].strand = c.strands[w];
      s->wires[w].cls = p->models[w];
      c.meshes[w] = now;
      c.strands[w] = strand;
    }
    for (size_t k = 0; k < p->holds; k++)
      if (c.holds[k].s) swap_shape(&s->holds[k], &c.holds[k]);
  }
  free_copies(p, &c);
  return status;
}

/* The same plan: only what tells, at the next thaw, whether a wire is as it was drawn. */
static void put_drawn(sw_scene *s, const sw_snapshot *p) {
  for (size_t w = 0; w < p->wires; w++) {
    sw_mesh *m = &s->wires[w].mesh;
    const sw_mesh *old = &p->meshes[w];
    m->drawn = old->drawn;
    memcpy(m->x, old->x, 3 * m->n * sizeof *m->x);
    memcpy(m->v, old->v, 3 * m->n * sizeof *m->v);
    if (!m->rest) continue;
    memcpy(m->normal, old->normal, 3 * m->n * sizeof *m->normal);
    memcpy(m->twist, old->twist, m->n * sizeof *m->twist);
  }
}

static sw_status put_windows(sw_scene *s, const sw_snapshot *p) {
  for (size_t w = 0; w < p->wires; w++) SW_TRY(sw_window_copy(&p->windows[w], &s->wires[w].window));
  return SW_OK;
}

/* Wires that had not moved yet lie untwisted again. */
static sw_status put_untwisted(sw_scene *s, const sw_snapshot *p) {
  for (size_t w = 0; w < p->wires; w++)
    if (p->untwisted[w]) SW_TRY(sw_scene_draw_untwisted(&s->wires[w]));
  return SW_OK;
}

sw_status sw_scene_restore(sw_scene *s, const sw_snapshot *p, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  if (!p->scene)
    return sw_fail(err, SW_EINVAL,
                   "restore: the snapshot is of the scene as it was before a file took its place");
  if (p->scene != s) return sw_fail(err, SW_EINVAL, "restore: the snapshot is of another scene");
  if (s->wire_count > p->wires)
    return sw_fail(err, SW_EINVAL,
                   "restore: wire '%s' was added after the snapshot; wires cannot be taken away",
                   s->wires[p->wires].name);
  if (!same_plan(s, p)) {
    SW_TRY(sw_scene_thaw(s));
    if (put_meshes(s, p) != SW_OK) return sw_fail(err, SW_ENOMEM, "restore: out of memory");
  } else {
    put_drawn(s, p);
  }
  if (put_untwisted(s, p) != SW_OK || put_windows(s, p) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "restore: out of memory");
  put_objects(s, p);
  drop_newer(s, p);
  sw_scene_drop_rules(s, p->rules);
  s->time = p->time, s->span = p->span, s->window = p->window;
  s->blow_part = p->blow_part, s->blow_since = p->blow_since, s->blow_until = p->blow_until;
  s->next_dt = p->next_dt, s->next_frame = p->next_frame;
  s->gravity = p->gravity;
  s->deepest = p->deepest;
  s->restoring = p; /* placing the holds may call a user's function */
  sw_status status = sw_scene_build(s, err);
  if (status == SW_OK) s->diverged = 0;
  if (status == SW_OK) status = sw_live_put(s, &p->live, err);
  s->restoring = NULL;
  if (status != SW_OK) return status;
  s->discontinuous = p->discontinuous;
  sw_events_back_to(&s->events, p->time);
  sw_ledger_forget(s);
  sw_scene_frames_back_to(s, p->frames, p->frame_stride);
  return SW_OK;
}
