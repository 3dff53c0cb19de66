/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of a scene's wires with obstacles and with each other, behind one interface (see
 * sw_contact and sw_mutual). */
#ifndef SW_BODY_TOUCHING_H
#define SW_BODY_TOUCHING_H

#include "contact/contact.h"
#include "mutual/crowd.h"
#include "mutual/mutual.h"
#include "mutual/relief.h"
#include "scene/scene.h"
#include "touch/tally.h"

/* A rule of which wires touch each other, as stated. */
typedef struct sw_scene_rule {
  uint32_t *wires; /* (count) slots; count 0 = all */
  size_t count;
  int self; /* 1: each wire with itself too */
  sw_pair_rule rule;
} sw_scene_rule;

/* Makes the contact between wires by the rules. SW_ENOMEM. */
sw_status sw_scene_new_pairs(sw_scene *scene);
/* Connects contact and holds to the system. */
void sw_scene_couple(sw_scene *scene);
int sw_scene_has_contact(const sw_scene *scene);
/* Tells contact the memory of obstacles, and which obstacles may move. */
void sw_scene_inform_contact(sw_scene *scene);
/* The scene is built and will run: see sw_contact_clear. */
sw_status sw_scene_clear_meshes(sw_scene *scene, sw_error *err);
/* Contact in a step or an equilibrium: begins it, reviews a trial, commits it. */
sw_status sw_scene_begin_contact(sw_scene *scene, sw_contact_regime regime, double t, double h,
                                 double nominal, sw_error *err);
/* 1 if velocities predict that wires strike each other in a step of size h from now. */
int sw_scene_expects_strike(const sw_scene *scene, double h);
/* 1 if wires struck each other in the last trial. */
int sw_scene_was_struck(const sw_scene *scene);
sw_contact_verdict sw_scene_review_contact(sw_scene *scene, const double *x1, const double *v1,
                                           double h);
int sw_scene_review_static(sw_scene *scene, const double *x1);
void sw_scene_commit_contact(sw_scene *scene, int holds); /* see sw_contact_commit */
/* A step was accepted: stops the wires that came to rest (system/wait.h). */
void sw_scene_stop_wires(sw_scene *scene);
/* Computes the built system's stiffness at its state, with contact as it presses now: of these
 * obstacles (count), or of all (NULL). */
sw_status sw_scene_linearise(sw_scene *scene, const size_t *only, size_t count, sw_error *err);
/* The same with all obstacles, which have no friction, but for pads that grip. */
sw_status sw_scene_linearise_slipping(sw_scene *scene, sw_error *err);
/* After a change there are no touches until the next step: finds those of the present state, with
 * the forces that their memory has. */
sw_status sw_scene_find_touches(sw_scene *scene, sw_error *err);
double sw_scene_deepest(const sw_scene *scene, size_t *node); /* deepest penetration [m] */
/* Lists of all touches; returns how many lists. */
enum { SW_SCENE_PRESSES = 5 };
size_t sw_scene_presses(const sw_scene *scene, sw_presses list[SW_SCENE_PRESSES]);
double sw_scene_contact_energy(const sw_scene *scene); /* [J] */
double sw_scene_rubbed(const sw_scene *scene);         /* lost by friction in the step [J] */
/* Places where bodies press on each other: their number, and the next one of this body of the
 * system (SIZE_MAX: of any); 0: there are no more. next: {0, 0} for the first one. */
size_t sw_scene_places(const sw_scene *scene);
int sw_scene_next_place(const sw_scene *scene, size_t body, size_t next[2], sw_pair_place *out);
/* See sw_mutual_relief and sw_mutual_part. */
int sw_scene_relief(const sw_scene *scene, size_t body, sw_relief *out);
void sw_scene_push_out(const sw_scene *scene, size_t body, const sw_relief *relief, double *out);

#endif
