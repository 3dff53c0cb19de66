/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An electric cable: a tube of rings as shell around one or several cores, each core a line, layers
 * or voxels of particles. Its springs are calibrated to the wire (room calibrate). With bonded =
 * false the parts slide on each other along the wire (force slide) with friction times the pressure
 * between them: `grip` (of each core, per length) plus the pressure from bending and squeezing. The
 * parts do not separate, and a gap that is drawn stays. Particles keep their facing particles from
 * the drawn state; a core drawn out of the shell is still gripped by it. With solid elements there
 * is one core bonded to the shell, in one mesh, each with its own material. */
#include "wire/wire.h"

const sw_wire_class sw_wire_composite = {
    .name = "composite",
    .summary = "a shell of rings around one core or several: cables of sheath and conductors",
    .recipe = sw_web_recipe,
    .mesh = "composite",
};
