/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs an implicit method's table of stages: trial, next step size. */
#include "integrate/integrate.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/simd.h"
#include "integrate/turning.h"
#include "system/wait.h"

#define X(name) extern const sw_integrator sw_integrator_##name;
#include "integrate/list.def"
#undef X

static const sw_integrator *const all[] = {
#define X(name) &sw_integrator_##name,
#include "integrate/list.def"
#undef X
    NULL};

const sw_integrator *const *sw_integrator_all(void) { return all; }

const sw_integrator *sw_integrator_find(const char *name) {
  for (size_t i = 0; all[i]; i++)
    if (strcmp(all[i]->name, name) == 0) return all[i];
  return NULL;
}

static const sw_newton DYNAMIC_NEWTON = {
    .max_iterations = 16,
    .accept_rotation = 0.02, /* the linearised axial law's error stays below theta^2/2 */
    .limit_rotation = 0.5,
    .keeps_energy = 1,
};

sw_status sw_stepper_new(sw_stepper *p, const sw_integrator *method, sw_system *system) {
  memset(p, 0, sizeof *p);
  system->first.x = NULL; /* a pointer of the previous stepper */
  p->method = method;
  p->start = method->start ? sw_integrator_find(method->start) : method;
  p->n = system->freedoms;
  p->restart = 1;
  p->newton = DYNAMIC_NEWTON;
  const int explicit_ = !(method->flags & SW_INTEGRATOR_IMPLICIT);
  const size_t arrays = explicit_ ? 3 + SW_EXTRA : 9, m = system->edges;
  const size_t pulls = sw_system_pulls(system);
  const size_t strains = !explicit_ && system->strain ? system->strains : 0;
  double *w = sw_alloc(arrays * p->n + 5 * strains + 2 * m + 2 * pulls, sizeof *w);
  if (!w) return SW_ENOMEM;
  p->work = w;
  double **const implicit_arrays[] = {&p->xhat, &p->vhat, &p->y[0], &p->w[0], &p->y[1],
                                      &p->w[1], &p->a,    &p->xp,   &p->vp};
  if (explicit_) {
    p->extra = sw_alloc(SW_EXTRA, sizeof *p->extra);
    if (!p->extra) {
      sw_free(w);
      p->work = NULL;
      return SW_ENOMEM;
    }
    p->y[0] = w, p->w[0] = w + p->n, p->a = w + 2 * p->n;
    for (size_t k = 0; k < SW_EXTRA; k++) p->extra[k] = w + (3 + k) * p->n;
  } else {
    for (size_t k = 0; k < 9; k++) *implicit_arrays[k] = w + k * p->n;
  }
  p->tension = w + arrays * p->n;
  p->first = p->tension + m;
  p->pulled[0] = p->first + m, p->pulled[1] = p->pulled[0] + pulls;
  if (!strains) return SW_OK;
  p->strain_before = w + arrays * p->n; /* next to vp: both go to snapshots */
  p->tension = p->strain_before + strains, p->strain_past = p->tension + m;
  p->strain[0] = p->strain_past + strains, p->strain[1] = p->strain[0] + strains;
  p->strain_rate = p->strain[1] + strains;
  p->first = p->strain_rate + strains;
  p->pulled[0] = p->first + m, p->pulled[1] = p->pulled[0] + pulls;
  return SW_OK;
}

size_t sw_stepper_history(const sw_stepper *p, const sw_system *s) {
  return 2 * p->n + (p->strain_before ? s->strains : 0);
}

void sw_stepper_free(sw_stepper *p) {
  if (p->outside && p->free_outside) p->free_outside(p->outside);
  sw_free(p->extra);
  sw_free(p->work);
  memset(p, 0, sizeof *p);
}

/* out = a x + b y */
SW_HOT
static void combine(size_t n, double a, const double *restrict x, double b,
                    const double *restrict y, double *restrict out) {
  for (size_t i = 0; i < n; i++) out[i] = a * x[i] + b * y[i];
}

