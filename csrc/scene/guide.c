/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh beside guides: nodes that come out of them and go into them, and the
 * unloaded shape of the wire behind them. */
#include <math.h>

#include "base/alloc.h"
#include "scene/world.h"
#include "state/hinge.h"

/* --- unloaded shape -------------------------------------------------------------- */

static sw_quat frame_turn(sw_vec t, sw_vec m1) {
  const sw_vec m2 = sw_cross(t, m1); /* the quaternion of the matrix (t m1 m2) */
  const double trace = t.x + m1.y + m2.z;
  if (trace > 0) return sw_quat_unit((sw_quat){1 + trace, m1.z - m2.y, m2.x - t.z, t.y - m1.x});
  if (t.x >= m1.y && t.x >= m2.z)
    return sw_quat_unit((sw_quat){m1.z - m2.y, 1 + t.x - m1.y - m2.z, m1.x + t.y, m2.x + t.z});
  if (m1.y >= m2.z)
    return sw_quat_unit((sw_quat){m2.x - t.z, m1.x + t.y, 1 + m1.y - t.x - m2.z, m2.y + m1.z});
  return sw_quat_unit((sw_quat){t.y - m1.x, m2.x + t.z, m2.y + m1.z, 1 + m2.z - t.x - m1.y});
}

static sw_vec tangent_of(sw_quat q) { return sw_rotate(q, sw_v(1, 0, 0)); }
static sw_vec normal_of(sw_quat q) { return sw_rotate(q, sw_v(0, 1, 0)); }

static sw_quat rest_turn(const sw_mesh *m, double s) {
  const sw_mesh_frame f = sw_mesh_frame_at(m, s);
  return frame_turn(f.rest_tangent, f.rest_normal);
}

typedef struct rest_place {
  sw_vec x;  /* [m] */
  sw_quat q; /* its tangent and normal are the first two axes */
} rest_place;

/* A curve that goes on from (x, q) by a length u with the body rate w per length. */
static rest_place go_on(sw_vec x, sw_quat q, sw_vec w, double u) {
  const double rate = sw_norm(w), angle = rate * u;
  sw_vec way = sw_v(u, 0, 0);
  if (fabs(angle) > 1e-9) {
    const sw_vec a = sw_scale(w, 1 / rate);
    way = sw_scale(a, a.x * (u - sin(angle) / rate));
    way.x += sin(angle) / rate;
    way = sw_madd(way, sw_cross(a, sw_v(1, 0, 0)), (1 - cos(angle)) / rate);
  }
  return (rest_place){sw_add(x, sw_rotate(q, way)),
                      sw_quat_unit(sw_quat_mul(q, sw_quat_exp(sw_scale(w, u))))};
}

/* The unloaded wire at arc length s. Beyond its ends it goes on with the curvature and twist
 * that it has there: what is on the spool is like what has come from it. */
static rest_place shape_at(const sw_mesh *m, double s) {
  const size_t last = m->n - 1;
  if (s < m->s[0] || s > m->s[last]) {
    const int before = s < m->s[0];
    const size_t end = before ? 0 : last, i = before ? 1 : last - 1;
    const size_t j = last < 4 ? i : before ? 3 : last - 3;
    sw_vec w = sw_v(0, 0, 0);
    if (i != j) {
      const sw_quat a = rest_turn(m, m->s[i]), b = rest_turn(m, m->s[j]);
      w = sw_scale(sw_quat_log(sw_quat_mul(sw_quat_conj(a), b)), 1 / (m->s[j] - m->s[i]));
    }
    return go_on(sw_vec_at(m->rest, end), rest_turn(m, m->s[end]), w, s - m->s[end]);
  }
  const size_t i = sw_mesh_node(m, s), e = i > 0 ? i - 1 : 0;
  const double l = m->s[e + 1] - m->s[e], f = (s - m->s[e]) / l;
  const sw_vec a = sw_vec_at(m->rest, e), b = sw_vec_at(m->rest, e + 1);
  const double chord = sw_dist(a, b);
  const sw_vec ta = tangent_of(rest_turn(m, m->s[e])), tb = tangent_of(rest_turn(m, m->s[e + 1]));
  const sw_vec near =
      sw_add(sw_scale(a, (1 + 2 * f) * (1 - f) * (1 - f)), sw_scale(b, f * f * (3 - 2 * f)));
  return (rest_place){sw_add(near, sw_add(sw_scale(ta, chord * f * (1 - f) * (1 - f)),
                                          sw_scale(tb, -chord * f * f * (1 - f)))),
                      rest_turn(m, s)};
}

