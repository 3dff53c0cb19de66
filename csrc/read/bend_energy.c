/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Energy stored in bending, by model.
 *
 * Lines of nodes: the energy of their bending forces, minus what yields or slips, and of their bend
 * within rigid joints.
 *
 * Meshes: springs and elements do not separate bending from stretching. So the energy is 1/2 M^2/EI
 * summed over the slices, where M is the moment that springs and elements bear across a slice, plus
 * the energy of the folds along the wire. The folds have a part q of EI. With M = (1 - q) EI kappa
 * and both energies known, q follows from q/(1 - q)^2 = E_folds EI / (1/2 sum M^2 h). Lines between
 * meshed parts bend by folds alone. */
#include <math.h>
#include <string.h>

#include "body/build.h"
#include "body/section.h"
#include "read/readout.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/axial.h"
#include "system/join.h"

static double of_line(sw_scene *s, size_t body) {
  sw_system *system = sw_scene_system(s);
  double sum = 0;
  for (size_t k = 0; k < system->bodies[body].term_count; k++) {
    const sw_force_class *cls = system->bodies[body].terms[k].cls;
    double other;
    const double energy = sw_system_term_energy(system, body, k, &other);
    if (cls->flags & SW_FORCE_BENDING) sum += energy - other;
    if (!cls->corrects || strcmp(cls->corrects, "bend") == 0) sum += other;
  }
  return sum;
}

static double fold_energy(const sw_web_fold *fold, const double *x) {
  const sw_vec b = sw_vec_at(x, fold->b);
  const sw_vec one = sw_sub(b, sw_vec_at(x, fold->a)), two = sw_sub(sw_vec_at(x, fold->c), b);
  const double off = atan2(sw_norm(sw_cross(one, two)), sw_dot(one, two)) - fold->rest;
  return 0.5 * fold->k * off * off;
}

/* Energies of the folds in meshed parts and in the lines between them [J]. */
static void fold_energies(const sw_web *w, const double *x, double *rings, double *lines) {
  *rings = *lines = 0;
  for (size_t k = 0; k < w->folds; k++) {
    const size_t r = sw_web_ring_of(w, w->fold[k].b);
    *(sw_web_is_ring(w, r) ? rings : lines) += fold_energy(&w->fold[k], x);
  }
}

static double of_mesh(const sw_plan *p, const double *x, const double *T, double EI) {
  const sw_web *w = p->web;
  double rings, lines, squares = 0;
  fold_energies(w, x, &rings, &lines);
  for (size_t r = 0; r + 1 < w->rings; r++) {
    const double s0 = w->s[w->first[r]], s1 = w->s[w->first[r + 1]];
    if (!sw_web_is_ring(w, r) || !sw_web_is_ring(w, r + 1)) continue;
    const double M = sw_strand_moment(p, x, T, 0.5 * (s0 + s1));
    squares += 0.5 * M * M * (s1 - s0);
  }
  if (!(rings > 0) || !(squares > 0)) return rings + lines + squares / EI;
  const double c = rings * EI / squares;
  const double q = (2.0 * c + 1.0 - sqrt(4.0 * c + 1.0)) / (2.0 * c);
  return rings + lines + squares / (EI * (1.0 - q));
}

static sw_status read(sw_scene *s, sw_handle h, double place SW_UNUSED, double *out,
                      sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w;
  SW_TRY(sw_scene_open_wire(s, h, &w, err));
  const sw_body *b = &system->bodies[h.slot];
  const sw_beam *beam = &w->beam;
  if (!b->plan->web) {
    SW_TRY(sw_scene_still(s, err)); /* inside a step the fields are the solver's */
    sw_system_show(system, h.slot);
    *out = of_line(s, h.slot) +
           sw_joins_bend_energy(system, b->first_node, b->first_node + b->plan->nodes);
    return SW_OK;
  }
  if (beam->EI_axis[0] != beam->EI_axis[1])
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': bend_energy is not known for meshes with two values of EI; it is "
                   "for model = 'rod'",
                   w->name);
  *out = of_mesh(b->plan, system->x + 3 * b->first_node, sw_system_elastic(system, b),
                 beam->EI_axis[0]);
  return SW_OK;
}

const sw_readout sw_readout_bend_energy = {
    "bend_energy", "J", "energy stored in bending, over the whole wire", 0, read};
