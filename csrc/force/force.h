/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The force registry. A force answers for its whole element list at once; each
 * is one file ending in one sw_force_class and one X(name) line in list.def. */
#ifndef SW_FORCE_FORCE_H
#define SW_FORCE_FORCE_H

#include <stddef.h>
#include <stdint.h>

#include "base/param.h"
#include "base/status.h"
#include "state/field.h"

enum {
  SW_FORCE_INNER = 1,       /* part of a wire model's recipe; not made by scene:force */
  SW_FORCE_EXPLICIT = 2,    /* has no stiffness: iterated to a fixed point instead */
  SW_FORCE_AT_PLACE = 4,    /* acts at one arc length: takes s */
  SW_FORCE_DISSIPATIVE = 8, /* has no energy; takes power from the motion, F.v <= 0 */
  SW_FORCE_FROZEN = 16,     /* its stiffness leaves a part out, which its file names */
  SW_FORCE_BY_ANGLE = 32,   /* corrects bend: only for wires whose bending is by angles */
  SW_FORCE_ANY_BODY = 64,   /* knows nodes only, or particles too: goes with meshes as well */
  SW_FORCE_OF_WEB = 128,    /* knows springs or particles only: goes with nothing else */
  SW_FORCE_ON_SOME = 256,   /* acts on some particles: takes a list; see sw_force_some */
  SW_FORCE_ANY_SHAPE = 512, /* its history is not of bends: goes with material frames as well */
  SW_FORCE_LOAD = 1024,     /* a dead load: its energy is work that it gives */
  SW_FORCE_POWER = 2048,    /* tells the power that it takes from the motion (SW_WANT_POWER) */
  SW_FORCE_BENDING = 16384, /* its energy is bending energy of a line */
  SW_FORCE_OF_AXIS = 8192,  /* acts on a centre line, which loose particles have not */
  SW_FORCE_DRIVEN = 4096    /* has no energy; something outside drives it: F.v of any sign */
};

enum { SW_FORCE_ARGS_MAX = 144 };   /* room for any force's arguments [B] */
enum { SW_FORCE_OUTPUTS_MAX = 32 }; /* most values that a force has to read [-] */

/* Something that happened to a wire, for the list of events. */
typedef struct sw_force_news {
  const char *kind;
  double s, value; /* arc length [m] or NAN; of the text's unit */
  char text[160];  /* goes on after the names of force and wire */
} sw_force_news;

