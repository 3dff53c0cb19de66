/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes objects of particles that a user puts together link by link: checks the parts and makes a
 * web without rings. */
#include "edit/particles.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "body/build.h"
#include "edit/edit.h"
#include "edit/forces.h"
#include "force/solid.h"
#include "scene/parts.h"
#include "scene/scene.h"
#include "scene/wire.h"
#include "state/mesh.h"

static const sw_param rows[] = {
    SW_NAME_ROW(sw_particles_args),
    {"positions", SW_PARAM_OTHER, "m", 0, 0, 0, SW_PARAM_REQUIRED, NULL, 0,
     "list of points {x, y, z}, or of the numbers x1, y1, z1, x2 and so on"},
    {"masses", SW_PARAM_OTHER, "kg", 0, 0, 0, SW_PARAM_REQUIRED, NULL, 0,
     "of each particle: one number for all, or a list"},
    {"links", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "springs: list of {i, j, k = [N/m]} or {pairs = {i1, j1, i2, ...}, k =}, with rest [m], yield "
     "and hardening [-]"},
    {"folds", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "bending of three particles in a row: list of {i, j, k, stiffness = [N m]} or {triples = "
     "{...}, "
     "stiffness =}"},
    {"elements", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "solids: list of {prisms = {6 numbers each}} or {hexes = {8 each}} with mu and lambda, or E "
     "and "
     "nu [Pa], [-]"},
    {"surface", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "surface that touches obstacles: 'particles', or a list of edges {i, j} and triangles {i, j, "
     "k} (default: all links, or the outside of the elements)"},
    {"radius", SW_PARAM_NUMBER, "m", NAN, 0, 1e3, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_particles_args, radius),
     "of the surface: its distance from particles and edges (default: a tenth of the shortest "
     "link)"},
    {"repel", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "{distance = [m], stiffness = [N/m]}: particles without a link that come closer push each "
     "other apart"},
};
const sw_params sw_particles_params = SW_PARAMS("particles", rows);

static const sw_param repel_rows[] = {
    {"distance", SW_PARAM_NUMBER, "m", NAN, 0, 1e6, SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_repel_pairs, distance), "below which two particles push each other apart"},
    {"stiffness", SW_PARAM_NUMBER, "N/m", NAN, 0, 1e15, SW_PARAM_REQUIRED | SW_PARAM_ABOVE_MIN,
     NULL, offsetof(sw_repel_pairs, stiffness), "force over the shortfall of the distance"},
};
const sw_params sw_repel_pairs_params = SW_PARAMS("particles: repel", repel_rows);

static const sw_wire_class particles_class = {
    .name = "particles",
    .summary = "particles with links, folds and elements",
    .recipe = sw_web_recipe,
    .mesh = "particles",
};

const sw_wire_class *sw_scene_body_class(const char *name) {
  return strcmp(name, particles_class.name) == 0 ? &particles_class : sw_wire_find(name);
}

static const double USUAL_RADIUS = 0.1; /* of the shortest link [-] */
static const size_t MOST = 100000000;   /* of each kind of part [-] */

/* --- checks -------------------------------------------------------------------------- */

static sw_status check_particles(const maker *m) {
  const sw_particles_parts *p = m->parts;
  if (!p->count) return sw_fail(m->err, SW_EINVAL, "particles '%s': there is no particle", m->name);
  if (p->count > MOST || p->links > MOST || p->folds > MOST || p->elements > MOST)
    return sw_fail(m->err, SW_ELIMIT, "particles '%s': more than %zu parts", m->name, MOST);
  for (size_t i = 0; i < p->count; i++) {
    const sw_vec x = sw_vec_at(p->positions, i);
    const double most = fmax(fabs(x.x), fmax(fabs(x.y), fabs(x.z)));
    if (!sw_finite(x) || most > 1e9)
      return sw_fail(m->err, SW_EINVAL,
                     "particles '%s': position %zu = {%g, %g, %g} m is not allowed; it must be "
                     "finite, in [-1e9, 1e9] m",
                     m->name, i + 1, x.x, x.y, x.z);
    if (!(p->masses[i] > 0) || !(p->masses[i] < 1e15))
      return sw_fail(m->err, SW_EINVAL,
                     "particles '%s': mass %zu = %g kg is not allowed; it must be in (0, 1e15) kg",
                     m->name, i + 1, p->masses[i]);
  }
  return SW_OK;
}

