/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The surface-like model: rings of particles along the wire, and a central line of particles that
 * carries the part of EA that the rings do not. Its springs are calibrated to the wire (room
 * calibrate). */
#include "wire/wire.h"

const sw_wire_class sw_wire_tube = {
    .name = "tube",
    .summary = "rings of particles: stretch, bending, twist and ovalisation of the section",
    .recipe = sw_web_recipe,
    .mesh = "tube",
};
