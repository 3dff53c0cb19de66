/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact between bodies: wires with wires and themselves; objects of particles with wires, each
 * other and themselves. The contact law is that of obstacles. Two finders (pairs.c, grains.c) find
 * the places of touch and their dependence on nodes; the rest is common. The stiffness between the
 * two bodies is in the matrix as bridges between their nodes. */
#ifndef SW_MUTUAL_MUTUAL_H
#define SW_MUTUAL_MUTUAL_H

#include <stddef.h>

#include "base/status.h"
#include "contact/contact.h"
#include "system/system.h"

typedef struct sw_mutual sw_mutual;

/* How two bodies touch. */
typedef struct sw_pair_rule {
  int on;          /* 0: they pass through each other */
  double friction; /* [-] */
} sw_pair_rule;

/* Makes contact of wires with wires and with themselves. rules (bodies x bodies, symmetric) are
 * copied. Segments are round rods. Wires that cross touch where their smooth curves, or their
 * segments, are nearest; nearly parallel segments touch at each other's nodes. SW_ENOMEM. */
sw_status sw_pairs_new(const sw_system *system, const sw_pair_rule *rules, sw_mutual **out);
/* Makes contact of objects of particles and of meshes with each other, with themselves and with
 * lines. A particle at the surface is a ball, an edge of the surface a round rod, a line a chain of
 * rods. Joined particles, and particles with a common partner, do not touch. Between edges there is
 * no surface: a thin wire passes through the gaps. *out = NULL: there is no such rule.
 * SW_ENOMEM. */
sw_status sw_grains_new(const sw_system *system, const sw_pair_rule *rules, sw_mutual **out);
/* 1 if the bodies of such contact include an object of particles. */
int sw_grains_have_loose(const sw_mutual *grains);
/* Makes a copy with the same rules and memory, for a look ahead. *out must be NULL before; the
 * caller frees it, also on failure. SW_ENOMEM. */
sw_status sw_mutual_copy(const sw_mutual *mutual, const sw_system *system, sw_mutual **out);
void sw_mutual_free(sw_mutual *mutual); /* NULL is allowed */

/* 1 if something that touches rubs. */
int sw_mutual_rubs(const sw_mutual *mutual);
/* 1 if something touches now and rubs. */
int sw_mutual_drags(const sw_mutual *mutual);

/* 1 if there is a rule that these bodies touch, or this body touches itself. */
int sw_mutual_keeps_apart(const sw_mutual *mutual, size_t one, size_t two);
/* 1: nothing can touch in this step. */
int sw_mutual_idle(const sw_mutual *mutual);

/* Marks the bodies that may touch others or themselves in this step as coupled (system/part.h). */
void sw_pairs_mark(const sw_mutual *pairs, sw_system *system);
/* 1 if these include a waiting body. */
int sw_pairs_meet_waiting(const sw_mutual *pairs, const sw_system *system);
/* Call before a step begins: wakes the bodies that may touch one that does not wait. SW_ENOMEM.
 * Before it, call sw_mutual_regard with the size of the step. */
void sw_mutual_regard(sw_mutual *mutual, const sw_system *system, sw_contact_regime regime,
                      double h, double nominal);
sw_status sw_mutual_wake(sw_mutual *mutual, sw_system *system);
/* As sw_contact_keep_moving. */
void sw_mutual_keep_moving(const sw_mutual *mutual, sw_system *system);

/* These correspond to the functions of sw_contact. */
sw_status sw_mutual_begin_step(sw_mutual *mutual, sw_system *system, sw_contact_regime regime,
                               double h, double nominal, sw_error *err);
void sw_mutual_begin_stage(sw_mutual *mutual, double first);
sw_status sw_mutual_begin_look(sw_mutual *mutual, sw_system *system, sw_error *err);
sw_status sw_mutual_eval(sw_mutual *mutual, sw_system *system, const double *y, unsigned want,
                         sw_error *err);
