/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newton's method for three targets in three unknowns, all as logarithms. Derivatives by stiffness
 * are exact; the derivative by radius comes from a finite difference. */
#include "calibrate/shell_fit.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"

static const double GOOD = 1e-11;   /* residual that ends the search [-] */
static const double SMALL = 1e-4;   /* change of log radius in the finite difference [-] */
static const double SETTLED = 0.02; /* residual below which that derivative is reused [-] */
static const double STEP = 1.5;     /* largest step of log stiffness [-] */
static const double TURN = 0.15;    /* largest step of log radius [-] */
static const double LEAST = 0.05;   /* least share of the whole in the lines' first guess [-] */
static const double FAR = 3;        /* largest ratio of ring radius and wall's, either way [-] */
static const double FLOOR = 1e-12;  /* stiffness over the first guess that is lost [-] */
enum { STEPS = 30, PART = SW_CELL_SIZE + 1 };

enum { LINES, DIAGONALS, RADIUS, UNKNOWNS };

static const uint32_t with_lines[] = {SW_GROUP_LONGITUDINAL, SW_GROUP_HOOP, SW_GROUP_BRACE};
enum { WITH_LINES = sizeof with_lines / sizeof with_lines[0] };

static const size_t entry[SW_SHELL_TARGETS] = {SW_CELL_STRETCH * (SW_CELL_STRAINS + 1),
                                               SW_CELL_ABOUT_Y *(SW_CELL_STRAINS + 1),
                                               SW_CELL_TWIST *(SW_CELL_STRAINS + 1)};

static double of_part(const double *parts, uint32_t group, int target) {
  return parts[group * PART + entry[target]];
}

void sw_shell_guess(sw_calibration *c, sw_cell shell, const double *target) {
  double one[SW_GROUPS], S[SW_CELL_SIZE], parts[SW_GROUPS * PART];
  for (size_t g = 0; g < SW_GROUPS; g++) one[g] = 1;
  sw_cell_affine(&shell, one, S, parts);
  const double k = target[SW_SHELL_GJ] / of_part(parts, SW_GROUP_DIAGONAL, SW_SHELL_GJ);
  const double all = target[SW_SHELL_EA] / of_part(parts, SW_GROUP_LONGITUDINAL, SW_SHELL_EA);
  const double carried = k * of_part(parts, SW_GROUP_DIAGONAL, SW_SHELL_EA) / target[SW_SHELL_EA];
  c->k[SW_GROUP_DIAGONAL] = k;
  c->k[SW_GROUP_LONGITUDINAL] = all * fmax(LEAST, 1 - carried);
  for (size_t m = 0; m < shell.links; m++) { /* bars with the same modulus */
    const sw_cell_link *l = shell.link + m;
    const double ratio = shell.spacing / sw_cell_length(&shell, l);
    if (l->group == SW_GROUP_HOOP || l->group == SW_GROUP_BRACE)
      c->k[l->group] = all * ratio * ratio;
  }
}

typedef struct newton {
  sw_calibration *c;
  const double *target;
  sw_cell cell;
  double left[SW_SHELL_TARGETS];             /* log of reached over target [-] */
  double slope[SW_SHELL_TARGETS * UNKNOWNS]; /* its derivatives by the unknowns [-] */
} newton;

/* Evaluates left, and slope unless it is NULL (without the radius). */
static sw_status evaluate(const newton *n, double *left, double *slope, sw_error *err) {
  double parts[SW_GROUPS * PART];
  sw_cell_result result;
  if (sw_interrupted()) return SW_EINTR;
  SW_TRY(sw_cell_stiffness(&n->cell, n->c->k, &result, parts, err));
  for (int t = 0; t < SW_SHELL_TARGETS; t++) {
    const double value = fmax(result.S[entry[t]], DBL_MIN);
    left[t] = log(value / n->target[t]);
    if (!slope) continue;
    double lines = 0;
    for (int g = 0; g < WITH_LINES; g++) lines += of_part(parts, with_lines[g], t);
    slope[t * UNKNOWNS + LINES] = lines / value;
    slope[t * UNKNOWNS + DIAGONALS] = of_part(parts, SW_GROUP_DIAGONAL, t) / value;
  }
  return SW_OK;
}

