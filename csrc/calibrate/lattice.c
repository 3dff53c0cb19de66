/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of all lattices, and the round lattices. */
#include "calibrate/lattice.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/vec.h"

const char *const sw_group_names[SW_GROUPS] = {"longitudinal",  "inner",
                                               "core",          "diagonal",
                                               "hoop",          "brace",
                                               "spoke",         "inclined",
                                               "edge",          "cross",
                                               "bend",          "solid",
                                               "bond",          "core_longitudinal",
                                               "core_inner",    "core_line",
                                               "core_diagonal", "core_hoop",
                                               "core_brace",    "core_spoke",
                                               "core_inclined", "core_edge",
                                               "core_cross",    "core_bend",
                                               "core_solid"};

#define AT(member) offsetof(sw_tube_args, member)
static const sw_param tube_rows[] = {
    {"particles", SW_PARAM_INTEGER, "-", 8, 3, 64, 0, NULL, AT(particles), "particles of a ring"},
    {"reach", SW_PARAM_INTEGER, "-", 0, 0, 31, 0, NULL, AT(reach),
     "particles that a diagonal spans round the ring, below half a ring; 0 chooses"},
    {"brace", SW_PARAM_INTEGER, "-", -1, -1, 32, 0, NULL, AT(brace),
     "chords from each particle of a ring to the particle this many further, 2 to half a ring; 0: "
     "none; -1: 2 if nothing else keeps the ring round"},
    {"ring_radius", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     AT(ring_radius),
     "radius of the particles' centres (not given: the wire's radius; without core, where EA and "
     "EI agree)"},
    {"core", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, AT(core),
     "a central line of particles with spokes, which adds the EA that the ring lacks"},
    {"bend", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, AT(bend),
     "springs against bending of the central line"},
};
const sw_params sw_tube_params = SW_PARAMS("calibrate", tube_rows);
#undef AT

enum { LAYERS = 6 }; /* most of a radial lattice [-] */

static const sw_param radial_rows[] = {
    {"particles", SW_PARAM_INTEGER, "-", 8, 3, 48, 0, NULL, offsetof(sw_radial_args, particles),
     "particles of each layer"},
    {"layers", SW_PARAM_INTEGER, "-", 2, 1, LAYERS, 0, NULL, offsetof(sw_radial_args, layers),
     "layers around the central line"},
};
const sw_params sw_radial_params = SW_PARAMS("calibrate", radial_rows);

sw_status sw_lattice_room(sw_lattice *l, size_t particles, sw_error *err) {
  *l = (sw_lattice){.particles = particles};
  if (particles > SW_CELL_PARTICLES)
    return sw_fail(err, SW_EINVAL, "calibrate: %zu particles in a slice; at most %d", particles,
                   SW_CELL_PARTICLES);
  l->at = sw_alloc(3 * particles, sizeof *l->at);
  l->share = sw_alloc(particles, sizeof *l->share);
  return l->at && l->share ? SW_OK : sw_fail(err, SW_ENOMEM, "calibrate: out of memory");
}

void sw_lattice_free(sw_lattice *l) {
  SW_FREE_ALL(l->at, l->share, l->link, l->solid);
  *l = (sw_lattice){0};
}

sw_status sw_lattice_link(sw_lattice *l, sw_cell_link link, sw_error *err) {
  if (SW_GROW(l->link, l->capacity, l->links + 1) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "calibrate: out of memory");
  l->link[l->links++] = link;
  return SW_OK;
}

sw_status sw_lattice_solid(sw_lattice *l, int corners, const uint32_t *corner, sw_error *err) {
  sw_cell_solid solid = {.nodes = 2 * corners, .group = SW_GROUP_SOLID};
  for (int i = 0; i < corners; i++) solid.particle[i] = solid.particle[i + corners] = corner[i];
  if (SW_GROW(l->solid, l->solid_capacity, l->solids + 1) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "calibrate: out of memory");
  l->solid[l->solids++] = solid;
  return SW_OK;
}

void sw_lattice_drop_solids(sw_lattice *l) {
  sw_free(l->solid);
  l->solid = NULL;
  l->solids = l->solid_capacity = 0;
}

void sw_lattice_keep(sw_lattice *l, unsigned groups) {
  size_t kept = 0;
  for (size_t m = 0; m < l->links; m++)
    if (groups >> l->link[m].group & 1U) l->link[kept++] = l->link[m];
  l->links = kept;
}

