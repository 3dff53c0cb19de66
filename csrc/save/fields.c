/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fields of a scene's objects as they lie in memory, for specs that look whether a tape has
 * them all: those of a scene that was restored in place are those of before. */
#include "base/alloc.h"
#include "body/touching.h"
#include "link/joint.h"
#include "save/file.h"
#include "save/save.h"
#include "scene/forces.h"
#include "scene/obstacle.h"
#include "scene/wire.h"
#include "scene/world.h"
#include "watch/zone.h"

/* What need not come back: it is found anew, or grows as it likes. */
static void blank_scene(sw_scene *s) {
  s->serial = 0, s->snapshots = NULL, s->restoring = NULL;
  s->contact_steps = (sw_log){0};
  s->course.parts = 0, s->course.covered = 0, s->part = 0;
  s->course.jerks = 0;
  memset(&s->system, 0, sizeof s->system);
  memset(&s->course.stepper, 0, sizeof s->course.stepper);
  s->builds = 0;
  s->gone_capacity = 0, s->gone = NULL;
  s->frames.capacity = s->events.capacity = s->watches.capacity = s->watches.next = 0;
  s->frames.list = NULL, s->events.list = NULL, s->watches.list = NULL;
  s->frames.memory = 0;
  memset(&s->why, 0, sizeof s->why);
  s->contact = NULL, s->pairs = NULL, s->grains = NULL, s->crowd = NULL, s->hold_loads = NULL;
  sw_books *b = &s->books; /* what it measures anew */
  memset(&b->now, 0, sizeof b->now);
  memset(&b->powers, 0, sizeof b->powers);
  memset(&b->step, 0, sizeof b->step);
  b->dissipated = b->rubbed_off = b->mass = b->longest = b->weight = b->bending = 0;
  b->has_powers = b->known = 0;
  b->contact = 0, b->hold_room = b->obstacle_room = 0;
  b->holds = NULL, b->obstacles = NULL;
}

static void blank_wire(sw_scene_wire *w) {
  w->window.room = NULL, w->window.edges = 0;
  if (!w->window.marks) memset(&w->window, 0, sizeof w->window);
  w->zones.past = NULL, w->zones.gaps = w->zones.x = NULL;
  w->wear.places = NULL, w->wear.cycles = NULL, w->wear.across = NULL;
  w->strand.rate = NULL, w->twisted = NULL;
}

static void put_list(sw_tape *t, const void *list, size_t count, size_t size) {
  if (count) sw_tape_raw(t, (void *)(uintptr_t)list, count * size);
}

sw_status sw_scene_fields(const sw_scene *s, unsigned char **out, size_t *size) {
  sw_scene *copy = sw_alloc(1, sizeof *copy);
  if (!copy) return SW_ENOMEM;
  sw_tape t = sw_tape_writer(NULL);
  *copy = *s;
  blank_scene(copy);
  sw_tape_raw(&t, copy, sizeof *copy);
  sw_free(copy);
  for (size_t k = 0; k < s->wire_count; k++) {
    sw_scene_wire wire = s->wires[k];
    blank_wire(&wire);
    sw_tape_raw(&t, &wire, sizeof wire);
  }
  for (size_t k = 0; k < s->obstacle_count; k++) {
    sw_scene_obstacle obstacle = s->obstacles[k];
    obstacle.logged = 0;
    sw_tape_raw(&t, &obstacle, sizeof obstacle);
  }
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_hold hold = s->holds[k];
    hold.node = hold.number = hold.slider.rail = 0;
    sw_tape_raw(&t, &hold, sizeof hold);
  }
  put_list(&t, s->gone, s->gone_count, sizeof *s->gone);
  put_list(&t, s->tools, s->tool_count, sizeof *s->tools);
  put_list(&t, s->forces, s->force_count, sizeof *s->forces);
  for (size_t k = 0; k < s->join_count; k++) {
    sw_joint join = s->joins[k];
    join.spring = 0;
    sw_tape_raw(&t, &join, sizeof join);
  }
  put_list(&t, s->zones.list, s->zones.count, sizeof *s->zones.list);
  put_list(&t, s->rules.list, s->rules.count, sizeof *s->rules.list);
  put_list(&t, s->events.list, s->events.count, sizeof *s->events.list);
  if (!sw_tape_good(&t)) sw_tape_free(&t);
  *out = t.bytes, *size = t.size;
  return t.status;
}
