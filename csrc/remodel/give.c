/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Condenses the deformed mesh into the give of a rod's grip where the wire leaves the pads.
 *
 * Between the pads sections are flat, and the surface that sticks to the pads shears. So the wire
 * yields more than it would from a clamp at the pads' face, and differently in each direction. To
 * measure this on each side, the mesh beyond some rings is moved as one rigid body in six ways
 * (three shifts, three turns); the rings inside follow between the pads' touches. The forces and
 * moments, with the motion of a ring in between, give the compliance of the cell from the pads to
 * that ring. A rod gets the same compliance when it is held further inside than the pads' face,
 * which lets it stretch more, and when its bending and twist begin further out. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/touching.h"
#include "grip/frozen.h"
#include "remodel/exchange.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "solve/dense.h"
#include "strand/ring.h"
#include "system/linear.h"
#include "system/system.h"

/* Rings outside the pads: the one that is read, the first one that is moved; number of ways [-]. */
enum { READ = 3, MOVED = 5, WAYS = 6 };
static const double MOST = 0.45; /* largest shift into the pads, over the pressed length [-] */

typedef struct cell {
  sw_scene *s;
  size_t wire;
  const sw_web *web;
  const double *x;       /* places of its particles [m] */
  size_t read[2];        /* ring that is read before and after the pads; a ring of the pads: none */
  size_t moved[2];       /* the same of the first ring that is moved */
  sw_vec across;         /* direction in which the pads close [-] */
  unsigned char *fixed;  /* (particles) [-] */
  double *motion, *push; /* (particles x 3) [m], [N] */
  double *inner;         /* (particles x 3) forces on each other at present [N] */
} cell;

/* Axes of a ring: along the wire, across it towards the pads, along the pads' faces. */
static void axes_of(const cell *c, size_t ring, sw_vec out[3]) {
  out[0] = sw_web_facing(c->web, c->x, ring);
  const sw_vec across = sw_madd(c->across, out[0], -sw_dot(c->across, out[0]));
  out[1] = sw_unit_or(across, sw_perpendicular(out[0]));
  out[2] = sw_cross(out[0], out[1]);
}

/* Moves the mesh from a ring on outwards in one of the ways: along an axis or about it. */
static void move_rigidly(const cell *c, int side, int way, const sw_vec axes[3], sw_vec middle) {
  const size_t from = side ? c->web->first[c->moved[1]] : 0;
  const size_t to = side ? c->web->particles : c->web->first[c->moved[0] + 1];
  memset(c->motion, 0, 3 * c->web->particles * sizeof *c->motion);
  for (size_t p = from; p < to; p++) {
    const sw_vec arm = sw_sub(sw_vec_at(c->x, p), middle);
    sw_store(c->motion + 3 * p, way < 3 ? axes[way] : sw_cross(axes[way - 3], arm));
  }
}

/* Returns the ring's turn about one of its axes by the motion: of its plane, or in it [rad]. */
static double turn_of(const cell *c, size_t ring, int axis, const sw_vec axes[3], sw_vec middle) {
  double sum = 0, second = 0;
  for (size_t p = c->web->first[ring]; p < c->web->first[ring + 1]; p++) {
    const sw_vec turned = sw_cross(axes[axis], sw_sub(sw_vec_at(c->x, p), middle));
    const sw_vec way = axis ? sw_scale(axes[0], sw_dot(axes[0], turned)) : turned;
    sum += sw_dot(sw_vec_at(c->motion, p), way);
    second += sw_norm2(way);
  }
  return sum / second;
}

/* Finds forces and moments on the cell (rows) for each way (columns), and the motion of the ring
 * that is read. */
static void try_ways(const cell *c, int side, double load[WAYS][WAYS], double motion[WAYS][WAYS]) {
  sw_vec axes[3];
  const size_t ring = c->read[side], from = c->web->first[c->moved[side]];
  const sw_vec middle = sw_web_centre(c->web, c->x, ring);
  axes_of(c, ring, axes);
  for (int way = 0; way < WAYS; way++) {
    sw_vec force = sw_v(0, 0, 0), moment = force;
    double along[3];
    move_rigidly(c, side, way, axes, middle);
    sw_system_carry(sw_scene_system(c->s), c->wire, c->fixed, c->motion, c->push);
    for (size_t p = from; p < c->web->first[c->moved[side] + 1]; p++) {
      const sw_vec f = sw_vec_at(c->push, p);
      force = sw_add(force, f);
      moment = sw_add(moment, sw_cross(sw_sub(sw_vec_at(c->x, p), middle), f));
    }
    sw_web_middle(c->web, c->motion, ring, along);
    for (int k = 0; k < 3; k++) {
      load[k][way] = sw_dot(force, axes[k]), load[3 + k][way] = sw_dot(moment, axes[k]);
      motion[k][way] = sw_dot(sw_load(along), axes[k]);
      motion[3 + k][way] = turn_of(c, ring, k, axes, middle);
    }
  }
}

