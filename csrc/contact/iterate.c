/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of an iterate: their forces by the contact law, whether the last matrix is still valid,
 * and whether they agree with the solve. */
#include <math.h>

#include "base/alloc.h"
#include "base/each.h"
#include "contact/depth.h"
#include "contact/rolling.h"
#include "contact/surface.h"
#include "system/part.h"
#include "touch/load.h"
#include "touch/same.h"

static void apply(sw_contact *c, sw_system *s, sw_touch *t, const double *y, unsigned want) {
  double K[6];
  t->press.normal_force = 0;
  t->press.tangential = t->press.slip = sw_v(0, 0, 0);
  if (!t->press.active) return;
  const sw_vec f = sw_press_eval(&t->press, t->friction, c->regime != SW_CONTACT_EXPLICIT, K);
  sw_load_add(&s->bodies[t->body], &t->spot, f, want & SW_WANT_STIFFNESS ? K : NULL);
  if (want & SW_WANT_STIFFNESS && c->regime == SW_CONTACT_STATIC)
    sw_contact_add_rolling(c, s, t, y);
  if (s->rolls) sw_levers_push(s, t, K, want);
}

/* 1 if the touch slides with friction. Its stiffness then changes with its place. */
static int slides(const sw_touch *t) {
  return t->press.sliding && t->friction > 0 && t->press.lag > 0;
}

/* Begins the marks of the touches of a new matrix. */
static void begin_marks(sw_contact *c) {
  c->mark_count = 0;
  c->unmarked = c->parts.on;
}

static void mark(sw_contact *c, const sw_touch *t) {
  if (c->unmarked || !t->press.active) return;
  c->unmarked = slides(t) || SW_GROW(c->marks, c->mark_capacity, c->mark_count + 1) != SW_OK;
  if (!c->unmarked)
    c->marks[c->mark_count++] = (sw_mark){t->candidate, t->at, t->press.k, t->press.normal};
}

/* Adds the forces of the touches from number i to before end, and marks them. */
static void apply_all(sw_contact *c, sw_system *s, size_t i, size_t end, const double *y,
                      unsigned want) {
  for (; i < end; i++) {
    apply(c, s, &c->touches[i], y, want);
    if (want & SW_WANT_STIFFNESS) mark(c, &c->touches[i]);
  }
}

/* A touch still fits the matrix if it moved by less than MOVED of its segment [-], its normal
 * turned by less than TURNED [rad], and its stiffness changed by no more than the share STIFFENED
 * [-]. */
static const double MOVED = 1e-3, TURNED = 0.01, STIFFENED = 0.01;

static int is_marked(const sw_touch *t, const sw_mark *m) {
  return !slides(t) && m->candidate == t->candidate &&
         fabs(m->k - t->press.k) <= STIFFENED * m->k && fabs(m->at - t->at) < MOVED &&
         sw_norm2(sw_sub(m->normal, t->press.normal)) < TURNED * TURNED;
}

/* Finds the touches of an iterate; adds their forces if want is not 0. */
static sw_status look(sw_contact *c, sw_system *s, const double *y, unsigned want, sw_error *err) {
  sw_glance at;
  sw_status status = sw_contact_turn_over(c, &at);
  if (status != SW_OK) return sw_fail(err, status, "contact: %s", sw_status_text(status));
  size_t done = c->parts.touch, found;
  do {
    while (at.next < at.end) {
      SW_TRY(sw_contact_look_on(c, s, y, &at, &found, err));
      if (want) apply_all(c, s, done, found, y, want);
      done = found;
    }
  } while (sw_contact_next_range(c, &at));
  return SW_OK;
}

sw_status sw_contact_keeps(void *contact, sw_system *s, const double *y, int *out, sw_error *err) {
  sw_contact *c = contact;
  size_t active = 0;
  *out = 0;
  if (c->unmarked || c->regime == SW_CONTACT_EXPLICIT) return SW_OK;
  SW_TRY(look(c, s, y, 0, err));
  c->looked = 1;
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    if (!t->press.active) continue;
    if (active >= c->mark_count || !is_marked(t, &c->marks[active++])) return SW_OK;
  }
  *out = active == c->mark_count;
  return SW_OK;
}

