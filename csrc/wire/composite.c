/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An electric cable: a tube of rings as shell around one core or several, each a line, layers or
 * voxels of particles. Its springs are calibrated to the wire (room calibrate). With bonded = false
 * the parts slide on each other along the wire (force slide): friction times the pressure between
 * them, which is `grip`, of each core and per length, and what bending and squeezing press. They do
 * not part: bodies with a gap keep it. Particles keep those that they faced when the wire was
 * drawn, and a core that is drawn out of the shell goes on being gripped by it. Of solid elements
 * it is one core bonded to the shell, in one mesh, each with a material of its own. */
#include "wire/wire.h"

const sw_wire_class sw_wire_composite = {
    .name = "composite",
    .summary = "a shell of rings around one core or several: cables of sheath and conductors",
    .recipe = sw_web_recipe,
    .mesh = "composite",
};
