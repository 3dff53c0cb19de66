/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ties: joins of two wires that only may not be further apart than their slack, which break when
 * they are pulled harder than they bear. A broken tie stays in the system without stiffness until
 * that is made anew. */
#include <math.h>

#include "scene/world.h"
#include "system/join.h"

sw_status sw_scene_add_tie(sw_scene *s, size_t join) {
  sw_scene_join *j = &s->joins[join];
  const sw_join_spring spring = {.i = sw_scene_join_node(s, &j->ends[0]),
                                 .j = sw_scene_join_node(s, &j->ends[1]),
                                 .k = j->broken ? 0.0 : j->stiffness,
                                 .tie = 1,
                                 .slack = j->slack};
  SW_TRY(sw_system_add_spring(&s->system, &spring));
  j->spring = s->system.joins->spring_count - 1;
  return SW_OK;
}

/* A tie is to break when it is pulled by no more than this above its strength [-]. */
static const double CLOSE = 0.01;

/* Pull of a tie to a point with nodes at x, and what it bears, 0 once it is broken. A body's own
 * field may still name the places of a trial that is gone [N]. */
static double pull_of(const sw_body *b, const sw_term *term, const double *x, double *bears) {
  sw_field at = b->field;
  at.x = x + 3 * b->first_node;
  return term->cls->pull(term->args, &at, term->history, bears);
}

static sw_status check_terms(const sw_body *b, const double *x, sw_error *err) {
  for (size_t k = 0; k < b->term_count; k++) {
    const sw_term *term = &b->terms[k];
    if (!term->cls->pull) continue;
    double bears;
    const double pull = pull_of(b, term, x, &bears);
    if (bears > 0 && pull > (1.0 + CLOSE) * bears)
      return sw_fail(err, SW_ENOCONV, "a tie breaks within the step");
  }
  return SW_OK;
}

int sw_scene_may_break(const sw_scene *s) {
  for (size_t k = 0; k < s->join_count; k++) {
    const sw_scene_join *j = &s->joins[k];
    if (j->alive && isfinite(j->slack) && isfinite(j->strength) && !j->broken) return 1;
  }
  for (size_t b = 0; s->force_count && b < s->system.body_count; b++) {
    const sw_body *body = &s->system.bodies[b];
    for (size_t k = 0; k < body->term_count; k++) {
      const sw_term *term = &body->terms[k];
      double bears = 0;
      if (term->cls->pull) pull_of(body, term, s->system.x, &bears);
      if (bears > 0) return 1;
    }
  }
  return 0;
}

sw_status sw_scene_check_ties(const sw_scene *s, const double *x, sw_error *err) {
  for (size_t k = 0; k < s->join_count; k++) {
    const sw_scene_join *j = &s->joins[k];
    if (!j->alive || isnan(j->slack) || j->broken) continue;
    const sw_join_spring *p = &s->system.joins->springs[j->spring];
    if (sw_norm(sw_join_spring_force(p, x)) > (1.0 + CLOSE) * j->strength)
      return sw_fail(err, SW_ENOCONV, "tie '%s' breaks within the step", j->name);
  }
  for (size_t b = 0; s->force_count && b < s->system.body_count; b++)
    SW_TRY(check_terms(&s->system.bodies[b], x, err));
  return SW_OK;
}

/* Ties to points, which break when their force is told of the accepted state. */
static void tell_of_terms(sw_scene *s, size_t body) {
  const sw_body *b = &s->system.bodies[body];
  for (size_t k = 0; k < b->term_count; k++) {
    const sw_term *term = &b->terms[k];
    double bears;
    if (!term->cls->pull) continue;
    const double pull = pull_of(b, term, s->system.x, &bears);
    if (bears > 0 && pull > bears)
      sw_scene_tell(s, "tie", s->wires[body].name, NAN, pull,
                    "a tie of wire '%s' breaks at %.4g N; it bears %.4g N", s->wires[body].name,
                    pull, bears);
  }
}

void sw_scene_watch_ties(sw_scene *s) {
  for (size_t b = 0; s->force_count && b < s->system.body_count; b++) tell_of_terms(s, b);
  for (size_t k = 0; k < s->join_count; k++) {
    sw_scene_join *j = &s->joins[k];
    if (!j->alive || isnan(j->slack) || j->broken) continue;
    sw_join_spring *p = &s->system.joins->springs[j->spring];
    const double pull = sw_norm(sw_join_spring_force(p, s->system.x));
    j->peak = fmax(j->peak, pull);
    if (!(pull > j->strength)) continue;
    j->broken = 1, j->broken_time = s->time, j->broken_force = pull;
    p->k = 0;
    s->discontinuous = 1;
    s->build = ++s->builds; /* the system is another one */
    sw_scene_tell(s, "tie", j->name, NAN, pull, "tie '%s' breaks at %.4g N; it bears %.4g N",
                  j->name, pull, j->strength);
  }
}

sw_status sw_scene_tie_state(sw_scene *s, sw_handle h, sw_tie_state *out, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_TRY(sw_scene_editable(s, err));
  const sw_scene_join *j = sw_scene_find_join(s, h, err);
  if (!j) return SW_EDEAD;
  if (isnan(j->slack))
    return sw_fail(err, SW_EINVAL, "join '%s' is no tie: it was made without slack", j->name);
  *out = (sw_tie_state){.peak = j->peak,
                        .broken = j->broken,
                        .broken_time = j->broken_time,
                        .broken_force = j->broken_force};
  SW_TRY(sw_scene_build(s, err));
  const double *x = s->system.x;
  const uint32_t one = sw_scene_join_node(s, &j->ends[0]), two = sw_scene_join_node(s, &j->ends[1]);
  out->distance = sw_dist(sw_vec_at(x, one), sw_vec_at(x, two));
  if (j->alive)
    out->tension = sw_norm(sw_join_spring_force(&s->system.joins->springs[j->spring], x));
  return SW_OK;
}