/* The unloaded frame of an edge, from that of the curve at its middle. */
static void shape_edge(sw_mesh *m, const sw_mesh *shape, size_t e) {
  const sw_quat q = shape_at(shape, 0.5 * (m->s[e] + m->s[e + 1])).q;
  const sw_vec along = sw_sub(sw_vec_at(m->rest, e + 1), sw_vec_at(m->rest, e));
  const sw_vec t = sw_unit_or(along, tangent_of(q));
  sw_store(m->rest_normal + 3 * e, sw_carry_unit(normal_of(q), tangent_of(q), t));
}

/* The node's unloaded place and the edges beside it, for its arc length in the mesh. */
static void shape_node(sw_mesh *m, const sw_mesh *shape, size_t node) {
  sw_store(m->rest + 3 * node, shape_at(shape, m->s[node]).x);
  if (node > 0) shape_edge(m, shape, node - 1);
  if (node + 1 < m->n) shape_edge(m, shape, node);
}

void sw_feed_rest(sw_scene_hold *h, double s) {
  const sw_quat q = shape_at(&h->feed.shape, s).q;
  for (int side = 0; side < 2; side++) {
    h->frame[side].rest_tangent = tangent_of(q);
    h->frame[side].rest_normal = normal_of(q);
  }
}

void sw_feed_shape(sw_scene *s, sw_scene_hold *h) {
  sw_mesh *m = &s->wires[h->wire].mesh;
  sw_plan *p = s->system.bodies[h->wire].plan;
  const size_t node = h->feed.node;
  if (!m->rest) return;
  const double kept = m->s[node];
  m->s[node] = p->s[node];
  shape_node(m, &h->feed.shape, node);
  m->s[node] = kept;
  sw_feed_rest(h, p->s[node]);
  sw_scene_unloaded_near(s, h->wire, p, node);
}

/* --- nodes ------------------------------------------------------------------------ */

/* First edges between these shares of the second one keep the clamp's quadrature good; beyond
 * that nodes are made and removed. Apart by more than one, so that a feed that goes to and fro
 * does not do so all the time. */
static const double SHORTEST = 0.47, LONGEST = 1.5; /* [-] */
/* Without a node to be removed: of the usual length [-]. */
static const double LEAST_LEFT = 0.2;
static const double LARGEST_SHARE = 0.4; /* of an edge, fed in one step [-] */
enum { LEAST_FREE = 2, LEAST_HELD = 3 }; /* edges to keep before a free end and another hold */

double sw_feed_step(const sw_scene *s, double h) {
  for (size_t k = 0; k < s->hold_count; k++) {
    const sw_scene_hold *o = &s->holds[k];
    if (!o->alive || !o->cls->feeds) continue;
    const double most = LARGEST_SHARE * o->feed.size, now = sw_feed_at(o, s->time).fed;
    double way = fabs(sw_feed_at(o, s->time + h).fed - now);
    for (int i = 0; way > most && i < 60; i++) { /* in even parts: a tiny one would be a kick */
      h /= fmin(64, ceil(way / most));
      way = fabs(sw_feed_at(o, s->time + h).fed - now);
    }
  }
  return h;
}

/* One side of a guide. */
typedef struct guide {
  sw_scene_hold *h;
  sw_mesh *m;
  int side;
  sw_vec director, normal; /* of the wire in the guide [-] */
} guide;

static long inner(const guide *g, long k) {
  const long i = (long)sw_mesh_node(g->m, g->h->s1) + k * g->side;
  return i < (long)g->m->n ? i : -1;
}

/* Unstressed length of edge k from the guide; 0 beyond the wire. */
static double edge_length(const guide *g, long k) {
  const long a = inner(g, k), b = inner(g, k + 1);
  return a < 0 || b < 0 ? 0 : fabs(g->m->s[b] - g->m->s[a]);
}

/* Edges up to the wire's end or the next hold, and that hold. */
static size_t edges_left(const sw_scene *s, const guide *g, const sw_scene_hold **next) {
  const double from = g->h->s1;
  double to = g->side > 0 ? g->m->s[g->m->n - 1] : g->m->s[0];
  *next = NULL;
  for (size_t k = 0; k < s->hold_count; k++) {
    const sw_scene_hold *o = &s->holds[k];
    if (!o->alive || o == g->h || o->wire != g->h->wire) continue;
    const double near = g->side > 0 ? o->s1 : o->s2;
    if ((near - from) * g->side < 0 || (near - to) * g->side > 0) continue;
    to = near;
    *next = o;
  }
  const size_t a = sw_mesh_node(g->m, from), b = sw_mesh_node(g->m, to);
  return a < b ? b - a : a - b;
}

/* From the frame in the guide to that of the first edge, as a rotation in the former's axes. */
static sw_vec turn_between(sw_quat held, sw_quat edge) {
  return sw_quat_log(sw_quat_mul(sw_quat_conj(held), edge));
}