SW_HOT
static void add(size_t n, double a, const double *restrict x, double *restrict out) {
  for (size_t i = 0; i < n; i++) out[i] += a * x[i];
}

/* Computes the stage's xhat and vhat. Reads only the row's sources; two sources, the usual number,
 * take one pass. */
static void prepare_stage(const sw_stepper *p, const sw_stage_row *row, const sw_system *s,
                          double hbar) {
  const struct {
    double share;
    const double *x, *v;
  } sources[] = {
      {row->xv * hbar, s->v, s->a}, {row->x1, p->y[0], p->w[0]}, {row->xp, p->xp, p->vp}};
  size_t used = 0;
  for (size_t k = 0; k < 3; k++) {
    const double share = sources[k].share;
    if (share == 0) continue;
    if (used++) {
      add(p->n, share, sources[k].x, p->xhat);
      add(p->n, share, sources[k].v, p->vhat);
    } else {
      combine(p->n, row->xn, s->x, share, sources[k].x, p->xhat);
      combine(p->n, row->xn, s->v, share, sources[k].v, p->vhat);
    }
  }
  if (row->xa != 0) add(p->n, row->xa * hbar * hbar, s->a, p->xhat);
  if (row->va != 0) add(p->n, row->va * hbar, s->a, p->vhat);
  if (used) return;
  combine(p->n, row->xn, s->x, 0, s->x, p->xhat);
  combine(p->n, row->xn, s->v, 0, s->v, p->vhat);
}

/* The same for strains. The guess for the stage: strains change as fast as before. */
static void prepare_strains(const sw_stepper *p, const sw_stage_row *row, const sw_system *s,
                            double hbar, double *guess) {
  const size_t m = s->strains;
  combine(m, row->xn, s->strain, row->xv * hbar, s->strain_rate, p->strain_past);
  if (row->x1 != 0) add(m, row->x1, p->strain[0], p->strain_past);
  if (row->xp != 0) add(m, row->xp, p->strain_before, p->strain_past);
  combine(m, 1.0, p->strain_past, hbar, s->strain_rate, guess);
  if (s->waiting) sw_waits_strain(s, guess);
}

static void find_rates(const sw_stepper *p, const sw_system *s, double hbar, const double *strain) {
  combine(s->strains, 1.0 / hbar, strain, -1.0 / hbar, p->strain_past, p->strain_rate);
  if (s->waiting) sw_waits_strain_rate(s, p->strain_rate);
}

static void book(sw_system *s, sw_booking booking) {
  if (s->coupling.book) s->coupling.book(s->coupling.user, &booking);
}

void sw_stepper_book(sw_stepper *p, sw_system *s, double share) {
  book(s, (sw_booking){.own = share, .first = p->booked ? 1.0 : 0.0});
  p->booked = 1;
}

/* out = from + reach (out - from) */
static void extend(size_t n, double reach, const double *from, double *out) {
  for (size_t i = 0; i < n; i++) out[i] = reach * out[i] + (1.0 - reach) * from[i];
}

/* Extrapolates from the only stage to the end of the step. */
static sw_status go_onwards(sw_stepper *p, const sw_integrator *m, sw_system *s, double end,
                            sw_error *err) {
  extend(p->n, m->reach, s->x, p->y[0]);
  extend(p->n, m->reach, s->v, p->w[0]);
  if (m->keeps > 0) extend(p->n, m->keeps, s->a, p->a);
  book(s, (sw_booking){.first = m->reach}); /* it has one stage */
  sw_system_keep_loads(s);
  extend(s->edges, m->reach, p->tension, s->tension);
  if (p->strain_past) extend(s->strains, m->reach, s->strain, p->strain[0]);
  if (p->strain_past && m->keeps > 0) extend(s->strains, m->reach, s->strain_rate, p->strain_rate);
  return sw_system_place_holds(s, end, p->y[0], p->w[0], NULL, err);
}

