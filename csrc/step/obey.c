/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Repeats a step until a drive has the wanted force (obey.h). */
#include "step/obey.h"

sw_status sw_obey(sw_ladder *p, const sw_rung *below, double h, const sw_obeyer *what,
                  sw_error *err) {
  if (!what->begin(p->s, h)) return sw_rung_go(p, below, h, err);
  for (size_t i = 0; !what->most || i < what->most; i++) {
    const sw_status status = sw_rung_go(p, below, h, err);
    if (status == SW_OK && what->correct(p->s, h, i == 0)) return SW_OK;
    if (status != SW_OK && what->give_up) what->give_up(p->s);
    if (status != SW_OK) return status;
    sw_ladder_undo(p);
    if (what->goes_on && !what->goes_on(p->s, h)) break;
  }
  what->give_up(p->s);
  return sw_fail(err, SW_ENOCONV, "%s", what->failure);
}