/* Checks that these particles exist, and that none occurs twice. */
static sw_status check_numbers(const maker *m, const char *what, size_t number,
                               const uint32_t *node, size_t count) {
  for (size_t i = 0; i < count; i++) {
    if (node[i] >= m->parts->count)
      return sw_fail(m->err, SW_EINVAL,
                     "particles '%s': %s %zu names particle %lu; there are %zu, from 1 on", m->name,
                     what, number + 1, (unsigned long)node[i] + 1, m->parts->count);
    for (size_t j = 0; j < i; j++)
      if (node[i] == node[j])
        return sw_fail(m->err, SW_EINVAL, "particles '%s': %s %zu names particle %lu twice",
                       m->name, what, number + 1, (unsigned long)node[i] + 1);
  }
  return SW_OK;
}

static sw_status check_value(const maker *m, const char *what, size_t number, const char *key,
                             double value, double least, const char *unit) {
  if (value > least && value < 1e30) return SW_OK;
  return sw_fail(m->err, SW_EINVAL,
                 "particles '%s': %s %zu: %s = %g%s%s is not allowed; it must be above %g", m->name,
                 what, number + 1, key, value, *unit ? " " : "", unit, least);
}

static double distance(const maker *m, uint32_t a, uint32_t b) {
  return sw_dist(sw_vec_at(m->parts->positions, a), sw_vec_at(m->parts->positions, b));
}

static sw_status check_link(maker *m, size_t i) {
  const sw_particles_link *l = &m->parts->link[i];
  const uint32_t node[2] = {l->a, l->b};
  SW_TRY(check_numbers(m, "link", i, node, 2));
  SW_TRY(check_value(m, "link", i, "k", l->k, 0, "N/m"));
  const double as_it_lies = distance(m, l->a, l->b);
  if (!(as_it_lies > 0))
    return sw_fail(
        m->err, SW_EINVAL,
        "particles '%s': link %zu joins particles %lu and %lu, which are at the same place",
        m->name, i + 1, (unsigned long)l->a + 1, (unsigned long)l->b + 1);
  const double rest = isnan(l->rest) ? as_it_lies : l->rest;
  SW_TRY(check_value(m, "link", i, "rest", rest, 0, "m"));
  m->shortest = fmin(m->shortest, rest);
  if (isnan(l->yield)) return SW_OK;
  m->yields = 1;
  SW_TRY(check_value(m, "link", i, "yield", l->yield, 0, ""));
  if (l->hardening >= 0 && l->hardening < 1e6) return SW_OK;
  return sw_fail(m->err, SW_EINVAL,
                 "particles '%s': link %zu: hardening = %g is not allowed; it must be in [0, 1e6)",
                 m->name, i + 1, l->hardening);
}

typedef struct numbered {
  uint32_t a, b;
  size_t number;
} numbered;

static int by_nodes(const void *left, const void *right) {
  const numbered *p = left, *q = right;
  if (p->a != q->a) return p->a < q->a ? -1 : 1;
  if (p->b != q->b) return p->b < q->b ? -1 : 1;
  return p->number < q->number ? -1 : p->number > q->number;
}

