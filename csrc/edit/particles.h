/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An object of particles while it is made. Of this room only. */
#ifndef SW_EDIT_PARTICLES_H
#define SW_EDIT_PARTICLES_H

#include "edit/objects.h"

typedef struct maker {
  const char *name;
  const sw_particles_parts *parts;
  sw_error *err;
  double shortest;  /* of links and of elements' edges [m] */
  int yields;       /* 1: some link does */
  double radius;    /* [m] */
  double mass;      /* [kg] */
  sw_vec low, high; /* corners of a box around it [m] */
  sw_web *web;
} maker;

/* Which particles and edges of the web are its surface. SW_ENOMEM. */
sw_status sw_particles_add_surface(const maker *m);

#endif
