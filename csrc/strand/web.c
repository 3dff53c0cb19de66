/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The web of a strand: springs, folds, elements, masses, surface. add_parts runs twice: first it
 * counts the parts, then it makes them. */
#include <math.h>

#include "base/alloc.h"
#include "base/each.h"
#include "force/solid.h"
#include "state/crease.h"
#include "strand/maker.h"

void sw_strand_add_link(sw_strand_maker *m, size_t a, size_t b, double k, double rest) {
  if (m->web) m->web->link[m->links] = (sw_web_link){(uint32_t)a, (uint32_t)b, k, rest};
  m->links++;
}

void sw_strand_add_fold(sw_strand_maker *m, size_t a, size_t b, size_t c, double k, double rest) {
  if (m->web)
    m->web->fold[m->folds] = (sw_web_fold){(uint32_t)a, (uint32_t)b, (uint32_t)c, k, rest};
  m->folds++;
}

/* Returns the share of a link within ring r that counts. A ring at an end has half a slice. */
static double ring_share(const sw_strand_maker *m, const sw_cell_link *link, size_t r) {
  const int before = r > 0 && sw_strand_is_ring(m, r - 1), after = sw_strand_is_ring(m, r + 1);
  return link->slices == 0 ? 0.5 * (before + after) : 1.0;
}

/* 1 if the link that starts at ring r ends on a ring. A bend spring needs a ring before r too. */
static int fits(const sw_strand_maker *m, const sw_cell_link *link, size_t r) {
  if (link->bend) return r > 0 && sw_strand_is_ring(m, r - 1) && sw_strand_is_ring(m, r + 1);
  return sw_strand_is_ring(m, r + (size_t)link->slices);
}

/* Returns the unstressed length: of the drawn shape, or of the straight lattice with the twist at
 * rest. */
static double rest_length(const sw_strand_maker *m, const sw_cell_link *link, size_t r) {
  if (m->plan->curved)
    return sw_dist(sw_vec_at(m->strand->x, m->first[r] + link->from),
                   sw_vec_at(m->strand->x, m->first[r + (size_t)link->slices] + link->to));
  const double z = (double)link->slices * m->lattice->spacing, turn = m->plan->rest_twist * z;
  const double *a = m->lattice->at + 3 * (size_t)link->from;
  const double *b = m->lattice->at + 3 * (size_t)link->to;
  const double x = cos(turn) * b[0] - sin(turn) * b[1], y = sin(turn) * b[0] + cos(turn) * b[1];
  return sqrt((x - a[0]) * (x - a[0]) + (y - a[1]) * (y - a[1]) + z * z);
}

/* Returns the unloaded place of particle i of ring r, relative to ring number `from`. */
static sw_vec at_rest(const sw_strand_maker *m, size_t i, size_t r, size_t from) {
  const double z = ((double)r - (double)from) * m->lattice->spacing;
  const double turn = m->plan->rest_twist * z, c = cos(turn), s = sin(turn);
  const double *at = m->lattice->at + 3 * i;
  if (m->plan->curved) return sw_vec_at(m->strand->x, m->first[r] + i);
  return sw_v(c * at[0] - s * at[1], s * at[0] + c * at[1], at[2] + z);
}

/* Where rings begin or end, folds to the outline hold a bend spring's line to its section over half
 * a slice; without them the section would get no moment from it. A core that slides in its section
 * has none, because they would hold it there. */
static void add_end_hinge(sw_strand_maker *m, const sw_cell_link *link, size_t r, double k) {
  const int before = r > 0 && sw_strand_is_ring(m, r - 1), after = sw_strand_is_ring(m, r + 1);
  if (before == after || m->strand->calibrated->calibration.composite.slides > 0) return;
  const size_t next = after ? r + 1 : r - 1, from = link->from;
  size_t count = 0;
  for (size_t i = 0; i < m->around_count; i++) count += m->around[i] != from;
  for (size_t n = 0; n < m->around_count; n++) {
    const size_t i = m->around[n];
    if (i == from) continue;
    const sw_vec at = at_rest(m, from, r, r);
    const sw_vec along = sw_sub(at_rest(m, from, next, r), at);
    const sw_vec out = sw_sub(at_rest(m, i, r, r), at);
    const double angle = atan2(sw_norm(sw_cross(along, out)), -sw_dot(along, out));
    /* squared cosines sum to half the number; half the length */
    sw_strand_add_fold(m, m->first[next] + from, m->first[r] + from, m->first[r] + i,
                       4.0 * k / (double)count, angle);
  }
}

