/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A guide through which the wire slides along its axis: held there like a clamp, exactly at the
 * guide, while wire is paid out of a spool behind it or drawn in. In mid-wire it passes wire from
 * one side to the other.
 *
 * The node stays in the guide and its arc length changes with time, in every stage of every
 * integrator, so that the first edge grows or shrinks smoothly while all other nodes keep to their
 * material. The wire's velocity at the guide is that of the guide and the feeding speed along it.
 * Nodes are inserted and removed between steps (body/guide.c). */
#include <math.h>

#include "link/feeding.h"
#include "link/hold.h"
#include "link/spool.h"
#include "state/hinge.h"
#include "state/state_tape.h"

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, s),
     "arc length at the guide: 0 or the wire's length with a spool behind it"},
    {"direction", SW_PARAM_VECTOR, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_hold_args, direction),
     "where the guide points, the way of the wire that is paid out (default: the wire's own)"},
    {"speed", SW_PARAM_NUMBER, "m/s", NAN, -1e4, 1e4, 0, NULL, offsetof(sw_hold_args, speed),
     "wire paid out per time, unstressed; negative draws it in (default 0, without force)"},
    {"force", SW_PARAM_NUMBER, "N", NAN, -1e9, 1e9, 0, NULL, offsetof(sw_hold_args, force),
     "pushes the wire out with this force instead of a speed; negative: a pull against it"},
    {"force_limit", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_hold_args, force_limit),
     "the wire slips through where holding its speed would take more (default: never)"},
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_hold_args, name),
     "name used in messages and series"},
};

static const double AT_END = 1e-9; /* of the wire's length: rounding [-] */

/* --- what it holds ---------------------------------------------------------------- */

/* Which way wire goes that is paid out at arc length s of the mesh: see sw_feed. */
static int outward(const sw_mesh *m, double s) {
  const double end = m->s[m->n - 1];
  return s >= end - AT_END * (end - m->s[0]) ? -1 : 1;
}

static sw_status check(const sw_link_wire *w, sw_hold_args *a, sw_error *err) {
  if (isfinite(a->speed) && isfinite(a->force))
    return sw_fail(err, SW_EINVAL, "feed: give speed or force, not both; the other one follows");
  if (outward(w->mesh, a->s) < 0) a->direction = sw_neg(a->direction); /* it points outwards */
  return SW_OK;
}

static sw_status begin(sw_hold *h, const sw_link_wire *w) {
  const sw_mesh *m = w->mesh;
  const sw_hold_args *a = &h->args;
  h->feed = (sw_feed){.outward = outward(m, h->s1),
                      .label = h->s1,
                      .since = w->time,
                      .speed = isnan(a->speed) ? 0 : a->speed,
                      .slip_since = w->time,
                      .push = a->force,
                      .limit = a->force_limit,
                      .size = (m->s[m->n - 1] - m->s[0]) / (double)(m->n - 1)};
  return m->rest ? sw_mesh_copy(m, &h->feed.shape) : SW_OK;
}

static void clear(sw_hold *h) {
  sw_motion_release(h->feed.motion);
  sw_mesh_free(&h->feed.shape);
}

sw_feed_now sw_feed_at(const sw_hold *h, double t) {
  const sw_feed *f = &h->feed;
  const double u = t - f->slip_since;
  sw_feed_now now = {.fed = f->fed + f->slip,
                     .speed = f->speed + f->slip_speed + f->slip_growth * u,
                     .acceleration = f->slip_growth};
  now.fed += f->speed * (t - f->since) + (f->slip_speed + 0.5 * f->slip_growth * u) * u;
  if (f->motion) {
    sw_motion_state m;
    sw_error ignored; /* a motion between two points calls no function */
    if (sw_motion_eval(f->motion, t - f->start, &m, &ignored) != SW_OK) return now;
    now.fed += m.pose.p.x;
    now.speed += m.v.x;
    now.acceleration += m.a.x;
  }
  return now;
}

static double arc_at(const sw_feed *f, double fed) { return f->label - f->outward * fed; }

void sw_feed_spare(const sw_feed *f, double fed, double spare[2]) {
  for (int k = 0; k < 2; k++)
    spare[k] = f->spare[k] * fmax(0, 1 - fabs(fed - f->spare_fed[k]) / f->size);
}

