/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Largest values of wires: curvature, tension, strain, at the present state and over a run. */
#include "read/extremes.h"

#include <math.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/simd.h"
#include "body/section.h"
#include "body/side.h"
#include "body/spin.h"
#include "contact/jolt.h"
#include "record/wear.h"
#include "record/zone.h"
#include "scene/course.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "system/axial.h"
#include "system/system.h"

/* Returns the largest |t2 - t1| / hinge length, squared: the curvature to second order in the hinge
 * angle. The caller takes the exact angle at the place found. */
SW_HOT
static double largest_curvature2(size_t n, const double *restrict hinge, const double *restrict tx,
                                 const double *restrict ty, const double *restrict tz) {
  double largest = 0;
  for (size_t i = 1; i + 1 < n; i++) {
    const double dx = tx[i] - tx[i - 1], dy = ty[i] - ty[i - 1], dz = tz[i] - tz[i - 1];
    const double k2 = hinge[i] > 0 ? (dx * dx + dy * dy + dz * dz) / (hinge[i] * hinge[i]) : 0.0;
    largest = largest > k2 ? largest : k2;
  }
  return largest;
}

double sw_scene_hinge_chord(const sw_field *f, size_t i) {
  double d2 = 0;
  for (int k = 0; k < 3; k++) {
    const double d = f->tangent[k][i] - f->tangent[k][i - 1];
    d2 += d * d;
  }
  return sqrt(d2);
}

/* Finds the largest curvature, and how sharp it is if it is more than `above`; strained: the
 * largest strain beside clamps and joints of a wire that is straight at rest [1/m]. */
static void curvature_extreme(const sw_scene *s, const sw_body *b, double above, sw_extreme *out,
                              sw_sharpness *sharp, sw_extreme *strained) {
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  const double bound2 =
      largest_curvature2(p->nodes, p->hinge, f->tangent[0], f->tangent[1], f->tangent[2]);
  sw_bent_side side, sharpest;
  size_t node = 0, next = 0;
  int aside = 0;
  *out = (sw_extreme){.s = p->s[0]};
  *sharp = (sw_sharpness){0}, *strained = (sw_extreme){.value = -HUGE_VAL};
  const double *T = sw_system_elastic(sw_scene_system(s), b);
  for (size_t i = 1; i + 1 < p->nodes; i++) {
    if (!(p->hinge[i] > 0)) continue;
    const double chord = sw_scene_hinge_chord(f, i);
    if (chord * chord < (1 - 1e-12) * bound2 * p->hinge[i] * p->hinge[i]) continue;
    *out = (sw_extreme){.value = sw_angle_of_chord(chord) / p->hinge[i], .s = p->s[i]};
    node = i;
    break;
  }
  while (sw_scene_next_side(sw_scene_system(s), b, &next, &side)) {
    const double value = sw_scene_side_curvature(sw_scene_system(s), b, &side);
    const double strain = T[side.edge] / p->beam.EA + p->beam.radius * value;
    if (strain > strained->value) *strained = (sw_extreme){.value = strain, .s = p->s[side.node]};
    if (!(value > out->value)) continue;
    *out = (sw_extreme){.value = value, .s = p->s[side.node]};
    sharpest = side, aside = 1;
  }
  if (out->value > above)
    *sharp = sw_scene_sharpness(s, b, node, aside ? &sharpest : NULL, out->value);
}

/* Number of edges, or of slices between rings, whose tension is recorded. */
static size_t watched_edges(const sw_body *b) {
  const sw_web *web = b->plan->web;
  if (!web) return b->plan->edges;
  return web->rings > 1 ? web->rings - 1 : 0;
}

static double watched_place(const sw_body *b, size_t e) {
  const sw_web *web = b->plan->web;
  if (!web) return 0.5 * (b->plan->s[e] + b->plan->s[e + 1]);
  return 0.5 * (web->s[web->first[e]] + web->s[web->first[e + 1]]);
}

/* T: tensions of the wire's edges or slices. */
static void largest_tension(const sw_body *b, const double *T, sw_extreme *out) {
  *out = (sw_extreme){.value = -HUGE_VAL};
  for (size_t e = 0; e < watched_edges(b); e++)
    if (T[e] > out->value) *out = (sw_extreme){.value = T[e], .s = watched_place(b, e)};
}

/* Returns the largest strain of the outermost fibres at hinges: from the mean axial force of both
 * edges and the chord |t2 - t1| instead of the angle (exact to third order). */
