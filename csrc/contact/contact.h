/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of wires with rigid obstacles: unilateral normal force, anchored
 * Coulomb friction, impacts, and the swept test that keeps fast wires from
 * passing thin walls. It is one sw_coupling of the system. */
#ifndef SW_CONTACT_CONTACT_H
#define SW_CONTACT_CONTACT_H

#include <stddef.h>

#include "base/status.h"
#include "motion/motion.h"
#include "shape/shape.h"
#include "system/system.h"

typedef struct sw_contact sw_contact;

/* One obstacle as contact sees it. */
typedef struct sw_contact_obstacle {
  const sw_shape *shape;
  double friction;    /* of what sticks [-] */
  double kinetic;     /* of what slides [-] */
  double restitution; /* [-] */
  double grips;       /* of a gripper's pad: the force that it is to press with, INFINITY = any; 0 =
                         it is none [N] */
  int id;             /* the owner's number; part of the memory's key */
  int off;            /* 1: nothing touches it */
} sw_contact_obstacle;

/* What wires do to an obstacle: a force and its moment about the obstacle's own origin [N], [N m];
 * or the impulse of both [N s], [N m s]. */
typedef struct sw_contact_load {
  sw_vec force, moment;
} sw_contact_load;

/* What an obstacle got in the last step. The owner keeps it, for contact is made anew. */
typedef struct sw_contact_past {
  sw_contact_load mean;   /* over the step, blows included; in statics that of the state; moment
                             about the world's origin [N], [N m] */
  sw_contact_load end;    /* at its end, with which a method may begin the next step [N] */
  double hardest;         /* mean over a step of the hardest blow that was followed in parts [N] */
  sw_contact_load gained; /* in the step without blows, for methods that look back [N s] */
} sw_contact_past;

/* Where obstacle number o is at a time. */
typedef sw_status (*sw_contact_place)(void *user, int o, double time, sw_motion_state *out,
                                      sw_error *err);

/* Takes copies. SW_ENOMEM. */
sw_status sw_contact_new(const sw_contact_obstacle *obstacles, size_t count, sw_contact_place place,
                         void *user, sw_contact **out);
/* Another one over the same obstacles with the same memory, to look ahead with: what
 * it does leaves the first as it is. SW_ENOMEM. */
sw_status sw_contact_copy(const sw_contact *contact, sw_contact **out);
void sw_contact_free(sw_contact *contact);
/* Only obstacles of these numbers (count) are touched from now on. */
void sw_contact_keep(sw_contact *contact, const size_t *ids, size_t count);

/* How the coming steps are computed: decides the normal stiffness. */
typedef enum sw_contact_regime {
  SW_CONTACT_STATIC,
  SW_CONTACT_IMPLICIT,
  SW_CONTACT_EXPLICIT
} sw_contact_regime;

/* Stiffness of a touch that is to carry up to force, plus rate2 times the mass behind it
 * [N/m], [1/s2]. */
void sw_contact_stiffness(sw_contact_regime regime, double force, double nominal, double *base,
                          double *rate2);
/* Stiffness that touches of a particle with other objects have at least, but in explicit steps
 * [N/m]. */
double sw_contact_hardness(const sw_web *web, size_t particle);

/* A step of size h from time t begins at the system's state: candidates. nominal
 * is the run's full step, from which the stiffness is derived; in statics both
 * are of the pseudo step, h = 0 when there is none. */
sw_status sw_contact_begin_step(sw_contact *contact, sw_system *system, sw_contact_regime regime,
                                double t, double h, double nominal, sw_error *err);

/* Evaluations at the accepted state begin, with every touch as stiff as its force
 * was over its depth in the last step. */
sw_status sw_contact_begin_look(sw_contact *contact, sw_system *system, double t, sw_error *err);

/* The system's coupling functions (see sw_coupling), user = the contact. */
void sw_contact_part(void *contact, sw_system *system);
sw_status sw_contact_begin_stage(sw_contact *contact, double time, double first, sw_error *err);
sw_status sw_contact_eval(void *contact, sw_system *system, double time, double hbar,
                          const double *y, unsigned want, sw_error *err);
/* Its normals and friction are those of the last matrix: no touch slides, and the same ones press.
 */
sw_status sw_contact_keeps(void *contact, sw_system *system, const double *y, int *out,
                           sw_error *err);
