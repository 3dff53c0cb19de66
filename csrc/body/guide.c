/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh beside a guide, such as a feed: nodes come out of the guide and go into it. */
#include "body/guide.h"

#include <math.h>

#include "base/alloc.h"
#include "body/build.h"
#include "body/hold.h"
#include "link/hold.h"
#include "link/spool.h"
#include "mutual/mutual.h"
#include "scene/lists.h"
#include "scene/parts.h"
#include "state/hinge.h"
#include "system/system.h"

/* Limits of the first edge over the second one, between which the clamp's quadrature is good.
 * Beyond them nodes are made and removed. Their ratio is above 2, so that a feed that goes to and
 * fro does not make and remove nodes all the time. */
static const double SHORTEST = 0.47, LONGEST = 1.5; /* [-] */
/* Shortest first edge when no node can be removed, over the usual length [-]. */
static const double LEAST_LEFT = 0.2;
static const double LARGEST_SHARE = 0.4; /* most fed in one step, over an edge [-] */
enum { LEAST_FREE = 2, LEAST_HELD = 3 }; /* edges kept before a free end and before another hold */

/* Returns the length paid out at a time `later` after now [m]. */
static double fed_at(const sw_scene *s, const sw_hold *hold, double later) {
  return sw_hold_way_of(s, hold, sw_scene_time(s) + later, NULL).way;
}

double sw_feed_step(const sw_scene *s, double h) {
  SW_EACH(hold, o, s) {
    if (!o->alive || !sw_hold_passes(o)) continue;
    const double most = LARGEST_SHARE * o->cls->hold->guide(o)->size, now = fed_at(s, o, 0);
    double way = fabs(fed_at(s, o, h) - now);
    for (int i = 0; way > most && i < 60; i++) { /* in even parts, because a tiny last one would be
                                                    a kick */
      h /= fmin(64, ceil(way / most));
      way = fabs(fed_at(s, o, h) - now);
    }
  }
  return h;
}

sw_status sw_feed_too_fast(const sw_scene *s, const char *refused, sw_error *err) {
  const sw_hold *fastest = NULL;
  double most = -1;
  SW_EACH(hold, o, s) {
    if (!o->alive || !sw_hold_passes(o)) continue;
    const double speed = fabs(sw_hold_way_of(s, o, sw_scene_time(s), NULL).speed);
    if (speed > most) most = speed, fastest = o;
  }
  if (!fastest) return sw_fail(err, SW_ENOCONV, "%s", refused);
  return sw_fail(err, SW_ENOCONV,
                 "wire '%s' goes through feed '%s' at %.3g m/s, too fast for the steps%s%.300s",
                 sw_scene_wire_in(s, fastest->wire)->name, fastest->name, most,
                 refused[0] ? ": " : "", refused);
}

/* One side of a guide. */
typedef struct guide {
  const sw_scene *s;
  sw_hold *h;
  sw_guide *own;
  sw_mesh *m;
  int side;
  sw_vec director, normal; /* of the wire inside the guide [-] */
  size_t left;             /* edges up to the wire's end or the next hold */
} guide;

static long inner(const guide *g, long k) {
  const long i = (long)sw_mesh_node(g->m, g->h->s1) + k * g->side;
  return i < (long)g->m->n ? i : -1;
}

/* Returns the unstressed length of edge k from the guide; 0 beyond the wire [m]. */
static double edge_length(const guide *g, long k) {
  const long a = inner(g, k), b = inner(g, k + 1);
  return a < 0 || b < 0 ? 0 : fabs(g->m->s[b] - g->m->s[a]);
}

