/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of particles between the ringed parts of a strand: a rod that stretches and bends, lumped
 * in particles, without twist. Where a line meets a ring, its first particle is a lever: springs to
 * the ring's particles hold it straight in front of the section. The line's last hinge is there,
 * between line and section, with the compliance of half the edge and the lever. */
#include <math.h>

#include "strand/maker.h"

/* Stiffness of the lever over the bending stiffness of one slice [-]. */
static const double RIGID = 200.0;

static double gap(const sw_strand_maker *m, size_t r) { return m->mesh->s[r + 1] - m->mesh->s[r]; }

static const double *outline_at(const sw_strand_maker *m, size_t k) {
  return m->lattice->at + 3 * (size_t)m->around[k];
}

/* Adds springs from a ring to the particle of a line at distance d from its plane. */
static void add_lever(sw_strand_maker *m, size_t ring, size_t line, double d) {
  const sw_lattice *p = m->lattice;
  double sum = 0; /* turning stiffness for unit springs [m2] */
  for (size_t i = 0; i < p->particles; i++) {
    const double *at = p->at + 3 * i, R2 = at[0] * at[0] + at[1] * at[1];
    sum += 0.5 * p->share[i] * d * d * R2 / (d * d + R2);
  }
  for (size_t i = 0; i < p->particles; i++) {
    const double *at = p->at + 3 * i;
    const double l = sqrt(at[0] * at[0] + at[1] * at[1] + d * d);
    const double stiff = RIGID * m->beam->EI / (p->spacing * sum) * p->share[i];
    if (line > ring)
      sw_strand_add_link(m, m->first[ring] + i, m->first[line], stiff, l);
    else
      sw_strand_add_link(m, m->first[line], m->first[ring] + i, stiff, l);
  }
}

/* Adds the hinge at a lever, between the line's next particle and the section. */
static void add_section_hinge(sw_strand_maker *m, size_t line, size_t next, size_t ring, double d,
                              double edge) {
  const size_t count = m->around_count;
  const double moment = m->beam->EI / (0.5 * edge + d);
  const double sum = 0.5 * (double)count; /* sum of squared cosines round the ring */
  for (size_t k = 0; k < count; k++) {
    const double *at = outline_at(m, k);
    const size_t i = m->first[ring] + m->around[k];
    sw_strand_add_fold(m, m->first[next], m->first[line], i, moment / sum,
                       atan2(hypot(at[0], at[1]), d));
  }
}

static void add_hinge(sw_strand_maker *m, size_t r) {
  if (r == 0 || r + 1 >= m->mesh->n) return;
  const double before = gap(m, r - 1), after = gap(m, r);
  const int left = sw_strand_is_ring(m, r - 1), right = sw_strand_is_ring(m, r + 1);
  if (right && !left)
    add_section_hinge(m, r, r - 1, r + 1, after, before);
  else if (left && !right)
    add_section_hinge(m, r, r + 1, r - 1, before, after);
  else if (!left)
    sw_strand_add_fold(m, m->first[r - 1], m->first[r], m->first[r + 1],
                       m->beam->EI / (0.5 * (before + after)), 0);
}

void sw_strand_add_line(sw_strand_maker *m, size_t r) {
  add_hinge(m, r);
  if (r + 1 >= m->mesh->n) return;
  const double l = gap(m, r);
  if (sw_strand_is_ring(m, r + 1))
    add_lever(m, r + 1, r, l);
  else
    sw_strand_add_link(m, m->first[r], m->first[r + 1], m->beam->EA / l, l);
}

void sw_strand_add_end(sw_strand_maker *m, size_t r) { add_lever(m, r, r + 1, gap(m, r)); }

double sw_strand_mass(const sw_strand_maker *m, size_t r) {
  double length = 0;
  if (r > 0) length += 0.5 * gap(m, r - 1);
  if (r + 1 < m->mesh->n) length += 0.5 * gap(m, r);
  return m->beam->mass * length;
}
