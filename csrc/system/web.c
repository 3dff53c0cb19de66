/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Webs of particles: choice and assembly of the matrix, its solution, and the springs' axial
 * forces. */
#include "system/web.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "base/each.h"
#include "base/simd.h"
#include "solve/band3.h"
#include "solve/blocks.h"

/* --- the matrix -------------------------------------------------------------------- */

static size_t between(const sw_blocks *m, size_t a, size_t b) {
  return a > b ? sw_blocks_slot(m, a, b) : sw_blocks_slot(m, b, a);
}

/* Target of joined pairs of particles: a list, or their slots of a matrix, or nothing. */
typedef struct sink {
  size_t count;
  sw_couple *list; /* or NULL */
  size_t *slot;    /* the next one; or NULL */
  const sw_blocks *blocks;
} sink;

static void put(sink *to, uint32_t a, uint32_t b) {
  if (to->list) to->list[to->count] = (sw_couple){a, b};
  if (to->slot) *to->slot++ = between(to->blocks, a, b);
  to->count++;
}

static void put_all(sink *to, const uint32_t *node, uint32_t count) {
  for (uint32_t i = 1; i < count; i++)
    for (uint32_t j = 0; j < i; j++) put(to, node[j], node[i]);
}

/* Writes all joined pairs, in the order of their slots. Returns their number. */
static size_t join_all(const sw_web *w, sink to) {
  for (size_t e = 0; e < w->links; e++) put(&to, w->link[e].a, w->link[e].b);
  SW_ITEMS(const sw_web_fold, f, w->fold, w->folds) {
    put(&to, f->a, f->b), put(&to, f->a, f->c), put(&to, f->b, f->c);
  }
  SW_ITEMS(const sw_web_crease, f, w->crease, w->creases) {
    put(&to, f->a, f->b), put(&to, f->c, f->b), put(&to, f->d, f->b);
    put(&to, f->a, f->c), put(&to, f->a, f->d), put(&to, f->c, f->d);
  }
  for (size_t k = 0; k < w->solids; k++) {
    size_t *const first = to.slot;
    put_all(&to, w->solid[k].node, w->solid[k].count);
    if (first) to.slot = first + SW_FIELD_SOLID_PAIRS;
  }
  for (size_t k = 0; k < w->slides; k++) put_all(&to, w->slide[k].node, SW_SLIDE_NODES);
  to.slot = NULL; /* neighbours on the surface have no slots of their own */
  for (size_t p = 0; p < w->particles; p++)
    for (size_t k = w->side_first[p]; k < w->side_first[p + 1]; k++)
      put(&to, (uint32_t)p, w->side[k]);
  return to.count;
}

/* Makes a matrix of the web's joined pairs and of others (more x 2). */
static sw_status new_sparse(const sw_web *w, const uint32_t *others, size_t more, sw_blocks **out) {
  sw_couple *pairs SW_LOCAL = sw_alloc(join_all(w, (sink){0}) + more, sizeof *pairs);
  if (!pairs) return SW_ENOMEM;
  size_t count = join_all(w, (sink){.list = pairs});
  for (size_t i = 0; i < more; i++) pairs[count++] = (sw_couple){others[2 * i], others[2 * i + 1]};
  return sw_blocks_new_sparse(w->particles, pairs, count, NULL, NULL, out);
}

/* Rings are full blocks, although a particle of a large ring is joined to few others. From WIDE
 * particles in a ring on, a sparse matrix may save more than its analysis costs. */
enum { WIDE = 24 };
/* Largest work of a sparse matrix over that of rings for which it is chosen. With equal work a
 * sparse one is slower, because its dense pieces are smaller: a factor and a solution took 0.8 to
 * 1.2 times as long where it has 0.6 of the work, 0.04 times where it has 0.03 (3 to 100 rings of
 * 25 to 289 particles) [-] */
static const double CHEAPER = 0.6;

/* Makes the web's matrix with further pairs (more x 2). */
static sw_status new_blocks(const sw_web *w, const uint32_t *others, size_t more, sw_blocks **out) {
  if (!w->banded) return new_sparse(w, others, more, out);
  if (w->per_ring >= WIDE) {
    SW_TRY(new_sparse(w, others, more, out));
    if (sw_blocks_work(*out) < CHEAPER * sw_blocks_rings_work(w->rings, w->per_ring)) return SW_OK;
    sw_blocks_free(*out);
    *out = NULL;
  }
  return sw_blocks_new_rings(w->rings, w->per_ring, out);
}

