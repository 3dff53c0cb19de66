/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the bends of a wire when its edges change, or when a hold comes or goes. A wire's nodes are
 * not on its axis: all free nodes lie k h^2/12 further from a clamp's tangent (state/near.c), with
 * their own edges h and the curvature k. With other edges or holds, the nodes beside must lie
 * elsewhere, too. A short piece of wire between two holds must fit the places and directions of
 * both: an error of direction of 0.05 rad on 1.5 mm of wire is a bend radius of 30 mm. So the nodes
 * on both sides are put where the wire has its old bends (body/chain.c). */
#include "body/bends.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "body/chain.h"
#include "body/held_wire.h"
#include "body/join.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/hinge.h"

static sw_status open_view(const sw_scene *s, size_t wire, const sw_hold *fresh, int unloaded,
                           sw_held_wire *v) {
  const size_t slots = sw_scene_hold_slots(s), living = sw_scene_living_holds(s);
  const size_t joins = sw_scene_join_places(s, wire, NULL);
  sw_hold_place *places SW_LOCAL = sw_alloc(living + 1, sizeof *places);
  sw_scene_wire *w = sw_scene_wire_in((sw_scene *)s, wire);
  *v = (sw_held_wire){.mesh = &w->mesh, .fresh = fresh, .unloaded = unloaded};
  v->nodes = unloaded ? v->mesh->rest : v->mesh->x;
  v->normals = unloaded ? v->mesh->rest_normal : v->mesh->normal;
  /* NOLINTNEXTLINE(bugprone-sizeof-expression): a list of pointers */
  v->holds = sw_alloc(living + 1, sizeof *v->holds);
  v->joined = sw_alloc(joins + 1, sizeof *v->joined);
  if (!places || !v->holds || !v->joined) return SW_ENOMEM;
  for (size_t k = 0; k < slots; k++) {
    const sw_hold *h = sw_scene_hold_in((sw_scene *)s, k);
    if (h->alive && h->wire == wire && h != fresh) v->holds[v->count++] = h;
  }
  if (fresh) v->holds[v->count++] = fresh;
  for (size_t k = 0; k < v->count; k++) {
    const sw_hold *h = v->holds[k];
    places[k] =
        (sw_hold_place){h->s1, h->s2, h->cls->hold->direction, (int)k, {h->give[0], h->give[1]}};
  }
  v->joins = sw_scene_join_places(s, wire, v->joined);
  return sw_plan_new(&w->beam, v->mesh->s, v->mesh->n, places, v->count, &v->plan);
}

static void close_view(sw_held_wire *v) {
  sw_plan_release(v->plan);
  SW_FREE_ALL(v->holds, v->joined);
}

static void note(sw_bends *out, double s, sw_vec turn, double length) {
  if (length > 0) out->list[out->count++] = (sw_bend){s, sw_scale(turn, 1.0 / length)};
}

/* Notes the bends at node i: on both sides of a clamp, and within it. */
static void read_node(const sw_held_wire *v, size_t i, sw_bends *out) {
  const sw_mesh *m = v->mesh;
  const sw_clamp_hinge *before = sw_held_clamp(v, i, -1), *after = sw_held_clamp(v, i, 1);
  const sw_hold *h = sw_held_by(v, m->s[i]);
  const int clamped = h && h->cls->hold->direction, end = i == 0 || i + 1 == m->n;
  if (!clamped && end) note(out, m->s[i], sw_v(0, 0, 0), 1);
  if (!clamped && !end) note(out, m->s[i], sw_held_flexure(v, i), sw_held_joint(v, i));
  if (before)
    note(out, m->s[i], sw_held_flexure_beside(v, h, i, -1, -1), sw_held_clamp_joint(v, before));
  if (clamped && i > 0 && m->s[i] > h->s1) {
    const double half = 0.5 * (m->s[i] - m->s[i - 1]);
    if (m->s[i] == h->s2) note(out, m->s[i], sw_held_flexure_beside(v, h, i, -1, 1), half);
  }
  if (clamped && m->s[i] > h->s1 && m->s[i] < h->s2)
    note(out, m->s[i], sw_held_flexure(v, i), 0.5 * (m->s[i + 1] - m->s[i - 1]));
  if (clamped && m->s[i] == h->s1 && m->s[i] < h->s2)
    note(out, m->s[i], sw_held_flexure_beside(v, h, i, 1, -1), 0.5 * (m->s[i + 1] - m->s[i]));
  if (after)
    note(out, m->s[i], sw_held_flexure_beside(v, h, i, 1, 1), sw_held_clamp_joint(v, after));
}

