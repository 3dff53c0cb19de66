/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of wires with wires and with themselves. Segments are round rods; the law is
 * that of contact with obstacles. Wires that cross touch where their smooth curves are nearest,
 * or their segments; nearly parallel segments touch at each other's nodes. What two wires do to
 * each other stays in the matrix as links between their nodes. */
#ifndef SW_CONTACT_PAIRS_H
#define SW_CONTACT_PAIRS_H

#include <stddef.h>

#include "base/status.h"
#include "contact/contact.h"
#include "system/system.h"

typedef struct sw_pairs sw_pairs;

/* How two wires touch. */
typedef struct sw_pair_rule {
  int on;          /* 0: they pass through each other */
  double friction; /* [-] */
} sw_pair_rule;

/* Contact of bodies (count) by rules (count x count, symmetric), copied. SW_ENOMEM. */
sw_status sw_pairs_new(const sw_pair_rule *rules, size_t count, sw_pairs **out);
/* Another one with the same rules and memory, to look ahead with; *out, NULL before, is the
 * caller's to free also when this fails. SW_ENOMEM. */
sw_status sw_pairs_copy(const sw_pairs *pairs, sw_pairs **out);
void sw_pairs_free(sw_pairs *pairs); /* NULL is allowed */

/* No segments are near enough to touch in this step. */
int sw_pairs_idle(const sw_pairs *pairs);

/* These do what those of sw_contact do. */
sw_status sw_pairs_begin_step(sw_pairs *pairs, sw_system *system, sw_contact_regime regime,
                              double h, double nominal, sw_error *err);
/* As sw_contact_begin_stage. */
void sw_pairs_begin_stage(sw_pairs *pairs, double first);
sw_status sw_pairs_begin_look(sw_pairs *pairs, sw_system *system, sw_error *err);
sw_status sw_pairs_eval(sw_pairs *pairs, sw_system *system, const double *y, unsigned want,
                        sw_error *err);
/* As sw_contact_refine, with what linked bodies touch besides (contact; NULL: nothing). */
void sw_pairs_refine(sw_pairs *pairs, sw_contact *contact, sw_system *system);
int sw_pairs_settled(sw_pairs *pairs, sw_system *system, const double *delta);
/* Will something strike in a step of size h that begins now, as far as velocities tell? */
int sw_pairs_expect(const sw_pairs *pairs, const sw_system *system, double h);
/* dull: the trial was one that does not bounce, whatever struck. */
sw_contact_verdict sw_pairs_review(sw_pairs *pairs, sw_system *system, const double *x1, double h,
                                   int dull);
/* 1 = solve again. */
int sw_pairs_review_static(sw_pairs *pairs, sw_system *system, const double *x1);
void sw_pairs_commit(sw_pairs *pairs, sw_system *system);

/* Memory between steps, as sw_contact_memory. */
const void *sw_pairs_memory(const sw_pairs *pairs, size_t *bytes);
sw_status sw_pairs_set_memory(sw_pairs *pairs, const void *memory, size_t bytes);
int sw_pairs_memory_fits(const void *memory, size_t bytes, size_t nodes);
int sw_pairs_memory_names(const void *memory, size_t bytes, size_t node);
/* As sw_contact_seen, in two blocks: segments, and where they touch. */
void sw_pairs_seen(const sw_pairs *pairs, const void *blocks[2], size_t bytes[2]);
sw_status sw_pairs_set_seen(sw_pairs *pairs, const void *const blocks[2], const size_t bytes[2],
                            const sw_system *system);
size_t sw_pairs_layout(void); /* as sw_contact_layout */
sw_status sw_pairs_inherit(sw_pairs *pairs, const void *memory, size_t bytes,
                           const size_t *new_node);

/* A place where two wires press on each other. */
typedef struct sw_pair_place {
  size_t body[2], node[2]; /* the segments' wires and first nodes, in the system's arrays */
  double at[2];            /* along the segments [-] */
  sw_vec normal;           /* towards the first wire [-] */
  double normal_force;     /* [N] */
  sw_vec friction;         /* on the first wire [N] */
  sw_vec slip;             /* way that it slid in the last step [m] */
  double gap;              /* [m] */
} sw_pair_place;

size_t sw_pairs_count(const sw_pairs *pairs); /* places with a force */
/* Place number k of those. */
sw_pair_place sw_pairs_place(const sw_pairs *pairs, size_t k);
double sw_pairs_penetration(const sw_pairs *pairs, size_t *node); /* [m] */
double sw_pairs_energy(const sw_pairs *pairs);                    /* [J] */
/* As those of sw_contact. */
double sw_pairs_rubbed(const sw_pairs *pairs); /* [J] */
/* What touches have done on the way that wires were let out of each other [J]. */
double sw_pairs_emerged(const sw_pairs *pairs);
int sw_pairs_steady(const sw_pairs *pairs);
size_t sw_pairs_impacts(const sw_pairs *pairs); /* [-] */

#endif
