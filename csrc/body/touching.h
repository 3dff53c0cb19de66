/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the wires touch: obstacles and wires in one (see sw_contact and sw_mutual). Of the scene's
 * inside. */
#ifndef SW_BODY_TOUCHING_H
#define SW_BODY_TOUCHING_H

#include "contact/contact.h"
#include "contact/crowd.h"
#include "contact/mutual.h"
#include "contact/tally.h"
#include "scene/scene.h"

/* Which wires touch each other, as stated. */
typedef struct sw_scene_rule {
  uint32_t *wires; /* (count) slots; count 0 = all */
  size_t count;
  int self; /* each with itself too */
  sw_pair_rule rule;
} sw_scene_rule;

/* SW_ENOMEM. */
sw_status sw_scene_new_pairs(sw_scene *scene);
void sw_scene_couple(sw_scene *scene);
int sw_scene_has_contact(const sw_scene *scene);
/* Contact is to know what obstacles remember and which may move. */
void sw_scene_inform_contact(sw_scene *scene);
/* The life of a step or an equilibrium for what touches: it begins, is reviewed and taken. */
sw_status sw_scene_begin_contact(sw_scene *scene, sw_contact_regime regime, double t, double h,
                                 double nominal, sw_error *err);
/* Will wires strike each other in a step of size h that begins now, as far as velocities tell? And
 * have they in the last trial? */
int sw_scene_expects_strike(const sw_scene *scene, double h);
int sw_scene_was_struck(const sw_scene *scene);
sw_contact_verdict sw_scene_review_contact(sw_scene *scene, const double *x1, const double *v1,
                                           double h);
int sw_scene_review_static(sw_scene *scene, const double *x1);
void sw_scene_commit_contact(sw_scene *scene);
/* The built system's stiffness at its state, with contact as it presses now: of these obstacles
 * (count), or NULL: of all. */
sw_status sw_scene_linearise(sw_scene *scene, const size_t *only, size_t count, sw_error *err);
double sw_scene_deepest(const sw_scene *scene, size_t *node); /* [m] */
/* Lists of all touches; how many lists. */
enum { SW_SCENE_PRESSES = 3 };
size_t sw_scene_presses(const sw_scene *scene, sw_presses list[SW_SCENE_PRESSES]);
double sw_scene_contact_energy(const sw_scene *scene); /* [J] */
double sw_scene_rubbed(const sw_scene *scene);         /* lost by friction in the step [J] */
/* How many places there are where bodies press on each other, and the next of them: of this body of
 * the system, or SIZE_MAX: of any; 0: there are no more. next: {0, 0} for the first one. */
size_t sw_scene_places(const sw_scene *scene);
int sw_scene_next_place(const sw_scene *scene, size_t body, size_t next[2], sw_pair_place *out);

#endif
