/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds static equilibria. First the mixed Newton iteration from the present state. If that fails
 * (mechanisms, snap-through, sliding contact) or ends in an unstable equilibrium: pseudo-transient
 * continuation from the start, see continuation.c. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/join.h"
#include "body/live.h"
#include "body/touching.h"
#include "scene/parts.h"
#include "step/energy.h"
#include "step/statics.h"
#include "system/energy.h"
#include "system/rail.h"

static const double STATIC_TURN = 1e-7; /* last rotation of a converged solve [rad] */
static const double NUDGE = 1e-4; /* push away from an unstable equilibrium, over the length [-] */
enum { MOST_NUDGES = 2 };

/* 1 if a line has no hold. On a smooth table it can be shifted without force, and rounding alone
 * would carry it far. Meshes have enough touches to keep them in place. */
static int loose(const sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  for (size_t b = 0; b < system->body_count; b++) {
    const sw_plan *plan = system->bodies[b].plan;
    size_t i = 0;
    while (i < plan->nodes && plan->held[i] == SW_FREE) i++;
    if (!plan->web && i == plan->nodes && !sw_scene_joined(s, b)) return 1;
  }
  return 0;
}

/* Largest force, over the weight, that the solve with a little mass may leave unbalanced [-]. */
static const double LITTLE = 1e-5;

/* 1 if a wire that holds or feeds draw over something that rubs would come to rest in an unstable
 * place, further away than these went, or if shorter ways may lead to a stable one. A second solve
 * from there would begin friction anew: touches then stick, and the place looks stable. Single
 * poses of 4 to 30 mm so threw lying wires 40 to 180 mm aside (spec/contact/thrown_poses_spec). The
 * push of cables in a bent guide was up to 47 % too small (spec/contact/pushed_poses_spec). */
static int topples(const sw_statics *p, double shift) {
  const int divides = p->may_divide && !(sw_rest_dragged(p) > 0);
  return p->report->negative > 0 && p->slides && p->rests && (divides || shift > p->drawn);
}

sw_status sw_rest_newton(sw_statics *p, int iterations, sw_error *err) {
  const sw_newton newton = {.max_iterations = iterations,
                            .accept_rotation = fmax(STATIC_TURN, p->passing),
                            .limit_rotation = 1.0,
                            .statics = 1,
                            .counts = 1,
                            .accept_shift = fmax(p->args->tolerance, p->passing * p->edge),
                            .most_far = p->most_far};
  const double slowest = SW_REST_SLOWEST_GROWTH * sw_rest_time_scale(p->s);
  const int massive = loose(p->s);
  SW_TRY(sw_rest_solve(p, massive ? slowest : HUGE_VAL, &newton, err));
  p->report->residual = p->args->tolerance;
  const double shift = sw_rest_take(p, p->report->negative > 0);
  const double far = LITTLE * fmax(sw_norm(sw_scene_gravity(p->s)), 1.0) * slowest * slowest;
  if (p->report->negative == 0 && !(massive && shift > far)) return SW_OK;
  if (topples(p, shift))
    return sw_fail(err, SW_ENOCONV, "a wire would come to rest in an unstable place");
  /* once more with a little mass, which removes rounding in neutral directions */
  SW_TRY(sw_rest_solve(p, slowest, &newton, err));
  if (sw_rest_take(p, p->report->negative > 0) > far && massive && p->report->negative == 0)
    return sw_rest_fail_fall(p, err);
  return SW_OK;
}

/* Returns where a particle is in its section: its distance from the section's middle along a
 * direction like no axis of a scene, over the radius; 0 for nodes of a line [-]. */
static double place_across(const sw_system *s, const sw_body *b, size_t i) {
  const sw_web *web = b->plan->web;
  const double *x = s->x + 3 * b->first_node;
  if (!web || !web->per_ring) return 0;
  size_t ring = 0;
  for (size_t end = web->rings; end - ring > 1;) {
    const size_t middle = (ring + end) / 2;
    if (web->first[middle] <= i) ring = middle;
    if (web->first[middle] > i) end = middle;
  }
  const size_t from = web->first[ring], to = web->first[ring + 1];
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = from; k < to; k++) sum = sw_add(sum, sw_vec_at(x, k));
  const sw_vec off = sw_sub(sw_vec_at(x, i), sw_scale(sum, 1.0 / (double)(to - from)));
  return sw_dot(off, sw_v(0.6, 0.64, 0.48)) / b->plan->beam.radius;
}

