/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A touch of two bodies: how it begins from its memory, and whether it agrees with a solve. */
#include "mutual/meet.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "contact/contact.h"
#include "touch/same.h"

/* --- one touch ------------------------------------------------------------------- */

/* Share of a place that moves with free nodes [-]; *held: position of its held part [m]. */
static double free_share(const sw_system *s, const sw_meet *t, int side, sw_vec *held) {
  const sw_body *b = &s->bodies[t->of.body[side]];
  const uint32_t node = t->of.node[side], other = t->of.end[side];
  const double at = t->at[side];
  const int *is = b->plan->held;
  const int one = is[node - b->first_node] != SW_FREE, two = is[other - b->first_node] != SW_FREE;
  const sw_vec start = sw_vec_at(s->x, node), end = sw_vec_at(s->x, other);
  *held = one && two ? sw_lerp(start, end, at) : one ? start : end;
  return (one ? 0.0 : 1.0 - at) + (two ? 0.0 : at);
}

/* Depth that holds impose [m]: no force parts wires that are held closer than their radii. */
static double imposed(const sw_system *s, const sw_meet *t) {
  sw_vec a, b;
  const double one = free_share(s, t, 0, &a), share = sw_larger(one, free_share(s, t, 1, &b));
  return share < 1.0 ? (1.0 - share) * sw_larger(0.0, t->reach - sw_dist(a, b)) : 0.0;
}

static int is_line(const sw_system *s, uint32_t body) { return !s->bodies[body].plan->web; }

/* 1 if the touch of two wires pressed at the step's start. Stiffened within a step, it would press
 * more at the same depth and store energy from nowhere: a drawn twisted pair repeated each step and
 * sank in by 0.3 of the radius (spec/contact/drawn_pair_spec). It stiffens between steps. */
static int is_squeezed(const sw_mutual *m, const sw_system *s, const sw_met *met,
                       const sw_meet *t) {
  if (!met || m->regime != SW_CONTACT_IMPLICIT) return 0;
  if (!is_line(s, t->of.body[0]) || !is_line(s, t->of.body[1])) return 0;
  return met->kept.normal_force > 0 || met->kept.left != 0 || met->kept.edited;
}

/* Axial stiffness of the softer of both edges [N/m]. */
static double axial_of(const sw_system *s, const sw_meet *t) {
  return sw_smaller(sw_contact_edge_stiffness(s, t->of.body[0], t->of.node[0]),
                    sw_contact_edge_stiffness(s, t->of.body[1], t->of.node[1]));
}

/* 1 if a touch of two wires is not the remembered one: of another kind, as segments that lay along
 * each other now cross, or at another place. Its depth is no motion: it was there before, not seen,
 * and would throw the wires apart. */
static int is_elsewhere(const sw_system *s, const sw_met *met, const sw_meet *t) {
  if (!is_line(s, t->of.body[0]) || !is_line(s, t->of.body[1])) return 0;
  double most = 0;
  for (int k = 0; k < 2; k++)
    most = fmax(most, fabs((double)met->of.node[k] + met->at[k] - t->of.node[k] - t->at[k]));
  return met->kind != t->kind || most > SW_SAME_TOUCH;
}

/* Sets the part of a touch's depth that the step does not correct. Wires placed in each other come
 * out slowly: else the depth would become speed. So do unseen touches and other edges far inside.
 */
static void forgive(const sw_mutual *m, const sw_system *s, const sw_met *met, sw_meet *t) {
  const int edited = met && met->kept.edited, stays = edited || (met && met->kept.left < 0);
  const int outside = t->press.gap >= 0 && !(stays && m->regime == SW_CONTACT_IMPLICIT);
  if (m->regime == SW_CONTACT_EXPLICIT || outside) return;
  const double always = imposed(s, t);
  t->forgiven = always;
  if (m->regime != SW_CONTACT_IMPLICIT) return;
  const double depth = t->reach - sw_dot(t->square, sw_bows_apart(s->x, t->bow)) - always;
  const double off = edited ? fabs(depth - met->kept.depth - met->kept.left) : 0.0;
  const int far = off > sw_depth_for(SW_DEEPEST, 0.5 * t->reach); /* it comes out */
  t->emerges |= far || (met ? met->emerges || (!edited && is_elsewhere(s, met, t))
                            : sw_press_was_put(depth, m->memory_count == 0));
  sw_kept kept = met ? met->kept : (sw_kept){0};
  t->squeezed = is_squeezed(m, s, met, t);
  const double due = kept.normal_force > 0 ? HUGE_VAL : sw_larger(0.0, depth); /* to the edges */
  if (edited) kept.left = far ? 0.0 : due;
  if (!t->squeezed) kept.left = 0;
  const double way = (t->emerges ? SW_LET_OUT : SW_PART) * m->h;
  sw_left left = sw_press_leave(depth, met ? &kept : NULL, way);
  if (t->emerges && sw_meet_abuts(s, t))
    left = (sw_left){.forgiven = sw_larger(0.0, depth - kept.depth)};
  t->forgiven += left.forgiven, t->left = left.left;
  if (t->emerges) t->let_out = left.let_out;
}

