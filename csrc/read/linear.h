/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stiffness of the built scene, and wires that are about to buckle. Of its inside. */
#ifndef SW_READ_LINEAR_H
#define SW_READ_LINEAR_H

#include "scene/scene.h"

/* The built system's stiffness at its state, with contact as it presses now: of these obstacles
 * (count), or NULL: of all. */
sw_status sw_scene_linearise(sw_scene *scene, const size_t *only, size_t count, sw_error *err);

#endif
