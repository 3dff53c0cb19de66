/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/strand.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "force/solid.h"
#include "state/hinge.h"

/* Particles at a surface are this far inside of it, so that what touches them has a side; of the
 * radius [-]. Solid elements have their section's own size, and the thinnest skin that keeps a
 * particle out of what it touches; the ring of a composite's shell lies in its wall. */
static const double SKIN = 0.1, THINNEST = 0.03;

static double inset(const sw_strand_plan *p) {
  const int whole = p->body == SW_BODY_SOLID || strcmp(p->mesh, "composite") == 0;
  return whole ? 0.0 : SKIN;
}

/* How far the surface is outside of the outermost particles. */
static double skin_of(const sw_lattice *l, double radius) {
  double most = 0;
  for (size_t i = 0; i < l->particles; i++)
    most = fmax(most, hypot(l->at[3 * i], l->at[3 * i + 1]));
  return fmax(THINNEST * radius, radius - most);
}

/* --- calibration -------------------------------------------------------------------- */

static sw_status calibrate(const sw_strand_plan *p, const sw_beam *beam, double spacing,
                           double tolerance, sw_calibration *out, sw_error *err) {
  const sw_calibrate_args args = {.mesh = sw_calibrate_mesh(p->mesh),
                                  .squeeze = p->squeeze,
                                  .spacing = spacing,
                                  .tolerance = tolerance,
                                  .body = p->body};
  sw_lattice_args lattice = p->lattice;
  sw_section section = p->section;
  sw_error why = {""};
  section.E = section.density = section.spin_inertia = (double)NAN;
  if (p->body == SW_BODY_SPRINGS) section.nu = (double)NAN;
  section.EA = beam->EA, section.EI = beam->EI_axis[0], section.GJ = beam->GJ;
  section.mass_per_length = beam->mass;
  section.radius = (1.0 - inset(p)) * beam->radius;
  if (section.EI2 > 0) lattice.cubic.EI2 = section.EI2;
  section.EI2 = (double)NAN;
  if (args.mesh == SW_LATTICE_COMPOSITE && !lattice.composite.bonded)
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': bonded = false is for sw.calibrate only; in a scene parts of a "
                   "composite are bonded",
                   p->name);
  const sw_status status = sw_calibrate(&args, &section, &lattice, out, &why);
  if (status == SW_OK) return SW_OK;
  const char *text = strncmp(why.text, "calibrate: ", 11) == 0 ? why.text + 11 : why.text;
  return sw_fail(err, status, "wire '%s' as %s: %.400s", p->name, p->mesh, text);
}

sw_status sw_strand_slices(const sw_strand_plan *p, const sw_beam *beam, double length, size_t *out,
                           sw_error *err) {
  double spacing = p->spacing;
  if (isnan(spacing)) {
    sw_calibration any = {0};
    const sw_status status = calibrate(p, beam, spacing, 1.0, &any, err);
    spacing = any.lattice.spacing;
    sw_calibration_free(&any);
    SW_TRY(status);
  }
  const double count = ceil(length / spacing - 1e-6);
  if (!(count < 1e7))
    return sw_fail(err, SW_EINVAL, "wire '%s': slices of %g m are too many", p->name, spacing);
  *out = (size_t)fmax(2.0, count);
  return SW_OK;
}

/* --- the mesh of particles ------------------------------------------------------------ */

typedef struct maker {
  const sw_strand_plan *plan;
  const sw_lattice *lattice;
  const sw_mesh *mesh;
  const double *k; /* of groups */
  sw_web *web;
  sw_strand *strand;
} maker;

/* Share of a link that lies within ring r: those of the ends belong to half a slice. */
static double ring_share(const maker *m, const sw_cell_link *link, size_t r) {
  return link->slices == 0 && (r == 0 || r + 1 == m->mesh->n) ? 0.5 : 1.0;
}

/* Does the link that starts at ring r end on the wire? A bend spring needs a ring before. */
static int fits(const maker *m, const sw_cell_link *link, size_t r) {
  if (link->bend) return r > 0 && r + 1 < m->mesh->n;
  return r + (size_t)link->slices < m->mesh->n;
}