/* Integral of the axial forces over time since the step's start. The stages combine it as they
 * combine the velocity. Before a stage is solved, and after. */
static void begin_pull(const sw_stepper *p, size_t k, const sw_stage_row *row, const sw_system *s,
                       double hbar) {
  double *sum = p->pulled[k];
  const size_t pulls = sw_system_pulls(s);
  memset(sum, 0, pulls * sizeof *sum);
  if (row->x1 != 0) add(pulls, row->x1, p->pulled[0], sum);
  if (row->xv != 0) sw_system_add_pull(s, s->x, s->tension, s->strain_rate, row->xv * hbar, sum);
}

static void end_pull(const sw_stepper *p, size_t k, const sw_system *s, double hbar) {
  sw_system_add_pull(s, p->y[k], s->tension, p->strain_rate, hbar, p->pulled[k]);
}

/* Computes the mean over the step. Methods that look back would need that of the previous step. */
static void find_mean(sw_stepper *p, const sw_integrator *m, const sw_system *s, double h) {
  double *sum = p->pulled[m->stages - 1];
  const double share = m->flags & SW_INTEGRATOR_ONWARDS ? m->reach : 1.0;
  p->mean = (m->flags & SW_INTEGRATOR_HISTORY) || m->keeps > 0 ? NULL : sum;
  for (size_t e = 0; p->mean && e < sw_system_pulls(s); e++) sum[e] *= share / h;
}

/* 1 if a stage only goes on from the step's start by its own velocity, and others follow. */
static int is_inner(const sw_integrator *m, size_t k) {
  const sw_stage_row *row = &m->rows[k];
  return k + 1 < m->stages && row->xn == 1 && row->xv == 0 && row->xp == 0 && row->xa == 0;
}

static sw_status solve_stage(sw_stepper *p, const sw_integrator *m, size_t k, sw_system *s,
                             double t, double h, sw_error *err) {
  const sw_stage_row *row = &m->rows[k];
  const double hbar = row->hbar * h;
  sw_stage_report report;
  prepare_stage(p, row, s, hbar);
  if (p->strain_past) prepare_strains(p, row, s, hbar, p->strain[k]);
  const sw_stage stage = {.time = t + row->time * h,
                          .from = m->flags & SW_INTEGRATOR_ONWARDS ? t : 0,
                          .to = m->flags & SW_INTEGRATOR_ONWARDS ? t + h : 0,
                          .inner = is_inner(m, k) ? hbar : 0,
                          .hbar = hbar,
                          .inertia = row->inertia,
                          .first = row->x1,
                          .xhat = p->xhat,
                          .vhat = p->vhat,
                          .y = p->y[k],
                          .v = p->w[k],
                          .a = p->a,
                          .strain_past = p->strain_past,
                          .strain = p->strain[k]};
  begin_pull(p, k, row, s, hbar);
  const sw_status status = sw_system_stage(s, &stage, &p->newton, &report, err);
  p->iterations += (size_t)report.iterations;
  p->rotation = report.rotation;
  if (status != SW_OK) return status;
  if (p->strain_past) find_rates(p, s, hbar, p->strain[k]);
  end_pull(p, k, s, hbar);
  return SW_OK;
}

static sw_status implicit_trial(sw_stepper *p, const sw_integrator *m, sw_system *s, double t,
                                double h, sw_error *err) {
  memcpy(p->turning, s->turning, sizeof p->turning);
  p->between = sw_turning_step(m, h, p->last_h, p->turning);
  for (size_t k = 0; k < m->stages; k++) {
    const sw_stage_row *row = &m->rows[k];
    const double hbar = row->hbar * h;
    SW_TRY(solve_stage(p, m, k, s, t, h, err));
    if (k == 0 && !isnan(p->between.share))
      sw_system_sum_pull(s, s->tension, p->strain_rate, p->first);
    book(s, (sw_booking){.stage = (int)k,
                         .own = row->inertia > 0 ? hbar / row->inertia : hbar,
                         .start = (row->xv + row->va) * hbar,
                         .first = row->x1,
                         .before = row->xp});
  }
  if (!isnan(p->between.share))
    sw_system_find_excess(s, h, p->first, p->y[0], p->strain_rate, p->between);
  find_mean(p, m, s, h);
  const size_t last = m->stages - 1;
  if (m->flags & SW_INTEGRATOR_ONWARDS) SW_TRY(go_onwards(p, m, s, t + h, err));
  p->trial_x = p->y[last];
  p->trial_v = p->w[last];
  p->trial_a = p->a;
  p->trial_strain = p->strain[last];
  return SW_OK;
}

