/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A guide through which the wire slides along its axis. The wire is held exactly at the guide, like
 * in a clamp, while it is paid out of a spool behind the guide or drawn in. In mid-wire the guide
 * passes wire from one side to the other.
 *
 * The node stays in the guide, and its arc length changes with time in every stage of every
 * integrator. So the first edge grows or shrinks smoothly, and all other nodes keep to their
 * material. The wire's velocity at the guide is the guide's velocity plus the feeding speed along
 * the guide. Nodes are inserted and removed between steps (body/guide.c). */
#include <math.h>

#include "link/feed_drive.h"
#include "link/feeding.h"
#include "link/hold.h"
#include "link/spool.h"
#include "system/axial.h"
#include "system/system.h"

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", 0, 0, HUGE_VAL, 0, NULL, offsetof(sw_hold_args, s),
     "arc length at the guide: 0 or the wire's length with a spool behind it"},
    {"direction", SW_PARAM_VECTOR, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_hold_args, direction),
     "direction of the wire that is paid out at the guide (default: the wire's own)"},
    {"speed", SW_PARAM_NUMBER, "m/s", NAN, -1e4, 1e4, 0, NULL, offsetof(sw_hold_args, speed),
     "unstressed wire paid out per time; below 0 draws it in (default 0, without force)"},
    {"force", SW_PARAM_NUMBER, "N", NAN, -1e9, 1e9, 0, NULL, offsetof(sw_hold_args, force),
     "pushes the wire out with this force instead of a speed; below 0: a pull inwards"},
    {"force_limit", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_hold_args, force_limit),
     "the wire slips if its speed would need a larger force (default: never)"},
    SW_NAME_ROW(sw_hold_args),
};

static const double AT_END = 1e-9; /* of the wire's length, for rounding [-] */
/* A jump of the speed is made at once if the force limit needs less than this time for it [s]. */
static const double AT_ONCE = 1e-3;

/* --- held nodes ------------------------------------------------------------------- */

/* Returns the direction of wire paid out at arc length s of the mesh, see sw_guide. */
static int outward(const sw_mesh *m, double s) {
  const double end = m->s[m->n - 1];
  return s >= end - AT_END * (end - m->s[0]) ? -1 : 1;
}

static sw_status check(const sw_link_wire *w, sw_hold_args *a, sw_error *err) {
  if (isfinite(a->speed) && isfinite(a->force))
    return sw_fail(err, SW_EINVAL, "feed: give speed or force, not both; the run finds the other");
  if (outward(w->mesh, a->s) < 0) a->direction = sw_neg(a->direction); /* it must point outwards */
  return SW_OK;
}

/* Length paid out at a time, with speed and acceleration. */
typedef struct feed_now {
  double fed, speed, acceleration; /* [m], [m/s], [m/s2] */
} feed_now;

/* Returns the slipped length, beyond the fed one [m]. */
static double slipped(const sw_slip *slip, double t) {
  const double u = t - slip->since;
  return slip->length + (slip->speed + 0.5 * slip->growth * u) * u;
}

static feed_now feed_at(const sw_hold *h, double t) {
  const sw_feed *f = &h->feed;
  const sw_slip *slip = &f->slip;
  feed_now now = {.fed = f->fed + slipped(slip, t) + f->speed * (t - f->since),
                  .speed = f->speed + slip->speed + slip->growth * (t - slip->since),
                  .acceleration = slip->growth};
  if (f->motion) {
    sw_motion_state m;
    sw_error ignored; /* a motion between two points calls no function */
    if (sw_motion_eval(f->motion, t - f->start, &m, &ignored) != SW_OK) return now;
    now.fed += m.pose.p.x, now.speed += m.v.x, now.acceleration += m.a.x;
  }
  return now;
}

/* The asked speed has jumped, and a drive with a limit may not be able to follow: the wire then
 * keeps its speed and slips. */