typedef struct sw_force_class {
  const char *name;
  const char *summary;  /* one line for help() */
  const char *stores;   /* name of its energy; NULL = the force's */
  const char *loses;    /* what the work dissipated in its history is; NULL = plasticity */
  const char *corrects; /* what its field's `bending` is part of; NULL = bend */
  unsigned flags;
  sw_params params; /* rows of its argument struct */

  /* Has it anything to do there? NULL = always. A term of a recipe that has not is left out. */
  int (*applies)(const sw_plan *plan);

  /* Add what field->want asks for. args is the argument struct. Statuses: SW_OK;
   * SW_ECALLBACK from user code (err filled). */
  sw_status (*eval)(const void *args, sw_field *field, sw_error *err);

  /* Largest stable step of undamped leapfrog due to this force alone on this
   * plan, with lumped masses [s]; NULL = no limit. */
  double (*stable_dt)(const void *args, const sw_plan *plan);

  /* Share of the move delta of the nodes from x (both nodes x 3) that the force can follow, in
   * (0, 1]; NULL = any [-]. */
  double (*largest_share)(const void *args, const sw_plan *plan, const double *x,
                          const double *delta);

  /* Axial dashpots: their force over that of the springs beside them, per rate of strain [s];
   * NULL = it has none. */
  double (*axial_time)(const void *args);

  /* Dashpots in bending, clamps' hinges included: their moment per rate of curvature [N m2 s];
   * NULL = it has none. */
  double (*viscosity)(const void *args, const sw_plan *plan);

  /* Moment that a clamp hinge puts on the wire [N m]; NULL = none. */
  sw_vec (*clamp_moment)(const void *args, const sw_field *field, const sw_clamp_hinge *hinge);

  /* Does it go with a wire of these values? NULL = always. SW_EINVAL with a text. */
  sw_status (*check)(const void *args, const sw_beam *beam, sw_error *err);

  /* Fills arguments that were left open from where the body lies: nodes or particles at x (3 each)
   * with arc lengths s. nodes 0: there are several bodies. NULL = there are none. SW_EINVAL. */
  sw_status (*place)(void *args, size_t nodes, const double *x, const double *s, sw_error *err);

  /* History: doubles that live in the system's state, zero at first, number 0 the
   * work dissipated so far [J]. eval finds those of the last accepted state in
   * field->history and only reads them; commit, once for each accepted state,
   * brings them up to it. So a rejected step leaves nothing behind. inherit fills
   * them for field->plan (geometry is up to date, directors are not) from those of
   * an older plan of the same wire. All three NULL = no history. */
  size_t (*state_size)(const sw_plan *plan);
  void (*commit)(const void *args, const sw_field *field, double *history);
  void (*inherit)(const sw_plan *old, const double *from, const sw_field *field, double *history);

  /* News of the last commit, to be told as an event: its kind, the force's name, the place on
   * the wire, and a value in the unit that the text says; NULL = none. */
  int (*news)(const void *args, const double *history, sw_force_news *out);

  /* Fills the history of a wire that has none yet; geometry as for inherit. NULL = zeros. */
  void (*begin)(const void *args, const sw_field *field, double *history);

  /* 1: with this history it does nothing in the coming step, which then need not be computed as
   * closely as kinks ask for; NULL = it always may. */
  int (*idle)(const double *history);

  /* Pull on something that breaks, and its strength: 0 when it is broken or has no limit [N].
   * Of the field only places are up to date. NULL = nothing breaks. */
  double (*pull)(const void *args, const sw_field *field, const double *history, double *bears);

  /* How far the nodes would go in a step that brings them to x, over how far they may go there
   * without passing what the force does on the way: 1 and less is well; 0 = nothing is near [-].
   * NULL = the force is as smooth as the wire's own. */
  double (*oversteps)(const void *args, const sw_field *field, const double *history,
                      const double *x);

  /* Read-outs besides its force, on one wire at the accepted state: names, NULL-terminated, and
   * as many values, in units that the force's file states. NULL = none. */
  const char *const *outputs;
  void (*read)(const void *args, const sw_field *field, const double *history, double *out);
} sw_force_class;

/* How many there are. */
enum {
#define X(name) SW_FORCE_NUMBER_##name,
#include "force/list.def"
#undef X
  SW_FORCE_CLASSES
};

/* The class called name, or NULL. */
const sw_force_class *sw_force_find(const char *name);

/* All classes, NULL-terminated. */
const sw_force_class *const *sw_force_all(void);

/* Arguments of the inner forces, which recipes fill. */
typedef struct sw_stretch_args {
  double EA;           /* [N] */
  double tension_only; /* 1: no answer to compression (repel gives it) [-] */
} sw_stretch_args;

typedef struct sw_repel_args {
  double EA; /* [N] */
} sw_repel_args;

typedef struct sw_bend_args {
  double EI; /* [N m2] */
} sw_bend_args;

/* Head of the arguments of a force on some particles. The scene owns the list. */
typedef struct sw_force_some {
  const uint32_t *particle; /* (count) numbers in the body, from 0 */
  size_t count;
} sw_force_some;

/* Arguments of a Lua function as a force: called with the field, adds to
 * field->force. */
typedef struct sw_callback_args {
  sw_status (*function)(void *user, sw_field *field, sw_error *err);
  void *user;
} sw_callback_args;

#endif
