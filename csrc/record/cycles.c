/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rainflow count in bounded room (ASTM E1049-85, 5.4.4). */
#include "record/cycles.h"

#include <math.h>
#include <string.h>

/* Kinds of ranges per octave, and octaves below the widest range: fine kinds, then coarse ones,
 * then a single kind. */
static const double FINE = 16, FINE_OCTAVES = 2, COARSE = 2, COARSE_OCTAVES = 10;

/* Returns the kind of a range for a given widest range. Smaller ranges have smaller kinds. */
static double kind_of(double range, double widest) {
  const double below = log2(widest / range);
  if (below < FINE_OCTAVES) return floor(FINE * log2(range));
  if (below < COARSE_OCTAVES) return floor(COARSE * log2(range)) - 1e6;
  return -1e7;
}

/* Merges two kinds into one that damages at least as much: the ranges' powers of the slope are
 * averaged. */
static sw_cycle joined(const sw_cycle *a, const sw_cycle *b) {
  const double share = a->range / b->range, count = a->count + b->count;
  const double mean = (a->count * pow(share, SW_CYCLES_SLOPE) + b->count) / count;
  return (sw_cycle){.range = b->range * pow(mean, 1.0 / SW_CYCLES_SLOPE),
                    .mean = fmax(a->mean, b->mean),
                    .count = count};
}

/* Merges neighbours of the same kind; if this makes no room, merges the two smallest. */
static int condense(sw_cycle *list, int count) {
  const double widest = list[count - 1].range;
  int n = 0;
  for (int k = 0; k < count; k++) {
    const int same = n > 0 && kind_of(list[n - 1].range, widest) == kind_of(list[k].range, widest);
    if (same)
      list[n - 1] = joined(&list[n - 1], &list[k]);
    else
      list[n++] = list[k];
  }
  if (n <= SW_CYCLES_KEPT) return n;
  list[0] = joined(&list[0], &list[1]);
  memmove(&list[1], &list[2], (size_t)(n - 2) * sizeof *list);
  return n - 1;
}

/* Ranges that differ by less than this share are the same [-]. */
static const double SAME = 1e-12;

static void keep(sw_cycles *c, sw_cycle new) {
  const double count = new.count;
  sw_cycle list[SW_CYCLES_KEPT + 1];
  int k = c->count;
  if (!(new.range > 0)) return;
  while (k > 0 && c->kept[k - 1].range > new.range) k--;
  for (int i = k > 0 ? k - 1 : 0; i <= k && i < c->count; i++) {
    sw_cycle *old = &c->kept[i];
    if (fabs(old->range - new.range) > SAME * new.range) continue;
    old->count += count, old->mean = fmax(old->mean, new.mean);
    return;
  }
  memcpy(list, c->kept, (size_t)k * sizeof *list);
  list[k] = new;
  memcpy(list + k + 1, c->kept + k, (size_t)(c->count - k) * sizeof *list);
  c->count++;
  if (c->count > SW_CYCLES_KEPT) c->count = condense(list, c->count);
  memcpy(c->kept, list, (size_t)c->count * sizeof *list);
}

static double cube(double x) { return x * x * x; }

/* Returns by how much the sum of cubes falls where reversals i and i + 1, with ranges r, s and t at
 * them, are left out. s lies between r and t. */
static double left_out(const double *x, int i) {
  const double r = fabs(x[i] - x[i - 1]), s = fabs(x[i + 1] - x[i]), t = fabs(x[i + 2] - x[i + 1]);
  return cube(r) + cube(t) - cube(r - s + t) - cube(s);
}

/* Keeps a reversal at the start, whose half cycle has been counted. Of too many two are left out:
 * where a swing grows evenly, or not at all, this changes the count of its repetition least. */
static void begin(sw_cycles *c, double value) {
  if (c->begins == SW_CYCLES_OPEN) {
    int best = 1;
    for (int i = 2; i + 2 < c->begins; i++)
      if (left_out(c->begun, i) < left_out(c->begun, best)) best = i;
    c->begins -= 2;
    memmove(c->begun + best, c->begun + best + 2, (size_t)(c->begins - best) * sizeof *c->begun);
  }
  c->begun[c->begins++] = value;
}

static void drop(sw_cycles *c, int first, int count) {
  if (first == 0) begin(c, c->open[0]);
  memmove(c->open + first, c->open + first + count,
          (size_t)(c->opened - first - count) * sizeof *c->open);
  c->opened -= count;
}

