/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A motion given by a function of time. Velocity and acceleration are those of the parabola through
 * three poses, one step apart. Their errors are step^2/6 times the third and step^2/12 times the
 * fourth derivative. Where the velocity jumps, all three are on one side of the jump. */
#include <math.h>

#include "base/alloc.h"
#include "motion/law.h"

static sw_status ask(const sw_motion_callback *c, double t, sw_pose *out, sw_error *err) {
  *out = sw_pose_identity();
  SW_TRY(c->function(c->user, t, out, err));
  out->q = sw_quat_unit(out->q);
  if (!sw_finite(out->p))
    return sw_fail(err, SW_ECALLBACK,
                   "trajectory: the function gave no finite position at t = %g s", t);
  return SW_OK;
}

/* Returns q or -q, whichever is nearer to like. */
static sw_quat alike(sw_quat q, sw_quat like) {
  const double dot = q.w * like.w + q.x * like.x + q.y * like.y + q.z * like.z;
  return dot < 0 ? (sw_quat){-q.w, -q.x, -q.y, -q.z} : q;
}

/* Returns the turn from middle to q in world axes [rad]. */
static sw_vec turned(sw_quat q, sw_quat middle) {
  return sw_quat_log(sw_quat_mul(alike(q, middle), sw_quat_conj(middle)));
}

/* Asks for the poses one step before and after a time and, unless it is t, at it. */
static sw_status ask_three(const sw_motion_callback *c, double centre, double t, sw_pose *three,
                           sw_error *err) {
  if (centre != t) SW_TRY(ask(c, centre, three + 1, err));
  SW_TRY(ask(c, centre - c->step, three, err));
  return ask(c, centre + c->step, three + 2, err);
}

static sw_status eval(const sw_motion *motion, double t, sw_motion_state *out, sw_error *err) {
  const sw_motion_callback *c = motion->body;
  const double h = c->step;
  sw_pose at[3];
  double centre = fmin(fmax(t, h), motion->duration - h);
  SW_TRY(ask(c, t, &out->pose, err));
  at[1] = out->pose;
  SW_TRY(ask_three(c, centre, t, at, err));
  const double middle = centre;
  SW_TRY(sw_callback_beside(motion, t, h, at, &centre, err));
  if (centre != middle) SW_TRY(ask_three(c, centre, t, at, err));
  const sw_vec plus = sw_sub(at[2].p, at[1].p), minus = sw_sub(at[0].p, at[1].p);
  out->a = sw_scale(sw_add(plus, minus), 1 / (h * h));
  out->v = sw_madd(sw_scale(sw_sub(plus, minus), 0.5 / h), out->a, t - centre);
  const sw_vec wp = turned(at[2].q, at[1].q), wm = turned(at[0].q, at[1].q);
  out->alpha = sw_scale(sw_add(wp, wm), 1 / (h * h));
  out->omega = sw_madd(sw_scale(sw_sub(wp, wm), 0.5 / h), out->alpha, t - centre);
  return SW_OK;
}

sw_status sw_callback_pose(const sw_motion *m, double t, sw_pose *out, sw_error *err) {
  const sw_motion *law = m->inner ? m->inner : m;
  return ask(law->body, fmin(fmax(t - m->start, 0.0), law->duration), out, err);
}

static void destroy(void *body) {
  sw_motion_callback *c = body;
  if (c && c->release) c->release(c->user);
  sw_free(c);
}

const sw_motion_law sw_motion_law_callback = {"callback", NULL, NULL, eval, destroy};

double sw_motion_step(const sw_motion *motion) {
  const sw_motion *law = motion->inner ? motion->inner : motion;
  return law->law == &sw_motion_law_callback ? ((const sw_motion_callback *)law->body)->step : 0.0;
}

sw_status sw_motion_create_callback(const sw_motion_callback *callback, sw_motion **out,
                                    sw_error *err) {
  *out = NULL;
  if (!callback->function || !(callback->step > 0) || !(callback->duration >= 2 * callback->step))
    return sw_fail(err, SW_EINVAL,
                   "trajectory: a function needs a step above 0 s and a duration (%g s) of at "
                   "least two steps (of %g s)",
                   callback->duration, callback->step);
  sw_motion *motion = sw_alloc(1, sizeof *motion);
  sw_motion_callback *body = sw_alloc(1, sizeof *body);
  if (!motion || !body) {
    sw_free(motion);
    sw_free(body);
    return sw_fail(err, SW_ENOMEM, "trajectory: out of memory");
  }
  *body = *callback;
  motion->law = &sw_motion_law_callback;
  motion->references = 1;
  motion->start = callback->start;
  motion->duration = callback->duration;
  motion->length = NAN;
  motion->relative = callback->relative;
  motion->body = body;
  *out = motion;
  return SW_OK;
}
