/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds a step's tension, bending, friction and pressure to a wire's places. */
#include "watch/wear.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "read/extremes.h"
#include "record/wear.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"

/* --- places ---------------------------------------------------------------------- */

/* Number of places along a wire: nodes of a line, rings of a mesh. */
static size_t along(const sw_plan *p) { return p->web ? p->web->rings : p->nodes; }

/* Places at a state: those along a wire, then one for each side of a line that has a bend of its
 * own. */
typedef struct layout {
  const sw_plan *plan;
  sw_bent_side *sides; /* NULL: none */
  size_t count;        /* of all places */
} layout;

/* SW_ENOMEM. */
static sw_status lay_out(const sw_system *s, const sw_body *b, layout *out) {
  sw_bent_side side;
  size_t count = 0;
  *out = (layout){.plan = b->plan, .count = along(b->plan)};
  for (size_t next = 0; !b->plan->web && sw_scene_next_side(s, b, &next, &side);) count++;
  if (!count) return SW_OK;
  if (!(out->sides = sw_alloc(count, sizeof *out->sides))) return SW_ENOMEM;
  for (size_t next = 0, k = 0; k < count && sw_scene_next_side(s, b, &next, &side);)
    out->sides[k++] = side;
  out->count += count;
  return SW_OK;
}

static double place_of(const layout *l, size_t k) {
  const sw_plan *p = l->plan;
  if (p->web) return p->web->s[p->web->first[k]];
  return p->s[!l->sides || k < p->nodes ? k : l->sides[k - p->nodes].node];
}

static int side_of(const layout *l, size_t k) {
  return !l->sides || k < along(l->plan) ? 0 : l->sides[k - l->plan->nodes].side;
}

/* 1 if the places are the present ones. Nodes beside a feed may have moved a little along the
 * wire. */