void sw_lattice_share(sw_lattice *l) {
  double whole = 0;
  memset(l->share, 0, l->particles * sizeof *l->share);
  SW_ITEMS(const sw_cell_solid, s, l->solid, l->solids) {
    const int corners = s->nodes / 2;
    double area = 0;
    for (int a = 0; a < corners; a++) {
      const double *p = l->at + 3 * s->particle[a], *q = l->at + 3 * s->particle[(a + 1) % corners];
      area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    for (int a = 0; a < corners; a++) l->share[s->particle[a]] += area / corners;
    whole += area;
  }
  for (size_t i = 0; i < l->particles; i++) l->share[i] /= whole;
}

void sw_lattice_scale(sw_lattice *l, double scale) {
  for (size_t i = 0; i < l->particles; i++)
    for (size_t k = 0; k < 2; k++) l->at[3 * i + k] *= scale;
}

static double radius2(const sw_lattice *l, size_t i) {
  return l->at[3 * i] * l->at[3 * i] + l->at[3 * i + 1] * l->at[3 * i + 1];
}

uint32_t sw_lattice_line(const sw_lattice *l, size_t i) {
  double gyration2 = 0, least = HUGE_VAL;
  for (size_t p = 0; p < l->particles; p++) {
    gyration2 += l->share[p] * radius2(l, p);
    least = fmin(least, radius2(l, p));
  }
  if (radius2(l, i) <= least * (1 + 1e-6) && least < 0.25 * gyration2) return SW_GROUP_CORE;
  /* lines at equal distances do not count as inner */
  return radius2(l, i) < (1 - 1e-6) * gyration2 ? SW_GROUP_INNER : SW_GROUP_LONGITUDINAL;
}

sw_cell sw_lattice_cell(const sw_lattice *l) {
  return (sw_cell){.spacing = l->spacing,
                   .particles = l->particles,
                   .links = l->links,
                   .groups = SW_GROUPS,
                   .at = l->at,
                   .link = l->link,
                   .solids = l->solids,
                   .solid = l->solid};
}

static void place(sw_lattice *l, size_t i, double r, double angle, double share) {
  sw_store(l->at + 3 * i, sw_v(r * cos(angle), r * sin(angle), 0));
  l->share[i] = share;
}

/* Adds a link between particles i and j, and its mirror image if it goes to the next slice and i is
 * not j. */
static sw_status join(sw_lattice *l, size_t i, size_t j, int slices, uint32_t group, double weight,
                      sw_error *err) {
  const uint32_t a = (uint32_t)i, b = (uint32_t)j;
  SW_TRY(sw_lattice_link(l, (sw_cell_link){a, b, group, slices, 0, weight}, err));
  if (slices == 0 || a == b) return SW_OK;
  return sw_lattice_link(l, (sw_cell_link){b, a, group, slices, 0, weight}, err);
}

/* --- tube ----------------------------------------------------------------------- */

long sw_tube_reach(const sw_tube_args *a) {
  if (a->reach > 0) return a->reach;
  return a->particles >= 12 ? a->particles / 6 : 1;
}

static sw_status check_tube(const sw_tube_args *a, sw_error *err) {
  const long M = a->particles;
  if (2 * sw_tube_reach(a) >= M)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: reach = %ld must be below half of particles = %ld: a diagonal "
                   "across the axis does not resist twist",
                   a->reach, M);
  if (a->brace == 1 || 2 * a->brace > M)
    return sw_fail(err, SW_EINVAL, "calibrate: brace = %ld must be 0 or in [2, %ld] (-1 chooses)",
                   a->brace, M / 2);
  if (a->bend && !a->core)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: bend = true goes with core = true, which has the central line");
  return SW_OK;
}

/* Returns the chord's step. Without spokes a ring of more than three particles flattens freely. */
static size_t brace_of(const sw_tube_args *a) {
  if (a->brace >= 0) return (size_t)a->brace;
  return !a->core && a->particles > 3 ? 2 : 0;
}

static sw_status ring_links(const sw_tube_args *a, sw_lattice *l, size_t i, sw_error *err) {
  const size_t M = (size_t)a->particles, brace = brace_of(a), reach = (size_t)sw_tube_reach(a);
  SW_TRY(join(l, i, i, 1, SW_GROUP_LONGITUDINAL, 1, err));
  SW_TRY(join(l, i, (i + 1) % M, 0, SW_GROUP_HOOP, 1, err));
  SW_TRY(join(l, i, (i + reach) % M, 1, SW_GROUP_DIAGONAL, 1, err));
  if (brace && !(2 * brace == M && i >= brace))
    SW_TRY(join(l, i, (i + brace) % M, 0, SW_GROUP_BRACE, 1, err));
  if (a->core) {
    SW_TRY(join(l, M, i, 0, SW_GROUP_SPOKE, 1, err));
    SW_TRY(join(l, M, i, 1, SW_GROUP_INCLINED, 1, err));
  }
  return SW_OK;
}

/* A solid wire has half of the spin inertia mass_per_length r^2, and so does a ring at r with half
 * of the mass. */
