/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tie to a fixed point. It pulls one place of a wire towards the point where they are further
 * apart than its slack, E = 1/2 k (d - slack)^2, until the pull exceeds its strength and it breaks.
 * It fixes no direction and never pushes. Valid while its own mass does not matter. A real tie
 * round the wire lets it turn and slide through; this one does not. */
#include <math.h>
#include <stddef.h>

#include "force/axis.h"
#include "force/force.h"
#include "state/tie.h"

typedef struct tether_args {
  double s;         /* [m] */
  sw_vec to;        /* [m] */
  double slack;     /* [m] */
  double stiffness; /* [N/m] */
  double strength;  /* NAN = never breaks [N] */
} tether_args;

static const sw_param rows[] = {
    {"s", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_REQUIRED, NULL, offsetof(tether_args, s),
     "arc length of the tied place"},
    {"to", SW_PARAM_VECTOR, "m", 0, -HUGE_VAL, HUGE_VAL, SW_PARAM_REQUIRED, NULL,
     offsetof(tether_args, to), "the point"},
    SW_TIE_ROWS(tether_args),
};

/* BORNE: pull at the last commit. EVENED: 1 = BORNE was evened over both stages of the step and is
 * not the pull at the present length. */
enum { DISSIPATED, BORNE, EVENED, FATE, HISTORY = FATE + SW_TIE_FATE };

static size_t state_size(const sw_plan *plan SW_UNUSED) { return HISTORY; }

/* The tied place, between places i and i + 1 of the wire. */
typedef struct tied {
  size_t i;
  double part[2];  /* shares of the two places [-] */
  sw_vec apart;    /* from the point to the tied place [m] */
  double distance; /* [m] */
  double pull;     /* [N] */
} tied;

static tied tied_of(const tether_args *a, const sw_field *f) {
  tied t = {0};
  double fraction;
  t.i = sw_plan_locate(f->plan, a->s, &fraction);
  t.part[0] = 1.0 - fraction, t.part[1] = fraction;
  const sw_vec at = sw_lerp(sw_axis_at(f, t.i), sw_axis_at(f, t.i + 1), fraction);
  t.apart = sw_sub(at, a->to);
  t.distance = sw_norm(t.apart);
  t.pull = sw_tie_pull(a->stiffness, a->slack, t.distance);
  return t;
}

/* Returns the force on the tied place [N]. */
static sw_vec force_of(const tied *t, double pull) {
  return sw_scale(sw_unit_or(t->apart, sw_v(0, 0, 0)), -pull);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const tether_args *a = args;
  double K[9];
  if (f->history && f->history[FATE + SW_TIE_BROKEN] > 0) return SW_OK;
  const tied t = tied_of(a, f);
  if (t.distance <= a->slack && a->slack > 0) return SW_OK;
  sw_tie_stiffness(a->stiffness, a->slack, t.apart, 1.0, K);
  sw_axis_put_between(f, t.i, t.part, force_of(&t, t.pull), f->want & SW_WANT_STIFFNESS ? K : NULL);
  if (f->want & SW_WANT_ENERGY) f->energy += 0.5 * t.pull * t.pull / a->stiffness;
  return SW_OK;
}

/* Returns the tie's pull at the step's end. Some two-stage methods find a pull that only holds
 * against turning alternately too large and too small; it is then evened over both stages
 * (sw_even_force). before: the previous pull, or NULL. */
static double borne(const tether_args *a, const sw_field *f, const double *before, double pull) {
  if (!f->first.x) return pull;
  sw_field first = *f;
  first.x = f->first.x;
  const sw_vec then = {tied_of(a, &first).pull, 0, 0}, known = {before ? *before : 0, 0, 0};
  return sw_even_force(&f->first, before ? &known : NULL, then, sw_v(pull, 0, 0)).x;
}

static double pull(const void *args, const sw_field *f, const double *h, double *bears) {
  const tether_args *a = args;
  *bears = h[FATE + SW_TIE_BROKEN] > 0 ? 0.0 : isnan(a->strength) ? HUGE_VAL : a->strength;
  return *bears > 0 ? borne(a, f, h + BORNE, tied_of(a, f).pull) : 0.0;
}

static sw_tie_swing swing(const void *args, const sw_field *f, const double *h) {
  const tether_args *a = args;
  const tied t = tied_of(a, f);
  sw_tie_swing out = {.stiffness = a->stiffness, .peak = h[FATE + SW_TIE_PEAK]};
  double inverse = 0;
  const sw_vec n = sw_unit_or(t.apart, sw_v(0, 0, 0));
  for (size_t k = 0; k < 2; k++) {
    inverse += t.part[k] * t.part[k] / sw_axis_mass(f->plan, t.i + k);
    out.rate += t.part[k] * sw_dot(n, sw_axis_velocity(f, t.i + k));
  }
  out.mass = 1.0 / inverse;
  return out;
}

static void commit(const void *args, const sw_field *f, double *h) {
  const tether_args *a = args;
  const tied t = tied_of(a, f);
  const double pulls = borne(a, f, h + BORNE, t.pull);
  h[BORNE] = borne(a, f, NULL, t.pull);
  h[EVENED] = f->first.x != NULL;
  if (!sw_tie_suffers(pulls, a->strength, f->time, h + FATE)) return;
  h[DISSIPATED] += 0.5 * t.pull * t.pull / a->stiffness;
}

static void inherit(const sw_plan *old SW_UNUSED, const double *from, const sw_field *f SW_UNUSED,
                    double *h) {
  for (size_t k = 0; k < HISTORY; k++) h[k] = from[k];
}

/* The same as those of join:read. */
static const char *const outputs[] = {
    "distance",     "tension", "peak",    "broken",  "broken_time",
    "broken_force", "force_x", "force_y", "force_z", NULL};

static void read(const void *args, const sw_field *f, const double *h, double *out) {
  const tied t = tied_of(args, f);
  const double *fate = h + FATE, pulls = h[EVENED] > 0 ? h[BORNE] : t.pull;
  const double tension = fate[SW_TIE_BROKEN] > 0 ? 0.0 : pulls;
  const sw_vec force = force_of(&t, tension);
  const double values[] = {t.distance,
                           tension,
                           fate[SW_TIE_PEAK],
                           fate[SW_TIE_BROKEN],
                           fate[SW_TIE_BROKEN_TIME],
                           fate[SW_TIE_BROKEN_FORCE],
                           force.x,
                           force.y,
                           force.z};
  for (size_t k = 0; k < sizeof values / sizeof values[0]; k++) out[k] = values[k];
}

static double stable_dt(const void *args, const sw_plan *plan) {
  return sw_axis_stable_dt(plan, ((const tether_args *)args)->stiffness);
}

const sw_force_class sw_force_tether = {
    .name = "tether",
    .summary = "a tie of one place to a fixed point, with slack and strength; see scene:tie",
    .flags = SW_FORCE_AT_PLACE | SW_FORCE_ANY_BODY | SW_FORCE_ANY_SHAPE,
    .params = SW_PARAMS("force tether", rows),
    .eval = eval,
    .stable_dt = stable_dt,
    .state_size = state_size,
    .commit = commit,
    .inherit = inherit,
    .pull = pull,
    .swing = swing,
    .outputs = outputs,
    .read = read,
};
