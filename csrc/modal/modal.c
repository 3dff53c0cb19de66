/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the lowest modes in four steps. (1) Choose a shift below the lowest eigenvalue. (2) Grow a
 * block Krylov space of the inverse about the shift until the wanted values converge. (3) Count
 * negative pivots to make sure that no value was missed. (4) Do a last Rayleigh-Ritz step with K
 * itself, so that the factor's rounding enters the values only squared. */
#include "modal/modal.h"

#include <float.h>
#include <math.h>

#include "base/alloc.h"
#include "modal/eigen.h"
#include "modal/krylov.h"
#include "system/linear.h"

/* Residual of a Ritz pair of the inverse, over its value, at which it has converged. The value is
 * then exact to the square of this [-]. */
static const double CONVERGED = 1e-7;
/* The count of eigenvalues includes this share of the span from the shift to the last wanted value
 * beyond that value [-]. */
static const double BEYOND = 1e-6;
/* Values below this share of the last wanted one count as 0 [-]. */
static const double NEUTRAL = 1e-9;
/* Distance of the shift below zero, over the last wanted value [-]. */
static const double BELOW_ZERO = 0.05;
/* Rounding shifts a value by d before the last Rayleigh-Ritz step, and after it by about d^2 over
 * the values left out. Allowed is this share of the value itself, or of the last value taken in
 * [-]. */
static const double ROUNDING = 1e-3, ROUNDING_FLOOR = 1e-9;
/* More values than wanted are taken in if their residual over their value is at most this [-]. */
static const double NEARLY = 0.1;
/* Rounding of the matrix, over its largest entries [-]. */
static const double MATRIX_ROUNDING = 128 * DBL_EPSILON;
enum { SPARE = 8, MOST_UNSTABLE = 100, MOST_NEUTRAL = 60 };

typedef struct job {
  const sw_system *system;
  size_t body, n, free_unknowns;
  size_t target;          /* number of lowest values searched for, unstable ones included */
  double floor;           /* rounding of the matrix; values below it need the last step [rad2/s2] */
  double scale;           /* of the last value searched for, or the floor [rad2/s2] */
  double slow;            /* negative values up to this size count as 0 [rad2/s2] */
  double neutral;         /* values up to this size count as 0 [rad2/s2] */
  double shift;           /* [rad2/s2] */
  double *factor, *other; /* factor of K - shift M; one for counting */
  int (*interrupted)(void);
  sw_krylov krylov;
  double *values, *vectors, *scratch, *residuals; /* Ritz pairs */
  sw_error *err;
} job;

static sw_status out_of_memory(const job *p) {
  return sw_fail(p->err, SW_ENOMEM, "frequencies: out of memory");
}

/* Counts the eigenvalues below `at`. If the matrix is exactly singular there, `at` is moved a
 * little. */
static sw_status count_below(const job *p, double at, double *factor, size_t *count) {
  for (int k = 0; k < 4; k++) {
    if (sw_system_factor(p->system, p->body, at, factor, count) == SW_OK) return SW_OK;
    at += 1e-7 * fabs(at);
  }
  return sw_fail(p->err, SW_EDIVERGED, "frequencies: the stiffness is not a finite number");
}

/* Finds a value below which there are at least `wanted` eigenvalues, but which is not many times
 * higher than the last of them. */
static sw_status bracket(const job *p, size_t wanted, double *high) {
  const double step = 16.0;
  double low = p->floor;
  size_t count;
  *high = p->floor;
  SW_TRY(count_below(p, *high, p->other, &count));
  while (count < wanted && isfinite(*high)) {
    low = *high;
    *high *= step;
    SW_TRY(count_below(p, *high, p->other, &count));
  }
  while (*high > 2.0 * low) {
    const double middle = sqrt(low * *high);
    SW_TRY(count_below(p, middle, p->other, &count));
    if (count >= wanted)
      *high = middle;
    else
      low = middle;
  }
  return SW_OK;
}