static void keep_speed(sw_hold *h, const sw_link_wire *w, double kept) {
  sw_slip *slip = &h->feed.slip;
  const sw_mesh *m = w->mesh;
  const double jump = kept - feed_at(h, w->time).speed;
  const double momentum = fabs(jump) * w->beam->mass * (m->s[m->n - 1] - m->s[0]);
  if (!isfinite(slip->limit) || momentum <= slip->limit * AT_ONCE) return;
  slip->speed = jump;
  slip->way = copysign(1.0, -jump);
  sw_slip_taken(slip);
}

static sw_status begin(sw_hold *h, const sw_link_wire *w) {
  const sw_mesh *m = w->mesh;
  const sw_hold_args *a = &h->args;
  const double size = (m->s[m->n - 1] - m->s[0]) / (double)(m->n - 1);
  h->feed = (sw_feed){.guide = {.outward = outward(m, h->s1), .label = h->s1, .size = size},
                      .slip = {.push = a->force, .limit = a->force_limit, .since = w->time},
                      .since = w->time,
                      .speed = isnan(a->speed) ? 0 : a->speed};
  keep_speed(h, w, 0);
  return m->rest ? sw_mesh_copy(m, &h->feed.guide.shape) : SW_OK;
}

static void clear(sw_hold *h) {
  sw_motion_release(h->feed.motion);
  sw_mesh_free(&h->feed.guide.shape);
}

static double arc_at(const sw_guide *g, double fed) { return g->label - g->outward * fed; }

void sw_guide_spare(const sw_guide *g, double fed, double spare[2]) {
  for (int k = 0; k < 2; k++)
    spare[k] = g->spare[k] * fmax(0, 1 - fabs(fed - g->spare_fed[k]) / g->size);
}

/* Sets the hold's unloaded frames to those at arc length s of the mesh. */
static void set_rest(sw_hold *h, double s) {
  const sw_quat q = sw_spool_at(&h->feed.guide.shape, s).q;
  for (int side = 0; side < 2; side++) {
    h->frame[side].rest_tangent = sw_spool_tangent(q);
    h->frame[side].rest_normal = sw_spool_normal(q);
  }
}

/* Sets the unloaded place and frame of the guide's node for its present arc length. */
static void reshape(sw_hold *h, const sw_link_wire *w, const sw_plan *p) {
  sw_mesh *m = w->mesh;
  const double kept = m->s[h->node];
  if (!m->rest) return;
  m->s[h->node] = p->s[h->node];
  sw_spool_node(m, &h->feed.guide.shape, h->node);
  m->s[h->node] = kept;
  set_rest(h, p->s[h->node]);
  w->reshaped(w->user, w->body, h->node);
}

/* Slides the plan's node to the arc length of a fed length. */
static void slide(sw_hold *h, const sw_link_wire *w, double arc, double fed) {
  sw_plan *p = w->system->bodies[w->body].plan;
  const size_t node = h->node;
  double spare[2];
  sw_guide_spare(&h->feed.guide, fed, spare);
  const int same = p->s[node] == arc;
  if (same && (node == 0 || p->rest[node - 1] == arc - p->s[node - 1] + spare[0]) &&
      (node == p->edges || p->rest[node] == p->s[node + 1] - arc + spare[1]))
    return;
  sw_plan_slide(p, node, arc, spare);
  if (!same) reshape(h, w, p);
}

/* Length fed at the end of an inner stage (system/inner.h). */
static double fed_ahead(const sw_hold *h, double t, double inner) {
  const feed_now now = feed_at(h, t), before = feed_at(h, t - inner);
  const double ahead = before.fed + inner * now.speed;
  const double off = now.fed - before.fed - 0.5 * inner * (before.speed + now.speed);
  return sw_inner_goes_ahead(fabs(off), fabs(ahead - now.fed)) ? ahead : now.fed;
}

