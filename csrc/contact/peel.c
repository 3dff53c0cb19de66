/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds where a wire lifts off, in statics. If the last touches of a row should be free, a solve
 * shows a pull at the end and a push beside it, like the couple of a clamp. Releasing only the pull
 * moves the end by one touch: a fine mesh would need one solve per node. But the wire is free up to
 * the place where its bending moment vanishes, and the forces of this solve give the moment. */
#include <math.h>
#include <stdint.h>

#include "contact/touch.h"

/* After EASY_UPDATES updates of a stage an end moves by half its last distance each time, because
 * it may alternate. After MOST_UPDATES each touch decides for itself [-]. */
enum { EASY_UPDATES = 10, MOST_UPDATES = 40 };

/* Share of a length inside the obstacle on which the wire will lie: a third if the obstacle is
 * rigid, more if it is soft [-]. */
static const double LAID = 0.4;

enum { ANY, PRESSING };

static double place(const sw_touch *t) { return (double)t->node + t->at; }

/* Returns the next touch along the wire in direction dir, at most one segment away; SIZE_MAX: the
 * row ends. */
static size_t neighbour(const sw_contact *c, size_t i, int dir, int which) {
  const sw_touch *t = &c->touches[i];
  for (size_t j = i + (size_t)dir; j < c->touch_count; j += (size_t)dir) {
    const sw_touch *u = &c->touches[j];
    const double away = (place(u) - place(t)) * dir;
    if (u->body != t->body || away > 1.0 + 1e-6) break;
    if (u->obstacle == t->obstacle && (which == ANY || u->press.active) && away > 0) return j;
  }
  return SIZE_MAX;
}

/* Force of the touch's spring, negative if it pulls [N]. */
static double borne(const sw_touch *t) { return -t->press.k * t->press.gap_after; }

/* Arc length of a touch, up to a constant [m]. */
static double arc(const sw_system *s, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  const double *along = b->plan->s;
  const size_t i = t->node - b->first_node, e = t->other - b->first_node;
  return along[i] + t->at * (along[e] - along[i]);
}

/* Free length of the wire beyond touch i: up to the next touch, a hold or the wire's end [m]. */
static double free_length(const sw_contact *c, const sw_system *s, size_t i, int outwards) {
  const sw_touch *t = &c->touches[i];
  const sw_body *b = &s->bodies[t->body];
  const sw_plan *p = b->plan;
  size_t node = t->node - b->first_node, last = outwards > 0 ? p->nodes - 1 : 0, j = i;
  while ((j += (size_t)outwards) < c->touch_count && c->touches[j].body == t->body) {
    if (!c->touches[j].press.active) continue;
    last = c->touches[j].node - b->first_node;
    break;
  }
  while (node != last && (node == t->node - b->first_node || p->held[node] == SW_FREE))
    node += (size_t)outwards;
  return fabs(p->s[node] - arc(s, t));
}

/* Releases touches from the end i of a row inwards, at most over the free length. */
static void peel(sw_contact *c, const sw_system *s, size_t i, int inwards) {
  const double share = pow(0.5, fmax(0.0, c->updates - EASY_UPDATES));
  double force = 0, moment = 0, left = share * free_length(c, s, i, -inwards);
  for (size_t next; (next = neighbour(c, i, inwards, PRESSING)) != SIZE_MAX && moment <= 0;
       i = next) {
    sw_touch *t = &c->touches[i];
    const double step = fabs(arc(s, t) - arc(s, &c->touches[next]));
    force += borne(t);
    moment += force * step;
    t->press.let_go = 1;
    t->press.normal_force = 0;
    if ((left -= step) < 0) break;
  }
}

/* Adds touches beyond the row's end i, where the couple of a clamp presses the wire in. Without the
 * couple the wire would lie there over the share LAID of the length inside the obstacle; touches
 * beyond that stay released. */
static void lay(sw_contact *c, const sw_system *s, size_t i, int outwards) {
  const size_t first = neighbour(c, i, outwards, ANY);
  size_t at = first, end = i;
  for (; at != SIZE_MAX && c->touches[at].press.gap_after < 0;
       at = neighbour(c, at, outwards, ANY)) {
    if (c->touches[at].press.active) return;
    end = at;
  }
  if (at == SIZE_MAX) return; /* the wire is inside up to its end */
  size_t k = neighbour(c, i, -outwards, PRESSING);
  for (int n = 0; k != SIZE_MAX && n < 2; n++, k = neighbour(c, k, -outwards, PRESSING))
    c->touches[k].press.spare = 1; /* its pull belongs to the couple */
  const double from = arc(s, &c->touches[i]), inside = fabs(arc(s, &c->touches[end]) - from);
  for (at = first; at != end;) {
    at = neighbour(c, at, outwards, ANY);
    if (fabs(arc(s, &c->touches[at]) - from) > LAID * inside) c->touches[at].press.let_go = 1;
  }
}

static void end_of_row(sw_contact *c, const sw_system *s, size_t i, int outwards) {
  if (!sw_press_apart(&c->touches[i].press)) {
    peel(c, s, i, -outwards);
    return;
  }
  const size_t next = neighbour(c, i, outwards, ANY);
  if (next != SIZE_MAX && !sw_press_apart(&c->touches[next].press)) lay(c, s, i, outwards);
}

/* Sets the touches that press next from the gaps of an update that is not made. */
static void take_on(sw_contact *c) {
  for (size_t i = 0; i < c->touch_count; i++) {
    sw_press *p = &c->touches[i].press;
    p->take_on = !p->active && !p->let_go && !sw_press_apart(p);
    p->let_go |= p->active && !p->spare && !sw_press_apart(p);
  }
}

void sw_contact_peel(sw_contact *c, const sw_system *s) {
  if (c->regime != SW_CONTACT_STATIC || c->updates > MOST_UPDATES) return;
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    if (!t->press.active || t->press.let_go) continue;
    if (s->bodies[t->body].plan->web) continue;
    const size_t before = neighbour(c, i, -1, PRESSING), after = neighbour(c, i, 1, PRESSING);
    if (after == SIZE_MAX && before != SIZE_MAX) end_of_row(c, s, i, 1);
    if (before == SIZE_MAX && after != SIZE_MAX) end_of_row(c, s, i, -1);
  }
  if (s->rough == SW_NOT_MADE) take_on(c);
}
