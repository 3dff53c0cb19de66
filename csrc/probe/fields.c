/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Returns the bytes of the structs of a scene's objects. Specs compare them before a snapshot and
 * after restoring it in place, to check that a tape has every field. */
#include "bind/child.h"
#include "body/touching.h"
#include "link/joint.h"
#include "probe/probe.h"
#include "scene/forces.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/wire.h"
#include "scene/world.h"
#include "watch/zone.h"

/* Clears the fields that a tape need not have: they are computed again, or are growing buffers. */
static void blank_scene(sw_scene *s) {
  s->serial = 0, s->snapshots = NULL, s->restoring = NULL;
  s->contact_steps = (sw_log){0};
  s->course.parts = 0, s->course.covered = 0, s->part = 0;
  s->course.jerks = s->course.smooth = 0;
  memset(&s->system, 0, sizeof s->system);
  memset(&s->course.stepper, 0, sizeof s->course.stepper);
  s->builds = 0;
  s->gone_capacity = 0, s->gone = NULL;
  s->frames.capacity = s->events.capacity = s->watches.capacity = s->watches.next = 0;
  s->frames.list = NULL, s->events.list = NULL, s->watches.list = NULL;
  s->frames.memory = 0;
  memset(&s->why, 0, sizeof s->why);
  s->contact = NULL, s->pairs = NULL, s->grains = NULL, s->crowd = NULL, s->through = NULL;
  s->hold_loads = NULL;
  sw_books *b = &s->books; /* these fields are computed again */
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
  w->spun.places = NULL, w->spun.across = NULL;
  w->strand.rate = NULL, w->twisted = NULL;
}

static void put(luaL_Buffer *out, const void *list, size_t count, size_t size) {
  if (count) luaL_addlstring(out, list, count * size);
}

static void put_holds(luaL_Buffer *out, const sw_scene *s) {
  SW_EACH(hold, h, s) {
    sw_hold hold = *h;
    hold.node = hold.number = hold.rail = 0;
    put(out, &hold, 1, sizeof hold);
  }
  SW_EACH(join, j, s) {
    sw_joint join = *j;
    join.spring = 0;
    put(out, &join, 1, sizeof join);
  }
}

int lsw_probe_fields(lua_State *L) {
  const sw_scene *s = lsw_check_scene(L);
  luaL_Buffer out;
  luaL_buffinit(L, &out);
  sw_scene copy = *s;
  blank_scene(&copy);
  put(&out, &copy, 1, sizeof copy);
  SW_EACH(wire, w, s) {
    sw_scene_wire wire = *w;
    blank_wire(&wire);
    put(&out, &wire, 1, sizeof wire);
  }
  SW_EACH(obstacle, o, s) {
    sw_scene_obstacle obstacle = *o;
    obstacle.logged = 0;
    put(&out, &obstacle, 1, sizeof obstacle);
  }
  put_holds(&out, s);
  put(&out, s->gone, s->gone_count, sizeof *s->gone);
  SW_EACH(tool, t, s) {
    sw_tool tool = *t;
    tool.room = NULL, tool.room_size = 0;
    put(&out, &tool, 1, sizeof tool);
  }
  put(&out, s->forces, s->force_count, sizeof *s->forces);
  put(&out, s->zones.list, s->zones.count, sizeof *s->zones.list);
  put(&out, s->rules.list, s->rules.count, sizeof *s->rules.list);
  put(&out, s->events.list, s->events.count, sizeof *s->events.list);
  luaL_pushresult(&out);
  return 1;
}
