/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh of a shell around cores. Cores off the axis are copies of the first, rotated about the
 * axis, and the ring has the same symmetry: bending is the same in all planes. */
#include <math.h>

#include "base/alloc.h"
#include "calibrate/composite.h"

static const double ONE = 0.6;    /* default radius of a single core over the wire's [-] */
static const double WALL = 0.2;   /* default wall around several cores over the radius [-] */
static const double USUAL = 0.95; /* default radius of several cores over the largest fitting [-] */
static const double MOST = 0.98;  /* the same, largest: particles must not meet [-] */
static const double TIE = 1e-6;   /* relative difference of distances that count as equal [-] */
static const double BESIDE = 1.2; /* largest distance of neighbours, over the least of cores [-] */
static const long CORE_RING = 6;  /* default particles of a layer of a radial core [-] */
static const long RING = 12;      /* default particles of the shell, at least [-] */

/* --- positions of the parts ----------------------------------------------------------- */

/* Returns the number of cores around the axis. */
static size_t around(const sw_composite *c) {
  return c->cores == SW_COMPOSITE_CORES ? c->cores - 1 : c->cores;
}

/* Returns the core radius at which cores touch each other or the bore. */
static double fitting(const sw_composite *c) {
  if (c->cores == 1) return c->bore;
  const double s = sin(M_PI / (double)around(c));
  return c->bore * s / (1 + s);
}

static sw_status choose_ring(const sw_composite_args *a, sw_composite *c, sw_error *err) {
  const long n = (long)around(c);
  if (a->particles == 0) {
    c->ring = (size_t)(n * ((RING + n - 1) / n));
    return SW_OK;
  }
  if (a->particles < 3)
    return sw_fail(
        err, SW_EINVAL,
        "calibrate: particles = %ld is not allowed; it must be 0 (chooses) or in [3, 64]",
        a->particles);
  if (a->particles % n)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: particles = %ld must be a multiple of the %ld cores around the "
                   "axis, so that bending is the same in all planes: give %ld",
                   a->particles, n, n * (a->particles / n + 1));
  c->ring = (size_t)a->particles;
  return SW_OK;
}

static sw_status check_room(const sw_composite *c, sw_error *err) {
  const double most = c->cores == 1 ? c->bore : MOST * fitting(c);
  if (c->core_radius <= most * (1 + 1e-12)) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "calibrate: core_radius = %.6g m is not allowed; %zu core%s fit%s in a bore of "
                 "%.6g m with a radius in (0, %.6g] m: reduce core_radius or wall",
                 c->core_radius, c->cores, c->cores == 1 ? "" : "s", c->cores == 1 ? "s" : "",
                 c->bore, most);
}

static sw_status choose_radii(const sw_composite_args *a, sw_composite *c, sw_error *err) {
  const int one = c->cores == 1;
  double wall = a->wall;
  if (isnan(wall) && !one) wall = WALL * c->radius;
  if (!isnan(wall) && !(wall < c->radius))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: wall = %.6g m must be in (0, %.6g) m, below the wire's radius", wall,
                   c->radius);
  c->core_radius = !isnan(a->core_radius) ? a->core_radius : ONE * c->radius;
  if (isnan(wall) && !(c->core_radius < c->radius))
    return sw_fail(
        err, SW_EINVAL,
        "calibrate: core_radius = %.6g m must be in (0, %.6g) m, below the wire's radius",
        c->core_radius, c->radius);
  c->bore = isnan(wall) ? c->core_radius : c->radius - wall;
  if (isnan(a->core_radius))
    c->core_radius = one ? fmin(c->core_radius, c->bore) : USUAL * fitting(c);
  return check_room(c, err);
}

sw_status sw_composite_place(const sw_composite_args *a, double radius, sw_composite *c,
                             sw_error *err) {
  *c = (sw_composite){.cores = (size_t)a->cores, .radius = radius};
  SW_TRY(sw_composite_check(a, err));
  SW_TRY(choose_radii(a, c, err));
  SW_TRY(choose_ring(a, c, err));
  c->ring_radius = sqrt(0.5 * (radius * radius + c->bore * c->bore));
  for (size_t i = 0; c->cores > 1 && i < around(c); i++) { /* they touch the shell */
    const double angle = 2 * M_PI * (double)i / (double)around(c), d = c->bore - c->core_radius;
    c->centre[i] = sw_v(d * cos(angle), d * sin(angle), 0);
  }
  return SW_OK;
}

