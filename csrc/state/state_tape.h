/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Structs of this room on a tape. Reading fills an empty struct, which the caller frees also
 * after a failure; numbers in it that name other things are checked to be inside of the arrays. */
#ifndef SW_STATE_STATE_TAPE_H
#define SW_STATE_STATE_TAPE_H

#include "base/tape.h"
#include "state/mesh.h"
#include "state/plan.h"
#include "state/web.h"

void sw_tape_beam(sw_tape *tape, sw_beam *beam);
/* alone: no system knows how its nodes move and turn, so that it says so itself. */
void sw_tape_mesh(sw_tape *tape, sw_mesh *mesh, int alone);
void sw_tape_mesh_frame(sw_tape *tape, sw_mesh_frame *frame);
/* *web NULL when reading; of one reference then. shape_size: of one of its shapes [B]. */
void sw_tape_web(sw_tape *tape, sw_web **web, size_t shape_size);
/* own: the wire's web as it is now, which most plans share. */
void sw_tape_plan(sw_tape *tape, sw_plan **plan, sw_web *own, size_t shape_size);

#endif
