/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work space while an object of particles is made. Private to this room. */
#ifndef SW_EDIT_PARTICLES_H
#define SW_EDIT_PARTICLES_H

#include "edit/objects.h"

typedef struct maker {
  const char *name;
  const sw_particles_parts *parts;
  sw_error *err;
  double shortest;  /* shortest link or edge of an element [m] */
  int yields;       /* 1: some link may yield */
  double radius;    /* [m] */
  double mass;      /* [kg] */
  sw_vec low, high; /* corners of its bounding box [m] */
  sw_web *web;
} maker;

/* Marks the particles and edges of the web that are its surface. SW_ENOMEM. */
sw_status sw_particles_add_surface(const maker *m);

#endif
