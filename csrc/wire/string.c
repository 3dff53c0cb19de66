/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one-dimensional model: a string of particles with stretching, repelling and bending forces
 * between neighbours. */
#include "wire/wire.h"

static void recipe(const sw_beam *beam, sw_recipe *out) {
  *out = (sw_recipe){.count = 4,
                     .terms = {{"gravity", {0}},
                               {"stretch", {beam->EA, 1}},
                               {"repel", {beam->EA}},
                               {"flex", {beam->EI}}},
                     .push = 1};
}

const sw_wire_class sw_wire_string = {
    .name = "string",
    .summary = "particles with stretching, repelling and bending forces between neighbours",
    .recipe = recipe,
};
