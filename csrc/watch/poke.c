/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports ends of rods that are pushed onto an obstacle and nearly slip, or hardly do. There a rod
 * buckles at once or bears the push, so forces and places after it are those of one of two
 * outcomes, and a little decides which one: the step, an edge, a hundredth of the friction. */
#include <math.h>
#include <stdio.h>

#include "contact/jolt.h"
#include "scene/events.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/observe.h"

/* An outcome stands near the threshold if this share more or less friction would give the other
 * one. Of 400 random pokes 6 depended on the step, and all 6 were told
 * (spec/contact/threshold_spec) [-]. */
static const double NEAR = 0.1;
/* A wire is pushed by its end if the cosine of its angle with the normal is above this [-]. */
static const double END_ON = 0.5;
/* And if the push is above this, over EI/L^2: a quarter of the buckling load, about 20 [-]. */
static const double PUSHED = 5.0;
/* A touch slides from this share of its friction on, or if it went further than this in the step
 * [-], [m]. */
static const double SLIDES = 0.9995, WENT = 1e-8;

/* A blow is hard from this push on, over EI/L^2: fifty times the buckling load. An end that strikes
 * hard again before L^2 sqrt(m/EI), about two swings of it, has rebounded [-]. */
static const double HARD = 1000.0;
/* A rod is free between its ends if this share of it is [-]. */
static const double WHOLE = 1.0 - 1e-9;
/* It is still straight if its ends are this share of its length apart: a wire that is bent by a
 * fiftieth of its length bends on instead [-]. */
static const double STRAIGHT = 1.0 - 1e-3;

static int is_straight(const sw_scene *s, const sw_body *b) {
  const double *x = sw_scene_system((sw_scene *)s)->x + 3 * b->first_node;
  return sw_dist(sw_vec_at(x, 0), sw_vec_at(x, b->plan->nodes - 1)) > STRAIGHT * b->plan->length;
}

/* Finds the hardest push on an end, where it is pushed. last: 0 = its start. Fills the part of
 * friction that would hold the end if the wire's force came along its edge [-], and the touch. */
static int find_push(const sw_scene *s, const sw_body *b, int last, sw_contact_push *most,
                     double *need, size_t *touch) {
  const sw_contact *c = sw_scene_contact(s);
  const sw_system *system = sw_scene_system(s);
  const double length = sw_contact_free_length(b->plan, last);
  const size_t end = b->first_node + (last ? b->plan->nodes - 1 : 0),
               before = last ? end - 1 : end + 1;
  const sw_vec edge = sw_sub(sw_vec_at(system->x, end), sw_vec_at(system->x, before));
  size_t k, stop;
  most->normal_force = PUSHED * b->plan->beam.EI / (length * length);
  int found = 0;
  if (!sw_contact_may_press(c, (size_t)(b - system->bodies), most->normal_force)) return 0;
  sw_contact_touches_of(c, end, end + 1, &k, &stop);
  for (; k < stop; k++) {
    sw_contact_push p;
    if (!sw_contact_push_at(c, system, k, &p) || p.node != p.other || p.obstacle < 0) continue;
    const double along = fabs(sw_dot(edge, p.normal));
    if (!(p.friction > 0) || !(along > END_ON * sw_norm(edge))) continue;
    if (sw_scene_obstacle_in(s, (size_t)p.obstacle)->drive.tool) continue;
    if (!(p.normal_force > most->normal_force)) continue;
    *most = p, found = 1, *touch = k;
    *need = sw_norm(sw_madd(edge, p.normal, -sw_dot(edge, p.normal))) / (along * p.friction);
  }
  return found;
}

/* Follows an end that sticks, or slides from this state on. Returns the needed friction over the
 * present one when this is first decided; else 0 [-]. */
static double follow(sw_poke *p, double time, double share, int slides, double need) {
  const sw_poke was = *p;
  const double rate = was.count ? (share - was.share) / (time - was.time) : HUGE_VAL;
  const double bend = was.count > 1 ? (rate - was.rate) / (time - was.time) : 0.0;
  const int arrives = slides && !was.count && need < 1; /* its own speed moves it on */
  p->count++, p->slid |= slides && !arrives;
  p->time = time, p->share = share, p->rate = rate, p->bend = isfinite(bend) ? bend : 0.0;
  if (was.slid || arrives) return 0;
  if (!was.count) return slides ? need : share;
  if (!slides && was.share > SLIDES) return need; /* the second state after an arrival */
  if (!slides) return rate <= 0 && was.rate > 0 ? was.share : 0.0;
  /* stuck so far, it would have gone on like this to the top of a parabola */
  const double top = was.bend < 0 ? was.share - 0.5 * was.rate * was.rate / was.bend : HUGE_VAL;
  return fmax(1.0, top);
}

/* Follows the blows of an end that is pushed with `push` over EI/L^2. Returns 1 if it begins to
 * strike hard now. */
static int strikes(sw_poke *p, double time, double push) {
  if (!(push > HARD) || p->hard) return 0;
  p->hard = 1, p->struck = time;
  return 1;
}

static void tell_again(sw_scene *s, const sw_scene_wire *w, const sw_contact_push *p,
                       double after) {
  sw_scene_tell(s, "rebound", w->name, p->place - w->mesh.s[0], p->normal_force,
                "the end of wire '%s' strikes '%s' hard again, after %.2g ms, with %.3g N. "
                "Small differences decide whether it rebounds: forces and places are "
                "uncertain",
                w->name, sw_scene_obstacle_in(s, (size_t)p->obstacle)->name, 1e3 * after,
                p->normal_force);
}

