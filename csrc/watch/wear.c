/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "watch/wear.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/touching.h"
#include "read/extremes.h"
#include "record/wear.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/hinge.h"
#include "system/system.h"

/* --- places ---------------------------------------------------------------------- */

static double place_of(const sw_plan *p, size_t k) {
  return p->s[k < p->nodes ? k : p->clamps[k - p->nodes].node];
}

static int side_of(const sw_plan *p, size_t k) {
  return k < p->nodes ? 0 : p->clamps[k - p->nodes].side;
}

/* Are the places those of the plan? Nodes beside a feed go along it. */
static int is_same(const sw_wear *w, const sw_plan *p) {
  const double slack = 0.25 * (p->s[p->nodes - 1] - p->s[0]) / (double)p->nodes;
  if (w->nodes != p->nodes || w->count != p->nodes + p->clamp_count) return 0;
  for (size_t k = 0; k < w->count; k++)
    if (w->places[k].side != side_of(p, k) || fabs(w->places[k].s - place_of(p, k)) > slack)
      return 0;
  return 1;
}

static double widest(const sw_wear *w, size_t k) {
  double most = 0;
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

static sw_status fit(sw_wear *w, const sw_plan *p) {
  if (w->count && is_same(w, p)) {
    for (size_t k = 0; k < w->count; k++) w->places[k].s = place_of(p, k);
    return SW_OK;
  }
  sw_wear new = {.count = p->nodes + p->clamp_count, .nodes = p->nodes};
  new.places = sw_alloc(new.count, sizeof *new.places);
  new.cycles = sw_alloc(SW_WEAR_SIGNALS * new.count, sizeof *new.cycles);
  if (!new.places || !new.cycles) {
    sw_wear_free(&new);
    return SW_ENOMEM;
  }
  for (size_t k = 0; k < new.count; k++) {
    const double s = place_of(p, k);
    const int side = side_of(p, k);
    if (w->count) {
      const size_t from = origin(w, s, side);
      new.places[k] = w->places[from];
      memcpy(new.cycles + SW_WEAR_SIGNALS *k, w->cycles + SW_WEAR_SIGNALS * from,
             SW_WEAR_SIGNALS * sizeof *new.cycles);
    }
    new.places[k].s = s, new.places[k].side = side;
  }
  new.pressed = w->pressed, w->pressed = (sw_window){0};
  new.sidewall = w->sidewall, new.partial = w->partial; /* holds 0: directions are found anew */
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

/* --- friction -------------------------------------------------------------------- */

/* Length of wire that belongs to a node [m]. */
static double share_of(const sw_plan *p, size_t i) {
  const double before = i > 0 ? p->s[i] - p->s[i - 1] : 0.0;
  const double after = i < p->edges ? p->s[i + 1] - p->s[i] : 0.0;
  return 0.5 * (before + after);
}

static void rub(sw_wear *w, const sw_body *b, size_t node, double share, double work, double slid) {
  if (node < b->first_node || node >= b->first_node + b->plan->nodes || !(share > 0)) return;
  const size_t i = node - b->first_node;
  const double length = share_of(b->plan, i);
  w->places[i].touches = 1;
  w->places[i].rubbed += share * work / length;
  w->places[i].slid += share * slid / length;
}

static void rub_obstacles(const sw_scene *s, const sw_body *b, sw_wear *w) {
  sw_contact *contact = sw_scene_contact(s);
  size_t k = 0, end = 0;
  sw_contact_push p;
  if (!contact) return;
  sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &k, &end);
  for (; k < end; k++) {
    if (!sw_contact_push_at(contact, sw_scene_system(s), k, &p)) continue;
    const double slid = p.normal_force * sw_norm(p.slip);
    const double work = -sw_dot(sw_madd(p.force, p.normal, -p.normal_force), p.slip);
    rub(w, b, p.node, p.node == p.other ? 1 : 1 - p.at, work, slid);
    if (p.node != p.other) rub(w, b, p.other, p.at, work, slid);
  }
}

/* Places where two bodies press on each other wear both. */
static void rub_bodies(const sw_scene *s, const sw_body *b, sw_wear *w) {
  const size_t count = sw_scene_places(s);
  for (size_t k = 0; k < count; k++) {
    const sw_pair_place p = sw_scene_place(s, k);
    const double slid = p.normal_force * sw_norm(p.slip), work = -sw_dot(p.friction, p.slip);
    for (int i = 0; i < 2; i++) {
      if (&sw_scene_system(s)->bodies[p.body[i]] != b) continue;
      rub(w, b, p.node[i], 1 - p.at[i], work, slid);
      if (p.at[i] > 0) rub(w, b, p.end[i], p.at[i], work, slid);
    }
  }
}

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
  if (b->plan->web) {
    sw_wear_free(wear);
    wear->partial = 1;
    return SW_OK;
  }
  sw_status status = fit(wear, b->plan);
  const double *T = rubs ? sw_scene_step_tension(s, b) : sw_system_pull(system, b);
  if (status == SW_OK) status = count_all(s, w, T);
  if (status == SW_OK && rubs) {
    rub_obstacles(s, b, wear), rub_bodies(s, b, wear);
    status = press(s, b->plan, wear);
  }
  if (status != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for the wear of '%s'",
                   sw_scene_wire_in(s, w)->name);
  return SW_OK;
}