/* Like sw_contact_refine, with all touches of bridged bodies. contact: touches with obstacles, or
 * NULL. Returns the share of the solution that should be applied [-]. */
double sw_mutual_refine(sw_mutual *mutual, sw_contact *contact, sw_system *system);
int sw_mutual_settled(sw_mutual *mutual, sw_system *system, const double *delta);
/* 1 if wires (of sw_pairs_new) will strike each other in a step of size h from now, by their
 * velocities. */
int sw_pairs_expect(const sw_mutual *pairs, const sw_system *system, double h);
/* dull: 1 if the trial does not rebound. */
sw_contact_verdict sw_mutual_review(sw_mutual *mutual, sw_system *system, const double *x1,
                                    double h, int dull);
/* 1 = solve again. */
int sw_mutual_review_static(sw_mutual *mutual, sw_system *system, const double *x1);
void sw_mutual_commit(sw_mutual *mutual, sw_system *system, int holds); /* see sw_contact_commit */

/* Memory between steps, like sw_contact_memory. */
const void *sw_mutual_memory(const sw_mutual *mutual, size_t *bytes);
sw_status sw_mutual_set_memory(sw_mutual *mutual, const void *memory, size_t bytes);
/* first (bodies + 1): the first node of each body. */
int sw_mutual_memory_fits(const void *memory, size_t bytes, const size_t *first, size_t bodies);
int sw_mutual_memory_names(const void *memory, size_t bytes, size_t node);
/* 1 if more than `most` bodies (at most SW_NEAR_MOST) touch others or themselves, or nearly do. */
enum { SW_NEAR_MOST = 16 };
int sw_mutual_crowded(const sw_mutual *mutual, size_t most);
/* Like sw_contact_seen. */
const void *sw_mutual_seen(sw_mutual *mutual, size_t *bytes);
sw_status sw_mutual_set_seen(sw_mutual *mutual, const void *seen, size_t bytes,
                             const sw_system *system);
size_t sw_mutual_layout(void); /* like sw_contact_layout */
/* new_node, new_body: new numbers of old nodes and bodies; SIZE_MAX: gone. former: of contact of
 * wires, what has changed, or NULL (mutual/resample.h). */
struct sw_pairs_former;
sw_status sw_mutual_inherit(sw_mutual *mutual, const sw_system *system, const void *memory,
                            size_t bytes, const size_t *new_node, const size_t *new_body,
                            const struct sw_pairs_former *former);

/* A place where two things press on each other. */
typedef struct sw_pair_place {
  size_t body[2];         /* in the system's arrays */
  size_t node[2], end[2]; /* each place is between these nodes, or at a particle (end = node) */
  double at[2];           /* from node to end [-] */
  sw_vec normal;          /* towards the first body [-] */
  double normal_force;    /* [N] */
  sw_vec friction;        /* on the first body [N] */
  sw_vec slip;            /* sliding way in the last step [m] */
  double gap;             /* [m] */
} sw_pair_place;

/* Reads the next place with a force, from touch *next on (0 at first), of this body or of any
 * (SIZE_MAX). 0: no more places. sw_presses_count (touch/tally.h) counts those of all bodies. */
int sw_mutual_next_place(const sw_mutual *mutual, size_t body, size_t *next, sw_pair_place *out);
/* Depth that a released join left does not count [m]. */
double sw_mutual_penetration(const sw_mutual *mutual, const sw_system *system, size_t *node);
/* 1 if wires come apart that a released join kept together. */
int sw_mutual_parts(const sw_mutual *mutual, const sw_system *system);
/* Like those of sw_contact. */
struct sw_presses sw_mutual_presses(const sw_mutual *mutual);
struct sw_presses sw_mutual_still_presses(const sw_mutual *mutual); /* between bodies that wait */
int sw_mutual_steady(const sw_mutual *mutual);
size_t sw_mutual_impacts(const sw_mutual *mutual); /* [-] */

#endif
