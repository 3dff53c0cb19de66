/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of one touch (see law.h): its states, forces and stiffness. */
#include "touch/law.h"

#include <math.h>

/* Depths up to this are rounding of a script's numbers [m]. */
static const double PLACED = 2e-8;
/* Smaller gaps let an iteration end. This is far below the depth of a resting wire in steps of any
 * size; otherwise the touches that a wire leaves would hold it back [m]. */
static const double GAP_TOLERANCE = 1e-13;
/* Smaller errors of a friction spring's length let an iteration end. They are far below its length
 * at the onset of sliding, at any stiffness [m]. */
static const double SPRING_TOLERANCE = 1e-14;
/* Turns of the sliding direction with a cosine above this let an iteration end [-]. */
static const double TURN_TOLERANCE = 0.98;
/* Errors by the direction's linearisation up to this share of the force let an iteration end
 * [-]. */
static const double DIRECTION_TOLERANCE = 0.02;
/* Changes of a sliding touch's normal force let an iteration end up to FORCE_TOLERANCE of it plus
 * WEIGHT_TOLERANCE of the scene's forces [-]. */
static const double FORCE_TOLERANCE = 0.01;
static const double WEIGHT_TOLERANCE = 1e-3;

/* If friction was this many times the scene's forces in an iterate's first solve, its rounding
 * remains in the solution [-]. */
static const double DROWNED = 100.0;

/* A spring stretched by this many times the limit of friction certainly slides, even in a poor
 * prediction [-]. */
static const double SURELY_SLIDING = 20.0;
/* But it sticks if the slide of a touch with by_place has reversed this often: friction then pushes
 * it back by more than that stretch each time [-]. */
enum { REVERSALS = 3 };

static const double MOST_BOOST = 1e5; /* largest stiffening, of a new touch's stiffness [-] */
/* Shares of the allowed depth: */
static const double DEEPER = 0.1;  /* allowed increase of depth in short steps [-] */
static const double AT_ONCE = 2.0; /* left at once under a load that grows fast [-] */
static const double SHORT = 0.25;  /* a step is short below this share of the nominal step [-] */

void sw_press_activate(sw_press *p, const sw_press *last) {
  p->active = p->gap < 0 || (last && last->active && last->normal_force > 0);
  if (!last) return;
  if (last->let_go || last->take_on) {
    p->active = last->take_on;
    return;
  }
  p->spare = last->spare;
  if (p->active || !last->active || !p->spare) return;
  p->active = 1;
  p->spare--;
}

/* After this many alternations the normal force in friction is found by a secant. Most alternations
 * die out by themselves, and among many touches the slope of one says little about the others
 * [-]. */
enum { ALTERNATIONS = 4 };

static void take_lag(sw_press *p, const sw_press *last) {
  const double error = last->normal_force - last->lag;
  const double error_before = last->force_before - last->lag_before;
  p->lag_before = last->lag, p->force_before = last->normal_force;
  p->lag = last->normal_force;
  if (!(last->lag_before > 0) || !(error * error_before < 0)) return;
  p->alternations = last->alternations + 1;
  if (p->alternations >= ALTERNATIONS)
    p->lag = last->lag + (last->lag_before - last->lag) * error / (error - error_before);
}

void sw_press_resume(sw_press *p, const sw_kept *kept, const sw_press *last, int goes_on,
                     double guess) {
  p->lag = kept ? kept->normal_force : guess;
  if (last) take_lag(p, last);
  if (goes_on && last)
    p->sliding = last->next_sliding;
  else if (kept)
    p->sliding = kept->sliding;
}

/* Part of a vector perpendicular to a normal. */
static sw_vec across(sw_vec v, sw_vec n) { return sw_madd(v, n, -sw_dot(v, n)); }

void sw_press_aim(sw_press *p, sw_vec u, const sw_press *last, int same, double first) {
  p->carried = !last ? sw_v(0, 0, 0) : same ? last->carried : sw_scale(last->slip, first);
  u = sw_sub(u, p->carried);
  p->trial = across(u, p->normal);
  if (last && last->active)
    p->pulls = across(last->next_pulls, p->normal);
  else
    p->pulls = sw_unit_or(p->trial, sw_v(0, 0, 0));
}

