/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums over lists of touches of any kind. */
#include "touch/tally.h"

#include "touch/law.h"

static const void *part(sw_presses l, size_t k, size_t place) {
  return (const char *)l.list + k * l.size + place;
}

static const sw_press *press(sw_presses l, size_t k) { return part(l, k, l.press); }

size_t sw_presses_count(sw_presses l) {
  size_t n = 0;
  if (l.known) return l.known->pressing;
  for (size_t k = 0; k < l.count; k++) n += press(l, k)->normal_force > 0;
  return n;
}

int sw_presses_slide(sw_presses l, double least) {
  for (size_t k = 0; k < l.count; k++) {
    const sw_press *p = press(l, k);
    if (p->normal_force > 0 && sw_norm(p->tangential) > 0 && sw_norm(p->slip) > least) return 1;
  }
  return 0;
}

double sw_presses_energy(sw_presses l) {
  double sum = 0;
  if (l.known) return l.known->energy;
  for (size_t k = 0; k < l.count; k++) {
    const sw_press *p = press(l, k);
    if (!(p->normal_force > 0)) continue;
    sum += 0.5 * p->normal_force * p->normal_force / p->k;
    sum += 0.5 * sw_norm2(p->tangential) / sw_press_grip(p);
  }
  return sum;
}

double sw_presses_rubbed(sw_presses l) {
  double sum = 0;
  if (l.known) return l.known->rubbed;
  for (size_t k = 0; k < l.count; k++) {
    const sw_press *p = press(l, k);
    if (p->normal_force > 0) sum -= sw_dot(p->tangential, p->slip);
  }
  return sum;
}

sw_press_sums sw_presses_sums(sw_presses l) {
  l.known = NULL;
  sw_press_sums out = {sw_presses_count(l), sw_presses_energy(l), sw_presses_rubbed(l), 0};
  for (size_t k = 0; k < l.count; k++)
    out.hardest = sw_larger(out.hardest, press(l, k)->normal_force);
  return out;
}

double sw_presses_emerged(sw_presses l) {
  double sum = 0;
  for (size_t k = 0; k < l.count; k++) {
    const double *let_out = part(l, k, l.let_out);
    sum += *let_out * press(l, k)->normal_force;
  }
  return sum;
}
