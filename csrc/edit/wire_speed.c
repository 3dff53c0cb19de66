/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives a line the velocity with which it came to its place. */
#include "body/build.h"
#include "edit/wires.h"
#include "scene/course.h"
#include "scene/parts.h"

sw_status sw_scene_wire_came_from(sw_scene *s, sw_handle h, const double *before, size_t count,
                                  double span, sw_error *err) {
  sw_scene_wire *w;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_open_body(s, h, &w, err));
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[h.slot];
  if (b->plan->nodes != count || b->plan->web)
    return sw_fail(err, SW_EINVAL, "wire '%s' does not have %zu nodes in a line", w->name, count);
  const double *x = system->x + 3 * b->first_node;
  for (size_t i = 0; i < count; i++)
    SW_TRY(sw_scene_check_speed(s, w, sw_dist(sw_vec_at(x, i), sw_vec_at(before, i)) / span, err));
  for (size_t i = 0; i < count; i++) {
    const sw_vec v = sw_scale(sw_sub(sw_vec_at(x, i), sw_vec_at(before, i)), 1 / span);
    if (b->plan->held[i] == SW_FREE) sw_store(system->v + 3 * (b->first_node + i), v);
  }
  sw_course_jump(sw_scene_course(s));
  return SW_OK;
}