static void place(sw_hold *h, const sw_link_wire *w, double t, double inner, sw_hold_state *state) {
  const sw_guide *g = &h->feed.guide;
  const feed_now now = feed_at(h, t);
  const int rigid = !isfinite(h->feed.slip.push) && !isfinite(h->feed.slip.limit);
  const double fed = inner > 0 && rigid ? fed_ahead(h, t, inner) : now.fed;
  slide(h, w, arc_at(g, fed), fed);
  const sw_vec along = sw_scale(sw_rotate(state->pose.q, h->director[1]), g->outward);
  state->ahead = sw_scale(along, fed - now.fed);
  state->v = sw_madd(state->v, along, now.speed);
  state->flow = g->outward * now.speed;
  state->a = sw_madd(state->a, along, now.acceleration);
  state->a = sw_madd(state->a, sw_cross(state->omega, along), 2.0 * now.speed);
}

static int follow(sw_hold *h, const sw_link_wire *w) {
  sw_slip *slip = &h->feed.slip;
  const double u = w->time - slip->since;
  slip->length = slipped(slip, w->time);
  /* If the wire yields as little as a wall, its speed oscillates about the right one: with constant
   * amplitude if the last stage's force is obeyed, with a growing one if a mix of both stages is
   * (tr-bdf2 with equal shares: 1.8 times from step to step). Half the change damps the mix (0.9
   * times) and the swing after a blow. In wires with dashpots half the change makes the oscillation
   * grow where the last stage's force is obeyed, by up to 1.2 times from step to step: if it does
   * not fall to a half by itself, three quarters damp it. Wire that stood and now begins to slip
   * does not oscillate. */
  const int slides = isfinite(slip->push) ? slip->evened : slip->way != 0 && slip->way_before != 0;
  const int swings = slides && slip->growth * slip->growth_before < 0;
  const int stays = fabs(slip->growth) > 0.5 * fabs(slip->growth_before) && !slip->evened;
  slip->speed += (!swings ? 1.0 : stays ? 0.75 : 0.5) * slip->growth * u;
  slip->since = w->time;
  sw_slip_taken(slip);
  const double arc = arc_at(&h->feed.guide, feed_at(h, w->time).fed);
  w->mesh->s[h->node] = arc;
  h->s1 = h->s2 = h->s[0] = arc;
  return 0;
}

static void undo(sw_hold *h, const sw_link_wire *w) {
  slide(h, w, h->s1, (h->feed.guide.label - h->s1) * h->feed.guide.outward);
}

/* --- forces ----------------------------------------------------------------------- */

static sw_hold_way passes(const sw_hold *h, const sw_link_wire *w, double t, const double *x) {
  const feed_now now = feed_at(h, t);
  sw_hold_way way = {.way = now.fed,
                     .speed = now.speed,
                     .force = h->feed.guide.drive,
                     .stage = h->feed.guide.stage,
                     .slipped = slipped(&h->feed.slip, t)};
  if (!x) return way;
  const sw_system *s = w->system;
  const sw_vec at = s->hold_states[h->number].pose.p;
  sw_vec force, moment;
  sw_system_reaction(s, (int)h->number, at, &force, &moment);
  way.direction = sw_feed_direction(h, s);
  way.stage = way.obeys = sw_feed_drive(h, w, x, force);
  sw_system_bears(s, (int)h->number, x, at, &force, &moment);
  way.force = sw_feed_drive(h, w, x, force);
  if (s->first.x) way.obeys = sw_obeyed_force(h->feed.guide.drive, way.force, way.stage);
  return way;
}

static sw_guide *guide(sw_hold *h) { return &h->feed.guide; }

static sw_slip *slips(sw_hold *h) {
  sw_slip *slip = &h->feed.slip;
  return isfinite(slip->push) || isfinite(slip->limit) ? slip : NULL;
}

/* --- orders ------------------------------------------------------------------------- */

/* Stops the feed at time t. The next request starts from there. */
static void stop(sw_hold *h, double t) {
  sw_feed *f = &h->feed;
  f->fed = feed_at(h, t).fed - f->slip.length;
  f->since = t;
  f->speed = f->slip.speed = f->slip.growth = f->slip.way = 0;
  f->slip.push = NAN;
  sw_slip_taken(&f->slip);
  sw_motion_release(f->motion);
  f->motion = NULL;
}

