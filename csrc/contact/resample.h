/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of touches on a line that has got other edges. */
#ifndef SW_CONTACT_RESAMPLE_H
#define SW_CONTACT_RESAMPLE_H

#include "contact/contact.h"

/* Gives the samples of a line under pads the memory of the nearest samples that it had with its
 * former edges, with the force per length. Otherwise its depth in the pads would count as that of
 * a wire that was drawn into them, and they would push it out with their force. memory, bytes: as
 * of sw_contact_inherit. s: (nodes) arc lengths of the former nodes, from the number `first` on
 * [m]. SW_ENOMEM. */
sw_status sw_contact_resample(sw_contact *contact, const sw_system *system, size_t body,
                              const void *memory, size_t bytes, size_t first, const double *s,
                              size_t nodes);
/* The same for other obstacles: nodes and segments that have no memory get that of the touches that
 * were there, with the force per length, as if the wire were still on them. A touch that is alone
 * keeps its force. Other arguments as above. SW_ENOMEM. */
sw_status sw_contact_resample_rows(sw_contact *contact, const sw_system *system, size_t body,
                                   const void *memory, size_t bytes, size_t first, const double *s,
                                   size_t nodes);
/* The line from node `first` to `end` has got other edges. Its pressing touches keep the depth at
 * which they are now, at their force: it is due to the edges, and to let it out would be work. */
void sw_contact_keep_depth(sw_contact *contact, size_t first, size_t end);
/* 1 if the memory has a force of nodes from `first` to `end` (exclusive) on an obstacle. */
int sw_contact_memory_presses(const void *memory, size_t bytes, int id, size_t first, size_t end);

#endif