/* Refuses two springs between the same particles: they are more often a mistake than intended. */
static sw_status check_twins(const maker *m) {
  const sw_particles_parts *p = m->parts;
  numbered *list SW_LOCAL = sw_alloc(p->links, sizeof *list);
  if (!list) return SW_ENOMEM;
  for (size_t i = 0; i < p->links; i++) {
    const uint32_t a = p->link[i].a, b = p->link[i].b;
    list[i] = (numbered){a < b ? a : b, a < b ? b : a, i};
  }
  qsort(list, p->links, sizeof *list, by_nodes);
  for (size_t i = 1; i < p->links; i++)
    if (list[i].a == list[i - 1].a && list[i].b == list[i - 1].b)
      return sw_fail(m->err, SW_EINVAL,
                     "particles '%s': links %zu and %zu both join particles %lu and %lu", m->name,
                     list[i - 1].number + 1, list[i].number + 1, (unsigned long)list[i].a + 1,
                     (unsigned long)list[i].b + 1);
  return SW_OK;
}

static sw_status check_fold(const maker *m, size_t i) {
  const sw_particles_fold *f = &m->parts->fold[i];
  const uint32_t node[3] = {f->a, f->b, f->c};
  SW_TRY(check_numbers(m, "fold", i, node, 3));
  SW_TRY(check_value(m, "fold", i, "stiffness", f->stiffness, 0, "N m"));
  if (distance(m, f->a, f->b) > 0 && distance(m, f->b, f->c) > 0) return SW_OK;
  return sw_fail(m->err, SW_EINVAL, "particles '%s': fold %zu has particles at the same place",
                 m->name, i + 1);
}

static sw_status check_element(maker *m, size_t i) {
  const sw_particles_element *e = &m->parts->element[i];
  if (e->count != SW_SOLID_PRISM && e->count != SW_SOLID_HEX)
    return sw_fail(m->err, SW_EINVAL,
                   "particles '%s': element %zu has %u particles; it must have 6 or 8", m->name,
                   i + 1, e->count);
  SW_TRY(check_numbers(m, "element", i, e->node, e->count));
  if (!(e->mu > 0) || !(e->mu < 1e30) || !(e->lambda + 2.0 / 3 * e->mu > 0) || !(e->lambda < 1e30))
    return sw_fail(m->err, SW_EINVAL,
                   "particles '%s': element %zu: mu = %g Pa, lambda = %g Pa is not a material; mu "
                   "and lambda + 2/3 mu must be above 0",
                   m->name, i + 1, e->mu, e->lambda);
  for (uint32_t k = 1; k < e->count; k++)
    m->shortest = fmin(m->shortest, distance(m, e->node[k - 1], e->node[k]));
  return SW_OK;
}

static sw_status check_surface(const maker *m) {
  const sw_particles_parts *p = m->parts;
  for (size_t i = 0; i < p->edges; i++)
    SW_TRY(check_numbers(m, "surface edge", i, p->edge + 2 * i, 2));
  return SW_OK;
}

static sw_status check(maker *m, const sw_particles_args *args) {
  m->shortest = HUGE_VAL;
  SW_TRY(check_particles(m));
  for (size_t i = 0; i < m->parts->links; i++) SW_TRY(check_link(m, i));
  SW_TRY(check_twins(m));
  for (size_t i = 0; i < m->parts->folds; i++) SW_TRY(check_fold(m, i));
  for (size_t i = 0; i < m->parts->elements; i++) SW_TRY(check_element(m, i));
  SW_TRY(check_surface(m));
  m->radius = isnan(args->radius) ? USUAL_RADIUS * m->shortest : args->radius;
  if (m->radius > 0 && isfinite(m->radius)) return SW_OK;
  return sw_fail(
      m->err, SW_EINVAL,
      "particles '%s': radius is required [m] without links: the surface that touches needs one",
      m->name);
}

/* --- the web -------------------------------------------------------------------------- */

