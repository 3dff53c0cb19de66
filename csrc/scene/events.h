/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The events of a run in one list: slips, crashes, jumps of equilibrium, energy from nowhere. The
 * list is bounded; repeats are merged. */
#ifndef SW_SCENE_EVENTS_H
#define SW_SCENE_EVENTS_H

#include "base/tape.h"
#include "scene/account.h"
#include "scene/scene.h"

enum { SW_EVENTS_MOST = 512 }; /* most entries of the list [-] */

typedef struct sw_events {
  sw_event *list;
  size_t count, capacity;
  size_t dropped; /* events lost because the list was full [-] */
} sw_events;

/* Books an event at the scene's time. kind: one word; object: a name, or "". arc: arc length [m] or
 * NAN. value: in the text's unit, or NAN. The text is one sentence. The same kind of event of the
 * same object soon after the last one is a repeat: it is counted, and the largest value stays with
 * its time, place and text. Without memory the event only counts as dropped. */
__attribute__((format(printf, 6, 7))) void sw_scene_tell(sw_scene *scene, const char *kind,
                                                         const char *object, double arc,
                                                         double value, const char *format, ...);

/* Extends the latest event of this kind and object to `time`, so that another one soon after is a
 * repeat. Returns it, or NULL if there is none. */
sw_event *sw_events_go_on(sw_events *events, const char *kind, const char *object, double time);

void sw_events_clear(sw_events *events);
void sw_tape_event(sw_tape *tape, sw_event *event);

#endif