static void add_ring(sw_strand_maker *m, size_t r) {
  SW_ITEMS(const sw_cell_link, link, m->lattice->link, m->lattice->links) {
    const double k = m->k[link->group] * link->weight * ring_share(m, link, r);
    if (link->bend) add_end_hinge(m, link, r, k);
    if (!fits(m, link, r)) continue;
    const size_t from = m->first[r] + link->from;
    if (link->bend)
      sw_strand_add_fold(m, m->first[r - 1] + link->from, from, m->first[r + 1] + link->from, k, 0);
    else
      sw_strand_add_link(m, from, m->first[r + (size_t)link->slices] + link->to, k,
                         m->web ? rest_length(m, link, r) : 0);
  }
}

/* Returns the length of wire that a ring stands for [m]. */
static double ring_length(const sw_strand_maker *m, size_t r) {
  const int before = r > 0 && sw_strand_is_ring(m, r - 1), after = sw_strand_is_ring(m, r + 1);
  return 0.5 * (before + after) * m->lattice->spacing;
}

/* Returns how much stiffer the hinges of a polygon must be for it to ovalise like its circle. Bent
 * by A cos 2 phi, hinges have 2 A^2 sin^2 b each, and the polygon loses R A (1 + sin(b/2)/sin(3
 * b/2)) of its height, with b the angle of a side; the circle is b = 0 [-]. */
static double of_polygon(size_t sides) {
  const double b = 2.0 * M_PI / (double)sides;
  const double lost = 0.75 * (1.0 + sin(0.5 * b) / sin(1.5 * b));
  return 2.0 * b * sin(0.5 * b) / (sin(b) * sin(b)) * lost * lost;
}

/* Adds the wall's bending along the wire. Without it only the slices' length would limit how short
 * the buckling waves of the compressed side are, and how early they come. */
static void add_wall_along(sw_strand_maker *m, size_t r, double chord) {
  const double k = sw_strand_wall_along(m->plan, m->beam) * chord / m->lattice->spacing;
  if (!(k > 0) || r == 0 || !sw_strand_is_ring(m, r - 1) || !sw_strand_is_ring(m, r + 1)) return;
  for (size_t i = 0; i < m->around_count; i++)
    sw_strand_add_fold(m, m->first[r - 1] + m->around[i], m->first[r] + m->around[i],
                       m->first[r + 1] + m->around[i], k, 0);
}

/* Adds creases round a ring: its wall, bent at each particle as drawn. */
static void add_wall(sw_strand_maker *m, size_t r) {
  const size_t n = m->around_count;
  const size_t next = sw_strand_is_ring(m, r + 1) ? r + 1 : r - 1;
  const double *p = m->lattice->at + 3 * (size_t)m->around[0];
  const double *q = m->lattice->at + 3 * (size_t)m->around[1];
  const double chord = hypot(q[0] - p[0], q[1] - p[1]);
  const double k = m->plan->wall * of_polygon(n) * ring_length(m, r) / chord;
  if (!(k > 0)) return; /* a single ring between lines */
  add_wall_along(m, r, chord);
  for (size_t i = 0; i < n; i++, m->creases++) {
    if (!m->web) continue;
    const uint32_t a = m->around[(i + n - 1) % n], b = m->around[i], c = m->around[(i + 1) % n];
    const sw_vec at = at_rest(m, b, r, r);
    const double turn =
        sw_crease_angle(sw_sub(at_rest(m, a, r, r), at), sw_sub(at_rest(m, c, r, r), at),
                        sw_sub(at_rest(m, b, next, r), at));
    m->web->crease[m->creases] = (sw_web_crease){.a = (uint32_t)m->first[r] + a,
                                                 .b = (uint32_t)m->first[r] + b,
                                                 .c = (uint32_t)m->first[r] + c,
                                                 .d = (uint32_t)m->first[next] + b,
                                                 .k = k,
                                                 .rest = turn};
  }
}

static void add_elements(sw_strand_maker *m, size_t r) {
  const sw_lattice *l = m->lattice;
  for (size_t k = 0; k < l->solids && sw_strand_is_ring(m, r + 1); k++, m->solids++) {
    const sw_cell_solid *e = &l->solid[k];
    if (!m->web) continue;
    sw_web_solid *to = &m->web->solid[m->solids];
    to->count = (uint32_t)e->nodes;
    to->shape = (uint32_t)((m->plan->curved ? r * l->solids : 0) + k);
    for (int i = 0; i < e->nodes; i++)
      to->node[i] = (uint32_t)m->first[r + (2 * i >= e->nodes)] + e->particle[i];
  }
}

