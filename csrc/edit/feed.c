/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a user asks of a feed (link/feed.c). */
#include <math.h>

#include "edit/links.h"
#include "link/hold.h"
#include "scene/course.h"
#include "scene/lookup.h"
#include "scene/parts.h"

static sw_hold *feeding(sw_scene *s, sw_handle hold, sw_error *err) {
  sw_hold *h = sw_scene_living_hold(s, hold, err);
  if (!h || sw_hold_passes(h)) return h;
  sw_fail(err, SW_EINVAL, "%s '%s' feeds nothing: the wire slides through those of scene:feed only",
          h->cls->name, h->name);
  return NULL;
}

/* Stop where it is; what follows starts from now. */
static sw_status open_feed(sw_scene *s, sw_handle hold, sw_hold **h, sw_error *err) {
  *h = feeding(s, hold, err);
  if (!*h) return SW_EDEAD;
  return sw_scene_editable(s, err);
}

static void stop(sw_scene *s, sw_hold *h) {
  sw_feed_stop(h, sw_scene_time(s));
  sw_course_jump(sw_scene_course(s));
}

sw_status sw_scene_feed_speed(sw_scene *s, sw_handle hold, double speed, sw_error *err) {
  sw_hold *h;
  SW_TRY(open_feed(s, hold, &h, err));
  stop(s, h);
  h->feed.speed = speed;
  return SW_OK;
}

sw_status sw_scene_feed_push(sw_scene *s, sw_handle hold, double force, sw_error *err) {
  sw_hold *h;
  SW_TRY(open_feed(s, hold, &h, err));
  const sw_feed_now now = sw_feed_at(h, sw_scene_time(s));
  stop(s, h);
  h->feed.push = force;
  h->feed.slip_speed = now.speed;
  return SW_OK;
}

sw_status sw_scene_feed_limit(sw_scene *s, sw_handle hold, double force, sw_error *err) {
  sw_hold *h;
  SW_TRY(open_feed(s, hold, &h, err));
  h->feed.limit = force;
  if (isnan(force) && isnan(h->feed.push))
    h->feed.slip_speed = h->feed.slip_growth = h->feed.slip_way = 0;
  return SW_OK;
}

sw_status sw_scene_feed_length(sw_scene *s, sw_handle hold, sw_motion *motion, double length,
                               sw_error *err) {
  sw_hold *h;
  SW_TRY(open_feed(s, hold, &h, err));
  const double there = sw_feed_reserve(h, &sw_scene_wire_in(s, h->wire)->mesh, length);
  if (!(fabs(length) < there))
    return sw_fail(err, SW_EINVAL,
                   "feed '%s': length = %g m is not allowed; %.6g m of wire '%s' are there",
                   h->name, length, there, sw_scene_wire_in(s, h->wire)->name);
  stop(s, h);
  h->feed.motion = sw_motion_retain(motion);
  h->feed.start = sw_scene_time(s);
  return SW_OK;
}

sw_status sw_scene_feed_state(sw_scene *s, sw_handle hold, sw_feed_state *out, sw_error *err) {
  SW_TRY(sw_scene_readable(s, err));
  SW_FIND(const sw_hold, h, feeding(s, hold, err));
  const sw_feed_now now = sw_feed_at(h, sw_scene_time(s));
  *out = (sw_feed_state){now.fed, now.speed, h->feed.drive, h->feed.limit};
  return SW_OK;
}
