/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "watch/wear.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "read/extremes.h"
#include "record/wear.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/hinge.h"
#include "system/system.h"

/* --- places ---------------------------------------------------------------------- */

/* Places along a wire: nodes of a line, rings of a mesh. */
static size_t along(const sw_plan *p) { return p->web ? p->web->rings : p->nodes; }

/* And those at clamps, of a line. */
static size_t at_clamps(const sw_plan *p) { return p->web ? 0 : p->clamp_count; }

static double place_of(const sw_plan *p, size_t k) {
  if (p->web) return p->web->s[p->web->first[k]];
  return p->s[k < p->nodes ? k : p->clamps[k - p->nodes].node];
}

static int side_of(const sw_plan *p, size_t k) {
  return k < along(p) ? 0 : p->clamps[k - p->nodes].side;
}

/* Are the places those of the plan? Nodes beside a feed go along it. */
static int is_same(const sw_wear *w, const sw_plan *p) {
  const size_t n = along(p);
  const double slack = 0.25 * (place_of(p, n - 1) - place_of(p, 0)) / (double)n;
  if (w->nodes != n || w->count != n + at_clamps(p) || !w->cycles != !!p->web) return 0;
  for (size_t k = 0; k < w->count; k++)
    if (w->places[k].side != side_of(p, k) || fabs(w->places[k].s - place_of(p, k)) > slack)
      return 0;
  return 1;
}

static double widest(const sw_wear *w, size_t k) {
  double most = 0;
  if (!w->cycles) return 0;
  for (int c = 0; c < SW_WEAR_SIGNALS; c++)
    most = fmax(most, sw_cycles_widest(&w->cycles[SW_WEAR_SIGNALS * k + (size_t)c]));
  return most;
}

/* The old place that a new one goes on from: the nearest; of those at one node the one of its side,
 * else the one that has gone through most. */
static size_t origin(const sw_wear *old, double s, int side) {
  size_t best = 0;
  for (size_t k = 1; k < old->count; k++) {
    const sw_wear_place *a = &old->places[best], *b = &old->places[k];
    const double nearer = fabs(a->s - s) - fabs(b->s - s);
    const int same = b->s == a->s && (b->side == side || (a->side != side && side)) &&
                     widest(old, k) >= widest(old, best);
    const int ended = b->s == a->s && !side && widest(old, k) > widest(old, best);
    if (nearer > 0 || same || ended) best = k;
  }
  return best;
}

/* The wire that belongs to place k along it begins here; that of the last one ends at that of
 * number nodes [m]. */
static double begin_of(const sw_wear *w, size_t k) {
  if (k == 0) return w->places[0].s;
  return k < w->nodes ? 0.5 * (w->places[k - 1].s + w->places[k].s) : w->places[k - 1].s;
}

/* Work of friction stays where it was done, and all of it: a new place has the mean of the old
 * ones' over its length. */
static void spread_friction(const sw_wear *old, sw_wear *new) {
  size_t from = 0;
  for (size_t k = 0; k < new->count; k++) new->places[k].rubbed = new->places[k].slid = 0;
  for (size_t k = 0; k < new->nodes; k++) {
    const double begin = begin_of(new, k), end = begin_of(new, k + 1);
    while (from + 1 < old->nodes && begin_of(old, from + 1) <= begin) from++;
    for (size_t j = from; j < old->nodes && begin_of(old, j) < end; j++) {
      const double common = fmin(end, begin_of(old, j + 1)) - fmax(begin, begin_of(old, j));
      const double share = fmax(common, 0.0) / (end - begin);
      new->places[k].rubbed += share * old->places[j].rubbed;
      new->places[k].slid += share * old->places[j].slid;
    }
  }
}