/* out = b / a; returns 0 when a is singular. Solves row by row: a' out' = b'. */
static int divide(double b[WAYS][WAYS], double a[WAYS][WAYS], double out[WAYS][WAYS]) {
  for (int row = 0; row < WAYS; row++) {
    double turned[WAYS * WAYS];
    for (int i = 0; i < WAYS; i++)
      for (int j = 0; j < WAYS; j++) turned[WAYS * j + i] = a[i][j];
    memcpy(out[row], b[row], sizeof out[row]);
    if (!sw_dense_solve(turned, WAYS, out[row])) return 0;
  }
  return 1;
}

/* Force and moment of the part outside the ring that is read, about that ring's middle. */
static void load_of(const cell *c, int side, sw_vec middle, sw_vec *force, sw_vec *moment) {
  const size_t ring = c->read[side];
  const size_t from = side ? c->web->first[ring + 1] : 0;
  const size_t to = side ? c->web->particles : c->web->first[ring];
  *force = *moment = sw_v(0, 0, 0);
  for (size_t p = from; p < to; p++) {
    const sw_vec f = sw_vec_at(c->inner, p); /* of the cell on the outside */
    *force = sw_sub(*force, f);
    *moment = sw_sub(*moment, sw_cross(sw_sub(sw_vec_at(c->x, p), middle), f));
  }
}

enum { PARTS = 64 }; /* parts of the rod between the ring and its end [-] */

/* Finds where a rod must be held that lies at the ring that is read like the mesh, under the
 * present load. Follows the rod from the ring inwards to its end. The load stretches all of it, and
 * bends it over the length over which the rod bends. */
static void follow(const cell *c, int side, double length, sw_grip_end *out) {
  const sw_beam *beam = &sw_scene_system(c->s)->bodies[c->wire].plan->beam;
  const sw_clamp_give *give = &out->give;
  sw_vec axes[3], force, moment, at = sw_web_centre(c->web, c->x, c->read[side]);
  axes_of(c, c->read[side], axes);
  load_of(c, side, at, &force, &moment);
  const double part = length / PARTS, bends = length - fmax(0.0, give->shorter);
  sw_vec t = axes[0];
  out->turn = sw_dot(moment, t) * (length + give->twist) / beam->GJ;
  for (int k = 0; k < PARTS; k++) {
    const double l = fmin(part, fmax(0.0, bends - k * part));
    const sw_vec across = sw_madd(moment, t, -sw_dot(moment, t));
    const sw_quat back = sw_quat_exp(sw_scale(across, -0.5 * l / beam->EI));
    t = sw_rotate(back, t);
    const sw_vec inward = sw_scale(t, side ? -1.0 : 1.0);
    const sw_vec way = sw_scale(inward, part * (1.0 - sw_dot(force, inward) / beam->EA));
    at = sw_add(at, way);
    moment = sw_sub(moment, sw_cross(way, force));
    t = sw_rotate(back, t);
  }
  const sw_vec axis = sw_unit_or(sw_madd(give->axis, t, -sw_dot(give->axis, t)), axes[2]);
  const sw_vec across = sw_madd(moment, t, -sw_dot(moment, t));
  const sw_vec hinge = sw_madd(sw_scale(across, fmax(0.0, -give->shorter)), axis,
                               give->softer * sw_dot(moment, axis));
  const sw_quat back = sw_quat_exp(sw_scale(hinge, -1.0 / beam->EI));
  out->at = at;
  out->director = sw_rotate(back, t), out->give.axis = sw_rotate(back, axis);
}