/* What the hold knows of the unloaded frame at arc length s of the mesh. */
static void set_rest(sw_hold *h, double s) {
  const sw_quat q = sw_spool_at(&h->feed.shape, s).q;
  for (int side = 0; side < 2; side++) {
    h->frame[side].rest_tangent = sw_spool_tangent(q);
    h->frame[side].rest_normal = sw_spool_normal(q);
  }
}

/* Unloaded place and frame of the node at the guide, for its present arc length. */
static void reshape(sw_hold *h, const sw_link_wire *w, const sw_plan *p) {
  sw_mesh *m = w->mesh;
  const double kept = m->s[h->node];
  if (!m->rest) return;
  m->s[h->node] = p->s[h->node];
  sw_spool_node(m, &h->feed.shape, h->node);
  m->s[h->node] = kept;
  set_rest(h, p->s[h->node]);
  w->reshaped(w->user, w->body, h->node);
}

/* The plan for a length fed. */
static void slide(sw_hold *h, const sw_link_wire *w, double arc, double fed) {
  sw_plan *p = w->system->bodies[w->body].plan;
  const size_t node = h->node;
  double spare[2];
  sw_feed_spare(&h->feed, fed, spare);
  const int same = p->s[node] == arc;
  if (same && (node == 0 || p->rest[node - 1] == arc - p->s[node - 1] + spare[0]) &&
      (node == p->edges || p->rest[node] == p->s[node + 1] - arc + spare[1]))
    return;
  sw_plan_slide(p, node, arc, spare);
  if (!same) reshape(h, w, p);
}

static void place(sw_hold *h, const sw_link_wire *w, double t, sw_hold_state *state) {
  const sw_feed *f = &h->feed;
  const sw_feed_now now = sw_feed_at(h, t);
  slide(h, w, arc_at(f, now.fed), now.fed);
  const sw_vec along = sw_scale(sw_rotate(state->pose.q, h->director[1]), f->outward);
  state->v = sw_madd(state->v, along, now.speed);
  state->a = sw_madd(state->a, along, now.acceleration);
  state->a = sw_madd(state->a, sw_cross(state->omega, along), 2.0 * now.speed);
}

static int follow(sw_hold *h, const sw_link_wire *w) {
  sw_feed *f = &h->feed;
  const double u = w->time - f->slip_since;
  f->slip += (f->slip_speed + 0.5 * f->slip_growth * u) * u;
  f->slip_speed += f->slip_growth * u;
  f->slip_since = w->time;
  const double arc = arc_at(f, sw_feed_at(h, w->time).fed);
  w->mesh->s[h->node] = arc;
  h->s1 = h->s2 = h->s[0] = arc;
  return 0;
}

static void undo(sw_hold *h, const sw_link_wire *w) {
  slide(h, w, h->s1, (h->feed.label - h->s1) * h->feed.outward);
}

/* --- forces ----------------------------------------------------------------------- */

/* Curvature where the wire leaves the guide on the clamp's side, squared and times EI. In a wire
 * with frames this is its curvature at rest plus the bending. */
static double bent(const sw_system *s, const sw_body *b, size_t clamp, const double *x) {
  const sw_plan *p = b->plan;
  const sw_clamp_hinge *c = &p->clamps[clamp];
  const size_t at = 2 * (size_t)c->hold + (c->side > 0 ? 1 : 0), number = p->nodes + clamp;
  const double *edge = x + 3 * (b->first_node + c->edge);
  const sw_vec d = sw_vec_at(s->directors_now, at);
  const sw_vec t = sw_unit_or(sw_sub(sw_load(edge + 3), sw_load(edge)), d);
  if (!b->spin_block) {
    const double curvature = 2.0 * asin(fmin(1.0, 0.5 * sw_dist(d, t))) / c->length;
    return p->beam.EI * curvature * curvature;
  }
  const sw_edge_frame held = {d, sw_vec_at(s->normals_now, at)};
  const double *const *n = b->field.normals;
  const sw_edge_frame own = {t, sw_v(n[0][c->edge], n[1][c->edge], n[2][c->edge])};
  double bend[2], sum = 0;
  sw_hinge_bend(c->side > 0 ? &held : &own, c->side > 0 ? &own : &held,
                b->field.hinge_twist[number], bend);
  for (int k = 0; k < 2; k++) {
    const double rest = p->rest_bend[2 * number + k];
    const double curvature = (bend[k] - rest) / c->length + 2.0 * rest / p->rest[c->edge];
    sum += p->beam.EI_axis[k] * curvature * curvature;
  }
  return sum;
}

