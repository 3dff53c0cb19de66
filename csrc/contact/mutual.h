/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact between bodies: wires with wires and themselves, objects of particles with wires, each
 * other and themselves. The law is that of obstacles. Two finders (pairs_near.c, grains.c) give the
 * places of touch and their dependence on nodes; the rest is common. The effect on both bodies
 * stays in the matrix as bridges between their nodes. */
#ifndef SW_CONTACT_MUTUAL_H
#define SW_CONTACT_MUTUAL_H

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

/* Wires with wires and with themselves, by rules (bodies x bodies, symmetric), copied. Segments are
 * round rods. Wires that cross touch where their smooth curves are nearest, or their segments;
 * nearly parallel segments touch at each other's nodes. SW_ENOMEM. */
sw_status sw_pairs_new(const sw_system *system, const sw_pair_rule *rules, sw_mutual **out);
/* Objects of particles with each other and with wires that are lines. A particle is a ball of the
 * object's radius, a wire a chain of round rods. Joined particles, and those with a common partner,
 * do not touch. There is no surface between balls: a thin wire passes the gaps. *out = NULL: no
 * such rule. SW_ENOMEM. */
sw_status sw_grains_new(const sw_system *system, const sw_pair_rule *rules, sw_mutual **out);
/* A copy with the same rules and memory, for a look ahead. The caller frees *out, NULL before, also
 * on failure. SW_ENOMEM. */
sw_status sw_mutual_copy(const sw_mutual *mutual, const sw_system *system, sw_mutual **out);
void sw_mutual_free(sw_mutual *mutual); /* NULL is allowed */

/* 1: nothing can touch in this step. */
int sw_mutual_idle(const sw_mutual *mutual);

/* These do what those of sw_contact do. */
sw_status sw_mutual_begin_step(sw_mutual *mutual, sw_system *system, sw_contact_regime regime,
                               double h, double nominal, sw_error *err);
void sw_mutual_begin_stage(sw_mutual *mutual, double first);
sw_status sw_mutual_begin_look(sw_mutual *mutual, sw_system *system, sw_error *err);
sw_status sw_mutual_eval(sw_mutual *mutual, sw_system *system, const double *y, unsigned want,
                         sw_error *err);
/* As sw_contact_refine, with all touches of bridged bodies; contact: those with obstacles, NULL:
 * none. Returns the share of the solution that is to be made [-]. */
double sw_mutual_refine(sw_mutual *mutual, sw_contact *contact, sw_system *system);
int sw_mutual_settled(sw_mutual *mutual, sw_system *system, const double *delta);
/* By velocities, will wires (of sw_pairs_new) strike in a step of size h from now? */
int sw_pairs_expect(const sw_mutual *pairs, const sw_system *system, double h);
/* dull: the trial does not rebound. */
sw_contact_verdict sw_mutual_review(sw_mutual *mutual, sw_system *system, const double *x1,
                                    double h, int dull);
/* 1 = solve again. */
int sw_mutual_review_static(sw_mutual *mutual, sw_system *system, const double *x1);
void sw_mutual_commit(sw_mutual *mutual, sw_system *system);

/* Memory between steps, as sw_contact_memory. */
const void *sw_mutual_memory(const sw_mutual *mutual, size_t *bytes);
sw_status sw_mutual_set_memory(sw_mutual *mutual, const void *memory, size_t bytes);
/* first (bodies + 1): node that each body begins with. */
int sw_mutual_memory_fits(const void *memory, size_t bytes, const size_t *first, size_t bodies);
int sw_mutual_memory_names(const void *memory, size_t bytes, size_t node);
/* 1: more than so many bodies touch others or themselves, or nearly do; most: up to SW_NEAR_MOST.
 */
enum { SW_NEAR_MOST = 16 };
int sw_mutual_crowded(const sw_mutual *mutual, size_t most);
/* As sw_contact_seen. */
const void *sw_mutual_seen(const sw_mutual *mutual, size_t *bytes);
sw_status sw_mutual_set_seen(sw_mutual *mutual, const void *seen, size_t bytes,
                             const sw_system *system);
size_t sw_mutual_layout(void); /* as sw_contact_layout */
/* new_node, new_body: present numbers; SIZE_MAX: gone. */
sw_status sw_mutual_inherit(sw_mutual *mutual, const void *memory, size_t bytes,
                            const size_t *new_node, const size_t *new_body);

/* A place where two things press on each other. */
typedef struct sw_pair_place {
  size_t body[2];         /* in the system's arrays */
  size_t node[2], end[2]; /* each is between these, or a particle, which is its own end */
  double at[2];           /* from node to end [-] */
  sw_vec normal;          /* towards the first one [-] */
  double normal_force;    /* [N] */
  sw_vec friction;        /* on the first one [N] */
  sw_vec slip;            /* way that it slid in the last step [m] */
  double gap;             /* [m] */
} sw_pair_place;

/* The next place with a force, from touch *next on (0 to begin with), of this body of the system,
 * or SIZE_MAX: of any; 0: there are no more. There are sw_presses_count of any (contact/tally.h).
 */
int sw_mutual_next_place(const sw_mutual *mutual, size_t body, size_t *next, sw_pair_place *out);
double sw_mutual_penetration(const sw_mutual *mutual, size_t *node); /* [m] */
/* As those of sw_contact. */
struct sw_presses sw_mutual_presses(const sw_mutual *mutual);
int sw_mutual_steady(const sw_mutual *mutual);
size_t sw_mutual_impacts(const sw_mutual *mutual); /* [-] */

#endif