/* Finds the rod's end from the compliance of one side. */
static void find_end(const cell *c, const sw_frozen *f, int side, double compliance[WAYS][WAYS],
                     sw_grip_end *out) {
  const sw_beam *beam = &sw_scene_system(c->s)->bodies[c->wire].plan->beam;
  const double face = f->stations.s[side ? f->last : f->first];
  const double way = fabs(f->stations.s[c->read[side]] - face);
  const double most = MOST * (f->stations.s[f->last] - f->stations.s[f->first]);
  const double stretch = compliance[0][0] * beam->EA - way;
  const double twist = compliance[3][3] * beam->GJ - way;
  const double bend[2] = {compliance[4][4] * beam->EI - way, compliance[5][5] * beam->EI - way};
  if (!isfinite(stretch + twist + bend[0] + bend[1])) return;
  const int soft = bend[1] > bend[0];
  const double inside = fmin(most, fmax(0.0, stretch));
  sw_vec axes[3];
  axes_of(c, c->read[side], axes);
  out->give = (sw_clamp_give){.shorter = inside - bend[!soft],
                              .softer = bend[soft] - bend[!soft],
                              .twist = twist - inside,
                              .axis = axes[1 + soft]};
  out->s = side ? face - inside : face + inside;
  out->ring = c->read[side];
  follow(c, side, way + inside, out);
}

static void find_side(const cell *c, const sw_frozen *f, int side, sw_grip_end *out) {
  double load[WAYS][WAYS], motion[WAYS][WAYS], compliance[WAYS][WAYS];
  try_ways(c, side, load, motion);
  if (divide(motion, load, compliance)) find_end(c, f, side, compliance, out);
}

/* Returns the ring `count` rings outside the pads, or fewer where the mesh ends. */
static size_t ring_outside(const sw_web *web, size_t face, int side, int count) {
  size_t ring = face;
  for (int k = 0; k < count; k++) {
    const size_t next = side ? ring + 1 : ring - 1;
    if (next >= web->rings || !sw_web_is_ring(web, next)) break; /* 0 - 1 wraps to above all */
    ring = next;
  }
  return ring;
}

static sw_status condense(sw_scene *s, const sw_tool *t, cell *c, const sw_frozen *f,
                          sw_grip_end ends[2], sw_error *err) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[f->wire.slot];
  const size_t face[2] = {f->first, f->last};
  size_t pads[SW_TOOL_PADS];
  for (size_t k = 0; k < t->pads; k++) pads[k] = t->pad[k].obstacle;
  for (int side = 0; side < 2; side++) {
    c->moved[side] = ring_outside(c->web, face[side], side, MOVED);
    c->read[side] = ring_outside(c->web, face[side], side, READ);
  }
  for (size_t p = 0; p < c->web->particles; p++) {
    const size_t r = sw_web_ring_of(c->web, p);
    const int before = c->moved[0] < f->first && r <= c->moved[0];
    const int after = c->moved[1] > f->last && r >= c->moved[1];
    c->fixed[p] = before || after || b->plan->held[p] != SW_FREE;
  }
  SW_TRY(sw_system_inner_forces(system, c->wire, c->inner, err));
  SW_TRY(sw_scene_linearise(s, pads, t->pads, err));
  SW_TRY(sw_system_fix_particles(system, c->wire, c->fixed));
  for (int side = 0; side < 2; side++)
    if (c->moved[side] != face[side]) find_side(c, f, side, &ends[side]);
  return SW_OK;
}

/* Sets the end at the pads' face, where the mesh lies. It stays there for a wire that ends between
 * the pads. */
static void rigid_end(const cell *c, const sw_frozen *f, int side, sw_grip_end *out) {
  const size_t ring = side ? f->last : f->first;
  *out = (sw_grip_end){.s = f->stations.s[ring],
                       .at = sw_web_centre(c->web, c->x, ring),
                       .director = sw_load(f->frame + 6 * ring),
                       .ring = ring};
}

sw_status sw_frozen_condense(sw_scene *s, const sw_tool *t, sw_frozen *f, sw_grip_end ends[2],
                             sw_error *err) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[f->wire.slot];
  const size_t n = b->plan->web->particles;
  double *room SW_LOCAL = sw_alloc(9 * n, sizeof *room);
  unsigned char *fixed SW_LOCAL = sw_alloc(n, 1);
  if (!room || !fixed) return SW_ENOMEM;
  f->across = sw_unit_or(sw_scene_obstacle_in(s, t->pad[0].obstacle)->drive.opens, sw_v(0, 1, 0));
  cell c = {.s = s, .wire = f->wire.slot, .web = b->plan->web, .fixed = fixed};
  c.across = sw_rotate(f->pose.q, f->across);
  c.x = system->x + 3 * b->first_node;
  c.motion = room, c.push = room + 3 * n, c.inner = room + 6 * n;
  for (int side = 0; side < 2; side++) rigid_end(&c, f, side, &ends[side]);
  return condense(s, t, &c, f, ends, err);
}