sw_status sw_composite_core_share(const sw_composite_args *a, const sw_composite *c, double mass,
                                  double *share, sw_error *err) {
  const double n = (double)c->cores, core = c->core_radius * c->core_radius;
  const double density = a->core_density * M_PI * core;
  const double given = isnan(density) ? a->core_mass : density;
  *share = core / (c->radius * c->radius - c->bore * c->bore + n * core);
  if (isnan(given)) return SW_OK;
  if (isnan(mass) && !isnan(density))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_density = %.6g kg/m3 goes with the shell's density [kg/m3] or "
                   "the wire's mass_per_length [kg/m]",
                   a->core_density);
  if (isnan(mass))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_mass = %.6g kg/m goes with the wire's mass_per_length [kg/m]",
                   given);
  if (!(given < mass) && !isnan(density))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_density = %.6g kg/m3 must be in (0, %.6g) kg/m3, so that the "
                   "shell has a part of the wire's mass of %.6g kg/m",
                   a->core_density, mass / (M_PI * core), mass);
  if (!(n * given < mass))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_mass = %.6g kg/m with cores = %g must be in (0, %.6g) kg/m, "
                   "so that the shell has a part of the wire's mass",
                   given, n, mass / n);
  *share = given / mass;
  return SW_OK;
}

size_t sw_composite_part(const sw_composite *c, size_t particle) {
  if (c->layers) return particle < c->each;
  return particle < c->ring ? 0 : 1 + (particle - c->ring) / c->each;
}

/* --- the cores ----------------------------------------------------------------------- */

static long divisor(long a, long b) { return b ? divisor(b, a % b) : a; }

/* Layers and ring together should be symmetric under a third of a turn or less, if possible. */
long sw_core_particles(const sw_composite_args *a, const sw_composite *c) {
  if (a->core_particles) return a->core_particles;
  if (c->cores > 1 || divisor((long)c->ring, CORE_RING) > 2) return CORE_RING;
  for (long n = CORE_RING - 1; n <= 2 * CORE_RING; n++)
    if (divisor((long)c->ring, n) > 2) return n;
  return CORE_RING;
}

long sw_core_layers(const sw_composite_args *a, const sw_composite *c) {
  return a->core_layers ? a->core_layers : c->cores == 1 ? 2 : 1;
}

long sw_core_across(const sw_composite_args *a, const sw_composite *c) {
  return a->core_across ? a->core_across : c->cores == 1 ? 4 : 2;
}

sw_status sw_lattice_core(const sw_composite_args *a, const sw_composite *c, double spacing,
                          sw_lattice *l, sw_error *err) {
  const double R = c->core_radius;
  *l = (sw_lattice){0};
  if (a->core == SW_CORE_RADIAL) {
    const sw_radial_args radial = {sw_core_particles(a, c), sw_core_layers(a, c)};
    SW_TRY(sw_lattice_radial(&radial, R, spacing, l, err));
    sw_lattice_drop_solids(l);
    return SW_OK;
  }
  if (a->core == SW_CORE_CUBIC) {
    sw_cubic_args cubic;
    sw_params_default(&sw_cubic_params, &cubic);
    cubic.across = sw_core_across(a, c);
    SW_TRY(sw_lattice_cubic(&cubic, R, spacing, l, err));
    sw_lattice_drop_solids(l);
    return SW_OK;
  }
  SW_TRY(sw_lattice_room(l, 1, err));
  l->spacing = spacing;
  sw_store(l->at, sw_v(0, 0, 0));
  l->share[0] = 1;
  return SW_OK;
}

static void copy_particles(const sw_composite *c, size_t number, const sw_lattice *core,
                           double share, sw_lattice *l) {
  const sw_vec centre = c->centre[number];
  const double d = hypot(centre.x, centre.y);
  const double cosine = d > 0 ? centre.x / d : 1, sine = d > 0 ? centre.y / d : 0;
  for (size_t i = 0; i < core->particles; i++) {
    const size_t p = c->ring + number * c->each + i;
    const sw_vec q = sw_vec_at(core->at, i);
    sw_store(l->at + 3 * p,
             sw_v(centre.x + cosine * q.x - sine * q.y, centre.y + sine * q.x + cosine * q.y, q.z));
    l->share[p] = share * core->share[i];
  }
}