/* As it was, at the places of the plan. */
static void carry_over(const sw_wear *old, const sw_plan *p, sw_wear *new) {
  for (size_t k = 0; k < new->count; k++) {
    const double s = place_of(p, k);
    const int side = side_of(p, k);
    if (old->count) {
      const size_t from = origin(old, s, side);
      new->places[k] = old->places[from];
      if (new->cycles && old->cycles)
        memcpy(new->cycles + SW_WEAR_SIGNALS *k, old->cycles + SW_WEAR_SIGNALS * from,
               SW_WEAR_SIGNALS * sizeof *new->cycles);
    }
    new->places[k].s = s, new->places[k].side = side;
  }
  if (old->count) spread_friction(old, new);
}

/* The same places, some of which went along the wire. */
static sw_status move_places(sw_wear *w, const sw_plan *p) {
  int moved = 0;
  for (size_t k = 0; k < w->count; k++) moved |= w->places[k].s != place_of(p, k);
  if (!moved) return SW_OK;
  sw_wear old = *w;
  sw_wear_place *before SW_LOCAL = sw_alloc(w->count, sizeof *before);
  if (!before) return SW_ENOMEM;
  memcpy(before, w->places, w->count * sizeof *before);
  old.places = before;
  for (size_t k = 0; k < w->count; k++) w->places[k].s = place_of(p, k);
  spread_friction(&old, w);
  return SW_OK;
}

static sw_status fit(sw_wear *w, const sw_plan *p) {
  if (w->count && is_same(w, p)) return move_places(w, p);
  const int counts = !p->web;
  sw_wear new = {.count = along(p) + at_clamps(p), .nodes = along(p)};
  new.places = sw_alloc(new.count, sizeof *new.places);
  if (counts) new.cycles = sw_alloc(SW_WEAR_SIGNALS * new.count, sizeof *new.cycles);
  if (!new.places || (counts && !new.cycles)) {
    sw_wear_free(&new);
    return SW_ENOMEM;
  }
  carry_over(w, p, &new);
  new.pressed = w->pressed, w->pressed = (sw_window){0};
  new.sidewall = w->sidewall; /* holds 0: directions are found anew */
  new.partial = w->partial || !counts;
  sw_wear_free(w);
  *w = new;
  return SW_OK;
}

/* --- bending --------------------------------------------------------------------- */

/* A number for what holds the wire's direction where. */
static uint64_t holds_of(const sw_body *b) {
  uint64_t sum = sw_sum(SW_SUM_START, &b->plan->clamp_count, sizeof b->plan->clamp_count);
  SW_ITEMS(const sw_clamp_hinge, h, b->plan->clamps, b->plan->clamp_count) {
    const size_t own[3] = {h->node, (size_t)h->hold, (size_t)(h->side + 1)};
    sum = sw_sum(sum, own, sizeof own);
  }
  return sum | 1;
}

static size_t edge_of(const sw_plan *p, size_t k) {
  if (k >= p->nodes) return p->clamps[k - p->nodes].edge;
  return k < p->edges ? k : p->edges - 1;
}

/* A bend of this size towards the change of tangent, seen across the tangent t [1/m]. */
static sw_vec towards(sw_vec change, sw_vec t, double size) {
  const sw_vec way = sw_madd(change, t, -sw_dot(change, t));
  return sw_scale(sw_unit_or(way, sw_v(0, 0, 0)), size);
}

/* Where the wire bends to, by the curvature, across the edge of the place [1/m]. */
static sw_vec bend_of(const sw_system *s, const sw_body *b, size_t k) {
  const sw_plan *p = b->plan;
  if (k >= p->nodes) {
    const sw_clamp_hinge *c = &p->clamps[k - p->nodes];
    const sw_vec t = sw_field_tangent(&b->field, c->edge),
                 d = sw_vec_at(s->directors_now, sw_clamp_place(c));
    return towards(sw_scale(sw_sub(t, d), c->side), t, sw_scene_clamp_curvature(s, b, c));
  }
  if (k == 0 || k + 1 >= p->nodes || !(p->hinge[k] > 0)) return sw_v(0, 0, 0);
  const sw_vec t = sw_field_tangent(&b->field, k),
               change = sw_sub(t, sw_field_tangent(&b->field, k - 1));
  return towards(change, t, 2.0 * asin(fmin(1.0, 0.5 * sw_norm(change))) / p->hinge[k]);
}

