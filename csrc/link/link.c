/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The registry of links: finds a class by its name. */
#include "link/link.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "link/joint.h"

#define X(name) extern const sw_link_class sw_link_##name;
#include "link/list.def"
#undef X

static const sw_link_class *const all[] = {
#define X(name) &sw_link_##name,
#include "link/list.def"
#undef X
    NULL};

const sw_link_class *const *sw_link_all(void) { return all; }

const sw_link_class *sw_link_find(const char *name) {
  for (size_t i = 0; all[i]; i++)
    if (strcmp(all[i]->name, name) == 0) return all[i];
  return NULL;
}

void sw_hold_forget(sw_hold_args *a) {
  a->line = sw_v(0, 0, 0), a->from = a->to = a->friction = 0;
  a->points = NULL, a->count = 0, a->closed = a->formed = 0;
}

void sw_hold_clear(sw_hold *h) {
  if (h->cls && h->cls->hold->clear) h->cls->hold->clear(h);
  SW_FREE_ALL(h->s, h->local, h->particle);
  sw_log_free(&h->log);
  sw_motion_release(h->drive.motion);
}

const sw_link_class *sw_joint_class(double slack) {
  return isnan(slack) ? &sw_link_join : &sw_link_tie;
}