/* Returns the edges up to the wire's end or the next hold; *next: that hold, or NULL. */
static size_t edges_left(const sw_scene *s, const guide *g, const sw_hold **next) {
  const double from = g->h->s1;
  double to = g->side > 0 ? g->m->s[g->m->n - 1] : g->m->s[0];
  *next = NULL;
  SW_EACH(hold, o, s) {
    if (!o->alive || o == g->h || o->wire != g->h->wire) continue;
    const double near = g->side > 0 ? o->s1 : o->s2;
    if ((near - from) * g->side < 0 || (near - to) * g->side > 0) continue;
    to = near;
    *next = o;
  }
  const size_t a = sw_mesh_node(g->m, from), b = sw_mesh_node(g->m, to);
  return a < b ? b - a : a - b;
}

/* Returns the rotation from the frame in the guide to that of the first edge, in the former's
 * axes. */
static sw_vec turn_between(sw_quat held, sw_quat edge) {
  return sw_quat_log(sw_quat_mul(sw_quat_conj(held), edge));
}

static sw_quat edge_turn(const guide *g, size_t e) {
  const sw_vec along = sw_sub(sw_vec_at(g->m->x, e + 1), sw_vec_at(g->m->x, e));
  const sw_vec t = sw_unit_or(along, g->director);
  const sw_vec n = g->m->normal ? sw_vec_at(g->m->normal, e) : g->normal;
  return sw_spool_turn(t, sw_carry_unit(n, g->m->normal ? t : g->director, t));
}

static sw_vec rest_between(const guide *g, size_t e) {
  if (!g->m->rest) return sw_v(0, 0, 0);
  const sw_vec along = sw_sub(sw_vec_at(g->m->rest, e + 1), sw_vec_at(g->m->rest, e));
  const sw_quat held = sw_spool_at(&g->own->shape, g->h->s1).q;
  const sw_quat edge =
      sw_spool_turn(sw_unit_or(along, sw_spool_tangent(held)), sw_vec_at(g->m->rest_normal, e));
  return turn_between(held, edge);
}

/* Returns the frame of an edge, from the guide's frame, its turn at rest and its bend. */
static sw_quat bent_turn(const guide *g, size_t e, sw_vec bend) {
  const sw_quat held = sw_spool_turn(g->director, g->normal);
  return sw_quat_unit(sw_quat_mul(held, sw_quat_exp(sw_add(rest_between(g, e), bend))));
}

static void put_normal(const guide *g, size_t e, sw_quat q) {
  const sw_vec along = sw_sub(sw_vec_at(g->m->x, e + 1), sw_vec_at(g->m->x, e));
  const sw_vec t = sw_unit_or(along, sw_spool_tangent(q));
  sw_store(g->m->normal + 3 * e, sw_carry_unit(sw_spool_normal(q), sw_spool_tangent(q), t));
}

/* Place of this side's spare: unstressed length of the first edge beyond that of the mesh [m]. */
static double *spare_of(const guide *g) { return &g->own->spare[g->side > 0]; }

static double fed_length(const guide *g) { return (g->own->label - g->h->s1) * g->own->outward; }

static double true_length(const guide *g) {
  double spare[2];
  sw_guide_spare(g->own, fed_length(g), spare);
  return edge_length(g, 0) + spare[g->side > 0];
}

static void set_length(guide *g, double length) {
  *spare_of(g) = length - edge_length(g, 0);
  g->own->spare_fed[g->side > 0] = fed_length(g);
}

static sw_vec node_at(const guide *g, long k) { return sw_vec_at(g->m->x, (size_t)inner(g, k)); }

/* --- nodes come and go ------------------------------------------------------------- */

static sw_vec face_bend(const guide *g, size_t e) {
  const sw_vec turn = turn_between(sw_spool_turn(g->director, g->normal), edge_turn(g, e));
  return sw_sub(turn, rest_between(g, e));
}

/* REACH: most nodes that share in a shift; with fewer than LEAST_REACH nothing is shifted.
 * LARGEST_SHIFT: largest shift over an edge's length; a larger one would be no small correction. */
enum { REACH = 8, LEAST_REACH = 3 };
static const double LARGEST_SHIFT = 0.1;

