/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Impacts and crossings between wires. A step that meets what it did not touch before is
 * redone by implicit Euler: the wires reach each other within it and go on together, whatever
 * their stiffness, and the integrator never sees the shock that would make it bounce. Wires
 * do not rebound. Segments whose axes come much nearer than their radii allow are kept on
 * their sides of each other. */
#include <math.h>

#include "base/alloc.h"
#include "contact/pairs_sweep.h"
#include "contact/same.h"

static int is_barred(const sw_pairs *p, const sw_pair *k, const double at[2]) {
  const sw_pair_barrier *b = p->barriers;
  for (size_t i = 0; i < p->barrier_count; i++)
    if (b[i].one == k->one && b[i].two == k->two && fabs(b[i].at[0] - at[0]) < SW_SAME_TOUCH &&
        fabs(b[i].at[1] - at[1]) < SW_SAME_TOUCH)
      return 1;
  return 0;
}

static int raise_barrier(sw_pairs *p, const sw_pair *k, const double at[2], sw_vec normal) {
  if (sw_grow((void **)&p->barriers, &p->barrier_capacity, p->barrier_count + 1,
              sizeof *p->barriers) != SW_OK)
    return 0;
  p->barriers[p->barrier_count++] = (sw_pair_barrier){k->one, k->two, {at[0], at[1]}, normal};
  return 1;
}

/* How fast a touch is passed through in the step, beyond just being reached [m/s]. */
static double excess(const sw_system *s, const sw_pair *k, const sw_bow bow[2], sw_vec normal,
                     double h) {
  const double gap = sw_dot(normal, sw_pair_apart(s->x, bow)) - k->reach;
  const double approach = -sw_dot(sw_pair_apart(s->v, bow), normal);
  return approach - (gap > 0 ? gap : 0.0) / h;
}

/* How many touches strike. Once in a step: the one that does not bounce deals with all of them. */
static size_t strikes(const sw_pairs *p, const sw_system *s, double h) {
  size_t count = 0;
  for (size_t i = 0; i < p->pressed_count && !p->impact_count; i++) {
    const sw_pair_touch *t = &p->pressed[i];
    count += excess(s, &p->pairs[t->pair], t->bow, t->press.normal, h) > SW_SLOWEST_IMPACT;
  }
  return count;
}

/* The fastest that nodes of two segments go against each other [m/s]. */
static double fastest_between(const sw_system *s, const sw_pair *k) {
  double most = 0;
  for (uint32_t i = 0; i < 2; i++)
    for (uint32_t j = 0; j < 2; j++)
      most = fmax(most, sw_norm2(sw_sub(sw_vec_at(s->v, k->one + i), sw_vec_at(s->v, k->two + j))));
  return sqrt(most);
}

/* Ends of segments along each other may be nearest aslant, where they do not touch. */
static sw_vec square_to(const sw_system *s, const sw_pair *k, sw_vec apart) {
  const sw_vec u = sw_sub(sw_vec_at(s->x, k->one + 1u), sw_vec_at(s->x, k->one));
  return k->parallel ? sw_madd(apart, u, -sw_dot(apart, u) / fmax(sw_norm2(u), 1e-300)) : apart;
}

int sw_pairs_expect(const sw_pairs *p, const sw_system *s, double h) {
  for (size_t i = 0; i < p->pair_count; i++) {
    const sw_pair *k = &p->pairs[i];
    double at[2];
    if (k->held || !(fastest_between(s, k) > SW_SLOWEST_IMPACT)) continue;
    sw_segments_nearest(sw_vec_at(s->x, k->one), sw_vec_at(s->x, k->one + 1u),
                        sw_vec_at(s->x, k->two), sw_vec_at(s->x, k->two + 1u), at);
    const sw_bow bow[2] = {sw_bow_chord(k->one, at[0]), sw_bow_chord(k->two, at[1])};
    const sw_vec normal = sw_unit_or(square_to(s, k, sw_pair_apart(s->x, bow)), sw_v(0, 0, 1));
    if (excess(s, k, bow, normal, h) > SW_SLOWEST_IMPACT) return 1;
  }
  return 0;
}

/* 1 = segments would pass through each other and are kept on their sides from now on; -1 =
 * they would although they were: only a smaller step helps. */
static int review_crossings(sw_pairs *p, const sw_system *s, const double *x1) {
  int changed = 0;
  for (size_t i = 0; i < p->pair_count; i++) {
    const sw_pair *k = &p->pairs[i];
    double at[2];
    sw_vec normal;
    if (k->held || !sw_pair_sweep(s, k, s->x, x1, at, &normal)) continue;
    if (is_barred(p, k, at)) return -1;
    changed |= raise_barrier(p, k, at, normal);
  }
  return changed;
}