static sw_status read(const sw_scene *s, size_t wire, int unloaded, sw_bends *out) {
  sw_held_wire v;
  sw_status status = open_view(s, wire, NULL, unloaded, &v);
  if (status == SW_OK && !(out->list = sw_alloc(4 * v.mesh->n, sizeof *out->list)))
    status = SW_ENOMEM;
  for (size_t i = 0; status == SW_OK && i < v.mesh->n; i++) read_node(&v, i, out);
  close_view(&v);
  return status;
}

sw_status sw_scene_read_bends(const sw_scene *s, size_t wire, sw_wire_bends *out) {
  const sw_mesh *m = &sw_scene_wire_in((sw_scene *)s, wire)->mesh;
  *out = (sw_wire_bends){{NULL, 0}, {NULL, 0}, 0};
  for (size_t e = 0; e + 1 < m->n; e++) out->longest = fmax(out->longest, m->s[e + 1] - m->s[e]);
  SW_TRY(read(s, wire, 0, &out->loads));
  return m->rest ? read(s, wire, 1, &out->unloaded) : SW_OK;
}

void sw_wire_bends_free(sw_wire_bends *b) { SW_FREE_ALL(b->loads.list, b->unloaded.list); }

/* Returns the bend at s; side -1 or 1: on that side of a jump [1/m]. */
static sw_vec bend_at(const sw_bends *b, double s, int side) {
  size_t low = 0, high = b->count;
  while (low < high) { /* the first one at s or after it, or after it (side 1) */
    const size_t k = (low + high) / 2;
    if (side > 0 ? b->list[k].s <= s : b->list[k].s < s)
      low = k + 1;
    else
      high = k;
  }
  if (side > 0 && low > 0 && b->list[low - 1].s == s) return b->list[low - 1].vector;
  if (low < b->count && (low == 0 || b->list[low].s == s)) return b->list[low].vector;
  if (low == b->count) return b->count ? b->list[low - 1].vector : sw_v(0, 0, 0);
  const sw_bend *x = &b->list[low - 1], *y = &b->list[low];
  return sw_lerp(x->vector, y->vector, (s - x->s) / (y->s - x->s));
}

/* --- give ------------------------------------------------------------------------------ */

/* Nodes on each side of a hold that move. Spread over so many, a remaining misfit needs a bend of
 * less than a hundredth of the wire's [-]. */
enum { FOLLOWERS = 8 };

/* Marks edges from node i on, on one side, up to a clamp. */
static void mark(const sw_held_wire *v, size_t i, int side, double reach, char *moves) {
  const sw_mesh *m = v->mesh;
  const double from = m->s[i];
  for (int k = 0; side > 0 ? i + 1 < m->n : i > 0; k++) {
    const size_t next = side > 0 ? i + 1 : i - 1;
    const sw_hold *h = sw_held_by(v, m->s[i]);
    if (k > 0 && h && h != v->fresh && h->cls->hold->direction) return;
    if (k >= FOLLOWERS && fabs(m->s[i] - from) >= reach) return;
    moves[side > 0 ? i : next] = 1;
    i = next;
  }
}

/* Wanted turn at node i, over a joint of this length, of which half an edge is on either side. */
static sw_vec turn_at(const sw_held_wire *v, const sw_bends *b, size_t i, double joint) {
  const sw_mesh *m = v->mesh;
  const double before = m->s[i] - m->s[i - 1], share = before / (m->s[i + 1] - m->s[i - 1]);
  const sw_vec bend = sw_lerp(bend_at(b, m->s[i], 1), bend_at(b, m->s[i], -1), share);
  return sw_madd(sw_held_rest_turn(v, i), bend, joint);
}

typedef struct maker {
  const sw_held_wire *v;
  const sw_bends *bends;
  sw_chain_link *link;
  size_t count;
  size_t lo, hi;  /* nodes */
  sw_vec from;    /* the last fixed place [m] */
  size_t *edge;   /* (edges of the stretch) their links */
  size_t held[2]; /* links of the fresh hold's directions */
  double *moved;  /* (nodes x 3) their new places [m] */
} maker;

static void push(maker *k, sw_vec u, double length, int stays) {
  k->link[k->count++] = (sw_chain_link){.u = u, .length = length, .stays = stays};
}

