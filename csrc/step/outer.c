/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces from outside that change with time within a step: functions of scripts, which nobody knows
 * but at the times at which they are called, and forces of a known period. */
#include "step/outer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/forces.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/energy.h"
#include "system/outer.h"

/* Share of a function's impulse that steps may miss without an event [-]. */
static const double TOLD = 0.05;
/* The event asks for at least this share of the step: one that missed all tells no length [-]. */
static const double SHORTER = 1.0 / 16;
/* Steps per period of a force; an event tells of fewer than LEAST [-]. */
static const double PER_PERIOD = 10, LEAST = 9;

/* --- how a method samples a force ------------------------------------------------ */

enum { MOST_TIMES = 2 * SW_STAGES_MAX + 3 };

/* Times in a step as shares of it, with the weights that the method gives them, and those of
 * Simpson's rule between the method's own times. */
typedef struct samples {
  int count;
  double at[MOST_TIMES], used[MOST_TIMES], fine[MOST_TIMES];
} samples;

static int add_time(double *times, int count, double t) {
  if (t > times[count - 1] && t <= 1.0) times[count++] = t;
  return count;
}

/* Adds a weight of the method at its own time. */
static void use(samples *q, double time, double weight) {
  for (int k = 0; k < q->count; k++)
    if (q->at[k] == time) q->used[k] += weight;
}

/* The change of velocity in a step is the sum of the stages' accelerations with these weights. */
static samples samples_of(const sw_integrator *m) {
  const sw_stage_row *rows = m->rows;
  double times[SW_STAGES_MAX + 2] = {0};
  int count = 1;
  for (size_t k = 0; k < m->stages; k++) count = add_time(times, count, rows[k].time);
  count = add_time(times, count, 1.0);
  samples q = {.count = 2 * count - 1};
  for (int k = 0; k < count; k++) q.at[2 * k] = times[k];
  for (int k = 0; k + 1 < count; k++) {
    const double part = times[k + 1] - times[k];
    q.at[2 * k + 1] = 0.5 * (times[k] + times[k + 1]);
    q.fine[2 * k] += part / 6, q.fine[2 * k + 1] += part * 4 / 6, q.fine[2 * k + 2] += part / 6;
  }
  if (m->stages == 1) {
    use(&q, rows[0].time, 1.0);
  } else {
    use(&q, 0.0, rows[1].x1 * rows[0].hbar * rows[0].xv);
    use(&q, rows[0].time, rows[1].x1 * rows[0].hbar);
    use(&q, rows[1].time, rows[1].hbar);
  }
  return q;
}

/* --- functions of scripts --------------------------------------------------------- */

static int slot_of(const sw_term *term) {
  return term->id < 0 || term->id >= SW_OUTER_SUMS ? SW_OUTER_SUMS - 1 : term->id;
}

static double sum_of_norms(const double *f, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += sw_norm(sw_vec_at(f, i));
  return sum;
}

/* A function on a body whose motion stands still at the trial's end: only what the time alone
 * changes counts. */
typedef struct view {
  sw_body *body;
  const sw_term *term;
  const samples *q;
  double h;
  double *force; /* (count x 3 x nodes) at the samples [N] */
} view;

static double *sample(const view *v, int k) {
  return v->force + 3 * v->body->plan->nodes * (size_t)k;
}

static sw_status take_sample(sw_scene *s, const view *v, int k, sw_error *err) {
  return sw_outer_force(sw_scene_system(s), v->body, v->term, sw_scene_time(s) + v->q->at[k] * v->h,
                        0, sample(v, k), err);
}

/* Takes all samples but that between the last stages, which is another call of a script: it is
 * taken only if the others differ. *steady: 1: they do not. */
static sw_status take_samples(sw_scene *s, const view *v, int *steady, sw_error *err) {
  const int last = v->q->count - 1;
  const size_t size = 3 * v->body->plan->nodes * sizeof(double);
  *steady = 1;
  for (int k = 0; k <= last; k++) {
    if (k > 2 && k == last - 1) continue;
    SW_TRY(take_sample(s, v, k, err));
    *steady &= memcmp(sample(v, 0), sample(v, k), size) == 0;
  }
  return *steady || last <= 3 ? SW_OK : take_sample(s, v, last - 1, err);
}