static void fill_slots(sw_body *b) {
  const sw_web *w = b->plan->web;
  size_t *own = b->web_slots, *link = own + w->particles, *fold = link + w->links;
  size_t *crease = fold + 3 * w->folds, *solid = crease + SW_FIELD_CREASE_PAIRS * w->creases;
  for (size_t p = 0; p < w->particles; p++) own[p] = sw_blocks_slot(b->blocks, p, p);
  (void)join_all(w, (sink){.slot = link, .blocks = b->blocks});
  b->field.own_slot = own, b->field.link_slot = link;
  b->field.fold_slot = fold, b->field.crease_slot = crease, b->field.solid_slot = solid;
  b->field.slide_slot = solid + SW_FIELD_SOLID_PAIRS * w->solids;
}

/* Matrices differ little within a step. From LARGE particles on, the first one's factor
 * preconditions conjugate gradients for the following ones while these converge fast; a factor
 * costs some dozens of iterations. Each step starts with a new factor, so that it depends only on
 * its starting state. */
enum { LARGE = 30000, MOST_ITERATIONS = 20, EARLY = 5 };
static const double EXACT = 1e-7; /* remaining error, in the solution's energy norm [-] */
static const double PROMISE =
    0.03; /* error after the early iterations above which iteration is too slow [-] */

static void use_blocks(sw_body *b) {
  fill_slots(b);
  b->field.slot_of = sw_blocks_slot, b->field.matrix = b->blocks;
  b->field.blocks = sw_blocks_values(b->blocks);
  b->field.block_stride = sw_blocks_stride(b->blocks);
}

sw_status sw_web_prepare(sw_body *b) {
  const sw_web *w = b->plan->web;
  SW_TRY(new_blocks(w, NULL, 0, &b->blocks));
  const size_t slots = w->particles + w->links + 3 * w->folds + SW_FIELD_SOLID_PAIRS * w->solids +
                       SW_FIELD_SLIDE_PAIRS * w->slides + SW_FIELD_CREASE_PAIRS * w->creases;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(b->web_slots, slots), SW_ROOM(b->web_fixed, w->particles)));
  if (w->particles >= LARGE && !w->banded) {
    b->web_room = sw_alloc(15 * w->particles, sizeof *b->web_room);
    if (!b->web_room) return SW_ENOMEM;
  }
  for (size_t p = 0; p < w->particles; p++) b->web_fixed[p] = b->plan->held[p] != SW_FREE;
  use_blocks(b);
  return SW_OK;
}

sw_status sw_body_plan_pairs(sw_body *b, const uint32_t *pairs, size_t count) {
  const size_t size = 2 * count * sizeof *pairs;
  if (count == b->web_pair_count && (!count || memcmp(pairs, b->web_pairs, size) == 0))
    return SW_OK;
  sw_blocks *blocks;
  uint32_t *copy = sw_alloc(2 * count, sizeof *copy);
  if (!copy) return SW_ENOMEM;
  if (count) memcpy(copy, pairs, size);
  const sw_status status = new_blocks(b->plan->web, pairs, count, &blocks);
  if (status != SW_OK) {
    sw_free(copy);
    return status;
  }
  sw_blocks_free(b->blocks);
  sw_free(b->web_pairs);
  b->blocks = blocks, b->web_pairs = copy, b->web_pair_count = count;
  b->web_factored = 0, b->web_replanned = 1;
  use_blocks(b);
  return SW_OK;
}

void sw_web_discard(sw_body *b) {
  sw_blocks_free(b->blocks);
  SW_FREE_ALL(b->web_slots, b->web_fixed, b->web_pairs, b->web_room);
}

size_t sw_web_couples_room(const sw_body *b) {
  return join_all(b->plan->web, (sink){0}) + b->web_pair_count;
}

size_t sw_web_couples(const sw_body *b, sw_couple *out) {
  const sw_web *w = b->plan->web;
  size_t n = join_all(w, (sink){.list = out}), kept = 0;
  for (size_t k = 0; k < b->web_pair_count; k++)
    out[n++] = (sw_couple){b->web_pairs[2 * k], b->web_pairs[2 * k + 1]};
  for (size_t k = 0; k < n; k++)
    if (out[k].i > out[k].j) out[k] = (sw_couple){out[k].j, out[k].i};
  if (n) qsort(out, n, sizeof *out, sw_couple_order);
  for (size_t k = 0; k < n; k++)
    if (k == 0 || sw_couple_order(&out[k], &out[kept - 1])) out[kept++] = out[k];
  return kept;
}

