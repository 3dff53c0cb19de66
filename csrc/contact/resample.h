/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of touches on a line that has got other edges. */
#ifndef SW_CONTACT_RESAMPLE_H
#define SW_CONTACT_RESAMPLE_H

#include "contact/contact.h"

/* The memory of touches on a line's former edges. */
typedef struct sw_former {
  const void *memory; /* of all bodies, as of sw_contact_inherit */
  size_t bytes;
  size_t first, nodes;    /* the line's nodes in it */
  const double *s;        /* (nodes) their arc lengths [m] */
  const size_t *new_node; /* present nodes of all nodes in it; SIZE_MAX: gone */
} sw_former;

/* Gives a line that has got other edges the memory of the touches that it had, with the same sum of
 * forces, as if the wire were still on them. Without it the depth of new edges would count as that
 * of a wire that was drawn into something, and be pushed out. SW_ENOMEM. */
sw_status sw_contact_resample(sw_contact *contact, const sw_system *system, size_t body,
                              const sw_former *former);
/* The line from node `first` to `end` has got other edges. Its pressing touches keep the depth at
 * which they are now, at their force: it is due to the edges, and to let it out would be work. */
void sw_contact_keep_depth(sw_contact *contact, size_t first, size_t end);
/* 1 if the memory has a force of nodes from `first` to `end` (exclusive) on an obstacle. */
int sw_contact_memory_presses(const void *memory, size_t bytes, int id, size_t first, size_t end);

#endif
