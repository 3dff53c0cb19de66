/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Margin of a rigid grip: its load over the load that its pads could bear.
 *
 * A touch of the pads stays where it was when the grip was frozen. It can bear friction up to mu N.
 * Its normal force N can change to any value from 0 to 2 N, because a moment towards the pads moves
 * force from one edge to the other. The forces and moments that such touches can balance form a
 * convex set. The margin is the load over the largest load of the same direction in that set. By
 * the kinematic theorem of limit analysis it is the maximum, over all rigid motions of the wire
 * between the pads, of the load's power over the power that the touches can resist
 *
 *     sum_i N_i (mu_i |tangential velocity| + |normal velocity|).
 *
 * Pads that squeeze have the normal forces that they have. The load is then the touches' own
 * friction, and they resist sum_i mu_i N_i |velocity|. So the margin is 1 at most, and it is 1 if
 * all touches slide as a rigid wire does. Without a moment it is |sum of friction| / sum mu N.
 *
 * Friction of a rod acts at its axis. Turning about the axis moves such touches by nothing but the
 * nanometres that they lie off one line, and power over resistance would be that of two roundings.
 * Such a turn w slides the wire's surface by r w, so this counts as velocity too.
 *
 * For motions in the pads' plane this is the limit surface of Goyal, Ruina and Papadopoulos (Wear
 * 143, 1991, 307), which Howe and Cutkosky's ellipsoid (1996) approximates. The best motion is
 * found by iterated least squares: the weights come from the previous motion, and the value only
 * grows. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "grip/frozen.h"
#include "scene/drive.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "solve/dense.h"
#include "strand/ring.h"

enum { SIX = 6, MOST_ROUNDS = 20 };
static const double ENOUGH = 1e-4; /* relative growth of the margin that ends the search [-] */
static const double STILL = 1e-6;  /* velocity that counts as zero, over the motion's [-] */

/* A touching particle may lie inside a pad. The pad's normal is taken at a place moved by this
 * share of the wire's radius towards the middle of the section, which is safely outside [-]. */
static const double INSIDE = 0.2;

static sw_vec inside(const sw_scene *s, size_t wire, const sw_contact_push *p) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const sw_web *web = b->plan->web;
  const double *x = system->x + 3 * b->first_node;
  const sw_vec one = sw_vec_at(system->x, p->node), two = sw_vec_at(system->x, p->other);
  const sw_vec at = sw_lerp(one, two, p->node == p->other ? 0.0 : p->at);
  const sw_vec middle = sw_web_centre(web, x, sw_web_ring_of(web, p->node - b->first_node));
  const sw_vec in = sw_unit_or(sw_sub(middle, at), sw_v(0, 0, 0));
  return sw_madd(at, in, INSIDE * b->plan->beam.radius);
}

sw_status sw_frozen_keep_touches(sw_scene *s, const sw_tool *t, sw_frozen *f, sw_error *err) {
  const size_t count = sw_scene_contact(s) ? sw_contact_touches(sw_scene_contact(s)) : 0;
  f->touch = sw_alloc(count, sizeof *f->touch);
  if (!f->touch) return SW_ENOMEM;
  for (size_t k = 0; k < count; k++) {
    sw_contact_push p;
    sw_motion_state at;
    sw_closest near;
    if (!sw_contact_push_at(sw_scene_contact(s), sw_scene_system(s), k, &p) ||
        !sw_tool_is_pad(t, p.obstacle))
      continue;
    if (p.node < f->node || p.node >= f->node + f->nodes) continue;
    const sw_scene_obstacle *o = sw_scene_obstacle_in(s, p.obstacle);
    SW_TRY(sw_drive_eval(s, &o->drive, sw_scene_time(s), &at, err));
    const sw_vec place = sw_pose_local(at.pose, inside(s, f->wire.slot, &p));
    if (!sw_shape_point(o->shape, place, HUGE_VAL, &near)) continue;
    f->touch[f->touches++] =
        (sw_frozen_touch){.at = sw_pose_local(f->pose, p.point),
                          .normal = sw_unrotate(f->pose.q, sw_rotate(at.pose.q, near.normal)),
                          .force = p.normal_force,
                          .friction = o->friction};
  }
  return SW_OK;
}

