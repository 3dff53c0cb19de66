/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tells which particles of a web are joined by a link, a fold or an element. */
#ifndef SW_MUTUAL_JOINED_H
#define SW_MUTUAL_JOINED_H

#include "state/web.h"

typedef struct sw_joined {
  size_t *first;     /* (particles + 1) index of each particle's first partner */
  uint32_t *partner; /* partners of each particle, ascending */
} sw_joined;

/* On SW_ENOMEM the caller must still free *out. */
sw_status sw_joined_new(const sw_web *web, sw_joined *out);
void sw_joined_free(sw_joined *joined);

int sw_joined_are(const sw_joined *joined, uint32_t a, uint32_t b);
/* 1 if both are joined, or if a third particle is joined to both. */
int sw_joined_nearly(const sw_joined *joined, uint32_t a, uint32_t b);

#endif
