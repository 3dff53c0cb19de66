/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Least squares on the logarithms of the groups' stiffnesses, so that all stay above 0. There are
 * more groups than targets. A weak pull towards the previous guess makes the solution unique;
 * moving the guess after each round removes the pull's effect. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/interrupt.h"
#include "calibrate/calibrate_inner.h"
#include "calibrate/least_squares.h"

static const double PULL = 0.03;     /* weight per unit of log stiffness, first round [-] */
static const double WEAKER = 0.1;    /* factor of the pull from round to round [-] */
static const double GOOD = 1e-10;    /* residual that ends the rounds [-] */
static const double HOPELESS = 0.01; /* residual above which little progress ends the rounds [-] */
static const double FAR = 50;        /* largest change of log stiffness from the first guess [-] */
static const double MOST = 1e150;    /* largest stiffness with finite products [N/m] */
static const double LEAST = 0.05;    /* least share of the whole in a group's first guess [-] */
enum { ROUNDS = 6, ITERATIONS = 40, PART = SW_CELL_SIZE + 1 };

const char *const sw_target_names[SW_TARGETS] = {"EA", "EI", "EI2", "GJ", "squeeze"};
const char *const sw_target_units[SW_TARGETS] = {"N", "N m2", "N m2", "N m2", "Pa"};

/* Entry of each target in S. Bending in the plane of x and z is about y. */
static const int entry[SW_TARGET_SQUEEZE] = {
    SW_CELL_STRETCH * (SW_CELL_STRAINS + 1), SW_CELL_ABOUT_Y *(SW_CELL_STRAINS + 1),
    SW_CELL_ABOUT_X *(SW_CELL_STRAINS + 1), SW_CELL_TWIST *(SW_CELL_STRAINS + 1)};

double sw_reached(const sw_cell_result *r, int target) {
  return target == SW_TARGET_SQUEEZE ? r->squeeze : r->S[entry[target]];
}

typedef struct search {
  sw_calibration *c;
  sw_cell cell;
  size_t n;                /* groups that have links [-] */
  size_t group[SW_GROUPS]; /* their numbers */
  double first[SW_GROUPS]; /* log stiffness at the start */
  double guess[SW_GROUPS]; /* log stiffness that the pull leads to */
  double pull;             /* [-] */
} search;

/* Returns the log of the ratio; the worst possible residual if the mesh does not resist at all. */
static double log_ratio(double reached, double target) {
  return reached > DBL_MIN ? log(reached / target) : log(DBL_MIN / target);
}

/* Sets stiffnesses, limited so that a diverging search keeps finite numbers. */
static void set_stiffness(search *s, const double *x) {
  for (size_t i = 0; i < s->n; i++)
    s->c->k[s->group[i]] = exp(s->first[i] + fmax(-FAR, fmin(FAR, x[i] - s->first[i])));
}

static sw_status residuals(void *user, const double *x, double *r, double *jacobian,
                           sw_error *err) {
  search *s = user;
  double parts[SW_GROUPS * PART];
  if (sw_interrupted()) return SW_EINTR;
  set_stiffness(s, x);
  SW_TRY(sw_cell_stiffness(&s->cell, s->c->k, &s->c->reached, parts, err));
  memset(jacobian, 0, (SW_TARGETS + s->n) * s->n * sizeof *jacobian);
  for (int t = 0; t < SW_TARGETS; t++) {
    const double value = sw_reached(&s->c->reached, t);
    const int at = t == SW_TARGET_SQUEEZE ? SW_CELL_SIZE : entry[t];
    r[t] = 0;
    if (isnan(s->c->target[t])) continue;
    r[t] = log_ratio(value, s->c->target[t]);
    for (size_t i = 0; value > DBL_MIN && i < s->n; i++)
      jacobian[(size_t)t * s->n + i] =
          parts[s->group[i] * PART + (size_t)at] / (t == SW_TARGET_SQUEEZE ? 1 : value);
  }
  for (size_t i = 0; i < s->n; i++) {
    r[SW_TARGETS + i] = s->pull * (x[i] - s->guess[i]);
    jacobian[(SW_TARGETS + i) * s->n + i] = s->pull;
  }
  return SW_OK;
}

/* First guess for springs that neither run along the wire nor resist twist: bars with the modulus
 * of the lines along the wire, whose stiffness is base. */
static double bar(const search *s, const sw_cell_link *l, double base) {
  const double h = s->cell.spacing;
  if (l->group == SW_GROUP_BEND) return LEAST * s->c->target[SW_TARGET_EI] / h;
  const double ratio = h / sw_cell_length(&s->cell, l);
  /* small: a tenth of the ring's EA between ring and core */
  if (l->group == SW_GROUP_INCLINED) return LEAST * base / (ratio * ratio);
  return base * ratio * ratio;
}

/* Guesses from the links of weight 1, or from any others in small meshes that have none. */
static void guess_section(const search *s, double base) {
  for (int any = 0; any <= 1; any++)
    for (size_t m = 0; m < s->cell.links; m++) {
      const sw_cell_link *l = s->cell.link + m;
      double *k = s->c->k + l->group;
      if (!(*k > 0) && (any || l->weight > 1 - 1e-9)) *k = bar(s, l, base);
    }
}

