/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records of contact: candidates, touches, and their memory between iterates and between steps. Of
 * this room only. */
#ifndef SW_CONTACT_RECORD_H
#define SW_CONTACT_RECORD_H

#include <stdint.h>

#include "contact/contact.h"
#include "contact/law.h"
#include "contact/mean.h"

/* A node, or the inside of a segment that starts there, and an obstacle that
 * it may touch in this step. */
typedef struct sw_candidate {
  int obstacle;
  int segment;        /* number of the segment among those of its node; 0: the node itself */
  size_t node, other; /* in the system's arrays; its other end, or the node again */
  size_t body;
  double radius;             /* of the wire there [m] */
  double skin;               /* of the surface from the node [m] */
  double mass;               /* [kg] */
  size_t memory, memory_end; /* matching range of the memory */
  size_t last, last_end;     /* matching range of the last iterate's touches */
  double usual;              /* stiffness of a new touch [N/m] */
  int given;                 /* 1: it keeps that, however deep it gets */
  int smooth;                /* 1: the wire is its smooth curve there, not its chords */
  int round;                 /* 1: its curve at a thin round obstacle, chords elsewhere */
  double squeezing;          /* force from which on its touch cannot come out; 0: none [N] */
  double firm;               /* then: firmness of the touch in the middle of its edge [-] */
  double firm_beside[2];     /* the same on the edges before and after it [-] */
  double lone;               /* and share of it in one place, 0 to 1 [-] */
  int samples; /* number of touches, spread evenly along the segment; 0: at the nearest places */
} sw_candidate;

/* Features that are no part of a shape: a touch kept by a barrier, and one of a wire's curve with a
 * round obstacle [-]. */
enum { SW_BEHIND_BARRIER = -1, SW_ON_CURVE = -2 };

/* One place where a wire's surface is near an obstacle. */
typedef struct sw_touch {
  int obstacle, segment;
  size_t node, other, body;
  int feature;
  double at;        /* along the segment, of a smooth one perhaps half an edge beyond it [-] */
  sw_mean spot;     /* the same as a mean of nodes */
  sw_sharp sharp;   /* of a smooth one: what it touches */
  sw_vec edge;      /* then: along an edge, in the obstacle's coordinates [-] */
  double steady;    /* steady normal force [N] */
  sw_vec point;     /* on the obstacle, world [m] */
  sw_vec local;     /* the same in the obstacle's coordinates [m] */
  double forgiven;  /* part of the true depth that this step leaves alone [m] */
  double left;      /* and always did, since it was made stiffer [m] */
  double let_out;   /* unexplained part of the true depth that this step ends [m] */
  double hardened;  /* energy that comes by a higher stiffness [J] */
  double usual;     /* of a new touch here [N/m] */
  double stiffer;   /* its stiffness from the next iterate on, in full [N/m] */
  double share;     /* of that stiffness, near a place of the edge beside [-] */
  int known;        /* it pressed at the step's start */
  int held;         /* both ends are held: no force */
  int squeezed;     /* a line that bore far more than its weight at the step's start */
  double friction;  /* coefficient in this step: kinetic if it slid before [-] */
  double slid;      /* sliding way until the step's start, since it began to press [m] */
  sw_vec seen;      /* where the wire was at this evaluation, in the obstacle's coordinates [m] */
  size_t candidate; /* index of what it was made from */
  size_t stage;     /* in which it was found */
  sw_press press;   /* its normal is the obstacle's, outward, in the world */
} sw_touch;

/* Is it softer in this iterate than it is to be in the next? */
static inline int sw_touch_is_softer(const sw_touch *t) {
  return t->press.k < t->share * t->stiffer;
}

/* A touch that pressed at the end of a stage and may have struck, as far as impacts need it. A
 * touch itself is large, and many nodes may land in one step. */
typedef struct sw_pressed {
  uint32_t node, other, body;
  int obstacle, segment;
  sw_sharp sharp;
  double at;
  sw_mean spot;
  sw_vec local, normal;
  double let_out;
} sw_pressed;

/* What is kept of a touch between steps; in the obstacle's coordinates. */
typedef struct sw_memory {
  int obstacle, segment; /* obstacle: the owner's id */
  size_t node;
  int feature;
  double at;
  sw_vec normal, point; /* the side: local [-], [m] */
  sw_kept kept;         /* vectors as above */
  sw_vec seen;          /* place of the wire then, local [m] */
  double slid;          /* sliding way since it began to press [m] */
} sw_memory;

/* A crossing found by the swept test: the place is kept on its side of a plane
 * for the rest of the step. */
typedef struct sw_barrier {
  int obstacle, segment;
  size_t node, other;
  double at;
  sw_vec normal, point; /* local [-], [m] */
  uint32_t before;      /* the one before at its node: number + 1, or 0 */
} sw_barrier;

/* A touch whose impact was dealt with in this step. */
typedef struct sw_impact {
  int obstacle, segment;
  size_t node;
  double at;
  uint32_t before; /* as a barrier's */
} sw_impact;

/* When a touch would strike. */
typedef struct sw_turn {
  double meets, closes; /* after the step's start [s]; closing speed of its gap there [m/s] */
  size_t node;
  int obstacle;
  uint32_t touch; /* of those that pressed */
} sw_turn;

/* A touch that was part of the last matrix. */
typedef struct sw_mark {
  size_t candidate;
  double at, k;  /* [-], [N/m] */
  sw_vec normal; /* [-] */
} sw_mark;

/* Statics: where the search for the touches' states goes on from. */
typedef struct sw_ahead {
  sw_vec shift; /* of the touch, from where the wires are [m] */
  sw_vec force; /* force on the wire there that the solves have used [N] */
} sw_ahead;

/* What an obstacle gets in a step. */
typedef struct sw_contact_loads {
  sw_contact_past past;
  sw_contact_load stage[SW_BOOK_STAGES]; /* impulse from the step's start, without blows [N s] */
  sw_contact_load blows; /* impulse of impacts that changed the starting velocities [N s] */
  sw_contact_load trial; /* at the end of a trial [N] */
  int busy;              /* 1: in the list of loaded obstacles */
} sw_contact_loads;

/* A stage that is solved by parts: the part at hand. */
typedef struct sw_contact_parts {
  int on, begun;     /* 1: there are parts; this one has been looked at */
  size_t first, end; /* its candidates */
  size_t touch;      /* its first touch */
  size_t before;     /* touches of the stage before, of all parts */
  size_t matched;    /* of those, up to this part's last */
} sw_contact_parts;

#endif