static sw_status look_at_term(sw_scene *s, const view *v, sw_outer_look *out, sw_error *err) {
  const sw_plan *p = v->body->plan;
  const size_t n = p->nodes;
  const int slot = slot_of(v->term);
  double *off = sample(v, v->q->count), all = 0;
  int steady;
  SW_TRY(take_samples(s, v, &steady, err));
  if (steady) {
    out->all[slot] += v->h * sum_of_norms(sample(v, 1), n);
    return SW_OK;
  }
  memset(off, 0, 3 * n * sizeof *off);
  for (int k = 0; k < v->q->count; k++) {
    const double *force = sample(v, k), share = v->q->used[k] - v->q->fine[k];
    for (size_t i = 0; i < 3 * n; i++) off[i] += share * force[i];
    all += v->q->fine[k] * sum_of_norms(force, n);
  }
  const double missed = v->h * sum_of_norms(off, n), mass = p->beam.mass * p->length;
  out->missed[slot] += missed, out->all[slot] += v->h * all;
  if (mass > 0) out->speed = fmax(out->speed, missed / mass);
  return SW_OK;
}

static int is_function(const sw_term *term) { return (term->cls->flags & SW_FORCE_EXPLICIT) != 0; }

static int any_function(const sw_system *system) {
  SW_ITEMS(const sw_body, b, system->bodies, system->body_count)
    for (size_t k = 0; k < b->term_count; k++)
      if (is_function(&b->terms[k])) return 1;
  return 0;
}

static sw_status look_at_body(sw_scene *s, sw_body *b, double h, const samples *q,
                              sw_outer_look *out, sw_error *err) {
  view v = {.body = b, .q = q, .h = h};
  sw_status status = SW_OK;
  for (size_t k = 0; status == SW_OK && k < b->term_count; k++) {
    if (b->waits || !is_function(&b->terms[k])) continue;
    v.term = &b->terms[k];
    if (!v.force) v.force = sw_alloc((MOST_TIMES + 1) * 3 * b->plan->nodes, sizeof *v.force);
    if (!v.force) return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
    status = look_at_term(s, &v, out, err);
  }
  sw_free(v.force);
  return status;
}

sw_status sw_outer_look_at(sw_ladder *p, double h, sw_outer_look *out, sw_error *err) {
  sw_scene *s = p->s;
  sw_system *system = sw_scene_system(s);
  const sw_stepper *stepper = &sw_scene_course(s)->stepper;
  sw_status status = SW_OK;
  sw_glance glance;
  *out = (sw_outer_look){.speed = 0};
  /* the steps of explicit methods are far shorter than the forces of scripts */
  if (!stepper->used || !any_function(system)) return SW_OK;
  const samples q = samples_of(stepper->used);
  sw_system_look_at(system, &glance, stepper->trial_x, stepper->trial_v, stepper->strain_rate);
  for (size_t k = 0; status == SW_OK && k < system->body_count; k++)
    status = look_at_body(s, &system->bodies[k], h, &q, out, err);
  sw_system_look_back(system, &glance);
  if (status != SW_OK) sw_ladder_undo(p); /* a script's error leaves the last good state */
  return status;
}

/* --- events ----------------------------------------------------------------------- */

/* Returns the name of the wire or object on which a force acts; "": on all. */
static const char *name_of(const sw_scene *s, long id) {
  if (id < 0 || (size_t)id >= sw_scene_force_slots(s)) return "";
  const sw_scene_force *force = sw_scene_force_in(s, (size_t)id);
  return force->wire >= 0 ? sw_scene_wire_in(s, (size_t)force->wire)->name : "";
}

double sw_outer_longest(const sw_scene *s) {
  const sw_term *term;
  return sw_outer_period(sw_scene_system(s), &term) / PER_PERIOD;
}

