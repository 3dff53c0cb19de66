/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of touches on a line that has got other edges. Each sample stands for a stretch of the
 * wire. A new sample takes the force of the former stretches that it covers, so that the sum of the
 * forces stays; the rest of its memory is that of the nearest former sample, at its own place. */
#include "contact/resample.h"

#include <math.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "base/halving.h"
#include "contact/pads.h"
#include "contact/touch.h"
#include "state/hinge.h"

/* A sample of the former edges. */
typedef struct sample {
  const sw_memory *memory;
  double s, from, to; /* place; stretch of wire that it stands for, empty: it is alone [m] */
} sample;

/* The former samples on one pad, in the order along the wire. */
typedef struct list {
  sample *sample;
  size_t count;
} list;

/* 1 if the former nodes are those of a line: no two are at the same place. */
static int is_line(const double *s, size_t nodes) {
  for (size_t i = 0; i + 1 < nodes; i++)
    if (!(s[i] < s[i + 1])) return 0;
  return nodes > 1;
}

/* Samples on a pad reach half-way to the next ones. */
static void find_stretches(list *l) {
  for (size_t k = 0; k < l->count; k++) {
    sample *x = &l->sample[k];
    const double before = k ? x->s - x[-1].s : 0.0;
    const double after = k + 1 < l->count ? x[1].s - x->s : before;
    x->from = x->s - 0.5 * (before > 0 ? before : after), x->to = x->s + 0.5 * after;
  }
}

/* Lists the memory of one pad. */
static void find_samples(const sw_former *of, int id, list *out) {
  const sw_memory *memory = of->memory;
  out->count = 0;
  for (size_t i = 0; i < of->bytes / sizeof *memory; i++) {
    const sw_memory *m = &memory[i];
    if (m->obstacle != id || !m->segment || m->node < of->first ||
        m->node + 1 >= of->first + of->nodes)
      continue;
    const double *at = of->s + (m->node - of->first);
    out->sample[out->count++] = (sample){.memory = m, .s = at[0] + m->at * (at[1] - at[0])};
  }
  find_stretches(out);
}

/* Where something that was at `a` and `b` at the samples before and after is at `share` between. */
static sw_vec between(sw_vec a, sw_vec b, double share) { return sw_madd(a, sw_sub(b, a), share); }

/* Turns a memory to the side that it has at its new place. */
static void turn(const sample *a, const sample *b, double share, sw_memory *m) {
  const sw_vec was = m->normal;
  m->normal = sw_unit_or(between(a->memory->normal, b->memory->normal, share), was);
  const double stretch = sw_norm(m->kept.elastic);
  if (!(stretch > 0)) return;
  const sw_vec along = sw_scale(m->kept.elastic, 1.0 / stretch);
  m->kept.elastic = sw_scale(sw_carry_unit(along, was, m->normal), stretch);
}

/* Moves a memory along the wire to s. */
static void move(const list *l, size_t k, double s, sw_memory *m) {
  const size_t before = k ? k - 1 : k, after = k + 1 < l->count ? k + 1 : k;
  const sample *a = &l->sample[s < l->sample[k].s ? before : k];
  const sample *b = &l->sample[s < l->sample[k].s ? k : after];
  if (a == b) a = &l->sample[before], b = &l->sample[after]; /* at an end: further along its line */
  if (!(b->s > a->s)) return;
  const double share = (s - a->s) / (b->s - a->s);
  m->seen = between(a->memory->seen, b->memory->seen, share);
  m->point = between(a->memory->point, b->memory->point, share);
  turn(a, b, share, m);
}

/* A sample hardly presses below this share of the force that is looked for [-]. */
static const double HARDLY = 1e-3;

/* Returns the first former sample that reaches beyond s. They are in order along the wire. */
static size_t reaching(const list *l, double s) {
  size_t k;
  SW_FIRST_NOT(l->sample[k].to <= s, k, 0, l->count);
  return k;
}

/* Normal force of the former samples on the wire from `from` to `to` [N]. */
static double force_on(const list *l, double from, double to) {
  double sum = 0;
  for (size_t k = reaching(l, from); k < l->count && l->sample[k].from < to; k++) {
    const sample *x = &l->sample[k];
    const double covered = fmin(to, x->to) - fmax(from, x->from);
    if (covered > 0) sum += x->memory->kept.normal_force * (covered / (x->to - x->from));
  }
  return sum;
}

/* Returns the former sample nearest to s. */
static size_t nearest(const list *l, double s) {
  size_t k = reaching(l, s);
  if (k == l->count) k--;
  while (k > 0 && fabs(l->sample[k - 1].s - s) <= fabs(l->sample[k].s - s)) k--;
  while (k + 1 < l->count && fabs(l->sample[k + 1].s - s) < fabs(l->sample[k].s - s)) k++;
  return k;
}

/* The former sample that a new one has its memory from: the nearest one or, if that hardly presses,
 * the one with the most force on the same wire. */