static double largest_move(const double *x0, const double *x1, size_t nodes) {
  double most = 0;
  for (size_t i = 0; i < nodes; i++) {
    const double d2 = sw_norm2(sw_sub(sw_vec_at(x1, i), sw_vec_at(x0, i)));
    most = most > d2 ? most : d2;
  }
  return sqrt(most);
}

/* Did segments that were not chosen touch or pass each other? Their largest gap at the
 * step's start, or -1 when none did [m]. */
static double missed_gap(const sw_pairs *p, const sw_system *s, const double *x1) {
  const double farthest = 2.0 * largest_move(s->x, x1, s->nodes);
  double gap = -1;
  size_t k = 0;
  if (farthest <= -p->least_left) return gap;
  for (size_t i = 0; i < p->near_count; i++) {
    const sw_near *n = &p->near[i];
    if (k < p->pair_count && p->pairs[k].one == n->one && p->pairs[k].two == n->two) {
      k++;
      continue;
    }
    const double radii =
        s->bodies[n->body[0]].plan->beam.radius + s->bodies[n->body[1]].plan->beam.radius;
    if (n->distance - radii <= gap || n->distance - farthest >= radii) continue;
    const sw_pair as = {.one = n->one, .two = n->two, .reach = radii};
    double at[2];
    sw_vec normal;
    if (n->distance - sw_pair_approach(s, &as, s->x, x1) >= radii) continue;
    if (sw_pair_distance(s, &as, x1) - n->bulge < radii ||
        sw_pair_sweep(s, &as, s->x, x1, at, &normal))
      gap = n->distance - radii;
  }
  return gap;
}

/* Choose among more segments when some were missed: 1 = the step is to be redone, -1 =
 * out of memory. */
static int widen(sw_pairs *p, sw_system *s, const double *x1) {
  if (2.0 * largest_move(p->listed_at, x1, s->nodes) > p->listed_reach &&
      sw_pairs_list(p, s, 2.0 * largest_move(s->x, x1, s->nodes)) != SW_OK)
    return -1;
  const double gap = missed_gap(p, s, x1);
  if (gap < 0) return 0;
  p->least_reserve = 1.01 * gap;
  return sw_pairs_choose(p, s) == SW_OK ? 1 : -1;
}

/* A step may leave segments this much deeper in each other than it found them: of the
 * radii's sum, and at most [-], [m]. */
static const double DEEPER_SHARE = 0.05, DEEPER = 1e-4;
/* In steps below this share of the nominal one depth is taken as it comes [-]. */
static const double SMALLEST_CARE = 1.0 / 64;

static int cuts_deep(const sw_pairs *p, const sw_system *s, const double *x1, double h) {
  if (h < SMALLEST_CARE * p->nominal || p->regime == SW_CONTACT_EXPLICIT) return 0;
  for (size_t i = 0; i < p->pair_count; i++) {
    const sw_pair *k = &p->pairs[i];
    const double deeper = fmin(DEEPER, DEEPER_SHARE * k->reach);
    if (k->held || sw_pair_approach(s, k, s->x, x1) < deeper) continue;
    const double after = sw_pair_distance(s, k, x1);
    if (after < k->reach - deeper && after < sw_pair_distance(s, k, s->x) - deeper) return 1;
  }
  return 0;
}

sw_contact_verdict sw_pairs_review(sw_pairs *p, sw_system *s, const double *x1, double h,
                                   int dull) {
  const int wider = widen(p, s, x1);
  if (wider) {
    p->pressed_count = 0;
    return wider > 0 ? SW_CONTACT_REDO : SW_CONTACT_SMALLER;
  }
  const int crossed = review_crossings(p, s, x1);
  if (crossed < 0) {
    p->pressed_count = 0;
    return SW_CONTACT_SMALLER;
  }
  const size_t struck = strikes(p, s, h);
  p->impact_count += struck;
  p->pressed_count = 0;
  if (crossed || (struck && !dull)) return SW_CONTACT_STRIKE;
  return cuts_deep(p, s, x1, h) ? SW_CONTACT_SMALLER : SW_CONTACT_ACCEPT;
}

int sw_pairs_review_static(sw_pairs *p, sw_system *s, const double *x1) {
  if (widen(p, s, x1)) return 1;
  return review_crossings(p, s, x1) != 0;
}
