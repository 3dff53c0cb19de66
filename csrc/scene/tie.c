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

void sw_scene_watch_ties(sw_scene *s) {
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