static size_t origin_of(const list *l, const sample *x, double force) {
  const size_t k = nearest(l, x->s);
  if (l->sample[k].memory->kept.normal_force >= HARDLY * force) return k;
  size_t most = reaching(l, x->from);
  for (size_t i = most; i < l->count && l->sample[i].from < x->to; i++)
    if (l->sample[i].memory->kept.normal_force > l->sample[most].memory->kept.normal_force)
      most = i;
  return most;
}

/* Adds the memory of a new sample; none where the wire did not press. */
static sw_status add(sw_contact *c, const list *l, size_t node, double at, sample x) {
  const double force = force_on(l, x.from, x.to);
  if (!(force > 0)) return SW_OK;
  const size_t k = origin_of(l, &x, force);
  const sample *near = &l->sample[k];
  SW_TRY(SW_GROW(c->memory, c->memory_capacity, c->memory_count + 1));
  sw_memory *m = &c->memory[c->memory_count++];
  const double share = force / near->memory->kept.normal_force;
  *m = *near->memory;
  m->node = (uint32_t)node, m->at = at;
  m->kept.normal_force *= share, m->kept.steady *= share;
  /* at the same stiffness: it is as soft as a touch that was always there */
  m->kept.depth *= share;
  m->kept.elastic = sw_scale(m->kept.elastic, share);
  if (x.s != near->s) move(l, k, x.s, m);
  return SW_OK;
}

static sw_status add_samples(sw_contact *c, const sw_body *b, size_t pad, const list *l) {
  const sw_plan *p = b->plan;
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    const int n = sw_pad_samples(c, p, i, pad);
    const double length = (p->s[i + 1] - p->s[i]) / fmax(1, n);
    for (int k = 0; k < n; k++) {
      const double at = ((double)k + 0.5) / n;
      const double s = p->s[i] + at * (p->s[i + 1] - p->s[i]);
      const sample x = {.s = s, .from = s - 0.5 * length, .to = s + 0.5 * length};
      SW_TRY(add(c, l, b->first_node + i, at, x));
    }
  }
  return SW_OK;
}

/* The stretch that a segment stands for, or a node (segment 0): half-way to the next nodes. at:
 * place on the segment [-]. */
static sample stretch_of(const double *s, size_t nodes, size_t i, int segment, double at) {
  const size_t a = !segment && i > 0 ? i - 1 : i, b = i + 1 < nodes ? i + 1 : i;
  if (segment) return (sample){.s = s[i] + at * (s[b] - s[i]), .from = s[i], .to = s[b]};
  return (sample){.s = s[i], .from = 0.5 * (s[a] + s[i]), .to = 0.5 * (s[i] + s[b])};
}

/* Lists the pressing touches with one obstacle, on nodes (segment 0) or between them. */
static void find_row(const sw_former *of, size_t count, int id, int segment, list *out) {
  const sw_memory *memory = of->memory;
  const size_t first = of->first, end = first + of->nodes - (segment ? 1 : 0);
  out->count = 0;
  for (size_t i = 0; i < count; i++) {
    const sw_memory *m = &memory[i];
    if (m->obstacle != id || m->segment != segment || m->node < first || m->node >= end) continue;
    if (!(m->kept.normal_force > 0)) continue;
    out->sample[out->count] = stretch_of(of->s, of->nodes, m->node - first, segment, m->at);
    out->sample[out->count++].memory = m;
  }
  for (size_t k = 0; k < out->count; k++) {
    sample *x = &out->sample[k];
    const int a = k > 0 && x->memory->node - x[-1].memory->node <= 1;
    const int b = k + 1 < out->count && x[1].memory->node - x->memory->node <= 1;
    if (!a && !b) x->to = x->from;
  }
}

/* Adds a touch that is alone, as on an edge of a box: it stays at its place with its force. A node
 * that is gone leaves nothing. */
static sw_status add_alone(sw_contact *c, const sw_body *b, const sample *x, size_t now) {
  const sw_plan *p = b->plan;
  const int segment = x->memory->segment;
  if (x->to > x->from || (!segment && now == SIZE_MAX)) return SW_OK;
  double at;
  const size_t i = sw_plan_locate(p, x->s, &at);
  SW_TRY(SW_GROW(c->memory, c->memory_capacity, c->memory_count + 1));
  sw_memory *m = &c->memory[c->memory_count++];
  *m = *x->memory;
  m->node = (uint32_t)(segment ? b->first_node + i : now);
  if (segment) m->at = at;
  return SW_OK;
}

