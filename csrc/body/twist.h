/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Twist of wires without material frames, kept from one system to the next. */
#ifndef SW_BODY_TWIST_H
#define SW_BODY_TWIST_H

#include "scene/scene.h"

/* Before the system goes: keeps twist by stretches of wire, and the turns of holds. SW_ENOMEM. */
sw_status sw_scene_keep_twist(sw_scene *scene);
/* Gives the spans of a new system the twist of the stretches that they cover. */
void sw_scene_inherit_twist(sw_scene *scene);

#endif
