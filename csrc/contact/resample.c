/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory of touches on a line that has got other edges. A sample's memory is that of the nearest
 * former sample, at its own place. */
#include "contact/resample.h"

#include <math.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "contact/pads.h"
#include "contact/touch.h"
#include "state/hinge.h"

/* A sample of the former edges. */
typedef struct sample {
  const sw_memory *memory;
  double s, length; /* place, length of wire that it stands for; 0: it is alone [m] */
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

static void find_lengths(list *l) {
  for (size_t k = 0; k < l->count; k++) {
    const size_t before = k ? k - 1 : k, after = k + 1 < l->count ? k + 1 : k;
    const double way = l->sample[after].s - l->sample[before].s;
    l->sample[k].length = after > before ? way / (double)(after - before) : 0.0;
  }
}

/* Lists the memory of one pad. */
static void find_samples(const sw_memory *memory, size_t count, int id, size_t first,
                         const double *s, size_t nodes, list *out) {
  out->count = 0;
  for (size_t i = 0; i < count; i++) {
    const sw_memory *m = &memory[i];
    if (m->obstacle != id || !m->segment || m->node < first || m->node + 1 >= first + nodes)
      continue;
    const double *at = s + (m->node - first);
    out->sample[out->count++] = (sample){m, at[0] + m->at * (at[1] - at[0]), 0};
  }
  find_lengths(out);
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

/* Adds the memory of a new sample; none where the wire had not come under the pad. */
static sw_status add(sw_contact *c, const list *l, size_t node, double at, double s,
                     double length) {
  size_t k = 0;
  while (k + 1 < l->count && fabs(l->sample[k + 1].s - s) < fabs(l->sample[k].s - s)) k++;
  const sample *near = &l->sample[k];
  if (!(near->length > 0) || fabs(near->s - s) > 0.5 * (near->length + length)) return SW_OK;
  SW_TRY(SW_GROW(c->memory, c->memory_capacity, c->memory_count + 1));
  sw_memory *m = &c->memory[c->memory_count++];
  const double share = length / near->length;
  *m = *near->memory;
  m->node = (uint32_t)node, m->at = at;
  m->kept.normal_force *= share, m->kept.steady *= share;
  m->kept.k *= share, m->kept.grip *= share;
  move(l, k, s, m);
  return SW_OK;
}

static sw_status add_pad(sw_contact *c, const sw_body *b, size_t pad, const list *l) {
  const sw_plan *p = b->plan;
  for (size_t i = 0; i + 1 < p->nodes; i++) {
    const int n = sw_pad_samples(c, p, i, pad);
    const double length = (p->s[i + 1] - p->s[i]) / fmax(1, n);
    for (int k = 0; k < n; k++) {
      const double at = ((double)k + 0.5) / n;
      SW_TRY(add(c, l, b->first_node + i, at, p->s[i] + at * (p->s[i + 1] - p->s[i]), length));
    }
  }
  return SW_OK;
}

/* Lists the pressing touches with one obstacle, on nodes (segment 0) or between them. */
static void find_row(const sw_memory *memory, size_t count, int id, int segment, size_t first,
                     const double *s, size_t nodes, list *out) {
  out->count = 0;
  for (size_t i = 0; i < count; i++) {
    const sw_memory *m = &memory[i];
    const size_t end = first + nodes - (segment ? 1 : 0);
    if (m->obstacle != id || m->segment != segment || m->node < first || m->node >= end) continue;
    const double *at = s + (m->node - first);
    const double place = at[0] + (segment ? m->at * (at[1] - at[0]) : 0.0);
    if (m->kept.normal_force > 0) out->sample[out->count++] = (sample){m, place, 0};
  }
  for (size_t k = 0; k < out->count; k++) {
    const sample *x = &out->sample[k];
    const int a = k > 0 && x[0].memory->node - x[-1].memory->node == 1;
    const int b = k + 1 < out->count && x[1].memory->node - x[0].memory->node == 1;
    const double way = (b ? x[1].s : x->s) - (a ? x[-1].s : x->s);
    out->sample[k].length = a || b ? way / (a + b) : 0.0;
  }
}

/* 1 if there is memory of the node, or of the segment that begins there. The first `count` are in
 * order. */
static int has_memory(const sw_contact *c, size_t count, size_t node, int segment, int id) {
  size_t low = 0, high = count;
  while (low < high) {
    const size_t k = (low + high) / 2;
    if (c->memory[k].node < node)
      low = k + 1;
    else
      high = k;
  }
  for (; low < count && c->memory[low].node == node; low++)
    if (c->memory[low].obstacle == id && c->memory[low].segment == segment) return 1;
  return 0;
}

/* A touch that is alone, as on an edge of a box, stays at its place with its force. */
static sw_status add_alone(sw_contact *c, const sw_body *b, const sample *x, size_t count) {
  const sw_plan *p = b->plan;
  size_t i = 0;
  if (x->length > 0 || !x->memory->segment) return SW_OK;
  while (i + 2 < p->nodes && p->s[i + 1] <= x->s) i++;
  if (has_memory(c, count, b->first_node + i, 1, x->memory->obstacle)) return SW_OK;
  SW_TRY(SW_GROW(c->memory, c->memory_capacity, c->memory_count + 1));
  sw_memory *m = &c->memory[c->memory_count++];
  *m = *x->memory;
  m->node = (uint32_t)(b->first_node + i), m->at = (x->s - p->s[i]) / (p->s[i + 1] - p->s[i]);
  return SW_OK;
}

/* Adds the memory of the nodes or segments that have none. count: memory that was there before. */
static sw_status add_row(sw_contact *c, const sw_body *b, int id, int segment, const list *l,
                         size_t count) {
  const sw_plan *p = b->plan;
  for (size_t i = 0; i + (segment ? 1 : 0) < p->nodes; i++) {
    const size_t before = !segment && i > 0 ? i - 1 : i, after = i + 1 < p->nodes ? i + 1 : i;
    const double length = (p->s[after] - p->s[before]) * (segment ? 1.0 : 0.5);
    const double at = segment ? 0.5 : 0.0, s = p->s[i] + at * (p->s[after] - p->s[i]);
    if (has_memory(c, count, b->first_node + i, segment, id)) continue;
    SW_TRY(add(c, l, b->first_node + i, at, s, length));
  }
  for (size_t k = 0; k < l->count; k++) SW_TRY(add_alone(c, b, &l->sample[k], count));
  return SW_OK;
}

/* Of one obstacle that is no pad. */
static sw_status add_obstacle(sw_contact *c, const sw_body *b, int id, const sw_memory *memory,
                              size_t bytes, size_t first, const double *s, size_t nodes, list *l) {
  const size_t count = c->memory_count;
  for (int segment = 0; segment < 2; segment++) {
    find_row(memory, bytes / sizeof *memory, id, segment, first, s, nodes, l);
    if (l->count) SW_TRY(add_row(c, b, id, segment, l, count));
  }
  if (c->memory_count > count) sw_contact_sort_memory(c);
  return SW_OK;
}

sw_status sw_contact_resample_rows(sw_contact *c, const sw_system *system, size_t body,
                                   const void *memory, size_t bytes, size_t first, const double *s,
                                   size_t nodes) {
  const sw_memory *of = memory;
  const size_t count = bytes / sizeof *of;
  if (!count || !is_line(s, nodes)) return SW_OK;
  list l = {.sample = sw_alloc(count, sizeof *l.sample)};
  int *done = sw_alloc(c->count + 1, sizeof *done);
  sw_status status = l.sample && done ? SW_OK : SW_ENOMEM;
  for (size_t k = 0; k < c->pad_count && status == SW_OK; k++) done[c->pads[k]] = 1;
  for (size_t i = 0; i < count && status == SW_OK; i++) {
    if (of[i].node < first || of[i].node >= first + nodes) continue;
    const size_t o = sw_contact_index(c, of[i].obstacle);
    if (o >= c->count || done[o]) continue;
    done[o] = 1;
    status = add_obstacle(c, &system->bodies[body], of[i].obstacle, of, bytes, first, s, nodes, &l);
  }
  SW_FREE_ALL(l.sample, done);
  return status;
}

sw_status sw_contact_resample(sw_contact *c, const sw_system *system, size_t body,
                              const void *memory, size_t bytes, size_t first, const double *s,
                              size_t nodes) {
  const sw_body *b = &system->bodies[body];
  const size_t count = bytes / sizeof(sw_memory);
  if (b->plan->web || !count || !c->pad_count || !is_line(s, nodes)) return SW_OK;
  list l = {.sample = sw_alloc(count, sizeof *l.sample)};
  if (!l.sample) return SW_ENOMEM;
  sw_status status = SW_OK;
  sw_pads_look(c, b->plan);
  for (size_t k = 0; k < c->pad_count && status == SW_OK; k++) {
    const size_t pad = (size_t)c->pads[k];
    find_samples(memory, count, c->obstacles[pad].id, first, s, nodes, &l);
    if (l.count) status = add_pad(c, b, pad, &l);
  }
  sw_free(l.sample);
  sw_contact_sort_memory(c);
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