static sw_status choose_shift(job *p, size_t modes) {
  size_t unstable, below, soft;
  p->floor = MATRIX_ROUNDING * sw_system_stiffest(p->system, p->body, p->other);
  SW_TRY(count_below(p, -p->floor, p->other, &unstable));
  if (unstable > MOST_UNSTABLE)
    return sw_fail(p->err, SW_EDIVERGED,
                   "frequencies: the state is unstable in %zu directions (slack, or compressed far "
                   "beyond buckling); call scene:settle() before",
                   unstable);
  p->target = modes + unstable;
  if (p->target > p->free_unknowns) p->target = p->free_unknowns;
  SW_TRY(count_below(p, p->floor, p->other, &soft));
  /* real values among the soft ones show only against the first one that is not soft */
  if (soft >= p->target && soft < p->target + MOST_NEUTRAL && soft < p->free_unknowns)
    p->target = soft + 1;
  SW_TRY(bracket(p, p->target, &p->scale));
  p->neutral = soft >= p->target ? p->floor : NEUTRAL * p->scale;
  p->shift = -fmax(BELOW_ZERO * p->scale, 4 * p->floor);
  do {
    SW_TRY(count_below(p, p->shift, p->factor, &below));
    if (below == 0) return SW_OK;
    p->shift *= 4;
  } while (isfinite(p->shift));
  return sw_fail(p->err, SW_EDIVERGED, "frequencies: no lowest frequency was found");
}

/* --- Krylov space ------------------------------------------------------------- */

/* Returns the i-th lowest eigenvalue by the present Ritz values. */
static double lowest(const job *p, size_t i) {
  return p->shift + 1.0 / p->values[p->krylov.done - 1 - i];
}

static int settled(const job *p) {
  const size_t m = p->krylov.done;
  if (m < p->target) return 0;
  for (size_t i = 0; i < p->target; i++) {
    const double theta = p->values[m - 1 - i];
    if (!(theta > 0) || p->residuals[m - 1 - i] > CONVERGED * theta) return 0;
  }
  return 1;
}

/* *yes = 1 if all eigenvalues up to the last wanted one were found. Neutral ones are not counted:
 * there may be any number of them. */
static sw_status complete(const job *p, int *yes) {
  const double last = lowest(p, p->target - 1), at = last + BEYOND * (last - p->shift);
  size_t found = 0, there = 0;
  *yes = 1;
  if (last <= p->floor) return SW_OK;
  while (found < p->krylov.done && p->values[p->krylov.done - 1 - found] > 0 &&
         lowest(p, found) <= at)
    found++;
  SW_TRY(count_below(p, at, p->other, &there));
  *yes = there <= found;
  return SW_OK;
}

static sw_status look(job *p, int *finished) {
  *finished = 0;
  const sw_status status =
      sw_krylov_ritz(&p->krylov, p->scratch, p->values, p->vectors, p->residuals);
  if (status == SW_ENOMEM) return out_of_memory(p);
  if (status != SW_OK) return sw_fail(p->err, status, "frequencies: the numbers are not finite");
  if (!settled(p)) return SW_OK;
  SW_TRY(complete(p, finished));
  if (*finished) return SW_OK;
  return sw_krylov_add_random(&p->krylov, 1) == SW_ENOMEM ? out_of_memory(p) : SW_OK;
}

static sw_status iterate(job *p) {
  sw_krylov *k = &p->krylov;
  size_t next_look = p->target;
  sw_status status = sw_krylov_add_random(k, SW_KRYLOV_BLOCK);
  for (int finished = 0; status == SW_OK;) {
    if (p->interrupted && p->interrupted()) return SW_EINTR;
    status = sw_krylov_extend(k);
    if (status == SW_ELIMIT)
      return sw_fail(p->err, SW_ENOCONV, "frequencies: no convergence in %zu directions", k->count);
    if (status != SW_OK) break;
    const int exhausted = k->done == k->count;
    if (k->done >= next_look || exhausted) {
      SW_TRY(look(p, &finished));
      if (finished || k->done == p->free_unknowns) return SW_OK;
      next_look = k->done + k->done / 8 + 1;
    }
    if (exhausted) status = sw_krylov_add_random(k, SW_KRYLOV_BLOCK);
    if (status == SW_OK && k->done == k->count) return look(p, &finished); /* nothing is left */
  }
  return status == SW_ENOMEM ? out_of_memory(p)
                             : sw_fail(p->err, SW_EDIVERGED, "frequencies: numbers not finite");
}

/* --- last Rayleigh-Ritz --------------------------------------------------------- */

