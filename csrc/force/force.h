/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The force registry. One call of a force evaluates all its elements. Each force is one file ending
 * in one sw_force_class, and one X(name) line in list.def. */
#ifndef SW_FORCE_FORCE_H
#define SW_FORCE_FORCE_H

#include <stddef.h>
#include <stdint.h>

#include "base/param.h"
#include "base/status.h"
#include "state/field.h"
#include "state/tie.h"

enum {
  SW_FORCE_INNER = 1,       /* part of a wire model's recipe; not made by scene:force */
  SW_FORCE_EXPLICIT = 2,    /* has no stiffness: solved by fixed-point iteration */
  SW_FORCE_AT_PLACE = 4,    /* acts at one arc length: takes s */
  SW_FORCE_DISSIPATIVE = 8, /* has no energy; takes power from the motion, F.v <= 0 */
  SW_FORCE_FROZEN = 16,     /* its stiffness omits a term, named in its file */
  SW_FORCE_BY_ANGLE = 32,   /* corrects bend: only for wires that bend by angles (bend.c) */
  SW_FORCE_ANY_BODY = 64,   /* acts on nodes or particles alike: goes with meshes too */
  SW_FORCE_OF_WEB = 128,    /* acts on a web's springs or particles: only for meshes */
  SW_FORCE_ON_SOME = 256,   /* acts on some particles: takes a list, see sw_force_some */
  SW_FORCE_ANY_SHAPE = 512, /* its history holds no bending: goes with material frames too */
  SW_FORCE_LOAD = 1024,     /* a dead load: its energy is counted as work done on the wire */
  SW_FORCE_POWER = 2048,    /* reports the power it takes from the motion (SW_WANT_POWER) */
  SW_FORCE_BENDING = 16384, /* its energy is the bending energy of a line */
  SW_FORCE_OF_AXIS = 8192,  /* acts on a centre line: not for loose particles */
  SW_FORCE_DRIVEN = 4096    /* has no energy; driven from outside: F.v of any sign */
};

enum { SW_FORCE_ARGS_MAX = 144 };   /* room for any force's arguments [B] */
enum { SW_FORCE_OUTPUTS_MAX = 32 }; /* most read-out values of a force [-] */

/* An event of one wire, for the list of events. */
typedef struct sw_force_news {
  const char *kind;
  double s, value; /* arc length [m] or NAN; value in the unit of the text */
  char text[160];  /* continues after the names of force and wire */
} sw_force_news;

