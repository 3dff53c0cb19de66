/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of a clip about a wire, and its events: the wire goes in, comes out, breaks the clip,
 * or crosses it in a way that the clip does not describe. */
#ifndef SW_FORCE_CLIP_WATCH_H
#define SW_FORCE_CLIP_WATCH_H

#include "force/clip_sum.h"
#include "force/force.h"

/* The head, then three numbers for each node or ring: how far friction's spring is stretched
 * [m], where along the axis the node was [m], and the most friction there [N]. */
enum {
  SW_CLIP_DISSIPATED,
  SW_CLIP_BEGUN,
  SW_CLIP_NEAR, /* 1: some of the wire is within the clip's width and not far above or beside */
  SW_CLIP_RUBS, /* 1: there is friction at some node */
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
  SW_CLIP_THERE_BEFORE, /* 1: the wire passed the clip's plane in the last accepted state, at */
  SW_CLIP_U_BEFORE,     /* this height and */
  SW_CLIP_V_BEFORE,     /* this far to the side [m] */
  SW_CLIP_PUSH,         /* the most that floor or wall did to it since it is deep in them [N] */
  SW_CLIP_BROKEN,       /* part through which the wire broke out, see below; 0 = it did not */
  SW_CLIP_BROKEN_TIME,
  SW_CLIP_BROKEN_FORCE,
  SW_CLIP_NEWS, /* what is to be told of the last step */
  SW_CLIP_NEWS_VALUE,
  SW_CLIP_NEWS_S,
  SW_CLIP_PEAK_SLOPE, /* the middle's slope at the largest pull [-] */
  SW_CLIP_HEAD
};
enum { SW_CLIP_STRETCH, SW_CLIP_PLACE, SW_CLIP_MOST, SW_CLIP_EACH };
enum { SW_CLIP_EMPTY, SW_CLIP_INSERTING, SW_CLIP_SEATED, SW_CLIP_ABOVE };
enum {
  SW_CLIP_NO_NEWS,
  SW_CLIP_THROUGH_FLOOR,
  SW_CLIP_THROUGH_WALL,
  SW_CLIP_FROM_OUTSIDE,
  SW_CLIP_CROSSING,
  SW_CLIP_PASSED,
  SW_CLIP_COARSE
};

static inline int sw_clip_is_broken(const double *history) {
  return history && history[SW_CLIP_BROKEN] > 0;
}

/* The wire's part in the clip as a whole. */
typedef struct sw_clip_middle {
  double share;   /* of the width that it passes through, between the walls [-] */
  double u, v, s; /* of its middle [m] */
  double push;    /* of lips, floor and walls along direction [N] */
  sw_vec force;   /* of all [N] */
  double passes;  /* share of the width that it passes through, anywhere [-] */
  double at[2];   /* u and v of that [m] */
  double along;   /* of the wire there and the axis, the cosine [-] */
  double slope;   /* mean of the wire's rise over its way along the axis [-] */
  double edge;    /* length of the longest edge there [m] */
} sw_clip_middle;

sw_clip_middle sw_clip_middle_of(const sw_clip *clip, const sw_field *field);

/* After a step: 1 = the wire has broken the clip, which then does nothing to it any more. */
int sw_clip_breaks(const sw_clip *clip, const sw_clip_middle *middle, double time, double *history);

/* After a step: which part of its way in or out the wire is on. */
void sw_clip_follow(const sw_clip *clip, const sw_clip_middle *middle, double time,
                    double *history);

/* See sw_force_class. */
int sw_clip_news(const void *args, const double *history, sw_force_news *out);

#endif
