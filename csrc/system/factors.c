/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decides if a solve takes old factors, and checks its error. */
#include "system/factors.h"

#include <math.h>
#include <string.h>

#include "base/each.h"
#include "system/bridge.h"
#include "system/web.h"

/* Factors are used again while no edge has changed by more than this share of its length [-], and
 * for at most MOST_SOLVES solves in a row in a stage. */
static const double SERVES = 0.02;
enum { MOST_SOLVES = 3 };

/* A Newton step leaves an error of about half the square of the edges' change. Solves with old
 * factors may leave half of that, estimated from the last two solves, or a change too small to
 * cause any force [-]. Their convergence is not known in advance: a turn of a stiff part acts on a
 * soft one, multiplied by the ratio of stiffnesses. */
static const double GOOD = 0.25, NOTHING = 1e-8;
static const double SLOW = 0.3; /* a slower decrease of the change ends their use [-] */

/* 1 if the stiffness has no jumps: all of it is of elements and of terms that take power from the
 * motion. */
static int is_smooth(const sw_body *b) {
  const sw_web *w = b->plan->web;
  if (!w || !w->solids || w->links || w->folds || w->creases || w->slides || b->web_room) return 0;
  if (b->is_explicit || b->is_kinked) return 0;
  for (size_t k = 0; k < b->term_count; k++) {
    const int flags = b->terms[k].cls->flags;
    if (!(flags & (SW_FORCE_INNER | SW_FORCE_DISSIPATIVE)) || flags & SW_FORCE_FROZEN) return 0;
  }
  return 1;
}

static int may_serve(const sw_system *s, const sw_newton *newton) {
  if (newton->statics || s->joins || sw_bridges_any(s)) return 0;
  for (size_t b = 0; b < s->body_count; b++)
    if (!is_smooth(&s->bodies[b])) return 0;
  return 1;
}

size_t sw_factors_room(const sw_system *s) {
  for (size_t b = 0; b < s->body_count; b++)
    if (!s->bodies[b].plan->web || !s->bodies[b].plan->web->solids) return 0;
  return s->freedoms;
}

void sw_factors_keep(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                     const sw_stage_report *report) {
  s->factor_hbar = 0;
  if (report->negative || !may_serve(s, newton)) return;
  s->factor_hbar = stage->hbar;
  memcpy(s->factor_at, stage->y, 3 * s->nodes * sizeof *s->factor_at);
}

/* Returns the largest relative change of an edge by the move to - from. */
static double change(const sw_system *s, const double *from, const double *to) {
  double largest = 0;
  SW_ITEMS(const sw_body, body, s->bodies, s->body_count) {
    const size_t at = 3 * body->first_node;
    const double own = sw_web_change(body, s->x + at, from ? from + at : NULL, to + at);
    if (!(own <= largest)) largest = own;
  }
  return largest;
}

sw_status sw_factors_serve(sw_system *s, const sw_stage *stage, const sw_newton *newton,
                           const sw_stage_report *report, int *out, sw_error *err) {
  const sw_coupling *c = &s->coupling;
  *out = 0;
  if (report->iterations == 1) s->factor_solves = 0;
  if (!(s->factor_hbar > 0) || s->factor_solves == MOST_SOLVES) return SW_OK;
  if (s->factor_solves != report->iterations - 1 || !may_serve(s, newton)) return SW_OK;
  if (fabs(s->factor_hbar - stage->hbar) > 1e-9 * stage->hbar) return SW_OK;
  if (!(change(s, s->factor_at, stage->y) <= SERVES)) return SW_OK;
  if (!c->eval) *out = 1;
  if (c->eval && c->keeps) SW_TRY(c->keeps(c->user, s, stage->y, out, err));
  s->factor_solves += *out;
  return SW_OK;
}

int sw_factors_stale(sw_system *s, const sw_stage_report *report) {
  if (s->factor_solves != report->iterations) return 0;
  const double before = s->factor_update, size = change(s, NULL, s->delta);
  s->factor_update = size;
  if (report->iterations == 1) {
    s->factor_first = size;
    return size > NOTHING;
  }
  if (!(size <= SLOW * before)) s->factor_solves = MOST_SOLVES;
  return size * size > before * fmax(GOOD * s->factor_first * s->factor_first, NOTHING);
}
