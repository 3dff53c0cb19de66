/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of wires with rigid obstacles: normal force, anchored Coulomb friction, impacts, and the
 * swept test that keeps fast wires from passing thin walls. It is one sw_coupling of the system. */
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
  double friction;    /* coefficient while the wire sticks [-] */
  double kinetic;     /* coefficient while it slides [-] */
  double restitution; /* [-] */
  double grips;       /* wanted force of a gripper's pad, INFINITY = any; 0 = no pad [N] */
  int id;             /* the owner's number; part of the memory's key */
  int off;            /* 1: nothing touches it */
} sw_contact_obstacle;

/* Load of wires on an obstacle: force and moment about the obstacle's pivot [N], [N m]. Also used
 * for impulses [N s], [N m s]. */
typedef struct sw_contact_load {
  sw_vec force, moment;
} sw_contact_load;

/* Load of an obstacle in the last step. The owner stores it, because contact is rebuilt when the
 * scene changes. */
typedef struct sw_contact_past {
  sw_contact_load mean;   /* mean over the step, with blows; in statics the load of the state; its
                             moment is about the world's origin [N], [N m] */
  sw_contact_load end;    /* at the step's end, for methods that begin the next step with it [N] */
  double hardest;         /* hardest blow that was followed in parts: its mean over a step [N] */
  sw_contact_load gained; /* impulse without blows, for methods that use earlier steps [N s] */
} sw_contact_past;

/* Gives the position and motion of obstacle number o (the owner's number) at a time. */
typedef sw_status (*sw_contact_place)(void *user, int o, double time, sw_motion_state *out,
                                      sw_error *err);

/* Makes a contact over copies of these obstacles. Their ids must ascend. SW_ENOMEM. */
sw_status sw_contact_new(const sw_contact_obstacle *obstacles, size_t count, sw_contact_place place,
                         void *user, sw_contact **out);
/* Makes a copy with the same obstacles and memory, for a look ahead. SW_ENOMEM. */
sw_status sw_contact_copy(const sw_contact *contact, sw_contact **out);
void sw_contact_free(sw_contact *contact);
/* Keeps only the obstacles with these owner's numbers (count). */
void sw_contact_keep(sw_contact *contact, const size_t *ids, size_t count);
void sw_contact_slip(sw_contact *contact); /* takes friction from all but pads that grip */

/* How the coming steps are computed. This decides the normal stiffness. */
typedef enum sw_contact_regime {
  SW_CONTACT_STATIC,
  SW_CONTACT_IMPLICIT,
  SW_CONTACT_EXPLICIT
} sw_contact_regime;

/* Stiffness of a body's touch that carries at most this force: base plus rate2 times the mass at
 * the touch [N/m], [1/s2]. */
void sw_contact_stiffness(sw_contact_regime regime, const sw_plan *plan, double force,
                          double nominal, double *base, double *rate2);
/* Smallest stiffness of a particle's touches with other objects, not in explicit steps [N/m]. */
double sw_contact_hardness(const sw_web *web, size_t particle);
/* Begins a step of size h (in statics a pseudo step, or 0) at time t: places the obstacles. */
sw_status sw_contact_open(sw_contact *contact, double t, double h, sw_error *err);
/* Call next: wakes waiting bodies that may be disturbed in the step (system/wait.h), then finds
 * candidates. nominal: the run's full step, which determines the stiffness; in statics h. */
sw_status sw_contact_wake(sw_contact *contact, sw_system *system, sw_error *err);
sw_status sw_contact_begin_step(sw_contact *contact, sw_system *system, sw_contact_regime regime,
                                double nominal, sw_error *err);
/* Call before the first motion of a body: moves meshes of elements without holds out of obstacles
 * into which they were drawn a little. is_new: 1 for a body that was just remodelled. */
sw_status sw_contact_clear(sw_contact *contact, sw_system *system, double t,
                           int (*is_new)(void *, size_t), void *user, sw_error *err);
