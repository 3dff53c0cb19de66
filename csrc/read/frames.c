/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores frames: data for pictures and players at equidistant times of a run. A frame is one block
 * of floats: obstacles and holds (SW_FRAME_BODY numbers and a flag: exists, holds), then tools,
 * then for each wire (removed ones have zeros): its node count and positions, the number of values
 * per node and the values, the number of surface points per section (0: no mesh of particles), and
 * these points with the force across the surface at each. */
#include "read/frames.h"

#include <string.h>

#include "base/alloc.h"
#include "body/build.h"
#include "body/obstacle_log.h"
#include "grip/jaws.h"
#include "link/hold.h"
#include "read/kept_frames.h"
#include "scene/drive.h"
#include "scene/gripper.h"
#include "scene/lists.h"
#include "scene/parts.h"
#include "state/web.h"
#include "strand/ring.h"
#include "system/system.h"

enum { TOOL = SW_FRAME_TOOL, HOLD = SW_FRAME_HOLD, NONE = 3, LEAST = 3 }; /* NONE: of a gone body */

const double SW_FRAME_MEMORY = 256e6;

static void free_data(sw_frames *f) {
  for (size_t i = 0; i < f->count; i++) sw_free(f->list[i].data);
  f->count = 0;
}

static void drop_all(sw_scene *s) {
  sw_frames *all = sw_scene_frames_of(s);
  free_data(all);
  all->stride = 1;
  all->bytes = 0;
}

void sw_frames_free(sw_frames *f) {
  free_data(f);
  sw_free(f->list);
  *f = (sw_frames){0};
}

sw_status sw_frame_copy(const sw_frame *from, sw_frame *to) {
  *to = *from;
  to->data = sw_alloc(from->size + 1, sizeof *to->data); /* never of no size */
  if (!to->data) return SW_ENOMEM;
  memcpy(to->data, from->data, from->size * sizeof *to->data);
  return SW_OK;
}

sw_status sw_frames_copy(const sw_frames *from, sw_frames *to) {
  *to = *from;
  to->count = 0, to->capacity = from->count;
  to->list = sw_alloc(from->count + 1, sizeof *to->list);
  while (to->list && to->count < from->count) {
    if (sw_frame_copy(&from->list[to->count], &to->list[to->count]) != SW_OK) break;
    to->count++;
  }
  if (to->list && to->count == from->count) return SW_OK;
  sw_frames_free(to);
  return SW_ENOMEM;
}

sw_status sw_scene_clear_frames(sw_scene *s, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  drop_all(s);
  return SW_OK;
}

sw_status sw_scene_keep_frames(sw_scene *s, double memory, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_scene_frames_of(s)->memory = memory;
  return SW_OK;
}

size_t sw_scene_frames_thinned(const sw_scene *s) { return sw_scene_frames_of(s)->stride; }

double sw_frame_bytes(const sw_frame *f) { return (double)(f->size * sizeof *f->data + sizeof *f); }

/* Drops every second frame. The last one stays when their number is odd; the next one is due two
 * old strides later. */
static void thin(sw_scene *s) {
  sw_frames *all = sw_scene_frames_of(s);
  size_t kept = 0;
  for (size_t i = 0; i < all->count; i++) {
    if (i % 2 == 0) {
      all->list[kept++] = all->list[i];
      continue;
    }
    all->bytes -= sw_frame_bytes(&all->list[i]);
    sw_free(all->list[i].data);
  }
  all->count = kept;
  all->stride *= 2;
}

void sw_scene_drop_last_frame(sw_scene *s) {
  sw_frames *all = sw_scene_frames_of(s);
  all->bytes -= sw_frame_bytes(&all->list[--all->count]);
  sw_free(all->list[all->count].data);
}

int sw_frames_closed(const sw_frames *f) { return f->count && f->list[f->count - 1].closing; }

int sw_scene_frames_closed(const sw_scene *s) { return sw_frames_closed(sw_scene_frames_of(s)); }

void sw_scene_reopen_frames(sw_scene *s) {
  if (sw_frames_closed(sw_scene_frames_of(s))) sw_scene_drop_last_frame(s);
}

sw_status sw_scene_reclose_frames(sw_scene *s, const sw_frame *end) {
  sw_frames *all = sw_scene_frames_of(s);
  SW_TRY(SW_GROW(all->list, all->capacity, all->count + 1));
  SW_TRY(sw_frame_copy(end, &all->list[all->count]));
  all->bytes += sw_frame_bytes(&all->list[all->count++]);
  return SW_OK;
}

