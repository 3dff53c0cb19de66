/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames: what a picture or a player needs, stored at even times of a run. One
 * block a frame: energies, obstacle poses with a flag (there), hold poses with one (held), tool
 * poses, then for each wire its node count and positions, how many values each node has and these,
 * the number of its surface's points in a section (0: it is no mesh of particles), and these points
 * with the force across the surface at each. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"

enum { POSE = 7, HOLD = POSE + 1 };

void sw_scene_drop_frames(sw_scene *s) {
  for (size_t i = 0; i < s->frame_count; i++) sw_free(s->frames[i].data);
  s->frame_count = 0;
}

sw_status sw_scene_clear_frames(sw_scene *s, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_scene_drop_frames(s);
  return SW_OK;
}

static void store_pose(double *out, sw_pose pose) {
  sw_store(out, pose.p);
  out[3] = pose.q.w, out[4] = pose.q.x, out[5] = pose.q.y, out[6] = pose.q.z;
}

/* The middle line of a mesh and its surface. */
static sw_status fill_strand(sw_scene *s, const sw_body *b, double **to, sw_error *err) {
  const sw_web *web = b->plan->web;
  const size_t around = web->around_count;
  const double *x = s->system.x + 3 * b->first_node;
  double outline[3 * SW_OUTLINE], wide[3 * SW_OUTLINE], *p = *to;
  double *pressed = sw_alloc(b->plan->nodes, sizeof *pressed);
  if (!pressed) return sw_fail(err, SW_ENOMEM, "out of memory for frames");
  sw_strand_pressed(s, b, pressed, NULL);
  *p++ = (double)web->rings;
  for (size_t r = 0; r < web->rings; r++, p += 3) sw_store(p, sw_strand_middle(web, x, r));
  *p++ = SW_FRAME_VALUES;
  sw_scene_node_values(s, (size_t)(b - s->system.bodies), web->rings, p);
  p += SW_FRAME_VALUES * web->rings;
  *p++ = (double)around;
  for (size_t r = 0; r < web->rings; r++) {
    sw_strand_outline(web, x, r, outline);
    sw_outline_widen(outline, around, sw_strand_facing(web, x, r), web->skin - web->proud, wide);
    for (size_t k = 0; k < around; k++, p += SW_FRAME_SURFACE) {
      sw_store(p, sw_vec_at(wide, k));
      p[3] = pressed[web->first[r] + (sw_web_is_ring(web, r) ? web->around[k] : 0)];
    }
  }
  sw_free(pressed);
  *to = p;
  return SW_OK;
}

/* Numbers that a wire takes in a frame. */
static size_t size_of(const sw_plan *p) {
  if (!p->web) return 3 + (3 + SW_FRAME_VALUES) * p->nodes;
  if (!p->web->per_ring) return 3 + 3 * p->nodes;
  return 3 + (3 + SW_FRAME_VALUES + SW_FRAME_SURFACE * p->web->around_count) * p->web->rings;
}

static sw_status fill(sw_scene *s, double *p, sw_error *err) {
  sw_motion_state at;
  sw_scene_frame_energies(s, p);
  p += SW_FRAME_ENERGIES;
  for (size_t k = 0; k < s->obstacle_count; k++, p += HOLD) {
    SW_TRY(sw_drive_eval(s, &s->obstacles[k].drive, s->time, &at, err));
    store_pose(p, at.pose);
    p[POSE] = s->obstacles[k].alive;
  }
  for (size_t k = 0; k < s->hold_count; k++, p += HOLD) {
    at.pose = s->holds[k].last_pose;
    if (s->holds[k].alive) SW_TRY(sw_drive_eval(s, &s->holds[k].drive, s->time, &at, err));
    store_pose(p, at.pose);
    p[POSE] = s->holds[k].alive;
  }
  for (size_t k = 0; k < s->tool_count; k++, p += POSE) {
    SW_TRY(sw_drive_eval(s, &s->tools[k].drive, s->time, &at, err));
    store_pose(p, at.pose);
  }
  for (size_t w = 0; w < s->wire_count; w++) {
    const sw_body *b = &s->system.bodies[w];
    const sw_web *web = b->plan->web;
    if (web && web->per_ring) {
      SW_TRY(fill_strand(s, b, &p, err));
      continue;
    }
    *p++ = (double)b->plan->nodes;
    memcpy(p, s->system.x + 3 * b->first_node, 3 * b->plan->nodes * sizeof *p);
    p += 3 * b->plan->nodes;
    *p++ = web ? 0 : SW_FRAME_VALUES;
    if (!web) sw_scene_node_values(s, w, b->plan->nodes, p);
    if (!web) p += SW_FRAME_VALUES * b->plan->nodes;
    *p++ = 0;
  }
  return SW_OK;
}