static sw_status fill_links(const maker *m) {
  sw_web *w = m->web;
  if (m->yields) {
    SW_TRY(SW_ALLOC_ALL(SW_ROOM(w->yield, w->links), SW_ROOM(w->hardening, w->links)));
  }
  for (size_t i = 0; i < w->links; i++) {
    const sw_particles_link *l = &m->parts->link[i];
    const double rest = isnan(l->rest) ? distance(m, l->a, l->b) : l->rest;
    w->link[i] = (sw_web_link){l->a, l->b, l->k, rest};
    if (m->yields) w->yield[i] = l->yield, w->hardening[i] = l->hardening;
  }
  for (size_t i = 0; i < w->folds; i++) {
    const sw_particles_fold *f = &m->parts->fold[i];
    w->fold[i] = (sw_web_fold){f->a, f->b, f->c, f->stiffness, 0};
  }
  return SW_OK;
}

/* Adds the row sums of an element's stiffness. By Gershgorin's theorem the square of no frequency
 * exceeds the largest row sum over the mass of its particle. */
static void bound_solid(const sw_solid *e, const sw_web_solid *s, const double *x, double *sums) {
  double H[9 * SW_SOLID_NODES * SW_SOLID_NODES], g[3 * SW_SOLID_NODES];
  const size_t n = 3 * s->count;
  sw_solid_eval(e, x, SW_WANT_FORCE | SW_WANT_STIFFNESS, g, H);
  for (size_t r = 0; r < n; r++)
    for (size_t c = 0; c < n; c++) sums[3 * (size_t)s->node[r / 3] + r % 3] += fabs(H[r * n + c]);
}

static sw_status fill_solids(const maker *m) {
  sw_web *w = m->web;
  if (!w->solids) return SW_OK;
  sw_solid *shape = sw_alloc(w->solids, sizeof *shape);
  double *sums SW_LOCAL = sw_alloc(3 * w->particles, sizeof *sums);
  w->shapes = shape, w->shape_count = w->solids;
  sw_status status = shape && sums ? SW_OK : SW_ENOMEM;
  for (size_t i = 0; i < w->solids && status == SW_OK; i++) {
    const sw_particles_element *e = &m->parts->element[i];
    double x[3 * SW_SOLID_NODES];
    w->solid[i] = (sw_web_solid){.count = e->count, .shape = (uint32_t)i};
    for (uint32_t k = 0; k < e->count; k++) {
      w->solid[i].node[k] = e->node[k];
      sw_store(x + 3 * k, sw_vec_at(m->parts->positions, e->node[k]));
    }
    status = sw_solid_prepare((int)e->count, x, e->mu, e->lambda, &shape[i]);
    if (status == SW_EINVAL)
      sw_fail(m->err, status,
              "particles '%s': element %zu has no volume, is inverted or too much distorted; its "
              "first half must be a face, anticlockwise as seen from the second half",
              m->name, i + 1);
    if (status == SW_OK) bound_solid(&shape[i], &w->solid[i], x, sums);
  }
  for (size_t k = 0; k < 3 * w->particles && status == SW_OK; k++) {
    w->solid_rate2 = fmax(w->solid_rate2, sums[k] / w->mass[k / 3]);
    w->behind[k / 3] += 0.5 * sums[k] / 3.0;
  }
  return status;
}

/* Finds the bounding box. Its diagonal is the object's length; each particle's arc length is its
 * place along it. */
static void measure_size(maker *m) {
  sw_vec low = sw_load(m->parts->positions), high = low;
  for (size_t i = 1; i < m->parts->count; i++) {
    const sw_vec x = sw_vec_at(m->parts->positions, i);
    low = sw_v(fmin(low.x, x.x), fmin(low.y, x.y), fmin(low.z, x.z));
    high = sw_v(fmax(high.x, x.x), fmax(high.y, x.y), fmax(high.z, x.z));
  }
  if (!(sw_dist(low, high) > 0)) high = sw_add(low, sw_v(2 * m->radius, 0, 0));
  m->low = low, m->high = high;
  m->web->length = sw_dist(low, high);
  const sw_vec along = sw_scale(sw_sub(high, low), 1.0 / m->web->length);
  for (size_t i = 0; i < m->parts->count; i++)
    m->web->s[i] = sw_dot(sw_sub(sw_vec_at(m->parts->positions, i), low), along);
}

