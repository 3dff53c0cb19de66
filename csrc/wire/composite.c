/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An electric cable: a tube of rings as shell around one core or several, each a line, layers or
 * voxels of particles. Its springs are calibrated to the wire (room calibrate). */
#include "wire/wire.h"

const sw_wire_class sw_wire_composite = {
    .name = "composite",
    .summary = "a shell of rings around one core or several: cables of sheath and conductors",
    .recipe = sw_web_recipe,
    .mesh = "composite",
};
