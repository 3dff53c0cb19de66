/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the twist of wires without material frames when holds come and go. While a system lives, a
 * wire's list has the stretches that its spans were made from; the wire between the ends of a wide
 * hold keeps its share of them until the hold lets go. */
#include "body/twist.h"

#include <math.h>

#include "base/alloc.h"
#include "base/each.h"
#include "body/build.h"
#include "link/hold.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"

/* Arc lengths of a span's ends, shifted by the give of its clamps: it twists as evenly as a wire
 * from one to the other [m]. */
typedef struct reach {
  double from, to;
} reach;

static reach reach_of(const sw_plan *p, const sw_span *span) {
  return (reach){p->s[span->first] - p->clamps[span->left].twist,
                 p->s[span->last + 1] + p->clamps[span->right].twist};
}

/* Returns the length of an old stretch that belongs to a span from s1 to s2, which reaches further
 * by the give of its clamps. Without it an imposed grip on a wire that a frozen one holds had a
 * torque of a sixth of the wire's (spec/physics/untwisted_release_spec). */
static double common_of(const sw_twisted *old, double s1, double s2, reach at) {
  const double from = old->s1 < s1 ? fmax(old->s1, fmin(s1, at.from)) : old->s1;
  const double to = old->s2 > s2 ? fmin(old->s2, fmax(s2, at.to)) : old->s2;
  return to - from;
}

/* Returns the twist of the old stretches from s1 to s2. Wire outside all stretches has unwound
 * through a free end to its unloaded twist [rad]. */
static double twist_of(const sw_scene_wire *wire, double s1, double s2, reach at) {
  double twist = 0, unwound = s2 - s1;
  SW_ITEMS(const sw_twisted, old, wire->twisted, wire->twisted_count) {
    const double covered = fmin(s2, old->s2) - fmax(s1, old->s1);
    if (!(covered > 0)) continue;
    twist += old->twist * common_of(old, s1, s2, at) / (old->s2 - old->s1);
    unwound -= covered;
  }
  return twist + wire->beam.rest_twist * unwound;
}

/* What a hold keeps of its wire's twist: between its ends, and between the spans that reach in. */
static sw_twisted held_of(const sw_scene_wire *wire, const sw_hold *h) {
  const double s1 = h->s1 + fmax(0.0, h->give[0].twist);
  const double s2 = h->s2 - fmax(0.0, h->give[1].twist);
  return (sw_twisted){s1, s2, s2 > s1 ? twist_of(wire, s1, s2, (reach){s1, s2}) : 0.0};
}

static sw_status keep_twist_of(sw_scene *s, size_t w) {
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  sw_scene_wire *wire = sw_scene_wire_in(s, w);
  const size_t spans = b->has_twist ? b->plan->span_count : 0;
  sw_twisted *list = sw_alloc(spans + system->hold_count, sizeof *list);
  if (!list) return SW_ENOMEM;
  size_t count = 0;
  for (; count < spans; count++) {
    const reach at = reach_of(b->plan, &b->plan->spans[count]);
    list[count] = (sw_twisted){at.from, at.to, system->twist[b->first_span + count]};
  }
  for (size_t k = 0; b->has_twist && k < system->hold_count; k++) {
    const sw_hold *h = sw_scene_held_by(s, k);
    if (h->wire != w || !h->cls->hold->direction) continue;
    const sw_twisted held = held_of(wire, h);
    if (held.s2 > held.s1) list[count++] = held;
  }
  sw_free(wire->twisted);
  wire->twisted = list;
  wire->twisted_count = count;
  return SW_OK;
}

sw_status sw_scene_keep_twist(sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  for (size_t k = 0; k < system->hold_count; k++) {
    const double *q = system->turn + 4 * k;
    sw_scene_held_by(s, k)->turn = (sw_quat){q[0], q[1], q[2], q[3]};
  }
  for (size_t w = 0; w < system->body_count; w++)
    if (!sw_scene_wire_in(s, w)->untwisted) /* else nothing has moved yet */
      SW_TRY(keep_twist_of(s, w));
  return SW_OK;
}

sw_status sw_scene_draw_untwisted(sw_scene_wire *w) {
  sw_twisted *list = sw_alloc(1, sizeof *list);
  if (!list) return SW_ENOMEM;
  *list = (sw_twisted){w->mesh.s[0], w->mesh.s[w->mesh.n - 1], 0};
  sw_free(w->twisted);
  w->twisted = list;
  w->twisted_count = 1;
  w->untwisted = 1;
  return SW_OK;
}

static void store_turn(double *out, sw_quat q) {
  out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
}

void sw_scene_inherit_twist(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  for (size_t k = 0; k < system->hold_count; k++)
    store_turn(system->turn + 4 * k, sw_scene_held_by(s, k)->turn);
  for (size_t w = 0; w < system->body_count; w++) {
    const sw_body *b = &system->bodies[w];
    for (size_t k = 0; b->has_twist && k < b->plan->span_count; k++) {
      const sw_span *span = &b->plan->spans[k];
      const double s1 = b->plan->s[span->first], s2 = b->plan->s[span->last + 1];
      system->twist[b->first_span + k] +=
          twist_of(sw_scene_wire_in(s, w), s1, s2, reach_of(b->plan, span));
    }
  }
}
