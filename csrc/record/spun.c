/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Turns of a rod where it touches obstacles, on a tape. */
#include "record/spun.h"

#include <math.h>

#include "base/alloc.h"

void sw_spun_free(sw_spun *x) {
  SW_FREE_ALL(x->places, x->across);
  *x = (sw_spun){0};
}

void sw_tape_spun(sw_tape *t, sw_spun *x) {
  SW_TAPE_STRUCT(t, sw_spun, 32); /* across is work space */
  SW_TAPE_STRUCT(t, sw_spun_place, 72);
  const size_t count = x->count;
  sw_tape_list(t, &x->places, &x->count, sizeof *x->places);
  sw_tape_raw(t, &x->holds, sizeof x->holds);
  if (x->count != count) sw_free(x->across), x->across = NULL;
  for (size_t k = 0; sw_tape_reads(t) && sw_tape_good(t) && k < x->count; k++) {
    const sw_spun_place *p = &x->places[k];
    const int fine = isfinite(p->turn + p->share + p->seen);
    sw_tape_expect(t, fine && sw_finite(p->tangent) && sw_finite(p->across), "a wire's turns");
  }
}
