/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elements of the force slide, which hold the parts of a sliding composite together: one for each
 * pair of facing particles and each slice. */
#include "state/slide.h"

#include <math.h>

#include "strand/maker.h"

/* Stiffness along the wire, before slip, of all elements of one core, over the series stiffness of
 * shell and core per slice. At this value the parts' forces pass from one to the other within three
 * slices, and sticking parts reduce the bending stiffness by 0.1 %. Larger values make stick and
 * slip alternate in every iteration [-]. */
static const double HANDED_ON = 0.1;

/* Returns the unloaded places of an element's particles: as drawn, or straight with the twist at
 * rest. */
static sw_slide_place at_rest(const sw_strand_maker *m, const sw_slide *pair, size_t r) {
  double place[SW_SLIDE_NODES][3];
  const double *at[SW_SLIDE_NODES];
  for (int i = 0; i < SW_SLIDE_NODES; i++) {
    const uint32_t particle = i < 2 ? pair->from : pair->to;
    const double *q = m->lattice->at + 3 * (size_t)particle, z = (i % 2) * m->lattice->spacing;
    const double turn = m->plan->rest_twist * z, c = cos(turn), s = sin(turn);
    sw_store(place[i], sw_v(c * q[0] - s * q[1], s * q[0] + c * q[1], q[2] + z));
    at[i] = place[i];
    if (m->plan->curved) at[i] = m->strand->x + 3 * (m->first[r + (size_t)(i % 2)] + particle);
  }
  return sw_slide_measure(at);
}

/* Returns the core that a particle of the slice belongs to; c->cores: the shell. */
static size_t core_of(const sw_composite *c, uint32_t particle) {
  return particle < c->ring ? c->cores : (particle - c->ring) / c->each;
}

/* Returns a pair's share of the pressure and grip of one core. All pairs of a core have the same
 * share; a pair between two cores has the mean of both [-]. */
static double share_of(const sw_composite *c, const sw_slide *pair) {
  const size_t core[2] = {core_of(c, pair->from), core_of(c, pair->to)};
  double sum = 0, cores = 0;
  for (int side = 0; side < 2; side++) {
    double count = 0;
    if (core[side] == c->cores) continue;
    for (size_t i = 0; i < c->slides; i++)
      count +=
          core_of(c, c->slide[i].from) == core[side] || core_of(c, c->slide[i].to) == core[side];
    sum += 1 / count, cores++;
  }
  return sum / cores;
}

/* Sets one element. Across it acts like a bar of the shell's modulus. */
static void set_element(const sw_strand_maker *m, const sw_slide *pair, size_t r,
                        sw_web_slide *out) {
  const sw_composite *c = &m->strand->calibrated->calibration.composite;
  const double shell = c->shell.S[0], core = c->core.S[0], h = m->lattice->spacing;
  const double share = share_of(c, pair);
  const sw_slide_place rest = at_rest(m, pair, r);
  for (size_t i = 0; i < SW_SLIDE_NODES; i++)
    out->node[i] = (uint32_t)m->first[r + i % 2] + (i < 2 ? pair->from : pair->to);
  out->apart = rest.apart, out->along = rest.u;
  out->press = shell / ((double)c->ring * rest.apart);
  out->stick = HANDED_ON * share * shell * core / ((shell + core) * h);
  out->grip = share * m->plan->lattice.composite.grip * h;
}

void sw_strand_add_slides(sw_strand_maker *m, size_t r) {
  const sw_composite *c = &m->strand->calibrated->calibration.composite;
  if (!sw_strand_is_ring(m, r + 1)) return;
  for (size_t i = 0; i < c->slides; i++, m->slides++)
    if (m->web) set_element(m, &c->slide[i], r, &m->web->slide[m->slides]);
}