/* Call after the step: bodies on their way out of an obstacle must not stop. */
void sw_contact_keep_moving(const sw_contact *contact, sw_system *system);
/* Begins to evaluate the accepted state. A touch's stiffness is its last force over its depth. */
sw_status sw_contact_begin_look(sw_contact *contact, sw_system *system, double t, sw_error *err);

/* The system's coupling functions (see sw_coupling), user = the contact. */
void sw_contact_part(void *contact, sw_system *system);
sw_status sw_contact_begin_stage(sw_contact *contact, double time, double first, sw_error *err);
sw_status sw_contact_eval(void *contact, sw_system *system, double time, double hbar,
                          const double *y, unsigned want, sw_error *err);
/* *out = 1: the last matrix is still valid, because no touch slides and the same touches press. */
sw_status sw_contact_keeps(void *contact, sw_system *system, const double *y, int *out,
                           sw_error *err);
void sw_contact_refine(void *contact, sw_system *system);
/* Adds the touches of bridged bodies to a list. These bodies are refined together. */
struct sw_spots;
struct sw_ways;
void sw_contact_add_spots(sw_contact *contact, const sw_system *system, struct sw_spots *spots);
void sw_contact_add_ways(sw_contact *contact, const sw_system *system, struct sw_ways *ways);
int sw_contact_settled(void *contact, sw_system *system, const double *y, const double *delta);

/* See sw_coupling. */
void sw_contact_book(void *contact, const sw_booking *booking);
/* Impulse of the wires on obstacle `id` booked so far in the step, without impacts; its moment is
 * about the obstacle's place [N s], [N m s]. */
void sw_contact_gained(const sw_contact *contact, int id, sw_vec *force, sw_vec *moment);

/* The owner's number of obstacle k; its load in the last accepted step. */
int sw_contact_id(const sw_contact *contact, size_t k);
const sw_contact_past *sw_contact_past_of(const sw_contact *contact, size_t k);
/* Numbers (count) of the only obstacles that have a load or may get one in this step. */
const int *sw_contact_busy(const sw_contact *contact, size_t *count);
/* Numbers (count) of the obstacles that may move. */
const int *sw_contact_movers(const sw_contact *contact, size_t *count);
/* By the owner's number: the load in the last step; 1 if the obstacle may move. */
typedef const sw_contact_past *(*sw_contact_past_function)(void *user, int id);
typedef int (*sw_contact_moves_function)(void *user, int id);
/* 1 if sw_contact_recall was called since contact was built, got a memory, or an obstacle was moved
 * by hand. The owner must call it before a step. sw_contact_ask_again demands it. */
int sw_contact_informed(const sw_contact *contact);
void sw_contact_recall(sw_contact *contact, sw_contact_past_function past,
                       sw_contact_moves_function moves);
void sw_contact_ask_again(sw_contact *contact);
/* Largest shift of an obstacle since the step's start, its turn at this lever included [m]. */
double sw_contact_shift(const sw_contact *contact, double lever);

/* Result of a review of the trial positions x1 and velocities v1. dull: 1 if the step does not
 * rebound, as in steps in which wires strike each other. */
typedef enum sw_contact_verdict {
  SW_CONTACT_ACCEPT,
  SW_CONTACT_REDO,   /* starting velocities or contacts were changed: repeat the step */
  SW_CONTACT_SOONER, /* a rebound within the step: end the step at sw_contact_soonest */
  SW_CONTACT_STRIKE, /* something struck: repeat the step without rebound */
  SW_CONTACT_SMALLER /* wires got too deep, or free: only a smaller step helps */
} sw_contact_verdict;
sw_contact_verdict sw_contact_review(sw_contact *contact, sw_system *system, const double *x1,
                                     const double *v1, double h, int dull);
