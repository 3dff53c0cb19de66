/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is recorded of wires and forces at every accepted state, for series. */
#ifndef SW_WATCH_WATCHES_H
#define SW_WATCH_WATCHES_H

#include "base/tape.h"
#include "read/reading.h"
#include "record/watches.h"
#include "scene/scene.h"
#include "scene/values.h"

/* Add a row of the accepted state. */
sw_status sw_watch_wire(sw_scene *scene, size_t wire, const sw_wire_extremes *now, sw_error *err);
/* The same of all forces that tell what they do to wires (clips, ties). */
sw_status sw_watch_forces(sw_scene *scene, sw_error *err);
/* Ties between wires. */
sw_status sw_watch_ties(sw_scene *scene, sw_error *err);
void sw_watches_clear(sw_watches *watches);
void sw_tape_watches(sw_tape *tape, sw_watches *watches);

#endif
