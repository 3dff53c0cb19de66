/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Air or liquid that streams past a wire. With u = wind - velocity, split into u_t along the wire
 * and u_n across it, the force per length is
 *   1/2 rho d (Cn |u_n| u_n + pi Ct |u_t| u_t)
 * (Morison's drag by the cross-flow principle; Hoerner, Fluid-Dynamic Drag, 1965, chapters 2, 3).
 * Cn = 1.2 is that of a smooth cylinder at Reynolds numbers from 1e3 to 2e5, about right from 200
 * on; slower streams have more drag. Ct = 0.02 is surface friction. The wind is velocity + gust
 * sin(2 pi frequency t), the same everywhere. Lift, added mass and shelter by other bodies are left
 * out. The stiffness contains the derivatives by velocity. The derivatives by the wire's directions
 * are left out: their symmetric part, the only one that the matrix can hold, vanishes except at the
 * wire's ends. In statics, where nothing else holds a slack wire, iterations then oscillate; see
 * hold_back. */
#include <math.h>
#include <stddef.h>

#include "force/axis.h"
#include "force/force.h"

typedef struct wind_args {
  sw_vec velocity, gust; /* [m/s] */
  double frequency;      /* [Hz] */
  double density;        /* [kg/m3] */
  double normal, tangential;
  double diameter; /* NAN: the wire's diameter [m] */
} wind_args;

#define AT(field) offsetof(wind_args, field)
static const sw_param rows[] = {
    {"velocity", SW_PARAM_VECTOR, "m/s", 0, -1e3, 1e3, SW_PARAM_REQUIRED | SW_PARAM_CHANGES, NULL,
     AT(velocity), "mean velocity of the wind, in the direction to which it blows"},
    {"gust", SW_PARAM_VECTOR, "m/s", 0, -1e3, 1e3, SW_PARAM_CHANGES, NULL, AT(gust),
     "largest velocity of gusts, which vary with time as a sine"},
    {"frequency", SW_PARAM_NUMBER, "Hz", 1, 0, HUGE_VAL, SW_PARAM_CHANGES, NULL, AT(frequency),
     "frequency of gusts"},
    {"density", SW_PARAM_NUMBER, "kg/m3", 1.2, 0, HUGE_VAL, SW_PARAM_CHANGES, NULL, AT(density),
     "density of the fluid: air; water has 1000"},
    {"normal", SW_PARAM_NUMBER, "-", 1.2, 0, HUGE_VAL, SW_PARAM_CHANGES, NULL, AT(normal),
     "drag coefficient across the wire, over its diameter; a smooth cylinder has 1.2"},
    {"tangential", SW_PARAM_NUMBER, "-", 0.02, 0, HUGE_VAL, SW_PARAM_CHANGES, NULL, AT(tangential),
     "drag coefficient along the wire, over its surface; a rough wire has 0.02"},
    {"diameter", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN | SW_PARAM_CHANGES,
     NULL, AT(diameter),
     "diameter in the wind, if it differs from the wire's, such as that of a cover"},
};
#undef AT

typedef struct stream {
  sw_vec wind;      /* now [m/s] */
  double cn, ct;    /* 1/2 rho d Cn and 1/2 rho d pi Ct [N s2/m3] */
  double rate;      /* see sw_field [1/s] */
  int force, stiff; /* what is wanted */
} stream;

/* Returns the force on half of an edge of tangent t, at a node of velocity v. Fills K, its
 * derivative by velocity: cn (|un| P + un un'/|un|) + 2 ct |ut| t t', P across t. */
static sw_vec on_half(const stream *s, sw_vec t, sw_vec v, double length, double K[9]) {
  const sw_vec u = sw_sub(s->wind, v);
  const double along = sw_dot(u, t), a[3] = {t.x, t.y, t.z};
  const sw_vec un = sw_madd(u, t, -along);
  const double across = sw_norm(un), n[3] = {un.x, un.y, un.z};
  for (int i = 0; s->stiff && i < 9; i++) {
    const double tt = a[i / 3] * a[i % 3], nn = across > 0 ? n[i / 3] * n[i % 3] / across : 0.0;
    const double P = (i % 4 == 0) - tt;
    K[i] = s->rate * length * (s->cn * (across * P + nn) + 2.0 * s->ct * fabs(along) * tt);
  }
  return sw_scale(sw_madd(sw_scale(un, s->cn * across), t, s->ct * fabs(along) * along), length);
}

/* Adds the stiffness of an extra tension C a, to damp iterations in statics. Turning a wire by one
 * radian changes the force across it by at most C = cn |u|^2 per length. Where a wire hangs by its
 * tension T alone, an iteration without this term changes a turn by up to -C a / T times itself. a
 * is the length that T bears: T over the pull along the wire per length, at most the whole wire.
 * Strings blown beyond 45 degrees from the vertical still do not settle: settle reports it, a run
 * in time gets there. */
static void hold_back(const stream *s, sw_field *f, size_t e, sw_vec t) {
  const sw_plan *p = f->plan;
  const double along = sw_dot(s->wind, t), weight = sw_dot(sw_load(f->gravity), t);
  const double pull = fabs(p->beam.mass * weight + s->ct * along * fabs(along));
  const double tension = f->tension ? fmax(f->tension[e], 0.0) : 0.0;
  const double bears = tension < pull * p->length ? tension / pull : p->length;
  const double k = s->cn * sw_norm2(s->wind) * bears * f->reciprocal[e];
  const double a[3] = {t.x, t.y, t.z};
  for (int i = 0, at = 0; i < 3; i++)
    for (int j = i; j < 3; j++, at++) f->own[at][e] += k * ((i == j) - a[i] * a[j]);
}

static sw_status eval(const void *args, sw_field *f, sw_error *err SW_UNUSED) {
  const wind_args *a = args;
  const sw_plan *p = f->plan;
  const double d = isnan(a->diameter) ? 2.0 * p->beam.radius : a->diameter;
  const double c = 0.5 * a->density * d, share = sin(2.0 * M_PI * a->frequency * f->time);
  const stream s = {sw_madd(a->velocity, a->gust, share),
                    c * a->normal,
                    c * M_PI * a->tangential,
                    f->velocity_rate,
                    0,
                    (f->want & SW_WANT_STIFFNESS) && f->velocity_rate > 0};
  double K[9];
  if (!(f->want & (SW_WANT_FORCE | SW_WANT_STIFFNESS))) return SW_OK;
  for (size_t e = 0; e + 1 < sw_axis_points(p); e++) {
    const sw_vec way = sw_sub(sw_axis_at(f, e + 1), sw_axis_at(f, e));
    const sw_vec t = sw_unit_or(way, sw_v(1, 0, 0));
    if (f->statics && !p->web && f->want & SW_WANT_STIFFNESS) hold_back(&s, f, e, t);
    const double half = 0.5 * (sw_axis_s(p, e + 1) - sw_axis_s(p, e));
    for (size_t i = e; i < e + 2; i++) {
      const sw_vec force = on_half(&s, t, sw_axis_velocity(f, i), half, K);
      sw_axis_put(f, i, force, s.stiff ? K : NULL);
    }
  }
  return SW_OK;
}

static double period(const void *args) {
  const wind_args *a = args;
  return sw_norm2(a->gust) > 0 && a->frequency > 0 ? 1.0 / a->frequency : HUGE_VAL;
}

const sw_force_class sw_force_wind = {
    .name = "wind",
    .summary = "drag of flowing air or liquid, across and along the wire, with gusts",
    .flags = SW_FORCE_DRIVEN | SW_FORCE_ANY_BODY | SW_FORCE_OF_AXIS | SW_FORCE_FROZEN,
    .params = SW_PARAMS("force wind", rows),
    .eval = eval,
    .period = period,
};