/* Projects K and M on q Ritz vectors x; w and w + n are scratch. */
static void project(const job *p, double *const *x, size_t q, double *w, double *a, double *b) {
  for (size_t j = 0; j < q; j++) {
    sw_system_stiffness_times(p->system, p->body, x[j], w);
    sw_system_mass_times(p->system, p->body, x[j], w + p->n);
    for (size_t i = 0; i <= j; i++) {
      a[i * q + j] = a[j * q + i] = sw_krylov_dot(x[i], w, p->n);
      b[i * q + j] = b[j * q + i] = sw_krylov_dot(x[i], w + p->n, p->n);
    }
  }
}

static sw_status compare(const job *p, const double *before, const double *after, size_t q) {
  const double beyond = before[q - 1], least = ROUNDING_FLOOR * beyond;
  for (size_t i = 0; i < p->target && p->neutral < p->floor; i++) {
    const double d = after[i] - before[i];
    if (!(d * d / beyond <= fmax(ROUNDING * fabs(after[i]), least)))
      return sw_fail(
          p->err, SW_EDIVERGED,
          "frequencies: rounding errors hide the softest modes among %zu nodes; use fewer segments",
          p->system->bodies[p->body].plan->nodes);
  }
  return SW_OK;
}

/* Makes the largest component positive, so that the same scene gives the same signs. */
static void set_sign(double *x, size_t n) {
  double most = 0;
  for (size_t i = 0; i < n; i++)
    if (fabs(x[i]) > fabs(most)) most = x[i];
  for (size_t i = 0; most < 0 && i < n; i++) x[i] = -x[i];
}

static void finish(const job *p, const double *values, const double *turn, double *const *x,
                   size_t q, sw_modes *out) {
  for (size_t r = 0; r < out->count; r++) {
    double *shape = out->shapes + r * p->n;
    for (size_t j = 0; j < q; j++)
      for (size_t i = 0; i < p->n; i++) shape[i] += turn[r * q + j] * x[j][i];
    set_sign(shape, p->n);
    const int none = fabs(values[r]) <= p->neutral || (values[r] < 0 && values[r] >= -p->slow);
    out->omega2[r] = none ? 0.0 : values[r];
    out->unstable += out->omega2[r] < 0;
  }
}

static sw_status solve_again(const job *p, double *const *x, size_t q, double *dense, double *w,
                             sw_modes *out) {
  double *a = dense, *b = a + q * q, *turn = b + q * q, *values = turn + q * q;
  double *before = values + q;
  for (size_t r = 0; r < q; r++) {
    before[r] = lowest(p, r);
    sw_krylov_combine(&p->krylov, p->vectors + (p->krylov.done - 1 - r) * p->krylov.done, w);
    /* once more through the inverse: this removes small errors along stiff directions */
    sw_system_mass_times(p->system, p->body, w, x[r]);
    sw_system_factor_solve(p->system, p->body, p->factor, x[r]);
    for (size_t i = 0; i < p->n; i++) x[r][i] *= before[r] - p->shift;
  }
  project(p, x, q, w, a, b);
  const sw_status status = sw_eigen_dense(a, b, q, values, turn);
  if (status == SW_ENOMEM) return out_of_memory(p);
  if (status != SW_OK) return sw_fail(p->err, status, "frequencies: the numbers are not finite");
  SW_TRY(compare(p, before, values, q));
  out->count = p->target;
  out->unknowns = p->n;
  out->omega2 = sw_alloc(out->count, sizeof *out->omega2);
  out->shapes = sw_alloc(out->count * p->n, sizeof *out->shapes);
  if (!out->omega2 || !out->shapes) return out_of_memory(p);
  finish(p, values, turn, x, q, out);
  return SW_OK;
}

static sw_status polish(const job *p, sw_modes *out) {
  const size_t m = p->krylov.done;
  size_t q = 0;
  while (q < m && q < p->target + SPARE && p->residuals[m - 1 - q] <= NEARLY * p->values[m - 1 - q])
    q++;
  if (q < p->target)
    return sw_fail(p->err, SW_ENOCONV, "frequencies: only %zu of %zu were found", q, p->target);
  double **x = sw_alloc(q, sizeof *x);
  double *dense = sw_alloc(3 * q * q + 2 * q, sizeof *dense);
  double *w = sw_alloc(2 * p->n, sizeof *w);
  sw_status status = x && dense && w ? SW_OK : SW_ENOMEM;
  for (size_t r = 0; status == SW_OK && r < q; r++) {
    x[r] = sw_alloc(p->n, sizeof *x[r]);
    if (!x[r]) status = SW_ENOMEM;
  }
  if (status == SW_OK)
    status = solve_again(p, x, q, dense, w, out);
  else
    out_of_memory(p);
  for (size_t r = 0; x && r < q; r++) sw_free(x[r]);
  SW_FREE_ALL(x, dense, w);
  return status;
}

