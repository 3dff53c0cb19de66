/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rod: stretch both ways, bending by hinge angles, twist between holds. */
#include "wire/wire.h"

static void recipe(const sw_beam *beam, sw_recipe *out) {
  *out = (sw_recipe){.count = 4,
                     .terms = {{"gravity", {0}},
                               {"stretch", {beam->EA, 0}},
                               {"bend", {beam->EI}},
                               {"twist", {beam->GJ}}},
                     .push = 1,
                     .twist = 1};
  if (beam->framed)
    out->terms[3] =
        (sw_recipe_term){"frame", {beam->EI, beam->EI_axis[0], beam->EI_axis[1], beam->GJ}};
}

const sw_wire_class sw_wire_rod = {
    .name = "rod",
    .summary = "elastic rod: stretch, bending and twist, no change of section",
    .recipe = recipe,
};
