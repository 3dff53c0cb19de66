/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solid model of round wires: layers and sectors of particles around a central line. Its
 * springs are calibrated to the wire (room calibrate). */
#include "wire/wire.h"

const sw_wire_class sw_wire_radial = {
    .name = "radial",
    .summary = "layers of particles around a line: also squeezing of a solid section",
    .recipe = sw_web_recipe,
    .mesh = "radial",
};