double sw_contact_soonest(const sw_contact *contact); /* of a rebound, after the step's start [s] */
/* Sets the earliest time at which a rebound may cut the step [s]. */
void sw_contact_cut(sw_contact *contact, double least);
/* Call if a drive on which wires slide comes to rest soon: friction is then as stiff as a wire. */
void sw_contact_brake(sw_contact *contact);
/* Sets the wanted size of the part (substep) [s]. Touches that slowly get deeper in parts of this
 * size are stiffened as in whole steps. adaptive: 1: steps follow their error. */
void sw_contact_ask(sw_contact *contact, double part, int adaptive);

/* First guess of a pose: nodes (x) go with the pads that hold them, or with moving obstacles on
 * which they stick, from the step's start. */
sw_status sw_contact_carry(sw_contact *contact, const sw_system *system, double time, double *x,
                           sw_error *err);
/* Reviews a static solution x1. Segments that passed an obstacle are kept on their side from now
 * on. Returns 1 if there are any: solve again. */
int sw_contact_review_static(sw_contact *contact, sw_system *system, const double *x1);
/* Accepts the trial: stores friction anchors and sides. holds: 1: see sw_kept_hold_slide. */
void sw_contact_commit(sw_contact *contact, sw_system *system, int holds);

/* Total force on obstacle o (the owner's number) in the last evaluation; its moment [N], [N m]. */
void sw_contact_force(const sw_contact *contact, int o, sw_vec about, sw_vec *force,
                      sw_vec *moment);
/* Largest penetration of the accepted state, and the nearest node [m]. */
double sw_contact_penetration(const sw_contact *contact, size_t *node);
/* The lists of touches for touch/tally.h: of solved wires, and of waiting wires. */
struct sw_presses sw_contact_presses(const sw_contact *contact);
struct sw_presses sw_contact_still_presses(const sw_contact *contact);
/* Pressure on a node or on a segment. */
typedef struct sw_contact_push {
  int obstacle;                  /* the owner's number */
  size_t node, other;            /* of the system; other = node if only the node is pressed [-] */
  double at;                     /* place between both nodes [-] */
  double normal_force, friction; /* [N]; coefficient [-] */
  sw_vec force;                  /* on the wire, with friction [N] */
  sw_vec normal;                 /* the obstacle's, outward [-] */
  sw_vec slip;                   /* sliding way in the last step [m] */
  int slides;                    /* 1: its friction is used up */
  sw_vec point, acts; /* on the obstacle; of the force: on the axis or a rolling surface [m] */
  double place;       /* arc length [m] */
  double slid;        /* sliding way since the touch began to press [m] */
} sw_contact_push;
/* Number of touches, with or without a force. sw_contact_push_at reads touch k and returns 0 if it
 * has no force. sw_contact_pusher returns the obstacle that pushes at touch k; -1: no force.
 * sw_contact_slides: 1 if it pushes, has friction and slid by more than least in the step [m]. */
size_t sw_contact_touches(const sw_contact *contact);
int sw_contact_pusher(const sw_contact *contact, size_t k);
int sw_contact_slides(const sw_contact *contact, size_t k, double least);
double sw_contact_slid(const sw_contact *contact); /* the largest `slid`, also after a rebuild */
/* Touches of nodes from node to before end_node: from *first to before *end. */
void sw_contact_touches_of(const sw_contact *contact, size_t node, size_t end_node, size_t *first,
                           size_t *end);
int sw_contact_push_at(const sw_contact *contact, const sw_system *system, size_t k,
                       sw_contact_push *out);
/* Largest force of some touches [N]; 0 if surely none of a body's is above a force (quick) [N]. */
double sw_contact_largest_push(const sw_contact *contact, size_t first, size_t end);
int sw_contact_may_press(const sw_contact *contact, size_t body, double force);
/* Largest radius of round obstacles that press on a wire within one edge of a node; 0: none [m]. */
double sw_contact_round_beside(const sw_contact *contact, const sw_system *system, size_t node);

