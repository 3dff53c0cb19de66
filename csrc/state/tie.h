/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of a tie. It pulls two places together where they are further apart than its slack, with
 * the energy 1/2 k (d - slack)^2, until it is pulled harder than its strength and breaks. */
#ifndef SW_STATE_TIE_H
#define SW_STATE_TIE_H

#include <math.h>

#include "base/param.h"
#include "base/vec.h"

/* Stiffness of a nylon tie round a few millimetres. At half or twice the value, a tie that bears 80
 * N stretches by 1.6 or 0.4 mm [N/m]. */
#define SW_TIE_STIFFNESS 1e5

/* Parameter rows that describe a tie. */
#define SW_TIE_ROWS(args)                                                                      \
  SW_NUMBER_ROW(args, slack, "m", 0, 0, HUGE_VAL, 0, "distance below which it does not pull"), \
      SW_NUMBER_ROW(args, stiffness, "N/m", SW_TIE_STIFFNESS, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, \
                    "stiffness of the taut tie"),                                              \
      SW_NUMBER_ROW(args, strength, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN,                 \
                    "pull at which it breaks (default: never)")

/* A step in which a tie breaks must end with a pull of at most this share above its strength. At
 * twice the value the break is recorded up to 2 % late; at half, steps are cut once more [-]. */
static const double SW_TIE_CLOSE = 0.01;

/* Returns the pull of a tie whose places are this distance apart [m], [N]. */
static inline double sw_tie_pull(double k, double slack, double distance) {
  return k * fmax(0.0, distance - slack);
}

/* Computes w times the stiffness of a taut tie between places that are apart by d: k (n n' + (1 -
 * slack/|d|) (I - n n')), n = d/|d| [N/m]. */
static inline void sw_tie_stiffness(double k, double slack, sw_vec d, double w, double K[9]) {
  const double size = sw_norm(d), along = w * k;
  const double across = size > 0 ? along * (1.0 - slack / size) : along;
  const sw_vec unit = size > 0 ? sw_scale(d, 1.0 / size) : sw_v(0, 0, 0);
  const double n[3] = {unit.x, unit.y, unit.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      K[3 * i + j] = (along - across) * n[i] * n[j] + (i == j ? across : 0.0);
}

/* A taut tie swings on the places that it pulls at: its stiffness [N/m], the mass of these places
 * along the tie (infinite: no place moves) [kg], the rate at which it lengthens [m/s], and its
 * largest pull so far [N]. */
typedef struct sw_tie_swing {
  double stiffness, mass, rate, peak;
} sw_tie_swing;

/* What happened to a tie, as kept in histories. */
enum { SW_TIE_BROKEN, SW_TIE_BROKEN_TIME, SW_TIE_BROKEN_FORCE, SW_TIE_PEAK, SW_TIE_FATE };

/* Notes the pull on a tie in the accepted state at a time; 1: it breaks now [N], [s]. */
static inline int sw_tie_suffers(double pull, double strength, double time, double *fate) {
  if (fate[SW_TIE_BROKEN] > 0) return 0;
  fate[SW_TIE_PEAK] = fmax(fate[SW_TIE_PEAK], pull);
  if (!(pull > strength)) return 0;
  fate[SW_TIE_BROKEN] = 1, fate[SW_TIE_BROKEN_TIME] = time, fate[SW_TIE_BROKEN_FORCE] = pull;
  return 1;
}

/* 1 if it breaks well within the step that led there. */
static inline int sw_tie_breaks_early(double pull, double strength) {
  return pull > (1.0 + SW_TIE_CLOSE) * strength;
}

#endif