/* A touch this near to an obstacle with restitution strikes together with its neighbours [m]. */
static const double NEXT_TO = 1e-6;

/* Notes a touch that presses and so may have struck. If memory runs out, its impact is treated in
 * the next step. */
static void note_pressed(sw_contact *c, const sw_touch *t) {
  const double open = c->obstacles[t->obstacle].restitution > 0 ? NEXT_TO : 0.0;
  if (t->held || !(t->press.normal_force > 0 || t->press.gap_after < open)) return;
  if (SW_GROW(c->pressed, c->pressed_capacity, c->pressed_count + 1) == SW_OK)
    c->pressed[c->pressed_count++] = sw_contact_pressed(t);
}

sw_status sw_contact_eval(void *contact, sw_system *s, double time, double hbar SW_UNUSED,
                          const double *y, unsigned want, sw_error *err) {
  sw_contact *c = contact;
  sw_status status = SW_OK;
  if (c->regime == SW_CONTACT_EXPLICIT) status = sw_contact_begin_stage(c, time, 0, err);
  if (status != SW_OK) return status;
  if (s->rough < SW_NOT_MADE) c->ahead_count = 0, c->passes = c->softer = 0;
  if (want & SW_WANT_STIFFNESS) begin_marks(c);
  if (c->looked)
    apply_all(c, s, c->parts.touch, c->touch_count, y, want);
  else
    status = look(c, s, y, want, err);
  c->looked = 0;
  c->unmarked |= status != SW_OK;
  SW_TRY(status);
  for (size_t i = c->parts.touch; i < c->touch_count && c->regime == SW_CONTACT_EXPLICIT; i++)
    note_pressed(c, &c->touches[i]);
  return SW_OK;
}

/* Shift of a touch by the update, including that of a rolling surface. */
static sw_vec surface_shift(const sw_system *s, const sw_touch *t, const double *delta,
                            sw_vec shift) {
  const sw_levers levers = sw_touch_levers(s, t);
  if (!levers.count) return shift;
  shift = sw_add(shift, sw_levers_tilt(&levers, delta));
  return sw_add(shift, sw_levers_shift(&levers, s->bodies[t->body].spin_delta + 3, 4));
}

/* 1 for the first update of a stage on an obstacle that is not flat. It starts from a prediction,
 * in which the normals of round obstacles are a little off, and must be checked by another one:
 * otherwise the force of ropes that slide round a cylinder would swing by 12 % instead of 1 %, and
 * a mesh that rocks on a peg would gain energy. Meshes in a gripper's pads are excepted: their
 * gripper then finds its force in fewer trials. */
static int is_first(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  if (c->obstacles[t->obstacle].grips > 0 && s->bodies[t->body].plan->web) return 0;
  return c->updates == 1 && c->regime == SW_CONTACT_IMPLICIT && !c->flat[t->obstacle] &&
         t->press.active;
}

/* 1 if the touch may have a new place and normal, on an obstacle that is not flat. */
static int may_change(const sw_contact *c, const sw_touch *t, double shift) {
  const double radius = c->candidates[t->candidate].radius;
  return !c->flat[t->obstacle] && t->press.gap_after < radius &&
         !(shift <= SW_SMALL_SHIFT * radius);
}

/* From this update of a stage on friction need not agree where wires come out of facets; error that
 * counts then, of friction itself, plus this share of the wire's largest force [-]. */
enum { IMPATIENCE = 10 };
static const double OF_SCALE = 0.02;

/* 1 if friction is off by no more than its own size on the facets of a round surface out of which a
 * wire comes slowly. A chord there touches several edges with forces of the way out, and may stick
 * on some while it slides on others in every other iterate, at any size of step: 8 of 24 cables
 * that began with their chords inside ended with "no convergence"
 * (spec/contact/faceted_capstan_spec). The friction of a wire that was put inside has no exact
 * value anyway. */
