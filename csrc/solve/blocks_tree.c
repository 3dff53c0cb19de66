/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Multifrontal factorisation (Duff and Reid 1983): analysis, factor, solution. */
#include "solve/blocks_tree.h"

#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "solve/blocks_front.h"
#include "solve/cholmod_adapter.h"
#include "solve/numbers.h"

/* A front. Its rows are nodes, ascending: those that it leaves (rest), then its own. */
typedef struct piece {
  uint32_t row;          /* start of its list of rows */
  uint32_t rest, own;    /* counts */
  uint32_t child, other; /* its last child; the previous child of the same parent; or NONE */
  size_t before, stride; /* as in sw_front */
  size_t factor;         /* start of its factor */
  size_t left;           /* start of its remainder in left */
} piece;

#define NONE UINT32_MAX

/* A block of the matrix, in the rows of the node that is eliminated first. */
typedef struct entry {
  uint32_t block;
  uint32_t other;  /* number of the node of its columns */
  uint32_t turned; /* 1: the block is stored transposed */
} entry;

struct sw_tree {
  size_t nodes, pieces;
  const uint32_t *first, *column;
  uint32_t *number;  /* (nodes) node -> its number */
  uint32_t *node;    /* (nodes) number -> node */
  piece *piece;      /* (pieces) in the order of elimination */
  uint32_t *row;     /* numbers */
  uint32_t *entries; /* (nodes + 1) a number's first entry */
  entry *entry;      /* (blocks) */
  uint32_t *place;   /* (nodes) work: columns of a front by number */
  /* Numbers written before they are read, so that another tree can take the lists over. */
  sw_numbers factor, scaled, left, x;
  double *kept, *before; /* in factor, in x */
};

void sw_tree_free(sw_tree *t) {
  if (!t) return;
  SW_FREE_ALL(t->number, t->piece, t->row, t->entry, t->factor.at, t->scaled.at, t->left.at,
              t->x.at, t);
}

/* --- analysis ------------------------------------------------------------------- */

/* Reverses the order of rows, and finds each front's children. */
static void find_pieces(sw_tree *t, const sw_cholmod_plan *plan) {
  const uint32_t last = (uint32_t)t->nodes - 1;
  uint32_t *owner = t->place; /* of each number */
  for (size_t k = 0; k < t->nodes; k++) {
    t->node[last - k] = plan->order[k];
    t->number[plan->order[k]] = last - (uint32_t)k;
  }
  for (uint32_t s = 0; s < t->pieces; s++) {
    piece *p = t->piece + s;
    const uint32_t rows = plan->start[s + 1] - plan->start[s];
    p->row = plan->start[s], p->own = plan->pivot[s + 1] - plan->pivot[s];
    p->rest = rows - p->own;
    p->child = p->other = NONE;
    for (uint32_t k = 0; k < rows; k++)
      t->row[p->row + k] = last - plan->row[p->row + rows - 1 - k];
    for (uint32_t k = plan->pivot[s]; k < plan->pivot[s + 1]; k++) owner[last - k] = s;
  }
  for (uint32_t s = 0; s < t->pieces; s++) {
    piece *p = t->piece + s;
    if (!p->rest) continue;
    piece *parent = t->piece + owner[t->row[p->row + p->rest - 1]];
    p->other = parent->child, parent->child = s;
  }
}

static void find_entries(sw_tree *t) {
  uint32_t *start = t->entries;
  for (size_t i = 0; i < t->nodes; i++)
    for (uint32_t k = t->first[i]; k < t->first[i + 1]; k++) {
      const uint32_t a = t->number[i], b = t->number[t->column[k]];
      start[(a > b ? a : b) + 1]++;
    }
  for (size_t i = 0; i < t->nodes; i++) start[i + 1] += start[i], t->place[i] = start[i];
  for (size_t i = 0; i < t->nodes; i++)
    for (uint32_t k = t->first[i]; k < t->first[i + 1]; k++) {
      const uint32_t a = t->number[i], b = t->number[t->column[k]];
      t->entry[t->place[a > b ? a : b]++] = (entry){k, a > b ? b : a, b > a};
    }
}

/* Sizes of all arrays [doubles]. */
typedef struct sizes {
  size_t factor, scaled, left, before;
} sizes;

/* Remainders are on two stacks, which alternate from parent to child, so that a front is written
 * while its children's are read. Walks through both once. */
