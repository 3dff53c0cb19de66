/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which particles of a web something joins: a link, a fold or an element. */
#ifndef SW_CONTACT_JOINED_H
#define SW_CONTACT_JOINED_H

#include "state/web.h"

typedef struct sw_joined {
  size_t *first;     /* (particles + 1) where the partners of each begin */
  uint32_t *partner; /* of each, ascending */
} sw_joined;

/* SW_ENOMEM leaves *out to be freed. */
sw_status sw_joined_new(const sw_web *web, sw_joined *out);
void sw_joined_free(sw_joined *joined);

int sw_joined_are(const sw_joined *joined, uint32_t a, uint32_t b);
/* Or is there one that is joined to both? */
int sw_joined_nearly(const sw_joined *joined, uint32_t a, uint32_t b);

#endif