/* The same of its twist, times GJ. */
static double twisted(const sw_system *s, const sw_body *b, size_t clamp) {
  const sw_plan *p = b->plan;
  if (b->spin_block) {
    const double rest = p->rest_twist[p->nodes + clamp];
    const double strain = (b->field.hinge_twist[p->nodes + clamp] - rest) / p->clamps[clamp].length;
    const double twist = strain + 2.0 * rest / p->rest[p->clamps[clamp].edge];
    return p->beam.GJ * twist * twist;
  }
  for (size_t k = 0; b->has_twist && k < p->span_count; k++) {
    if (p->spans[k].left != clamp && p->spans[k].right != clamp) continue;
    const double twist = s->twist[b->first_span + k] / p->spans[k].length;
    return p->beam.GJ * twist * twist;
  }
  return 0;
}

/* The guide's walls bear a force along the wire too: where it leaves them bent, each length
 * that is paid out takes up the energy of the bend at the drive's cost, and the walls push the
 * wire out with EI curvature^2 / 2 (Bigoni et al. 2015). The drive bears the rest. */
static double drive(const sw_hold *h, const sw_link_wire *w, const double *x) {
  const sw_system *y = w->system;
  const sw_body *b = &y->bodies[w->body];
  const int number = (int)h->number;
  double sum = 0;
  for (size_t i = 0; i < y->held_count; i++)
    if (y->held[i].hold == number)
      sum += sw_dot(y->held[i].reaction, sw_load(y->directors_now + 3 * (2 * h->number + 1)));
  sum *= h->feed.outward;
  for (size_t c = 0; c < b->plan->clamp_count; c++) {
    if (b->plan->clamps[c].hold != number) continue;
    const int grows = b->plan->clamps[c].side * h->feed.outward;
    sum -= 0.5 * grows * (bent(y, b, c, x) + twisted(y, b, c));
  }
  return sum;
}

static sw_hold_way passes(const sw_hold *h, const sw_link_wire *w, double t, const double *x) {
  const sw_feed_now now = sw_feed_at(h, t);
  return (sw_hold_way){now.fed, now.speed, x ? drive(h, w, x) : 0.0};
}

/* --- what is asked of it ------------------------------------------------------------ */

/* It stops where it is at time t; what follows starts from then. */
static void stop(sw_hold *h, double t) {
  sw_feed *f = &h->feed;
  f->fed = sw_feed_at(h, t).fed - f->slip;
  f->since = t;
  f->speed = f->slip_speed = f->slip_growth = f->slip_way = 0;
  f->push = NAN;
  sw_motion_release(f->motion);
  f->motion = NULL;
}

static sw_status go(sw_hold *h, const sw_link_wire *w, double speed, sw_motion *motion,
                    sw_error *err) {
  (void)motion, (void)err;
  stop(h, w->time);
  h->feed.speed = speed;
  return SW_OK;
}

static sw_status push(sw_hold *h, const sw_link_wire *w, double force, sw_motion *motion,
                      sw_error *err) {
  const double speed = sw_feed_at(h, w->time).speed;
  (void)motion, (void)err;
  stop(h, w->time);
  h->feed.push = force, h->feed.slip_speed = speed;
  return SW_OK;
}

static sw_status limit(sw_hold *h, const sw_link_wire *w, double force, sw_motion *motion,
                       sw_error *err) {
  (void)w, (void)motion, (void)err;
  h->feed.limit = force;
  if (isnan(force) && isnan(h->feed.push))
    h->feed.slip_speed = h->feed.slip_growth = h->feed.slip_way = 0;
  return SW_OK;
}