static void lay_out(sw_tree *t, sizes *size) {
  size_t top[2] = {0, 0}, most[2] = {0, 0};
  uint32_t *turn = t->place;
  for (size_t s = t->pieces; s-- > 0;) /* parents come after children */
    for (uint32_t c = t->piece[s].child; c != NONE; c = t->piece[c].other) turn[c] = !turn[s];
  for (size_t s = 0; s < t->pieces; s++) {
    piece *p = t->piece + s;
    p->before = sw_front_pad(3 * (size_t)p->rest);
    p->stride =
        (p->before + sw_front_pad(3 * (size_t)p->own)) | SW_FRONT_TILE; /* spares cache sets */
    p->factor = size->factor;
    size->factor += 3 * p->own * p->stride;
    const size_t together = 3 * p->own < SW_FRONT_ROWS ? 3 * p->own : SW_FRONT_ROWS;
    if (together * p->stride > size->scaled) size->scaled = together * p->stride;
    if (p->before > size->before) size->before = p->before;
    size_t *mine = top + turn[s], *theirs = top + !turn[s];
    p->left = *mine;
    *mine += 3 * p->rest * p->before;
    if (*mine > most[turn[s]]) most[turn[s]] = *mine;
    for (uint32_t c = p->child; c != NONE; c = t->piece[c].other) *theirs = t->piece[c].left;
  }
  for (size_t s = 0; s < t->pieces; s++) t->piece[s].left += turn[s] ? most[0] : 0;
  size->left = most[0] + most[1];
}

static sw_status make_rooms(sw_tree *t, const sizes *size, sw_tree *old) {
  const size_t n = t->nodes;
  /* tiles may be read beyond the last row */
  SW_TRY(sw_numbers_make(&t->factor, old ? &old->factor : NULL,
                         size->factor + SW_FRONT_TILE + 3 * n * SW_FRONT_KEPT));
  SW_TRY(sw_numbers_make(&t->scaled, old ? &old->scaled : NULL, size->scaled + SW_FRONT_TILE));
  SW_TRY(sw_numbers_make(&t->left, old ? &old->left : NULL, size->left));
  SW_TRY(sw_numbers_make(&t->x, old ? &old->x : NULL, 3 * n + SW_FRONT_TILE + size->before));
  t->kept = t->factor.at + size->factor + SW_FRONT_TILE;
  t->before = t->x.at + 3 * n + SW_FRONT_TILE;
  memset(t->factor.at + size->factor, 0, SW_FRONT_TILE * sizeof *t->factor.at);
  memset(t->scaled.at + size->scaled, 0, SW_FRONT_TILE * sizeof *t->scaled.at);
  return SW_OK;
}

static sw_status build(sw_tree *t, const sw_cholmod_plan *plan, sw_tree *old) {
  const size_t n = t->nodes;
  sizes size = {0, 0, 0, 0};
  t->pieces = plan->fronts;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(t->number, 4 * n + 1), SW_ROOM(t->piece, t->pieces),
                      SW_ROOM(t->row, plan->start[t->pieces]), SW_ROOM(t->entry, t->first[n])));
  t->node = t->number + n, t->place = t->node + n, t->entries = t->place + n;
  find_pieces(t, plan);
  find_entries(t);
  memset(t->place, 0, n * sizeof *t->place);
  lay_out(t, &size);
  return make_rooms(t, &size, old);
}

sw_status sw_tree_new(size_t nodes, const uint32_t *first, const uint32_t *column,
                      const int32_t *order, sw_tree *old, sw_tree **out) {
  sw_cholmod_plan plan = {0};
  SW_TRY(sw_cholmod_analyse(nodes, first, column, order, &plan));
  sw_tree *t = sw_alloc(1, sizeof *t);
  sw_status status = SW_ENOMEM;
  if (t) {
    t->nodes = nodes, t->first = first, t->column = column;
    status = build(t, &plan, old);
  }
  sw_cholmod_free_plan(&plan);
  if (status == SW_OK)
    *out = t;
  else
    sw_tree_free(t);
  return status;
}

/* --- factorisation --------------------------------------------------------------- */

static sw_front front_of(const sw_tree *t, const piece *p) {
  return (sw_front){.n = 3 * p->own,
                    .before = p->before,
                    .place = p->before,
                    .stride = p->stride,
                    .factor = t->factor.at + p->factor,
                    .kept = t->kept + 3 * (size_t)t->row[p->row + p->rest] * SW_FRONT_KEPT,
                    .scaled = t->scaled.at};
}

/* Finds the columns of a front's nodes. */
static void find_places(const sw_tree *t, const piece *p) {
  const uint32_t *row = t->row + p->row;
  for (uint32_t k = 0; k < p->rest; k++) t->place[row[k]] = 3 * k;
  for (uint32_t k = 0; k < p->own; k++) t->place[row[p->rest + k]] = (uint32_t)p->before + 3 * k;
}

/* Adds the matrix to a front's own rows. */
static void add_entries(const sw_tree *t, const piece *p, const double *values,
                        const unsigned char *fixed) {
  for (uint32_t k = 0; k < p->own; k++) {
    const uint32_t number = t->row[p->row + p->rest + k], node = t->node[number];
    double *row = t->factor.at + p->factor + 3 * (size_t)k * p->stride;
    const int out = fixed && fixed[node];
    for (uint32_t e = t->entries[number]; e < t->entries[number + 1]; e++) {
      const entry *at = t->entry + e;
      const double *from = values + 9 * (size_t)at->block;
      double *to = row + t->place[at->other];
      const int own = at->other == number, turned = (int)at->turned;
      if (!own && (out || (fixed && fixed[t->node[at->other]]))) continue;
      for (int i = 0; i < 3; i++, to += p->stride)
        for (int j = 0; j < (own ? i + 1 : 3); j++)
          to[j] += own && out ? i == j : from[turned ? 3 * j + i : 3 * i + j];
    }
  }
}