/* Stiffness of a touch, wherever it has slid to [N/m]. */
static double stiffness_of(const sw_mutual *m, const sw_meet *t, const sw_met *met,
                           const sw_meet *last) {
  if (m->regime == SW_CONTACT_EXPLICIT) return t->usual;
  if (last) return last->stiffer;
  return met && met->kept.normal_force > 0 ? met->kept.k : t->usual;
}

/* Touches of wires along each other, and of particles, that pressed at the step's start also press
 * in the first iterate, unless the prediction opens them by more than this share of the sum of
 * radii [-]. Their depth is far below their motion in a step, so a prediction cannot show whether
 * they part. Crossings are excepted: in a tight knot they slide along both segments and would not
 * converge. */
static const double STILL_NEAR = 0.02;

static int stays_near(const sw_mutual *m, const sw_meet *t) {
  if (m->regime != SW_CONTACT_IMPLICIT || !(t->press.gap < STILL_NEAR * t->reach)) return 0;
  return t->kind != SW_CROSSING || t->press.by_place;
}

/* A force that turns with its normal has negative stiffness. At a predicted place, where a wire may
 * be as deep as it flew in the step, this would be thousands of weights. So it is left out until
 * the last update shifts all pressing touches by at most CALM_SHIFT of the radii: a flying wire
 * throws its neighbours too. A touch that shifts by more than NEAR_SHIFT keeps the iteration going
 * [-]. Both apply only to depth that may come from the prediction. Depth by placing or by holds is
 * real, and crossings slide in knots. */
static const double CALM_SHIFT = 0.01, NEAR_SHIFT = 0.02;

static int may_fly(const sw_mutual *m, const sw_meet *t) {
  return m->regime == SW_CONTACT_IMPLICIT && t->kind != SW_CROSSING && !(t->forgiven > 0);
}

static int is_far(const sw_mutual *m, const sw_meet *t, const sw_meet *last, int pressed) {
  if (!t->flies) return 0;
  if (!last) return !pressed;
  return last->stage == m->stage && sw_norm(last->press.shift) > NEAR_SHIFT * t->reach;
}

/* As `soft` of sw_press. Wires along each other have many touches and share their friction. */
static double softness(const sw_mutual *m, const sw_system *s, const sw_meet *t,
                       const sw_met *met) {
  const uint32_t *of = t->of.body;
  if (m->regime != SW_CONTACT_IMPLICIT || t->kind != SW_CROSSING || !met) return 0;
  if (!is_line(s, of[0]) || !is_line(s, of[1])) return 0;
  const double usual = sw_larger(sw_contact_usual_force(s, s->bodies[of[0]].plan),
                                 sw_contact_usual_force(s, s->bodies[of[1]].plan));
  const double grip = sw_kept_grip(&met->kept, axial_of(s, t), usual);
  return grip > t->press.k ? t->press.k / grip : 0.0;
}

/* No smaller depth is asked for. In motion taut pairs of cables then have 1 to 7 % too little pull,
 * instead of 4 to 33 (spec/contact/round_spec). With a tenth of it the pull is within 1 % of that
 * of poses, but soft pairs repeat steps and need ten times the time. Poses of pairs with a third of
 * it do not come to rest [m]. */
static const double LEAST = 1e-6;

static int is_taut(const sw_mutual *m, const sw_system *s, uint32_t body, uint32_t node) {
  const double usual = sw_contact_usual_force(s, s->bodies[body].plan);
  return sw_drawn_is_taut(s, body, node, m->drawn[body].taken, usual);
}

/* Largest allowed depth within a step [m]. Equilibria for their own sake keep the usual depth:
 * pairs that hang would not come to rest. So do crossings in motion: a drawn cable that stops on
 * others lost its friction (spec/contact/pair_stop_spec). */