void sw_contact_refine(void *contact, sw_system *system);
/* Those of the bodies that links tie together are refined with all that these touch. */
struct sw_spots;
void sw_contact_add_spots(sw_contact *contact, const sw_system *system, struct sw_spots *spots);
int sw_contact_settled(void *contact, sw_system *system, const double *y, const double *delta);

/* See sw_coupling. */
void sw_contact_book(void *contact, const sw_booking *booking);

/* The owner's number of obstacle number k; what that one is to remember of an accepted step. */
int sw_contact_id(const sw_contact *contact, size_t k);
const sw_contact_past *sw_contact_past_of(const sw_contact *contact, size_t k);
/* Numbers (count) of those that remember anything or may; the others remember nothing. */
const int *sw_contact_busy(const sw_contact *contact, size_t *count);
/* The same of those that may move. */
const int *sw_contact_movers(const sw_contact *contact, size_t *count);
/* By the owner's number: what an obstacle remembers of the last step, and 1 when it may move. */
typedef const sw_contact_past *(*sw_contact_past_function)(void *user, int id);
typedef int (*sw_contact_moves_function)(void *user, int id);
/* Has the owner told that since contact was made, was given a memory, or was told to ask again, for
 * an obstacle was moved by hand? Before a step it is to tell. */
int sw_contact_informed(const sw_contact *contact);
void sw_contact_recall(sw_contact *contact, sw_contact_past_function past,
                       sw_contact_moves_function moves);
void sw_contact_ask_again(sw_contact *contact);

/* 1: an obstacle is not where it was at the step's start, as last placed. */
int sw_contact_moves(const sw_contact *contact);

/* What is to be done with a trial step to positions x1 and velocities v1. dull: one of wires that
 * strike each other, which does not bounce. */
typedef enum sw_contact_verdict {
  SW_CONTACT_ACCEPT,
  SW_CONTACT_REDO,   /* impacts or crossings that the step did not know of: the
                        system's starting velocities were changed, contacts added;
                        redo the step from a restart */
  SW_CONTACT_SOONER, /* something rebounds within the step, when sw_contact_soonest says: the step
                        is to end there */
  SW_CONTACT_STRIKE, /* something struck: redo the step without bouncing */
  SW_CONTACT_SMALLER /* edges or corners cut too deep: only a smaller step helps */
} sw_contact_verdict;
sw_contact_verdict sw_contact_review(sw_contact *contact, sw_system *system, const double *x1,
                                     const double *v1, double h, int dull);

double sw_contact_soonest(const sw_contact *contact); /* after the step's start [s] */
/* A step that began is not to be cut shorter than this [s]. */
void sw_contact_cut(sw_contact *contact, double least);

/* The same for statics: segments of a solution x1 that went through an obstacle
 * are kept on their side from now on. 1 = there were some, solve again. */
int sw_contact_review_static(sw_contact *contact, sw_system *system, const double *x1);

/* The trial was accepted: keep friction anchors and sides for the next step. */
void sw_contact_commit(sw_contact *contact, sw_system *system);

/* Total force on obstacle o at the last state that was looked at, and its moment about a point [N],
 * [N m]. */
void sw_contact_force(const sw_contact *contact, int o, sw_vec about, sw_vec *force,
                      sw_vec *moment);
/* What holds wires by obstacle o, added up over its touches. */
typedef struct sw_contact_grip {
  double normal;  /* forces across the surface [N] */
  double most;    /* friction that these allow [N] */
  sw_vec tangent; /* friction on the wires [N] */
  sw_vec slip;    /* force times the way slid in the last step, of wires [N m] */
  double sliding; /* force of touches that slide [N] */
  double place;   /* force times arc length in its plan [N m] */
} sw_contact_grip;
void sw_contact_add_grip(const sw_contact *contact, const sw_system *system, int o,
                         sw_contact_grip *sum);
/* Deepest penetration of the accepted state, with the system's node nearest to
 * it [m]. */