/* --- the whole ------------------------------------------------------------------ */

static sw_status run(job *p, size_t modes, sw_modes *out) {
  SW_TRY(choose_shift(p, modes));
  size_t most = 6 * p->target + 150;
  if (most > p->free_unknowns) most = p->free_unknowns;
  most += 1; /* the vector beyond a full space is zero, but it needs room */
  p->values = sw_alloc(2 * most, sizeof *p->values);
  p->residuals = p->values ? p->values + most : NULL;
  p->vectors = sw_alloc(most * most, sizeof *p->vectors);
  p->scratch = sw_alloc(most * most, sizeof *p->scratch);
  if (!p->values || !p->vectors || !p->scratch) return out_of_memory(p);
  if (sw_krylov_new(&p->krylov, p->system, p->body, p->factor, most) != SW_OK)
    return out_of_memory(p);
  SW_TRY(iterate(p));
  return polish(p, out);
}

sw_status sw_modal_solve(const sw_system *system, size_t body, size_t modes, double slow,
                         int (*interrupted)(void), sw_modes *out, sw_error *err) {
  job p = {.system = system,
           .body = body,
           .n = sw_system_unknowns(system, body),
           .free_unknowns = sw_system_free_unknowns(system, body),
           .interrupted = interrupted,
           .slow = slow,
           .err = err};
  *out = (sw_modes){0};
  if (modes > p.free_unknowns)
    return sw_fail(err, SW_EINVAL, "frequencies: %zu modes are more than the %zu free unknowns",
                   modes, p.free_unknowns);
  const size_t size = sw_system_factor_size(system, body);
  p.factor = sw_alloc(size, sizeof *p.factor);
  p.other = sw_alloc(size, sizeof *p.other);
  const sw_status status = p.factor && p.other ? run(&p, modes, out) : out_of_memory(&p);
  sw_krylov_free(&p.krylov);
  SW_FREE_ALL(p.values, p.vectors, p.scratch, p.factor, p.other);
  if (status != SW_OK) sw_modes_free(out);
  return status;
}

sw_status sw_modal_unstable(const sw_system *system, size_t body, double slow, size_t *count) {
  sw_error ignored;
  double *factor SW_LOCAL = sw_alloc(sw_system_factor_size(system, body), sizeof *factor);
  if (!factor) return SW_ENOMEM;
  const job p = {.system = system, .body = body, .err = &ignored};
  const double floor = MATRIX_ROUNDING * sw_system_stiffest(system, body, factor);
  return count_below(&p, -fmax(slow, floor), factor, count);
}

void sw_modes_free(sw_modes *modes) {
  sw_free(modes->omega2);
  sw_free(modes->shapes);
  *modes = (sw_modes){0};
}

sw_status sw_modal_unrest(const sw_system *system, size_t body, double tau, double *drift,
                          double *axial, sw_error *err) {
  const size_t n = sw_system_unknowns(system, body);
  double *factor SW_LOCAL = sw_alloc(sw_system_factor_size(system, body) + 2 * n, sizeof *factor);
  if (!factor) return sw_fail(err, SW_ENOMEM, "frequencies: out of memory");
  double *d = factor + sw_system_factor_size(system, body), *shifts = d + n;
  *drift = 0;
  sw_system_residual(system, body, d);
  if (sw_system_factor(system, body, -1.0 / (tau * tau), factor, NULL) != SW_OK) d[0] = NAN;
  sw_system_factor_solve(system, body, factor, d);
  sw_system_shifts(system, body, d, shifts);
  for (size_t i = 0; i < n && !isnan(*drift); i++)
    if (!(fabs(shifts[i]) <= *drift)) *drift = fabs(shifts[i]);
  *axial = sw_system_axial_error(system, body, d);
  return SW_OK;
}
