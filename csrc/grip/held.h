/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the pads of a tool hold at present: the touches of each wire, their friction and its slip.
 */
#ifndef SW_GRIP_HELD_H
#define SW_GRIP_HELD_H

#include "contact/contact.h"
#include "scene/gripper.h"
#include "scene/scene.h"

typedef struct sw_held {
  double normal, most; /* normal forces; largest friction that these allow [N] */
  double sliding;      /* normal force of the touches that slide [N] */
  double place;        /* mean of the touches' arc lengths, weighted by normal forces [m] */
  unsigned press;      /* one bit for each finger that presses */
  double margin;     /* largest one of a wire: friction and its moment over the touches' resistance,
                        from 0 to 1 [-] */
  sw_vec slip, turn; /* way and turn of the wires between the pads in the last step, in the
                        tool's axes [m], [rad] */
} sw_held;

/* Returns the finger of the pad that pushes at touch k; below 0: none does [-]. */
int sw_held_finger(const sw_contact *contact, const sw_tool *tool, size_t k);
/* Reads the touches of the tool's pads. slipped, turned: slip and turn before this step, in the
 * tool's axes [m], [rad]; they grow by those of this step. *furthest: the longest way of a touch by
 * both [m], as it was if nothing presses. SW_ENOMEM. */
sw_status sw_held_look(sw_scene *scene, sw_tool *tool, sw_held *out, sw_vec *slipped,
                       sw_vec *turned, double *furthest, sw_error *err);
/* Call when a search for a pose has taken a step: adds the slip and turn of that step to t->way and
 * t->swing. Touches know the slip of the last step only. SW_ENOMEM and errors of its motion. */
sw_status sw_held_search(sw_scene *scene, sw_tool *tool, sw_error *err);

#endif
