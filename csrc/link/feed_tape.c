/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A feed's state on a tape. */
#include <math.h>

#include "link/feeding.h"
#include "state/state_tape.h"

#define DOUBLE(field) sw_tape_double(t, &x->field)
#define SLIP(field) sw_tape_double(t, &x->slip.field)
#define GUIDE(field) sw_tape_double(t, &x->guide.field)

void sw_tape_feed(sw_tape *t, sw_feed *x) {
  sw_guide *g = &x->guide;
  int shaped = g->shape.n > 0;
  SW_TAPE_STRUCT(t, sw_feed, 392);
  sw_tape_int(t, &g->outward), GUIDE(label), DOUBLE(fed), DOUBLE(since), DOUBLE(speed);
  DOUBLE(start);
  sw_tape_motion(t, &x->motion);
  SLIP(length), SLIP(since), SLIP(speed), SLIP(growth), SLIP(growth_before);
  SLIP(push), SLIP(limit), SLIP(way), SLIP(way_before);
  sw_tape_bracket(t, &x->slip.found, "a feed");
  SLIP(slope), GUIDE(spare[0]), GUIDE(spare[1]), GUIDE(spare_fed[0]), GUIDE(spare_fed[1]);
  GUIDE(size), GUIDE(drive), GUIDE(stage);
  sw_tape_int(t, &shaped);
  if (shaped) sw_tape_mesh(t, &g->shape, 1);
  if (!sw_tape_reads(t)) return;
  const sw_slip *slip = &x->slip;
  sw_slip_taken(&x->slip); /* older files hold other values before the step */
  const double all = g->label + x->fed + x->since + x->speed + x->start + slip->length +
                     slip->since + slip->speed + slip->growth + slip->growth_before + slip->slope +
                     g->size;
  sw_tape_expect(t, isfinite(all + g->spare[0] + g->spare[1]), "a feed");
}