static sw_status copy_links(const sw_composite *c, size_t number, const sw_lattice *core,
                            sw_lattice *l, sw_error *err) {
  const uint32_t base = (uint32_t)(c->ring + number * c->each);
  for (size_t m = 0; m < core->links; m++) {
    sw_cell_link link = core->link[m];
    link.from += base;
    link.to += base;
    link.group += SW_GROUP_OF_CORE;
    SW_TRY(sw_lattice_link(l, link, err));
  }
  if (core->links) return SW_OK;
  SW_TRY(sw_lattice_link(l, (sw_cell_link){base, base, SW_GROUP_OF_CORE + SW_GROUP_CORE, 1, 0, 1},
                         err));
  return sw_lattice_link(l, (sw_cell_link){base, base, SW_GROUP_OF_CORE + SW_GROUP_BEND, 1, 1, 1},
                         err);
}

/* --- facing particles ----------------------------------------------------------------- */

/* A body's surface: the particles that can face another body. */
typedef struct surface {
  size_t count;
  uint32_t *at;  /* particle numbers in the slice */
  double pitch;  /* distance of neighbouring particles [m] */
  sw_vec centre; /* of a core [m] */
  int shell;     /* [-] */
} surface;

/* 1 if particle i of a core is at its surface. Inner voxel corners have more mass than outer ones;
 * a core with equal masses has no inner corner. */
static int is_outer(const sw_composite_args *a, const sw_composite *c, const sw_lattice *core,
                    size_t i) {
  if (a->core == SW_CORE_RADIAL) return i + (size_t)sw_core_particles(a, c) >= core->particles;
  double most = 0, least = HUGE_VAL;
  for (size_t p = 0; p < core->particles; p++) {
    most = fmax(most, core->share[p]);
    least = fmin(least, core->share[p]);
  }
  return least > (1 - TIE) * most || core->share[i] < (1 - TIE) * most;
}

static surface ring_surface(const sw_composite *c, uint32_t *numbers) {
  for (size_t i = 0; i < c->ring; i++) numbers[i] = (uint32_t)i;
  return (surface){c->ring, numbers, 2 * c->ring_radius * sin(M_PI / (double)c->ring),
                   sw_v(0, 0, 0), 1};
}

static surface core_surface(const sw_composite_args *a, const sw_composite *c,
                            const sw_lattice *core, size_t number, uint32_t *numbers) {
  size_t n = 0;
  for (size_t i = 0; i < core->particles; i++)
    if (is_outer(a, c, core, i)) numbers[n++] = (uint32_t)(c->ring + number * c->each + i);
  return (surface){n, numbers, 2 * c->core_radius * sin(M_PI / fmax(3, (double)n)),
                   c->centre[number], 0};
}

/* Returns the gap between two bodies at a pair of facing particles: at `shell` in body a, and at
 * `core` in core b. */
static double clearance(const sw_composite *c, const surface *a, const surface *b, sw_vec shell,
                        sw_vec core) {
  if (a->shell) {
    const sw_vec wall = sw_scale(shell, c->bore / sw_norm(shell));
    return sw_dist(wall, b->centre) - c->core_radius;
  }
  const sw_vec out = sw_unit_or(sw_sub(core, b->centre), sw_sub(a->centre, b->centre));
  const sw_vec touching = sw_madd(b->centre, sw_unit_or(out, sw_v(1, 0, 0)), c->core_radius);
  return sw_dist(touching, a->centre) - c->core_radius;
}

static double nearest(const sw_lattice *l, uint32_t i, const surface *b) {
  double least = HUGE_VAL;
  for (size_t k = 0; k < b->count; k++)
    least = fmin(least, sw_dist(sw_vec_at(l->at, i), sw_vec_at(l->at, b->at[k])));
  return least;
}

static sw_status join(const sw_composite_args *args, sw_composite *c, sw_lattice *l, uint32_t i,
                      uint32_t j, double gap, sw_error *err) {
  if (args->bonded) {
    SW_TRY(sw_lattice_link(l, (sw_cell_link){i, j, SW_GROUP_BOND, 0, 0, 1}, err));
    SW_TRY(sw_lattice_link(l, (sw_cell_link){i, j, SW_GROUP_BOND, 1, 0, 1}, err));
    return sw_lattice_link(l, (sw_cell_link){j, i, SW_GROUP_BOND, 1, 0, 1}, err);
  }
  if (SW_GROW(c->slide, c->capacity, c->slides + 1) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "calibrate: out of memory");
  c->slide[c->slides++] = (sw_slide){i, j, gap};
  return SW_OK;
}

/* Pairs each particle with the nearest of the other body, or with all that are equally near, which
 * preserves symmetry. Particles that look away are skipped. */