SW_HOT
static double largest_hinge_strain(size_t n, double half_compliance, double radius,
                                   const double *restrict T, const double *restrict hinge,
                                   const double *restrict tx, const double *restrict ty,
                                   const double *restrict tz) {
  double largest = -HUGE_VAL;
  for (size_t i = 1; i + 1 < n; i++) {
    const double dx = tx[i] - tx[i - 1], dy = ty[i] - ty[i - 1], dz = tz[i] - tz[i - 1];
    const double chord = sqrt(dx * dx + dy * dy + dz * dz);
    const double bent = hinge[i] > 0 ? radius * chord / hinge[i] : 0.0;
    const double strain = half_compliance * (T[i] + T[i - 1]) + bent;
    largest = largest > strain ? largest : strain;
  }
  return largest;
}

static void keep_largest(sw_extreme *kept, const sw_extreme *now) {
  if (now->value > kept->value) *kept = *now;
}

/* The same for a wire that is curved at rest, without its bend at rest. */
static void framed_strain(const sw_system *s, const sw_body *b, sw_extreme *out) {
  const sw_plan *p = b->plan;
  const double *T = sw_system_elastic(s, b), EA = p->beam.EA, radius = p->beam.radius;
  *out = (sw_extreme){.value = T[0] / EA, .s = p->s[0]};
  keep_largest(out, &(sw_extreme){.value = T[p->edges - 1] / EA, .s = p->s[p->edges]});
  for (size_t i = 1; i + 1 < p->nodes; i++) {
    const double bent = radius * sw_scene_flexure(s, b, i), mean = 0.5 * (T[i] + T[i - 1]) / EA;
    keep_largest(out, &(sw_extreme){.value = mean + bent, .s = p->s[i]});
  }
  sw_bent_side side;
  for (size_t next = 0; sw_scene_next_side(s, b, &next, &side);) {
    const double bent = radius * sw_scene_side_flexure(s, b, &side);
    keep_largest(out, &(sw_extreme){.value = T[side.edge] / EA + bent, .s = p->s[side.node]});
  }
}

/* strained: see curvature_extreme. */
static void strain_extreme(const sw_system *s, const sw_body *b, const sw_extreme *strained,
                           sw_extreme *out) {
  if (b->plan->beam.curved) {
    framed_strain(s, b, out);
    return;
  }
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  const double *T = sw_system_elastic(s, b), EA = p->beam.EA, radius = p->beam.radius;
  const double bound = largest_hinge_strain(p->nodes, 0.5 / EA, radius, T, p->hinge, f->tangent[0],
                                            f->tangent[1], f->tangent[2]);
  *out = (sw_extreme){.value = T[0] / EA, .s = p->s[0]}; /* free and pinned ends are not bent */
  keep_largest(out, &(sw_extreme){.value = T[p->edges - 1] / EA, .s = p->s[p->edges]});
  for (size_t i = 1; i + 1 < p->nodes && bound > out->value; i++) {
    const double chord = sw_scene_hinge_chord(f, i), mean = 0.5 * (T[i] + T[i - 1]) / EA;
    const double per_length = p->hinge[i] > 0 ? radius / p->hinge[i] : 0.0;
    if (mean + per_length * chord < bound - 1e-12 * fabs(bound)) continue;
    *out = (sw_extreme){.value = mean + per_length * sw_angle_of_chord(chord), .s = p->s[i]};
    break;
  }
  keep_largest(out, strained);
}

/* Of a string it is not known: it bears no twist (a free rod has none, which is known). */
static void torsion_extreme(const sw_scene *s, size_t w, sw_extreme *out) {
  const sw_scene_wire *wire = sw_scene_wire_in(s, w);
  sw_recipe recipe;
  wire->cls->recipe(&wire->beam, &recipe);
  sw_scene_torsion(sw_scene_system(s), &sw_scene_system(s)->bodies[w], out);
  if (!recipe.twist) out->value = -HUGE_VAL;
}

/* above: see curvature_extreme [1/m]. */
static void wire_now(sw_scene *s, size_t w, double *tension, double above, sw_wire_extremes *now) {
  sw_system *system = sw_scene_system(s);
  if (sw_scene_wire_in(s, w)->strand.web) {
    sw_strand_extremes(s, w, tension, now);
    now->sharp =
        now->curvature.value > above ? sw_scene_mesh_sharpness(s, w, now) : (sw_sharpness){0};
    now->curvature.time = now->tension.time = now->strain.time = sw_scene_time(s);
    now->ovalisation.time = now->folding.time = sw_scene_time(s);
    now->torsion.time = sw_scene_time(s);
    return;
  }
  sw_extreme strained;
  curvature_extreme(s, &system->bodies[w], above, &now->curvature, &now->sharp, &strained);
  const sw_body *b = &system->bodies[w];
  largest_tension(b, sw_system_pull(system, b), &now->tension);
  strain_extreme(system, &system->bodies[w], &strained, &now->strain);
  now->ovalisation = now->folding = (sw_extreme){.value = -HUGE_VAL};
  torsion_extreme(s, w, &now->torsion);
  now->curvature.time = now->tension.time = now->strain.time = now->torsion.time = sw_scene_time(s);
}