static void joint(maker *k, double length, sw_vec turn) {
  if (!k->count || !(length > 0)) return;
  k->link[k->count - 1].joint = length, k->link[k->count - 1].turn = turn;
}

static void clamp_joint(maker *k, const sw_hold *h, size_t i, int side, double length, int out) {
  const sw_vec bend = bend_at(k->bends, k->v->mesh->s[i], side);
  const sw_vec rest = sw_held_rest_turn_beside(k->v, h, i, side, out ? side : -side);
  joint(k, length, sw_madd(rest, bend, length));
}

/* Adds the directions that a clamping hold has at node i, and the joints before them; the joint
 * after them is added with the next link. */
static void add_clamp(maker *k, const sw_hold *h, size_t i) {
  const sw_mesh *m = k->v->mesh;
  const sw_clamp_hinge *before = i > k->lo ? sw_held_clamp(k->v, i, -1) : NULL;
  const sw_clamp_hinge *after = i < k->hi ? sw_held_clamp(k->v, i, 1) : NULL;
  const int fresh = h == k->v->fresh, wide = h->s1 < h->s2;
  const double inner_before = m->s[i] > h->s1 && fresh ? 0.5 * (m->s[i] - m->s[i - 1]) : 0;
  const double inner_after = m->s[i] < h->s2 && fresh ? 0.5 * (m->s[i + 1] - m->s[i]) : 0;
  if (before) clamp_joint(k, h, i, -1, sw_held_clamp_joint(k->v, before), 1);
  if (m->s[i] == h->s1 || !wide) {
    if (fresh) k->held[0] = k->held[1] = k->count;
    push(k, sw_held_director(k->v, h, wide || before ? -1 : 1), 0, !fresh);
    if (inner_after > 0) clamp_joint(k, h, i, 1, inner_after, 0);
  }
  if (m->s[i] > h->s1 && m->s[i] < h->s2 && fresh)
    joint(k, inner_before + inner_after, turn_at(k->v, k->bends, i, inner_before + inner_after));
  if (wide && m->s[i] == h->s2) {
    if (inner_before > 0) clamp_joint(k, h, i, -1, inner_before, 0);
    if (fresh) k->held[1] = k->count;
    push(k, sw_held_director(k->v, h, 1), 0, !fresh);
  }
  if (after) clamp_joint(k, h, i, 1, sw_held_clamp_joint(k->v, after), 1);
}

/* 1 if node i does not move. */
static int is_fixed(const maker *k, size_t i) {
  const double s = k->v->mesh->s[i];
  const sw_hold *h = sw_held_by(k->v, s);
  if (h && (h != k->v->fresh || h->args.points)) return 1; /* on a curved rail it stays */
  if (i == k->lo ? i > 0 : i == k->hi && i + 1 < k->v->mesh->n) return 1;
  for (size_t j = 0; j < k->v->joins; j++)
    if (k->v->joined[j] == s) return 1;
  return 0;
}

static void fix(maker *k, size_t i) {
  const sw_vec at = sw_vec_at(k->v->nodes, i);
  if (!k->count) push(k, sw_v(1, 0, 0), 0, 1); /* before the first edge; without a joint */
  k->link[k->count - 1].ends = 1;
  k->link[k->count - 1].span = sw_sub(at, k->from);
  k->from = at;
}

static void make_chain(maker *k) {
  const sw_mesh *m = k->v->mesh;
  const double *x = k->v->nodes;
  k->from = sw_vec_at(x, k->lo);
  for (size_t i = k->lo; i <= k->hi; i++) {
    const sw_hold *h = sw_held_by(k->v, m->s[i]);
    const int clamped = h && h->cls->hold->direction, inner = i > 0 && i + 1 < m->n;
    if (i == k->lo && i > 0 && !clamped) push(k, sw_edge_direction(x, i - 1), 0, 1);
    if (clamped)
      add_clamp(k, h, i);
    else if (inner)
      joint(k, sw_held_joint(k->v, i), turn_at(k->v, k->bends, i, sw_held_joint(k->v, i)));
    if (is_fixed(k, i)) fix(k, i);
    if (i == k->hi && i + 1 < m->n && !clamped) push(k, sw_edge_direction(x, i), 0, 1);
    if (i == k->hi) return;
    const int rigid = h && h != k->v->fresh && m->s[i + 1] <= h->s2;
    k->edge[i - k->lo] = k->count;
    push(k, sw_edge_direction(x, i),
         rigid || k->v->unloaded ? sw_dist(sw_vec_at(x, i), sw_vec_at(x, i + 1))
                                 : (m->s[i + 1] - m->s[i]) * (1.0 + m->tension[i] / m->EA),
         rigid);
  }
}