/* 1 if the frame belongs to the scene's past. Frames of a run from another state may be later, or
 * have objects that the scene does not have. */
static int is_of_past(const sw_scene *s, const sw_frame *f) {
  return f->time <= sw_scene_time(s) && f->wires <= sw_scene_bodies_made(s) &&
         f->obstacles <= sw_scene_obstacle_slots(s) && f->holds <= sw_scene_hold_slots(s) &&
         f->tools <= sw_scene_tool_slots(s);
}

void sw_scene_frames_back_to(sw_scene *s, size_t count, size_t stride) {
  sw_frames *all = sw_scene_frames_of(s);
  const size_t ratio = all->stride > stride && stride ? all->stride / stride : 1;
  size_t kept = (count + ratio - 1) / ratio;
  if (kept > all->count) kept = all->count;
  for (size_t k = 0; k < kept; k++)
    if (!is_of_past(s, &all->list[k])) kept = k;
  while (all->count > kept) sw_scene_drop_last_frame(s);
}

static void store_body(float *out, sw_pose pose, sw_vec force) {
  sw_vec_to(out, pose.p);
  out[3] = (float)pose.q.w, out[4] = (float)pose.q.x;
  out[5] = (float)pose.q.y, out[6] = (float)pose.q.z;
  sw_vec_to(out + SW_FRAME_POSE, force);
}

/* Writes the middle line of a mesh and its surface. */
static sw_status fill_strand(sw_scene *s, const sw_body *b, float **to, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  const sw_web *web = b->plan->web;
  const size_t around = web->around_count;
  const double *x = system->x + 3 * b->first_node;
  double outline[3 * SW_OUTLINE], wide[3 * SW_OUTLINE];
  float *p = *to;
  double *pressed SW_LOCAL = sw_alloc(b->plan->nodes, sizeof *pressed);
  if (!pressed) return sw_fail(err, SW_ENOMEM, "out of memory for frames");
  sw_strand_pressed(s, b, pressed, NULL);
  *p++ = (float)web->rings;
  for (size_t r = 0; r < web->rings; r++, p += 3) sw_vec_to(p, sw_web_centre(web, x, r));
  *p++ = SW_FRAME_VALUES;
  sw_scene_node_values(s, (size_t)(b - system->bodies), web->rings, p);
  p += SW_FRAME_VALUES * web->rings;
  *p++ = (float)around;
  for (size_t r = 0; r < web->rings; r++) {
    sw_strand_outline(web, x, r, outline);
    sw_outline_widen(outline, around, sw_web_facing(web, x, r), web->skin - web->proud, wide);
    for (size_t k = 0; k < around; k++, p += SW_FRAME_SURFACE) {
      sw_vec_to(p, sw_vec_at(wide, k));
      p[3] = (float)pressed[web->first[r] + (sw_web_is_ring(web, r) ? web->around[k] : 0)];
    }
  }
  *to = p;
  return SW_OK;
}

/* Returns the number of floats of a wire in a frame. */
static size_t size_of(const sw_plan *p) {
  if (!p->web) return 3 + (3 + SW_FRAME_VALUES) * p->nodes;
  if (!p->web->per_ring) return 3 + 3 * p->nodes;
  return 3 + (3 + SW_FRAME_VALUES + SW_FRAME_SURFACE * p->web->around_count) * p->web->rings;
}

static sw_status fill_bodies(sw_scene *s, float **to, sw_error *err) {
  float *p = *to;
  sw_motion_state at;
  sw_vec force, moment;
  sw_error unknown;
  for (size_t k = 0; k < sw_scene_obstacle_slots(s); k++, p += HOLD) {
    SW_TRY(sw_drive_eval(s, &sw_scene_obstacle_in(s, k)->drive, sw_scene_time(s), &at, err));
    sw_obstacle_mean(sw_scene_obstacle_in(s, k), at.pose.p, &force, &moment);
    store_body(p, at.pose, force);
    p[SW_FRAME_BODY] = (float)sw_scene_obstacle_in(s, k)->alive;
  }
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++, p += HOLD) {
    const sw_hold *h = sw_scene_hold_in(s, k);
    at.pose = h->last_pose;
    if (h->alive) SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &at, err));
    store_body(p, at.pose, h->alive ? h->force : sw_v(0, 0, 0));
    p[SW_FRAME_BODY] = (float)h->alive;
  }
  for (size_t k = 0; k < sw_scene_tool_slots(s); k++, p += TOOL) {
    const sw_handle tool = {(uint32_t)k, sw_scene_tool_in(s, k)->generation};
    SW_TRY(sw_drive_eval(s, &sw_scene_tool_in(s, k)->drive, sw_scene_time(s), &at, err));
    if (sw_scene_tool_force(s, tool, NULL, &force, &moment, &unknown) != SW_OK)
      force = sw_v(0, 0, 0);
    store_body(p, at.pose, force);
  }
  *to = p;
  return SW_OK;
}