static void close_cycles(sw_cycles *c) {
  double *x = c->open;
  while (c->opened >= 3) {
    const int n = c->opened;
    if (fabs(x[n - 1] - x[n - 2]) < fabs(x[n - 2] - x[n - 3])) return;
    keep(c, (sw_cycle){.range = fabs(x[n - 2] - x[n - 3]),
                       .mean = 0.5 * (x[n - 3] + x[n - 2]),
                       .count = n == 3 ? 0.5 : 1.0}); /* of three, the history's start is in it */
    drop(c, n == 3 ? 0 : n - 3, n == 3 ? 1 : 2);
  }
}

/* Returns the cycle that takes the place of reversals i and i + 1 of those that wait, whose ranges
 * only fall. Of the ranges r >= s >= t at them, r and t would close later. Without the two,
 * r - s + t does. The sum of cubes stays; *moved: how much of it moves from r and t to the cycle,
 * beyond s. Little moves where r, s and t are nearly equal, and where they are small. */
static sw_cycle instead(const double *x, int i, double *moved) {
  const double r = fabs(x[i] - x[i - 1]), s = fabs(x[i + 1] - x[i]), t = fabs(x[i + 2] - x[i + 1]);
  const double missing = cube(r) + cube(t) - cube(r - s + t);
  *moved = missing - cube(s);
  return (sw_cycle){
      .range = cbrt(fmax(missing, cube(t))), .mean = 0.5 * (x[i] + x[i + 1]), .count = 1};
}

/* Closes a cycle between two of the reversals that wait, those with which the least is moved. The
 * present value stays. */
static void make_room(sw_cycles *c) {
  double least = HUGE_VAL, moved;
  int best = 1;
  for (int i = 1; i + 2 < c->opened; i++) {
    instead(c->open, i, &moved);
    if (moved < least) least = moved, best = i;
  }
  keep(c, instead(c->open, best, &moved));
  drop(c, best, 2);
}

void sw_cycles_add(sw_cycles *c, double value) {
  double *x = c->open;
  const int n = c->opened;
  if (!isfinite(value) || (n > 0 && value == x[n - 1])) return;
  if (n >= 2 && (x[n - 1] > x[n - 2]) == (value > x[n - 1])) {
    x[n - 1] = value; /* the same direction as before */
  } else {
    if (n == SW_CYCLES_OPEN) make_room(c); /* a decaying oscillation */
    x[c->opened++] = value;
  }
  close_cycles(c);
}

size_t sw_cycles_read(const sw_cycles *c, sw_cycle *out) {
  size_t n = 0;
  for (int k = 0; k < c->count; k++) out[n++] = c->kept[k];
  for (int k = 0; k + 1 < c->opened; k++) {
    const double a = c->open[k], b = c->open[k + 1];
    out[n++] = (sw_cycle){.range = fabs(b - a), .mean = 0.5 * (a + b), .count = 0.5};
  }
  return n;
}

size_t sw_cycles_residue(const sw_cycles *c, double *out) {
  size_t n = 0;
  for (int k = 0; k < c->begins; k++) out[n++] = c->begun[k];
  for (int k = 0; k < c->opened; k++) out[n++] = c->open[k];
  return n;
}

double sw_cycles_widest(const sw_cycles *c) {
  double widest = c->count ? c->kept[c->count - 1].range : 0;
  for (int k = 0; k + 1 < c->opened; k++) widest = fmax(widest, fabs(c->open[k + 1] - c->open[k]));
  return widest;
}

int sw_cycles_sized(const sw_cycles *c) {
  return c->opened >= 0 && c->opened <= SW_CYCLES_OPEN && c->begins >= 0 &&
         c->begins <= SW_CYCLES_OPEN && c->count >= 0 && c->count <= SW_CYCLES_KEPT;
}

int sw_cycles_fine(const sw_cycles *c) {
  if (!sw_cycles_sized(c)) return 0;
  for (int k = 0; k < c->begins; k++)
    if (!isfinite(c->begun[k])) return 0;
  for (int k = 0; k < c->opened; k++)
    if (!isfinite(c->open[k])) return 0;
  for (int k = 0; k < c->count; k++) {
    const sw_cycle *x = &c->kept[k];
    if (!(isfinite(x->range + x->mean + x->count) && x->range >= 0 && x->count > 0)) return 0;
    if (k && x->range < c->kept[k - 1].range) return 0;
  }
  return 1;
}