/* Blocks are stored in the rows of the larger number; only the lower half of a particle's own block
 * counts. */
void sw_web_block(const sw_body *b, size_t i, size_t j, double out[9]) {
  const size_t slot = sw_blocks_slot(b->blocks, j, i), stride = b->field.block_stride;
  for (size_t r = 0; r < 3; r++)
    for (size_t c = 0; c < 3; c++) {
      const int swap = i != j || c > r;
      out[3 * r + c] = b->field.blocks[slot + stride * (swap ? c : r) + (swap ? r : c)];
    }
}

void sw_web_begin(sw_body *b) { sw_blocks_clear(b->blocks); }

void sw_body_couple(sw_body *b, size_t i, size_t j, const double K[9]) {
  const size_t slot = between(b->blocks, i, j);
  if (slot != SIZE_MAX) sw_field_add_block(&b->field, i, j, slot, K, 3);
}

void sw_web_gather(sw_body *b) {
  const sw_field *f = &b->field;
  for (size_t p = 0; p < b->plan->nodes; p++) { /* the lower half, the only one that is read */
    double *first = f->blocks + f->own_slot[p];
    double *second = first + f->block_stride, *third = second + f->block_stride;
    const double *row = f->rows + SW_ROW_SIZE * p;
    first[0] += row[0];
    second[0] += row[1], second[1] += row[3];
    third[0] += row[2], third[1] += row[4], third[2] += row[5];
  }
}

void sw_web_hold(sw_held_node *h, const sw_body *b, double *right) {
  double *at = right + 3 * (h->node - b->first_node);
  h->own_force = sw_neg(sw_load(at));
  sw_store(at, sw_v(0, 0, 0));
}

sw_vec sw_web_reaction(const sw_held_node *h, const sw_body *b, const double *delta) {
  double push[3];
  sw_blocks_row_times(b->blocks, h->node - b->first_node, delta, push);
  return sw_add(h->own_force, sw_load(push));
}

static double dot(size_t n, const double *a, const double *b) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

/* Solves for delta, which holds the right-hand side. Returns 0, with delta unchanged, if this is
 * too slow. */
static int iterate(const sw_body *b, double *delta) {
  const size_t particles = b->plan->nodes, n = 3 * particles;
  double *x = b->web_room, *r = x + n, *z = x + 2 * n, *p = x + 3 * n, *Ap = x + 4 * n;
  memset(x, 0, n * sizeof *x);
  memcpy(r, delta, n * sizeof *r);
  memcpy(p, delta, n * sizeof *p);
  sw_blocks_solve(b->blocks, p);
  double rz = dot(n, r, p);
  const double whole = rz, enough = EXACT * EXACT * rz;
  if (rz == 0) return 1;
  for (int k = 0; k < MOST_ITERATIONS && rz > 0; k++) {
    sw_blocks_multiply(b->blocks, p, Ap);
    for (size_t i = 0; i < particles; i++)
      if (b->web_fixed[i]) sw_store(Ap + 3 * i, sw_v(0, 0, 0));
    const double curve = dot(n, p, Ap);
    if (!(curve > 0)) return 0; /* not positive definite */
    const double step = rz / curve;
    for (size_t i = 0; i < n; i++) x[i] += step * p[i], r[i] -= step * Ap[i];
    memcpy(z, r, n * sizeof *z);
    sw_blocks_solve(b->blocks, z);
    const double before = rz;
    rz = dot(n, r, z);
    if (fabs(rz) <= enough) {
      memcpy(delta, x, n * sizeof *x);
      return 1;
    }
    if (k == EARLY && fabs(rz) > PROMISE * PROMISE * whole) return 0;
    for (size_t i = 0; i < n; i++) p[i] = z[i] + rz / before * p[i];
  }
  return 0;
}

sw_status sw_web_solve(sw_body *b, double *delta, size_t *negative) {
  *negative = 0;
  if (b->web_factored && b->web_room && !b->field.statics) {
    if (iterate(b, delta)) return SW_OK;
    b->web_slow = 1;
  }
  SW_TRY(sw_blocks_factor(b->blocks, b->web_fixed, negative));
  b->web_factored = *negative == 0 && !b->web_slow;
  sw_blocks_solve(b->blocks, delta);
  return SW_OK;
}

