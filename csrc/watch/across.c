/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How fast the bend of a wire grows to the side under a push, and whether friction holds it. A real
 * wire has a bend of a thousandth of its length; friction of its touches holds it until the push on
 * this bend is larger. A bend that grew before the touch is larger, and is held by less. */
#include "watch/across.h"

#include <math.h>

#include "contact/contact.h"
#include "contact/trough.h"
#include "system/axis.h"

/* Bend of a real wire over its length [-]. */
static const double CROOKED = 1e-3;
/* Length of an arch as sin^2, over the square of its sum over the sum of its squares [-]. */
static const double ARCH = 1.5;
/* Largest growth that friction meets, as its logarithm: the bend is a tenth of the wire's length
 * [-]. */
static const double MOST_GROWTH = 4.6;

/* A touch of a piece of a wire. */
typedef struct touch {
  size_t edge; /* or slice, counted from the wire's start */
  sw_contact_push push;
} touch;

static int touch_of(const sw_scene *s, const sw_body *b, size_t k, touch *out) {
  if (!sw_contact_push_at(sw_scene_contact(s), sw_scene_system(s), k, &out->push)) return 0;
  out->edge = sw_axis_of(b, out->push.node - b->first_node);
  return 1;
}

/* Touches from edge or slice `from` to before `to`. */
static void touches_of(const sw_scene *s, const sw_body *b, size_t from, size_t to, size_t *first,
                       size_t *end) {
  const size_t last = sw_axis_edges(b) + 1;
  sw_contact_touches_of(sw_scene_contact(s), b->first_node + sw_axis_first(b, from),
                        b->first_node + sw_axis_first(b, to < last ? to : last), first, end);
}

static int faces(const sw_scene *s, const sw_body *b, const touch *one, size_t k) {
  touch other;
  return touch_of(s, b, k, &other) && sw_dot(one->push.normal, other.push.normal) < SW_FACING;
}

/* 1 if touch k and another one at the same place press the wire from two sides, as jaws do. */
static int is_between(const sw_scene *s, const sw_body *b, size_t k) {
  size_t first, end;
  touch one;
  if (!touch_of(s, b, k, &one)) return 0;
  touches_of(s, b, one.edge - (one.edge > 0), one.edge + 2, &first, &end);
  for (size_t i = first; i < end; i++)
    if (faces(s, b, &one, i)) return 1;
  return 0;
}

/* Keeps the longest part of a piece that jaws leave free. Returns the friction that holds it, per
 * length [N/m]. */
static double friction_on(const sw_scene *s, const sw_body *b, sw_pushed *piece) {
  size_t first, end, from = piece->from, best = from, most = 0;
  double sum = 0;
  if (!sw_scene_contact(s)) return 0;
  touches_of(s, b, piece->from, piece->to, &first, &end);
  for (size_t k = first; k <= end; k++) {
    touch t = {.edge = piece->to};
    if (k < end && (!is_between(s, b, k) || !touch_of(s, b, k, &t))) continue;
    if (t.edge > from && t.edge - from > most) best = from, most = t.edge - from;
    from = t.edge + 1;
  }
  for (size_t k = first; k < end; k++) {
    touch t;
    if (touch_of(s, b, k, &t) && t.edge >= best && t.edge < best + most)
      sum += t.push.friction * t.push.normal_force;
  }
  piece->length = 0, piece->from = best, piece->to = best + most, piece->edge = best + most / 2;
  for (size_t e = best; e < best + most; e++) piece->length += sw_axis_rest(b, e);
  return most ? sum / piece->length : 0;
}

/* Bent by a = L/1000 as a/2 (1 - cos(k x)), k = 2 pi/L, a real wire is pushed to the side by (P -
 * EI k^2) k^2 a/2 in its middle. Cables whose rest shape has this bend buckled under 1 to 0.7 times
 * the P of this formula (spec/scene/borne_spec). What grew before friction held it pushes more. */
int sw_bend_grows(const sw_body *b, const sw_bend *bend, double growth) {
  const double EI = b->plan->beam.EI, k = 2 * M_PI / bend->piece.length;
  const double aside = CROOKED * bend->piece.length * exp(fmin(growth, MOST_GROWTH));
  return 0.5 * (bend->piece.push - EI * k * k) * k * k * aside > bend->friction;
}

void sw_scene_bend_of(const sw_scene *s, const sw_body *b, sw_bend *out) {
  const sw_system *system = sw_scene_system(s);
  *out = (sw_bend){.rate = 0};
  if (b->waits || !(b->plan->beam.EI > 0)) return;
  if (!(sw_pushed_rate(system, b, system->x, 0, &out->piece) > 0)) return;
  out->friction = friction_on(s, b, &out->piece);
  if (out->piece.length > 0) out->rate = sw_pushed_rate_of(&b->plan->beam, 0, &out->piece);
}

/* What draws a piece of a wire back to the floor of a trough. */
typedef struct trough {
  double support; /* force over shift, per length [N/m2] */
  double open;    /* longest part without it [m] */
} trough;