static sw_status face(const sw_composite_args *args, sw_composite *c, const surface *a,
                      const surface *b, sw_lattice *l, sw_error *err) {
  double least = HUGE_VAL;
  for (size_t i = 0; i < a->count; i++) least = fmin(least, nearest(l, a->at[i], b));
  const double most = least + fmax(a->pitch, b->pitch);
  for (size_t i = 0; i < a->count; i++)
    for (size_t k = 0; k < b->count; k++) {
      const sw_vec p = sw_vec_at(l->at, a->at[i]), q = sw_vec_at(l->at, b->at[k]);
      const double d = sw_dist(p, q) / (1 + TIE);
      if (d > most || (d > nearest(l, a->at[i], b) && d > nearest(l, b->at[k], a))) continue;
      SW_TRY(join(args, c, l, a->at[i], b->at[k], clearance(c, a, b, p, q), err));
    }
  return SW_OK;
}

static sw_status face_all(const sw_composite_args *args, const sw_lattice *core, sw_composite *c,
                          sw_lattice *l, sw_error *err) {
  uint32_t ring[SW_CELL_PARTICLES], numbers[2][SW_CELL_PARTICLES];
  const surface shell = ring_surface(c, ring);
  double beside = HUGE_VAL;
  for (size_t i = 0; i < c->cores; i++)
    for (size_t k = 0; k < i; k++) beside = fmin(beside, sw_dist(c->centre[i], c->centre[k]));
  for (size_t i = 0; i < c->cores; i++) {
    const surface own = core_surface(args, c, core, i, numbers[0]);
    if (i < around(c)) SW_TRY(face(args, c, &shell, &own, l, err));
    for (size_t k = i + 1; k < c->cores; k++) {
      if (sw_dist(c->centre[i], c->centre[k]) > BESIDE * beside) continue;
      const surface other = core_surface(args, c, core, k, numbers[1]);
      SW_TRY(face(args, c, &own, &other, l, err));
    }
  }
  return SW_OK;
}

/* --- the whole ------------------------------------------------------------------------ */

/* Makes the shell as a tube without a central line; chords keep it round by itself. */
static sw_status shell(const sw_composite_args *a, const sw_composite *c, double spacing,
                       sw_lattice *out, sw_error *err) {
  sw_tube_args tube;
  sw_params_default(&sw_tube_params, &tube);
  tube.particles = (long)c->ring;
  tube.reach = a->reach;
  tube.ring_radius = c->ring_radius;
  tube.core = 0;
  return sw_lattice_tube(&tube, spacing, out, err);
}

static sw_status put_together(const sw_composite_args *args, const sw_lattice *ring,
                              const sw_lattice *core, double core_share, sw_composite *c,
                              sw_lattice *l, sw_error *err) {
  const double shell_share = 1 - core_share * (double)c->cores;
  SW_TRY(sw_lattice_room(l, c->ring + c->cores * c->each, err));
  l->spacing = core->spacing;
  for (size_t i = 0; i < c->ring; i++) {
    sw_store(l->at + 3 * i, sw_vec_at(ring->at, i));
    l->share[i] = shell_share / (double)c->ring;
  }
  for (size_t m = 0; m < ring->links; m++) SW_TRY(sw_lattice_link(l, ring->link[m], err));
  c->shell_links = l->links;
  for (size_t i = 0; i < c->cores; i++) {
    copy_particles(c, i, core, core_share, l);
    SW_TRY(copy_links(c, i, core, l, err));
  }
  return face_all(args, core, c, l, err);
}

sw_status sw_lattice_composite(const sw_composite_args *args, const sw_lattice *core,
                               double core_share, sw_composite *c, sw_lattice *l, sw_error *err) {
  sw_lattice ring;
  *l = (sw_lattice){0};
  c->each = core->particles;
  const size_t all = c->ring + c->cores * c->each;
  if (all > SW_CELL_PARTICLES)
    return sw_fail(
        err, SW_EINVAL,
        "calibrate: %zu particles of the ring and %zu of each core (cores = %zu) are %zu "
        "in a slice; at most %d: reduce core_layers, core_particles or core_across",
        c->ring, c->each, c->cores, all, SW_CELL_PARTICLES);
  sw_status status = shell(args, c, core->spacing, &ring, err);
  if (status == SW_OK) status = put_together(args, &ring, core, core_share, c, l, err);
  sw_lattice_free(&ring);
  return status;
}

void sw_composite_resize(sw_composite *c, sw_lattice *l, double ring_radius) {
  const double factor = ring_radius / c->ring_radius;
  for (size_t i = 0; i < c->ring; i++)
    sw_store(l->at + 3 * i, sw_scale(sw_vec_at(l->at, i), factor));
  c->ring_radius = ring_radius;
}