static double deepest(const sw_mutual *m, const sw_system *s, const sw_meet *t) {
  const int still = m->regime == SW_CONTACT_STATIC;
  const double least = sw_depth_for(LEAST, 0.5 * t->reach);
  double most = sw_depth_for(SW_DEEPEST, 0.5 * t->reach);
  if (m->regime == SW_CONTACT_EXPLICIT || (still ? !s->tight : t->kind == SW_CROSSING)) return most;
  for (int k = 0; k < 2; k++) {
    const uint32_t body = t->of.body[k], node = t->of.node[k], end = t->of.end[k];
    if (sw_drawn_has(&m->drawn[body], node, end) && (!still || is_taut(m, s, body, node)))
      most = fmin(most, sw_drawn_depth(s, body, node, end, t->square, least));
  }
  return most;
}

sw_meet *sw_meet_new(sw_mutual *m) {
  if (SW_GROW(m->touches, m->touch_capacity, m->touch_count + 1) != SW_OK) return NULL;
  return memset(&m->touches[m->touch_count], 0, sizeof *m->touches);
}

void sw_meet_add(sw_mutual *m, const sw_system *s, const double *y, sw_meet *t, double gap,
                 sw_vec normal, const sw_met *met, const sw_meet *last) {
  sw_press *press = &t->press;
  const int pressed = met && met->kept.normal_force > 0;
  t->stage = m->stage, t->known = pressed;
  press->gap = gap, press->normal = normal;
  if (!(sw_norm2(t->square) > 0)) t->square = normal;
  press->k = t->stiffer = stiffness_of(m, t, met, last);
  press->soft = softness(m, s, t, met);
  t->deepest = deepest(m, s, t);
  forgive(m, s, met, t);
  press->gap += t->forgiven;
  press->gap_after = press->gap;
  sw_press_activate(press, last && m->regime != SW_CONTACT_EXPLICIT ? &last->press : NULL);
  t->flies = may_fly(m, t);
  t->far = is_far(m, t, last, pressed);
  t->turns = !t->flies || (m->calm && !t->far);
  if (pressed && !last) press->active |= stays_near(m, t);
  sw_meet_begin_friction(m, s, y, t, met, last);
  m->touch_count++;
}

/* Lines that continue to press each other have as little depth as in obstacles. With the usual
 * depth the pull of a twisted pair of cables was 5 % too low. */
double sw_meet_depth(const sw_meet *t) {
  const double usual = t->deepest, shallow = 0.5 * SW_SHALLOW * t->reach;
  return t->squeezed ? sw_smaller(usual, shallow) : usual;
}

sw_met sw_meet_remember(const sw_system *s, const sw_meet *t) {
  const double deepest = sw_meet_depth(t);
  sw_met out = {.of = t->of,
                .kind = t->kind,
                .at = {t->at[0], t->at[1]},
                .kept = sw_press_keep(&t->press, t->usual, t->stiffer, deepest, 1.0),
                .normal = t->press.normal,
                .emerges = t->let_out > 0 || (t->emerges && t->forgiven > 0)};
  out.kept.left = t->left;
  if (t->squeezed) sw_kept_harden(&out.kept, axial_of(s, t), deepest);
  return out;
}

/* Axes further apart than this share of the sum of radii did not pass each other in this iteration.
 * Without the limit knots fail: their normals turn by more than a right angle within two segments
 * [-]. */
static const double PASSED = 0.5;

void sw_meet_side(const sw_met *met, double reach, sw_vec *normal, double *distance) {
  if (met && *distance < PASSED * reach && sw_dot(*normal, met->normal) < 0)
    *normal = sw_neg(*normal), *distance = -*distance;
}

double sw_meet_excess(const sw_system *s, const sw_bow bow[2], double reach, sw_vec normal,
                      double h) {
  const double gap = sw_dot(normal, sw_bows_apart(s->x, bow)) - reach;
  const double approach = -sw_dot(sw_bows_apart(s->v, bow), normal);
  return approach - (gap > 0 ? gap : 0.0) / h;
}

/* --- before a solve ---------------------------------------------------------------- */

/* Number of first solves with softer springs. Where the prediction lets wires fly into each other,
 * stiff springs would hold every overlap at its surface, and neighbouring touches would push and
 * pull with many times their real force; half of the resulting states are wrong. The stiffness is
 * SOFTER times for each remaining soft solve, this one included [-]. Falling bundles of 16 and 20
 * wires then need a third to a half of the solves; with one or three soft solves, or 3 or 100 times
 * as soft, 1.1 to 1.7 times as many (spec/contact/bundle_spec). */