static sw_quat edge_turn(const guide *g, size_t e) {
  const sw_vec along = sw_sub(sw_vec_at(g->m->x, e + 1), sw_vec_at(g->m->x, e));
  const sw_vec t = sw_unit_or(along, g->director);
  const sw_vec n = g->m->normal ? sw_vec_at(g->m->normal, e) : g->normal;
  return frame_turn(t, sw_carry_unit(n, g->m->normal ? t : g->director, t));
}

static sw_vec rest_between(const guide *g, size_t e) {
  if (!g->m->rest) return sw_v(0, 0, 0);
  const sw_vec along = sw_sub(sw_vec_at(g->m->rest, e + 1), sw_vec_at(g->m->rest, e));
  const sw_quat held = shape_at(&g->h->feed.shape, g->h->s1).q;
  const sw_quat edge =
      frame_turn(sw_unit_or(along, tangent_of(held)), sw_vec_at(g->m->rest_normal, e));
  return turn_between(held, edge);
}

/* The frame of an edge that is turned from the guide's by what rests and what bends it. */
static sw_quat bent_turn(const guide *g, size_t e, sw_vec bend) {
  const sw_quat held = frame_turn(g->director, g->normal);
  return sw_quat_unit(sw_quat_mul(held, sw_quat_exp(sw_add(rest_between(g, e), bend))));
}

static void put_normal(const guide *g, size_t e, sw_quat q) {
  const sw_vec along = sw_sub(sw_vec_at(g->m->x, e + 1), sw_vec_at(g->m->x, e));
  const sw_vec t = sw_unit_or(along, tangent_of(q));
  sw_store(g->m->normal + 3 * e, sw_carry_unit(normal_of(q), tangent_of(q), t));
}

/* Unstressed length of the first edge with its spare, and the place that holds it. */
static double *spare_of(const guide *g) { return &g->h->feed.spare[g->side > 0]; }

static double fed_length(const guide *g) {
  return (g->h->feed.label - g->h->s1) * g->h->feed.outward;
}

static double true_length(const guide *g) {
  double spare[2];
  sw_feed_spare(&g->h->feed, fed_length(g), spare);
  return edge_length(g, 0) + spare[g->side > 0];
}

static void set_length(guide *g, double length) {
  *spare_of(g) = length - edge_length(g, 0);
  g->h->feed.spare_fed[g->side > 0] = fed_length(g);
}

static sw_vec node_at(const guide *g, long k) { return sw_vec_at(g->m->x, (size_t)inner(g, k)); }

/* A node comes out of the guide, a usual length before the first one: on the curve for
 * which bending moment and torque at the guide stay as they are. The way over the new
 * node is longer than the chord that was there by what the feed then holds back again. */
static sw_status add_node(guide *g) {
  sw_mesh *m = g->m;
  const double first = edge_length(g, 0), size = g->h->feed.size;
  const sw_vec from = node_at(g, 0), to = node_at(g, 1);
  const double stretch = sw_dist(from, to) / true_length(g);
  const size_t face = (size_t)inner(g, 0), edge = g->side > 0 ? face : face - 1;
  double w0, next, v0, v1;
  sw_plan_clamp_lengths(first, edge_length(g, 1), &w0, &next);
  sw_plan_clamp_lengths(first - size, size, &v0, &v1);
  const sw_vec turn = turn_between(frame_turn(g->director, g->normal), edge_turn(g, edge));
  const sw_vec bend = sw_sub(turn, rest_between(g, edge));
  const double arc = m->s[inner(g, 1)] - g->side * size;
  SW_TRY(sw_mesh_insert(m, edge, arc));
  const size_t node = edge + 1, at = g->side > 0 ? edge : edge + 1, beyond = 2 * edge + 1 - at;
  if (m->rest) {
    shape_node(m, &g->h->feed.shape, node);
    m->twist[node] = 0;
  }
  const sw_quat q = bent_turn(g, at, sw_scale(bend, v0 / w0));
  const sw_vec out = sw_scale(tangent_of(q), g->side), way = sw_sub(to, from);
  const double along = sw_dot(out, way), rest = stretch * size;
  const double root2 = along * along - sw_norm2(way) + rest * rest;
  const double chord = along - sqrt(fmax(0, root2)); /* leaves `rest` to the next node */
  sw_store(m->x + 3 * node, sw_madd(from, out, chord));
  set_length(g, chord / stretch);
  if (!m->rest) return SW_OK;
  put_normal(g, at, q);
  put_normal(g, beyond, bent_turn(g, beyond, sw_scale(bend, (v0 + v1) / w0)));
  return SW_OK;
}

static void take_node(guide *g) {
  const size_t node = (size_t)inner(g, 1);
  const sw_vec a = node_at(g, 0), b = node_at(g, 1), c = node_at(g, 2);
  const double stretch = (sw_dist(a, b) + sw_dist(b, c)) / (true_length(g) + edge_length(g, 1));
  sw_mesh_remove(g->m, node);
  set_length(g, sw_dist(a, c) / stretch);
  if (g->m->rest) shape_node(g->m, &g->h->feed.shape, (size_t)inner(g, 0));
}

