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
  double grips;       /* of a gripper's pad: its wanted force, INFINITY = any; 0 = no pad [N] */
  int id;             /* the owner's number; part of the memory's key */
  int off;            /* 1: nothing touches it */
} sw_contact_obstacle;

/* Load of wires on an obstacle: force and moment about the obstacle's pivot [N], [N m]; or
 * their impulses [N s], [N m s]. */
typedef struct sw_contact_load {
  sw_vec force, moment;
} sw_contact_load;

/* Load of an obstacle in the last step. The owner keeps it, because contact is built anew. */
typedef struct sw_contact_past {
  sw_contact_load mean; /* mean over the step, with blows; in statics of the state; moment about the
                           world's origin [N], [N m] */
  sw_contact_load end;  /* at the step's end, for a method that begins the next step with it [N] */
  double hardest;       /* mean over a step of the hardest blow that was followed in parts [N] */
  sw_contact_load gained; /* of the step without blows, for methods that use earlier steps [N s] */
} sw_contact_past;

/* Where obstacle number o is at a time. */
typedef sw_status (*sw_contact_place)(void *user, int o, double time, sw_motion_state *out,
                                      sw_error *err);

/* Takes copies. SW_ENOMEM. */
sw_status sw_contact_new(const sw_contact_obstacle *obstacles, size_t count, sw_contact_place place,
                         void *user, sw_contact **out);
/* A copy over the same obstacles with the same memory, for a look ahead; the original does not
 * change. SW_ENOMEM. */
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
/* Least stiffness of touches between a particle and other objects, but for explicit steps [N/m]. */
double sw_contact_hardness(const sw_web *web, size_t particle);

/* A step of size h begins at time t and the system's state: finds candidates. nominal: the run's
 * full step, which sets the stiffness. In statics both are the pseudo step, h = 0 without one. */
sw_status sw_contact_begin_step(sw_contact *contact, sw_system *system, sw_contact_regime regime,
                                double t, double h, double nominal, sw_error *err);

/* Evaluations at the accepted state begin. Each touch has the stiffness force over depth of the
 * last step. */
sw_status sw_contact_begin_look(sw_contact *contact, sw_system *system, double t, sw_error *err);

/* The system's coupling functions (see sw_coupling), user = the contact. */
void sw_contact_part(void *contact, sw_system *system);
sw_status sw_contact_begin_stage(sw_contact *contact, double time, double first, sw_error *err);
sw_status sw_contact_eval(void *contact, sw_system *system, double time, double hbar,
                          const double *y, unsigned want, sw_error *err);
/* 1: the last matrix holds. No touch slides, and the same touches press. */
sw_status sw_contact_keeps(void *contact, sw_system *system, const double *y, int *out,
                           sw_error *err);
void sw_contact_refine(void *contact, sw_system *system);
/* Bodies that are bridged are refined together, with all their touches. */
struct sw_spots;
struct sw_ways;
void sw_contact_add_spots(sw_contact *contact, const sw_system *system, struct sw_spots *spots);
void sw_contact_add_ways(sw_contact *contact, const sw_system *system, struct sw_ways *ways);
int sw_contact_settled(void *contact, sw_system *system, const double *y, const double *delta);

/* See sw_coupling. */
void sw_contact_book(void *contact, const sw_booking *booking);
/* What is booked so far in the step for an obstacle that is there, by the owner's number: impulse
 * and moment of impulse of the wires on it, about a point; without those of impacts [N s], [N m s].
 */
void sw_contact_gained(const sw_contact *contact, int id, sw_vec about, sw_vec *force,
                       sw_vec *moment);

/* The owner's number of obstacle number k; what it remembers of an accepted step. */
int sw_contact_id(const sw_contact *contact, size_t k);
const sw_contact_past *sw_contact_past_of(const sw_contact *contact, size_t k);
/* Numbers (count) of the obstacles with a memory; all others have none. */
const int *sw_contact_busy(const sw_contact *contact, size_t *count);
/* The same of those that may move. */
const int *sw_contact_movers(const sw_contact *contact, size_t *count);
/* By the owner's number: the obstacle's memory of the last step; 1: it may move. */
typedef const sw_contact_past *(*sw_contact_past_function)(void *user, int id);
typedef int (*sw_contact_moves_function)(void *user, int id);
/* Has the owner told these since contact was built, got a memory, or had an obstacle moved by hand?
 * It must before a step. */