/* --- springs ------------------------------------------------------------------------ */

SW_HOT
static double advance(const sw_web *w, const double *restrict x, const double *restrict delta,
                      double *restrict axial) {
  double largest = 0;
  for (size_t e = 0; e < w->links; e++) {
    const sw_web_link *link = &w->link[e];
    const double *a = x + 3 * (size_t)link->a, *b = x + 3 * (size_t)link->b;
    const double *p = delta + 3 * (size_t)link->a, *q = delta + 3 * (size_t)link->b;
    const double e0 = b[0] - a[0], e1 = b[1] - a[1], e2 = b[2] - a[2];
    const double d0 = q[0] - p[0], d1 = q[1] - p[1], d2 = q[2] - p[2];
    const double l = sqrt(e0 * e0 + e1 * e1 + e2 * e2), r = 1.0 / l;
    const double along = (e0 * d0 + e1 * d1 + e2 * d2) * r;
    const double across2 = (d0 * d0 + d1 * d1 + d2 * d2 - along * along) * (r * r);
    axial[e] = link->k * (l + along - link->rest);
    largest = largest > across2 ? largest : across2;
  }
  return largest;
}

/* Returns the square of the largest rotation of edges between consecutive corners of solid
 * elements. */
static double solid_turn2(const sw_web *w, const double *x, const double *delta) {
  double largest = 0;
  for (size_t n = 0; n < w->solids; n++)
    for (uint32_t i = 0; i + 1 < w->solid[n].count; i++) {
      const size_t a = w->solid[n].node[i], b = w->solid[n].node[i + 1];
      const sw_vec e = sw_sub(sw_vec_at(x, b), sw_vec_at(x, a));
      const sw_vec d = sw_sub(sw_vec_at(delta, b), sw_vec_at(delta, a));
      const double l2 = sw_norm2(e), along = sw_dot(d, e);
      const double across2 = (sw_norm2(d) - along * along / l2) / l2;
      if (!(across2 <= largest)) largest = across2;
    }
  return largest;
}

double sw_web_change(const sw_body *body, const double *x, const double *from, const double *to) {
  const sw_web *w = body->plan->web;
  double largest = 0;
  for (size_t n = 0; n < w->solids; n++)
    for (uint32_t i = 0; i + 1 < w->solid[n].count; i++) {
      const size_t a = w->solid[n].node[i], b = w->solid[n].node[i + 1];
      sw_vec d = sw_sub(sw_vec_at(to, b), sw_vec_at(to, a));
      if (from) d = sw_sub(d, sw_sub(sw_vec_at(from, b), sw_vec_at(from, a)));
      const double change2 = sw_norm2(d) / sw_norm2(sw_sub(sw_vec_at(x, b), sw_vec_at(x, a)));
      if (!(change2 <= largest)) largest = change2;
    }
  return sqrt(largest);
}

double sw_web_advance(const sw_body *b, const double *x, const double *delta, double *axial) {
  const double springs = advance(b->plan->web, x, delta, axial);
  const double solids = solid_turn2(b->plan->web, x, delta);
  return springs >= solids ? springs : solids; /* a NaN of the solids passes through */
}

void sw_web_axial(const sw_body *b, const double *x, double *axial) {
  const sw_web *w = b->plan->web;
  for (size_t e = 0; e < w->links; e++) {
    const double l = sw_dist(sw_vec_at(x, w->link[e].a), sw_vec_at(x, w->link[e].b));
    axial[e] = w->link[e].k * (l - w->link[e].rest);
  }
}

SW_HOT
static long count_turned(const sw_web *w, const double *restrict x, const double *restrict y,
                         double share) {
  long turned = 0;
  for (size_t e = 0; e < w->links; e++) {
    const double *a = x + 3 * (size_t)w->link[e].a, *b = x + 3 * (size_t)w->link[e].b;
    const double *p = y + 3 * (size_t)w->link[e].a, *q = y + 3 * (size_t)w->link[e].b;
    const double e0 = b[0] - a[0], e1 = b[1] - a[1], e2 = b[2] - a[2];
    const double along = e0 * (q[0] - p[0]) + e1 * (q[1] - p[1]) + e2 * (q[2] - p[2]);
    turned += !(along >= share * (e0 * e0 + e1 * e1 + e2 * e2));
  }
  return turned;
}

long sw_web_turned(const sw_body *b, const double *x, const double *y, double share) {
  return count_turned(b->plan->web, x, y, share);
}