/* Puts the nodes where the links end; spreads the gap to the next fixed place over them. */
static void take_section(const maker *k, double *normals, size_t a, size_t b, int back) {
  const sw_mesh *m = k->v->mesh;
  const double *x = k->v->nodes;
  sw_vec at = sw_vec_at(x, back ? b : a), gap = sw_v(0, 0, 0);
  if (!back && is_fixed(k, b)) {
    for (size_t i = a; i < b; i++) {
      const sw_chain_link *l = &k->link[k->edge[i - k->lo]];
      gap = sw_madd(gap, l->u, l->length);
    }
    gap = sw_sub(sw_sub(sw_vec_at(x, b), at), gap);
  }
  const double whole = m->s[b] - m->s[a];
  for (size_t j = 0; j < b - a; j++) {
    const size_t e = back ? b - 1 - j : a + j;
    const sw_chain_link *l = &k->link[k->edge[e - k->lo]];
    const sw_vec was = sw_edge_direction(x, e);
    const sw_vec along = sw_madd(sw_scale(l->u, l->length), gap, (m->s[e + 1] - m->s[e]) / whole);
    at = back ? sw_sub(at, along) : sw_add(at, along);
    if (normals)
      sw_store(normals + 3 * e, sw_carry_unit(sw_vec_at(normals, e), was, sw_unit_or(along, was)));
    if (!back && e + 1 == b && is_fixed(k, b)) return;
    /* the edge that was read next begins where this node was */
    sw_store(k->moved + 3 * (back ? e : e + 1), at);
  }
}

static void take(const maker *k, sw_mesh *m, sw_hold *fresh) {
  double *x = k->v->unloaded ? m->rest : m->x;
  double *normals = k->v->unloaded ? m->rest_normal : m->normal;
  memcpy(k->moved, x, 3 * m->n * sizeof *x);
  size_t a = k->lo;
  int back = !is_fixed(k, a);
  for (size_t i = k->lo + 1; i <= k->hi; i++) {
    if (!is_fixed(k, i) && i < k->hi) continue;
    if (back && !is_fixed(k, i)) back = 0; /* nothing is fixed: from the first node on */
    take_section(k, normals, a, i, back);
    a = i, back = 0;
  }
  memcpy(x, k->moved, 3 * m->n * sizeof *x);
  for (int side = 0; fresh && fresh->cls->hold->direction && side < 2; side++) {
    const sw_vec u = k->link[k->held[side]].u;
    sw_mesh_frame *f = &fresh->frame[side];
    if (k->v->unloaded) {
      f->rest_normal = sw_carry_unit(f->rest_normal, f->rest_tangent, u), f->rest_tangent = u;
      continue;
    }
    if (m->rest) f->normal = sw_carry_unit(f->normal, f->tangent, u), f->tangent = u;
    fresh->director[side] = u;
  }
}

/* Share of its stretch that counts: a stretch that is nearly straight is bent rather than pulled
 * [-]. */
static const double GIVE = 1e-5;

static sw_status ease(sw_held_wire *v, const sw_bends *b, size_t lo, size_t hi, sw_mesh *m,
                      sw_hold *fresh, int *done) {
  const sw_beam *beam = &v->plan->beam;
  maker k = {.v = v, .bends = b, .lo = lo, .hi = hi};
  k.link = sw_alloc(4 * (hi - lo) + 8, sizeof *k.link);
  k.edge = sw_alloc(hi - lo + 1, sizeof *k.edge);
  k.moved = sw_alloc(3 * m->n, sizeof *k.moved);
  sw_status status = k.link && k.edge && k.moved ? SW_OK : SW_ENOMEM;
  if (status == SW_OK) {
    make_chain(&k);
    status = sw_chain_ease(k.link, k.count, GIVE * beam->EI / beam->EA, !is_fixed(&k, lo), done);
  }
  if (status == SW_OK && *done) take(&k, m, fresh);
  SW_FREE_ALL(k.link, k.edge, k.moved);
  return status;
}

static int is_bent(const sw_bends *b, double edge) {
  static const double STRAIGHT = 1e-9; /* rounding: bend times edge [-] */
  for (size_t k = 0; k < b->count; k++)
    if (sw_norm(b->list[k].vector) * edge > STRAIGHT) return 1;
  return 0;
}