int sw_contact_informed(const sw_contact *contact);
void sw_contact_recall(sw_contact *contact, sw_contact_past_function past,
                       sw_contact_moves_function moves);
void sw_contact_ask_again(sw_contact *contact);

/* 1: an obstacle has moved since the step's start. */
int sw_contact_moves(const sw_contact *contact);

/* Judges a trial step to positions x1 and velocities v1. dull: a step without rebounds, for wires
 * that strike each other. */
typedef enum sw_contact_verdict {
  SW_CONTACT_ACCEPT,
  SW_CONTACT_REDO, /* the step met impacts or crossings: starting velocities have changed, contacts
                      were added; restart the step */
  SW_CONTACT_SOONER, /* a rebound within the step: end the step at sw_contact_soonest */
  SW_CONTACT_STRIKE, /* something struck: redo the step without bouncing */
  SW_CONTACT_SMALLER /* edges or corners cut too deep: only a smaller step helps */
} sw_contact_verdict;
sw_contact_verdict sw_contact_review(sw_contact *contact, sw_system *system, const double *x1,
                                     const double *v1, double h, int dull);

double sw_contact_soonest(const sw_contact *contact); /* after the step's start [s] */
/* A step that began is not to be cut shorter than this [s]. */
void sw_contact_cut(sw_contact *contact, double least);
/* It was to be taken in parts of this size: touches that slowly get deeper in these are made
 * stiffer as in whole steps [s]. */
void sw_contact_ask(sw_contact *contact, double part);

/* The same for statics. Segments of a solution x1 that passed an obstacle are kept on their side
 * from now on. 1 = there are some, solve again. */
int sw_contact_review_static(sw_contact *contact, sw_system *system, const double *x1);

/* The trial was accepted: keep friction anchors and sides for the next step. */
void sw_contact_commit(sw_contact *contact, sw_system *system);

/* Total force on obstacle o at the last evaluated state, and its moment about a point [N], [N m].
 */
void sw_contact_force(const sw_contact *contact, int o, sw_vec about, sw_vec *force,
                      sw_vec *moment);
/* What holds wires by obstacle o, added up over its touches. */
typedef struct sw_contact_grip {
  double normal;  /* forces across the surface [N] */
  double most;    /* friction that these allow [N] */
  sw_vec tangent; /* friction on the wires [N] */
  sw_vec slip;    /* sum of force times sliding way in the last step, of wires [N m] */
  double sliding; /* force of touches that slide [N] */
  double place;   /* sum of force times arc length in the wire's plan [N m] */
} sw_contact_grip;
void sw_contact_add_grip(const sw_contact *contact, const sw_system *system, int o,
                         sw_contact_grip *sum);
/* Deepest penetration of the accepted state, with the system's node nearest to
 * it [m]. */
double sw_contact_penetration(const sw_contact *contact, size_t *node);
/* Touches, for contact/tally.h. */
struct sw_presses sw_contact_presses(const sw_contact *contact);
/* Pressure on a node or on a segment. */
typedef struct sw_contact_push {
  int obstacle;        /* the owner's number */
  size_t node, other;  /* of the system; other = node if only the node is pressed [-] */
  double at;           /* between both [-] */
  double normal_force; /* [N] */
  sw_vec force;        /* on the wire, with friction [N] */
  sw_vec normal;       /* the obstacle's, outward [-] */
  sw_vec slip;         /* sliding way in the last step [m] */
  sw_vec point;        /* on the obstacle [m] */
  double place;        /* arc length [m] */
  double slid;         /* sliding way since it began to press [m] */
} sw_contact_push;
/* All touches, also those without a force; number k of them: 0 when it has none. */
size_t sw_contact_touches(const sw_contact *contact);
/* Those from number *first up to *end are of nodes from node up to end_node. */
void sw_contact_touches_of(const sw_contact *contact, size_t node, size_t end_node, size_t *first,
                           size_t *end);
