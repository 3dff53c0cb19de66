/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blows of wires on each other. Steps with a blow are divided into parts (substeps). */
#include "mutual/jolt.h"

#include <math.h>

#include "mutual/meet.h"

/* Forces of two bodies on each other: at the step's start, and in the trial [N]. */
typedef struct push {
  sw_vec start, end;
  int fresh; /* 1: some of their touches did not press before */
} push;

static int are_bodies(const sw_ends *e, const uint32_t body[2]) {
  return e->body[0] == body[0] && e->body[1] == body[1];
}

static push push_of(const sw_mutual *m, const uint32_t body[2]) {
  push p = {.fresh = 0};
  for (size_t i = 0; i < m->memory_count; i++)
    if (are_bodies(&m->memory[i].of, body))
      p.start = sw_madd(p.start, m->memory[i].normal, m->memory[i].kept.normal_force);
  for (size_t i = 0; i < m->touch_count; i++) {
    const sw_meet *t = &m->touches[i];
    if (!are_bodies(&t->of, body) || !(t->press.normal_force > 0)) continue;
    p.end = sw_madd(p.end, t->press.normal, t->press.normal_force);
    p.fresh |= !t->known;
  }
  return p;
}

/* Searches backwards: most touches of the same two wires are a few places earlier in the list. */
static int is_first(const sw_mutual *m, size_t touch) {
  for (size_t i = touch; i-- > 0;)
    if (are_bodies(&m->touches[i].of, m->touches[touch].of.body)) return 0;
  return 1;
}

/* A force that stretches a wire by more than this is not a blow of the wire: holds drive it into
 * the other wire, and parts of any size would be as rough [-]. */
static const double DRIVEN = 0.1;

/* Returns the jolt of two bodies if its force exceeds the limit by *hardest of one of them, else 0
 * [-]. */
static double jolt_of(const sw_mutual *m, const sw_system *s, const uint32_t body[2], int dull,
                      int followed, double *const hardest[2]) {
  const sw_plan *one = s->bodies[body[0]].plan, *two = s->bodies[body[1]].plan;
  const double usual = fmin(sw_contact_usual_force(s, one), sw_contact_usual_force(s, two));
  const push p = push_of(m, body);
  const sw_vec mean = dull ? p.end : sw_scale(sw_add(p.start, p.end), 0.5);
  const double size = sw_norm(mean), before = fmin(*hardest[0], *hardest[1]);
  if (!(size > sw_contact_least_blow(usual, before, followed))) return 0;
  if (size > DRIVEN * fmin(one->beam.EA, two->beam.EA) || (!followed && !p.fresh)) return 0;
  if (!sw_contact_comes_and_goes(usual, p.start, mean, p.end, followed)) return 0;
  for (int k = 0; k < 2 && !followed; k++) *hardest[k] = fmax(*hardest[k], size);
  return sw_contact_jolt_of(size, usual, m->h);
}

double sw_mutual_jolt(const sw_mutual *m, const sw_system *s, int dull, int followed, sw_blow_of of,
                      void *user) {
  double most = 0;
  if (m->regime != SW_CONTACT_IMPLICIT || !(m->h > 0) || (!followed && !m->struck)) return 0;
  for (size_t i = 0; i < m->touch_count; i++) {
    const uint32_t *body = m->touches[i].of.body;
    if (!is_first(m, i)) continue;
    double *const hardest[2] = {of(user, body[0]), of(user, body[1])};
    most = fmax(most, jolt_of(m, s, body, dull, followed, hardest));
  }
  return most;
}