static int is_same(const sw_wear *w, const layout *p) {
  const size_t n = along(p->plan);
  const double slack = 0.25 * (place_of(p, n - 1) - place_of(p, 0)) / (double)n;
  if (w->nodes != n || w->count != p->count) return 0;
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

/* Returns the old place from which a new one goes on: the nearest. Of several at one node: the one
 * of the same side, else the one with the widest cycles. */
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

/* Returns where the wire that belongs to place k begins. Place k ends where k + 1 begins; the last
 * one ends at k = nodes [m]. */
static double begin_of(const sw_wear *w, size_t k) {
  if (k == 0) return w->places[0].s;
  return k < w->nodes ? 0.5 * (w->places[k - 1].s + w->places[k].s) : w->places[k - 1].s;
}

/* Moves the work of friction to the new places without changing its sum: a new place gets the mean
 * of the old ones over its length. */
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

/* Carries the wear over to the present places. */
static void carry_over(const sw_wear *old, const layout *p, sw_wear *new) {
  for (size_t k = 0; k < new->count; k++) {
    const double s = place_of(p, k);
    const int side = side_of(p, k);
    if (old->count) {
      const size_t from = origin(old, s, side);
      new->places[k] = old->places[from];
      memcpy(new->cycles + SW_WEAR_SIGNALS *k, old->cycles + SW_WEAR_SIGNALS * from,
             SW_WEAR_SIGNALS * sizeof *new->cycles);
    }
    new->places[k].s = s, new->places[k].side = side;
  }
  if (old->count) spread_friction(old, new);
}

/* Handles unchanged places of which some have moved along the wire. */
static sw_status move_places(sw_wear *w, const layout *p) {
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

static sw_status fit(sw_wear *w, const layout *p) {
  if (w->count && is_same(w, p)) return move_places(w, p);
  sw_wear new = {.count = p->count, .nodes = along(p->plan)};
  if (SW_ALLOC_ALL(SW_ROOM(new.places, new.count), SW_ROOM(new.cycles, SW_WEAR_SIGNALS * new.count),
                   SW_ROOM(new.across, new.count)) != SW_OK) {
    sw_wear_free(&new);
    return SW_ENOMEM;
  }
  carry_over(w, p, &new);
  new.pressed = w->pressed, w->pressed = (sw_window){0};
  new.sidewall = w->sidewall; /* holds stays 0: directions are found anew */
  sw_wear_free(w);
  *w = new;
  return SW_OK;
}

/* --- sidewall pressure ---------------------------------------------------------- */

/* Returns the pressure at a touching node. On a round body the turns at the nodes are alternately
 * too large and too small. So where the next node touches too, the mean of both counts. */
static double pressure_at(const sw_wear *w, size_t i) {
  const sw_wear_place *x = &w->places[i];
  if (!x->touches) return 0;
  if (i + 1 < w->nodes && x[1].touches) return 0.5 * (x[0].load + x[1].load);
  return i > 0 && x[-1].touches ? 0 : x->load;
}

/* A node beside a clamp or joint gets the larger load of the two. */
static void press_sides(const layout *p, sw_wear *w) {
  for (size_t k = w->nodes; p->sides && k < w->count; k++) {
    sw_wear_place *node = &w->places[p->sides[k - w->nodes].node];
    node->load = fmax(node->load, w->places[k].load);
  }
}

/* Differences of integrals leave rounding errors where nothing presses. Every real load is larger
 * [N/m]. */
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
  if (most.value > 0 && !due) return most; /* otherwise the run is shorter than the window */
  const size_t i = sw_window_largest(window, c->window, &mean);
  keep(&most, mean, w->places[i].s, window->now);
  return most;
}

static sw_status fit_pressed(sw_wear *w) {
  if (w->pressed.edges == w->nodes) return SW_OK;
  double *s SW_LOCAL = sw_alloc(w->nodes, sizeof *s);
  if (!s) return SW_ENOMEM;
  for (size_t i = 0; i < w->nodes; i++) s[i] = w->places[i].s;
  return sw_window_fit(&w->pressed, w->nodes, s);
}

static void keep_mean(sw_wear *w, double window) {
  double mean;
  const size_t i = sw_window_largest(&w->pressed, window, &mean);
  keep(&w->sidewall, mean, w->places[i].s, w->pressed.now);
}

/* A single step of an impact does not tell how long it lasts. So means over the window count, as
 * for other peaks. */
static sw_status press(sw_scene *s, const layout *p, sw_wear *w) {
  sw_course *c = sw_scene_course(s);
  const int averaged = sw_scene_is_averaged(s);
  const double end = sw_scene_time(s);
  press_sides(p, w);
  for (size_t i = 0; i < w->nodes && !averaged; i++)
    keep(&w->sidewall, pressure_at(w, i), w->places[i].s, end);
  if (!averaged && !w->pressed.marks && !(c->span > 0)) return SW_OK;
  SW_TRY(fit_pressed(w));
  if (!(c->span > 0)) {
    sw_window_forget(&w->pressed);
    return SW_OK;
  }
  double *values = sw_window_values(&w->pressed);
  for (size_t i = 0; i < w->nodes; i++) values[i] = pressure_at(w, i);
  const double begin = end - c->span;
  double from = begin;
  /* NOLINTNEXTLINE(cert-flp30-c): from cut to cut, which are found anew each time */
  for (double at; (at = sw_window_cut(&w->pressed, begin, end, c->window)) < end; from = at)
    if (sw_window_add(&w->pressed, values, at, at - from, c->window)) keep_mean(w, c->window);
  if (sw_window_add(&w->pressed, values, end, end - from, c->window) && averaged)
    keep_mean(w, c->window);
  return SW_OK;
}

/* Makes room for across, which wear from a tape or a snapshot does not have. */
static sw_status make_room(sw_wear *w) {
  if (!w->across) w->across = sw_alloc(w->count, sizeof *w->across);
  return w->across ? SW_OK : SW_ENOMEM;
}

static sw_status out_of_memory(const sw_scene *s, size_t w, sw_error *err) {
  return sw_fail(err, SW_ENOMEM, "out of memory for the wear of '%s'",
                 sw_scene_wire_in(s, w)->name);
}

sw_status sw_wear_fit(sw_scene *s, size_t w, sw_error *err) {
  const sw_body *b = &sw_scene_system(s)->bodies[w];
  layout l;
  if (b->plan->web && !b->plan->web->per_ring) return SW_OK;
  sw_status status = lay_out(sw_scene_system(s), b, &l);
  if (status == SW_OK) status = fit(&sw_scene_wire_in(s, w)->wear, &l);
  sw_free(l.sides);
  return status == SW_OK ? SW_OK : out_of_memory(s, w, err);
}

sw_status sw_wear_note(sw_scene *s, size_t w, int rubs, sw_error *err) {
  const int averaged = rubs && sw_scene_is_averaged(s);
  sw_system *system = sw_scene_system(s);
  sw_wear *wear = &sw_scene_wire_in(s, w)->wear;
  const sw_body *b = &system->bodies[w];
  const sw_web *web = b->plan->web;
  if (web && !web->per_ring) return SW_OK; /* an object, not a wire */
  layout l;
  sw_status status = lay_out(system, b, &l);
  if (status == SW_OK) status = fit(wear, &l);
  if (status == SW_OK) status = make_room(wear);
  if (status == SW_OK && web) sw_wear_count_mesh(system, b, averaged, wear);
  if (status == SW_OK && !web)
    sw_wear_count_line(system, b, l.sides,
                       rubs ? sw_scene_step_tension(s, b) : sw_system_pull(system, b), averaged,
                       wear);
  if (status == SW_OK && rubs) {
    sw_wear_rub(s, b, wear);
    status = press(s, &l, wear);
  }
  sw_free(l.sides);
  return status == SW_OK ? SW_OK : out_of_memory(s, w, err);
}