sw_status sw_scene_store_frame(sw_scene *s, sw_error *err) {
  size_t size =
      SW_FRAME_ENERGIES + POSE * s->tool_count + HOLD * (s->obstacle_count + s->hold_count);
  for (size_t w = 0; w < s->wire_count; w++) size += size_of(s->system.bodies[w].plan);
  if (sw_grow((void **)&s->frames, &s->frame_capacity, s->frame_count + 1, sizeof *s->frames) !=
      SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for frames");
  double *data = sw_alloc(size, sizeof *data);
  if (!data) return sw_fail(err, SW_ENOMEM, "out of memory for frames");
  const sw_status status = fill(s, data, err);
  if (status != SW_OK) {
    sw_free(data);
    return status;
  }
  s->frames[s->frame_count++] =
      (sw_frame){s->time, data, s->wire_count, s->obstacle_count, s->hold_count, s->tool_count};
  return SW_OK;
}

static size_t before_wires(const sw_frame *f) {
  return SW_FRAME_ENERGIES + POSE * f->tools + HOLD * (f->obstacles + f->holds);
}

int sw_scene_frame_walk(const sw_frame *f, size_t room, size_t *size) {
  size_t at = before_wires(f);
  for (size_t w = 0; w < f->wires; w++) {
    double count[3]; /* nodes, values of each, points around each [-] */
    for (size_t k = 0; k < 3; k++) {
      if (at >= room) return 0;
      count[k] = f->data[at++];
      const double each = k == 0 ? 3 : k == 1 ? count[0] : SW_FRAME_SURFACE * count[0];
      if (!(count[k] >= 0) || count[k] != floor(count[k]) ||
          (k == 1 && count[k] > 0 && count[k] != SW_FRAME_VALUES) ||
          !(each * count[k] <= (double)(room - at)))
        return 0;
      at += (size_t)(each * count[k]);
    }
  }
  *size = at;
  return at <= room;
}

size_t sw_scene_frames(const sw_scene *s) { return s->frame_count; }
double sw_scene_frame_time(const sw_scene *s, size_t frame) { return s->frames[frame].time; }
const double *sw_scene_frame_energy(const sw_scene *s, size_t frame) {
  return s->frames[frame].data;
}

const double *sw_scene_frame_obstacle(const sw_scene *s, size_t frame, size_t o, int *there) {
  const sw_frame *f = &s->frames[frame];
  if (o >= f->obstacles) return NULL;
  const double *p = f->data + SW_FRAME_ENERGIES + HOLD * o;
  *there = p[POSE] > 0;
  return p;
}

const double *sw_scene_frame_hold(const sw_scene *s, size_t frame, size_t h, int *held) {
  const sw_frame *f = &s->frames[frame];
  if (h >= f->holds) return NULL;
  const double *p = f->data + SW_FRAME_ENERGIES + HOLD * (f->obstacles + h);
  *held = p[POSE] > 0;
  return p;
}

const double *sw_scene_frame_tool(const sw_scene *s, size_t frame, size_t k) {
  const sw_frame *f = &s->frames[frame];
  return k < f->tools ? f->data + before_wires(f) - POSE * (f->tools - k) : NULL;
}

int sw_scene_frame_is_loose(const sw_scene *s, size_t w) {
  return w < s->wire_count && sw_scene_is_loose(&s->wires[w]);
}

const double *sw_scene_frame_wire(const sw_scene *s, size_t frame, size_t w, size_t *count) {
  const sw_frame *f = &s->frames[frame];
  if (w >= f->wires) return NULL;
  const double *p = f->data + before_wires(f);
  for (size_t k = 0; k < w; k++) {
    const size_t nodes = (size_t)*p;
    p += 1 + 3 * nodes;
    p += 1 + nodes * (size_t)*p;
    p += 1 + SW_FRAME_SURFACE * nodes * (size_t)*p;
  }
  *count = (size_t)*p;
  return p + 1;
}

const double *sw_scene_frame_values(const sw_scene *s, size_t frame, size_t w, size_t *count) {
  const double *p = sw_scene_frame_wire(s, frame, w, count);
  if (!p) return NULL;
  p += 3 * *count;
  return *p > 0 ? p + 1 : NULL;
}

const double *sw_scene_frame_surface(const sw_scene *s, size_t frame, size_t w, size_t *count,
                                     size_t *around) {
  const double *p = sw_scene_frame_wire(s, frame, w, count);
  if (!p) return NULL;
  p += 3 * *count;
  p += 1 + *count * (size_t)*p;
  *around = (size_t)*p;
  *count *= *around;
  return *around ? p + 1 : NULL;
}