/* 1 if node k touched something in the last step. A node that has just come did not. */
static int touches(const guide *g, long k) {
  const sw_scene *s = g->s;
  const double arc = g->m->s[inner(g, k)];
  const sw_kept_contact *m = sw_scene_kept(s);
  if (!m->memory) return 0;
  for (size_t i = m->first[g->h->wire]; i < m->first[g->h->wire + 1]; i++)
    if (m->s[i] == arc)
      return sw_contact_memory_names(m->memory, m->bytes, i) ||
             sw_mutual_memory_names(m->pairs, m->pair_bytes, i) ||
             sw_mutual_memory_names(m->grains, m->grain_bytes, i);
  return 0;
}

/* Shifts node `first` across the wire by delta, and the nodes after it by less and less; all edges
 * keep their lengths. Nodes that touch something stay: a shift would push them into it or off
 * it. */
static void shift_nodes(const guide *g, long first, sw_vec delta) {
  sw_mesh *m = g->m;
  const long most = (long)fmin(REACH, (double)g->left - (double)first);
  long reach = 0;
  while (reach < most && !touches(g, first + reach)) reach++;
  if (reach < LEAST_REACH || !(sw_norm(delta) < LARGEST_SHIFT * g->own->size)) return;
  sw_vec old = node_at(g, first + reach), now = old;
  for (long k = first + reach - 1; k >= first; k--) {
    const size_t i = (size_t)inner(g, k), e = g->side > 0 ? i : i - 1;
    const sw_vec x = sw_vec_at(m->x, i);
    const double share = 0.5 + 0.5 * cos(M_PI * (double)(k - first) / (double)reach);
    const sw_vec before = sw_unit_or(sw_sub(x, old), g->director);
    const sw_vec way = sw_unit_or(sw_sub(sw_madd(x, delta, share), now), before);
    now = sw_madd(now, way, sw_dist(x, old));
    old = x;
    sw_store(m->x + 3 * i, now);
    if (m->rest) sw_store(m->normal + 3 * e, sw_carry_unit(sw_vec_at(m->normal, e), before, way));
  }
}

/* A guide's first edges before and after a change: their bending, in the guide's axes. */
typedef struct beside {
  double first, second; /* lengths [m] */
  double clamp, next;   /* lengths of hinges [m] */
  sw_vec bend, change;  /* curvature in the guide, and its change to the first node [1/m] */
} beside;

static beside look(const guide *g) {
  const size_t face = (size_t)inner(g, 0), edge = g->side > 0 ? face : face - 1;
  beside b = {.first = edge_length(g, 0), .second = edge_length(g, 1)};
  sw_plan_clamp_lengths(b.first, b.second, &b.clamp, &b.next);
  const sw_vec turn = face_bend(g, edge);
  b.bend = sw_scale(turn, 1 / b.clamp);
  if (b.second > 0) {
    const sw_vec beyond = sw_sub(face_bend(g, g->side > 0 ? edge + 1 : edge - 1), turn);
    b.change = sw_sub(sw_scale(beyond, 1 / b.next), b.bend);
  }
  return b;
}

/* Inserts a node that comes out of the guide, a usual length before the first one. Bending moment
 * and torque at the guide stay the same. So do those at the nodes, for which they shift a little,
 * because the hinges now stand for other stretches of wire. The way over the new node is longer
 * than the old chord; the feed holds the difference back again. */