static int comes_out(const sw_contact *c, const sw_system *s, const sw_touch *t, double scale) {
  const sw_press *p = &t->press;
  if (!sw_contact_is_faceted(c, (size_t)t->obstacle) || !c->fresh || c->updates <= IMPATIENCE ||
      !p->active)
    return 0;
  if (c->regime != SW_CONTACT_IMPLICIT || s->bodies[t->body].plan->web) return 0;
  return sw_press_apart(p) && p->off <= t->friction * p->normal_force + OF_SCALE * scale;
}

/* Sets a touch's forces after the update. Returns 1 if they agree with the assumptions of the
 * solve. Friction of a loose object's many touches may never agree everywhere. After many updates
 * it no longer causes iterations if it shifts a touch by less than a small share of the radius; in
 * that step friction may be off by less than its own size. */
static int update(sw_contact *c, const sw_system *s, sw_touch *t, const double *y,
                  const double *delta, double scale) {
  const sw_vec shift = sw_mean_of(delta, 0, &t->spot);
  const sw_vec surface = s->rolls ? surface_shift(s, t, delta, shift) : shift;
  const int agrees =
      sw_press_update(&t->press, t->friction, surface, scale) || comes_out(c, s, t, scale);
  if (t->held) return 1;
  const double way = sw_norm(shift);
  const sw_web *web = s->bodies[t->body].plan->web;
  const int changes = may_change(c, t, way);
  const int first = is_first(c, s, t);
  if (web || c->regime != SW_CONTACT_IMPLICIT) {
    if ((changes && s->rough < SW_NOT_MADE) || first) return 0;
    const int small = way <= SW_SMALL_SHIFT * c->candidates[t->candidate].radius;
    if (agrees || !small || c->updates <= SW_PATIENCE || !web || web->per_ring) return agrees;
    return sw_press_apart(&t->press);
  }
  if (!agrees || (first && !c->straight[t->obstacle])) return 0;
  return !(changes || first) || sw_contact_stays(c, s, t, y, way, scale);
}

/* Returns the full stiffness of a touch from the next iterate on; touches that are too deep are
 * stiffened [N/m]. */
static double stiffer(const sw_contact *c, const sw_system *s, const sw_touch *t) {
  const int still = c->regime == SW_CONTACT_STATIC, squeezed = t->squeezed && !still;
  if (t->held || c->candidates[t->candidate].given) return t->stiffer;
  const double deepest = sw_contact_deepest(c, s, t);
  const int small = sw_press_is_short(still, c->h, c->asked);
  double before = small || squeezed ? fmax(0.0, sw_contact_depth_before(c, s, t)) : -1.0;
  if (squeezed) before = sw_press_squeezed(t->forgiven, before, deepest);
  const double k = sw_press_stiffer(&t->press, t->share * t->usual,
                                    t->share * sw_contact_edge_stiffness(s, t->body, t->node),
                                    deepest, t->forgiven, before);
  if (!(k > t->press.k) || (!still && sw_contact_is_pinched(c, t))) return t->stiffer;
  return k / t->share;
}

/* Stiffens touches that are too deep. Returns 1 if there are any. */
static int stiffen(sw_contact *c, const sw_system *s) {
  int any = 0;
  for (size_t i = c->parts.touch; i < c->touch_count; i++) {
    sw_touch *t = &c->touches[i];
    t->stiffer = stiffer(c, s, t);
    any |= sw_touch_is_softer(t);
  }
  return any;
}

/* Sets the forces of all touches after the update. Returns 1 if they agree; then pressing touches
 * are noted, and *changes is 1 if stiffnesses should change. */
static int update_all(sw_contact *c, const sw_system *s, const double *y, const double *delta,
                      int *changes) {
  const int may = c->regime != SW_CONTACT_EXPLICIT && !s->rough;
  int fine = 1;
  *changes = 0;
  for (size_t first = c->parts.touch, end; first < c->touch_count; first = end) {
    const double scale = sw_contact_scale(c, first, &end);
    for (size_t i = first; i < end; i++) {
      sw_touch *t = &c->touches[i];
      sw_touch_fetch(t, SW_FETCH_PRESS);
      fine &= update(c, s, t, y, delta, scale);
      if (!fine) continue;
      note_pressed(c, t);
      if (may) *changes |= stiffer(c, s, t) != t->stiffer || sw_touch_is_softer(t);
    }
  }
  return fine;
}

