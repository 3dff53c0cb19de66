/* SPDX-License-Identifier: GPL-3.0-or-later */
/* No node of a wire and no particle of a mesh is held by two holds, and between two holds there
 * is wire that can be meshed. */
#include <math.h>

#include "base/alloc.h"
#include "link/hold.h"
#include "scene/hold.h"
#include "scene/line.h"
#include "scene/world.h"

static const double SAME_PLACE = 1e-9; /* of the wire's length: rounding [-] */
/* Wire between two holds, of the whole: its edges, a quarter as long, must be told from nothing. */
static const double LEAST_BETWEEN = 1e-6; /* [-] */

static sw_status say_held(const sw_scene_wire *w, const sw_hold *by, const char *what,
                          sw_error *err) {
  const double start = w->mesh.s[0];
  return sw_fail(err, SW_EINVAL,
                 "%s: wire '%s' is already held by '%s' between s = %.6g and %.6g m", what, w->name,
                 by->name, by->s1 - start, by->s2 - start);
}

sw_status sw_scene_check_clear(const sw_scene *s, size_t wire, const sw_hold *self,
                               const char *what, double s1, double s2, sw_error *err) {
  const sw_scene_wire *w = &s->wires[wire];
  const double start = w->mesh.s[0], length = w->mesh.s[w->mesh.n - 1] - start;
  for (size_t k = 0; k < s->hold_count; k++) {
    const sw_hold *h = &s->holds[k];
    if (!h->alive || h->wire != wire || h == self) continue;
    const double between = fmax(s1 - h->s2, h->s1 - s2);
    if (!(between > SAME_PLACE * length)) return say_held(w, h, what, err);
    if (!w->strand.web && between < LEAST_BETWEEN * length)
      return sw_fail(err, SW_EINVAL,
                     "%s: at s = %.9g m wire '%s' is only %.2g m away from where '%s' holds it; it "
                     "must be %.2g m or more",
                     what, s1 - start, w->name, between, h->name, LEAST_BETWEEN * length);
  }
  return SW_OK;
}

static sw_status say_twice(const sw_scene *s, const sw_hold *a, const sw_hold *b, sw_error *err) {
  const sw_scene_wire *w = &s->wires[a->wire];
  const double start = w->mesh.s[0];
  return sw_fail(err, SW_EINVAL,
                 "wire '%s': '%s' (s = %.6g to %.6g m) and '%s' (s = %.6g to %.6g m) hold the same "
                 "%s; release one of them, or hold places further apart",
                 w->name, a->name, a->s1 - start, a->s2 - start, b->name, b->s1 - start,
                 b->s2 - start, w->strand.web ? "particles" : "node");
}

/* Of a wire that is a line. */
static sw_status check_line(const sw_scene *s, const sw_hold *h, sw_error *err) {
  for (const sw_hold *o = s->holds; o < h; o++)
    if (o->alive && o->wire == h->wire && o->s1 <= h->s2 && h->s1 <= o->s2)
      return say_twice(s, o, h, err);
  return SW_OK;
}

/* Of a mesh: taken (particles) has 1 + the slot of what holds a particle. */
static sw_status take_particles(const sw_scene *s, const sw_hold *h, size_t *taken, sw_error *err) {
  const size_t particles = s->wires[h->wire].strand.web->particles;
  for (size_t i = 0; i < h->count; i++) {
    const size_t p = h->particle ? h->particle[i] : particles;
    if (p >= particles)
      return sw_fail(err, SW_EINVAL, "wire '%s': '%s' holds a particle that is not there",
                     s->wires[h->wire].name, h->name);
    if (taken[p]) return say_twice(s, &s->holds[taken[p] - 1], h, err);
    taken[p] = (size_t)(h - s->holds) + 1;
  }
  return SW_OK;
}

static sw_status check_mesh(const sw_scene *s, size_t wire, sw_error *err) {
  size_t *taken = NULL;
  sw_status status = SW_OK;
  for (size_t k = 0; k < s->hold_count && status == SW_OK; k++) {
    if (!s->holds[k].alive || s->holds[k].wire != wire) continue;
    if (!taken) taken = sw_alloc(s->wires[wire].strand.web->particles, sizeof *taken);
    if (!taken) return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", s->name);
    status = take_particles(s, &s->holds[k], taken, err);
  }
  sw_free(taken);
  return status;
}

sw_status sw_scene_check_holds(const sw_scene *s, sw_error *err) {
  for (size_t k = 0; k < s->hold_count; k++)
    if (s->holds[k].alive && !s->wires[s->holds[k].wire].strand.web)
      SW_TRY(check_line(s, &s->holds[k], err));
  for (size_t w = 0; w < s->wire_count; w++)
    if (s->wires[w].strand.web) SW_TRY(check_mesh(s, w, err));
  return SW_OK;
}