/* Force-weighted middle and radius of the touches, and the force and moment about the middle of the
 * normal forces alone. */
typedef struct patch {
  sw_vec middle, force, moment; /* [m], [N], [N m] */
  double size;                  /* [m] */
} patch;

static patch patch_of(const sw_frozen_touch *touch, size_t touches) {
  patch out = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0};
  double sum = 0, second = 0;
  for (size_t k = 0; k < touches; k++) {
    out.middle = sw_madd(out.middle, touch[k].at, touch[k].force);
    sum += touch[k].force;
  }
  out.middle = sw_scale(out.middle, 1.0 / sum);
  for (size_t k = 0; k < touches; k++) {
    const sw_vec arm = sw_sub(touch[k].at, out.middle);
    const sw_vec push = sw_scale(touch[k].normal, touch[k].force);
    out.force = sw_add(out.force, push);
    out.moment = sw_add(out.moment, sw_cross(arm, push));
    second += touch[k].force * sw_norm2(arm);
  }
  out.size = sqrt(second / sum);
  return out;
}

/* Sums over the touches for the quadratic form. sum, arm, second: of weights equal in all
 * directions; A: of the extra weights across the surfaces, until close_form adds the others. */
typedef struct form {
  double A[SIX][SIX];
  double sum, arm[3], second[SIX]; /* second: xx xy xz yy yz zz */
} form;

/* Adds a touch with weight `all` in every direction and `more` in addition across its surface. */
static void add(form *o, sw_vec arm, sw_vec normal, double all, double more) {
  double g[SIX];
  sw_store(g, normal);
  sw_store(g + 3, sw_cross(arm, normal));
  for (int i = 0; i < SIX; i++) {
    const double scaled = more * g[i];
    for (int j = 0; j <= i; j++) o->A[i][j] += scaled * g[j];
  }
  const double x = all * arm.x, y = all * arm.y, z = all * arm.z;
  o->sum += all, o->arm[0] += x, o->arm[1] += y, o->arm[2] += z;
  o->second[0] += x * arm.x, o->second[1] += x * arm.y, o->second[2] += x * arm.z;
  o->second[3] += y * arm.y, o->second[4] += y * arm.z, o->second[5] += z * arm.z;
}

/* Completes the lower half of the matrix; velocities are v + turn x arm and, across it, turn .
 * axle. */
static void close_form(form *o, sw_vec axle) {
  const double *p = o->arm, *q = o->second;
  double roll[3];
  sw_store(roll, axle);
  const double turns[3][3] = {
      {q[3] + q[5], 0, 0}, {-q[1], q[0] + q[5], 0}, {-q[2], -q[4], q[0] + q[3]}};
  const double mixed[3][3] = {{0, -p[2], p[1]}, {p[2], 0, -p[0]}, {-p[1], p[0], 0}};
  for (int i = 0; i < 3; i++) {
    o->A[i][i] += o->sum;
    for (int j = 0; j < 3; j++) o->A[3 + i][j] += mixed[i][j];
    for (int j = 0; j <= i; j++) o->A[3 + i][3 + j] += turns[i][j] + o->sum * roll[i] * roll[j];
  }
}

/* Touches, in units of `size` from their middle. fixed: 1 = each keeps its normal force. */
typedef struct hold {
  const sw_frozen_touch *touch;
  size_t touches;
  sw_vec middle; /* [m] */
  sw_vec axle;   /* along the wire, as long as the lever of its surface; 0: touches lie there */
  double size;   /* [m] */
  int fixed;
} hold;

/* Returns the power that the touches resist in a motion [W]. A: its quadratic form, with that
 * motion's weights. */
