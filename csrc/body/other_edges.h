/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the turn of holds and joints against one another when a wire gets other edges. */
#ifndef SW_BODY_OTHER_EDGES_H
#define SW_BODY_OTHER_EDGES_H

#include "body/build.h"

/* While the scene is not built: the wire's mesh has replaced `old`, with the same arc lengths.
 * Changes its twist between holds and joints so that these keep their turns. */
void sw_scene_correct_twist(sw_scene *scene, size_t wire, const sw_mesh *old);

/* The same when a hold has come between two others (it is not in the list yet), or has let go. */
void sw_scene_correct_hold(const sw_scene *scene, const sw_hold *hold, const sw_mesh *old,
                           int comes);

/* The ends of a wire's spans, with its mesh. */
typedef struct sw_span_ends {
  sw_mesh mesh; /* arc lengths and places only */
  size_t count;
  struct sw_span_end {
    double s1, s2;   /* [m] */
    sw_vec from, to; /* directors [-] */
    sw_vec mark[2];  /* directions across them that turn with the joints, or zero [-] */
  } * span;
} sw_span_ends;

/* The same for a scene that is built, exact also at joints: reads the spans' ends before and turns
 * the spans when the wire has its other edges. SW_ENOMEM. */
sw_status sw_scene_read_spans(sw_scene *scene, size_t wire, sw_span_ends *out);
void sw_scene_turn_spans(sw_scene *scene, size_t wire, const sw_span_ends *old);
void sw_span_ends_free(sw_span_ends *ends);

#endif