/* Unstressed length: of the drawn shape, or of the straight lattice, twisted at rest. */
static double rest_length(const maker *m, const sw_cell_link *link, size_t r) {
  const size_t n = m->lattice->particles;
  if (m->plan->curved)
    return sw_dist(sw_vec_at(m->strand->x, r * n + link->from),
                   sw_vec_at(m->strand->x, (r + (size_t)link->slices) * n + link->to));
  const double z = (double)link->slices * m->lattice->spacing, turn = m->plan->rest_twist * z;
  const double *a = m->lattice->at + 3 * (size_t)link->from;
  const double *b = m->lattice->at + 3 * (size_t)link->to;
  const double x = cos(turn) * b[0] - sin(turn) * b[1], y = sin(turn) * b[0] + cos(turn) * b[1];
  return sqrt((x - a[0]) * (x - a[0]) + (y - a[1]) * (y - a[1]) + z * z);
}

static void add_links(maker *m) {
  const size_t n = m->lattice->particles;
  size_t links = 0, folds = 0;
  for (size_t r = 0; r < m->mesh->n; r++) {
    m->web->ring_links[r] = links;
    for (size_t i = 0; i < m->lattice->links; i++) {
      const sw_cell_link *link = &m->lattice->link[i];
      if (!fits(m, link, r)) continue;
      const double k = m->k[link->group] * link->weight * ring_share(m, link, r);
      const uint32_t from = (uint32_t)(r * n) + link->from;
      const uint32_t to = (uint32_t)((r + (size_t)link->slices) * n) + link->to;
      if (link->bend)
        m->web->fold[folds++] = (sw_web_fold){from - (uint32_t)n, from, from + (uint32_t)n, k};
      else
        m->web->link[links++] = (sw_web_link){from, to, k, rest_length(m, link, r)};
    }
  }
  m->web->ring_links[m->mesh->n] = links;
}

/* Rest places of an element's corners, of a shape that serves all slices unless the wire is
 * curved at rest. */
static void rest_corners(const maker *m, const sw_cell_solid *e, size_t r, double *out) {
  const size_t n = m->lattice->particles, half = (size_t)e->nodes / 2;
  for (size_t i = 0; i < (size_t)e->nodes; i++) {
    const size_t next = i >= half;
    const double *at = m->lattice->at + 3 * (size_t)e->particle[i];
    const double z = next ? m->lattice->spacing : 0.0, turn = m->plan->rest_twist * z;
    sw_vec p = sw_v(cos(turn) * at[0] - sin(turn) * at[1], sin(turn) * at[0] + cos(turn) * at[1],
                    at[2] + z);
    if (m->plan->curved) p = sw_vec_at(m->strand->x, (r + next) * n + e->particle[i]);
    sw_store(out + 3 * i, p);
  }
}

static sw_status prepare_shapes(maker *m) {
  const sw_lattice *l = m->lattice;
  const size_t slices = m->plan->curved ? m->mesh->n - 1 : 1;
  const double E = m->k[SW_GROUP_SOLID], nu = m->strand->calibration.nu;
  const double mu = 0.5 * E / (1.0 + nu), lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  sw_solid *shape = sw_alloc(slices * l->solids, sizeof *shape);
  if (!shape) return SW_ENOMEM;
  m->web->shapes = shape;
  m->web->shape_count = slices * l->solids;
  for (size_t k = 0; k < m->web->shape_count; k++) {
    double rest[3 * SW_SOLID_NODES];
    const sw_cell_solid *e = &l->solid[k % l->solids];
    rest_corners(m, e, k / l->solids, rest);
    SW_TRY(sw_solid_prepare(e->nodes, rest, mu, lambda, &shape[k]));
  }
  return SW_OK;
}

static sw_status add_solids(maker *m) {
  const sw_lattice *l = m->lattice;
  const size_t n = l->particles, rings = m->mesh->n;
  if (l->solids) SW_TRY(prepare_shapes(m));
  for (size_t r = 0; r < rings; r++) {
    m->web->ring_solids[r] = r * l->solids;
    for (size_t k = 0; k < l->solids && r + 1 < rings; k++) {
      const sw_cell_solid *e = &l->solid[k];
      sw_web_solid *to = &m->web->solid[r * l->solids + k];
      to->count = (uint32_t)e->nodes;
      to->shape = (uint32_t)((m->plan->curved ? r * l->solids : 0) + k);
      for (int i = 0; i < e->nodes; i++)
        to->node[i] = (uint32_t)((r + (2 * i >= e->nodes)) * n) + e->particle[i];
    }
  }
  m->web->ring_solids[rings] = m->web->solids;
  return SW_OK;
}

static void count_links(const maker *m, size_t *links, size_t *folds) {
  *links = *folds = 0;
  for (size_t r = 0; r < m->mesh->n; r++)
    for (size_t i = 0; i < m->lattice->links; i++)
      if (fits(m, &m->lattice->link[i], r)) *(m->lattice->link[i].bend ? folds : links) += 1;
}

