/* SPDX-License-Identifier: GPL-3.0-or-later */
/* History of a clip on one wire, and its events: the wire goes in, comes out, breaks the clip, or
 * crosses it in a way that the model does not cover. */
#ifndef SW_FORCE_CLIP_WATCH_H
#define SW_FORCE_CLIP_WATCH_H

#include "force/clip_sum.h"
#include "force/force.h"

/* Layout of the history: the head, then three numbers for each node or ring: stretch of its
 * friction spring [m], its place along the axis at the last commit [m], and its largest friction
 * [N]. */
enum {
  SW_CLIP_DISSIPATED,
  SW_CLIP_BEGUN,
  SW_CLIP_NEAR, /* 1: some of the wire is within the clip's width and not far above or beside */
  SW_CLIP_RUBS, /* number of nodes with friction; SW_CLIP_GUESS: its limits are a first guess */
  SW_CLIP_STATE,
  SW_CLIP_PEAK,
  SW_CLIP_LAST,
  SW_CLIP_IN,
  SW_CLIP_IN_TIME,
  SW_CLIP_IN_S,
  SW_CLIP_IN_PEAK,
  SW_CLIP_OUT,
  SW_CLIP_OUT_TIME,
  SW_CLIP_OUT_PEAK,
  SW_CLIP_THERE_BEFORE, /* 1: the wire crossed the clip's plane in the last accepted state, at */
  SW_CLIP_U_BEFORE,     /* this height and */
  SW_CLIP_V_BEFORE,     /* this distance to the side [m] */
  SW_CLIP_PUSH,         /* largest push of floor or wall since the wire is deep in them [N] */
  SW_CLIP_BROKEN,       /* the way the wire broke out, a number of the last list below; 0 = none */
  SW_CLIP_BROKEN_TIME,
  SW_CLIP_BROKEN_FORCE,
  SW_CLIP_NEWS, /* event of the last step */
  SW_CLIP_NEWS_VALUE,
  SW_CLIP_NEWS_S,
  SW_CLIP_PEAK_SLOPE, /* slope of the wire at the largest push in or pull out [-] */
  SW_CLIP_RUN_PEAK, /* as SW_CLIP_PEAK of a seated wire, in this run only; below 0: none yet [N] */
  SW_CLIP_GOES_IN,  /* 1: the seated wire is not at rest yet since it passed the lips */
  SW_CLIP_SINCE,    /* when such a wire last moved in [s] */
  SW_CLIP_HELD,     /* largest pull on it since then [N] */
  SW_CLIP_HELD_SLOPE, /* its slope at that pull [-] */
  SW_CLIP_HEAD
};
static const double SW_CLIP_GUESS = 0.5;
enum { SW_CLIP_STRETCH, SW_CLIP_PLACE, SW_CLIP_MOST, SW_CLIP_EACH };
enum { SW_CLIP_EMPTY, SW_CLIP_INSERTING, SW_CLIP_SEATED, SW_CLIP_ABOVE };
enum {
  SW_CLIP_NO_NEWS,
  SW_CLIP_THROUGH_FLOOR,
  SW_CLIP_THROUGH_WALL,
  SW_CLIP_FROM_OUTSIDE,
  SW_CLIP_CROSSING,
  SW_CLIP_PASSED,
  SW_CLIP_COARSE,
  SW_CLIP_CAME_OUT,
  SW_CLIP_SLID_OUT, /* along the axis */
  SW_CLIP_PEELED_IN,
  SW_CLIP_PEELED_OUT,
  SW_CLIP_UNSEEN_IN, /* steps have missed the lips' peak */
  SW_CLIP_UNSEEN_OUT,
  SW_CLIP_LONG_EDGES
};

/* Stretch at which a friction spring slips, over the clip's width [-]. */
static const double SW_CLIP_SLIP = 1.0 / 200.0;

/* Returns the clip as the wire meets it in this step. */
sw_clip sw_clip_met(const void *args, const sw_field *field, const double *history);

static inline int sw_clip_is_broken(const double *history) {
  return history && history[SW_CLIP_BROKEN] > 0;
}

/* The whole of the wire within the clip. */
typedef struct sw_clip_middle {
  double share;   /* share of the clip's width that the wire fills, between the walls [-] */
  double u, v, s; /* mean u, v and arc length of that [m] */
  double push;    /* force of lips, floor and walls along direction [N] */
  sw_vec force;   /* their whole force on the wire [N] */
  double passes;  /* share of the clip's width that the wire fills, at any u and v [-] */
  double at[2];   /* mean u and v of that [m] */
  double along;   /* mean cosine of the angle between wire and axis [-] */
  double slope;   /* mean rise of the wire over its way along the axis [-] */
  double edge;    /* length of the longest edge in the clip [m] */
  sw_vec
      couple; /* moment of its force about the clip's middle, without that along the axis [N m] */
} sw_clip_middle;

/* Pushes of lips, floor and walls on the ends of the edges in the clip (sw_clip_sum). With more
 * edges than KNOWN they are not complete: then they are summed again. */
enum { SW_CLIP_KNOWN = 16 };
typedef struct sw_clip_pushes {
  size_t count; /* of edges, also of those that have no room */
  size_t edge[SW_CLIP_KNOWN];
  double push[SW_CLIP_KNOWN][2]; /* [N] */
} sw_clip_pushes;

/* pushes: filled, or NULL. */
sw_clip_middle sw_clip_middle_of(const sw_clip *clip, const sw_field *field,
                                 sw_clip_pushes *pushes);

/* Adds the largest friction of the next step to each place. known: the pushes in this state, or
 * NULL. */
void sw_clip_measure_friction(const sw_clip *clip, const sw_field *field,
                              const sw_clip_pushes *known, double *each);

/* After a step: 1 if the wire has broken the clip. The clip does not act on this wire from then
 * on. */
int sw_clip_breaks(const sw_clip *clip, const sw_clip_middle *middle, double time, double *history);

/* After a step: updates the state of the wire on its way in or out. statics: 1 if it is in
 * equilibrium. */
void sw_clip_follow(const sw_clip *clip, const sw_clip_middle *middle, double time, int statics,
                    double *history);

/* After that: notes if edges are too long for the bend that the clip makes. EI: the wire's [N m2].
 */
void sw_clip_watch_edges(const sw_clip *clip, const sw_clip_middle *middle, double EI,
                         double *history);

/* See sw_force_class. */
double sw_clip_largest_share(const void *args, const sw_field *field, const double *delta);
double sw_clip_mistake(const void *args, const sw_field *field, const double *history,
                       const double *x, const double *delta);
void sw_clip_begin_run(double *history);
int sw_clip_news(const void *args, const double *history, sw_force_news *out);

#endif
