/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solid elements between the particles of a web: prisms and hexahedra of the compressible
 * neo-Hookean body of force/solid.h. The second derivative is exact; iterations that do not
 * converge use one without negative eigenvalues. largest_share keeps iterations so short that no
 * element turns inside out; an element that starts inverted is pushed back. */
#include <math.h>

#include "base/each.h"
#include "base/simd.h"
#include "force/force.h"
#include "force/solid.h"

static void gather(const sw_web_solid *s, const double *x, double *out) {
  for (uint32_t i = 0; i < s->count; i++)
    for (size_t k = 0; k < 3; k++) out[3 * i + k] = x[3 * (size_t)s->node[i] + k];
}

/* Adds an element's stiffness. Pairs (i, j), j before i, come in the order of the slots. A block's
 * rows belong to the particle with the larger number. */
SW_HOT
static void add_stiffness(const sw_web_solid *s, const double *H, const size_t *slot, sw_field *f) {
  const size_t n = 3 * s->count, stride = f->block_stride;
  for (uint32_t i = 0; i < s->count; i++) {
    double *own = f->rows + SW_FIELD_ROW * (size_t)s->node[i];
    const double *h = H + 3 * i * n + 3 * i;
    own[0] += h[0], own[1] += h[1], own[2] += h[2];
    own[3] += h[n + 1], own[4] += h[n + 2], own[5] += h[2 * n + 2];
    for (uint32_t j = 0; j < i; j++, slot++) {
      const int upper = s->node[j] > s->node[i];
      double *to = f->blocks + *slot;
      h = upper ? H + 3 * j * n + 3 * i : H + 3 * i * n + 3 * j;
      for (size_t k = 0; k < 3; k++, to += stride, h += n)
        to[0] += h[0], to[1] += h[1], to[2] += h[2];
    }
  }
}

static sw_status eval(const void *args SW_UNUSED, sw_field *f, sw_error *err SW_UNUSED) {
  const sw_web *web = f->plan->web;
  const unsigned want = f->want | (f->cautious ? SW_SOLID_SEMIDEFINITE : 0u);
  double x[3 * SW_SOLID_NODES], g[3 * SW_SOLID_NODES], H[9 * SW_SOLID_NODES * SW_SOLID_NODES];
  for (size_t n = 0; n < web->solids; n++) {
    const sw_web_solid *s = &web->solid[n];
    const sw_solid *shape = (const sw_solid *)web->shapes + sw_plan_shape(f->plan, s);
    gather(s, f->x, x);
    const double energy = sw_solid_eval(shape, x, want, g, H);
    if (f->want & SW_WANT_ENERGY) f->energy += energy;
    for (uint32_t i = 0; i < s->count && f->want & SW_WANT_FORCE; i++)
      for (size_t k = 0; k < 3; k++) f->force[3 * (size_t)s->node[i] + k] -= g[3 * i + k];
    if (f->want & SW_WANT_STIFFNESS)
      add_stiffness(s, H, f->solid_slot + SW_FIELD_SOLID_PAIRS * n, f);
  }
  return SW_OK;
}

static double largest_share(const void *args SW_UNUSED, const sw_field *f, const double *delta) {
  const sw_web *web = f->plan->web;
  double from[3 * SW_SOLID_NODES], move[3 * SW_SOLID_NODES], share = 1.0;
  SW_ITEMS(const sw_web_solid, s, web->solid, web->solids) {
    gather(s, f->x, from);
    gather(s, delta, move);
    share = fmin(share, sw_solid_step((const sw_solid *)web->shapes + sw_plan_shape(f->plan, s),
                                      from, move));
  }
  return share;
}

static double stable_dt(const void *args SW_UNUSED, const sw_plan *plan) {
  return plan->web->solid_rate2 > 0 ? 2.0 / sqrt(plan->web->solid_rate2) : HUGE_VAL;
}

const sw_force_class sw_force_neo_hooke = {
    .name = "neo_hooke",
    .summary = "solid elements between the particles of a mesh",
    .stores = "solid",
    .flags = SW_FORCE_INNER | SW_FORCE_ANY_BODY,
    .params = {"force neo_hooke", NULL, 0},
    .eval = eval,
    .stable_dt = stable_dt,
    .largest_share = largest_share,
};
