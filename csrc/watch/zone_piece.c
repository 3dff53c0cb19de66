/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Straight pieces of a wire, for distances to zones. */
#include "watch/zone_piece.h"

#include <math.h>

#include "strand/ring.h"

/* Least number of lines along the surface of a mesh: a point at the surface is at most 0.065 of the
 * radius from one of them [-]. */
enum { LINES = 48 };

static int has_rings(const sw_web *w) { return w->per_ring > 0 && w->around_count > 2; }

sw_zone_body sw_zone_body_of(const sw_system *s, const sw_body *b) {
  const sw_web *w = b->plan->web;
  sw_zone_body z = {.system = s, .body = b, .count = b->plan->edges};
  if (!w) return z;
  z.count = b->plan->nodes;
  if (!has_rings(w)) return z;
  z.times = (LINES + w->around_count - 1) / w->around_count;
  z.bulge = sw_outline_is_round(w) ? M_PI / (double)w->around_count : 0;
  z.count = b->plan->nodes + (w->rings - 1) * z.times * w->around_count;
  return z;
}

static sw_vec at(const sw_zone_body *z, size_t node) {
  return sw_vec_at(z->system->x, z->body->first_node + node);
}

static sw_zone_piece between(const sw_zone_body *z, size_t a, size_t b, double skin) {
  const double *s = z->body->plan->web ? z->body->plan->web->s : z->body->plan->s;
  return (sw_zone_piece){{at(z, a), at(z, b)}, {s[a], s[b]}, skin};
}

static double skin_of(const sw_zone_body *z, size_t node) {
  const sw_web *w = z->body->plan->web;
  const int inside = has_rings(w) && sw_web_is_ring(w, sw_web_ring_of(w, node));
  return sw_plan_skin(z->body->plan, node) - (inside ? w->proud : 0);
}

/* Returns the middle of the particles round a section. */
static sw_vec middle_of(const sw_zone_body *z, size_t ring) {
  const sw_web *w = z->body->plan->web;
  if (!sw_web_is_ring(w, ring)) return at(z, w->first[ring]);
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < w->around_count; k++)
    sum = sw_add(sum, at(z, w->first[ring] + w->around[k]));
  return sw_scale(sum, 1.0 / (double)w->around_count);
}

/* Returns place m of a section's curve through its outer particles: on the chord, and for a round
 * section moved outwards from the chord to the circle. */
static sw_vec around(const sw_zone_body *z, size_t ring, size_t m) {
  const sw_web *w = z->body->plan->web;
  const size_t k = m / z->times, first = w->first[ring];
  const double share = (double)(m % z->times) / (double)z->times;
  const sw_vec p = sw_lerp(at(z, first + w->around[k]),
                           at(z, first + w->around[(k + 1) % w->around_count]), share);
  if (!(z->bulge > 0) || share == 0) return p;
  const double angle = atan((2 * share - 1) * tan(z->bulge));
  const sw_vec middle = middle_of(z, ring);
  return sw_madd(middle, sw_sub(p, middle), cos(angle) / cos(z->bulge));
}

/* Returns line m from ring r to the next. Where one of them is a particle of a line, line 0 is that
 * of the axis, and the others are its first end. */
static sw_zone_piece along(const sw_zone_body *z, size_t r, size_t m) {
  const sw_web *w = z->body->plan->web;
  const double s0 = w->s[w->first[r]], s1 = w->s[w->first[r + 1]];
  if (sw_web_is_ring(w, r) && sw_web_is_ring(w, r + 1))
    return (sw_zone_piece){{around(z, r, m), around(z, r + 1, m)}, {s0, s1}, w->skin - w->proud};
  const sw_vec a = middle_of(z, r), b = m ? a : middle_of(z, r + 1);
  return (sw_zone_piece){{a, b}, {s0, m ? s0 : s1}, w->line_skin};
}

sw_zone_piece sw_zone_piece_of(const sw_zone_body *z, size_t e) {
  const sw_web *w = z->body->plan->web;
  if (!w) return between(z, e, e + 1, sw_plan_skin(z->body->plan, e));
  if (e < z->body->plan->nodes) return between(z, e, e, skin_of(z, e));
  const size_t k = e - z->body->plan->nodes, lines = z->times * w->around_count;
  return along(z, k / lines, k % lines);
}