void sw_scene_wire_now(sw_scene *s, size_t w, sw_wire_extremes *now) {
  wire_now(s, w, NULL, 0, now);
}

int sw_scene_is_averaged(const sw_scene *s) {
  sw_course *course = sw_scene_course(s);
  return course->span > 0 && course->span < (1 - 1e-9) * course->window; /* times are rounded */
}

static sw_status fit_window(sw_scene *s, size_t w) {
  sw_window *window = &sw_scene_wire_in(s, w)->window;
  const sw_body *b = &sw_scene_system(s)->bodies[w];
  const size_t n = watched_edges(b);
  if (window->edges == n) return SW_OK;
  double *places SW_LOCAL = sw_alloc(n, sizeof *places);
  if (!places) return SW_ENOMEM;
  for (size_t e = 0; e < n; e++) places[e] = watched_place(b, e);
  return sw_window_fit(window, n, places);
}

/* Keeps the largest mean over the window up to now. */
static void keep_mean(const sw_scene *s, size_t w, sw_extreme *kept) {
  const sw_window *window = &sw_scene_wire_in(s, w)->window;
  sw_extreme mean = {.time = window->now};
  const size_t e = sw_window_largest(window, sw_scene_course(s)->window, &mean.value);
  mean.s = watched_place(&sw_scene_system(s)->bodies[w], e);
  keep_largest(kept, &mean);
}

/* The same for a new window; its means are loads of the wear too. */
static void count_means(sw_scene *s, size_t w, sw_extreme *kept) {
  keep_mean(s, w, kept);
  sw_scene_wear_means(s, w);
}

/* Returns the mean tensions of edges or slices over the step, if the method gives them, else NULL.
 * The axial force at the step's end is as good for a steady pull but misses impulses. Where a feed
 * stopped at once, it was up to three times too large at all step sizes, since it grows as steps
 * get shorter. */
static const double *mean_tension(const sw_scene *s, const sw_body *b) {
  const sw_course *course = sw_scene_course(s);
  if (!(course->span > 0) || !course->stepper.mean) return NULL;
  const sw_system *system = sw_scene_system(s);
  const size_t first = sw_system_first_pull(system, b);
  return sw_system_mean_pull(system, b, course->stepper.mean + first);
}

/* 1 if the step that led to this state is so long that it smears impacts. */
static int is_coarse(const sw_scene *s) {
  return sw_scene_course(s)->span >= (1 - 1e-9) * SW_WINDOW;
}

const double *sw_scene_step_tension(const sw_scene *s, const sw_body *b) {
  const double *mean = is_coarse(s) ? mean_tension(s, b) : NULL;
  return mean ? mean : sw_system_pull(sw_scene_system(s), b);
}

/* Returns the tensions of the step that led to this state. NULL where only the state's own are
 * known: at rest, and of a mesh by methods that give no mean. */
static const double *step_tension(const sw_scene *s, const sw_body *b) {
  if (!(sw_scene_course(s)->span > 0)) return NULL;
  const double *mean = mean_tension(s, b);
  return mean || b->plan->web ? mean : sw_system_pull(sw_scene_system(s), b);
}

/* Adds the step that led to this state, with tensions T, or NULL: those in the window's room. */
static void add_step(sw_scene *s, size_t w, const double *T, sw_extreme *kept) {
  const sw_course *course = sw_scene_course(s);
  sw_window *window = &sw_scene_wire_in(s, w)->window;
  const double *values = T ? T : sw_window_values(window), end = sw_scene_time(s);
  const double begin = end - course->span;
  double from = begin;
  /* NOLINTNEXTLINE(cert-flp30-c): from cut to cut, which are found anew each time */
  for (double at; (at = sw_window_cut(window, begin, end, course->window)) < end; from = at)
    if (sw_window_add(window, values, at, at - from, course->window)) count_means(s, w, kept);
  if (sw_window_add(window, values, end, end - from, course->window) && sw_scene_is_averaged(s))
    count_means(s, w, kept);
}

