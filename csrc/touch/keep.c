/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The memory of one touch between steps (see keep.h). */
#include "touch/keep.h"

#include <math.h>

#include "touch/law.h"

/* Shares of the allowed depth: */
/* A squeezed touch is stiffened above this share of the allowed depth. A slowly growing load leaves
 * 0.36 of the allowed depth for each factor of ten in force; half or twice this value leaves half
 * or twice as much, with as few refused steps (spec/contact/taut_spec). */
static const double EARLY = 0.4;    /* stiffened from this share on [-] */
static const double NEEDLESS = 0.1; /* below this share, stiffness is higher than needed [-] */
static const double EASING = 0.8;   /* factor on such stiffness per full step [-] */

static double eased(const sw_press *p, double usual, double k, double deepest, double share) {
  if (!(k > usual) || !(p->normal_force / p->k < NEEDLESS * deepest)) return k;
  return sw_larger(usual, pow(EASING, sw_smaller(share, 1.0)) * k);
}

static const double NO_FORCE = 1e-200; /* of a touch that opened for a while [N] */
static const double STIFFER = 2.0;     /* of friction that holds, over the edge's stiffness [-] */

double sw_kept_grip(const sw_kept *kept, double edge, double usual) {
  const int pressed = kept->normal_force > usual;
  if (!(kept->normal_force > 0)) return 0;
  if (!kept->sliding) return pressed ? (kept->k < edge ? STIFFER : 1.0) * edge : kept->grip;
  return pressed && sw_kept_is_stiff(kept) ? kept->grip : 0;
}

sw_vec sw_press_stretch(const sw_press *p, const sw_kept *kept, int gives_way) {
  const double was = kept->depth > 0 ? kept->normal_force / kept->depth : p->k;
  const double share = gives_way && was > 0 ? p->k / was : 1.0;
  return sw_scale(kept->elastic, share * kept->grip / sw_press_grip(p));
}

int sw_press_eases(const sw_press *p, double usual, double stiffer, double deepest) {
  return eased(p, usual, stiffer, deepest, 1.0) < stiffer;
}

sw_kept sw_press_keep(const sw_press *p, double usual, double stiffer, double deepest,
                      double share) {
  sw_kept out = {.normal_force = p->normal_force,
                 .depth = p->normal_force / p->k,
                 .k = eased(p, usual, stiffer, deepest, share),
                 .steady = p->normal_force,
                 .grip = sw_press_grip(p),
                 .sliding = p->next_sliding};
  if (p->normal_force > 0) out.elastic = sw_scale(p->tangential, -1.0 / out.grip);
  return out;
}

void sw_kept_hold_slide(sw_kept *kept, const sw_press *p, int known) {
  if (!known) return;
  if (p->normal_force > 0) {
    kept->elastic = sw_add(kept->elastic, p->slip);
  } else {
    kept->normal_force = NO_FORCE, kept->sliding = 1;
    kept->elastic = sw_add(p->trial, sw_madd(p->shift, p->normal, -sw_dot(p->shift, p->normal)));
  }
}

void sw_kept_harden(sw_kept *kept, double axial, double deepest) {
  if (kept->depth <= EARLY * deepest || kept->k >= axial) return;
  const double times = sw_smaller(SW_STIFFENED_MOST, axial / kept->k), depth = kept->depth / times;
  kept->left += kept->depth - depth;
  kept->k *= times, kept->depth = depth;
}

void sw_kept_firm(sw_kept *kept, double k) {
  if (!(kept->k < k)) return;
  const double less = kept->k / k;
  kept->k = k;
  kept->depth *= less;
}

double sw_kept_hardened(const sw_kept *kept, double k, int mesh) {
  const double depth = kept->depth, force = kept->normal_force, harder = k * depth - force;
  if (!(harder > 0)) return 0;
  return mesh ? 0.5 * depth * harder : force * depth * harder / (k * depth);
}

void sw_kept_as_felt(sw_kept *k) {
  if (k->normal_force > 0 && k->depth > 0) k->k = k->normal_force / k->depth;
}

sw_press sw_press_felt(const sw_kept *kept) {
  sw_kept k = *kept;
  sw_kept_as_felt(&k);
  sw_press p = {.k = k.k, .normal_force = k.normal_force, .gap_after = -k.depth};
  p.soft = k.grip > 0 ? k.k / k.grip : 0.0;
  p.tangential = sw_scale(k.elastic, -k.grip);
  return p;
}