double sw_contact_penetration(const sw_contact *contact, size_t *node);
/* Touches, for contact/tally.h. */
struct sw_presses sw_contact_presses(const sw_contact *contact);
/* What presses on a node, or on the segment between two. */
typedef struct sw_contact_push {
  int obstacle;        /* the owner's number */
  size_t node, other;  /* of the system; other is node again when that alone is pressed [-] */
  double at;           /* between both [-] */
  double normal_force; /* [N] */
  sw_vec force;        /* on the wire, with friction [N] */
  sw_vec normal;       /* the obstacle's, outward [-] */
  sw_vec slip;         /* way that it slid in the last step [m] */
  sw_vec point;        /* on the obstacle [m] */
  double place;        /* arc length [m] */
  double slid;         /* way that it slid since it began to press [m] */
} sw_contact_push;
/* All touches, also those without a force; number k of them: 0 when it has none. */
size_t sw_contact_touches(const sw_contact *contact);
/* Those from number *first up to *end are of nodes from node up to end_node. */
void sw_contact_touches_of(const sw_contact *contact, size_t node, size_t end_node, size_t *first,
                           size_t *end);
int sw_contact_push_at(const sw_contact *contact, const sw_system *system, size_t k,
                       sw_contact_push *out);

/* After a step: 1, obstacles' forces at its end are those of a shock, which it does not go on with.
 */
int sw_contact_shaken(const sw_contact *contact, const sw_system *system);
/* A trial step in which some obstacle gets a blow, harder than any that it got so far: its mean
 * over the step, over the weight of the wire that strikes or the force that bends it. 0: there is
 * none
 * [-]. followed: 1, does one that is followed in parts go on? */
double sw_contact_jolt(sw_contact *contact, const sw_system *system, int followed);

/* --- for the energy ledger, after a trial ------------------------------------- */

/* Where obstacle number id is at the step's start and as last placed. 0: there is none. */
int sw_contact_poses(const sw_contact *contact, int id, sw_pose *from, sw_pose *to);
/* 1: the touches that press are those that pressed at the step's start. */
int sw_contact_steady(const sw_contact *contact);
/* Given by touches of meshes being stiffer than before, which lets them sink in less, at most [J].
 */
double sw_contact_hardened(const sw_contact *contact);
double sw_contact_fastest(const sw_contact *contact); /* of obstacles at the step's end [m/s] */
/* 1: in this step wires are let out of obstacles that they began in. */
int sw_contact_emerges(const sw_contact *contact);
size_t sw_contact_impacts(const sw_contact *contact); /* dealt with in the step [-] */
double sw_contact_struck(const sw_contact *contact);  /* work of moving obstacles in these [J] */

/* Memory kept between steps (anchors and sides), for snapshots: a block to copy
 * and to give back. */
const void *sw_contact_memory(const sw_contact *contact, size_t *bytes);
/* SW_CONTACT_FRESH while no step was accepted: there is nothing to remember yet.
 * SW_CONTACT_EMERGING while wires that began inside of obstacles are let out of them; slowly, so
 * that they are not thrown. Else 0. */
enum { SW_CONTACT_FRESH = 1, SW_CONTACT_EMERGING = 2 };
int sw_contact_is_fresh(const sw_contact *contact);
sw_status sw_contact_set_memory(sw_contact *contact, const void *memory, size_t bytes, int fresh);
/* 1: memory that may have come from anywhere names nothing beyond these nodes and obstacles. */
int sw_contact_memory_fits(const void *memory, size_t bytes, size_t nodes, size_t obstacles);
/* What touches at the accepted state, which only read-outs look at, likewise. SW_EINVAL: it names
 * nodes (so many) or obstacles that there are not. */
const void *sw_contact_seen(const sw_contact *contact, size_t *bytes);
sw_status sw_contact_set_seen(sw_contact *contact, const void *seen, size_t bytes, size_t nodes);
/* A number that is another one when what these blocks consist of is, to tell files of another
 * version by. */
size_t sw_contact_layout(void);
/* 1: it says that a node of a wire without particles touches something, or a segment beside it. */
int sw_contact_memory_names(const void *memory, size_t bytes, size_t node);
/* Add what a memory says of nodes from old_first up to old_end, which are now numbered from
 * new_first, and obstacles of these numbers (count). SW_ENOMEM. */
sw_status sw_contact_add_memory(sw_contact *contact, const void *memory, size_t bytes,
                                size_t old_first, size_t old_end, size_t new_first,
                                const size_t *obstacles, size_t count);
/* The same from a contact whose nodes had other numbers: new_node gives for each
 * old number the new one, or SIZE_MAX when the node is gone; new_edge the same for
 * the segments that began there. */
sw_status sw_contact_inherit(sw_contact *contact, const void *memory, size_t bytes, int fresh,
                             const size_t *new_node, const size_t *new_edge);

#endif