/* The particles of a section that lie on its convex outline, in their order round it: those
 * inside by more than rounding are left out. */
static void find_around(const sw_lattice *l, sw_web *w) {
  const size_t n = l->particles;
  size_t first = 0;
  for (size_t i = 1; i < n; i++)
    if (l->at[3 * i] > l->at[3 * first]) first = i;
  size_t at = first;
  do { /* wrap the section: the next one has all others on its left */
    w->around[w->around_count++] = (uint32_t)at;
    size_t next = at == 0 && n > 1;
    const double *p = l->at + 3 * at;
    for (size_t i = 0; i < n; i++) {
      const double *q = l->at + 3 * i, *o = l->at + 3 * next;
      const double ux = o[0] - p[0], uy = o[1] - p[1], vx = q[0] - p[0], vy = q[1] - p[1];
      const double cross = ux * vy - uy * vx, size = hypot(ux, uy) * hypot(vx, vy);
      const int straight = fabs(cross) <= 1e-9 * size;
      if (i == at || i == next || size == 0) continue;
      if (cross < 0 && !straight) next = i;
      if (straight && ux * vx + uy * vy > 0 && hypot(vx, vy) < hypot(ux, uy)) next = i;
    }
    at = next;
  } while (at != first && w->around_count < n);
}

sw_status sw_strand_bound_solids(sw_web *w, const double *x) {
  double at[3 * SW_SOLID_NODES], H[9 * SW_SOLID_NODES * SW_SOLID_NODES];
  double *sum = sw_alloc(w->particles, sizeof *sum);
  if (!sum) return SW_ENOMEM;
  for (size_t n = 0; n < w->solids; n++) {
    const sw_web_solid *s = &w->solid[n];
    const size_t size = 3 * s->count;
    for (uint32_t i = 0; i < s->count; i++) sw_store(at + 3 * i, sw_vec_at(x, s->node[i]));
    sw_solid_eval((const sw_solid *)w->shapes + s->shape, at, SW_WANT_STIFFNESS, NULL, H);
    for (size_t r = 0; r < size; r++) {
      double row = 0;
      for (size_t c = 0; c < size; c++) row += fabs(H[r * size + c]);
      sum[s->node[r / 3]] += row / 3.0; /* of three directions the mean */
    }
  }
  w->solid_rate2 = 0;
  for (size_t p = 0; p < w->particles; p++)
    w->solid_rate2 = fmax(w->solid_rate2, sum[p] / w->mass[p]);
  sw_free(sum);
  return SW_OK;
}

static sw_status fill_web(maker *m) {
  const sw_lattice *l = m->lattice;
  sw_web *w = m->web;
  const size_t n = l->particles, rings = m->mesh->n;
  w->rings = rings, w->per_ring = n;
  w->banded = w->folds == 0;
  w->share = sw_alloc(n, sizeof *w->share);
  w->section = sw_alloc(2 * n, sizeof *w->section);
  w->around = sw_alloc(n, sizeof *w->around);
  w->ring_links = sw_alloc(rings + 1, sizeof *w->ring_links);
  w->ring_solids = sw_alloc(rings + 1, sizeof *w->ring_solids);
  if (!w->share || !w->section || !w->around || !w->ring_links || !w->ring_solids) return SW_ENOMEM;
  w->axis = (uint32_t)n;
  for (size_t i = 0; i < n; i++) {
    w->share[i] = l->share[i];
    w->section[2 * i] = l->at[3 * i], w->section[2 * i + 1] = l->at[3 * i + 1];
    if (hypot(l->at[3 * i], l->at[3 * i + 1]) < 1e-9 * l->spacing) w->axis = (uint32_t)i;
  }
  const double slice = m->strand->calibration.mass_per_length * l->spacing;
  for (size_t r = 0; r < rings; r++)
    for (size_t i = 0; i < n; i++) {
      w->mass[r * n + i] = slice * l->share[i] * (r == 0 || r + 1 == rings ? 0.5 : 1.0);
      w->s[r * n + i] = m->mesh->s[r];
    }
  add_links(m);
  SW_TRY(add_solids(m));
  find_around(l, w);
  SW_TRY(sw_strand_bound_solids(w, m->strand->x));
  SW_TRY(sw_web_bound_rate(w));
  return sw_web_add_surface(w);
}