static sw_status add_node(guide *g) {
  sw_mesh *m = g->m;
  const double size = g->own->size;
  const beside b = look(g);
  const sw_vec from = node_at(g, 0);
  const double stretch = sw_dist(from, node_at(g, 1)) / true_length(g);
  const size_t face = (size_t)inner(g, 0), edge = g->side > 0 ? face : face - 1;
  double v0, v1;
  sw_plan_clamp_lengths(b.first - size, size, &v0, &v1);
  SW_TRY(sw_mesh_insert(m, edge, m->s[inner(g, 1)] - g->side * size));
  g->left++;
  const size_t node = edge + 1, at = g->side > 0 ? edge : edge + 1, beyond = 2 * edge + 1 - at;
  if (m->rest) {
    sw_spool_node(m, &g->own->shape, node);
    m->twist[node] = 0;
  }
  const sw_vec here = sw_madd(b.bend, b.change, (b.first - size) / b.first);
  const sw_quat q0 = bent_turn(g, at, sw_scale(b.bend, v0));
  const sw_quat q1 = bent_turn(g, beyond, sw_madd(sw_scale(b.bend, v0), here, v1));
  const sw_vec t0 = sw_scale(sw_spool_tangent(q0), g->side);
  const sw_vec t1 = sw_scale(sw_spool_tangent(q1), g->side);
  const sw_vec wanted = sw_madd(sw_madd(from, t0, stretch * (b.first - size)), t1, stretch * size);
  const sw_vec delta = sw_sub(wanted, node_at(g, 2));
  if (b.second > 0) shift_nodes(g, 2, sw_madd(delta, t1, -sw_dot(delta, t1)));
  const sw_vec way = sw_sub(node_at(g, 2), from);
  const double along = sw_dot(t0, way), rest = stretch * size;
  const double root2 = along * along - sw_norm2(way) + rest * rest;
  const double chord = along - sqrt(fmax(0, root2)); /* leaves the length `rest` to the next node */
  sw_store(m->x + 3 * node, sw_madd(from, t0, chord));
  set_length(g, chord / stretch);
  if (!m->rest) return SW_OK;
  put_normal(g, at, q0);
  put_normal(g, beyond, q1);
  return SW_OK;
}

/* Removes the first node, which goes into the guide. */
static void take_node(guide *g) {
  sw_mesh *m = g->m;
  const beside b = look(g);
  const sw_vec from = node_at(g, 0), mid = node_at(g, 1), to = node_at(g, 2);
  const double way = sw_dist(from, mid) + sw_dist(mid, to);
  const double stretch = way / (true_length(g) + b.second);
  double v0, v1;
  sw_mesh_remove(m, (size_t)inner(g, 1));
  g->left--;
  const size_t face = (size_t)inner(g, 0), edge = g->side > 0 ? face : face - 1;
  if (m->rest) sw_spool_node(m, &g->own->shape, face);
  sw_plan_clamp_lengths(b.first + b.second, edge_length(g, 1), &v0, &v1);
  const sw_quat q = bent_turn(g, edge, sw_scale(b.bend, v0));
  const sw_vec t = sw_scale(sw_spool_tangent(q), g->side);
  const sw_vec delta = sw_sub(sw_madd(from, t, way), to);
  if (edge_length(g, 1) > 0) shift_nodes(g, 1, sw_madd(delta, t, -sw_dot(delta, t)));
  set_length(g, sw_dist(from, node_at(g, 1)) / stretch);
  if (m->rest) put_normal(g, edge, q);
}

enum { FINE = 0, ADD = 1, TAKE = 2, EMPTY = 3 };

/* Returns the edit (ADD, TAKE, ...) that a guide's side needs while its first edge changes by
 * `change` [m]. */
static int needs(const sw_scene *s, const guide *g, double change) {
  const sw_hold *next;
  const double now = edge_length(g, 0), then = now + change, second = edge_length(g, 1);
  if (!(now > 0)) return FINE; /* no wire there: the side of the spool */
  /* An edge that is too long now and not after the step has just lost its node to the guide. */
  if (fmin(now, then) > LONGEST * g->own->size) return ADD;
  if (!(then < SHORTEST * (second > 0 ? second : g->own->size))) return FINE;
  const size_t left = edges_left(s, g, &next);
  if (left > (next ? LEAST_HELD : LEAST_FREE)) return TAKE;
  return then < LEAST_LEFT * g->own->size ? EMPTY : FINE;
}