static sw_status go(sw_hold *h, const sw_link_wire *w, double speed, sw_motion *motion SW_UNUSED,
                    sw_error *err SW_UNUSED) {
  const double before = feed_at(h, w->time).speed;
  stop(h, w->time);
  h->feed.speed = speed;
  keep_speed(h, w, before);
  return SW_OK;
}

static sw_status push(sw_hold *h, const sw_link_wire *w, double force, sw_motion *motion SW_UNUSED,
                      sw_error *err SW_UNUSED) {
  const double speed = feed_at(h, w->time).speed;
  stop(h, w->time);
  h->feed.slip.push = force, h->feed.slip.speed = speed;
  return SW_OK;
}

static sw_status limit(sw_hold *h, const sw_link_wire *w SW_UNUSED, double force,
                       sw_motion *motion SW_UNUSED, sw_error *err SW_UNUSED) {
  sw_slip *slip = &h->feed.slip;
  slip->limit = force;
  if (isnan(force) && isnan(slip->push)) slip->speed = slip->growth = slip->way = 0;
  sw_slip_taken(slip);
  return SW_OK;
}

/* Returns the length of wire on the side that would supply this length; infinite: a spool [m]. */
static double reserve(const sw_hold *h, const sw_mesh *m, double length) {
  const int from_far = length * h->feed.guide.outward < 0;
  const int is_end = from_far ? h->s1 >= m->s[m->n - 1] : h->s1 <= m->s[0];
  if (is_end) return HUGE_VAL;
  return from_far ? m->s[m->n - 1] - h->s1 : h->s1 - m->s[0];
}

static sw_status pay_out(sw_hold *h, const sw_link_wire *w, double length, sw_motion *motion,
                         sw_error *err) {
  const double there = reserve(h, w->mesh, length);
  if (!(fabs(length) < there))
    return sw_fail(
        err, SW_EINVAL,
        "feed '%s': length = %g m is not allowed; %.6g m of wire '%s' are left on the side "
        "that it comes from; length = %g m goes the other way",
        h->name, length, there, w->name, -length);
  const double before = feed_at(h, w->time).speed;
  stop(h, w->time);
  h->feed.motion = sw_motion_retain(motion), h->feed.start = w->time;
  keep_speed(h, w, before);
  return SW_OK;
}

/* speed: wire paid out per time [m/s]. push: force that pushes it out [N]. force_limit: force
 * beyond which it slips, NAN = none [N]. length: given by the motion's x [m]. */
static const sw_hold_order orders[] = {
    {"speed", 1, go}, {"push", 1, push}, {"force_limit", 0, limit}, {"length", 1, pay_out}, {0}};

static const char *const outputs[] = {"fed", "speed", "drive_force", "force_limit", NULL};

/* Length paid out so far, speed, force that moves the wire outwards (the guide's walls bear the
 * rest), force limit or NAN [m], [m/s], [N], [N]. */
static void read(const sw_hold *h, double t, double *out) {
  const feed_now now = feed_at(h, t);
  out[0] = now.fed, out[1] = now.speed, out[2] = h->feed.guide.drive, out[3] = h->feed.slip.limit;
}

/* 1 if the hold read from a tape is a feed of this wire. */
static int fits(const sw_hold *h, const sw_link_wire *w) {
  const sw_guide *g = &h->feed.guide;
  return h->s1 == h->s2 && h->count == 1 && g->size > 0 && (g->outward == 1 || g->outward == -1) &&
         (w->mesh->rest != NULL) == (g->shape.rest != NULL);
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
                                  .guide = guide,
                                  .slips = slips,
                                  .fits = fits};

const sw_link_class sw_link_feed = {
    .name = "feed",
    .summary = "holds like a clamp while wire slides through",
    .params = SW_PARAMS("feed", rows),
    .hold = &acts,
};
