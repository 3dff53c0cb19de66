/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What frames tell of how wires moved between them. */
#include "base/alloc.h"
#include "base/segments.h"
#include "read/frames.h"

static const double HALF_TURN = 3.14159265358979323846; /* [rad] */

/* A line in a frame, with the frame before: NULL where it has not as many nodes there. */
typedef struct line {
  const float *x, *before;
  size_t count; /* of nodes [-] */
} line;

static sw_vec node(const float *x, size_t i) {
  return sw_v((double)x[3 * i], (double)x[3 * i + 1], (double)x[3 * i + 2]);
}

static line line_of(const sw_scene *s, size_t frame, size_t w, double start) {
  line l = {0};
  size_t count = 0;
  l.x = sw_scene_frame_wire(s, frame, w, &l.count);
  if (!l.x) l.count = 0;
  if (frame > 0 && sw_scene_frame_time(s, frame - 1) >= start) {
    l.before = sw_scene_frame_wire(s, frame - 1, w, &count);
    if (count != l.count) l.before = NULL;
  }
  return l;
}

/* Angle between the edges at node i [rad]. */
static double angle_at(const line *l, size_t i) {
  const sw_vec a = sw_sub(node(l->x, i), node(l->x, i - 1));
  const sw_vec b = sw_sub(node(l->x, i + 1), node(l->x, i));
  const double size = sw_norm(sw_cross(a, b)), dot = sw_dot(a, b);
  return size > 0 || dot < 0 ? atan2(size, dot) : 0;
}

static double moved(const line *l, size_t i) {
  return l->before ? sw_dist(node(l->x, i), node(l->before, i)) : 0;
}

static void sweep(const line *l, sw_swept *out) {
  double turn = 0;
  for (size_t i = 0; i < l->count; i++) {
    for (size_t k = 0; k < 3; k++) {
      const double x = (double)l->x[3 * i + k];
      out->low[k] = fmin(out->low[k], x), out->high[k] = fmax(out->high[k], x);
    }
    out->step = fmax(out->step, moved(l, i));
    if (i > 0 && i + 1 < l->count) turn += angle_at(l, i);
  }
  out->turning = fmax(out->turning, turn);
}

void sw_scene_frames_sweep(const sw_scene *s, double start, size_t w, sw_swept *out) {
  *out =
      (sw_swept){.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
  for (size_t f = 0; f < sw_scene_frames(s); f++) {
    if (sw_scene_frame_time(s, f) < start) continue;
    const line l = line_of(s, f, w, start);
    sweep(&l, out);
  }
}

double sw_scene_frames_acceleration(const sw_scene *s, double start, size_t w, size_t stride) {
  double most = -1;
  for (size_t f = 2 * stride; f < sw_scene_frames(s); f++) {
    const size_t g = f - stride, e = g - stride;
    const double a = sw_scene_frame_time(s, e), b = sw_scene_frame_time(s, g);
    const double second = sw_scene_frame_time(s, f) - b, first = b - a;
    size_t n, m, k;
    const float *x = sw_scene_frame_wire(s, e, w, &n), *y = sw_scene_frame_wire(s, g, w, &m);
    const float *z = sw_scene_frame_wire(s, f, w, &k);
    if (a <= start || first <= 0 || second <= 0 || !x || !y || !z || n != m || m != k) continue;
    for (size_t i = 0; i < n; i++) {
      const sw_vec before = sw_scale(sw_sub(node(y, i), node(x, i)), 1 / first);
      const sw_vec after = sw_scale(sw_sub(node(z, i), node(y, i)), 1 / second);
      most = fmax(most, 2 * sw_dist(after, before) / (first + second));
    }
  }
  return most;
}

/* --- how near lines come ----------------------------------------------------------------- */

/* An edge of a line: its first node, the way to the second, half of its length, and by how much
 * what is there may be off it: moved since the frame before, or bowed; the angle by which the line
 * turns before it. */
typedef struct edge {
  sw_vec from, way;
  double half, off, turn; /* [m], [m], [rad] */
} edge;

/* The edges of a line, one less than its nodes; returns how many. */
static size_t edges_of(const line *l, edge *edges) {
  const size_t count = l->count > 0 ? l->count - 1 : 0;
  double angle = 0, turn = 0;
  for (size_t i = 0; i < count; i++) {
    edge e = {.from = node(l->x, i), .turn = turn += angle};
    const double next = i + 1 < count ? angle_at(l, i + 1) : 0;
    e.way = sw_sub(node(l->x, i + 1), e.from);
    e.half = sw_norm(e.way) / 2;
    e.off = fmax(moved(l, i), moved(l, i + 1)) + e.half * fmax(angle, next) / 4; /* of an arc */
    edges[i] = e, angle = next;
  }
  return count;
}

static double gap_of(const edge *a, const edge *b, double enough) {
  double s, t;
  const sw_vec middle = sw_sub(sw_madd(a->from, a->way, 0.5), sw_madd(b->from, b->way, 0.5));
  const double off = a->off + b->off, least = sw_norm(middle) - a->half - b->half - off;
  if (least >= enough) return least;
  sw_pair_segments(a->from, a->way, b->from, b->way, &s, &t);
  return sw_dist(sw_madd(a->from, a->way, s), sw_madd(b->from, b->way, t)) - off;
}

/* Of a line with itself, places between which it turns by less than half a turn cannot meet: a
 * closed polygon turns by 2 pi at least, and by no more than pi where it closes (Fenchel). */
static double near_itself(const edge *e, size_t count, double best, double enough) {
  for (size_t i = 0; i < count; i++)
    for (size_t j = i + 1; j < count && best > enough; j++)
      if (e[j].turn - e[i].turn >= HALF_TURN) best = fmin(best, gap_of(&e[i], &e[j], best));
  return best;
}

static double near_other(const edge *e, size_t count, const edge *f, size_t other, double best,
                         double enough) {
  for (size_t i = 0; i < count; i++)
    for (size_t j = 0; j < other && best > enough; j++)
      best = fmin(best, gap_of(&e[i], &f[j], best));
  return best;
}

/* The largest number of nodes of wire w in a frame. */
static size_t most_nodes(const sw_scene *s, size_t w) {
  size_t most = 0, count;
  for (size_t f = 0; f < sw_scene_frames(s); f++)
    if (sw_scene_frame_wire(s, f, w, &count) && count > most) most = count;
  return most;
}

sw_status sw_scene_frames_apart(const sw_scene *s, double start, size_t w, size_t v, double enough,
                                double *out, sw_error *err) {
  double best = INFINITY;
  edge *e SW_LOCAL = sw_alloc(most_nodes(s, w) + 1, sizeof *e);
  edge *g SW_LOCAL = sw_alloc(most_nodes(s, v) + 1, sizeof *g);
  if (!e || !g) return sw_fail(err, SW_ENOMEM, "out of memory for how near lines come");
  for (size_t f = 0; f < sw_scene_frames(s) && best > enough; f++) {
    if (sw_scene_frame_time(s, f) < start) continue;
    const line l = line_of(s, f, w, start), m = line_of(s, f, v, start);
    const size_t n = edges_of(&l, e);
    if (w == v)
      best = near_itself(e, n, best, enough);
    else
      best = near_other(e, n, g, edges_of(&m, g), best, enough);
  }
  *out = best;
  return SW_OK;
}
