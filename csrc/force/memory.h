/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The slipping hinges of a whole wire, shared by plastic and stick_slip: layout of the history,
 * evaluation, commit, and transfer to another plan. A history is the work dissipated so far [J],
 * then six numbers for each node and each clamp hinge: slipped angle [rad] and tangent [-]. Held
 * nodes and ends have no hinge; they keep the slip of a hinge that was there before. */
#ifndef SW_FORCE_MEMORY_H
#define SW_FORCE_MEMORY_H

#include "force/force.h"

/* The law of a wire. A hinge of length w has k = stiffness / w, and so on. */
typedef struct sw_memory_law {
  double stiffness; /* [N m2] */
  double own;       /* stiffness if this force is the whole spring; 0 if it corrects bend [N m2] */
  double hardening; /* [N m2] */
  double limit;     /* [N m] */
} sw_memory_law;

size_t sw_memory_size(const sw_plan *plan); /* in doubles */
void sw_memory_eval(const sw_memory_law *law, sw_field *field);
void sw_memory_commit(const sw_memory_law *law, const sw_field *field, double *history);
sw_vec sw_memory_clamp_moment(const sw_memory_law *law, const sw_field *field,
                              const sw_clamp_hinge *hinge);
double sw_memory_clamp_energy(const sw_memory_law *law, const sw_field *field,
                              const sw_clamp_hinge *hinge); /* [J] */
/* Fills the history for field's plan from the history of an older plan of the same wire. The
 * slipped angle per length is kept at its arc lengths, so the total slip stays. */
void sw_memory_inherit(const sw_plan *old, const double *from, const sw_field *field,
                       double *history);

/* Defines eval, commit, clamp_moment and clamp_energy of such a force; law_of(args, plan) gives its
 * law. */
#define SW_MEMORY_FORCE(law_of)                                                                  \
  static sw_status eval(const void *args, sw_field *f, sw_error *err) {                          \
    const sw_memory_law law = law_of(args, f->plan);                                             \
    (void)err;                                                                                   \
    sw_memory_eval(&law, f);                                                                     \
    return SW_OK;                                                                                \
  }                                                                                              \
  static void commit(const void *args, const sw_field *f, double *history) {                     \
    const sw_memory_law law = law_of(args, f->plan);                                             \
    sw_memory_commit(&law, f, history);                                                          \
  }                                                                                              \
  static sw_vec clamp_moment(const void *args, const sw_field *f, const sw_clamp_hinge *hinge) { \
    const sw_memory_law law = law_of(args, f->plan);                                             \
    return sw_memory_clamp_moment(&law, f, hinge);                                               \
  }                                                                                              \
  static double clamp_energy(const void *args, const sw_field *f, const sw_clamp_hinge *hinge) { \
    const sw_memory_law law = law_of(args, f->plan);                                             \
    return sw_memory_clamp_energy(&law, f, hinge);                                               \
  }

#endif
