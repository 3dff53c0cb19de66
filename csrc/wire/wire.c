/* SPDX-License-Identifier: GPL-3.0-or-later */
/* List of all wire models, and the common recipe of wires as meshes. */
#include "wire/wire.h"

#include <string.h>

#define X(name) extern const sw_wire_class sw_wire_##name;
#include "wire/list.def"
#undef X

static const sw_wire_class *const all[] = {
#define X(name) &sw_wire_##name,
#include "wire/list.def"
#undef X
    NULL};

const sw_wire_class *const *sw_wire_all(void) { return all; }

void sw_web_recipe(const sw_beam *beam SW_UNUSED, sw_recipe *out) {
  *out = (sw_recipe){.count = 6,
                     .terms = {{"gravity", {0}},
                               {"spring", {0}},
                               {"fold", {0}},
                               {"crease", {0}},
                               {"neo_hooke", {0}},
                               {"slide", {0}}}};
}

const sw_wire_class *sw_wire_find(const char *name) {
  for (size_t i = 0; all[i]; i++)
    if (strcmp(all[i]->name, name) == 0) return all[i];
  return NULL;
}