static void tell_period(sw_scene *s, double h) {
  const sw_term *term;
  const double period = sw_outer_period(sw_scene_system(s), &term);
  if (!(h > period / LEAST)) return;
  const char *name = name_of(s, term->id);
  sw_scene_tell(s, "coarse", name, NAN, h / period,
                "a step of %.3g ms is too long for the force %s on %s%s%s, which changes with a "
                "period of %.3g ms: its mean is left to chance; run again with dt = %.2g s",
                1e3 * h, term->cls->name, name[0] ? "'" : "all", name, name[0] ? "'" : "",
                1e3 * period, period / PER_PERIOD);
}

void sw_outer_taken(sw_scene *s, double h, const sw_outer_look *look) {
  for (int k = 0; k < SW_OUTER_SUMS; k++) {
    sw_outer_sum *sum = &sw_scene_books(s)->outer[k];
    sum->missed += look->missed[k], sum->all += look->all[k];
    if (!(look->missed[k] > sum->worst)) continue;
    sum->worst = look->missed[k], sum->step = h, sum->time = sw_scene_time(s);
  }
  tell_period(s, h);
}

void sw_outer_end_run(sw_scene *s) {
  for (int k = 0; k < SW_OUTER_SUMS; k++) {
    const sw_outer_sum *sum = &sw_scene_books(s)->outer[k];
    const double share = sum->missed / sum->all;
    if (!(share > TOLD)) continue;
    const char *name = k + 1 < SW_OUTER_SUMS ? name_of(s, k) : "";
    sw_scene_tell(s, "coarse", name, NAN, share,
                  "a force function changes within steps: %.3g %% of its impulse is missed or "
                  "counted twice, most after t = %.4g s, in a step of %.3g ms; run again with dt = "
                  "%.2g s",
                  100.0 * share, sum->time, 1e3 * sum->step,
                  fmax(0.8 * TOLD / share, SHORTER) * sum->step);
  }
}

/* --- work in poses ---------------------------------------------------------------- */

/* Fills force (3 x nodes) with the sum of all forces from outside [N]. */
static sw_status all_forces(sw_scene *s, double *force, double *room, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  memset(force, 0, 3 * system->nodes * sizeof *force);
  SW_ITEMS(sw_body, b, system->bodies, system->body_count)
    SW_ITEMS(const sw_term, term, b->terms, b->term_count) {
      double *on = force + 3 * b->first_node;
      if (!sw_outer_is(term->cls)) continue;
      SW_TRY(sw_outer_force(system, b, term, sw_scene_time(s), 1, room, err));
      for (size_t i = 0; i < 3 * b->plan->nodes; i++) on[i] += room[i];
    }
  return SW_OK;
}

sw_status sw_outer_begin_pose(sw_scene *s, sw_outer_start *start, sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  const size_t n = 3 * system->nodes;
  int any = 0;
  for (size_t b = 0; b < system->body_count; b++)
    for (size_t k = 0; k < system->bodies[b].term_count; k++)
      any |= sw_outer_is(system->bodies[b].terms[k].cls);
  if (!any) return SW_OK;
  start->x = sw_alloc(3 * n, sizeof *start->x); /* the last part: room */
  if (!start->x) return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  start->force = start->x + n;
  memcpy(start->x, system->x, n * sizeof *start->x);
  return all_forces(s, start->force, start->force + n, err);
}

sw_status sw_outer_work(sw_scene *s, const sw_outer_start *start, double *work, sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  const size_t n = 3 * system->nodes;
  *work = 0;
  if (!start->x) return SW_OK;
  double *now = sw_alloc(2 * n, sizeof *now);
  if (!now) return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  const sw_status status = all_forces(s, now, now + n, err);
  for (size_t i = 0; status == SW_OK && i < n; i++)
    *work += 0.5 * (start->force[i] + now[i]) * (system->x[i] - start->x[i]);
  sw_free(now);
  return status;
}

void sw_outer_drop(sw_outer_start *start) {
  sw_free(start->x);
  *start = (sw_outer_start){0};
}