enum { SOFT_SOLVES = 2 };
static const double SOFTER = 0.1;
/* A larger overlap, over the radii, comes from flight in the prediction [-]. */
static const double FLOWN = 0.005;
/* Stiff springs throw wires about while these still slide past each other. So springs keep their
 * softness while an update shifts some pressing touch by more than this share of the radii, for at
 * most the first LONG_SOFT solves. 24 falling bundles of 7 to 20 wires then need 0.72 times the
 * solves; shares of 0.05 and 0.1 give the same [-]. */
static const double PASSES_ROUND = 0.07;
enum { LONG_SOFT = 6 };

static int have_flown(const sw_mutual *m) {
  SW_ITEMS(const sw_meet, t, m->touches, m->touch_count) {
    if (t->flies && t->press.gap < -FLOWN * t->reach) return 1;
  }
  return 0;
}

void sw_mutual_soften(sw_mutual *m) {
  if (m->regime != SW_CONTACT_IMPLICIT) return;
  if (m->solves == 0)
    m->soft = have_flown(m) ? SOFT_SOLVES : 0;
  else if (m->soft > 0 && (m->solves >= LONG_SOFT || m->widest <= PASSES_ROUND))
    m->soft--;
  m->more_soft += m->soft > 0 && m->solves >= SOFT_SOLVES;
  for (size_t i = 0; i < m->touch_count && m->soft; i++)
    if (m->touches[i].flies) m->touches[i].press.k *= pow(SOFTER, m->soft);
}

/* --- after a solve ---------------------------------------------------------------- */

/* Stiffens touches that are too deep. Returns 1 if there are any. */
static int stiffen(sw_mutual *m, const sw_system *s) {
  const int small = sw_press_is_short(m->regime == SW_CONTACT_STATIC, m->h, m->nominal);
  int any = 0;
  if (m->regime == SW_CONTACT_EXPLICIT || s->rough) return 0;
  SW_ITEMS(sw_meet, t, m->touches, m->touch_count) {
    const double deepest = t->deepest;
    double before = sw_larger(0.0, t->reach - sw_dot(t->square, sw_bows_apart(s->x, t->bow)));
    before = t->squeezed ? sw_press_squeezed(t->forgiven, before, deepest) : small ? before : -1.0;
    t->stiffer =
        sw_press_stiffer(&t->press, t->usual, axial_of(s, t), deepest, t->forgiven, before);
    any |= t->stiffer > t->press.k;
  }
  return any;
}

/* Finds force scales: forces far below the largest touch of a body do not matter; for a touch of
 * two bodies the smaller scale counts. */
static void find_scales(sw_mutual *m) {
  for (size_t b = 0; b < m->bodies; b++) m->largest[b] = 0;
  for (size_t i = 0; i < m->touch_count; i++)
    for (size_t k = 0; k < 2; k++) {
      double *largest = &m->largest[m->touches[i].of.body[k]];
      const double lag = m->touches[i].press.lag;
      if (lag > *largest) *largest = lag;
    }
}

static double scale_of(const sw_mutual *m, const sw_meet *t) {
  return sw_smaller(m->largest[t->of.body[0]], m->largest[t->of.body[1]]);
}

typedef enum verdict { GOES_ON, ALL_BUT_FRICTION, AGREES } verdict;

static verdict update(const sw_mutual *m, sw_meet *t, const double *delta, double scale) {
  const sw_vec shift = sw_meet_passes(t, delta);
  const double friction = sw_mutual_rule(m, t->of.body)->friction;
  const int agrees = sw_press_update(&t->press, friction, shift, scale);
  for (int i = 0; i < 2; i++) sw_press_weigh(&t->press, friction, &m->rubbing[t->of.body[i]]);
  if (t->press.gap_after < 0.5 * t->reach && sw_norm(shift) > SW_SMALL_SHIFT * t->reach)
    return GOES_ON;
  if (t->far && t->press.normal_force > 0) return GOES_ON;
  return agrees ? AGREES : sw_press_apart(&t->press) ? ALL_BUT_FRICTION : GOES_ON;
}

