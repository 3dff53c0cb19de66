/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows of wires on obstacles. The steps of a blow are taken in short parts (substeps). Private to
 * this room. */
#ifndef SW_STEP_BLOW_H
#define SW_STEP_BLOW_H

#include "scene/scene.h"

/* Shortest part of a blow, unless a wire is pushed by its end or a tie snaps taut [s]. */
#define SW_SHORTEST_PART 1e-4

/* Returns the step to take instead of h: shorter during a blow [s]. */
double sw_blow_part(const sw_scene *scene, double h);
/* Smallest part that is tried during a blow; HUGE_VAL: there is no blow [s]. */
double sw_blow_smallest(const sw_scene *scene);
/* 1 if a converged trial of size h contains a new blow and must be redone in shorter parts. */
int sw_blow_begins(sw_scene *scene, double h);
/* Returns the part in which a converged trial of size h must be redone because a tie snaps taut in
 * it during a blow; h: none does [s]. */
double sw_blow_snap(const sw_scene *scene, double h);
/* Call when a part was refused or made energy: shortens the time of short parts. part [s]. */
void sw_blow_refused(sw_scene *scene, double part);

#endif