static void add_parts(sw_strand_maker *m) {
  m->links = m->folds = m->creases = m->solids = m->slides = 0;
  for (size_t r = 0; r <= m->mesh->n; r++) {
    if (m->web) m->web->ring_links[r] = m->links, m->web->ring_solids[r] = m->solids;
    if (sw_strand_is_line(m, r)) sw_strand_add_line(m, r);
    if (!sw_strand_is_ring(m, r)) continue;
    add_ring(m, r);
    if (!isnan(m->plan->wall)) add_wall(m, r);
    add_elements(m, r);
    sw_strand_add_slides(m, r);
    if (sw_strand_is_line(m, r + 1)) sw_strand_add_end(m, r);
  }
}

/* Fills the rest places of an element's corners. One shape serves all slices unless the wire is
 * curved at rest. */
static void rest_corners(const sw_strand_maker *m, const sw_cell_solid *e, size_t r, double *out) {
  const size_t half = (size_t)e->nodes / 2;
  for (size_t i = 0; i < (size_t)e->nodes; i++) {
    const size_t next = i >= half;
    const double *at = m->lattice->at + 3 * (size_t)e->particle[i];
    const double z = next ? m->lattice->spacing : 0.0, turn = m->plan->rest_twist * z;
    sw_vec p = sw_v(cos(turn) * at[0] - sin(turn) * at[1], sin(turn) * at[0] + cos(turn) * at[1],
                    at[2] + z);
    if (m->plan->curved) p = sw_vec_at(m->strand->x, m->first[r + next] + e->particle[i]);
    sw_store(out + 3 * i, p);
  }
}

/* Softening of elements at a held ring. A held ring prevents the lateral contraction that the beam
 * allows: stretched and bent wires would be stiffer, as if shorter by 0.1 radii per clamp at nu =
 * 0.35, 0.25 at 0.49. Elements at a held ring therefore have the Poisson's ratio nu - GIVES_WAY
 * nu^2 with the same shear modulus. Fitted with 6 to 16 particles round, 4 and 8 voxels across,
 * slices of 0.25 to 0.75 radii: 20 diameters between clamps are then within 0.4 % of the beam at
 * any nu [-]. */
static const double GIVES_WAY = 0.62;

static sw_status prepare_shapes(sw_strand_maker *m) {
  const sw_lattice *l = m->lattice;
  const size_t slices = m->plan->curved ? m->mesh->n - 1 : 1;
  const size_t usual = slices * l->solids;
  sw_solid *shape = sw_alloc(2 * usual, sizeof *shape);
  if (!shape) return SW_ENOMEM;
  m->web->shapes = shape;
  m->web->shape_count = 2 * usual;
  m->web->clamped_shapes = usual;
  for (size_t k = 0; k < m->web->shape_count; k++) {
    double rest[3 * SW_SOLID_NODES];
    const sw_cell_solid *e = &l->solid[k % l->solids];
    const double E = m->k[e->group], nu = k < usual ? e->nu : e->nu * (1.0 - GIVES_WAY * e->nu);
    const double mu = 0.5 * E / (1.0 + e->nu), lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
    rest_corners(m, e, k % usual / l->solids, rest);
    SW_TRY(sw_solid_prepare(e->nodes, rest, mu, lambda, &shape[k]));
  }
  return SW_OK;
}

/* Finds the particles on a section's convex outline, in order round it. Particles inside by more
 * than rounding are left out. */
static void find_around(const sw_lattice *l, uint32_t *around, size_t *count) {
  const size_t n = l->particles;
  size_t first = 0;
  for (size_t i = 1; i < n; i++)
    if (l->at[3 * i] > l->at[3 * first]) first = i;
  size_t at = first;
  do { /* gift wrapping: the next particle has all others on its left */
    around[(*count)++] = (uint32_t)at;
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
  } while (at != first && *count < n);
}

/* Bounds the frequency of the web's solid elements by their stiffness at x, which limits the steps
 * of explicit methods. SW_ENOMEM. */
