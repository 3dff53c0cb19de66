/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of objects of particles with wires, with each other and with themselves. A particle is a
 * ball of the object's radius, a wire a chain of round rods; the law is that of contact with
 * obstacles. Particles that something joins, or that have a partner in common, do not touch. What
 * lies between particles is no surface: a wire thinner than the gaps between balls gets through. */
#ifndef SW_CONTACT_GRAINS_H
#define SW_CONTACT_GRAINS_H

#include "contact/pairs.h"

typedef struct sw_grains sw_grains;

/* By the rules (bodies x bodies) between objects of particles and what is not a mesh of rings.
 * *out = NULL: nothing of that kind. SW_ENOMEM. */
sw_status sw_grains_new(const sw_system *system, const sw_pair_rule *rules, sw_grains **out);
/* As sw_pairs_copy. */
sw_status sw_grains_copy(const sw_grains *grains, const sw_system *system, sw_grains **out);
void sw_grains_free(sw_grains *grains); /* NULL is allowed */

/* These do what those of sw_pairs do. */
sw_status sw_grains_begin_step(sw_grains *grains, sw_system *system, sw_contact_regime regime,
                               double h, double nominal, sw_error *err);
void sw_grains_begin_stage(sw_grains *grains, double first);
sw_status sw_grains_begin_look(sw_grains *grains, sw_system *system, sw_error *err);
sw_status sw_grains_eval(sw_grains *grains, sw_system *system, const double *y, unsigned want,
                         sw_error *err);
int sw_grains_settled(sw_grains *grains, sw_system *system, const double *delta);
sw_contact_verdict sw_grains_review(sw_grains *grains, sw_system *system, const double *x1,
                                    double h);
/* 1 = solve again. */
int sw_grains_review_static(sw_grains *grains, sw_system *system, const double *x1);
void sw_grains_commit(sw_grains *grains);

/* What touches, which is also what is remembered between steps. */
const void *sw_grains_memory(const sw_grains *grains, size_t *bytes);
sw_status sw_grains_set_memory(sw_grains *grains, const void *memory, size_t bytes);
/* first (bodies + 1): node that each body begins with. */
int sw_grains_memory_fits(const void *memory, size_t bytes, const size_t *first, size_t bodies);
int sw_grains_memory_names(const void *memory, size_t bytes, size_t node);
size_t sw_grains_layout(void);
/* new_node, new_body: what those of the memory are now; SIZE_MAX: they are gone. */
sw_status sw_grains_inherit(sw_grains *grains, const void *memory, size_t bytes,
                            const size_t *new_node, const size_t *new_body);

size_t sw_grains_count(const sw_grains *grains); /* places with a force */
/* Place number k of those; of a particle the place along its segment is 0. */
sw_pair_place sw_grains_place(const sw_grains *grains, size_t k);
double sw_grains_penetration(const sw_grains *grains, size_t *node); /* [m] */
double sw_grains_energy(const sw_grains *grains);                    /* [J] */
double sw_grains_rubbed(const sw_grains *grains);                    /* [J] */
double sw_grains_emerged(const sw_grains *grains);                   /* [J] */
int sw_grains_steady(const sw_grains *grains);
size_t sw_grains_impacts(const sw_grains *grains); /* [-] */

#endif