sw_status sw_lattice_tube(const sw_tube_args *a, double spacing, sw_lattice *l, sw_error *err) {
  *l = (sw_lattice){0};
  SW_TRY(check_tube(a, err));
  const size_t M = (size_t)a->particles;
  SW_TRY(sw_lattice_room(l, M + (a->core != 0), err));
  l->spacing = spacing;
  for (size_t i = 0; i < M; i++)
    place(l, i, a->ring_radius, 2 * M_PI * (double)i / (double)M,
          (a->core ? 0.5 : 1.0) / (double)M);
  if (a->core) place(l, M, 0, 0, 0.5);
  for (size_t i = 0; i < M; i++) SW_TRY(ring_links(a, l, i, err));
  if (a->core) SW_TRY(join(l, M, M, 1, SW_GROUP_CORE, 1, err));
  if (a->bend)
    SW_TRY(
        sw_lattice_link(l, (sw_cell_link){(uint32_t)M, (uint32_t)M, SW_GROUP_BEND, 1, 1, 1}, err));
  return SW_OK;
}

/* --- radial --------------------------------------------------------------------- */

typedef struct radial {
  size_t M, L;
  sw_lattice *l;
} radial;

static size_t node(const radial *r, size_t layer, size_t sector) {
  return layer == 0 ? 0 : 1 + (layer - 1) * r->M + sector % r->M;
}

/* Adds a link as a bar of the volume around it: stiffness goes with volume over length squared. */
static sw_status bar(const radial *r, size_t i, size_t j, int slices, uint32_t group,
                     sw_error *err) {
  const sw_cell cell = sw_lattice_cell(r->l);
  const sw_cell_link link = {(uint32_t)i, (uint32_t)j, group, slices, 0, 1};
  const double length = sw_cell_length(&cell, &link);
  const double share = 0.5 * (r->l->share[i] + r->l->share[j]);
  return join(r->l, i, j, slices, group, share / (length * length), err);
}

static sw_status radial_links(const radial *r, size_t layer, size_t sector, sw_error *err) {
  const size_t p = node(r, layer, sector), q = node(r, layer, sector + 1);
  const size_t in = node(r, layer - 1, sector), in2 = node(r, layer - 1, sector + 1);
  SW_TRY(bar(r, p, p, 1, sw_lattice_line(r->l, p), err));
  SW_TRY(bar(r, p, q, 0, SW_GROUP_HOOP, err));
  SW_TRY(bar(r, p, q, 1, SW_GROUP_DIAGONAL, err));
  SW_TRY(bar(r, in, p, 0, SW_GROUP_SPOKE, err));
  SW_TRY(bar(r, in, p, 1, SW_GROUP_INCLINED, err));
  if (layer == 1) return SW_OK;
  SW_TRY(bar(r, in, q, 0, SW_GROUP_CROSS, err));
  return bar(r, in2, p, 0, SW_GROUP_CROSS, err);
}

/* Prisms around the central line, hexahedra from layer to layer. */
static sw_status radial_solid(const radial *r, size_t layer, size_t sector, sw_error *err) {
  const uint32_t in = (uint32_t)node(r, layer - 1, sector), p = (uint32_t)node(r, layer, sector);
  const uint32_t q = (uint32_t)node(r, layer, sector + 1);
  const uint32_t in2 = (uint32_t)node(r, layer - 1, sector + 1);
  return sw_lattice_solid(r->l, layer == 1 ? 3 : 4, (uint32_t[]){in, p, q, in2}, err);
}

static void unit_weights(sw_lattice *l) {
  double most[SW_GROUPS] = {0};
  for (int pass = 0; pass < 2; pass++)
    SW_ITEMS(sw_cell_link, link, l->link, l->links) {
      if (pass == 0)
        most[link->group] = fmax(most[link->group], link->weight);
      else
        link->weight /= most[link->group];
    }
}

sw_status sw_lattice_layers(size_t particles, size_t layers, const double *radius, double spacing,
                            sw_lattice *l, sw_error *err) {
  const radial r = {particles, layers, l};
  const double M = (double)particles, whole = radius[layers] * radius[layers];
  double inner = 0; /* squared outer radius of the area already given to inner layers */
  SW_TRY(sw_lattice_room(l, 1 + particles * layers, err));
  l->spacing = spacing;
  for (size_t k = 0; k <= layers; k++) {
    const double middle = k < layers ? 0.5 * (radius[k] + radius[k + 1]) : radius[k];
    const double share = (middle * middle - inner) / (whole * (k ? M : 1));
    for (size_t s = 0; s < (k ? particles : 1); s++)
      place(l, node(&r, k, s), radius[k], 2 * M_PI * (double)s / M, share);
    inner = middle * middle;
  }
  SW_TRY(bar(&r, 0, 0, 1, SW_GROUP_CORE, err));
  for (size_t k = 1; k <= layers; k++)
    for (size_t s = 0; s < particles; s++) {
      SW_TRY(radial_links(&r, k, s, err));
      SW_TRY(radial_solid(&r, k, s, err));
    }
  unit_weights(l);
  return SW_OK;
}

sw_status sw_lattice_radial(const sw_radial_args *a, double radius, double spacing, sw_lattice *l,
                            sw_error *err) {
  double at[LAYERS + 1] = {0};
  for (long k = 0; k <= a->layers; k++) at[k] = radius * (double)k / (double)a->layers;
  return sw_lattice_layers((size_t)a->particles, (size_t)a->layers, at, spacing, l, err);
}