static void keep_tension(sw_scene *s, size_t w, const sw_wire_extremes *now) {
  sw_course *course = sw_scene_course(s);
  sw_scene_wire *wire = sw_scene_wire_in(s, w);
  sw_wire_extremes *kept = &wire->extremes;
  const sw_body *b = &sw_scene_system(s)->bodies[w];
  const double *T = step_tension(s, b);
  sw_extreme step = now->tension;
  course->means = mean_tension(s, b) != NULL;
  if (T) largest_tension(b, T, &step), step.time = sw_scene_time(s);
  if (step.value > kept->raw.value) kept->raw = step, kept->raw_span = course->span;
  if (!sw_scene_is_averaged(s)) keep_largest(&kept->tension, &step);
  if (!(course->span > 0)) {
    sw_window_forget(&wire->window);
    return;
  }
  add_step(s, w, T, &kept->tension);
}

void sw_scene_run_tension(const sw_scene *s, size_t w, const sw_wire_extremes *now,
                          sw_wire_extremes *run) {
  const sw_window *window = &sw_scene_wire_in(s, w)->window;
  const sw_course *course = sw_scene_course(s); /* its stepper may be new: of a file, or edited */
  const int counted = isfinite(run->raw.value) && course->span > 0 && course->means;
  if (!counted && now->tension.value > run->raw.value)
    run->raw = now->tension, run->raw_span = course->span;
  const int fits = window->marks && window->edges == watched_edges(&sw_scene_system(s)->bodies[w]);
  const int missing = !isfinite(run->tension.value); /* the record is shorter than the window */
  if (!fits && (missing || !counted))
    keep_largest(&run->tension, &now->tension);
  else if (fits && (missing || (sw_window_waits(window) && sw_scene_is_averaged(s) &&
                                sw_window_full(window, sw_scene_course(s)->window))))
    keep_mean(s, w, &run->tension);
}

void sw_scene_keep_extremes(sw_wire_extremes *kept, const sw_wire_extremes *now) {
  if (now->curvature.value > kept->curvature.value) kept->sharp = now->sharp;
  keep_largest(&kept->curvature, &now->curvature);
  keep_largest(&kept->strain, &now->strain);
  keep_largest(&kept->ovalisation, &now->ovalisation);
  keep_largest(&kept->torsion, &now->torsion);
  if (!(kept->folding.value > 0)) keep_largest(&kept->folding, &now->folding); /* the first fold */
}

sw_status sw_scene_note_extremes(sw_scene *s, size_t w, sw_wire_extremes *now, sw_error *err) {
  double *tension = NULL;
  /* Steps as long as the window count, too: a window may begin in one and end in a part (substep).
   * Else the window of a pulse that begins with the first parts would lack the time after the
   * pulse. */
  if (sw_scene_course(s)->span > 0 && fit_window(s, w) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for the tension of '%s'",
                   sw_scene_wire_in(s, w)->name);
  if (sw_scene_wire_in(s, w)->strand.web &&
      sw_scene_wire_in(s, w)->window.edges == watched_edges(&sw_scene_system(s)->bodies[w]))
    tension = sw_window_values(&sw_scene_wire_in(s, w)->window);
  wire_now(s, w, tension, sw_scene_wire_in(s, w)->extremes.curvature.value, now);
  sw_scene_keep_extremes(&sw_scene_wire_in(s, w)->extremes, now);
  keep_tension(s, w, now);
  return SW_OK;
}

void sw_scene_reset_extremes(sw_scene *s) {
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) {
    const sw_extreme least = {.value = -HUGE_VAL};
    sw_scene_wire_in(s, w)->extremes =
        (sw_wire_extremes){least, least, least, least, least, least, least, 0, {0, 0, 0, 0, 0}};
    sw_scene_wire_in(s, w)->blow = 0;
    sw_scene_wire_in(s, w)->sunk = (sw_sunk){0};
    sw_window_forget(&sw_scene_wire_in(s, w)->window);
    sw_wear_free(&sw_scene_wire_in(s, w)->wear);
    sw_zones_forget(&sw_scene_wire_in(s, w)->zones);
    if (sw_scene_is_built(s)) sw_scene_system(s)->bodies[w].pushed = 0;
  }
  SW_EACH(obstacle, o, s) o->past.hardest = 0;
  if (sw_scene_contact(s)) sw_contact_forget_hardest(sw_scene_contact(s));
  *sw_scene_penetrated(s) = (sw_extreme){0};
  sw_scene_set_wears(s, 0);
}
