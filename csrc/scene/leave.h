/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies that were taken away, on a tape. */
#ifndef SW_SCENE_LEAVE_H
#define SW_SCENE_LEAVE_H

#include "base/tape.h"
#include "scene/parts.h"

void sw_tape_gone(sw_tape *tape, sw_gone *gone);
void sw_tape_check_numbers(sw_tape *tape, const sw_scene *scene);

#endif
