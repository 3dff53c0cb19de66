/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and writes this room's structs on a tape. Reading fills an empty struct, which the caller
 * frees even after a failure. Numbers in it that refer to other things are checked to be within the
 * arrays. */
#ifndef SW_STATE_STATE_TAPE_H
#define SW_STATE_STATE_TAPE_H

#include "base/tape.h"
#include "state/mesh.h"
#include "state/plan.h"
#include "state/web.h"

void sw_tape_beam(sw_tape *tape, sw_beam *beam);
/* alone: no system holds the motion and turns of its nodes, so the mesh's own are taped. */
void sw_tape_mesh(sw_tape *tape, sw_mesh *mesh, int alone);
void sw_tape_mesh_frame(sw_tape *tape, sw_mesh_frame *frame);
/* When reading, *web must be NULL; it gets one reference. shape_size: size of one of its shapes
 * [B]. */
void sw_tape_web(sw_tape *tape, sw_web **web, size_t shape_size);
/* own: the wire's present web, which most plans share. */
void sw_tape_plan(sw_tape *tape, sw_plan **plan, sw_web *own, size_t shape_size);

#endif