static void mark_all(const sw_held_wire *v, const double *places, size_t count, double reach,
                     char *moves) {
  for (size_t k = 0; k < count; k++)
    for (int side = -1; side < 2; side += 2)
      mark(v, sw_mesh_node(v->mesh, places[k]), side, reach, moves);
  if (!v->fresh) return;
  for (size_t e = sw_mesh_node(v->mesh, v->fresh->s1); v->mesh->s[e] < v->fresh->s2; e++)
    moves[e] = 1;
}

/* Most holds in a stretch that is eased at once, because the cost grows with their cube. Longer
 * stretches are cut at holds, then again between the first cuts. The bends of a wire on 100 pins
 * with 6, 24 and 1000 differ by 3e-7 of themselves [-]. */
enum { MOST_HELD = 24 };

/* Returns the end of the stretch from node lo on: where edges stay, or at a hold after `most`
 * others (0: at once). */
static size_t stretch_end(const sw_held_wire *v, const char *moves, size_t lo, int most) {
  size_t hi = lo;
  for (int held = 0; hi + 1 < v->mesh->n && moves[hi]; hi++) {
    const sw_hold *h = hi > lo ? sw_held_by(v, v->mesh->s[hi]) : NULL;
    held += h && h != v->fresh && h->s1 == h->s2;
    if (held > most) break;
  }
  return hi;
}

/* Eases each stretch of edges that may move. most: holds before the first cut, if there is one. */
static sw_status ease_from(sw_held_wire *v, const sw_bends *b, const char *moves, int most,
                           sw_mesh *m, sw_hold *fresh, int *cut, int *done) {
  for (size_t lo = 0, hi; lo + 1 < m->n; lo = hi) {
    hi = stretch_end(v, moves, lo, lo == 0 || !moves[lo - 1] ? most : MOST_HELD);
    int good = 1;
    if (hi > lo) SW_TRY(ease(v, b, lo, hi, m, fresh, &good));
    *done = *done && good;
    *cut |= hi > lo && hi + 1 < m->n && moves[hi];
    if (hi == lo) hi++;
  }
  return SW_OK;
}

static sw_status ease_all(sw_held_wire *v, const sw_bends *b, const char *moves, sw_mesh *m,
                          sw_hold *fresh, int *done) {
  int cut = 0;
  SW_TRY(ease_from(v, b, moves, MOST_HELD, m, fresh, &cut, done));
  return cut ? ease_from(v, b, moves, MOST_HELD / 2, m, fresh, &cut, done) : SW_OK;
}

sw_status sw_scene_give_bends(const sw_scene *s, size_t wire, const sw_wire_bends *bends,
                              const double *places, size_t count, sw_hold *fresh, int *done) {
  sw_mesh *m = &sw_scene_wire_in((sw_scene *)s, wire)->mesh;
  const int curved = is_bent(&bends->unloaded, bends->longest);
  char *moves SW_LOCAL = sw_alloc(m->n, 1);
  *done = 1;
  if (sw_held_remembers(s, wire)) return SW_OK; /* nodes are where forces remember bends */
  if (!curved && !is_bent(&bends->loads, bends->longest)) return SW_OK;
  if (!moves) return SW_ENOMEM;
  for (int unloaded = curved; unloaded >= 0; unloaded--) {
    sw_held_wire v;
    sw_status status = open_view(s, wire, fresh, unloaded, &v);
    if (status == SW_OK) mark_all(&v, places, count, FOLLOWERS * bends->longest, moves);
    if (status == SW_OK)
      status = ease_all(&v, unloaded ? &bends->unloaded : &bends->loads, moves, m, fresh, done);
    close_view(&v);
    SW_TRY(status);
  }
  return SW_OK;
}

sw_status sw_scene_give_all_bends(const sw_scene *s, size_t wire, const sw_wire_bends *bends) {
  size_t count = 0;
  int done;
  if (sw_held_moves(s, wire, &bends->loads)) return SW_OK;
  double *places SW_LOCAL = sw_alloc(2 * sw_scene_living_holds(s) + 1, sizeof *places);
  if (!places) return SW_ENOMEM;
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++) {
    const sw_hold *h = sw_scene_hold_in((sw_scene *)s, k);
    if (h->alive && h->wire == wire) places[count++] = h->s1, places[count++] = h->s2;
  }
  return sw_scene_give_bends(s, wire, bends, places, count, NULL, &done);
}
