/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Distances of wires to zones at steps, and lower bounds between steps. */
#include "watch/zone.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "record/zone.h"
#include "scene/course.h"
#include "scene/driven.h"
#include "scene/lists.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"
#include "watch/zone_piece.h"

static const sw_param rows[] = {
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_zone_args, name),
     "name used in checks"},
    {"at", SW_PARAM_VECTOR, "m", 0, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(sw_zone_args, at),
     "place of the shape's origin"},
    {"rotation", SW_PARAM_ROTATION, "rad", 0, 0, 0, 0, NULL, offsetof(sw_zone_args, rotation),
     "rotation of the shape: { axis = {x, y, z}, angle = } or quaternion {w, x, y, z}"},
    {"temperature", SW_PARAM_NUMBER, "degC", NAN, -273.15, 5000, 0, NULL,
     offsetof(sw_zone_args, temperature),
     "temperature of wires in the zone; a zone without it is forbidden for wires"},
    {"on", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "an obstacle to which the zone is fixed, as they are placed now"},
};
const sw_params sw_zone_params = SW_PARAMS("zone", rows);

void sw_scene_clear_zone(sw_zone *z) { sw_shape_release(z->shape); }

sw_status sw_scene_add_zone(sw_scene *s, sw_shape *shape, const sw_zone_args *args, sw_error *err) {
  sw_zones *zones = sw_scene_zones_of(s);
  SW_TRY(sw_scene_editable(s, err));
  if (SW_GROW(zones->list, zones->capacity, zones->count + 1) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  sw_zone *z = &zones->list[zones->count];
  *z = (sw_zone){.pose = {args->at, args->rotation}, .temperature = args->temperature};
  if (args->on.generation) {
    SW_TRY(sw_scene_object_pose(s, SW_OF_OBSTACLE, args->on, &z->carrier, err));
    const sw_quat back = sw_quat_conj(z->carrier.q);
    z->on = args->on;
    z->local =
        (sw_pose){sw_pose_local(z->carrier, z->pose.p), sw_quat_unit(sw_quat_mul(back, z->pose.q))};
  }
  sw_scene_give_name(z->name, args->name, "zone", zones->count);
  for (size_t k = 0; k < zones->count; k++)
    if (strcmp(zones->list[k].name, z->name) == 0)
      return sw_fail(err, SW_EINVAL, "scene '%s': there is another zone '%s'", sw_scene_name(s),
                     z->name);
  z->shape = sw_shape_retain(shape);
  zones->count++;
  return SW_OK;
}

size_t sw_scene_zones(const sw_scene *s) { return sw_scene_zones_of(s)->count; }
const sw_zone *sw_scene_zone(const sw_scene *s, size_t k) { return &sw_scene_zones_of(s)->list[k]; }

const sw_zone_past *sw_scene_zone_past(const sw_scene *s, sw_handle h, size_t k) {
  const sw_scene_wire *w = sw_scene_find_body(s, h, NULL);
  return w && k < w->zones.zones && w->zones.past[k].until > -HUGE_VAL ? &w->zones.past[k] : NULL;
}

/* --- distances ------------------------------------------------------------------- */

static double gap_at(const sw_shape *shape, sw_vec p) {
  sw_closest at;
  return sw_shape_point(shape, p, HUGE_VAL, &at) ? at.gap : HUGE_VAL;
}

/* Returns the gap between the piece a-b and the zone; along: where on the piece, 0 to 1. */
static double gap_of(const sw_zone *z, sw_vec a, sw_vec b, double *along) {
  sw_closest list[SW_CLOSEST_MAX];
  const sw_vec p = sw_pose_local(z->pose, a), q = sw_pose_local(z->pose, b);
  const double one = gap_at(z->shape, p), two = gap_at(z->shape, q);
  double least = fmin(one, two);
  *along = two < one;
  const int count = sw_shape_segment(z->shape, p, q, HUGE_VAL, list);
  for (int k = 0; k < count; k++)
    if (list[k].gap < least) least = list[k].gap, *along = list[k].at;
  return least;
}

/* Returns the larger shift of the piece's ends since the last step's end. */
static double moved(const sw_zone_watch *w, size_t e, sw_vec from, sw_vec to) {
  return fmax(sw_dist(sw_load(w->x + 6 * e), from), sw_dist(sw_load(w->x + 6 * e + 3), to));
}

/* Returns the turn of the zone's obstacle since the last step's end [rad]. */
static double turned(const sw_zone *z, const sw_zone_past *past) {
  return sw_norm(sw_quat_log(sw_quat_mul(z->carrier.q, sw_quat_conj(past->before.q))));
}

/* Returns a bound of the path length of a point in the obstacle's axes. The point moves straight at
 * constant speed, relative to the obstacle by c; the obstacle turns at a constant rate by an angle;
 * r is the largest distance between them. The path is longer than its chord by (2 angle c + angle^2
 * r) / 3 at most, a third of its largest second derivative. */
static double way_in(const sw_zone *z, const sw_zone_past *past, double angle, sw_vec from,
                     sw_vec to) {
  const sw_vec a = sw_pose_local(past->before, from), b = sw_pose_local(z->carrier, to);
  const double c = sw_norm(sw_sub(sw_sub(to, z->carrier.p), sw_sub(from, past->before.p)));
  const double r = fmax(sw_norm(a), sw_norm(b));
  return sw_dist(a, b) + (2 * angle * c + angle * angle * r) / 3;
}

/* Returns how far an end of the piece has moved since then, as seen from the zone. */
static double passed(const sw_zone *z, const sw_zone_past *past, const sw_zone_watch *w, size_t e,
                     sw_vec from, sw_vec to) {
  if (!z->on.generation) return moved(w, e, from, to);
  const double angle = turned(z, past);
  return fmax(way_in(z, past, angle, sw_load(w->x + 6 * e), from),
              way_in(z, past, angle, sw_load(w->x + 6 * e + 3), to));
}

/* Returns the largest distance that any node may have gone since a time. */
static double farthest(const sw_scene *s, const sw_body *b, double since) {
  double most = 0;
  if (!(sw_scene_time(s) > since)) return 0;
  if (!(sw_scene_course(s)->span > 0)) return HUGE_VAL; /* rest poses have no speeds */
  for (size_t i = 0; i < b->plan->nodes; i++)
    most = fmax(most, sw_norm(sw_vec_at(sw_scene_system(s)->v, b->first_node + i)));
  return most * (sw_scene_time(s) - since);
}

/* The same as seen from the zone. */
static double farthest_from(const sw_scene *s, const sw_body *b, const sw_zone *z,
                            const sw_zone_past *past) {
  const double far = farthest(s, b, past->until);
  if (!z->on.generation) return far;
  const double shift = sw_dist(past->before.p, z->carrier.p);
  double r = 0;
  for (size_t i = 0; i < b->plan->nodes; i++)
    r = fmax(r, sw_dist(sw_vec_at(sw_scene_system(s)->x, b->first_node + i), z->carrier.p));
  return far + shift + turned(z, past) * (r + far + shift);
}

static void note_zone(const sw_scene *s, size_t w, size_t k, int same) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  sw_zone_watch *watch = &sw_scene_wire_in(s, w)->zones;
  sw_zone_past *past = &watch->past[k];
  const sw_zone *zone = &sw_scene_zones_of(s)->list[k];
  const int seen = past->until > -HUGE_VAL;
  const double before = past->last, far = seen && !same ? farthest_from(s, b, zone, past) : 0;
  const sw_zone_body whole = sw_zone_body_of(system, b);
  double *gaps = watch->gaps + k * watch->edges;
  past->last = HUGE_VAL;
  for (size_t e = 0; e < watch->edges; e++) {
    const sw_zone_piece p = sw_zone_piece_of(&whole, e);
    const sw_vec from = p.end[0], to = p.end[1];
    double along;
    const double gap = gap_of(zone, from, to, &along) - p.skin;
    /* a place at distance `old` before and `gap` at present was never nearer than this */
    const double way = !same ? far : seen ? passed(zone, past, watch, e, from, to) : 0;
    const double old = same ? gaps[e] : before;
    past->between = fmin(past->between, seen ? fmin(gap, 0.5 * (old + gap - way)) : gap);
    gaps[e] = gap, past->last = fmin(past->last, gap);
    if (gap < past->gap)
      past->gap = gap, past->s = p.s[0] + along * (p.s[1] - p.s[0]), past->time = sw_scene_time(s);
  }
  if (past->last < 0 && seen) past->inside += sw_scene_time(s) - past->until;
  past->until = sw_scene_time(s), past->before = zone->carrier;
}

