/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks that no node of a wire and no particle of a mesh is held by two holds, and that the wire
 * between two holds can be meshed. */
#include <math.h>

#include "body/body.h"
#include "body/hold.h"
#include "link/hold.h"
#include "scene/parts.h"
#include "scene/wire.h"

static const double SAME_PLACE = 1e-9; /* of the wire's length, for rounding [-] */

static sw_status say_held(const sw_scene_wire *w, const sw_hold *by, const char *what,
                          sw_error *err) {
  const double start = w->mesh.s[0];
  return sw_fail(err, SW_EINVAL,
                 "%s: wire '%s' is already held by '%s' between s = %.6g and %.6g m", what, w->name,
                 by->name, by->s1 - start, by->s2 - start);
}

sw_status sw_scene_check_clear(const sw_scene *s, size_t wire, const sw_hold *self,
                               const char *what, double s1, double s2, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double start = w->mesh.s[0], length = w->mesh.s[w->mesh.n - 1] - start;
  const double apart = sw_body_class_of(w)->apart;
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != wire || h == self) continue;
    const double between = fmax(s1 - h->s2, h->s1 - s2);
    if (!(between > SAME_PLACE * length)) return say_held(w, h, what, err);
    if (between < apart * length)
      return sw_fail(err, SW_EINVAL,
                     "%s: at s = %.9g m wire '%s' is only %.2g m away from the place that '%s' "
                     "holds; it must be %.2g m or more",
                     what, s1 - start, w->name, between, h->name, apart * length);
  }
  return SW_OK;
}

sw_status sw_scene_held_twice(const sw_scene *s, const sw_hold *a, const sw_hold *b,
                              sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, a->wire);
  const double start = w->mesh.s[0];
  return sw_fail(err, SW_EINVAL,
                 "wire '%s': '%s' (s = %.6g to %.6g m) and '%s' (s = %.6g to %.6g m) hold the same "
                 "%s; release one of them, or hold places that are further apart",
                 w->name, a->name, a->s1 - start, a->s2 - start, b->name, b->s1 - start,
                 b->s2 - start, sw_body_class_of(w)->held);
}

sw_status sw_scene_check_holds(const sw_scene *s, sw_error *err) {
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++)
    SW_TRY(sw_body_class_of(sw_scene_wire_in(s, w))->check_holds(s, w, err));
  return SW_OK;
}