/* 1 if the total error of friction is small for each body. */
static int rubs_enough(const sw_mutual *m) {
  if (m->regime != SW_CONTACT_IMPLICIT || m->updates <= SW_PATIENCE) return 0;
  for (size_t b = 0; b < m->bodies; b++)
    if (!sw_press_enough(&m->rubbing[b])) return 0;
  return 1;
}

static int update_all(sw_mutual *m, const double *delta) {
  verdict all = AGREES;
  find_scales(m);
  m->updates++;
  m->widest = 0;
  memset(m->rubbing, 0, m->bodies * sizeof *m->rubbing);
  SW_ITEMS(sw_meet, t, m->touches, m->touch_count) {
    const verdict one = update(m, t, delta, scale_of(m, t));
    if (t->press.normal_force > 0)
      m->widest = sw_larger(m->widest, sw_norm(t->press.shift) / t->reach);
    all = one < all ? one : all;
  }
  m->calm = m->widest <= CALM_SHIFT;
  if (m->soft) return 0;
  return all == AGREES || (all == ALL_BUT_FRICTION && rubs_enough(m));
}

/* Touches agree within this many solves, or they will probably cycle. Later updates are shortened
 * to the energy's minimum if the slope of the energy at the end is more than RISES times its
 * initial fall. This limit is multiplied by FALLS from solve to solve; two alternating touches need
 * a very small one. Measured with 20 wires whose nodes do not lie beside each other, in steps of
 * 2.5 ms: without shortening most steps are halved, some without end; with half of RISES, twice of
 * FREE_SOLVES, or a limit that falls half or twice as fast, at most 1.2 times the solves
 * (spec/contact/bundle_spec). Further soft solves do not count. */
enum { FREE_SOLVES = 12 };
static const double RISES = 0.5, FALLS = 0.8; /* [-] */

static double share_of(sw_mutual *m, sw_contact *contact, sw_system *s) {
  sw_ways *w = &m->ways;
  const int solves = ++m->solves - m->more_soft - FREE_SOLVES;
  if (solves <= 0 || m->regime != SW_CONTACT_IMPLICIT || !sw_bridges_solves_again(s)) return 1.0;
  w->count = 0, w->work = sw_bridges_work(s);
  if (contact) sw_contact_add_ways(contact, s, w);
  SW_ITEMS(sw_meet, t, m->touches, m->touch_count) {
    sw_ways_add(w, &t->press, sw_mutual_rule(m, t->of.body)->friction, sw_meet_passes(t, s->delta));
  }
  return sw_ways_share(w, RISES * pow(FALLS, solves - 1));
}

/* Sets how the turns of both wires move their surfaces at a place. */
static void set_turns(sw_spot *spot, const sw_meet *t) {
  int i = 0;
  spot->eases = t->eases;
  if (!(spot->turns = sw_meet_turns(t))) return;
  for (int side = 0; side < 2; side++)
    for (uint32_t k = 0; k < t->bow[side].spot.count; k++)
      spot->lever[i++] = sw_scale(t->lever[side], t->bow[side].slope[k]);
}

double sw_mutual_refine(sw_mutual *m, sw_contact *contact, sw_system *s) {
  m->spots.count = 0;
  if (contact) sw_contact_add_spots(contact, s, &m->spots);
  find_scales(m);
  SW_ITEMS(sw_meet, t, m->touches, m->touch_count) {
    const double friction = sw_mutual_rule(m, t->of.body)->friction;
    const sw_spot spot = {.press = &t->press, .friction = friction, .scale = scale_of(m, t)};
    sw_spot *added = sw_spots_add(&m->spots, s, spot, &t->bow[0].spot, t->of.body[0],
                                  &t->bow[1].spot, t->of.body[1]);
    if (added) set_turns(added, t);
  }
  sw_spots_follow(&m->spots, s);
  return share_of(m, contact, s);
}

int sw_mutual_settled(sw_mutual *m, sw_system *s, const double *delta) {
  const int fine = update_all(m, delta);
  if (fine && stiffen(m, s)) return 0;
  for (size_t i = 0; fine && i < m->touch_count; i++) {
    const sw_meet *t = &m->touches[i];
    if (!(t->press.normal_force > 0 || t->press.gap_after < 0)) continue;
    if (SW_GROW(m->hits, m->hit_capacity, m->hit_count + 1) != SW_OK)
      break; /* out of memory: the impact is treated in the next step */
    m->hits[m->hit_count++] =
        (sw_hit){.bow = {t->bow[0], t->bow[1]}, .normal = t->press.normal, .reach = t->reach};
  }
  return fine;
}