static sw_status fit(sw_scene *s, size_t w, int *same) {
  sw_zone_watch *watch = &sw_scene_wire_in(s, w)->zones;
  const sw_system *system = sw_scene_system(s);
  const size_t pieces = sw_zone_body_of(system, &system->bodies[w]).count;
  *same = watch->edges == pieces && watch->zones == sw_scene_zones_of(s)->count;
  if (*same) return SW_OK;
  sw_zone_watch new = {.zones = sw_scene_zones_of(s)->count, .edges = pieces};
  if (SW_ALLOC_ALL(SW_ROOM(new.past, new.zones), SW_ROOM(new.gaps, new.zones *pieces),
                   SW_ROOM(new.x, 6 * pieces)) != SW_OK) {
    sw_zones_forget(&new);
    return SW_ENOMEM;
  }
  for (size_t k = 0; k < new.zones; k++)
    new.past[k] = k < watch->zones
                      ? watch->past[k]
                      : (sw_zone_past){.gap = HUGE_VAL, .between = HUGE_VAL, .until = -HUGE_VAL};
  sw_zones_forget(watch);
  *watch = new;
  return SW_OK;
}

/* 0 if the zone's obstacle is gone: the zone goes with it. */
static int is_there(const sw_scene *s, const sw_zone *z) {
  return !z->on.generation || sw_scene_find_obstacle(s, z->on, NULL);
}