/* Pushes the wires smoothly sideways, the same in every run. The push has none of a scene's
 * symmetries. It turns sections of meshes too: a mesh that lies on a corner falls by rolling, and
 * friction takes back what only shifts it. */
static void nudge(sw_statics *p, int number) {
  sw_system *s = sw_scene_system(p->s);
  const double size = NUDGE * sw_rest_longest(p->s);
  memset(p->way, 0, s->freedoms * sizeof(double)); /* continuation begins anew */
  SW_ITEMS(const sw_body, body, s->bodies, s->body_count) {
    for (size_t i = 0; i < body->plan->nodes; i++) {
      if (body->plan->held[i] != SW_FREE) continue;
      const double u = body->plan->s[i] / body->plan->length + 0.3 * number;
      const double across = place_across(s, body, i);
      double *shift = p->way + 3 * (body->first_node + i);
      shift[0] = size * sin(2.3 * u + 0.4 + across);
      shift[1] = size * sin(3.1 * u + 0.9 + across);
      shift[2] = size * sin(4.7 * u + 1.3 + across);
    }
  }
  sw_rest_go_on(p, 1.0);
}

/* Loads of held nodes and rails, from the last solve. They are not part of the live state, so they
 * are stored and restored separately. */
typedef struct loads {
  sw_held_node *held; /* (held_count) */
  sw_rail *rails;     /* (rail_count) */
} loads;

static sw_status keep_loads(const sw_system *s, loads *out) {
  *out = (loads){sw_alloc(s->held_count, sizeof *out->held),
                 sw_alloc(s->rail_count, sizeof *out->rails)};
  if (!out->held || !out->rails) return SW_ENOMEM;
  if (s->held_count) memcpy(out->held, s->held, s->held_count * sizeof *s->held);
  if (s->rail_count) memcpy(out->rails, s->rails, s->rail_count * sizeof *s->rails);
  return SW_OK;
}

static void take_loads_back(sw_system *s, const loads *kept) {
  if (s->held_count) memcpy(s->held, kept->held, s->held_count * sizeof *s->held);
  if (s->rail_count) memcpy(s->rails, kept->rails, s->rail_count * sizeof *s->rails);
}

/* Runs Newton's iteration from the place where continuation came to rest. If it fails, the
 * equilibrium is not isolated or (unstable: 1) not stable. Then the result of continuation is
 * restored, with its touches, forces and count of unstable directions, because a failed iteration
 * may end anywhere. */
static sw_status polish(sw_statics *p, int *unstable, sw_error *err) {
  const size_t negative = p->report->negative;
  sw_error why = {"out of memory"};
  sw_tape rest = {0};
  loads kept;
  sw_status status = keep_loads(sw_scene_system(p->s), &kept);
  if (status == SW_OK) status = sw_live_take(p->s, &rest);
  if (status == SW_OK) status = sw_rest_newton(p, SW_REST_ITERATIONS, &why);
  if (sw_rest_stops(status)) sw_fail(err, status, "%s", why.text);
  *unstable = status == SW_OK && p->report->negative > 0;
  if (status != SW_OK) p->report->negative = negative;
  if (status == SW_OK ? *unstable : !sw_rest_stops(status)) {
    status = sw_live_back(p->s, &rest, err);
    take_loads_back(sw_scene_system(p->s), &kept);
  }
  sw_tape_free(&rest);
  sw_free(kept.held), sw_free(kept.rails);
  return status;
}

sw_status sw_rest_continue(sw_statics *p, sw_error *err) {
  for (int k = 0;; k++) {
    int again = 0;
    SW_TRY(sw_rest_transient(p, err));
    SW_TRY(polish(p, &again, err));
    if (!again || k == MOST_NUDGES) return SW_OK;
    nudge(p, k);
  }
}

/* Newton's iteration once more where obstacles drag a wire: updates for each node, and most of them
 * as a share of all iterations [-]. */
enum { SLIDES = 8 };
static const double MOST_SLIDES = 0.5;

static int found(const sw_statics *p, sw_status status) {
  return (status == SW_OK && p->report->negative == 0) || sw_rest_stops(status);
}

/* Continues with all that friction slid since the pose's start, so that wires follow what drags
 * them in steps of any length, and friction opposes their way where holds draw them. *again: 1 if
 * no rest was found; the state is then as before. touched: the time up to which contact followed
 * the obstacles. */
