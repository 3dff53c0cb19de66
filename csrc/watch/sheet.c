/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports what comes to the back of an open mesh (a sheet) and passes through it. Mostly the
 * triangles face the wrong way. */
#include "body/body.h"
#include "contact/behind.h"
#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/observe.h"

void sw_scene_watch_sheets(sw_scene *s, size_t wire) {
  sw_contact *contact = sw_scene_contact(s);
  if (!contact) return;
  const sw_behind at = sw_contact_behind(contact, sw_scene_system(s), wire);
  if (!at.found || at.obstacle < 0 || (size_t)at.obstacle >= sw_scene_obstacle_slots(s)) return;
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  sw_scene_tell(s, "sheet", w->name, at.place, at.depth,
                "wire '%s' passes through the open mesh '%s' from its back at s = %.4g m: only the "
                "side is solid from which the corners of its triangles run anticlockwise. Reverse "
                "them, or give the sheet a thickness",
                w->name, sw_scene_obstacle_in(s, (size_t)at.obstacle)->name, at.place);
}
