/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "constraint/constraint.h"

#include <string.h>

#define X(name) extern const sw_hold_class sw_hold_##name;
#include "constraint/list.def"
#undef X

static const sw_hold_class *const all[] = {
#define X(name) &sw_hold_##name,
#include "constraint/list.def"
#undef X
    NULL};

const sw_hold_class *const *sw_hold_all(void) { return all; }

const sw_hold_class *sw_hold_find(const char *name) {
  for (size_t i = 0; all[i]; i++)
    if (strcmp(all[i]->name, name) == 0) return all[i];
  return NULL;
}