static sw_status continue_keeping(sw_statics *p, double touched, int *again, sw_error *err) {
  const double leads = p->leads;
  const size_t begun = p->report->iterations;
  sw_tape start = {0};
  sw_error why = {"out of memory"};
  sw_status status = sw_live_take(p->s, &start);
  if (status == SW_OK) {
    p->keeps = 1;
    status = sw_rest_continue(p, &why);
    p->keeps = 0;
  }
  *again = status == SW_ENOCONV;
  if (*again) {
    sw_contact *contact = sw_scene_contact(p->s);
    status = sw_live_back(p->s, &start, err);
    if (status == SW_OK && contact) status = sw_contact_began(contact, touched, err);
    p->leads = leads, p->touched = touched;
    p->before += p->report->iterations - begun;
  } else if (status != SW_OK) {
    sw_fail(err, status, "%s", why.text);
  }
  sw_tape_free(&start);
  return status;
}

/* Continues with friction that forgets in each step what it slid. If obstacles or wires drag
 * others, the pose cannot be halved any more and no rest is found, other first steps may find one:
 * a long one where obstacles drag, a short one else. Wires then slide on what drags them. */
static sw_status continue_forgetting(sw_statics *p, double touched, sw_error *err) {
  const double dragged = sw_rest_dragged(p);
  const int may_slide = !p->too_far && (p->leads > 0 || dragged > 0);
  sw_status status = sw_rest_continue(p, err);
  if (status != SW_ENOCONV || !may_slide) return status;
  sw_rest_take_back(p->s, p->kept);
  p->slow = dragged > 0, p->leads = 0, p->before = p->report->iterations;
  if (p->slow) p->touched = touched;
  status = sw_rest_continue(p, err);
  p->slow = 0;
  return status;
}

/* 1 if friction must oppose the whole way of this pose. Where holds draw a wire over the facets of
 * a round surface, touches begin and end in every step of continuation: with friction that forgets,
 * the pull was 15 % low (spec/contact/hollow_edges_spec). On a smooth surface touches go on, and
 * friction that keeps threw wires that buckle far aside (spec/model/example_spec). In a first pose
 * the way is that of a wire that begins in the air. */
static int keeps(const sw_statics *p) {
  const sw_contact *c = sw_scene_contact(p->s);
  return p->leads > 0 || sw_rest_dragged(p) > 0 ||
         (p->slides && p->rests && c && sw_contact_on_facets(c));
}

static sw_status continue_on(sw_statics *p, double touched, sw_error *err) {
  if (keeps(p)) {
    int again = 0;
    const sw_status status = continue_keeping(p, touched, &again, err);
    if (status != SW_OK || !again) return status;
  }
  return continue_forgetting(p, touched, err);
}

/* Returns the energy that wires at rest may give away [J]. */
static double potential(const sw_statics *p) {
  sw_energies e;
  sw_system_energies(sw_scene_system(p->s), 0, NULL, &e);
  return e.gravity + e.stored + e.loads + sw_ledger_contact(p->s);
}

/* A wire that nothing moves may rise by this share of its length's weight, or shift by this share
 * of its length, without being looked at [-]. */
static const double RISE = 0.01;

/* 1 if wires that nothing moves came to rest higher than they were. Where a wire with a pin begins
 * in the air its first update turns it far, and it may come down on another flank of a groove: of
 * 90 cables in grooves 7 lay up to 0.26 m above the bottom (spec/physics/uphill_poses_spec). */
static int rises(const sw_statics *p, double before) {
  const sw_system *s = sw_scene_system(p->s);
  double weight = 0;
  SW_ITEMS(const sw_body, b, s->bodies, s->body_count)
    weight += b->plan->beam.mass * b->plan->length * sw_norm(sw_scene_gravity(p->s));
  const double longest = sw_rest_longest(p->s);
  return sw_rest_shift_from(p, p->kept) > RISE * longest &&
         potential(p) - before > RISE * weight * longest;
}

/* Wires at rest that obstacles drag move about as far as these. Newton's iteration that moved them
 * more than LEAP times as far has lost the way, and may end anywhere: a cable on a table, pushed by
 * 0.15 mm, lay 250 mm farther (spec/contact/pushed_aside_spec). A shift below SMALL_LEAP of the
 * longest wire is not looked at [-]. */