void sw_press_begin(sw_press *p, double friction, int known, double felt) {
  const double most = friction * p->lag, grip = sw_press_grip(p), length = sw_norm(p->trial);
  if (!known) p->sliding = grip * length > most, p->pulls = sw_v(0, 0, 0);
  const int surely = sw_smaller(grip, felt) * length > SURELY_SLIDING * most;
  if (surely && p->reversals < REVERSALS) p->sliding = 1;
}

/* Returns the direction in which a touch slides, zero if unknown, and the length of its spring. */
static sw_vec direction(const sw_press *p, double *length) {
  const sw_vec u = sw_add(p->trial, p->ahead);
  *length = sw_norm(u);
  if (!(*length > SPRING_TOLERANCE)) return sw_v(0, 0, 0);
  return sw_scale(u, 1.0 / *length);
}

/* K = kn n n' + kt (I - n n') - ks (d w' + w d')/2 */
static void stiffness_matrix(double kn, double kt, double ks, sw_vec n, sw_vec d, sw_vec w,
                             double K[6]) {
  const double v[3] = {n.x, n.y, n.z}, u[3] = {d.x, d.y, d.z}, q[3] = {w.x, w.y, w.z};
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++)
      K[at] =
          (kn - kt) * v[i] * v[j] + (i == j ? kt : 0.0) - 0.5 * ks * (u[i] * q[j] + q[i] * u[j]);
}

/* Stiffness of a sliding touch times a shift along the surface: the change of friction as it
 * turns. */
static sw_vec turned(const sw_press *p, sw_vec d, sw_vec along) {
  const double by = -0.5 * sw_dot(d, along), more = -0.5 * sw_dot(p->pulls, along);
  return sw_scale(sw_madd(sw_madd(along, p->pulls, by), d, more), p->turning);
}

sw_vec sw_press_eval(sw_press *p, double friction, int lagged, double K[6]) {
  p->normal_force = -p->k * p->gap;
  if (!lagged) p->lag = p->normal_force;
  p->lag_at_first = p->lag;
  const double most = friction * p->lag, grip = sw_press_grip(p);
  double length;
  const sw_vec d = direction(p, &length);
  if (p->by_place) p->pulls = d;
  if (!lagged) p->next_sliding = p->sliding = grip * length > most;
  p->tangential = p->sliding ? sw_scale(d, -most) : sw_scale(p->trial, -grip);
  p->slip = sw_add(p->carried, sw_madd(p->trial, p->tangential, 1.0 / grip));
  if (p->sliding) {
    p->turning = length > SPRING_TOLERANCE ? sw_smaller(most / length, grip) : 0.0;
    stiffness_matrix(p->k, p->turning, p->turning, p->normal, d, p->pulls, K);
    const sw_vec back = turned(p, d, p->ahead);
    return sw_add(sw_madd(p->tangential, p->normal, p->normal_force), back);
  } else {
    stiffness_matrix(p->k, friction > 0 ? grip : 0.0, 0, p->normal, d, d, K);
    if (!(friction > 0)) p->tangential = sw_v(0, 0, 0);
  }
  return sw_madd(p->tangential, p->normal, p->normal_force);
}

/* 1 if the normal force used in friction is within the tolerance. */
static int lag_agrees(const sw_press *p, double force, double force_scale) {
  return fabs(force - p->lag) <= FORCE_TOLERANCE * force + WEIGHT_TOLERANCE * force_scale;
}

double sw_press_push(const sw_press *p, sw_vec shift) {
  return sw_larger(0.0, -p->k * (p->gap + sw_dot(p->normal, shift)));
}

int sw_press_slides(const sw_press *p, double friction) {
  return p->active && p->sliding && friction > 0;
}

int sw_press_lags(const sw_press *p, double friction, sw_vec shift, double force_scale) {
  return sw_press_slides(p, friction) && !lag_agrees(p, sw_press_push(p, shift), force_scale);
}

sw_vec sw_press_assume(sw_press *p, double friction, double force) {
  const double before = p->lag;
  double length;
  p->lag = force;
  return sw_scale(direction(p, &length), friction * (before - force));
}

