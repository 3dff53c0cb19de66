/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines that get other edges or become lines of another model: the part of the axial force in the
 * springs of their edges. The rest is in bending forces (system/borne.h). */
#ifndef SW_REMODEL_BORNE_H
#define SW_REMODEL_BORNE_H

#include "scene/parts.h"
#include "state/mesh.h"

/* Axial forces beside those of the springs of a line that is about to change. */
typedef struct sw_borne {
  sw_mesh at;    /* its arc lengths only; n 0: no force bears any [m] */
  double *force; /* (edges) [N] */
} sw_borne;

/* Reads them off a built wire; none of a mesh of particles. SW_ENOMEM. */
sw_status sw_borne_read(sw_scene *scene, size_t wire, sw_borne *out);
void sw_borne_free(sw_borne *borne);

/* The wire is another line now. The springs of its edges take the old line's forces of
 * system/borne.h, less its own ones: the whole axial force stays. Edges get lengths for these
 * forces, and keep their bends. The scene is built, and is built again. */
sw_status sw_borne_exchange(sw_scene *scene, size_t wire, const sw_borne *old, sw_error *err);

/* Makes the mesh of a line that stays one: strains of its edges stay, too, on either side of holds.
 * to: has the places, which are as near to those of holds as rounding. SW_ENOMEM. */
sw_status sw_line_carry(const sw_scene *scene, size_t wire, sw_mesh *to);

#endif
