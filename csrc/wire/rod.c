/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rod: stretch both ways and bending by hinge angles. */
#include "wire/wire.h"

static void recipe(const sw_beam *beam, sw_recipe *out) {
  *out = (sw_recipe){.count = 3,
                     .terms = {{"gravity", {0}}, {"stretch", {beam->EA, 0}}, {"bend", {beam->EI}}},
                     .push = 1};
}

const sw_wire_class sw_wire_rod = {
    .name = "rod",
    .summary = "elastic rod: stretch and bending, no change of section",
    .recipe = recipe,
};
