/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The law of one touch, whatever touches: normal force and anchored friction. Normal:
 * N = k max(0, -gap). Friction: a spring with return mapping, f = -k u while
 * k |u| <= mu N, else mu N against u and the anchor follows. Within an iteration friction
 * takes the normal force of the iterate before (lag), which keeps the matrix symmetric and
 * the sub-problem convex. */
#ifndef SW_CONTACT_LAW_H
#define SW_CONTACT_LAW_H

#include "base/vec.h"

typedef struct sw_press {
  double gap;          /* of the surfaces at this iterate [m] */
  double gap_after;    /* after the last solve [m] */
  double k;            /* stiffness, normal and tangential [N/m] */
  double soft;         /* friction's spring is so many times softer; 0 = it is not [-] */
  double lag;          /* normal force that friction takes as given [N] */
  double lag_at_first; /* the same in the iterate's first solve [N] */
  double turning;      /* stiffness of a sliding one's friction against turns [N/m] */
  double normal_force; /* after the last solve [N] */
  double lag_before, force_before; /* both, one iterate earlier; 0 = not known [N] */
  sw_vec normal;                   /* of the push [-] */
  sw_vec carried; /* how far the anchor slid in the step until this stage began, by its rule [m] */
  sw_vec pulls;   /* friction that the iterate begins with, over what it can be, against it [-] */
  sw_vec trial;   /* tangential displacement from that anchor at this iterate [m] */
  sw_vec ahead;   /* statics: how far from that its friction is linearised, along the surface [m] */
  sw_vec tangential; /* friction force after the last solve [N] */
  sw_vec next_pulls; /* pulls, as the last solve found it [-] */
  sw_vec shift;      /* by the last solve [m] */
  sw_vec slip;       /* how far the anchor slid in the step [m] */
  int alternations;  /* of normal_force - lag until the last iterate [-] */
  int by_place;      /* 1: friction's direction is that of the place, no unknown of its own */
  int reversals;     /* then: of the slide in this stage, or where a static solve is dragged [-] */
  double off;        /* friction that the last solve reckoned with, less that of the law [N] */
  int active;        /* pushes in this iterate */
  int let_go;        /* 1: not active in the next iterate, whatever its gap */
  int take_on;       /* 1: active in the next iterate, whatever its gap */
  int opened;        /* it pushed, until its solution */
  double lift;       /* then: the force that takes its pull away [N] */
  int spare;         /* so often it stays active though the last solve pulled [-] */
  int sliding;       /* assumed in this iterate */
  int next_sliding;  /* as the last solve found it */
} sw_press;

/* Stiffness of friction's spring [N/m]. */
static inline double sw_press_grip(const sw_press *p) {
  return p->soft > 0 ? p->k / p->soft : p->k;
}

/* What a touch keeps of all that from step to step, whatever touches. */
typedef struct sw_kept {
  double normal_force; /* 0: near, but without force [N] */
  double depth;        /* that goes with it [m] */
  double k;            /* to begin the next step with [N/m] */
  double steady;       /* normal force that it has had for a while; so far, that at the end [N] */
  double soft;         /* as above [-] */
  sw_vec elastic;      /* displacement of friction's spring [m] */
  int sliding;
} sw_kept;

/* At a step's end. usual: of a new touch, stiffer: from the next iterate on [N/m]. It goes on as
 * stiff as it was, for a change would be a kick, but one that was made stiffer than it has to be
 * gives way slowly. */
sw_kept sw_press_keep(const sw_press *press, double usual, double stiffer);
/* The other way round, as the force was over its depth: for what looks at an accepted state. */
void sw_kept_as_felt(sw_kept *kept);
sw_press sw_press_felt(const sw_kept *kept);

/* A touch that pushed after the last solve goes on in this iterate even if turning normals
 * have opened its gap a little: letting go of it would let the wires fall into each other.
 * The next solve tells. Nor does the first pull end a touch with spare ones. last: the same touch
 * in the iterate before, or NULL. */
void sw_press_activate(sw_press *press, const sw_press *last);

/* The normal force for friction to take as given, and whether it slides, by what is known: kept, at
 * the last accepted step, NULL if it did not press; last, in the iterate before, or NULL, which
 * counts when the touch goes on; else guess [N]. Taking just the last iterate's force may go to and
 * fro for ever, more at each turn where friction presses the touch: then by the secant through the
 * last two. */
void sw_press_resume(sw_press *press, const sw_kept *kept, const sw_press *last, int goes_on,
                     double guess);

/* Friction begins at an iterate: k, lag and trial are set. known: 1 = it slides as sliding
 * says, 0 = find out. A predicted place says little about sticking, as a spring this stiff
 * calls every prediction a slide; but one stretched far beyond its limit does slide, were it
 * not stiffer than felt [N/m]. */
void sw_press_begin(sw_press *press, double friction, int known, double felt);