static trough trough_of(const sw_scene *s, const sw_body *b, const sw_pushed *piece) {
  const sw_contact *contact = sw_scene_contact(s);
  const double aside = CROOKED * piece->length, to = sw_axis_arc(b, piece->to);
  double from = sw_axis_arc(b, piece->from);
  trough out = {0};
  size_t first = 0, end = 0;
  if (contact) touches_of(s, b, piece->from, piece->to, &first, &end);
  for (size_t k = first; k < end; k++) {
    const double hollow = sw_contact_trough(contact, sw_scene_system(s), b, k, aside);
    touch t;
    if (!(hollow > 0) || !touch_of(s, b, k, &t)) continue;
    out.support += hollow * t.push.normal_force / piece->length;
    out.open = fmax(out.open, t.push.place - from), from = fmax(from, t.push.place);
  }
  out.open = fmax(out.open, to - from);
  return out;
}

/* With a support K per length the smallest push that buckles a long wire is 2 sqrt(EI K): Dawson
 * and Paslay's in a tube. A part that lies elsewhere buckles as if it were clamped. */
double sw_bend_rate_in_trough(const sw_scene *s, const sw_body *b, const sw_bend *bend) {
  const trough at = trough_of(s, b, &bend->piece);
  const sw_beam *beam = &b->plan->beam;
  sw_pushed open = bend->piece;
  if (!(at.support > 0)) return bend->rate;
  open.length = at.open;
  const double rate2 = bend->rate * bend->rate - at.support / beam->mass;
  return fmax(sqrt(fmax(0.0, rate2)), open.length > 0 ? sw_pushed_rate_of(beam, 0, &open) : 0.0);
}

/* A motion as arrows at the nodes. */
typedef struct arrows {
  const double *x;
  size_t width;
} arrows;

static sw_vec arrow(const arrows *m, size_t node) { return sw_load(m->x + node * m->width); }

/* Motion at a touch, along the obstacle's surface. */
static sw_vec way_at(const arrows *m, const sw_body *b, const sw_contact_push *p) {
  const sw_vec from = arrow(m, p->node - b->first_node), to = arrow(m, p->other - b->first_node);
  const sw_vec way = sw_madd(from, sw_sub(to, from), p->at);
  return sw_madd(way, p->normal, -sw_dot(way, p->normal));
}

/* Work of friction over the motion [N/sqrt(kg)]. */
static double rubbed_by(const sw_scene *s, const sw_body *b, const arrows *m) {
  const sw_contact *contact = sw_scene_contact(s);
  size_t first, end;
  double sum = 0;
  if (!contact) return 0;
  sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &first, &end);
  for (size_t k = first; k < end; k++) {
    sw_contact_push p;
    if (!sw_contact_push_at(contact, sw_scene_system(s), k, &p)) continue;
    sum += p.friction * p.normal_force * sw_norm(way_at(m, b, &p));
  }
  return sum;
}

/* Hardly ever computed: for motions of wires in a plane that are pushed harder than before. */
double sw_scene_drawn_back(const sw_scene *s, size_t w, const sw_modes *modes, size_t k) {
  const sw_contact *contact = sw_scene_contact(s);
  const sw_body *b = &sw_scene_system(s)->bodies[w];
  const arrows m = {modes->shapes + k * modes->unknowns, modes->unknowns / b->plan->nodes};
  size_t first, end;
  double sum = 0;
  if (!contact) return 0;
  sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &first, &end);
  for (size_t i = first; i < end; i++) {
    sw_contact_push p;
    if (!sw_contact_push_at(contact, sw_scene_system(s), i, &p)) continue;
    const sw_vec way = way_at(&m, b, &p);
    const double aside = CROOKED * b->plan->length;
    const double hollow = sw_contact_trough(contact, sw_scene_system(s), b, i, aside);
    sum += hollow * p.normal_force * sw_norm2(way);
  }
  return sum;
}

/* In a motion x of unit mass that grows at the rate r, a bend of the same shape with the height a
 * pushes with r^2 a/|x|, |x| the largest shift. Friction holds with the sum of mu N x. */
int sw_scene_overcomes(const sw_scene *s, size_t w, const sw_modes *modes, size_t k,
                       double growth) {
  const sw_body *b = &sw_scene_system(s)->bodies[w];
  const size_t nodes = b->plan->nodes;
  const arrows m = {modes->shapes + k * modes->unknowns, modes->unknowns / nodes};
  double most = 0, sum = 0, squares = 0;
  for (size_t i = 0; i < nodes; i++) {
    const double ds = b->plan->s[i + 1 < nodes ? i + 1 : i] - b->plan->s[i ? i - 1 : i];
    const double x = sw_norm(arrow(&m, i));
    most = fmax(most, x), sum += 0.5 * ds * x, squares += 0.5 * ds * x * x;
  }
  if (!(squares > 0)) return 0;
  const double length = ARCH * sum * sum / squares; /* of the part that moves */
  const double aside = CROOKED * length * exp(fmin(growth, MOST_GROWTH));
  return -modes->omega2[k] * aside / most > rubbed_by(s, b, &m);
}