/* Wire on the side of the guide from which this length would come; a spool has no end [m]. */
static double reserve(const sw_hold *h, const sw_mesh *m, double length) {
  const int from_far = length * h->feed.outward < 0;
  const int is_end = from_far ? h->s1 >= m->s[m->n - 1] : h->s1 <= m->s[0];
  if (is_end) return HUGE_VAL;
  return from_far ? m->s[m->n - 1] - h->s1 : h->s1 - m->s[0];
}

static sw_status pay_out(sw_hold *h, const sw_link_wire *w, double length, sw_motion *motion,
                         sw_error *err) {
  const double there = reserve(h, w->mesh, length);
  if (!(fabs(length) < there))
    return sw_fail(err, SW_EINVAL,
                   "feed '%s': length = %g m is not allowed; %.6g m of wire '%s' are there",
                   h->name, length, there, w->name);
  stop(h, w->time);
  h->feed.motion = sw_motion_retain(motion), h->feed.start = w->time;
  return SW_OK;
}

/* Wire paid out per time; a force that pushes it out; the force beyond which it slips, NAN: none; a
 * length, as the motion's x [m/s], [N], [N], [m]. */
static const sw_hold_order orders[] = {
    {"speed", 1, go}, {"push", 1, push}, {"force_limit", 0, limit}, {"length", 1, pay_out}, {0}};

static const char *const outputs[] = {"fed", "speed", "drive_force", "force_limit", NULL};

/* Paid out so far, speed, force that moves the wire outwards (the guide's walls bear the rest), its
 * limit or NAN [m], [m/s], [N], [N]. */
static void read(const sw_hold *h, double t, double *out) {
  const sw_feed_now now = sw_feed_at(h, t);
  out[0] = now.fed, out[1] = now.speed, out[2] = h->feed.drive, out[3] = h->feed.limit;
}

/* --- on a tape --------------------------------------------------------------------- */

#define DOUBLE(field) sw_tape_double(t, &x->field)

void sw_tape_feed(sw_tape *t, sw_feed *x) {
  int shaped = x->shape.n > 0;
  SW_TAPE_STRUCT(t, sw_feed, 368);
  sw_tape_int(t, &x->outward), DOUBLE(label), DOUBLE(fed), DOUBLE(since), DOUBLE(speed),
      DOUBLE(start);
  sw_tape_motion(t, &x->motion);
  DOUBLE(slip), DOUBLE(slip_since), DOUBLE(slip_speed), DOUBLE(slip_growth), DOUBLE(slip_before);
  DOUBLE(push), DOUBLE(limit), DOUBLE(slip_way), DOUBLE(way_before);
  sw_tape_bracket(t, &x->found, "a feed");
  DOUBLE(slope), DOUBLE(spare[0]), DOUBLE(spare[1]), DOUBLE(spare_fed[0]), DOUBLE(spare_fed[1]);
  DOUBLE(size), DOUBLE(drive);
  sw_tape_int(t, &shaped);
  if (shaped) sw_tape_mesh(t, &x->shape, 1);
  if (!sw_tape_reads(t)) return;
  const double all = x->label + x->fed + x->since + x->speed + x->start + x->slip + x->slip_since +
                     x->slip_speed + x->slip_growth + x->slip_before + x->slope + x->size;
  sw_tape_expect(t, isfinite(all + x->spare[0] + x->spare[1]), "a feed");
}

/* Of a hold at rest: is what came from a tape a feed of the wire? */
static int fits(const sw_hold *h, const sw_link_wire *w) {
  const sw_feed *f = &h->feed;
  return h->s1 == h->s2 && h->count == 1 && f->size > 0 && (f->outward == 1 || f->outward == -1) &&
         (w->mesh->rest != NULL) == (f->shape.rest != NULL);
}

static const sw_hold_acts acts = {.orders = orders,
                                  .outputs = outputs,
                                  .read = read,
                                  .direction = 1,
                                  .lines = 1,
                                  .check = check,
                                  .begin = begin,
                                  .clear = clear,
                                  .place = place,
                                  .follow = follow,
                                  .undo = undo,
                                  .passes = passes,
                                  .fits = fits};

const sw_link_class sw_link_feed = {
    .name = "feed",
    .summary = "holds like a clamp while wire slides through",
    .params = SW_PARAMS("feed", rows),
    .hold = &acts,
};