/* Adds the memory of all nodes, or of all segments. new_node: of the former nodes. */
static sw_status add_row(sw_contact *c, const sw_body *b, int segment, const list *l,
                         const size_t *new_node) {
  const sw_plan *p = b->plan;
  for (size_t i = 0; i + (segment ? 1 : 0) < p->nodes; i++) {
    const double at = segment ? 0.5 : 0.0;
    SW_TRY(add(c, l, b->first_node + i, at, stretch_of(p->s, p->nodes, i, segment, at)));
  }
  for (size_t k = 0; k < l->count; k++)
    SW_TRY(add_alone(c, b, &l->sample[k], new_node[l->sample[k].memory->node]));
  return SW_OK;
}

/* Forgets the forces of a body on an obstacle. */
static void forget(sw_contact *c, const sw_body *b, int id) {
  size_t kept = 0;
  for (size_t i = 0; i < c->memory_count; i++) {
    const sw_memory *m = &c->memory[i];
    const int own = m->node >= b->first_node && m->node < b->first_node + b->plan->nodes;
    if (!own || m->obstacle != id || !(m->kept.normal_force > 0)) c->memory[kept++] = *m;
  }
  c->memory_count = kept;
}

/* Sorts the memory. What only came near leaves the places that have got a force. */
static void tidy(sw_contact *c) {
  size_t kept = 0;
  sw_contact_sort_memory(c);
  for (size_t i = 0; i < c->memory_count; i++) {
    const sw_memory *m = &c->memory[i];
    int doubled = 0;
    for (int by = -1; by < 2; by += 2) {
      const size_t j = i + (size_t)by;
      if (j >= c->memory_count || m->kept.normal_force > 0) continue;
      const sw_memory *o = &c->memory[j];
      doubled |= o->node == m->node && o->obstacle == m->obstacle && o->segment == m->segment &&
                 o->kept.normal_force > 0;
    }
    if (!doubled) c->memory[kept++] = *m;
  }
  c->memory_count = kept;
}

/* 0 if a place touches twice, as in a hollow: the places of one flank are not told from those of
 * the other. */
static int is_single(const list *l) {
  for (size_t k = 0; k + 1 < l->count; k++)
    if (l->sample[k].memory->node == l->sample[k + 1].memory->node) return 0;
  return 1;
}

/* Of one obstacle that is no pad. */
static sw_status add_obstacle(sw_contact *c, const sw_body *b, int id, const sw_former *of,
                              list *l) {
  const size_t count = of->bytes / sizeof(sw_memory);
  int single = 1;
  for (int segment = 0; segment < 2 && single; segment++) {
    find_row(of, count, id, segment, l);
    single = is_single(l);
  }
  if (!single) return SW_OK;
  forget(c, b, id);
  for (int segment = 0; segment < 2; segment++) {
    find_row(of, count, id, segment, l);
    if (l->count) SW_TRY(add_row(c, b, segment, l, of->new_node));
  }
  return SW_OK;
}

static sw_status add_pad(sw_contact *c, const sw_body *b, int id, const sw_former *of, list *l) {
  find_samples(of, id, l);
  if (!l->count) return SW_OK;
  forget(c, b, id);
  return add_samples(c, b, sw_contact_index(c, id), l);
}

sw_status sw_contact_resample(sw_contact *c, const sw_system *system, size_t body,
                              const sw_former *of) {
  const sw_memory *m = of->memory;
  const size_t count = of->bytes / sizeof *m;
  const sw_body *b = &system->bodies[body];
  if (b->plan->web || !count || !is_line(of->s, of->nodes)) return SW_OK;
  list l = {.sample = sw_alloc(count, sizeof *l.sample)};
  int *done = sw_alloc(c->count + 1, sizeof *done);
  sw_status status = l.sample && done ? SW_OK : SW_ENOMEM;
  if (c->pad_count) sw_pads_look(c, b->plan);
  for (size_t i = 0; i < count && status == SW_OK; i++) {
    if (m[i].node < of->first || m[i].node >= of->first + of->nodes) continue;
    const size_t o = sw_contact_index(c, m[i].obstacle);
    if (o >= c->count || done[o]) continue;
    done[o] = 1;
    int pad = 0;
    for (size_t k = 0; k < c->pad_count; k++) pad |= (size_t)c->pads[k] == o;
    status = (pad ? add_pad : add_obstacle)(c, b, m[i].obstacle, of, &l);
  }
  SW_FREE_ALL(l.sample, done);
  tidy(c);
  return status;
}

void sw_contact_keep_depth(sw_contact *c, size_t first, size_t end) {
  for (size_t i = 0; i < c->memory_count; i++) {
    sw_memory *m = &c->memory[i];
    if (m->node >= first && m->node < end && m->kept.normal_force > 0)
      m->kept.left = HUGE_VAL, m->kept.edited = 1;
  }
}

int sw_contact_memory_presses(const void *memory, size_t bytes, int id, size_t first, size_t end) {
  const sw_memory *m = memory;
  for (size_t i = 0; i < bytes / sizeof *m; i++)
    if (m[i].obstacle == id && m[i].node >= first && m[i].node < end && m[i].kept.normal_force > 0)
      return 1;
  return 0;
}
