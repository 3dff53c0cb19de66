/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The particles of a wire on a tape. */
#include "base/tape.h"

#include "base/alloc.h"
#include "force/solid.h"
#include "state/state_tape.h"
#include "strand/strand.h"

static void tape_calibrated(sw_tape *t, sw_strand_calibrated **calibrated) {
  static const sw_sharing sharing = {sw_strand_calibrated_retain, sw_strand_calibrated_release};
  if (sw_tape_share(t, calibrated, &sharing)) return;
  int there = !sw_tape_reads(t) && *calibrated != NULL;
  SW_TAPE_STRUCT(t, sw_strand_calibrated, 1296);
  sw_tape_int(t, &there);
  if (!there) return;
  if (!sw_tape_object(t, calibrated, sizeof **calibrated)) return;
  if (sw_tape_reads(t)) (*calibrated)->references = 1;
  sw_tape_calibration(t, &(*calibrated)->calibration);
}

void sw_tape_strand(sw_tape *t, sw_strand *x, int placed) {
  int there = !sw_tape_reads(t) && x->web != NULL;
  SW_TAPE_STRUCT(t, sw_strand, 56);
  SW_TAPE_STRUCT(t, sw_solid, 1632);
  sw_tape_int(t, &there);
  if (!there) return;
  sw_tape_web(t, &x->web, sizeof(sw_solid));
  tape_calibrated(t, &x->calibrated);
  if (!sw_tape_good(t)) return;
  const size_t n = placed ? x->web->particles : 0;
  if (placed) {
    SW_TAPE_ARRAY(t, x->x, 3 * n), SW_TAPE_ARRAY(t, x->v, 3 * n), SW_TAPE_ARRAY(t, x->a, 3 * n);
    SW_TAPE_ARRAY(t, x->axial, x->web->links);
    SW_TAPE_OPTIONAL(t, x->rate, x->web->links);
  }
  if (!sw_tape_reads(t) || t->home || !sw_tape_good(t)) return;
  sw_tape_finite(t, x->x, 3 * n, "particles");
  sw_tape_finite(t, x->v, 3 * n, "particles");
  for (size_t k = 0; k < x->web->solids && sw_tape_good(t); k++) {
    const sw_web_solid *e = &x->web->solid[k];
    const sw_solid *shape = (const sw_solid *)x->web->shapes + e->shape;
    sw_tape_expect(t, shape->nodes == (int)e->count, "an element");
    shape += x->web->clamped_shapes;
    sw_tape_expect(t, shape->nodes == (int)e->count, "an element");
  }
}