/* A wire with at most this many touches with friction stands rather than lies. It may be bent and
 * about to slip, and its touches then depend on its bends [-]. */
enum { SINGLE = 4 };

static int stands(const sw_contact *c) {
  int rubs = 0;
  for (size_t i = 0; i < c->touch_count; i++)
    rubs += c->touches[i].press.active && c->touches[i].friction > 0;
  return rubs > 0 && rubs <= SINGLE;
}

/* 1 if friction is the only nonlinearity of the touches, because all are on flat obstacles. Then
 * the sliding touches are found before the update is made; otherwise the update would go the wrong
 * way. Places on edges and round sides are found by updates. */
static int rubs_on_flat(const sw_contact *c, const sw_system *s) {
  int rubs = 0;
  if (s->rolls) return 0;
  SW_ITEMS(const sw_touch, t, c->touches, c->touch_count) {
    if (!t->press.active) continue;
    if (!c->flat[t->obstacle]) return 0;
    rubs |= t->friction > 0;
  }
  return rubs;
}

/* After EASY_PASSES solves at one place, touches that do not agree are searched for agreement. No
 * update is made before they agree once there were EASY_UPDATES updates of positions, or
 * SOME_UPDATES if at most FEW_WRONG touches are wrong [-]. */
enum { EASY_PASSES = 8, EASY_UPDATES = 14, SOME_UPDATES = 8, FEW_WRONG = 4 };

/* 1 if the touches should agree before the possible update is made. */
static int rather_waits(const sw_contact *c, const sw_system *s) {
  if (stands(c)) return 0;
  if (c->softer || rubs_on_flat(c, s) || c->made >= EASY_UPDATES) return 1;
  return c->made >= SOME_UPDATES && sw_contact_wrong(c) <= FEW_WRONG;
}

static int searches(sw_contact *c, const sw_system *s) {
  if (s->rough < SW_NOT_MADE || stands(c)) return 0;
  return ++c->passes > EASY_PASSES || s->rough == SW_MAY_BE_MADE || !sw_contact_wrong(c);
}

/* 1 if the current part of bodies strikes something. Its friction need not agree: the trial will be
 * repeated with other speeds. */
static int is_hasty(sw_contact *c, sw_system *s) {
  if (!sw_part_is_single(s) || c->careful || s->rough || c->regime != SW_CONTACT_IMPLICIT) return 0;
  for (size_t i = c->parts.touch; i < c->touch_count; i++)
    if (!c->touches[i].held && !sw_press_apart(&c->touches[i].press)) return 0;
  if (!sw_contact_will_strike(c, s, c->parts.touch, c->touch_count)) return 0;
  c->pressed_count = c->pressed_before;
  for (size_t i = c->parts.touch; i < c->touch_count; i++) note_pressed(c, &c->touches[i]);
  return c->hasty = 1;
}

int sw_contact_settled(void *contact, sw_system *s, const double *y, const double *delta) {
  sw_contact *c = contact;
  int changes;
  c->pressed_count = c->pressed_before;
  c->updates++;
  const int fine = update_all(c, s, y, delta, &changes) && !c->softer;
  c->made += s->rough < SW_NOT_MADE;
  if (!fine) c->pressed_count = c->pressed_before;
  if (!fine && is_hasty(c, s)) return 1;
  if (!fine && s->rough == SW_MAY_BE_MADE && !rather_waits(c, s)) {
    c->updates--;
    return 1;
  }
  if (!fine && !(searches(c, s) && sw_contact_search(c, s, delta))) sw_contact_peel(c, s);
  if (!fine || !changes || !stiffen(c, s)) return fine;
  c->pressed_count = c->pressed_before;
  return 0;
}