static double resistance(const hold *h, const double v[SIX], double A[SIX][SIX]) {
  form o = {0};
  double sum = 0;
  const sw_vec way = sw_load(v), turn = sw_load(v + 3);
  const double still = STILL * (sw_norm(way) + sw_norm(turn)), roll = sw_dot(turn, h->axle);
  SW_ITEMS(const sw_frozen_touch, t, h->touch, h->touches) {
    const sw_vec arm = sw_scale(sw_sub(t->at, h->middle), 1.0 / h->size);
    const sw_vec u = sw_add(way, sw_cross(turn, arm));
    const double across = h->fixed ? 0.0 : sw_dot(u, t->normal);
    const double along = hypot(sw_norm(sw_madd(u, t->normal, -across)), roll);
    const double rub = t->friction * t->force / fmax(along, still);
    sum += t->force * (t->friction * along + fabs(across));
    add(&o, arm, t->normal, rub, h->fixed ? 0.0 : t->force / fmax(fabs(across), still) - rub);
  }
  close_form(&o, h->axle);
  memcpy(A, o.A, sizeof o.A);
  return sum;
}

/* Turns that move no touch, such as those of a line about itself, cost and yield nothing. This
 * share of the others makes them solvable [-]. */
static const double IDLE = 1e-9;

static void stiffen(double A[SIX][SIX]) {
  double trace = 0;
  for (int i = 0; i < SIX; i++) trace += A[i][i];
  for (int i = 0; i < SIX; i++) A[i][i] += IDLE * trace;
}

/* Returns the load over the largest one of its direction. load: force, and moment about the middle
 * over the size [N]. */
static double search(const hold *h, const double load[SIX]) {
  double A[SIX][SIX], v[SIX], margin = 0;
  memcpy(v, load, sizeof v);
  for (int round = 0; round <= MOST_ROUNDS; round++) {
    double power = 0;
    const double most = resistance(h, v, A);
    for (int i = 0; i < SIX; i++) power += load[i] * v[i];
    const double now = most > 0 ? power / most : 0.0;
    if (round && now <= margin * (1.0 + ENOUGH)) return fmax(now, margin);
    margin = fmax(margin, now);
    memcpy(v, load, sizeof v);
    if (h->fixed) stiffen(A);
    if (!sw_cholesky_solve(&A[0][0], SIX, v)) return margin;
  }
  return margin;
}

double sw_frozen_margin(const sw_frozen *f, sw_vec force, sw_vec moment) {
  double load[SIX];
  if (!f->touches) return 0;
  const patch p = patch_of(f->touch, f->touches);
  if (!(p.size > 0)) return 0;
  const hold h = {f->touch, f->touches, p.middle, {0, 0, 0}, p.size, 0};
  const sw_vec about = sw_sub(moment, sw_cross(p.middle, force));
  sw_store(load, sw_sub(force, p.force));
  sw_store(load + 3, sw_scale(sw_sub(about, p.moment), 1.0 / p.size));
  return search(&h, load);
}

/* Touches of a rod closer than this share of its lever are at one place: their moment about their
 * middle is rounding [-]. */
static const double POINT = 1e-6;

/* A load below this share of what friction can bear is rounding: the turn that yields most is then
 * one that moves no touch, and the margin would be the ratio of two roundings. It is that of double
 * precision over IDLE [-]. */
static const double NOTHING = 1e-7;

double sw_touches_margin(const sw_frozen_touch *touch, size_t touches, sw_vec axle, sw_vec force,
                         sw_vec moment) {
  double load[SIX], most = 0;
  for (size_t k = 0; k < touches; k++) most += touch[k].friction * touch[k].force;
  if (!(most > 0)) return 0;
  const double straight = sw_norm(force) / most; /* of pure sliding: exact, and no search */
  const patch p = patch_of(touch, touches);
  if (!(p.size > POINT * sw_norm(axle))) return straight;
  const hold h = {touch, touches, p.middle, sw_scale(axle, 1.0 / p.size), p.size, 1};
  const sw_vec about = sw_sub(moment, sw_cross(p.middle, force));
  sw_store(load, force);
  sw_store(load + 3, sw_scale(about, 1.0 / p.size));
  if (!(hypot(sw_norm(force), sw_norm(about) / p.size) > NOTHING * most)) return straight;
  return fmin(1.0, fmax(straight, search(&h, load)));
}
