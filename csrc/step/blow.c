/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows of wires on obstacles, followed in parts of a step. */
#include "step/blow.h"

#include <math.h>

#include "contact/contact.h"
#include "link/hold.h"
#include "scene/world.h"

/* A step as long as a blow lasts smears it: what is pressed gives way by no law but that of the
 * step, and a wire that is pushed on buckles at once instead of bearing the push for a while.
 * Harder ones than any before are followed in parts for so long [s], in at least so many of them a
 * step [-], but none shorter than this [s]. */
static const double BLOW = 0.01, MOST_PARTS = 100, SHORTEST_PART = 1e-4;
/* What goes on longer is no blow but a rattle, and costs too much to be followed [s]. */
static const double LONGEST_BLOW = 0.03;
/* From one that is followed to the next: a wire that tumbles would be followed all the time [s]. */
static const double BETWEEN_BLOWS = 0.1;

double sw_blow_part(const sw_scene *s, double h) {
  return s->time < s->course.blow_until ? fmin(h, fmax(s->course.blow_part, SHORTEST_PART)) : h;
}

/* Every part that is refused, or makes energy, takes this share off the time that a blow is
 * followed for: a wire that is driven into something makes energy in parts of any size [-]. */
static const double REFUSED = 1.0 / 16;

/* Parts refused down to this share of those that follow it: it is not followed any more, for
 * contact takes depth as it comes only in far smaller ones yet [-]. */
static const double SMALLEST_FOLLOWED = 1.0 / 16;

void sw_blow_refused(sw_scene *s, double part) {
  if (!(s->time < s->course.blow_until)) return;
  if (part < SMALLEST_FOLLOWED * s->course.blow_part) s->course.blow_until = s->time;
  s->course.blow_since -= REFUSED * LONGEST_BLOW;
  s->course.blow_until = fmin(s->course.blow_until, s->course.blow_since + LONGEST_BLOW);
}

/* Nodes that go into a guide press on what is beside it by no blow. */
static int any_feed(const sw_scene *s) {
  for (size_t k = 0; k < s->hold_count; k++)
    if (s->holds[k].alive && sw_hold_passes(&s->holds[k])) return 1;
  return 0;
}

/* Of more wires one strikes all the time, and all would take the parts of each [-]. */
enum { MOST_WIRES = 32 };

/* Parts of a step with such a jolt: a power of two, so that scenes which differ by little take the
 * same steps [-]. */
static double parts_for(double jolt) {
  return exp2(ceil(log2(fmin(jolt * fmax(2.0, jolt), MOST_PARTS))));
}

int sw_blow_begins(sw_scene *s, double h) {
  const int followed = s->time < s->course.blow_until;
  if (s->wire_count > MOST_WIRES || !s->contact || s->pairs || s->grains ||
      (!followed && !(h > 1.01 * SHORTEST_PART)) || any_feed(s))
    return 0;
  if (!followed && s->course.blow_until > 0 && s->time < s->course.blow_since + BETWEEN_BLOWS)
    return 0;
  const double jolt = sw_contact_jolt(s->contact, &s->system, followed);
  if (!(jolt > 0)) return 0;
  if (!followed) s->course.blow_since = s->time;
  s->course.blow_until =
      fmin(s->time + fmax(BLOW, h), s->course.blow_since + fmax(LONGEST_BLOW, h));
  if (!followed) s->course.blow_part = fmax(SHORTEST_PART, h / parts_for(jolt));
  return !followed;
}
