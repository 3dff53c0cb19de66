/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of wires after a solve: do they agree with what it assumed? */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/pair.h"

/* Make touches that sink in too deep stiffer; 1 = there were some. */
static int stiffen(sw_pairs *p, const sw_system *s) {
  const int small = sw_press_is_short(p->regime == SW_CONTACT_STATIC, p->h, p->nominal);
  int any = 0;
  if (p->regime == SW_CONTACT_EXPLICIT || s->rough) return 0;
  for (size_t i = 0; i < p->touch_count; i++) {
    sw_pair_touch *t = &p->touches[i];
    const sw_pair *k = &p->pairs[t->pair];
    const sw_vec apart = sw_pair_apart(s->x, t->bow);
    const double before = fmax(0.0, k->reach - sw_dot(t->square, apart));
    t->stiffer = sw_press_stiffer(&t->press, k->usual, t->forgiven, small ? before : -1.0);
    any |= t->stiffer > t->press.k;
  }
  return any;
}

/* Of a wire's touches, forces far below the largest one do not matter; of two wires, what
 * does not matter to either. */
static void find_scales(sw_pairs *p) {
  for (size_t b = 0; b < p->bodies; b++) p->largest[b] = 0;
  for (size_t i = 0; i < p->touch_count; i++)
    for (size_t k = 0; k < 2; k++) {
      double *largest = &p->largest[p->pairs[p->touches[i].pair].body[k]];
      const double lag = p->touches[i].press.lag;
      if (lag > *largest) *largest = lag;
    }
}

static double scale_of(const sw_pairs *p, const sw_pair_touch *t) {
  const uint32_t *body = p->pairs[t->pair].body;
  return fmin(p->largest[body[0]], p->largest[body[1]]);
}

/* Shorter updates leave place and normal of a touch as they are; of the radii [-]. */
static const double SMALL_SHIFT = 0.05;

typedef enum verdict { GOES_ON, ALL_BUT_FRICTION, AGREES } verdict;

static verdict update(const sw_pairs *p, sw_pair_touch *t, const double *delta, double scale) {
  const sw_pair *k = &p->pairs[t->pair];
  const sw_vec shift = sw_pair_apart(delta, t->bow);
  const double friction = sw_pair_rule_of(p, k->body)->friction;
  const int agrees = sw_press_update(&t->press, friction, shift, scale);
  for (int i = 0; i < 2; i++) sw_press_weigh(&t->press, friction, &p->rubbing[k->body[i]]);
  if (t->press.gap_after < 0.5 * k->reach && sw_norm(shift) > SMALL_SHIFT * k->reach)
    return GOES_ON;
  if (t->far && t->press.normal_force > 0) return GOES_ON;
  return agrees ? AGREES : sw_press_apart(&t->press) ? ALL_BUT_FRICTION : GOES_ON;
}

/* Is what friction is off by little for each wire? */
static int rubs_enough(const sw_pairs *p) {
  if (p->regime != SW_CONTACT_IMPLICIT || p->updates <= SW_PATIENCE) return 0;
  for (size_t b = 0; b < p->bodies; b++)
    if (!sw_press_enough(&p->rubbing[b])) return 0;
  return 1;
}

static int update_all(sw_pairs *p, const double *delta) {
  verdict all = AGREES;
  find_scales(p);
  p->updates++;
  memset(p->rubbing, 0, p->bodies * sizeof *p->rubbing);
  for (size_t i = 0; i < p->touch_count; i++) {
    const verdict one = update(p, &p->touches[i], delta, scale_of(p, &p->touches[i]));
    all = one < all ? one : all;
  }
  return all == AGREES || (all == ALL_BUT_FRICTION && rubs_enough(p));
}

static sw_spot spot_of(const sw_pairs *p, sw_pair_touch *t) {
  const sw_pair *k = &p->pairs[t->pair];
  sw_spot spot = {.press = &t->press,
                  .friction = sw_pair_rule_of(p, k->body)->friction,
                  .scale = scale_of(p, t)};
  for (int side = 0; side < 2; side++)
    for (uint32_t i = 0; i < t->bow[side].count; i++, spot.count++) {
      spot.body[spot.count] = k->body[side];
      spot.node[spot.count] = t->bow[side].first + i;
      spot.weight[spot.count] = side ? -t->bow[side].w[i] : t->bow[side].w[i];
    }
  return spot;
}

void sw_pairs_refine(sw_pairs *p, sw_contact *contact, sw_system *s) {
  p->spots.count = 0;
  if (contact) sw_contact_add_spots(contact, s, &p->spots);
  find_scales(p);
  for (size_t i = 0; i < p->touch_count; i++) {
    sw_pair_touch *t = &p->touches[i];
    if (t->press.active && t->press.sliding) sw_spots_add(&p->spots, s, spot_of(p, t));
  }
  sw_spots_follow(&p->spots, s);
}

int sw_pairs_settled(sw_pairs *p, sw_system *s, const double *delta) {
  const int fine = update_all(p, delta);
  if (fine && stiffen(p, s)) return 0;
  for (size_t i = 0; fine && i < p->touch_count; i++) {
    const sw_pair_touch *t = &p->touches[i];
    if (!(t->press.normal_force > 0 || t->press.gap_after < 0)) continue;
    if (sw_grow((void **)&p->pressed, &p->pressed_capacity, p->pressed_count + 1,
                sizeof *p->pressed) != SW_OK)
      break; /* an impact is then dealt with in the next step */
    p->pressed[p->pressed_count++] = *t;
  }
  return fine;
}
