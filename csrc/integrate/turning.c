/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Follows a method through steady turning. An axially stiff edge that turns is pulled to its centre
 * by an axial force. The stages find this force from the distance that free flight carries the edge
 * outwards. Methods with stages of first order find a wrong multiple of it, whatever the step size:
 * sdirk2 -0.7 and 5.1 times the force, and in the first step after a start 0.5 and 3.4 times.
 * Forces that do not come from turning are found correctly. Both multiples follow from the rows of
 * the method, applied to a place that turns at unit acceleration. So does the mix of both stages'
 * forces whose multiple is one. */
#include "integrate/turning.h"

#include <math.h>

/* Multiples within CLOSE of one are left as they are; multiples within ALIKE of each other give no
 * mix [-]. */
static const double CLOSE = 0.05, ALIKE = 0.5;

/* Displacement [s2] and velocity [s] towards the centre, for a unit acceleration. */
typedef struct place {
  double r, u;
} place;

sw_between sw_turning_step(const sw_integrator *m, double h, double last_h, double *kept) {
  const place before = {0.5 * last_h * last_h, kept[SW_TURN_LAG_BEFORE] - last_h};
  const double lag = kept[SW_TURN_LAG], at_start = 1.0 + kept[SW_TURN_EXCESS];
  const sw_between none = {NAN, 0, 0};
  place y[SW_STAGES_MAX] = {{0, 0}, {0, 0}};
  double found[SW_STAGES_MAX] = {1, 1};
  kept[SW_TURN_LAG_BEFORE] = lag;
  kept[SW_TURN_LAG] = kept[SW_TURN_EXCESS] = 0;
  if (!m->stages || !(m->flags & SW_INTEGRATOR_IMPLICIT) || m->flags & SW_INTEGRATOR_ONWARDS)
    return none;
  for (size_t k = 0; k < m->stages; k++) {
    const sw_stage_row *row = &m->rows[k];
    const double t = row->time * h, hbar = row->hbar * h;
    const double r = row->xv * hbar * lag + row->x1 * y[0].r + row->xp * before.r;
    const double u =
        row->xn * lag + row->xv * hbar * at_start + row->x1 * y[0].u + row->xp * before.u;
    y[k].r = 0.5 * t * t;
    y[k].u = (y[k].r - r) / hbar;
    found[k] = (y[k].u - u) / hbar;
  }
  const size_t last = m->stages - 1;
  kept[SW_TURN_LAG] = y[last].u - h;
  kept[SW_TURN_EXCESS] = found[last] - 1.0;
  if (m->stages != 2 || fabs(found[1] - 1.0) < CLOSE) return none;
  const double apart = found[1] - found[0], share = (1.0 - found[0]) / apart;
  if (!(fabs(apart) > ALIKE && share > 0 && share < 1)) return none;
  const double apart_h = (m->rows[1].time - m->rows[0].time) * h;
  return (sw_between){share, (1.0 - share) * apart_h, m->rows[0].time};
}