static double angle_from(sw_vec a, sw_vec b, sw_vec t) {
  return atan2(sw_dot(sw_cross(a, b), t), sw_dot(a, b));
}

/* Across the wire at a place: between those of both edges. */
static sw_vec across_at(const sw_body *b, const sw_vec *across, size_t k) {
  const sw_plan *p = b->plan;
  const size_t e = edge_of(p, k);
  if (k == 0 || k >= p->edges || !(p->hinge[k] > 0)) return across[e];
  const sw_vec before = sw_carry_unit(across[e - 1], sw_field_tangent(&b->field, e - 1),
                                      sw_field_tangent(&b->field, e));
  return sw_unit_or(sw_add(before, across[e]), across[e]);
}

/* The place's own direction: as before where what holds the wire is not as before. */
static void turn_place(sw_wear_place *x, sw_vec tangent, sw_vec across, int anew) {
  if (!x->seen) x->turn = 0;
  if (x->seen && anew) {
    const sw_vec was = sw_carry_unit(x->across, x->tangent, tangent);
    x->turn = angle_from(across, was, tangent);
  }
  x->seen = 1, x->tangent = tangent;
  x->across = sw_madd(sw_scale(across, cos(x->turn)), sw_cross(tangent, across), sin(x->turn));
}

static void count_place(sw_cycles *c, const sw_wear_place *x, double tension, sw_vec bend) {
  const double one = sw_dot(bend, x->across), two = sw_dot(bend, sw_cross(x->tangent, x->across));
  sw_cycles_add(&c[0], tension);
  for (int k = 0; k < SW_WEAR_WAYS; k++) {
    const double angle = k * 3.14159265358979323846 / SW_WEAR_WAYS;
    sw_cycles_add(&c[1 + k], one * cos(angle) + two * sin(angle));
  }
}

/* Axial force at a place: the mean of both edges, beside a clamp that of its edge. */
static double tension_at(const sw_plan *p, const double *T, size_t k) {
  if (k >= p->nodes) return T[p->clamps[k - p->nodes].edge];
  if (k == 0) return T[0];
  return k < p->edges ? 0.5 * (T[k - 1] + T[k]) : T[p->edges - 1];
}

/* T: of its edges [N]. */
static sw_status count_all(sw_scene *s, size_t w, const double *T) {
  sw_system *system = sw_scene_system(s);
  sw_wear *wear = &sw_scene_wire_in(s, w)->wear;
  const sw_body *b = &system->bodies[w];
  const sw_plan *p = b->plan;
  if (!wear->across) wear->across = sw_alloc(wear->count, sizeof *wear->across);
  sw_vec *across = wear->across;
  if (!across) return SW_ENOMEM;
  const sw_wear_place *start = &wear->places[0];
  const sw_vec t0 = sw_field_tangent(&b->field, 0);
  const sw_vec first =
      start->seen ? sw_carry_unit(start->across, start->tangent, t0) : sw_perpendicular(t0);
  sw_wear_axes(system, b, first, across);
  const uint64_t holds = holds_of(b);
  for (size_t k = 0; k < wear->count; k++) {
    const size_t e = edge_of(p, k);
    sw_wear_place *x = &wear->places[k];
    const int free_start = !p->clamp_count && !b->spin_block; /* it is carried on by itself */
    if (free_start && k == 0) x->turn = 0;
    turn_place(x, sw_field_tangent(&b->field, e), across_at(b, across, k),
               wear->holds != holds && !(free_start && k == 0));
    const sw_vec bend = bend_of(system, b, k);
    const double tension = tension_at(p, T, k);
    count_place(&wear->cycles[SW_WEAR_SIGNALS * k], x, tension, bend);
    x->load = tension * sw_norm(bend), x->touches = 0;
  }
  wear->holds = holds;
  return SW_OK;
}

