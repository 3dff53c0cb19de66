/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the least energy on the path from an iterate to its solution (way.h). */
#include "touch/way.h"

#include <math.h>

#include "base/alloc.h"
#include "base/each.h"

sw_vec sw_press_at(const sw_press *p, double friction, sw_vec s) {
  const double across = sw_dot(p->normal, s), N = fmax(0.0, -p->k * (p->gap + across));
  const sw_vec u = sw_madd(sw_add(p->trial, s), p->normal, -across);
  const double most = friction * p->lag, spring = sw_press_grip(p) * sw_norm(u);
  const sw_vec f = sw_scale(p->normal, N);
  if (!(most > 0) || !(spring > 0)) return f;
  return sw_madd(f, u, -sw_press_grip(p) * fmin(1.0, most / spring));
}

void sw_press_go_on(sw_press *p, double friction, sw_vec s, int may) {
  const double across = sw_dot(p->normal, s), gap = p->gap + across;
  const sw_vec u = sw_madd(sw_add(p->trial, s), p->normal, -across);
  p->take_on = may && gap < 0;
  p->let_go = !p->take_on;
  p->normal_force = fmax(0.0, -p->k * gap);
  p->next_sliding = sw_press_grip(p) * sw_norm(u) > friction * p->normal_force;
}

/* Halvings of the path in the search for the share [-]. */
enum { HALVINGS = 20 };

double sw_way_least(double (*slope)(const void *, double), const void *user) {
  double low = 0, high = 1.0;
  if (!(slope(user, 1.0) > 0) || !(slope(user, 0.0) < 0)) return 1.0;
  for (int i = 0; i < HALVINGS; i++) {
    const double middle = 0.5 * (low + high);
    if (slope(user, middle) > 0)
      high = middle;
    else
      low = middle;
  }
  return high;
}

static double assumed(sw_press *p, double friction, sw_vec s, sw_vec along) {
  p->shift = s;
  p->gap_after = p->gap + sw_dot(p->normal, s);
  return sw_dot(sw_press_borne(p, friction), along);
}

void sw_ways_add(sw_ways *w, sw_press *press, double friction, sw_vec shift) {
  if (!press->active && !sw_press_closes(press, shift)) return;
  if (SW_GROW(w->list, w->capacity, w->count + 1) != SW_OK) return;
  const double begins = assumed(press, friction, sw_v(0, 0, 0), shift);
  w->list[w->count++] =
      (sw_way){press, friction, shift, begins, assumed(press, friction, shift, shift)};
}

/* Slope of the energy at this share of the path [J]. Everything except the touches' forces is
 * linear: with the assumed forces it is in balance at the end of the path; at its beginning the
 * energy falls by the work. */
static double slope(const void *user, double share) {
  const sw_ways *w = user;
  double sum = (share - 1.0) * w->work;
  SW_ITEMS(const sw_way, t, w->list, w->count) {
    const sw_vec real = sw_press_at(t->press, t->friction, sw_scale(t->shift, share));
    sum += t->begins + share * (t->ends - t->begins) - sw_dot(real, t->shift);
  }
  return sum;
}

double sw_ways_share(sw_ways *w, double accepted) {
  if (!(w->work > 0) || !(slope(w, 1.0) > accepted * w->work)) return 1.0;
  const double share = sw_way_least(slope, w);
  SW_ITEMS(sw_way, t, w->list, w->count) {
    sw_press_go_on(t->press, t->friction, sw_scale(t->shift, share), 1);
  }
  return share;
}
