/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact law of one touch, for all kinds of bodies: normal force and anchored friction.
 * Normal: N = k max(0, -gap). Friction: a spring with return mapping, f = -k u while k |u| <= mu N,
 * else mu N against u and the anchor follows. Within an iteration friction uses the normal force of
 * the previous iterate (lag), which keeps the matrix symmetric and the sub-problem convex. */
#ifndef SW_TOUCH_LAW_H
#define SW_TOUCH_LAW_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vec.h"
#include "touch/keep.h"

/* Members that are used together lie together, because long lists are not in the cache. */
typedef struct sw_press {
  bool active : 1;       /* 1: pushes in this iterate */
  bool sliding : 1;      /* assumed in this iterate */
  bool next_sliding : 1; /* sliding after the last solve */
  bool by_place : 1;     /* 1: friction's direction follows from the place; 0: it is an unknown */
  bool let_go : 1;       /* 1: not active in the next iterate, at any gap */
  bool take_on : 1;      /* 1: active in the next iterate, at any gap */
  bool opened : 1;       /* 1: pushed until the refinement of this solve opened it */
  uint8_t spare;         /* solves with a pull after which it still stays active [-] */
  uint16_t alternations; /* sign changes of normal_force - lag up to the last iterate [-] */
  uint16_t reversals;    /* with by_place: of the slide in this stage, or in statics with moved
                            obstacles [-] */
  double normal_force;   /* normal force after the last solve [N] */
  double gap_after;      /* gap after the last solve [m] */
  double lag;            /* normal force used in friction [N] */
  double gap;            /* gap of the surfaces at this iterate [m] */
  double k;              /* stiffness, normal and tangential [N/m] */
  sw_vec normal;         /* direction of the push [-] */
  double soft;           /* k over the stiffness of friction's spring; 0 = as stiff [-] */
  double lag_at_first;   /* lag in the iterate's first solve [N] */
  double turning; /* while sliding: stiffness of friction against a turn of its direction [N/m] */
  sw_vec trial;   /* tangential displacement from the anchor at this iterate [m] */
  sw_vec shift;   /* shift by the last solve [m] */
  double lift;    /* if opened: the force that cancels its pull [N] */
  double off;     /* friction of the last solve minus friction by the law [N] */
  sw_vec pulls;   /* minus friction over its limit, at the iterate's start [-] */
  sw_vec ahead;   /* statics: friction is linearised at trial + ahead, along the surface [m] */
  double lag_before, force_before; /* lag and normal force one iterate earlier; 0 = not known [N] */
  sw_vec tangential;               /* friction force after the last solve [N] */
  sw_vec slip;                     /* the anchor's slide in the step [m] */
  sw_vec next_pulls;               /* pulls after the last solve [-] */
  sw_vec carried;                  /* slip up to this stage's start, by the stage's rule [m] */
} sw_press;

/* Stiffness of friction's spring [N/m]. */
static inline double sw_press_grip(const sw_press *p) {
  return p->soft > 0 ? p->k / p->soft : p->k;
}

/* Allowed depth of a touch [m]. A deeper touch is stiffened until it is not. Lines in motion, and
 * taut lines in statics, have the smaller depth SW_SHALLOW in obstacles, a share of the radius [-],
 * and so have lines that continue to press each other. With SW_DEEPEST the tension of a stiff wire
 * drawn through a narrow eyelet is 10 % too low, with SW_SHALLOW 2 %; with half of it the laying S3
 * costs 15 % more (spec/contact/eyelet_spec). Meshes and pads are softer than that. In other
 * statics, and within a step between wires, a fifth of SW_DEEPEST would cost iterations, and
 * overlapping wires would not come out smoothly. */
#define SW_DEEPEST 50e-6
#define SW_SHALLOW 0.004

/* Allowed depths are for wires of at least this radius. For thinner ones they are multiplied by the
 * ratio of their radius to this one; otherwise a wire of 0.05 mm radius would lie in the table by a
 * tenth of its radius [m]. */
#define SW_THIN 1e-3
static inline double sw_depth_for(double depth, double radius) {
  return radius < SW_THIN ? depth * (radius / SW_THIN) : depth;
}

/* Decides whether a touch pushes in this iterate. A touch that pushed after the last solve stays
 * active even if turning normals opened its gap a little; otherwise the wires would fall into each
 * other. The next solve decides. `spare` touches stay active after a pull too. last: the same touch
 * in the previous iterate, or NULL. */
void sw_press_activate(sw_press *press, const sw_press *last);

/* Sets the normal force used in friction, and whether the touch slides. Sources: last, the previous
 * iterate, or NULL, used for sliding if goes_on; kept, the last accepted step, NULL if the touch
 * did not press; else guess [N]. With the force of the last iterate alone, the force may alternate
 * without end, and grow where friction presses the touch; then a secant through the last two is
 * used. */
void sw_press_resume(sw_press *press, const sw_kept *kept, const sw_press *last, int goes_on,
                     double guess);

/* Begins friction at an iterate, when k, lag and trial are set. known: 1 = `sliding` is valid, 0 =
 * find it. With a stiff spring every prediction looks like a slide, so a prediction says little
 * about sticking. A spring far beyond its limit slides if it is also far beyond it with the
 * stiffness `felt` [N/m]. */
void sw_press_begin(sw_press *press, double friction, int known, double felt);

/* Sets the friction spring of a stage that begins at x0 + first (x1 - x0), where x1 is the result
 * of the step's first stage. The anchor starts with the same share of that stage's slip, so that
 * friction opposes the speed at the end of the stage. If friction opposed the motion since the
 * step's start, a slide that stops would alternate without end. u: displacement from the anchor at
 * the step's start [m]. last: the touch in the previous iterate, or NULL; same: 1 if last is of
 * this stage. */