static void move_ring(newton *n, double by) {
  sw_composite_resize(&n->c->composite, &n->c->lattice, n->c->composite.ring_radius * exp(by));
}

static sw_status slope_by_radius(newton *n, sw_error *err) {
  double moved[SW_SHELL_TARGETS];
  move_ring(n, SMALL);
  const sw_status status = evaluate(n, moved, NULL, err);
  move_ring(n, -SMALL);
  for (int t = 0; t < SW_SHELL_TARGETS && status == SW_OK; t++)
    n->slope[t * UNKNOWNS + RADIUS] = (moved[t] - n->left[t]) / SMALL;
  return status;
}

/* Solves slope step = -left by Cramer's rule; 0: no finite solution. */
static int solve(const newton *n, double step[UNKNOWNS]) {
  sw_vec column[UNKNOWNS];
  for (int u = 0; u < UNKNOWNS; u++)
    column[u] = sw_v(n->slope[u], n->slope[UNKNOWNS + u], n->slope[2 * UNKNOWNS + u]);
  const sw_vec right = sw_neg(sw_load(n->left));
  const sw_vec a = column[0], b = column[1], c = column[2];
  const double whole = sw_dot(a, sw_cross(b, c));
  step[0] = sw_dot(right, sw_cross(b, c)) / whole;
  step[1] = sw_dot(a, sw_cross(right, c)) / whole;
  step[2] = sw_dot(a, sw_cross(b, right)) / whole;
  return isfinite(step[0]) && isfinite(step[1]) && isfinite(step[2]);
}

static void take(newton *n, const double step[UNKNOWNS]) {
  const double most =
      fmax(fmax(fabs(step[LINES]), fabs(step[DIAGONALS])) / STEP, fabs(step[RADIUS]) / TURN);
  const double part = 1 / fmax(1, most);
  for (int g = 0; g < WITH_LINES; g++) n->c->k[with_lines[g]] *= exp(part * step[LINES]);
  n->c->k[SW_GROUP_DIAGONAL] *= exp(part * step[DIAGONALS]);
  move_ring(n, part * step[RADIUS]);
}

static double worst(const newton *n) {
  double most = 0;
  for (int t = 0; t < SW_SHELL_TARGETS; t++) most = fmax(most, fabs(n->left[t]));
  return most;
}

/* The best shell so far. */
typedef struct kept {
  double off, k[SW_GROUPS], ring_radius;
} kept;

static void keep(const newton *n, kept *best) {
  best->off = worst(n);
  best->ring_radius = n->c->composite.ring_radius;
  memcpy(best->k, n->c->k, sizeof best->k);
}

static int is_lost(const newton *n, const double *first) {
  const sw_composite *c = &n->c->composite;
  return c->ring_radius > FAR * c->radius || c->ring_radius < c->bore / FAR ||
         n->c->k[SW_GROUP_LONGITUDINAL] < FLOOR * first[SW_GROUP_LONGITUDINAL] ||
         n->c->k[SW_GROUP_DIAGONAL] < FLOOR * first[SW_GROUP_DIAGONAL];
}

sw_status sw_shell_fit(sw_calibration *c, sw_cell cell, const double *target, sw_error *err) {
  newton n = {.c = c, .target = target, .cell = cell};
  double first[SW_GROUPS], step[UNKNOWNS];
  kept best;
  keep(&n, &best);
  best.off = HUGE_VAL;
  memcpy(first, c->k, sizeof first);
  for (int i = 0; i < STEPS && !is_lost(&n, first); i++) {
    SW_TRY(evaluate(&n, n.left, n.slope, err));
    if (worst(&n) < best.off) keep(&n, &best);
    if (worst(&n) < GOOD) break;
    if (i == 0 || worst(&n) > SETTLED) SW_TRY(slope_by_radius(&n, err));
    if (!solve(&n, step)) break;
    take(&n, step);
  }
  memcpy(c->k, best.k, sizeof best.k);
  sw_composite_resize(&c->composite, &c->lattice, best.ring_radius);
  return SW_OK;
}