/* Particles across the line that the mesh's nodes are, sections carried along without twist. */
static void place_particles(const maker *m) {
  const sw_mesh *mesh = m->mesh;
  const size_t n = m->lattice->particles;
  sw_vec t = sw_mesh_tangent(mesh, 0);
  const sw_vec wanted = sw_madd(m->plan->normal, t, -sw_dot(m->plan->normal, t));
  sw_vec u = isfinite(wanted.x) ? sw_unit_or(wanted, sw_perpendicular(t)) : sw_perpendicular(t);
  for (size_t r = 0; r < mesh->n; r++) {
    const sw_vec next = sw_mesh_tangent(mesh, r), middle = sw_vec_at(mesh->x, r);
    u = sw_carry_unit(u, t, next);
    t = next;
    const sw_vec w = sw_cross(t, u);
    for (size_t i = 0; i < n; i++) {
      const double *at = m->lattice->at + 3 * i;
      const sw_vec across = sw_madd(sw_scale(u, at[0]), w, at[1]);
      sw_store(m->strand->x + 3 * (r * n + i), sw_madd(sw_add(middle, across), t, at[2]));
    }
  }
}

static sw_status new_particles(maker *m, size_t particles, size_t links) {
  sw_strand *s = m->strand;
  s->x = sw_alloc(3 * particles, sizeof *s->x);
  s->v = sw_alloc(3 * particles, sizeof *s->v);
  s->a = sw_alloc(3 * particles, sizeof *s->a);
  s->axial = sw_alloc(links, sizeof *s->axial);
  if (!s->x || !s->v || !s->a || !s->axial) return SW_ENOMEM;
  place_particles(m);
  return SW_OK;
}

static sw_status make(maker *m) {
  size_t links, folds;
  const size_t particles = m->mesh->n * m->lattice->particles;
  count_links(m, &links, &folds);
  SW_TRY(sw_web_new(particles, links, folds, (m->mesh->n - 1) * m->lattice->solids, &m->web));
  m->strand->web = m->web;
  SW_TRY(new_particles(m, particles, links));
  SW_TRY(fill_web(m));
  const double *x = m->strand->x;
  for (size_t e = 0; e < links; e++) {
    const sw_web_link *link = &m->web->link[e];
    const double l = sw_dist(sw_vec_at(x, link->a), sw_vec_at(x, link->b));
    m->strand->axial[e] = link->k * (l - link->rest);
  }
  return SW_OK;
}

enum { MOST_PARTICLES = 1000000 }; /* their matrices take gigabytes */

static sw_status check_count(const sw_strand_plan *p, size_t rings, size_t per_ring,
                             sw_error *err) {
  if (rings * per_ring <= MOST_PARTICLES) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "wire '%s': %zu slices of %zu particles or more are too many; at most %d "
                 "particles are allowed",
                 p->name, rings - 1, per_ring, (int)MOST_PARTICLES);
}

/* An angle alone does not tell which way three particles are bent at rest. */
static sw_status check_rest(const sw_strand_plan *p, const sw_lattice *l, sw_error *err) {
  for (size_t i = 0; p->curved && i < l->links; i++)
    if (l->link[i].bend)
      return sw_fail(
          err, SW_EINVAL,
          "wire '%s': rest = 'path' needs a mesh without springs against bending, which "
          "are straight at rest; make %s",
          p->name,
          strcmp(p->mesh, "composite") == 0 ? "core = 'radial' or 'cubic'" : "bend = false");
  return SW_OK;
}

sw_status sw_strand_new(const sw_strand_plan *plan, const sw_beam *beam, const sw_mesh *mesh,
                        sw_strand *out, sw_error *err) {
  const double spacing = (mesh->s[mesh->n - 1] - mesh->s[0]) / (double)(mesh->n - 1);
  memset(out, 0, sizeof *out);
  SW_TRY(check_count(plan, mesh->n, 1, err));
  SW_TRY(calibrate(plan, beam, spacing, 1e-6, &out->calibration, err));
  SW_TRY(check_count(plan, mesh->n, out->calibration.lattice.particles, err));
  SW_TRY(check_rest(plan, &out->calibration.lattice, err));
  maker m = {.plan = plan,
             .lattice = &out->calibration.lattice,
             .mesh = mesh,
             .k = out->calibration.k,
             .strand = out};
  if (make(&m) != SW_OK) return sw_fail(err, SW_ENOMEM, "wire '%s': out of memory", plan->name);
  out->web->skin = skin_of(m.lattice, beam->radius);
  return SW_OK;
}

void sw_strand_free(sw_strand *s) {
  sw_web_release(s->web);
  sw_calibration_free(&s->calibration);
  sw_free(s->x);
  sw_free(s->v);
  sw_free(s->a);
  sw_free(s->axial);
  memset(s, 0, sizeof *s);
}