sw_vec sw_press_follow(sw_press *p, double friction, sw_vec shift) {
  if (!sw_press_slides(p, friction)) return sw_v(0, 0, 0);
  return sw_press_assume(p, friction, sw_press_push(p, shift));
}

sw_vec sw_press_unfollow(sw_press *p, double friction) {
  if (!sw_press_slides(p, friction)) return sw_v(0, 0, 0);
  return sw_press_assume(p, friction, p->lag_at_first);
}

double sw_press_off(const sw_press *p, double friction, sw_vec shift) {
  return sw_press_slides(p, friction) ? fabs(sw_press_push(p, shift) - p->lag) : 0.0;
}

int sw_press_pulls(const sw_press *p, sw_vec shift) {
  return p->active && p->gap + sw_dot(p->normal, shift) > GAP_TOLERANCE;
}

int sw_press_sinks(const sw_press *p, sw_vec shift) {
  return p->gap + sw_dot(p->normal, shift) < -GAP_TOLERANCE;
}

int sw_press_closes(const sw_press *p, sw_vec shift) {
  return !p->active && sw_press_sinks(p, shift);
}

void sw_press_close(sw_press *p) {
  p->active = p->sliding = 1;
  p->lag = p->lag_at_first = p->turning = 0;
}

int sw_press_opens(const sw_press *p, sw_vec shift, double force_scale) {
  if (sw_press_sinks(p, shift)) return 0;
  if (!p->sliding) return 1;
  double length;
  const sw_vec d = direction(p, &length);
  const sw_vec turn = turned(p, d, sw_sub(across(shift, p->normal), p->ahead));
  return sw_norm(turn) <= WEIGHT_TOLERANCE * force_scale;
}

/* Friction as assumed by the last solve. */
static sw_vec rubbed(const sw_press *p, double friction) {
  const sw_vec along = across(p->shift, p->normal);
  double length;
  if (!p->sliding) return sw_scale(sw_add(p->trial, along), -sw_press_grip(p));
  const sw_vec d = direction(p, &length);
  return sw_sub(sw_scale(d, -friction * p->lag), turned(p, d, sw_sub(along, p->ahead)));
}

/* Friction by the linearised law at displacement u, reversed, over its limit. If the curvature of
 * each touch came from its place alone, an iteration on sums of many directions u/|u| would be
 * misled, because there is no curvature along u: touches that should stick are thrown past their
 * place and back, hundreds at once. So the direction w, |w| <= 1, is an unknown besides the place,
 * and the equation |u| w = u is linearised. Curvature then acts only where friction is at its limit
 * (Chan, Golub and Mulet 1999, for sums of norms in images). */
static sw_vec pulled(const sw_press *p, sw_vec u, sw_vec along, double most) {
  double length;
  const sw_vec d = direction(p, &length);
  sw_vec w;
  if (p->sliding && length > SPRING_TOLERANCE)
    w = sw_scale(sw_madd(u, p->pulls, -sw_dot(d, along)), 1.0 / length);
  else
    w = most > 0 ? sw_scale(u, sw_press_grip(p) / most) : sw_v(0, 0, 0);
  return sw_scale(w, 1.0 / sw_larger(1.0, sw_norm(w)));
}