/* A stage that begins from x0 + first (x1 - x0), where x1 is what the step's first stage led to,
 * begins from what the anchor slid in that stage just so: friction is against the speed at the
 * stage's end then, not against the way since the step's start, which would push a slide that stops
 * to and fro for ever. u: displacement from the anchor at the step's start [m]. last: the touch in
 * the iterate before, or NULL; same: that was of this stage. */
void sw_press_aim(sw_press *press, sw_vec u, const sw_press *last, int same, double first);

/* Forces at this iterate. Returns the force, and its stiffness (upper half). lagged: 0 =
 * explicit methods, which take all from this iterate. */
sw_vec sw_press_eval(sw_press *press, double friction, int lagged, double K[6]);

/* Does it push and slide in this iterate? */
int sw_press_slides(const sw_press *press, double friction);

/* Friction of a sliding touch follows its normal force within the linearisation of an iterate. 1:
 * after an update by shift that is another one than it took as given, by more than what does not
 * keep an iteration going. force_scale: see below [N]. */
int sw_press_lags(const sw_press *press, double friction, sw_vec shift, double force_scale);
/* It then takes that one as given. Returns by how much that changes the force on the wire [N]. */
sw_vec sw_press_follow(sw_press *press, double friction, sw_vec shift);
/* The same in two parts: the normal force after an update by shift [N], and one that friction takes
 * as given instead. */
double sw_press_push(const sw_press *press, sw_vec shift);
sw_vec sw_press_assume(sw_press *press, double friction, double force);
/* Or the one of the iterate's first solve again, likewise. */
sw_vec sw_press_unfollow(sw_press *press, double friction);
/* How far the normal force after an update is from the one that friction took as given [N]. */
double sw_press_off(const sw_press *press, double friction, sw_vec shift);
/* Would the normal force pull after an update by shift? A touch that does is opened: it has no
 * force any more. */
int sw_press_pulls(const sw_press *press, sw_vec shift);
/* Would the wire be inside after an update by shift? */
int sw_press_sinks(const sw_press *press, sw_vec shift);
/* Would the wire go through where nothing pushes after an update by shift? Such a touch is closed:
 * it has been moving freely and slides, with friction for the normal force to come. */
int sw_press_closes(const sw_press *press, sw_vec shift);
void sw_press_close(sw_press *press);
/* Opened, does it stay open after an update by shift, with nothing left of its friction? */
int sw_press_opens(const sw_press *press, sw_vec shift, double force_scale);

/* Does it touch as near as a script may place it? */
int sw_press_lies(const sw_press *press);

/* Is a depth where nothing touched before one that no touch gets into by itself? Then it was placed
 * there. first: nothing at all touched before. */
int sw_press_was_put(double depth, int first);

/* Of a depth at the step's start, when the touch was last what is kept, or NULL. What was placed in
 * each other, or comes out of a barrier, is let out slowly, for within one step the whole depth
 * would turn into speed. */
typedef struct sw_left {
  double forgiven; /* the step leaves this alone [m] */
  double let_out;  /* nothing explains this and the step ends it: 0 where it is no more than a gap's
                      rounding, as of a wire that is laid on a table [m] */
} sw_left;
sw_left sw_press_leave(double depth, const sw_kept *kept, double h, int slowly);

/* Forces after an update that shifted the touch; 1 = they agree with what the solve
 * assumed. force_scale: of the scene, forces far below which do not matter [N]. */
int sw_press_update(sw_press *press, double friction, sw_vec shift, double force_scale);

/* Friction of some touches after an update: how far off it is in all, and what it can be [N]. Many
 * touches may never agree one by one. 1: all of it is off by no more than that of one may be. */
typedef struct sw_rubbing {
  double off, most;
} sw_rubbing;
void sw_press_weigh(const sw_press *press, double friction, sw_rubbing *sum);
int sw_press_enough(const sw_rubbing *sum);
/* After so many updates of a stage that is what counts [-]. */
enum { SW_PATIENCE = 6 };

/* Force on the wire that the last solve reckoned with, which is what moved it: it may differ from
 * that of the law by what does not keep an iteration going [N]. */
sw_vec sw_press_borne(const sw_press *press, double friction);

/* Does the last update leave the gap open where nothing pushed, and closed where it did? */
int sw_press_apart(const sw_press *press);

/* Is a step so short beside the nominal one that inertia alone keeps a depth where it was? Not in
 * statics: with short pseudo steps a scene would come to rest that deep, and the first step after
 * it turn the depth into speed. */
int sw_press_is_short(int statics, double h, double nominal);

/* A touch that sinks in too deep gets stiffer: its stiffness from the next iterate on, or the
 * one it has [N/m]. usual: of a new touch. before: how deep the wire was at the step's start in
 * a short step, else negative [m]. forgiven: see above. */
double sw_press_stiffer(const sw_press *press, double usual, double forgiven, double before);

#endif