sw_status sw_stepper_trial(sw_stepper *p, sw_system *s, double t, double h, sw_error *err) {
  memcpy(p->tension, s->tension, s->edges * sizeof(double));
  sw_system_begin_step(s);
  p->iterations = 0;
  p->rotation = 0;
  p->used = NULL;
  p->trial_h = h;
  p->booked = 0;
  p->mean = NULL;
  if (!(p->method->flags & SW_INTEGRATOR_IMPLICIT)) {
    memcpy(p->y[0], s->x, p->n * sizeof(double));
    memcpy(p->w[0], s->v, p->n * sizeof(double));
    SW_TRY(p->method->advance(p, s, t, h, p->y[0], p->w[0], err));
    p->trial_x = p->y[0], p->trial_v = p->w[0], p->trial_a = NULL;
    return SW_OK;
  }
  const int uneven =
      (p->method->flags & SW_INTEGRATOR_HISTORY) && !(fabs(h - p->last_h) <= 1e-9 * h);
  const sw_integrator *m = p->plastic             ? sw_integrator_find("implicit-euler")
                           : p->restart || uneven ? p->start
                                                  : p->method;
  if (p->restart) SW_TRY(sw_system_held_anew(s, t, err));
  SW_TRY(implicit_trial(p, m, s, t, h, err));
  p->used = m;
  return SW_OK;
}

void sw_stepper_reject(sw_stepper *p, sw_system *s) {
  memcpy(s->tension, p->tension, s->edges * sizeof(double));
}

void sw_stepper_accept(sw_stepper *p, sw_system *s, double h) {
  if (p->xp && (p->method->flags & SW_INTEGRATOR_HISTORY)) {
    memcpy(p->xp, s->x, p->n * sizeof(double));
    memcpy(p->vp, s->v, p->n * sizeof(double));
    if (p->strain_past) memcpy(p->strain_before, s->strain, s->strains * sizeof(double));
  }
  sw_system_follow(s, p->trial_x);
  memcpy(s->x, p->trial_x, p->n * sizeof(double));
  memcpy(s->v, p->trial_v, p->n * sizeof(double));
  if (p->trial_a) memcpy(s->a, p->trial_a, p->n * sizeof(double));
  if (p->strain_past) {
    memcpy(s->strain, p->trial_strain, s->strains * sizeof(double));
    memcpy(s->strain_rate, p->strain_rate, s->strains * sizeof(double));
  }
  if (p->method->flags & SW_INTEGRATOR_IMPLICIT) {
    memcpy(s->turning, p->turning, sizeof p->turning);
    if (isnan(p->between.share))
      sw_system_uneven(s);
    else
      sw_system_even_out(s, h, p->first, p->between);
  } else {
    sw_system_axial_from_state(s);
  }
  p->last_h = h;
  p->restart = p->plastic;
  p->plastic = 0;
}

double sw_stepper_next_h(const sw_stepper *p, double h, double error, double tolerance) {
  const double safety = 0.9, most = 2.0, least = 0.2; /* of the last step [-] */
  if (error == 0) return h * most;                    /* nothing moves */
  if (!(error > 0)) return h;
  const double factor = safety * pow(tolerance / error, 1.0 / (sw_stepper_order(p) + 1));
  return h * fmin(most, fmax(least, factor));
}