static sw_status bound_solids(sw_web *w, const double *x) {
  double at[3 * SW_SOLID_NODES], H[9 * SW_SOLID_NODES * SW_SOLID_NODES];
  double *sum SW_LOCAL = sw_alloc(w->particles, sizeof *sum);
  if (!sum) return SW_ENOMEM;
  SW_ITEMS(const sw_web_solid, s, w->solid, w->solids) {
    const size_t size = 3 * s->count;
    for (uint32_t i = 0; i < s->count; i++) sw_store(at + 3 * i, sw_vec_at(x, s->node[i]));
    sw_solid_eval((const sw_solid *)w->shapes + s->shape, at, SW_WANT_STIFFNESS, NULL, H);
    for (size_t r = 0; r < size; r++) {
      double row = 0;
      for (size_t c = 0; c < size; c++) row += fabs(H[r * size + c]);
      sum[s->node[r / 3]] += row / 3.0; /* mean of three directions */
    }
  }
  w->solid_rate2 = 0;
  for (size_t p = 0; p < w->particles; p++) {
    w->solid_rate2 = fmax(w->solid_rate2, sum[p] / w->mass[p]);
    w->behind[p] += 0.5 * sum[p];
  }
  return SW_OK;
}

static sw_status make_room(sw_strand_maker *m) {
  const size_t n = m->lattice->particles, rings = m->mesh->n;
  m->around = sw_alloc(n, sizeof *m->around);
  if (!m->around) return SW_ENOMEM;
  find_around(m->lattice, m->around, &m->around_count);
  add_parts(m);
  SW_TRY(sw_web_new(m->first[rings], m->links, m->folds, m->solids, &m->web));
  sw_web *w = m->web;
  m->strand->web = w;
  w->rings = rings, w->per_ring = n;
  w->banded = !m->ring && w->folds == 0;
  w->around = m->around, w->around_count = m->around_count;
  w->slides = m->slides, w->creases = m->creases;
  w->friction = m->plan->lattice.composite.friction;
  return SW_ALLOC_ALL(SW_ROOM(w->first, rings + 1), SW_ROOM(w->along, w->particles),
                      SW_ROOM(w->share, n), SW_ROOM(w->section, 2 * n),
                      SW_ROOM(w->ring_links, rings + 1), SW_ROOM(w->ring_solids, rings + 1),
                      SW_ROOM(w->slide, m->slides), SW_ROOM(w->crease, m->creases),
                      SW_ROOM(m->strand->axial, m->links));
}

static void fill_sections(sw_strand_maker *m) {
  const sw_lattice *l = m->lattice;
  sw_web *w = m->web;
  w->axis = (uint32_t)l->particles;
  for (size_t i = 0; i < l->particles; i++) {
    w->share[i] = l->share[i];
    w->section[2 * i] = l->at[3 * i], w->section[2 * i + 1] = l->at[3 * i + 1];
    if (hypot(l->at[3 * i], l->at[3 * i + 1]) < 1e-9 * l->spacing) w->axis = (uint32_t)i;
  }
  for (size_t r = 0; r <= m->mesh->n; r++) w->first[r] = m->first[r];
  for (size_t r = 0; r < m->mesh->n; r++)
    for (size_t p = w->first[r]; p < w->first[r + 1]; p++) {
      const double share = sw_strand_is_ring(m, r) ? w->share[p - w->first[r]] : 1.0;
      w->mass[p] = share * sw_strand_mass(m, r);
      w->s[p] = m->mesh->s[r];
      const uint32_t i = (uint32_t)(p - w->first[r]);
      const sw_cell_link line = {.from = i, .to = i, .slices = 1};
      if (sw_strand_is_ring(m, r) && sw_strand_is_ring(m, r + 1))
        w->along[p] = rest_length(m, &line, r);
    }
}

sw_status sw_strand_fill(sw_strand_maker *m) {
  SW_TRY(make_room(m));
  sw_web *w = m->web;
  const double *x = m->strand->x;
  fill_sections(m);
  SW_TRY(sw_strand_find_faces(m));
  if (m->lattice->solids) SW_TRY(prepare_shapes(m));
  add_parts(m);
  for (size_t e = 0; e < w->links; e++) {
    const double l = sw_dist(sw_vec_at(x, w->link[e].a), sw_vec_at(x, w->link[e].b));
    m->strand->axial[e] = w->link[e].k * (l - w->link[e].rest);
  }
  SW_TRY(bound_solids(w, x));
  SW_TRY(sw_web_bound_rate(w));
  SW_TRY(sw_web_bound_slides(w));
  return sw_web_add_surface(w);
}