static sw_status fill_body(sw_scene *s, size_t w, float **to, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  const sw_web *web = b->plan->web;
  float *p = *to;
  if (web && web->per_ring) return fill_strand(s, b, to, err);
  const double *x = system->x + 3 * b->first_node;
  *p++ = (float)b->plan->nodes;
  for (size_t i = 0; i < 3 * b->plan->nodes; i++) *p++ = (float)x[i];
  *p++ = web ? 0 : SW_FRAME_VALUES;
  if (!web) sw_scene_node_values(s, w, b->plan->nodes, p);
  if (!web) p += SW_FRAME_VALUES * b->plan->nodes;
  *p++ = 0;
  *to = p;
  return SW_OK;
}

static sw_status fill(sw_scene *s, float *p, sw_error *err) {
  size_t w = 0;
  SW_TRY(fill_bodies(s, &p, err));
  for (size_t k = 0; k < sw_scene_bodies_made(s); k++) {
    if (w == sw_scene_wire_slots(s) || sw_scene_wire_in(s, w)->number != k) { /* it was removed */
      *p++ = 0, *p++ = 0, *p++ = 0;
      continue;
    }
    SW_TRY(fill_body(s, w++, &p, err));
  }
  return SW_OK;
}

static sw_status add_frame(sw_scene *s, sw_error *err) {
  sw_frames *all = sw_scene_frames_of(s);
  sw_frame f = {.time = sw_scene_time(s),
                .size = TOOL * sw_scene_tool_slots(s) +
                        HOLD * (sw_scene_obstacle_slots(s) + sw_scene_hold_slots(s)) +
                        NONE * (sw_scene_bodies_made(s) - sw_scene_wire_slots(s)),
                .wires = sw_scene_bodies_made(s),
                .obstacles = sw_scene_obstacle_slots(s),
                .holds = sw_scene_hold_slots(s),
                .tools = sw_scene_tool_slots(s)};
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++)
    f.size += size_of(sw_scene_system(s)->bodies[w].plan);
  if (SW_GROW(all->list, all->capacity, all->count + 1) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for frames");
  f.data = sw_alloc(f.size, sizeof *f.data);
  if (!f.data) return sw_fail(err, SW_ENOMEM, "out of memory for frames");
  sw_scene_frame_energies(s, f.energy);
  const sw_status status = fill(s, f.data, err);
  if (status != SW_OK) {
    sw_free(f.data);
    return status;
  }
  all->list[all->count++] = f;
  all->bytes += sw_frame_bytes(&f);
  return SW_OK;
}

sw_status sw_scene_frame_now(sw_scene *s, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  SW_TRY(sw_scene_still(s, err));
  SW_TRY(sw_scene_build(s, err));
  SW_TRY(sw_system_place_holds(system, sw_scene_time(s), NULL, NULL, NULL, err));
  sw_system_refresh(system);
  return add_frame(s, err);
}

sw_status sw_scene_close_frames(sw_scene *s, sw_error *err) {
  sw_frames *all = sw_scene_frames_of(s);
  if (!all->count || all->list[all->count - 1].time >= sw_scene_time(s)) return SW_OK;
  sw_scene_reopen_frames(s);
  SW_TRY(sw_scene_frame_now(s, err));
  all->list[all->count - 1].closing = 1;
  return SW_OK;
}

sw_status sw_scene_store_frame(sw_scene *s, sw_error *err) {
  sw_frames *all = sw_scene_frames_of(s);
  SW_TRY(add_frame(s, err));
  const sw_frame f = all->list[all->count - 1];
  if (all->count % 2 && all->count > LEAST && all->bytes + 2 * sw_frame_bytes(&f) > all->memory)
    thin(s);
  return SW_OK;
}
