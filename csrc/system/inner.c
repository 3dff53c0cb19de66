/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Holds in an inner stage (inner.h). If a hold accelerates with a, the stage places it a h^2/2
 * ahead of its path. A wire with one hold goes along, and has the velocity a h. A wire that two
 * holds keep taut would be stretched by the difference of both shifts. */
#include "system/inner.h"

#include <math.h>

#include "base/each.h"
#include "system/part.h"

/* Shifts are the same if they differ by less than this share of the larger one [-]. */
static const double SAME = 1e-6;
/* A wire is slack if its chord, with the difference of both shifts, is shorter than this share of
 * the wire in between. A sag of 2 % of the span has this share [-]. */
static const double SLACK = 0.999;

/* A wire that bears more than this many times its weight and its inertia is held by something else
 * than this hold, such as an obstacle that it is pressed on [-]. */
static const double BLOCKED = 2.0;

static sw_vec place_of(const sw_system *s, const sw_held_node *h) {
  return sw_pose_point(s->hold_states[h->hold].pose, h->local);
}

/* Places a hold exactly at its pose at t. A guide's wire slides to that, too. */
static sw_status place_exactly(sw_system *s, int hold, double t, sw_hold_state *out,
                               sw_error *err) {
  const double inner = s->inner;
  s->inner = 0;
  const sw_status status = s->coupling.place(s->coupling.user, hold, t, out, err);
  s->inner = inner;
  return status;
}

/* Sets each held node's shift. */
static sw_status find_shifts(sw_system *s, double t, sw_error *err) {
  for (size_t i = 0; i < s->held_count;) {
    const int k = s->held[i].hold;
    sw_hold_state exact;
    SW_TRY(place_exactly(s, k, t, &exact, err));
    if (s->held[i].slides) /* back again */
      SW_TRY(s->coupling.place(s->coupling.user, k, t, &s->hold_states[k], err));
    for (; i < s->held_count && s->held[i].hold == k; i++) {
      s->held[i].exact = exact.pose;
      s->held[i].shift =
          sw_add(sw_sub(place_of(s, &s->held[i]), sw_pose_point(exact.pose, s->held[i].local)),
                 s->hold_states[k].ahead);
    }
  }
  return SW_OK;
}

static int is_slack(const sw_system *s, const sw_held_node *a, const sw_held_node *b,
                    double apart) {
  const sw_body *body = &s->bodies[a->body];
  /* a feed that obeys a force tries lengths; the answer must not depend on them */
  if (body->plan->web || a->slides || b->slides) return 0;
  const double from = body->plan->s[a->node - body->first_node];
  const double to = body->plan->s[b->node - body->first_node];
  return sw_dist(place_of(s, a), place_of(s, b)) + apart < SLACK * fabs(to - from);
}

/* Returns the shift that b's place would have if it went with a's hold. */
static sw_vec shift_with(const sw_system *s, const sw_held_node *a, const sw_held_node *b) {
  const sw_hold_state *hold = &s->hold_states[a->hold];
  if (!(sw_norm2(hold->omega) > 0)) return a->shift;
  const sw_vec at = sw_pose_point(b->exact, b->local);
  const sw_vec with = sw_pose_point(hold->pose, sw_pose_local(a->exact, at));
  return sw_add(sw_sub(with, at), hold->ahead);
}

static int disagree(const sw_system *s, const sw_held_node *a, const sw_held_node *b) {
  const double apart = sw_dist(shift_with(s, a, b), b->shift);
  const double most = fmax(sw_norm(a->shift), sw_norm(b->shift));
  return a->hold != b->hold && apart > SAME * most && !is_slack(s, a, b, apart);
}

/* 1 if the wire has one hold, and its axial forces are not those of its weight and its motion with
 * it. Several holds tell by themselves whether they go together. */
static int is_blocked(const sw_system *s, const sw_body *b) {
  const sw_plan *p = b->plan;
  for (size_t k = b->held; k; k = s->held[k - 1].next)
    if (s->held[k - 1].hold != s->held[b->held - 1].hold) return 0;
  const sw_hold_state *hold = &s->hold_states[s->held[b->held - 1].hold];
  const double own = p->beam.mass * p->length * (sw_norm(sw_load(s->gravity)) + sw_norm(hold->a));
  double most = 0;
  for (size_t e = 0; e < p->edges && !p->web; e++)
    most = fmax(most, fabs(s->tension[b->first_edge + e]));
  return most > BLOCKED * own;
}

/* 1 if some pair of the body's holds disagrees. Of each hold the first node counts. */
static int any_disagree(const sw_system *s, const sw_body *body) {
  int last = -1;
  for (size_t k = body->held; k; k = s->held[k - 1].next) {
    const sw_held_node *a = &s->held[k - 1];
    int seen = a->hold;
    if (a->hold == last) continue;
    last = a->hold;
    for (size_t j = a->next; j; j = s->held[j - 1].next) {
      const sw_held_node *b = &s->held[j - 1];
      if (b->hold != seen && disagree(s, a, b)) return 1;
      seen = b->hold;
    }
  }
  return 0;
}

/* Places all holds of a body at their poses at t. */
static sw_status stay(sw_system *s, const sw_body *body, double t, sw_error *err) {
  int last = -1;
  for (size_t k = body->held; k; k = s->held[k - 1].next) {
    const int hold = s->held[k - 1].hold;
    if (hold != last) SW_TRY(place_exactly(s, hold, t, &s->hold_states[hold], err));
    last = hold;
  }
  return SW_OK;
}

sw_status sw_inner_check(sw_system *s, double t, sw_error *err) {
  if (!s->hold_count) return SW_OK;
  SW_TRY(find_shifts(s, t, err));
  SW_ITEMS(const sw_body, body, s->bodies, s->body_count) {
    if (!body->held || !(is_blocked(s, body) || any_disagree(s, body))) continue;
    SW_TRY(stay(s, body, t, err));
    s->stays = 1;
  }
  return SW_OK;
}

static int is_joined(const sw_body *b) { return b->coupled & SW_JOINED; }

int sw_inner_goes_inside(const sw_system *s, const sw_body *body) {
  if (!(s->inner > 0) || !(body->carried > 0) || !body->lies_flat || body->held) return 0;
  for (size_t i = 0; is_joined(body) && i < s->body_count; i++)
    if (is_joined(&s->bodies[i]) && s->bodies[i].held) return 0;
  return 1;
}

/* Edges that turn this much faster than the obstacle do not go with it. Theirs are waves, which the
 * iterations follow better with the length itself [-]. */
static const double FASTER = 2.0;

/* An edge e of the state becomes e' without strain, by the stage's rule, if (e' - e) t' = 0. */
void sw_inner_felt_lengths(const sw_system *s, sw_body *b) {
  sw_field *f = &b->field;
  if (b->plan->web || !sw_inner_goes_inside(s, b)) return;
  const double *x = s->x + 3 * b->first_node, turn = FASTER * b->carried * s->inner;
  for (size_t e = 0; e < b->plan->edges; e++) {
    const sw_vec was = sw_sub(sw_vec_at(x, e + 1), sw_vec_at(x, e));
    const sw_vec t = sw_v(f->tangent[0][e], f->tangent[1][e], f->tangent[2][e]);
    const double length = sw_norm(was), most = 0.5 * turn * turn * length;
    f->length[e] += fmin(length - sw_dot(was, t), most);
  }
}