/* Adds one row of a child's remainder, up to its node number k, at the places of its nodes in the
 * parent. */
static inline void add_row(const uint32_t *places, uint32_t k, const double *from, double *to) {
  for (uint32_t j = 0; j <= k;) {
    const uint32_t begin = j, place = places[j];
    while (++j <= k && places[j] == place + 3 * (j - begin)) {
    }
    const size_t count = 3 * (size_t)(j - begin);
    for (size_t c = 0; c < count; c++) to[place + c] += (from + 3 * (size_t)begin)[c];
  }
}

/* places: work space, one column per node. */
static void add_child(const sw_tree *t, const piece *p, const piece *child, uint32_t *places) {
  const uint32_t *row = t->row + child->row;
  const double *from = t->left.at + child->left;
  for (uint32_t k = 0; k < child->rest; k++) places[k] = t->place[row[k]];
  for (uint32_t k = 0; k < child->rest; k++) {
    const int own = places[k] >= p->before;
    const size_t stride = own ? p->stride : p->before;
    double *to = own ? t->factor.at + p->factor + (places[k] - p->before) * stride
                     : t->left.at + p->left + places[k] * stride;
    for (int i = 0; i < 3; i++, from += child->before, to += stride) add_row(places, k, from, to);
  }
}

/* Clears the lower half of a front's remainder, up to full tiles: no more of it is used. */
static void clear_left(const piece *p, double *left) {
  const size_t rows = 3 * (size_t)p->rest;
  for (size_t i = 0; i < rows; i++) {
    const size_t end = sw_front_pad(i / SW_FRONT_PANEL * SW_FRONT_PANEL + SW_FRONT_PANEL);
    memset(left + i * p->before, 0, (end < p->before ? end : p->before) * sizeof *left);
  }
}

sw_status sw_tree_factor(sw_tree *t, const double *values, const unsigned char *fixed,
                         size_t *negative) {
  size_t count = 0, bad = 0;
  for (size_t s = 0; s < t->pieces && !bad; s++) {
    const piece *p = t->piece + s;
    sw_front f = front_of(t, p);
    double *left = t->left.at + p->left;
    memset(f.factor, 0, f.n * f.stride * sizeof *f.factor);
    clear_left(p, left);
    find_places(t, p);
    add_entries(t, p, values, fixed);
    for (uint32_t c = p->child; c != NONE; c = t->piece[c].other)
      add_child(t, p, t->piece + c, (uint32_t *)(void *)t->scaled.at);
    sw_front_reduce(&f, left, 3 * (size_t)p->rest);
    if (sw_interrupted()) return SW_EINTR;
    count += f.negative, bad += f.bad;
  }
  if (negative) *negative = count;
  return bad ? SW_ESINGULAR : SW_OK;
}

double sw_tree_work(const sw_tree *t) {
  double sum = 0;
  for (size_t s = 0; s < t->pieces; s++) {
    const double own = 3.0 * t->piece[s].own, rest = 3.0 * t->piece[s].rest;
    sum += own * (own * own / 6 + own * rest / 2 + rest * rest / 2);
  }
  return sum;
}

void sw_tree_solve(const sw_tree *t, double *x) {
  double *z = t->x.at, *before = t->before;
  memset(z + 3 * t->nodes, 0, SW_FRONT_TILE * sizeof *z); /* else a NaN would stay for good */
  for (size_t k = 0; k < t->nodes; k++)
    memcpy(z + 3 * k, x + 3 * (size_t)t->node[k], 3 * sizeof *x);
  for (size_t s = 0; s < t->pieces; s++) {
    const piece *p = t->piece + s;
    const sw_front f = front_of(t, p);
    const uint32_t *row = t->row + p->row;
    memset(before, 0, p->before * sizeof *before);
    sw_front_forward(&f, z + 3 * (size_t)row[p->rest], before);
    for (size_t k = 0; k < p->rest; k++)
      for (size_t c = 0; c < 3; c++) z[3 * (size_t)row[k] + c] += before[3 * k + c];
  }
  for (size_t s = t->pieces; s-- > 0;) {
    const piece *p = t->piece + s;
    const sw_front f = front_of(t, p);
    const uint32_t *row = t->row + p->row;
    memset(before, 0, p->before * sizeof *before);
    for (size_t k = 0; k < p->rest; k++)
      memcpy(before + 3 * k, z + 3 * (size_t)row[k], 3 * sizeof *z);
    sw_front_backward(&f, z + 3 * (size_t)row[p->rest], before);
  }
  for (size_t k = 0; k < t->nodes; k++)
    memcpy(x + 3 * (size_t)t->node[k], z + 3 * k, 3 * sizeof *x);
}
