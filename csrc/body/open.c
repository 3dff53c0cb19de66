/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opens wires for reading: builds the scene and refreshes its state. */

#include "body/build.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"

/* places = 1: forces that have been added need not be built in. */
static sw_status prepare(sw_scene *s, sw_handle h, int places, sw_scene_wire **body,
                         sw_error *err) {
  sw_system *system = sw_scene_system(s);
  SW_TRY(sw_scene_readable(s, err));
  *body = sw_scene_find_body(s, h, err);
  if (!*body) return SW_EDEAD;
  SW_TRY(sw_scene_still(s, err));
  if (!places || !sw_scene_is_placed(s)) SW_TRY(sw_scene_build(s, err));
  SW_TRY(sw_system_place_holds(system, sw_scene_time(s), NULL, NULL, NULL, err));
  sw_system_refresh(system);
  return SW_OK;
}

sw_status sw_scene_open_body(sw_scene *s, sw_handle h, sw_scene_wire **body, sw_error *err) {
  return prepare(s, h, 0, body, err);
}

sw_status sw_scene_open_places(sw_scene *s, sw_handle h, sw_scene_wire **wire, sw_error *err) {
  if (!sw_scene_find_wire(s, h, err)) return SW_EDEAD;
  return prepare(s, h, 1, wire, err);
}

/* The same for wires only. */
sw_status sw_scene_open_wire(sw_scene *s, sw_handle h, sw_scene_wire **wire, sw_error *err) {
  if (!sw_scene_find_wire(s, h, err)) return SW_EDEAD;
  return sw_scene_open_body(s, h, wire, err);
}

sw_status sw_scene_check_place(const sw_scene_wire *w, double place, sw_error *err) {
  const double length = w->mesh.s[w->mesh.n - 1] - w->mesh.s[0];
  if (place >= 0 && place <= length * (1 + 1e-12)) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "wire '%s': s = %.6g m is not on the wire; it must be in [0, %.6g] m", w->name,
                 place, length);
}

static const double LIGHT = 299792458.0; /* speed of light in vacuum [m/s] */

sw_status sw_scene_check_speed(const sw_scene *s, const sw_scene_wire *w, double speed,
                               sw_error *err) {
  if (speed <= LIGHT) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "'%s' of scene '%s': set_velocity: a speed of %.6g m/s is not allowed; it must be "
                 "at most %.9g m/s, that of light",
                 w->name, sw_scene_name(s), speed, LIGHT);
}