/* Both ends are struck: the rod buckles between them, in waves that its smallest bends decide. */
static void tell_both(sw_scene *s, const sw_scene_wire *w, const sw_contact_push *p, double times) {
  sw_scene_tell(s, "buckling", w->name, p->place - w->mesh.s[0], p->normal_force,
                "wire '%s' is struck hard at both ends, by '%s' with %.3g N, %.3g times its "
                "buckling load. Small differences decide how it buckles and whether it "
                "springs out: forces and places are uncertain",
                w->name, sw_scene_obstacle_in(s, (size_t)p->obstacle)->name, p->normal_force,
                times);
}

/* Edges up to RESOLVED of a half wave show how a struck rod buckles; ADVISED is for the advice. Of
 * 60 random pokes 14 had longer edges; of the other 46 one peak differs by more than 3 % with a
 * quarter of the edges. Edges of 0.6 half waves may make a peak 18 % too small
 * (spec/contact/struck_edges_spec) [-]. */
static const double RESOLVED = 0.6, ADVISED = 0.4;

/* Tells that a rod whose end sticks buckles in waves that are too short for its edges. */
static void tell_waves(sw_scene *s, const sw_scene_wire *w, const sw_body *b,
                       const sw_contact_push *p, double speed, double length) {
  const double edge = (w->mesh.s[w->mesh.n - 1] - w->mesh.s[0]) / (double)(w->mesh.n - 1);
  const double half = speed > 0 ? sw_contact_half_wave(b, length, speed) : HUGE_VAL;
  if (!(edge > RESOLVED * half)) return;
  const double segments = ceil((double)(w->mesh.n - 1) * edge / (ADVISED * half));
  sw_scene_tell(s, "edges", w->name, p->place - w->mesh.s[0], segments,
                "the end of wire '%s' strikes '%s' with %.3g m/s and sticks: it buckles in half "
                "waves of %.3g mm, too short for its edges of %.3g mm, and the peak force may be "
                "wrong; try segments = %.0f",
                w->name, sw_scene_obstacle_in(s, (size_t)p->obstacle)->name, speed, 1e3 * half,
                1e3 * edge, segments);
}

/* A change of friction by a share of itself, in words. */
static const char *percent(double share, char text[24]) {
  snprintf(text, 24, share < 1e-3 ? "less than 0.1 %%" : "%.2g %%", 100 * share);
  return text;
}

static void tell(sw_scene *s, const sw_scene_wire *w, const sw_contact_push *p, double part) {
  char much[24];
  const char *name = sw_scene_obstacle_in(s, (size_t)p->obstacle)->name;
  const double at = p->place - w->mesh.s[0];
  if (part < 1)
    sw_scene_tell(s, "threshold", w->name, at, part,
                  "the end of wire '%s' sticks to '%s' with %.3g %% of the friction there, "
                  "under %.3g N. With %s less friction it slips: forces and places are "
                  "uncertain",
                  w->name, name, 100 * part, p->normal_force, percent(1 - part, much));
  else
    sw_scene_tell(s, "threshold", w->name, at, 1 / part,
                  "the end of wire '%s' slips on '%s' under %.3g N. With %s more "
                  "friction it sticks: forces and places are uncertain",
                  w->name, name, p->normal_force, percent(part - 1, much));
}

static void watch_end(sw_scene *s, const sw_body *b, sw_scene_wire *w, int last) {
  sw_poke *poke = &w->pokes[last];
  const double time = sw_scene_time(s), struck = poke->struck;
  sw_contact_push p = {.obstacle = -1};
  double need = 0;
  size_t touch = 0;
  if (!find_push(s, b, last, &p, &need, &touch)) {
    *poke = (sw_poke){.struck = struck};
    return;
  }
  if (poke->count && !(time > poke->time)) return;
  const double length = sw_contact_free_length(b->plan, last), EI = b->plan->beam.EI;
  const double swing = length * length * sqrt(b->plan->beam.mass / EI);
  const sw_vec rubs = sw_madd(p.force, p.normal, -sw_dot(p.force, p.normal));
  const double share = sw_norm(rubs) / (p.friction * p.normal_force);
  const double part = follow(poke, time, share, share > SLIDES || sw_norm(p.slip) > WENT, need);
  if (part > 1 - NEAR && part < 1 + NEAR) tell(s, w, &p, part);
  const double push = p.normal_force * length * length / EI, other = w->pokes[!last].struck;
  if (!strikes(poke, time, push)) return;
  const double speed = sw_contact_push_speed(sw_scene_contact(s), sw_scene_system(s), touch);
  if (need < 1) tell_waves(s, w, b, &p, speed, length);
  if (struck > 0 && time - struck < swing) tell_again(s, w, &p, time - struck);
  if (other > 0 && time - other < swing && length > WHOLE * b->plan->length && is_straight(s, b))
    tell_both(s, w, &p, push / (M_PI * M_PI));
}

void sw_scene_watch_poke(sw_scene *s, size_t wire) {
  const sw_body *b = &sw_scene_system(s)->bodies[wire];
  if (!sw_scene_contact(s) || b->plan->web || !(b->plan->beam.EI > 0)) return;
  for (int last = 0; last < 2; last++) watch_end(s, b, sw_scene_wire_in(s, wire), last);
}