/* --- sidewall pressure ---------------------------------------------------------- */

/* Pressure at a node that touches: chords on a round thing turn by turns too much and too little,
 * so that where the next node touches too, the mean of both counts. */
static double pressure_at(const sw_wear *w, size_t i) {
  const sw_wear_place *x = &w->places[i];
  if (!x->touches) return 0;
  if (i + 1 < w->nodes && x[1].touches) return 0.5 * (x[0].load + x[1].load);
  return i > 0 && x[-1].touches ? 0 : x->load;
}

/* Beside a clamp its node has what the clamp has. */
static void press_sides(const sw_plan *p, sw_wear *w) {
  for (size_t c = 0; c < p->clamp_count; c++) {
    sw_wear_place *node = &w->places[p->clamps[c].node];
    node->load = fmax(node->load, w->places[p->nodes + c].load);
  }
}

/* Differences of integrals leave rounding where nothing presses; no load is as small [N/m]. */
static const double ROUNDING = 1e-12;

static void keep(sw_extreme *kept, double value, double place, double time) {
  if (value > fmax(ROUNDING, kept->value)) *kept = (sw_extreme){value, place, time};
}

sw_extreme sw_wear_sidewall(const sw_scene *s, const sw_wear *w) {
  sw_course *c = sw_scene_course(s);
  const sw_window *window = &w->pressed;
  sw_extreme most = w->sidewall;
  double mean;
  if (!window->marks || window->edges != w->nodes) return most;
  const int due =
      sw_window_waits(window) && sw_scene_is_averaged(s) && sw_window_full(window, c->window);
  if (most.value > 0 && !due) return most; /* else a record shorter than the window */
  const size_t i = sw_window_largest(window, c->window, &mean);
  keep(&most, mean, w->places[i].s, window->now);
  return most;
}

/* Single steps of a blow say nothing of how long it lasts: means count, as of other peaks. */
static sw_status press(sw_scene *s, const sw_plan *p, sw_wear *w) {
  sw_course *c = sw_scene_course(s);
  const int averaged = sw_scene_is_averaged(s);
  double mean;
  press_sides(p, w);
  for (size_t i = 0; i < w->nodes && !averaged; i++)
    keep(&w->sidewall, pressure_at(w, i), p->s[i], sw_scene_time(s));
  if (!averaged && !w->pressed.marks) return SW_OK;
  if (w->pressed.edges != w->nodes) SW_TRY(sw_window_fit(&w->pressed, w->nodes, p->s));
  if (!(c->span > 0)) {
    sw_window_forget(&w->pressed);
    return SW_OK;
  }
  double *values = sw_window_values(&w->pressed);
  for (size_t i = 0; i < w->nodes; i++) values[i] = pressure_at(w, i);
  if (!sw_window_add(&w->pressed, values, sw_scene_time(s), c->span, c->window) || !averaged)
    return SW_OK;
  const size_t i = sw_window_largest(&w->pressed, c->window, &mean);
  keep(&w->sidewall, mean, p->s[i], sw_scene_time(s));
  return SW_OK;
}

sw_status sw_wear_note(sw_scene *s, size_t w, int rubs, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_wear *wear = &sw_scene_wire_in(s, w)->wear;
  const sw_body *b = &system->bodies[w];
  const sw_web *web = b->plan->web;
  if (web && !web->per_ring) return SW_OK; /* an object, no wire */
  sw_status status = fit(wear, b->plan);
  if (status == SW_OK && !web)
    status = count_all(s, w, rubs ? sw_scene_step_tension(s, b) : sw_system_pull(system, b));
  if (status == SW_OK && rubs) {
    sw_wear_rub(s, b, wear);
    if (!web) status = press(s, b->plan, wear);
  }
  if (status != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for the wear of '%s'",
                   sw_scene_wire_in(s, w)->name);
  return SW_OK;
}
