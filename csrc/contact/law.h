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
  sw_vec pulls;   /* share of its limit that friction has at the iterate's start, against it [-] */
  sw_vec trial;   /* tangential displacement from that anchor at this iterate [m] */
  sw_vec ahead;   /* statics: how far from that its friction is linearised, along the surface [m] */
  sw_vec tangential; /* friction force after the last solve [N] */
  sw_vec next_pulls; /* pulls, as the last solve found it [-] */
  sw_vec shift;      /* by the last solve [m] */
  sw_vec slip;       /* how far the anchor slid in the step [m] */
  int alternations;  /* of normal_force - lag until the last iterate [-] */
  int by_place;      /* 1: friction's direction is that of the place, no unknown of its own */
  int reversals;     /* then: of the slide in this stage, or where a static solve is dragged [-] */
  double off;        /* friction of the last solve less that of the law [N] */
  int active;        /* pushes in this iterate */
  int let_go;        /* 1: not active in the next iterate, whatever its gap */
  int take_on;       /* 1: active in the next iterate, whatever its gap */
  int opened;        /* it pushed, until its solution */
  double lift;       /* then: the force that cancels its pull [N] */
  int spare;         /* so often it stays active though the last solve pulled [-] */
  int sliding;       /* assumed in this iterate */
  int next_sliding;  /* as the last solve found it */
} sw_press;

/* Stiffness of friction's spring [N/m]. */
static inline double sw_press_grip(const sw_press *p) {
  return p->soft > 0 ? p->k / p->soft : p->k;
}

/* The memory of a touch between steps, the same for all kinds. */
typedef struct sw_kept {
  double normal_force; /* 0: near, but without force [N] */
  double depth;        /* that goes with it [m] */
  double k;            /* to begin the next step with [N/m] */
  double steady;  /* mean normal force of the last steps; when just kept, that at the end [N] */
  double soft;    /* as above [-] */
  double left;    /* depth besides, since it was made stiffer when it was squeezed [m] */
  sw_vec elastic; /* displacement of friction's spring [m] */
  int sliding;
} sw_kept;

/* At a step's end. usual: stiffness of a new touch, stiffer: from the next iterate on [N/m]. A
 * touch keeps its stiffness, because a change would be a kick; needless stiffness goes away slowly.
 */
sw_kept sw_press_keep(const sw_press *press, double usual, double stiffer);
/* What is squeezed cannot come out: to let it out would make energy, and the step would be refused.
 * If it is too deep it is stiffer from the next step on, at the same force; the rest of the depth
 * stays. axial: stiffness of the wire's edge, which is enough: between rigid things no force could
 * be [N/m]. */
void sw_kept_harden(sw_kept *kept, double axial);
/* Energy that a touch gets by a stiffness k that is higher than it was [J]: what its spring holds
 * more at the same depth; of a line, which is light, it comes out to where the force is as before.
 */
double sw_kept_hardened(const sw_kept *kept, double k, int mesh);
/* The other way round, with stiffness = force over depth: for a look at an accepted state. */
void sw_kept_as_felt(sw_kept *kept);
sw_press sw_press_felt(const sw_kept *kept);

/* A touch that pushed after the last solve stays active in this iterate, even if turning normals
 * have opened its gap a little. Else the wires would fall into each other. The next solve decides.
 * Nor does the first pull end a touch with spare ones. last: the same touch in the iterate before,
 * or NULL. */
void sw_press_activate(sw_press *press, const sw_press *last);

/* Sets the normal force that friction takes as given, and whether the touch slides. Sources: last,
 * the iterate before, or NULL, used if goes_on; kept, the last accepted step, NULL if it did not
 * press; else guess [N]. The last iterate's force alone may alternate for ever, and grow where
 * friction presses the touch: then a secant through the last two is used. */
void sw_press_resume(sw_press *press, const sw_kept *kept, const sw_press *last, int goes_on,
                     double guess);

/* Friction begins at an iterate: k, lag and trial are set. known: 1 = `sliding` holds, 0 = find
 * out. With a stiff spring every prediction looks like a slide, so a prediction says little about
 * sticking. A spring far beyond its limit does slide, were it no stiffer than felt [N/m]. */
void sw_press_begin(sw_press *press, double friction, int known, double felt);

/* Sets the friction spring of a stage that begins at x0 + first (x1 - x0), where x1 is the result
 * of the step's first stage. The anchor begins with the same share of that stage's slip. So
 * friction opposes the speed at the stage's end; if it opposed the way since the step's start, a
 * slide that stops would alternate for ever. u: displacement from the anchor at the step's start
 * [m]. last: the touch in the iterate before, or NULL; same: last is of this stage. */