static sw_status say_empty(const sw_scene *s, const guide *g, sw_error *err) {
  const sw_hold *next;
  const double from = g->h->s1;
  edges_left(s, g, &next);
  const double end = g->side > 0 ? g->m->s[g->m->n - 1] : g->m->s[0];
  const double to = !next ? end : g->side > 0 ? next->s1 : next->s2;
  return sw_fail(err, SW_EEMPTY,
                 "feed '%s': at t = %.6g s wire '%s' is drawn in up to %s%s%s, and only %.3g m are "
                 "left; stop the feed earlier",
                 g->h->name, sw_scene_time(s), sw_scene_wire_in(s, g->h->wire)->name,
                 next ? "'" : "its end", next ? next->name : "", next ? "'" : "", fabs(to - from));
}

/* Returns one side of hold h's guide; directions are as the holds were last placed. */
static guide guide_of(sw_scene *s, sw_hold *h, int side, const sw_vec *axes) {
  guide g = {.s = s,
             .h = h,
             .own = h->cls->hold->guide(h),
             .m = &sw_scene_wire_in(s, h->wire)->mesh,
             .side = side,
             .director = axes[0]};
  g.normal = g.m->rest ? axes[1] : sw_perpendicular(axes[0]);
  return g;
}

/* Tends one hold, side by side, as long as something is needed. edit 0: only looks. */
static sw_status tend(sw_scene *s, sw_hold *h, double fed, int edit, const sw_vec *axes,
                      int *wanted, sw_error *err) {
  for (int side = -1; side < 2; side += 2) {
    guide g = guide_of(s, h, side, axes);
    for (int i = 0; i < 8; i++) { /* several passes, where the mesh was uneven */
      const int need = needs(s, &g, fed * side * g.own->outward);
      if (need == FINE) break;
      if (need == EMPTY) return say_empty(s, &g, err);
      *wanted = 1;
      if (!edit) break;
      const sw_hold *next;
      g.left = edges_left(s, &g, &next);
      if (need == TAKE)
        take_node(&g);
      else if (add_node(&g) != SW_OK)
        return sw_fail(err, SW_ENOMEM, "feed: out of memory");
    }
  }
  return SW_OK;
}

/* Tends every hold. axes: director and normal of each of the system's holds, or NULL to look
 * only. */
static sw_status tend_all(sw_scene *s, double t, const sw_vec *axes, int *wanted, sw_error *err) {
  static const sw_vec looking[2] = {{1, 0, 0}, {0, 1, 0}};
  SW_EACH(hold, h, s) {
    if (!h->alive || !sw_hold_passes(h)) continue;
    const double fed = sw_hold_way_of(s, h, t, NULL).way - fed_at(s, h, 0);
    SW_TRY(tend(s, h, fed, axes != NULL, axes ? axes + 2 * h->number : looking, wanted, err));
  }
  return SW_OK;
}

sw_status sw_feed_make_room(sw_scene *s, double t, int *changed, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  *changed = 0;
  SW_TRY(tend_all(s, t, NULL, changed, err));
  if (!*changed) return SW_OK;
  const size_t count = system->hold_count;
  SW_TRY(sw_system_place_holds(system, sw_scene_time(s), NULL, NULL, NULL, err));
  sw_vec *axes SW_LOCAL = sw_alloc(2 * count, sizeof *axes);
  if (!axes) return sw_fail(err, SW_ENOMEM, "feed: out of memory");
  for (size_t k = 0; k < count; k++) {
    axes[2 * k] = sw_vec_at(system->directors_now, 2 * k + 1);
    axes[2 * k + 1] = sw_vec_at(system->normals_now, 2 * k + 1);
  }
  sw_status status = sw_scene_unbuild(s);
  sw_scene_feed_nodes(s);
  if (status == SW_OK) status = tend_all(s, t, axes, changed, err);
  if (status == SW_ENOMEM) return sw_fail(err, status, "feed: out of memory");
  if (status != SW_OK) return status;
  return sw_scene_build(s, err);
}