int sw_contact_push_at(const sw_contact *contact, const sw_system *system, size_t k,
                       sw_contact_push *out);

/* After a step. 1: the obstacles' forces at its end come from a shock, and the next step must not
 * begin with them. */
int sw_contact_shaken(const sw_contact *contact, const sw_system *system);
/* Two obstacles face each other where the cosine of their normals is below this [-]. */
#define SW_FACING (-0.7)
/* A wire's weight; of one without, the force that bends it [N]. */
double sw_contact_usual_force(const sw_system *system, const sw_plan *plan);
/* Force of a touch from which on the wire is squeezed, or taut, and cannot come out; 0: of a mesh,
 * which may [N]. */
double sw_contact_squeezing_force(const sw_system *system, const sw_plan *plan);
/* Axial stiffness of the edge that begins or ends at a node; 0: of a mesh, or a loose particle
 * [N/m]. */
double sw_contact_edge_stiffness(const sw_system *system, size_t body, size_t node);

/* --- for the energy ledger, after a trial ------------------------------------- */

/* Where obstacle number id is at the step's start and as last placed. 0: there is none. */
int sw_contact_poses(const sw_contact *contact, int id, sw_pose *from, sw_pose *to);
/* 1: the touches that press are those that pressed at the step's start. */
int sw_contact_steady(const sw_contact *contact);
/* Largest energy given by stiffer touches of meshes, which sink in less than before [J]. */
double sw_contact_hardened(const sw_contact *contact);
double sw_contact_fastest(const sw_contact *contact); /* of obstacles at the step's end [m/s] */
/* 1: in this step wires come out of obstacles that they began in. */
int sw_contact_emerges(const sw_contact *contact);
size_t sw_contact_impacts(const sw_contact *contact); /* dealt with in the step [-] */
double sw_contact_struck(const sw_contact *contact);  /* work of moving obstacles in these [J] */

/* Memory kept between steps (anchors and sides), for snapshots: a block to copy
 * and to give back. */
const void *sw_contact_memory(const sw_contact *contact, size_t *bytes);
/* SW_CONTACT_FRESH: no step was accepted yet, and there is no memory. SW_CONTACT_EMERGING: wires
 * that began inside of obstacles come out slowly, so that they are not thrown. Else 0. */
enum { SW_CONTACT_FRESH = 1, SW_CONTACT_EMERGING = 2 };
int sw_contact_is_fresh(const sw_contact *contact);
sw_status sw_contact_set_memory(sw_contact *contact, const void *memory, size_t bytes, int fresh);
/* 1: a memory of any origin names only existing nodes and obstacles. */
int sw_contact_memory_fits(const void *memory, size_t bytes, size_t nodes, size_t obstacles);
/* The touches at the accepted state, for read-outs only; likewise. SW_EINVAL: it names nodes (of so
 * many) or obstacles that do not exist. */
const void *sw_contact_seen(const sw_contact *contact, size_t *bytes);
sw_status sw_contact_set_seen(sw_contact *contact, const void *seen, size_t bytes, size_t nodes);
/* Changes with the layout of these blocks: tells files of another version. */
size_t sw_contact_layout(void);
/* 1: a node of a wire without particles, or a segment beside it, touches something. */
int sw_contact_memory_names(const void *memory, size_t bytes, size_t node);
/* Adds the memory of nodes from old_first up to old_end, numbered from new_first now, and of these
 * obstacles (count). SW_ENOMEM. */
sw_status sw_contact_add_memory(sw_contact *contact, const void *memory, size_t bytes,
                                size_t old_first, size_t old_end, size_t new_first,
                                const size_t *obstacles, size_t count);
/* The same from a contact with other node numbers. new_node: the new number of each old node,
 * SIZE_MAX if it is gone; new_edge: the same for segments by their first node. */
sw_status sw_contact_inherit(sw_contact *contact, const void *memory, size_t bytes, int fresh,
                             const size_t *new_node, const size_t *new_edge);

#endif