void sw_press_aim(sw_press *press, sw_vec u, const sw_press *last, int same, double first);

/* Returns the force at this iterate, and its stiffness (upper half). lagged: 0 = explicit methods,
 * where friction uses this iterate's normal force. */
sw_vec sw_press_eval(sw_press *press, double friction, int lagged, double K[6]);

/* 1 if the touch pushes and slides in this iterate. */
int sw_press_slides(const sw_press *press, double friction);

/* 1 if, after an update by shift, the normal force differs from that used in friction by more than
 * the tolerance of the iteration. Only for sliding touches, whose friction must follow the normal
 * force within an iterate's linearisation. force_scale: see below [N]. */
int sw_press_lags(const sw_press *press, double friction, sw_vec shift, double force_scale);
/* Makes friction use the new normal force. Returns the change of the force on the wire [N]. */
sw_vec sw_press_follow(sw_press *press, double friction, sw_vec shift);
/* The same in two parts: sw_press_push returns the normal force after an update by shift [N];
 * sw_press_assume makes friction use a given normal force and returns the change. */
double sw_press_push(const sw_press *press, sw_vec shift);
sw_vec sw_press_assume(sw_press *press, double friction, double force);
/* Makes friction use the normal force of the iterate's first solve again. Returns the change
 * [N]. */
sw_vec sw_press_unfollow(sw_press *press, double friction);
/* Normal force after an update minus the force that friction used, absolute [N]. */
double sw_press_off(const sw_press *press, double friction, sw_vec shift);
/* 1 if the touch would pull after an update by shift. Then it opens and has no force. */
int sw_press_pulls(const sw_press *press, sw_vec shift);
/* 1 if the wire would be inside after an update by shift. */
int sw_press_sinks(const sw_press *press, sw_vec shift);
/* 1 if the wire would pass an inactive touch in an update by shift. Then the touch closes. It has
 * moved freely, so it slides, with the friction of the coming normal force. */
int sw_press_closes(const sw_press *press, sw_vec shift);
void sw_press_close(sw_press *press);
/* 1 if an opened touch stays open after an update by shift and nothing is left of its friction. */
int sw_press_opens(const sw_press *press, sw_vec shift, double force_scale);

/* 1 if the gap is as small as a script can place it. */
int sw_press_lies(const sw_press *press);

/* 1 if wires must have been placed this deep: nothing touched there before, and no touch gets this
 * deep within a step. first: 1 if nothing touched anywhere. */
int sw_press_was_put(double depth, int first);

/* Speeds of wires that come out because they are deeper than their force explains [m/s]. SW_LET_OUT
 * throws nothing; it is for lines at rest, for meshes, whose sections may stand off their line, and
 * for wires that were placed in each other. SW_PART, the highest, is for wires whose touch with
 * each other is found within a run. */
#define SW_LET_OUT 0.005
#define SW_PART 0.2

/* Splits a depth at the step's start. kept: memory of the touch, or NULL. way: largest correction
 * of depth that the force does not explain [m]. Wires that were placed in each other, or that leave
 * a barrier, come out slowly: within one step the depth would become speed. */
typedef struct sw_left {
  double forgiven; /* depth that the step does not correct [m] */
  double let_out; /* unexplained depth that the step removes; 0 if it is only rounding, as of a wire
                     laid on a table [m] */
  double left;    /* part of forgiven that the touch keeps (sw_kept.left) [m] */
} sw_left;
sw_left sw_press_leave(double depth, const sw_kept *kept, double way);

/* Sets the forces after an update that shifted the touch. Returns 1 if they agree with the
 * assumptions of the solve. force_scale: much smaller forces do not matter [N]. */
int sw_press_update(sw_press *press, double friction, sw_vec shift, double force_scale);

/* Friction of several touches after an update: its total error, and its total limit [N]. Many
 * touches may never agree one by one. sw_press_enough: 1 if the total error is within the tolerance
 * of one touch. */
typedef struct sw_rubbing {
  double off, most;
} sw_rubbing;
void sw_press_weigh(const sw_press *press, double friction, sw_rubbing *sum);
int sw_press_enough(const sw_rubbing *sum);
/* The total error counts after this many updates of a stage [-]. */
enum { SW_PATIENCE = 6 };

/* Force on the wire in the last solve, the force that moved the wire. It differs from the law's
 * force by no more than the tolerance of the iteration [N]. */
sw_vec sw_press_borne(const sw_press *press, double friction);

/* 1 if the gap after the last update is open where nothing pushed, or closed where a touch
 * pushed. */
int sw_press_apart(const sw_press *press);

/* 1 if a step is so short compared with the nominal one that inertia alone keeps a depth. 0 in
 * statics: short pseudo steps would leave the depth in the scene, and the first step of motion
 * would turn it into speed. */
int sw_press_is_short(int statics, double h, double nominal);

/* Depth above which a squeezed touch is stiffened at once. deepest: allowed depth, here and below
 * [m]. */
double sw_press_squeezed(double forgiven, double before, double deepest);

/* Stiffness from the next iterate on: higher for a touch that is too deep, else unchanged [N/m].
 * usual: stiffness of a new touch; axial: stiffness of the wire's edge, because a taut wire presses
 * with forces unrelated to its weight. before: a touch is not stiffened up to this depth, for wires
 * in a short step and squeezed touches; else negative [m]. forgiven: see sw_left. */
double sw_press_stiffer(const sw_press *press, double usual, double axial, double deepest,
                        double forgiven, double before);

#endif
