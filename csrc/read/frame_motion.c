/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion of wires between frames. */
#include "base/alloc.h"
#include "base/segments.h"
#include "read/frames.h"
#include "read/kept_frames.h"
#include "scene/parts.h"
#include "system/join.h"

static const double HALF_TURN = 3.14159265358979323846; /* [rad] */

/* A line in a frame. before: the frame before, or NULL if the line has another number of nodes
 * there. */
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

/* Returns the angle between the edges at node i [rad]. */
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
      if (x < out->low[k]) out->low[k] = x;
      if (x > out->high[k]) out->high[k] = x;
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
  /* the frame of a run's end may come so soon after another one that rounding rules the difference
   */
  const size_t count = sw_scene_frames(s) - (size_t)sw_frames_closed(sw_scene_frames_of(s));
  for (size_t f = 2 * stride; f < count; f++) {
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

/* An edge of a line. from, way: its first node and the way to the second. moved: the shifts of both
 * since the frame before. half: half its length. bows: how far the wire may bow beside the edge.
 * off: bound of the shift plus bows. turn: the line's turn before the edge. */
typedef struct edge {
  sw_vec from, way, moved[2];   /* [m] */
  double half, off, bows, turn; /* [m], [m], [m], [rad] */
} edge;

/* Some consecutive edges, and a ball that contains them with all that they may be off [m]. */
enum { ROW = 8 };
typedef struct row {
  size_t first, end;
  sw_vec middle;
  double radius;
} row;

/* The edges of a line, in rows. */
typedef struct rows {
  edge *edges;
  row *rows;
  size_t edge_count, count;
} rows;

/* Two lines of a frame: the system and their bodies in it. joined: 1 if the places of their joins
 * are together in this frame. */
typedef struct duo {
  const sw_system *system;
  uint32_t body[2];
  int joined;
} duo;

/* Finds the edges of a line, one fewer than its nodes. Returns their number. */
static size_t edges_of(const line *l, int straight, edge *edges) {
  const size_t count = l->count > 0 ? l->count - 1 : 0;
  double angle = 0, turn = 0;
  for (size_t i = 0; i < count; i++) {
    edge e = {.from = node(l->x, i), .turn = turn += angle};
    const double next = i + 1 < count ? angle_at(l, i + 1) : 0;
    e.way = sw_sub(node(l->x, i + 1), e.from);
    e.half = sw_norm(e.way) / 2;
    for (size_t k = 0; k < 2 && l->before; k++)
      e.moved[k] = sw_sub(node(l->x, i + k), node(l->before, i + k));
    e.bows = straight ? 0 : e.half * fmax(angle, next) / 4; /* sagitta of an arc */
    e.off = fmax(moved(l, i), moved(l, i + 1)) + e.bows;
    edges[i] = e, angle = next;
  }
  return count;
}

/* Returns a bound of the relative motion of a place on one edge and a place on the other. Both move
 * evenly between their nodes, so it is at most that of the nodes. */
static double moved_apart(const edge *a, const edge *b) {
  double most = 0;
  for (size_t i = 0; i < 4; i++) most = fmax(most, sw_dist(a->moved[i / 2], b->moved[i % 2]));
  return most;
}

static double gap_of(const edge *a, const edge *b, double enough) {
  double s, t;
  const sw_vec middle = sw_sub(sw_madd(a->from, a->way, 0.5), sw_madd(b->from, b->way, 0.5));
  const double least = sw_norm(middle) - a->half - b->half - a->off - b->off;
  if (least >= enough) return least;
  sw_pair_segments(a->from, a->way, b->from, b->way, &s, &t);
  return sw_dist(sw_madd(a->from, a->way, s), sw_madd(b->from, b->way, t)) - a->bows - b->bows -
         moved_apart(a, b);
}

/* Returns the smallest distance of a line to itself. Places between which it turns by less than
 * half a turn cannot meet: a closed polygon turns by at least 2 pi in all, and by at most pi at the
 * closing point (Fenchel). */
static double near_itself(const edge *e, size_t count, double best, double enough) {
  for (size_t i = 0; i < count; i++)
    for (size_t j = i + 1; j < count && best > enough; j++)
      if (e[j].turn - e[i].turn >= HALF_TURN) best = fmin(best, gap_of(&e[i], &e[j], best));
  return best;
}

static int at_join(const duo *d, size_t i, size_t j) {
  const sw_body *b = d->system->bodies;
  return d->joined && sw_joins_near(d->system, (uint32_t)(b[d->body[0]].first_node + i),
                                    (uint32_t)(b[d->body[1]].first_node + j));
}

static void make_rows(rows *r) {
  r->count = (r->edge_count + ROW - 1) / ROW;
  for (size_t k = 0; k < r->count; k++) {
    row *b = &r->rows[k];
    *b = (row){.first = k * ROW, .end = k * ROW + ROW};
    if (b->end > r->edge_count) b->end = r->edge_count;
    const edge *last = &r->edges[b->end - 1];
    b->middle = sw_scale(sw_add(r->edges[b->first].from, sw_add(last->from, last->way)), 0.5);
    for (size_t i = b->first; i < b->end; i++) {
      const edge *e = &r->edges[i];
      const double far = sw_dist(sw_madd(e->from, e->way, 0.5), b->middle) + e->half + e->off;
      b->radius = fmax(b->radius, far);
    }
  }
}

/* Pairs near a join are left out, for there wires do not touch. */
static double near_rows(const duo *d, const rows *a, const row *b, const rows *c, const row *other,
                        double best) {
  for (size_t i = b->first; i < b->end; i++)
    for (size_t j = other->first; j < other->end; j++) {
      const double gap = gap_of(&a->edges[i], &c->edges[j], best);
      if (gap < best && !at_join(d, i, j)) best = gap;
    }
  return best;
}

static double near_other(const duo *d, const rows *a, const rows *b, double best, double enough) {
  for (size_t i = 0; i < a->count; i++)
    for (size_t j = 0; j < b->count && best > enough; j++) {
      const row *one = &a->rows[i], *two = &b->rows[j];
      if (sw_dist(one->middle, two->middle) - one->radius - two->radius < best)
        best = near_rows(d, a, one, b, two, best);
    }
  return best;
}

/* Returns the place of a system's node on line l, which is body b; NULL: it is not on it. */
static const float *node_of(const line *l, const sw_body *b, uint32_t number) {
  const size_t at = number - b->first_node;
  return number >= b->first_node && at < b->plan->nodes ? l->x + 3 * at : NULL;
}

/* 1 if the places at which the lines are joined are together in this frame. A join may be made
 * later. */
static int is_joined(const duo *d, const line *l, const line *m) {
  const sw_system *s = d->system;
  const struct sw_joins *all = s->joins;
  if (!s->joins || d->body[0] >= s->body_count || d->body[1] >= s->body_count) return 0;
  const sw_body *b = &s->bodies[d->body[0]], *c = &s->bodies[d->body[1]];
  int found = 0;
  if (l->count != b->plan->nodes || m->count != c->plan->nodes) return 0; /* another mesh */
  for (size_t k = 0; k < all->spring_count; k++) {
    const sw_join_spring *p = &all->springs[k];
    const int turned = !node_of(l, b, p->i);
    const float *x = node_of(l, b, turned ? p->j : p->i);
    const float *y = node_of(m, c, turned ? p->i : p->j);
    if (p->tie || !x || !y) continue;
    if (sw_dist(sw_vec_of(x), sw_vec_of(y)) >
        sw_norm(p->offset) + b->plan->beam.radius + c->plan->beam.radius)
      return 0;
    found = 1;
  }
  return found;
}

/* Returns the largest number of nodes of wire w in any frame. */
static size_t most_nodes(const sw_scene *s, size_t w) {
  size_t most = 0, count;
  for (size_t f = 0; f < sw_scene_frames(s); f++)
    if (sw_scene_frame_wire(s, f, w, &count) && count > most) most = count;
  return most;
}

/* Makes room for a line's edges. */
static sw_status new_rows(const sw_scene *s, size_t w, rows *r) {
  const size_t most = most_nodes(s, w);
  *r = (rows){.edges = sw_alloc(most + 1, sizeof *r->edges),
              .rows = sw_alloc(most / ROW + 1, sizeof *r->rows)};
  return r->edges && r->rows ? SW_OK : SW_ENOMEM;
}

static void rows_of(const line *l, int straight, rows *r) {
  r->edge_count = edges_of(l, straight, r->edges);
  make_rows(r);
}

static double look_at_frames(const sw_scene *s, double start, duo *d, rows *a, rows *b,
                             const sw_apart_request *request) {
  const size_t w = d->body[0], v = d->body[1];
  const double enough = request->enough;
  double best = request->most;
  for (size_t f = 0; f < sw_scene_frames(s) && best > enough; f++) {
    if (sw_scene_frame_time(s, f) < start) continue;
    const line l = line_of(s, f, w, start), m = line_of(s, f, v, start);
    rows_of(&l, request->straight, a);
    if (w == v) {
      best = near_itself(a->edges, a->edge_count, best, enough);
      continue;
    }
    rows_of(&m, request->straight, b);
    d->joined = is_joined(d, &l, &m);
    best = near_other(d, a, b, best, enough);
  }
  return best;
}

sw_status sw_scene_frames_apart(const sw_scene *s, double start, size_t w, size_t v,
                                const sw_apart_request *request, double *out, sw_error *err) {
  duo d = {.system = sw_scene_system(s), .body = {(uint32_t)w, (uint32_t)v}};
  rows a = {0}, b = {0};
  sw_status status = new_rows(s, w, &a);
  if (status == SW_OK) status = new_rows(s, v, &b);
  if (status == SW_OK) *out = look_at_frames(s, start, &d, &a, &b, request);
  SW_FREE_ALL(a.edges, a.rows, b.edges, b.rows);
  return status == SW_OK ? status : sw_fail(err, status, "out of memory for how near lines come");
}