/* After a step: 1 if the obstacles' forces come from a shock; the next may not begin with them. */
int sw_contact_shaken(const sw_contact *contact, const sw_system *system);
/* Two obstacles face each other if the cosine between their normals is below this [-]. */
#define SW_FACING (-0.7)
int sw_contact_on_facets(const sw_contact *contact); /* 1: facets of a round surface bear wires */
/* A wire's weight; without gravity, its bending force EI/L^2 [N]. */
double sw_contact_usual_force(const sw_system *system, const sw_plan *plan);
/* From this force on a wire is squeezed or taut, and cannot come out; 0 for a mesh [N]. */
double sw_contact_squeezing_force(const sw_system *system, const sw_plan *plan);
/* Axial stiffness of the edge at a node; 0 for a mesh or a loose particle [N/m]. */
double sw_contact_edge_stiffness(const sw_system *system, size_t body, size_t node);

/* --- for the energy ledger, after a trial ------------------------------------- */
/* Call after a pose that began at t: its start is there, also if it was found in parts. */
sw_status sw_contact_began(sw_contact *contact, double t, sw_error *err);
/* Poses of obstacle id (of its owner) at the step's start and as last placed; 0: there is none. */
int sw_contact_poses(const sw_contact *contact, int id, sw_pose *from, sw_pose *to);
int sw_contact_steady(const sw_contact *contact); /* 1: the same touches press, nothing struck */
double sw_contact_hardened(const sw_contact *contact); /* most gain of stiffened touches [J] */
double sw_contact_unbent(const sw_contact *contact);   /* work of arcs that become flatter [J] */
double sw_contact_fastest(const sw_contact *contact); /* fastest obstacle at the step's end [m/s] */
int sw_contact_emerges(const sw_contact *contact); /* 1: wires are on their way out of obstacles */
double sw_contact_emerged(const sw_contact *contact); /* work of touches on such wires [J] */
size_t sw_contact_impacts(const sw_contact *contact); /* impacts treated in the step [-] */
double sw_contact_struck(const sw_contact *contact);  /* work of moving obstacles in impacts [J] */

/* Memory kept between steps (anchors and sides): a block to copy, for snapshots. */
const void *sw_contact_memory(const sw_contact *contact, size_t *bytes);
/* SW_CONTACT_FRESH: no step was accepted yet, and there is no memory. SW_CONTACT_EMERGING: wires
 * that began inside obstacles come out slowly, so that they are not thrown. Else 0. */
enum { SW_CONTACT_FRESH = 1, SW_CONTACT_EMERGING = 2 };
int sw_contact_is_fresh(const sw_contact *contact);
sw_status sw_contact_set_memory(sw_contact *contact, const void *memory, size_t bytes, int fresh);
/* 1 if it names only existing nodes and obstacles. */
int sw_contact_memory_fits(const void *memory, size_t bytes, size_t nodes, size_t obstacles);
/* The touches at the accepted state, as a block for read-outs only. SW_EINVAL: the block names
 * nodes (of this many) or obstacles that do not exist. */
const void *sw_contact_seen(sw_contact *contact, size_t *bytes);
sw_status sw_contact_set_seen(sw_contact *contact, const void *seen, size_t bytes,
                              const sw_system *system);
size_t sw_contact_layout(void); /* a number that changes with the layout of these blocks */
/* 1 if the memory contains a wire's node, or a segment that begins or ends there. */
int sw_contact_memory_names(const void *memory, size_t bytes, size_t node);
/* Adds the memory of nodes from old_first up to old_end (exclusive), for these obstacles (count)
 * only. The nodes are renumbered to begin at new_first. SW_ENOMEM. */
sw_status sw_contact_add_memory(sw_contact *contact, const void *memory, size_t bytes,
                                size_t old_first, size_t old_end, size_t new_first,
                                const size_t *obstacles, size_t count);
/* Takes the memory of a contact with other node numbers. new_node: the new number of each old node,
 * SIZE_MAX if it is gone; new_edge: the same for segments, by their first node. SW_ENOMEM. */
sw_status sw_contact_inherit(sw_contact *contact, const void *memory, size_t bytes, int fresh,
                             const size_t *new_node, const size_t *new_edge);

#endif
