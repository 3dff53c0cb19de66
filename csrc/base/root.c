/* SPDX-License-Identifier: GPL-3.0-or-later */
/* False position with the Illinois rule (see the header). */
#include "base/root.h"

#include <math.h>

void sw_bracket_clear(sw_bracket *b) {
  b->off[0] = b->off[1] = NAN;
  b->last_side = -1;
}

int sw_bracket_add(sw_bracket *b, double at, double off) {
  const int side = off > 0;
  b->tried[side] = at, b->off[side] = off;
  return side;
}

void sw_bracket_mend(sw_bracket *b, int falls, double at, double off) {
  const int other = !(off > 0), above = other == falls; /* 1: at must be above the other side */
  const double way = at - b->tried[other];
  if (isfinite(b->off[other]) && !(above ? way > 0 : way < 0)) b->off[other] = NAN;
}

int sw_bracket_closed(const sw_bracket *b) { return isfinite(b->off[0]) && isfinite(b->off[1]); }

double sw_bracket_width(const sw_bracket *b) { return b->tried[1] - b->tried[0]; }

double sw_bracket_slope(const sw_bracket *b) {
  return (b->off[1] - b->off[0]) / sw_bracket_width(b);
}

void sw_bracket_weigh(sw_bracket *b, int side) {
  if (b->last_side == side) b->off[!side] *= 0.5;
  b->last_side = side;
}

double sw_bracket_root(const sw_bracket *b) {
  return b->tried[0] + sw_bracket_width(b) * b->off[0] / (b->off[0] - b->off[1]);
}
