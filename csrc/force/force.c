/* SPDX-License-Identifier: GPL-3.0-or-later */
/* List of all forces. */
#include "force/force.h"

#include <string.h>

#define X(name) extern const sw_force_class sw_force_##name;
#include "force/list.def"
#undef X

static const sw_force_class *const all[] = {
#define X(name) &sw_force_##name,
#include "force/list.def"
#undef X
    NULL};

const sw_force_class *const *sw_force_all(void) { return all; }

const sw_force_class *sw_force_find(const char *name) {
  for (size_t i = 0; all[i]; i++)
    if (strcmp(all[i]->name, name) == 0) return all[i];
  return NULL;
}