static const double LEAP = 10.0, SMALL_LEAP = 0.01;

/* Runs Newton's iteration from the present state, where obstacles drag wires. *leapt: 1 if it lost
 * the way; the state is then as before. touched: see continue_keeping. */
static sw_status newton_near(sw_statics *p, double touched, int iterations, int *leapt,
                             sw_error *err) {
  const double way = sw_rest_dragged(p) + sw_rest_driven(p), leads = p->leads;
  if (!p->rests || !(sw_rest_dragged(p) > 0)) return sw_rest_newton(p, iterations, err);
  sw_contact *contact = sw_scene_contact(p->s);
  sw_tape start = {0};
  sw_status status = sw_live_take(p->s, &start);
  if (status != SW_OK) sw_fail(err, status, "out of memory");
  if (status == SW_OK) status = sw_rest_newton(p, iterations, err);
  const double shift = status == SW_OK ? sw_rest_shift_from(p, p->kept) : 0.0;
  *leapt = shift > LEAP * way && shift > SMALL_LEAP * sw_rest_longest(p->s);
  if (*leapt) {
    status = sw_live_back(p->s, &start, err);
    if (status == SW_OK && contact) status = sw_contact_began(contact, touched, err);
    p->touched = touched, p->leads = leads;
    if (status == SW_OK)
      status = sw_fail(err, SW_ENOCONV, "a wire would move much farther than what drags it");
  }
  sw_tape_free(&start);
  return status;
}

/* Runs Newton's iteration from the present state, which may not lead upwards by itself. */
static sw_status newton_down(sw_statics *p, double touched, int *leapt, sw_error *err) {
  const sw_system *s = sw_scene_system(p->s);
  const int judged = p->left_alone && !(sw_rest_dragged(p) > 0) && !sw_system_has_powers(s);
  const double before = judged ? potential(p) : 0.0;
  SW_TRY(newton_near(p, touched, SW_REST_ITERATIONS, leapt, err));
  if (!judged || p->report->negative > 0 || !rises(p, before)) return SW_OK;
  return sw_fail(err, SW_ENOCONV, "a wire would come to rest higher than it was");
}

sw_status sw_rest_find(sw_statics *p, sw_error *err) {
  int fell = 0, leapt = 0;
  const double touched = p->touched, leads = p->leads;
  sw_rest_put_aside(p->s, p->kept);
  sw_status status = newton_down(p, touched, &leapt, err);
  if (found(p, status)) return status;
  if (!p->rests && (sw_rest_dragged(p) > 0 || p->leads > 0)) {
    sw_rest_take_back(p->s, p->kept);
    SW_TRY(sw_rest_before(p, &fell, err));
    if (fell) {
      sw_rest_put_aside(p->s, p->kept);
      status = sw_rest_newton(p, SW_REST_ITERATIONS, err);
      if (found(p, status)) return status;
    }
  }
  if (status == SW_ENOCONV && sw_rest_dragged(p) > 0 && !p->rubs && !leapt) {
    sw_rest_take_back(p->s, p->kept); /* touches may begin to slide one by one */
    const double most = SW_REST_ITERATIONS + SLIDES * (double)sw_scene_system(p->s)->nodes;
    status = newton_near(p, touched, (int)fmin(most, MOST_SLIDES * (double)p->args->max_iterations),
                         &leapt, err);
  }
  if (found(p, status)) return status;
  sw_rest_take_back(p->s, p->kept);
  if (p->args->stays && p->too_far) {
    *p->too_far = 1;
    return sw_fail(err, SW_ENOCONV, "a wire may spring past a clip");
  }
  /* continuation may let a wire slide on an obstacle that goes with its hold */
  if (p->too_far && status == SW_ENOCONV && sw_rest_dragged(p) > 0 && sw_rest_driven(p) > 0) {
    *p->too_far = 1;
    return sw_fail(err, SW_ENOCONV, "an obstacle drags a wire too far");
  }
  if (p->may_divide && p->fed > 0 && p->too_far && status == SW_ENOCONV) {
    *p->too_far = 1;
    return sw_fail(err, SW_ENOCONV, "a feed pushes a wire too far in one pose");
  }
  p->divides = p->may_divide && status == SW_ENOCONV && !(sw_rest_dragged(p) > 0);
  if (p->divides) return status;
  p->leads = leads;
  return continue_on(p, touched, err);
}