/* Moves zones with their obstacles. */
static sw_status carry(sw_scene *s, sw_error *err) {
  const sw_zones *zones = sw_scene_zones_of(s);
  for (size_t k = 0; k < zones->count; k++) {
    sw_zone *z = &zones->list[k];
    if (!z->on.generation || !is_there(s, z)) continue;
    SW_TRY(sw_scene_object_pose(s, SW_OF_OBSTACLE, z->on, &z->carrier, err));
    z->pose = sw_pose_within(z->carrier, z->local);
  }
  return SW_OK;
}

sw_status sw_zones_note(sw_scene *s, size_t w, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  int same;
  if (!sw_scene_zones_of(s)->count) return SW_OK;
  if (fit(s, w, &same) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "out of memory for zones near '%s'",
                   sw_scene_wire_in(s, w)->name);
  SW_TRY(carry(s, err));
  sw_zone_watch *watch = &sw_scene_wire_in(s, w)->zones;
  for (size_t k = 0; k < watch->zones; k++)
    if (is_there(s, &sw_scene_zones_of(s)->list[k])) note_zone(s, w, k, same);
  const sw_zone_body whole = sw_zone_body_of(system, &system->bodies[w]);
  for (size_t e = 0; e < watch->edges; e++) {
    const sw_zone_piece p = sw_zone_piece_of(&whole, e);
    sw_store(watch->x + 6 * e, p.end[0]), sw_store(watch->x + 6 * e + 3, p.end[1]);
  }
  return SW_OK;
}

/* --- on a tape ------------------------------------------------------------------- */

void sw_tape_zone(sw_tape *t, sw_zone *z) {
  SW_TAPE_STRUCT(t, sw_zone, 256);
  sw_tape_name(t, z->name), sw_tape_shape(t, &z->shape);
  sw_tape_pose(t, &z->pose), sw_tape_double(t, &z->temperature);
  sw_tape_raw(t, &z->on, sizeof z->on), sw_tape_pose(t, &z->carrier), sw_tape_pose(t, &z->local);
  sw_tape_expect(t, z->shape && sw_finite(z->pose.p) && sw_finite(z->local.p), "a zone");
}