enum { FINE = 0, ADD = 1, TAKE = 2, EMPTY = 3 };

/* What a guide's side needs for first edges between two lengths; that now is one of them. */
static int needs(const sw_scene *s, const guide *g, double change) {
  const sw_scene_hold *next;
  const double now = edge_length(g, 0), then = now + change, second = edge_length(g, 1);
  if (!(now > 0)) return FINE; /* no wire there: the spool's side */
  if (now > LONGEST * g->h->feed.size) return ADD;
  if (!(then < SHORTEST * (second > 0 ? second : g->h->feed.size))) return FINE;
  const size_t left = edges_left(s, g, &next);
  if (left > (next ? LEAST_HELD : LEAST_FREE)) return TAKE;
  return then < LEAST_LEFT * g->h->feed.size ? EMPTY : FINE;
}

static sw_status say_empty(const sw_scene *s, const guide *g, sw_error *err) {
  const sw_scene_hold *next;
  const double from = g->h->s1;
  edges_left(s, g, &next);
  const double end = g->side > 0 ? g->m->s[g->m->n - 1] : g->m->s[0];
  const double to = !next ? end : g->side > 0 ? next->s1 : next->s2;
  return sw_fail(err, SW_EEMPTY,
                 "feed '%s': at t = %.6g s wire '%s' is drawn in up to %s%s%s, %.3g m are left; "
                 "stop the feed before",
                 g->h->name, s->time, s->wires[g->h->wire].name, next ? "'" : "its end",
                 next ? next->name : "", next ? "'" : "", fabs(to - from));
}

/* The guide's side of hold h; directions are as the holds were last placed. */
static guide guide_of(sw_scene *s, sw_scene_hold *h, int side, const sw_vec *axes) {
  guide g = {.h = h, .m = &s->wires[h->wire].mesh, .side = side, .director = axes[0]};
  g.normal = g.m->rest ? axes[1] : sw_perpendicular(axes[0]);
  return g;
}

/* Work on one hold: side by side, as long as something is needed. With edit 0 only look. */
static sw_status tend(sw_scene *s, sw_scene_hold *h, double fed, int edit, const sw_vec *axes,
                      int *wanted, sw_error *err) {
  for (int side = -1; side < 2; side += 2) {
    guide g = guide_of(s, h, side, axes);
    for (int i = 0; i < 8; i++) { /* a few where the mesh was uneven */
      const int need = needs(s, &g, fed * side * h->feed.outward);
      if (need == FINE) break;
      if (need == EMPTY) return say_empty(s, &g, err);
      *wanted = 1;
      if (!edit) break;
      if (need == TAKE)
        take_node(&g);
      else if (add_node(&g) != SW_OK)
        return sw_fail(err, SW_ENOMEM, "feed: out of memory");
    }
  }
  return SW_OK;
}

/* Every hold's; axes: director and normal of each of the system's holds, or NULL to look. */
static sw_status tend_all(sw_scene *s, double t, const sw_vec *axes, int *wanted, sw_error *err) {
  static const sw_vec looking[2] = {{1, 0, 0}, {0, 1, 0}};
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_scene_hold *h = &s->holds[k];
    if (!h->alive || !h->cls->feeds) continue;
    const double fed = sw_feed_at(h, t).fed - sw_feed_at(h, s->time).fed;
    SW_TRY(tend(s, h, fed, axes != NULL, axes ? axes + 2 * h->feed.number : looking, wanted, err));
  }
  return SW_OK;
}

sw_status sw_feed_make_room(sw_scene *s, double t, int *changed, sw_error *err) {
  *changed = 0;
  SW_TRY(tend_all(s, t, NULL, changed, err));
  if (!*changed) return SW_OK;
  const size_t count = s->system.hold_count;
  SW_TRY(sw_system_place_holds(&s->system, s->time, NULL, NULL, NULL, err));
  sw_vec *axes = sw_alloc(2 * count, sizeof *axes);
  if (!axes) return sw_fail(err, SW_ENOMEM, "feed: out of memory");
  for (size_t k = 0; k < count; k++) {
    axes[2 * k] = sw_vec_at(s->system.directors_now, 2 * k + 1);
    axes[2 * k + 1] = sw_vec_at(s->system.normals_now, 2 * k + 1);
  }
  sw_status status = sw_scene_thaw(s);
  if (status == SW_OK) status = tend_all(s, t, axes, changed, err);
  sw_free(axes);
  if (status == SW_ENOMEM) return sw_fail(err, status, "feed: out of memory");
  if (status != SW_OK) return status;
  return sw_scene_build(s, err);
}
