/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A calibration's result and lattice on a tape. */
#include "calibrate/calibrate.h"

#define DOUBLE(field) sw_tape_double(t, &x->field)
#define DOUBLES(field) sw_tape_raw(t, x->field, sizeof x->field)
#define SIZE(field) sw_tape_size(t, &x->field)

static void tape_result(sw_tape *t, sw_cell_result *x) {
  SW_TAPE_STRUCT(t, sw_cell_result, 136);
  DOUBLES(S), DOUBLE(squeeze);
}

static void check_lattice(sw_tape *t, const sw_lattice *l) {
  if (!sw_tape_good(t)) return;
  for (size_t i = 0; l->link && i < l->links; i++)
    sw_tape_expect(t,
                   l->link[i].from < l->particles && l->link[i].to < l->particles &&
                       l->link[i].group < SW_GROUPS,
                   "a spring of a section");
  for (size_t i = 0; l->solid && i < l->solids; i++)
    for (int k = 0; k < 8 && sw_tape_good(t); k++)
      sw_tape_expect(t,
                     (l->solid[i].nodes == 6 || l->solid[i].nodes == 8) &&
                         l->solid[i].group < SW_GROUPS &&
                         (k >= l->solid[i].nodes || l->solid[i].particle[k] < l->particles),
                     "an element of a section");
}

static void tape_lattice(sw_tape *t, sw_lattice *x) {
  SW_TAPE_STRUCT(t, sw_lattice, 80);
  SW_TAPE_STRUCT(t, sw_cell_link, 32);
  SW_TAPE_STRUCT(t, sw_cell_solid, 48);
  DOUBLE(spacing);
  sw_tape_count(t, &x->particles, sizeof *x->share);
  sw_tape_count(t, &x->links, sizeof *x->link);
  sw_tape_count(t, &x->solids, sizeof *x->solid);
  SW_TAPE_OPTIONAL(t, x->at, 3 * x->particles);
  SW_TAPE_OPTIONAL(t, x->share, x->particles);
  SW_TAPE_ARRAY(t, x->link, x->links);
  SW_TAPE_OPTIONAL(t, x->solid, x->solids);
  if (!sw_tape_reads(t)) return;
  x->capacity = x->links, x->solid_capacity = x->solid ? x->solids : 0;
  sw_tape_expect(t, x->solid || !x->solids, "a section without its elements");
  check_lattice(t, x);
}

static void tape_composite(sw_tape *t, sw_composite *x) {
  SW_TAPE_STRUCT(t, sw_composite, 544);
  SW_TAPE_STRUCT(t, sw_slide, 16);
  SIZE(cores), SIZE(ring), SIZE(each), SIZE(shell_links), SIZE(layers), SIZE(core_layers);
  DOUBLE(radius), DOUBLE(bore), DOUBLE(core_radius), DOUBLE(ring_radius);
  DOUBLES(centre);
  tape_result(t, &x->shell), tape_result(t, &x->core);
  sw_tape_count(t, &x->slides, sizeof *x->slide);
  SW_TAPE_OPTIONAL(t, x->slide, x->slides);
  if (!sw_tape_reads(t)) return;
  x->capacity = x->slide ? x->slides : 0;
  sw_tape_expect(t, x->cores <= SW_COMPOSITE_CORES && (x->slide || !x->slides), "a composite");
}

void sw_tape_calibration(sw_tape *t, sw_calibration *x) {
  SW_TAPE_STRUCT(t, sw_calibration, 1288);
  tape_lattice(t, &x->lattice);
  DOUBLES(k), DOUBLES(links), DOUBLES(target), DOUBLES(residual);
  tape_result(t, &x->reached);
  sw_tape_int(t, &x->faded);
  DOUBLE(fading), DOUBLE(mass_per_length), DOUBLE(nu), DOUBLE(core_nu);
  DOUBLE(scale);
  tape_composite(t, &x->composite);
  sw_tape_expect(t, x->faded >= 0 && x->faded <= SW_GROUPS, "a calibration");
}
