/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh of a composite of solid elements: layers around a line. One layer is the face between
 * core and shell, which share its particles. */
#include "calibrate/composite_solid.h"

#include <math.h>

static const double THIRD = 3;           /* default number of layers per radius [-] */
static const double SAME = 1e-9;         /* tolerance of equal lengths, over the radius [-] */
enum { MOST = 6, RADII = 2 * MOST + 1 }; /* most layers of a part; radii of both parts [-] */
enum { CORE_SOLID = SW_GROUP_OF_CORE + SW_GROUP_SOLID };

/* --- positions of the parts ----------------------------------------------------------- */

/* Returns the given number of layers, or one that makes elements about a third of the wire's radius
 * thick. A core of a single layer of prisms bends up to a third too stiffly by itself, because it
 * cannot bulge. */
static size_t chosen(long given, double thickness, double radius, double least) {
  const double usual = fmin(MOST, fmax(least, round(THIRD * thickness / radius)));
  return (size_t)(given ? (double)given : usual);
}

sw_status sw_composite_place_solid(const sw_composite_args *given, double radius, sw_composite *c,
                                   sw_error *err) {
  sw_composite_args a = *given;
  SW_TRY(sw_composite_check_solid(given, err));
  if (isnan(a.core_radius) && a.wall < radius) a.core_radius = radius - a.wall;
  SW_TRY(sw_composite_place(&a, radius, c, err));
  if (fabs(c->bore - c->core_radius) > SAME * radius)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_radius = %.6g m and wall = %.6g m leave a gap in radius = %.6g "
                   "m, which body = 'solid' does not have; leave one of them out",
                   c->core_radius, a.wall, radius);
  c->bore = c->core_radius;
  c->core_layers = chosen(a.core_layers, c->core_radius, radius, 2);
  c->layers = chosen(a.layers, radius - c->core_radius, radius, 1);
  c->each = 1 + c->ring * c->core_layers;
  c->ring_radius = radius;
  return SW_OK;
}

/* Fills the radii of the line, the core's layers and the shell's; returns the number of layers. */
static size_t radii(const sw_composite *c, double out[RADII]) {
  const double m = (double)c->core_layers, n = (double)c->layers;
  for (size_t k = 0; k <= c->core_layers; k++) out[k] = c->core_radius * ((double)k / m);
  for (size_t k = 1; k <= c->layers; k++)
    out[c->core_layers + k] = c->core_radius + (c->radius - c->core_radius) * ((double)k / n);
  return c->core_layers + c->layers;
}

sw_status sw_lattice_composite_solid(const sw_composite *c, double spacing, sw_lattice *l,
                                     sw_error *err) {
  double at[RADII];
  const size_t layers = radii(c, at), all = 1 + c->ring * layers;
  *l = (sw_lattice){0};
  if (all > SW_CELL_PARTICLES)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: %zu layers of %zu particles around a line are %zu in a slice; at "
                   "most %d: reduce particles, core_layers or layers",
                   layers, c->ring, all, SW_CELL_PARTICLES);
  SW_TRY(sw_lattice_layers(c->ring, layers, at, spacing, l, err));
  for (size_t m = 0; m < c->core_layers * c->ring; m++) l->solid[m].group = CORE_SOLID;
  return SW_OK;
}

/* --- masses ---------------------------------------------------------------------------- */

void sw_composite_weigh(const sw_composite *c, double core_share, sw_lattice *l) {
  const double core = c->core_radius * c->core_radius, whole = c->radius * c->radius;
  const double inside = core_share / core, outside = (1 - core_share) / (whole - core);
  double at[RADII], inner = 0;
  const size_t layers = radii(c, at);
  for (size_t k = 0; k <= layers; k++) { /* a layer has the area up to half way to the next one */
    const double middle = k < layers ? 0.5 * (at[k] + at[k + 1]) : at[k], outer = middle * middle;
    const double own = at[k] * at[k];
    const double share = (own - inner) * (k <= c->core_layers ? inside : outside) +
                         (outer - own) * (k < c->core_layers ? inside : outside);
    for (size_t s = 0; s < (k ? c->ring : 1); s++)
      l->share[k ? 1 + (k - 1) * c->ring + s : 0] = k ? share / (double)c->ring : share;
    inner = outer;
  }
}

/* --- parts alone ---------------------------------------------------------------------- */

sw_composite_areas sw_composite_measure(const sw_composite *c) {
  const double core = c->core_radius * c->core_radius, whole = c->radius * c->radius;
  return (sw_composite_areas){.shell = M_PI * (whole - core),
                              .core = M_PI * core,
                              .shell_I = 0.25 * M_PI * (whole * whole - core * core),
                              .core_I = 0.25 * M_PI * core * core};
}

sw_status sw_composite_parts(sw_composite *c, const sw_lattice *l, const double *k, sw_error *err) {
  const size_t inner = c->core_layers * c->ring;
  sw_cell part = sw_lattice_cell(l);
  part.links = 0;
  part.solids = inner;
  SW_TRY(sw_cell_stiffness(&part, k, &c->core, NULL, err));
  part.solid += inner;
  part.solids = l->solids - inner;
  return sw_cell_stiffness(&part, k, &c->shell, NULL, err);
}