static sw_status make_web(maker *m) {
  const sw_particles_parts *p = m->parts;
  SW_TRY(sw_web_new(p->count, p->links, p->folds, p->elements, &m->web));
  sw_web *w = m->web;
  memcpy(w->mass, p->masses, p->count * sizeof *w->mass);
  for (size_t i = 0; i < p->count; i++) m->mass += p->masses[i];
  w->skin = m->radius;
  w->repel_distance = p->repel.distance, w->repel_stiffness = p->repel.stiffness;
  measure_size(m);
  SW_TRY(fill_links(m));
  SW_TRY(fill_solids(m));
  SW_TRY(sw_particles_add_surface(m));
  return sw_web_bound_rate(w);
}

/* --- the body ------------------------------------------------------------------------- */

static sw_status make_body(maker *m, sw_scene_wire *w) {
  const size_t n = m->parts->count;
  sw_strand *s = &w->strand;
  SW_TRY(make_web(m));
  s->web = sw_web_retain(m->web);
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(s->x, 3 * n), SW_ROOM(s->v, 3 * n), SW_ROOM(s->a, 3 * n),
                      SW_ROOM(s->axial, m->web->links)));
  memcpy(s->x, m->parts->positions, 3 * n * sizeof *s->x);
  for (size_t e = 0; e < m->web->links; e++) {
    const sw_web_link *l = &m->web->link[e];
    s->axial[e] = l->k * (distance(m, l->a, l->b) - l->rest);
  }
  w->beam = (sw_beam){.mass = m->mass / m->web->length, .radius = m->radius};
  const double ends[6] = {m->low.x, m->low.y, m->low.z, m->high.x, m->high.y, m->high.z};
  SW_TRY(sw_mesh_along(&w->mesh, ends, 2, 2));
  w->drawing.length = w->mesh.s[w->mesh.n - 1];
  return SW_OK;
}

/* Adds the force for links that yield: they have a history, which only forces of the scene have. */
static sw_status add_yield(sw_scene *s, const sw_web *web, sw_handle body, sw_error *err) {
  const double own[2] = {(double)NAN, (double)NAN}; /* NAN: the links' own values */
  sw_handle force;
  if (!web->yield) return SW_OK;
  return sw_scene_add_force(s, sw_force_find("plastic_springs"), body, own, sizeof own, &force,
                            err);
}

sw_status sw_scene_add_particles(sw_scene *s, const sw_particles_args *args,
                                 const sw_particles_parts *parts, sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_scene_wire w = {.cls = &particles_class};
  sw_scene_give_name(w.name, args->name, "particles", sw_scene_wire_slots(s));
  maker m = {.name = w.name, .parts = parts, .err = err};
  sw_error text = {""};
  m.err = &text;
  sw_status status = check(&m, args);
  if (status == SW_OK) status = sw_scene_unbuild(s);
  if (status == SW_OK) status = make_body(&m, &w);
  if (status == SW_OK) status = sw_scene_check_rules(s, sw_scene_wire_slots(s), &w, &text);
  w.number = sw_scene_bodies_made(s);
  if (status == SW_OK) status = sw_scene_add(s, SW_OF_BODY, &w, out);
  if (status == SW_OK) sw_scene_let_out(s);
  if (status == SW_OK) {
    status = add_yield(s, m.web, *out, &text);
    if (status != SW_OK) sw_scene_unmake_body(s);
  }
  sw_web_release(m.web);
  if (status == SW_OK) return SW_OK;
  sw_scene_clear_body(&w);
  if (text.text[0]) return sw_fail(err, status, "%s", text.text);
  return sw_fail(err, status, "particles '%s': %s", m.name, sw_status_text(status));
}
