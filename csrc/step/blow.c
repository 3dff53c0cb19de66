/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows of wires on obstacles and of ties that snap taut. Their steps are taken in parts
 * (substeps). */
#include "step/blow.h"

#include <math.h>

#include "contact/jolt.h"
#include "link/hold.h"
#include "mutual/jolt.h"
#include "scene/course.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/coarse.h"
#include "watch/observe.h"

/* A step as long as a blow smears the blow: the force then depends on the step, not on the
 * stiffness, and a pushed wire buckles at once instead of carrying the push for a while. So steps
 * are divided for BLOW [s] after a blow that is harder than all before it. A step gets at most
 * MOST_PARTS parts (rounded up to a power of two) [-], none shorter than SW_SHORTEST_PART. The
 * limit for a wire that is pushed by its end is SHORTEST_PUSH [s]. */
static const double BLOW = 0.01, MOST_PARTS = 100, SHORTEST_PUSH = 1e-5;
/* A blow that lasts longer is a rattle, whose parts cost too much [s]. */
static const double LONGEST_BLOW = 0.03;

/* A tie that snaps taut stops the place that it pulls at within 1 to 3 sqrt(m/k), about 0.1 ms for
 * a stiff tie. In parts of 0.1 ms the impulse depends on where in a part it begins: peaks over 10
 * ms of cables with a tie at their end were 20 to 40 % apart for slacks that differ by 0.02 mm. In
 * parts of OF_SWING sqrt(m/k) they are within 3 %, in parts twice as long within 5 %
 * (spec/link/snap_end_spec) [-]. SHORTEST_SNAP: no shorter parts [s]. */
static const double OF_SWING = 0.5, SHORTEST_SNAP = 1e-6;

/* Part for a tie that swings within `time` [s]. */
static double part_of_swing(double time) { return fmax(SHORTEST_SNAP, OF_SWING * time); }

static int is_followed(const sw_scene *s) {
  return sw_scene_time(s) < sw_scene_course(s)->blow_until;
}

/* 1 if ties that snap are followed in a part of size h: during a blow, or in steps as short as the
 * parts of a blow. */
static int follows_ties(const sw_scene *s, double h) {
  return is_followed(s) || h < 1.01 * SW_SHORTEST_PART;
}

double sw_blow_part(const sw_scene *s, double h) {
  const double part = is_followed(s) ? fmax(sw_scene_course(s)->blow_part, SHORTEST_PUSH) : h;
  const double swing = follows_ties(s, h) ? part_of_swing(sw_scene_ties_swing(s)) : h;
  return fmin(h, fmin(part, swing));
}

double sw_blow_snap(const sw_scene *s, double h) {
  sw_snap snap;
  if (!follows_ties(s, h) || !sw_scene_ties_snap(s, 1, &snap)) return h;
  const double part = part_of_swing(snap.time);
  return h > 1.01 * part ? part : h;
}

/* Each part that is refused or makes energy shortens the time of short parts by this share of
 * LONGEST_BLOW. A wire driven into something makes energy in parts of any size. RATTLES: factor on
 * this share where wires touch each other, because these rattle [-]. */
static const double REFUSED = 1.0 / 16, RATTLES = 2.0;

/* Short parts end when a part below this share of the blow's part is refused: contact would accept
 * the depth only in far smaller parts [-]. */
static const double SMALLEST_FOLLOWED = 1.0 / 16;
/* Smallest part that is tried during a blow, over the blow's part [-]. */
static const double SMALLEST_TRIED = 1.0 / 32;

double sw_blow_smallest(const sw_scene *s) {
  const sw_course *course = sw_scene_course(s);
  return is_followed(s) ? SMALLEST_TRIED * course->blow_part : HUGE_VAL;
}

void sw_blow_refused(sw_scene *s, double part) {
  sw_course *course = sw_scene_course(s);
  if (!is_followed(s)) return;
  if (part < SMALLEST_FOLLOWED * course->blow_part) course->blow_until = sw_scene_time(s);
  course->blow_since -= (sw_scene_pairs(s) ? RATTLES : 1.0) * REFUSED * LONGEST_BLOW;
  course->blow_until = fmin(course->blow_until, course->blow_since + LONGEST_BLOW);
}

/* 1 if a drive obeys a force. Such a drive gives way to a blow. Its speed can be found only for
 * steps in which it hardly changes, not for shorter parts. */