typedef struct sw_force_class {
  const char *name;
  const char *summary;  /* one line for help() */
  const char *stores;   /* name under which its energy is reported; NULL = the force's name */
  const char *loses;    /* kind of work dissipated in its history; NULL = plasticity */
  const char *corrects; /* force whose energy its field's `bending` corrects; NULL = bend */
  unsigned flags;
  sw_params params; /* rows of its argument struct */

  /* 1 if the force acts on this plan; NULL = always. A recipe's term that does not act is left
   * out. */
  int (*applies)(const sw_plan *plan);

  /* Adds the values selected by field->want. args is the argument struct. Returns SW_OK, or
   * SW_ECALLBACK from user code (err filled). */
  sw_status (*eval)(const void *args, sw_field *field, sw_error *err);

  /* Largest stable step of undamped leapfrog due to this force alone on this
   * plan, with lumped masses [s]; NULL = no limit. */
  double (*stable_dt)(const void *args, const sw_plan *plan);

  /* Largest share, in (0, 1], of an iteration's move delta (nodes x 3) from field->x that the force
   * can follow [-]. NULL = the whole move. */
  double (*largest_share)(const void *args, const sw_field *field, const double *delta);

  /* Axial dashpots: their force per strain rate over the stiffness EA of the springs beside them
   * [s]; NULL = no such dashpots. */
  double (*axial_time)(const void *args);

  /* Adds the axial forces of edges that the force bears beside their springs, to sum (edges) [N];
   * NULL = none. For lines only (no webs). */
  void (*axial)(const void *args, const sw_field *field, double *sum);

  /* Bending dashpots, including those of clamp hinges: moment per rate of curvature [N m2 s]; NULL
   * = no such dashpots. */
  double (*viscosity)(const void *args, const sw_plan *plan);

  /* Moment that a clamp hinge puts on the wire [N m]; NULL = none. */
  sw_vec (*clamp_moment)(const void *args, const sw_field *field, const sw_clamp_hinge *hinge);

  /* Energy of a clamp hinge beside that of the wire's own bend; it is 1 / length at given angles
   * [J]; NULL = none. */
  double (*clamp_energy)(const void *args, const sw_field *field, const sw_clamp_hinge *hinge);

  /* SW_EINVAL with a text if the force cannot act on a wire of these values; NULL = it always
   * can. */
  sw_status (*check)(const void *args, const sw_beam *beam, sw_error *err);

  /* Fills arguments left open from the body's position: nodes or particles at x (nodes x 3) with
   * arc lengths s. nodes 0: there are several bodies. NULL = no such arguments. SW_EINVAL. */
  sw_status (*place)(void *args, size_t nodes, const double *x, const double *s, sw_error *err);

  /* History: doubles in the system's state, zero at first. Number 0 is the work dissipated so far
   * [J]. eval reads the history of the last accepted state in field->history and never writes it;
   * commit updates it once for each accepted state, so a rejected step leaves no trace. inherit
   * fills the history for field->plan (geometry is up to date, directors are not) from the history
   * of an older plan of the same wire. All three NULL = no history. */
  size_t (*state_size)(const sw_plan *plan);
  void (*commit)(const void *args, const sw_field *field, double *history);
  void (*inherit)(const sw_plan *old, const double *from, const sw_field *field, double *history);

  /* Between two searches for the same equilibrium: advances values that lag a step behind the state
   * to the state; guesses = 1: only first guesses. Returns the change of the force on the wire,
   * over the largest force that lags [-]. NULL = nothing lags. */
  double (*catch_up)(const void *args, const sw_field *field, int guesses, double *history);
  /* A run begins: clears the history's records of a run. NULL = no records. */
  void (*begin_run)(double *history);

  /* 1 if the last commit produced an event. Fills its kind, place on the wire, value and text. NULL
   * = no events. */
  int (*news)(const void *args, const double *history, sw_force_news *out);

  /* Fills the first history of a wire; geometry as for inherit. NULL = zeros. */
  void (*begin)(const void *args, const sw_field *field, double *history);

  /* 1 if a force with this history does nothing in the coming step; the step then needs no extra
   * accuracy for kinks. NULL = it may always act. */
  int (*idle)(const double *history);

  /* Returns how far the force on a line's nodes at x (nodes x 3) is from the one that an iteration
   * expected, which moved them there by delta: from the force and the stiffness before [N]. NULL =
   * not known. Then a force with a history is iterated until the nodes move no more, because its
   * stiffness may jump. */
  double (*mistake)(const void *args, const sw_field *field, const double *history, const double *x,
                    const double *delta);

  /* Returns the pull on a part that can break and fills its strength: 0 = broken, HUGE_VAL = no
   * limit [N]. Only positions of the field are up to date. NULL = cannot break. */
  double (*pull)(const void *args, const sw_field *field, const double *history, double *bears);
  /* With pull: how this part swings while it is taut. Positions and velocities are up to date. */
  sw_tie_swing (*swing)(const void *args, const sw_field *field, const double *history);

  /* Returns the nodes' move in a step to x over the largest move that still resolves the force on
   * the way: at most 1 is fine; 0 = the wire is not near [-]. NULL = the force is as smooth as the
   * wire's own. */
  double (*oversteps)(const void *args, const sw_field *field, const double *history,
                      const double *x);

  /* Returns the period with which the force changes by itself; HUGE_VAL: it is steady [s]. NULL =
   * it always is, or nobody knows. */
  double (*period)(const void *args);

  /* Read-outs besides the force, for one wire at the accepted state: names (NULL-terminated) and
   * their values, with units stated in the force's file. NULL = none. */
  const char *const *outputs;
  void (*read)(const void *args, const sw_field *field, const double *history, double *out);
} sw_force_class;

/* Number of classes. */
enum {
#define X(name) SW_FORCE_NUMBER_##name,
#include "force/list.def"
#undef X
  SW_FORCE_CLASSES
};

/* Returns the class called name, or NULL. */
const sw_force_class *sw_force_find(const char *name);

/* Returns all classes, NULL-terminated. */
const sw_force_class *const *sw_force_all(void);

/* Arguments of the inner forces, filled by recipes. */
typedef struct sw_stretch_args {
  double EA;           /* [N] */
  double tension_only; /* 1: no force in compression (repel gives it) [-] */
} sw_stretch_args;

typedef struct sw_repel_args {
  double EA; /* [N] */
} sw_repel_args;

typedef struct sw_bend_args {
  double EI; /* [N m2] */
} sw_bend_args;

/* First member of the arguments of a force on some particles. The scene owns the list. */
typedef struct sw_force_some {
  const uint32_t *particle; /* (count) numbers in the body, from 0 */
  size_t count;
} sw_force_some;

/* Arguments of a Lua function as a force. The function gets the field and adds to field->force. */
typedef struct sw_callback_args {
  sw_status (*function)(void *user, sw_field *field, sw_error *err);
  void *user;
} sw_callback_args;

#endif