/* First guess by closed forms: for sections that stay plane and keep their shape each target is
 * linear in the stiffnesses. GJ gives the diagonals, then EI the lines, then EA the core. */
static void guess(search *s) {
  sw_calibration *c = s->c;
  double one[SW_GROUPS], S[SW_CELL_SIZE], parts[SW_GROUPS * PART];
  for (size_t g = 0; g < SW_GROUPS; g++) one[g] = 1;
  sw_cell_affine(&s->cell, one, S, parts);
#define SHARE(g, t) parts[(size_t)(g)*PART + (size_t)entry[t]]
  const double *target = c->target;
  double *k = c->k;
  memset(k, 0, SW_GROUPS * sizeof *k);
  k[SW_GROUP_DIAGONAL] = target[SW_TARGET_GJ] / SHARE(SW_GROUP_DIAGONAL, SW_TARGET_GJ);
  const double all = target[SW_TARGET_EI] / (SHARE(SW_GROUP_LONGITUDINAL, SW_TARGET_EI) +
                                             SHARE(SW_GROUP_INNER, SW_TARGET_EI));
  const double rest =
      target[SW_TARGET_EI] - k[SW_GROUP_DIAGONAL] * SHARE(SW_GROUP_DIAGONAL, SW_TARGET_EI);
  k[SW_GROUP_LONGITUDINAL] = all * fmax(LEAST, rest / target[SW_TARGET_EI]);
  if (c->links[SW_GROUP_INNER]) k[SW_GROUP_INNER] = k[SW_GROUP_LONGITUDINAL];
  if (c->links[SW_GROUP_CORE]) {
    const double whole = target[SW_TARGET_EA];
    double carried = 0;
    for (size_t g = 0; g < SW_GROUPS; g++)
      if (g != SW_GROUP_CORE) carried += k[g] * SHARE(g, SW_TARGET_EA);
    k[SW_GROUP_CORE] = fmax(LEAST * whole, whole - carried) / SHARE(SW_GROUP_CORE, SW_TARGET_EA);
  }
#undef SHARE
  guess_section(s, all);
}

double sw_calibrate_residuals(sw_calibration *c) {
  double most = 0;
  for (int t = 0; t < SW_TARGETS; t++) {
    c->residual[t] = sw_reached(&c->reached, t) / c->target[t] - 1; /* NAN without a target */
    if (!isnan(c->residual[t])) most = fmax(most, fabs(c->residual[t]));
  }
  return most;
}

void sw_calibrate_count(sw_calibration *c) {
  memset(c->links, 0, sizeof c->links);
  for (size_t m = 0; m < c->lattice.links; m++) c->links[c->lattice.link[m].group]++;
  for (size_t m = 0; m < c->lattice.solids; m++) c->links[c->lattice.solid[m].group]++;
}

/* Lists the groups that have links, and sets the start of their search. */
static sw_status begin(search *s, double *x, sw_error *err) {
  sw_calibration *c = s->c;
  sw_calibrate_count(c);
  if (!c->lattice.solids) guess(s);
  for (size_t g = 0; g < SW_GROUPS; g++) {
    if (!c->links[g]) continue;
    if (!(c->k[g] > 1 / MOST) || !(c->k[g] < MOST))
      return sw_fail(err, SW_EINVAL,
                     "calibrate: EA = %g N, EI = %g N m2 and GJ = %g N m2 with slices every %g m "
                     "ask for %s springs beyond what numbers can hold",
                     c->target[SW_TARGET_EA], c->target[SW_TARGET_EI], c->target[SW_TARGET_GJ],
                     s->cell.spacing, sw_group_names[g]);
    x[s->n] = s->guess[s->n] = s->first[s->n] = log(c->k[g]);
    s->group[s->n++] = g;
  }
  return SW_OK;
}

static void find_faded(const search *s) {
  sw_calibration *c = s->c;
  c->faded = SW_GROUPS;
  c->fading = 1;
  for (size_t i = 0; i < s->n; i++) {
    const double ratio = c->k[s->group[i]] / exp(s->first[i]);
    if (ratio >= c->fading) continue;
    c->faded = (int)s->group[i];
    c->fading = ratio;
  }
}

sw_status sw_calibrate_fit(sw_calibration *c, sw_error *err) {
  search s = {.c = c, .cell = sw_lattice_cell(&c->lattice), .pull = PULL};
  double x[SW_GROUPS] = {0}, before = HUGE_VAL;
  SW_TRY(begin(&s, x, err));
  for (int round = 0; round < ROUNDS; round++) {
    SW_TRY(sw_least_squares(residuals, &s, s.n, SW_TARGETS + s.n, x, ITERATIONS, err));
    memcpy(s.guess, x, sizeof x);
    set_stiffness(&s, x);
    SW_TRY(sw_cell_stiffness(&s.cell, c->k, &c->reached, NULL, err));
    const double now = sw_calibrate_residuals(c);
    if (now < GOOD || (now > HOPELESS && now > 0.9 * before)) break;
    before = now;
    s.pull *= WEAKER;
  }
  find_faded(&s);
  return SW_OK;
}
