/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solid model of any convex section: small cubes with a particle at each corner or centre. Its
 * springs are calibrated to the wire (room calibrate). */
#include "wire/wire.h"

const sw_wire_class sw_wire_cubic = {
    .name = "cubic",
    .summary = "particles in small cubes: any convex section, circle, annulus or rectangle",
    .recipe = sw_web_recipe,
    .mesh = "cubic",
};