static int any_gives_way(const sw_scene *s) {
  SW_EACH(hold, h, s)
    if (h->alive && h->cls->hold->slips && h->cls->hold->slips(h)) return 1;
  return 0;
}

/* Returns the number of parts of a step with this jolt [-]. It is a power of two, so that nearly
 * equal scenes take the same steps. */
static double parts_for(double jolt) {
  return exp2(ceil(log2(fmin(jolt * fmax(2.0, jolt), MOST_PARTS))));
}

/* A tie that snaps taut counts as at least this many times the usual force, which gives 64 parts. A
 * stiff tie throws the wire back within 0.1 ms [-]. */
static const double SNAP = 6.0;

/* The hardest blow of a wire in this run [N]. */
static double *hardest_of(void *scene, size_t wire) { return &sw_scene_wire_in(scene, wire)->blow; }

/* As sw_contact_jolt, for ties. */
static double jolt_of_ties(const sw_scene *s, int followed) {
  sw_snap snap;
  return sw_scene_ties_snap(s, followed, &snap) && snap.jolt > 0 ? fmax(snap.jolt, SNAP) : 0.0;
}

static double jolt_of(sw_scene *s, int followed) {
  sw_course *course = sw_scene_course(s);
  const sw_system *system = sw_scene_system(s);
  sw_contact *contact = sw_scene_contact(s);
  const sw_mutual *const mutual[] = {sw_scene_pairs(s), sw_scene_grains(s)};
  const int dull = course->stepper.plastic;
  double jolt = jolt_of_ties(s, followed);
  if (contact) jolt = fmax(jolt, sw_contact_jolt(contact, system, followed, hardest_of, s));
  for (int k = 0; k < 2; k++)
    if (mutual[k])
      jolt = fmax(jolt, sw_mutual_jolt(mutual[k], system, dull, followed, hardest_of, s));
  return jolt;
}

/* Longest part for a blow with this jolt in a step of h [s]. */
static double part_for(const sw_scene *s, double jolt, double h) {
  const sw_contact *contact = sw_scene_contact(s);
  const double push = contact ? sw_contact_push_part(contact, sw_scene_system(s)) : HUGE_VAL;
  const double part = fmax(SW_SHORTEST_PART, h / parts_for(jolt));
  return push < part ? fmax(SHORTEST_PUSH, push) : part;
}

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

/* Returns why blows do not divide steps in the scene's present state; NULL: they do. */
static const char *why_whole(const sw_scene *s) {
  if (sw_coarse_is_crowd(s)) return "more than " TEXT(SW_MOST_MOVING) " wires move";
  if (sw_coarse_is_bundle(s)) return "more than " TEXT(SW_MOST_NEAR) " wires touch each other";
  if (sw_scene_grains(s) && sw_grains_have_loose(sw_scene_grains(s)))
    return "objects of particles touch others";
  return any_gives_way(s) ? "a feed obeys a force" : NULL;
}

/* Shorter steps resolve most blows as well as parts do: no event [s]. */
static const double LIKE_PARTS = 3e-4;

static void tell(sw_scene *s, double h, const char *why) {
  if (!(h > LIKE_PARTS)) return;
  const double jolt = jolt_of(s, 0), part = part_for(s, jolt, h);
  if (!(jolt > 0) || !(h > 1.01 * part)) return;
  sw_scene_tell(s, "coarse", "", NAN, jolt,
                "a blow of %.3g times its wire's %s is spread over a step of %.3g ms, because "
                "%s: peaks may be wrong; run again with dt = %.2g s and compare the peaks",
                jolt, sw_norm(sw_scene_gravity(s)) > 0 ? "weight" : "EI/length^2", 1e3 * h, why,
                part);
}

int sw_blow_begins(sw_scene *s, double h) {
  sw_course *course = sw_scene_course(s);
  const int followed = is_followed(s);
  const char *why = why_whole(s);
  if (why) tell(s, h, why);
  if (why || (!followed && !(h > 1.01 * SHORTEST_PUSH))) return 0;
  const double jolt = jolt_of(s, followed);
  if (!(jolt > 0)) return 0;
  const double part = followed ? course->blow_part : part_for(s, jolt, h);
  if (!followed && !(h > 1.01 * part)) return 0;
  if (!followed) course->blow_since = sw_scene_time(s);
  course->blow_until =
      fmin(sw_scene_time(s) + fmax(BLOW, h), course->blow_since + fmax(LONGEST_BLOW, h));
  course->blow_part = part;
  return !followed;
}