void sw_press_aim(sw_press *press, sw_vec u, const sw_press *last, int same, double first);

/* Forces at this iterate. Returns the force, and its stiffness (upper half). lagged: 0 = explicit
 * methods, where friction uses this iterate's normal force. */
sw_vec sw_press_eval(sw_press *press, double friction, int lagged, double K[6]);

/* Does it push and slide in this iterate? */
int sw_press_slides(const sw_press *press, double friction);

/* Within an iterate's linearisation friction of a sliding touch follows its normal force. 1: after
 * an update by shift the normal force differs from the one that friction used, by more than the
 * tolerance of the iteration. force_scale: see below [N]. */
int sw_press_lags(const sw_press *press, double friction, sw_vec shift, double force_scale);
/* Friction uses the new normal force. Returns the change of the force on the wire [N]. */
sw_vec sw_press_follow(sw_press *press, double friction, sw_vec shift);
/* The same in two parts: the normal force after an update by shift [N], and friction that uses a
 * given one instead. */
double sw_press_push(const sw_press *press, sw_vec shift);
sw_vec sw_press_assume(sw_press *press, double friction, double force);
/* Or friction uses that of the iterate's first solve again, likewise. */
sw_vec sw_press_unfollow(sw_press *press, double friction);
/* Difference of the normal force after an update and the one that friction used [N]. */
double sw_press_off(const sw_press *press, double friction, sw_vec shift);
/* Would the touch pull after an update by shift? Then it opens and has no force. */
int sw_press_pulls(const sw_press *press, sw_vec shift);
/* Would the wire be inside after an update by shift? */
int sw_press_sinks(const sw_press *press, sw_vec shift);
/* Would the wire pass an inactive touch in an update by shift? Then the touch closes. It has moved
 * freely, so it slides, with friction of the normal force to come. */
int sw_press_closes(const sw_press *press, sw_vec shift);
void sw_press_close(sw_press *press);
/* Opened, does it stay open after an update by shift, with nothing left of its friction? */
int sw_press_opens(const sw_press *press, sw_vec shift, double force_scale);

/* Does it touch as near as a script may place it? */
int sw_press_lies(const sw_press *press);

/* No touch gets this deep by itself within a step: was it placed there? Nothing touched there
 * before; first: nothing touched anywhere. */
int sw_press_was_put(double depth, int first);

/* Splits a depth at the step's start. kept: memory of the touch, or NULL. Wires that were placed in
 * each other, or that leave a barrier, come out slowly: within one step the depth would turn into
 * speed. */
typedef struct sw_left {
  double forgiven; /* the step leaves this alone [m] */
  double let_out;  /* unexplained depth that the step ends; 0 if it is only rounding, as of a wire
                      laid on a table [m] */
  double left;     /* part of what is forgiven that is kept besides [m] */
} sw_left;
sw_left sw_press_leave(double depth, const sw_kept *kept, double h, int slowly);

/* Forces after an update that shifted the touch; 1 = they agree with the solve's assumptions.
 * force_scale: of the scene; much smaller forces do not matter [N]. */
int sw_press_update(sw_press *press, double friction, sw_vec shift, double force_scale);

/* Friction of several touches after an update: its total error, and its total limit [N]. Many
 * touches may never agree one by one. 1: the total error is within the tolerance of one touch. */
typedef struct sw_rubbing {
  double off, most;
} sw_rubbing;
void sw_press_weigh(const sw_press *press, double friction, sw_rubbing *sum);
int sw_press_enough(const sw_rubbing *sum);
/* The sum counts after this many updates of a stage [-]. */
enum { SW_PATIENCE = 6 };

/* Force on the wire in the last solve, which moved the wire. It differs from the law's force by no
 * more than the tolerance of the iteration [N]. */
sw_vec sw_press_borne(const sw_press *press, double friction);

/* After the last update, is the gap open where nothing pushed, and closed where a touch did? */
int sw_press_apart(const sw_press *press);

/* Is a step so short beside the nominal one that inertia alone keeps a depth? Not in statics: short
 * pseudo steps would leave the depth in the scene, and the first dynamic step would turn it into
 * speed. */
int sw_press_is_short(int statics, double h, double nominal);

/* Depth from which on a squeezed touch is made stiffer at once [m]. */
double sw_press_squeezed(double forgiven, double before);

/* Stiffness from the next iterate on: higher for a touch that is too deep, else as it is [N/m].
 * usual: of a new touch; axial: of the wire's edge, for what a taut wire presses with has nothing
 * to do with its weight. before: depth at the step's start in a short step, else negative [m].
 * forgiven: see above. */
double sw_press_stiffer(const sw_press *press, double usual, double axial, double forgiven,
                        double before);

#endif