static int update_friction(sw_press *p, double friction, sw_vec shift, double force_scale) {
  const sw_vec moved = across(shift, p->normal), u = sw_add(p->trial, moved);
  const double length = sw_norm(u), most = friction * p->normal_force;
  const double grip = sw_press_grip(p), small = grip * SPRING_TOLERANCE;
  const sw_vec from = sw_add(p->trial, p->ahead);
  const double along = sw_dot(u, from);
  const int beyond = grip * length > most;
  /* with by_place, a slide that reverses in an iterate should stick */
  const int reversed = p->by_place && p->sliding && along < 0;
  p->next_sliding = beyond && !reversed;
  p->reversals += reversed;
  p->next_pulls = pulled(p, u, moved, most);
  p->tangential = sw_scale(u, -(beyond && length > 0 ? most / length : grip));
  p->slip = sw_add(p->carried, sw_madd(u, p->tangential, 1.0 / grip));
  p->off = sw_norm(sw_sub(rubbed(p, friction), p->tangential));
  /* friction from rounding of its spring has no direction and needs none */
  const int idle = sw_larger(most, friction * p->lag) <= small;
  /* the slide reversed in this iterate: its friction, from lag, must not matter */
  if (p->sliding && along < 0) return idle;
  if (p->sliding && beyond && !idle && along < TURN_TOLERANCE * length * sw_norm(from)) return 0;
  /* a change of state matters if the force does */
  const double share = p->sliding && beyond ? DIRECTION_TOLERANCE : FORCE_TOLERANCE;
  if (p->off > small + share * most + WEIGHT_TOLERANCE * force_scale) return 0;
  if (!p->sliding || !beyond || idle) return 1;
  if (p->lag_at_first > DROWNED * (p->normal_force + force_scale)) return 0;
  return lag_agrees(p, p->normal_force, force_scale);
}

int sw_press_update(sw_press *p, double friction, sw_vec shift, double force_scale) {
  const int active = p->active;
  p->shift = shift;
  p->gap_after = p->gap + sw_dot(p->normal, shift);
  p->normal_force = active ? sw_larger(0.0, -p->k * p->gap_after) : 0.0;
  p->next_sliding = 1; /* without touch it moves freely */
  p->slip = sw_v(0, 0, 0);
  p->off = 0;
  const int agrees = active && friction > 0 ? update_friction(p, friction, shift, force_scale) : 1;
  return agrees && sw_press_apart(p);
}

void sw_press_weigh(const sw_press *p, double friction, sw_rubbing *sum) {
  sum->off += p->off;
  sum->most += friction * p->normal_force;
}

int sw_press_enough(const sw_rubbing *sum) { return sum->off <= FORCE_TOLERANCE * sum->most; }

sw_vec sw_press_borne(const sw_press *p, double friction) {
  if (!p->active && !p->opened) return sw_v(0, 0, 0);
  /* for an opened touch, only rounding is left */
  const sw_vec f = sw_scale(p->normal, p->lift - p->k * p->gap_after);
  return friction > 0 ? sw_add(f, rubbed(p, friction)) : f;
}

int sw_press_apart(const sw_press *p) {
  return p->active ? p->gap_after <= GAP_TOLERANCE : p->gap_after >= -GAP_TOLERANCE;
}

int sw_press_lies(const sw_press *p) { return p->gap_after <= PLACED; }

int sw_press_was_put(double depth, int first) { return depth > (first ? PLACED : SW_DEEPEST); }

sw_left sw_press_leave(double depth, const sw_kept *kept, double way) {
  const double explained = kept ? kept->depth : 0.0;
  const double unexplained = depth - explained, kept_left = kept ? kept->left : 0.0;
  /* after an edit, HUGE_VAL: all of it, of either sign */
  const double most = kept_left == HUGE_VAL ? unexplained : sw_larger(0.0, unexplained);
  const double left = sw_smaller(kept_left, most);
  const double forgiven = left + sw_larger(0.0, depth - explained - left - way - PLACED);
  const double out = depth - explained - forgiven;
  return (sw_left){forgiven, out > PLACED ? out : 0.0, left};
}

int sw_press_is_short(int statics, double h, double nominal) {
  return !statics && h > 0 && h < SHORT * nominal;
}

double sw_press_squeezed(double forgiven, double before, double deepest) {
  return sw_larger(before, forgiven + AT_ONCE * deepest);
}

double sw_press_stiffer(const sw_press *p, double usual, double axial, double deepest,
                        double forgiven, double before) {
  const double over = p->gap_after / -deepest;
  if (over <= 1.0 || p->k >= sw_larger(MOST_BOOST * usual, axial)) return p->k;
  if (before < 0) return p->k * sw_smaller(SW_STIFFENED_MOST, 2.0 * over);
  /* a strike in a short step quickly becomes deep */
  return forgiven - p->gap_after < before + DEEPER * deepest ? p->k : p->k * SW_STIFFENED_MOST;
}
