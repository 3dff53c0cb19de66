/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Balance of a wire when it changes between a mesh and a rod.
 *
 * A rod and a mesh do not lie quite alike under the same forces. So the new model is shifted, by
 * micrometres, to where it is in balance with the inertia of the old one. Otherwise it would begin
 * to swing, and the gripper would feel the swinging. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "remodel/exchange.h"
#include "remodel/remodel.h"
#include "save/life.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"

enum { MOST_POSES = 200 };           /* iterations; if they fail the wire stays as it lies [-] */
static const double BALANCED = 1e-8; /* largest shift that ends them, over the wire's length [-] */

/* Adds the forces that velocities cause. work: (2 x freedoms). */
static sw_status add_friction_of_motion(sw_scene *s, double *force, double *work, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  const size_t n = 3 * system->nodes;
  double *still = work, *a = work + system->freedoms;
  const sw_coupling coupling = system->coupling;
  memset(still, 0, system->freedoms * sizeof *still);
  system->coupling.eval = NULL; /* contact forces do not depend on velocities here */
  sw_status status = sw_system_acceleration(system, sw_scene_time(s), system->x, system->v, a, err);
  for (size_t i = 0; i < n && status == SW_OK; i++) force[i] += system->delta[i];
  if (status == SW_OK)
    status = sw_system_acceleration(system, sw_scene_time(s), system->x, still, a, err);
  for (size_t i = 0; i < n && status == SW_OK; i++) force[i] -= system->delta[i];
  system->coupling = coupling;
  return status;
}

sw_status sw_frozen_balance(sw_scene *s, size_t wire, const double *rings, size_t count,
                            sw_balance *balance) {
  sw_system *system = sw_scene_system(s);
  const size_t n = system->freedoms;
  const sw_body *b = &system->bodies[wire];
  const sw_web *web = b->plan->web;
  sw_error ignored = {""};
  double *dead SW_LOCAL = sw_alloc(5 * n, sizeof *dead);
  if (!dead) return SW_ENOMEM;
  double *v = dead + n, *a = dead + 2 * n;
  memcpy(v, system->v, n * sizeof *v);
  memcpy(a, system->a, n * sizeof *a);
  const int alike = count == (web ? web->rings : b->plan->nodes); /* no nodes were added */
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const size_t r = web ? sw_web_ring_of(web, i) : i;
    sw_store(a + 3 * (b->first_node + i), alike ? sw_vec_at(rings, r) : sw_v(0, 0, 0));
  }
  sw_inertia_of(system, a, dead);
  if (add_friction_of_motion(s, dead, dead + 3 * n, &ignored) != SW_OK) return SW_OK;
  system->dead = dead;
  const sw_status status = balance(s, BALANCED, MOST_POSES, &ignored);
  system->dead = NULL;
  memcpy(system->v, v, n * sizeof *v);
  memcpy(system->a, a, n * sizeof *a);
  if (status == SW_ENOCONV)
    sw_scene_tell(s, "unbalanced", sw_scene_wire_in(s, wire)->name, NAN, NAN,
                  "the change between pads and a rigid grip leaves wire '%s' out of balance: "
                  "forces just after the change may be too large",
                  sw_scene_wire_in(s, wire)->name);
  return status == SW_ENOMEM || status == SW_ECALLBACK || status == SW_EINTR ? status : SW_OK;
}

/* Returns the accelerations of a wire's rings or nodes (count x 3), to be freed. NULL: no
 * memory. */
static double *accelerations(const sw_scene *s, size_t wire, size_t *count) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const sw_web *web = b->plan->web;
  const double *a = system->a + 3 * b->first_node;
  *count = web ? web->rings : b->plan->nodes;
  double *out = sw_alloc(3 * *count, sizeof *out);
  for (size_t r = 0; out && r < *count; r++) {
    if (web)
      sw_web_middle(web, a, r, out + 3 * r);
    else
      sw_store(out + 3 * r, sw_vec_at(a, r));
  }
  return out;
}

sw_status sw_frozen_exchange(sw_scene *s, const sw_exchange *x, sw_freeze_report *out,
                             sw_error *err) {
  sw_snapshot *before = NULL;
  sw_error ignored;
  size_t count = 0;
  SW_TRY(sw_scene_snapshot(s, &before, err));
  double *a = accelerations(s, x->wire, &count);
  const sw_status status = a ? x->change(s, x, a, count, out, err) : SW_ENOMEM;
  sw_free(a);
  if (status == SW_OK)
    sw_course_go_on(sw_scene_course(s));
  else
    sw_scene_restore(s, before, &ignored);
  sw_snapshot_free(before);
  return status;
}
