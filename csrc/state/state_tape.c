/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beams, meshes, webs and plans on a tape, with checks of indices. */
#include "state/state_tape.h"

#include "base/alloc.h"
#include "base/each.h"

#define DOUBLE(field) sw_tape_double(t, &x->field)
#define INT(field) sw_tape_int(t, &x->field)
#define SIZE(field) sw_tape_size(t, &x->field)
#define ARRAY(field, count) SW_TAPE_ARRAY(t, x->field, count)
#define OPTIONAL(field, count) SW_TAPE_OPTIONAL(t, x->field, count)

void sw_tape_beam(sw_tape *t, sw_beam *x) {
  SW_TAPE_STRUCT(t, sw_beam, 96);
  DOUBLE(EA), DOUBLE(EI), DOUBLE(GJ), DOUBLE(mass), DOUBLE(radius), DOUBLE(E);
  DOUBLE(rest_twist), DOUBLE(EI_axis[0]), DOUBLE(EI_axis[1]), DOUBLE(spin_inertia);
  INT(rolls), INT(curved), INT(framed);
}

void sw_tape_mesh_frame(sw_tape *t, sw_mesh_frame *x) {
  SW_TAPE_STRUCT(t, sw_mesh_frame, 96);
  sw_tape_vec(t, &x->tangent), sw_tape_vec(t, &x->normal);
  sw_tape_vec(t, &x->rest_tangent), sw_tape_vec(t, &x->rest_normal);
}

/* Expects at least two nodes with rising arc lengths. */
static void expect_rising(sw_tape *t, const double *s, size_t n) {
  sw_tape_expect(t, n >= 2, "a wire without nodes");
  if (!sw_tape_reads(t) || !sw_tape_good(t)) return;
  sw_tape_finite(t, s, n, "arc length");
  for (size_t i = 0; i + 1 < n; i++) sw_tape_expect(t, s[i] < s[i + 1], "arc lengths do not rise");
}

/* Allocates zeroed arrays that are not on the tape because a system sets them. */
static void fill_up(sw_tape *t, sw_mesh *x) {
  double **const lists[] = {&x->a, &x->tension, &x->rate, &x->turn, &x->spin};
  const size_t width[] = {3, 1, 1, 1, 1}, count = x->rest ? 5 : 3;
  for (size_t k = 0; k < count && sw_tape_reads(t) && sw_tape_good(t); k++) {
    if (!*lists[k]) *lists[k] = sw_alloc(width[k] * x->n, sizeof **lists[k]);
    if (!*lists[k]) sw_tape_fail(t, SW_ENOMEM);
  }
}

void sw_tape_mesh(sw_tape *t, sw_mesh *x, int alone) {
  SW_TAPE_STRUCT(t, sw_mesh, 144);
  sw_tape_count(t, &x->n, sizeof *x->s);
  DOUBLE(EA), DOUBLE(spacing), DOUBLE(scale), INT(drawn);
  const size_t n = x->n;
  int framed = x->rest != NULL;
  sw_tape_int(t, &framed);
  ARRAY(s, n), ARRAY(x, 3 * n), ARRAY(v, 3 * n);
  if (framed) ARRAY(rest, 3 * n), ARRAY(normal, 3 * n), ARRAY(rest_normal, 3 * n), ARRAY(twist, n);
  if (alone) ARRAY(a, 3 * n), ARRAY(tension, n), ARRAY(rate, n);
  if (alone && framed) ARRAY(turn, n), ARRAY(spin, n);
  if (!alone) fill_up(t, x);
  if (!sw_tape_reads(t)) return;
  x->capacity = n;
  if (t->home || !sw_tape_good(t)) return;
  expect_rising(t, x->s, n);
  const double *const lists[] = {x->x, x->v, x->a, x->rest, x->normal, x->rest_normal};
  for (size_t k = 0; k < sizeof lists / sizeof lists[0]; k++)
    if (lists[k]) sw_tape_finite(t, lists[k], 3 * n, "a wire's mesh");
  sw_tape_expect(t, x->scale > 0 && isfinite(x->scale) && x->spacing > 0, "a mesh without scale");
}

/* --- webs ------------------------------------------------------------------------ */

static void tape_sizes(sw_tape *t, sw_web *x) {
  SW_TAPE_STRUCT(t, sw_web, 384);
  sw_tape_count(t, &x->particles, sizeof *x->mass);
  SIZE(rings), SIZE(per_ring), INT(banded);
  sw_tape_count(t, &x->links, sizeof *x->link);
  sw_tape_count(t, &x->folds, sizeof *x->fold);
  sw_tape_count(t, &x->solids, sizeof *x->solid);
  sw_tape_count(t, &x->slides, sizeof *x->slide);
  sw_tape_count(t, &x->creases, sizeof *x->crease);
  sw_tape_count(t, &x->around_count, sizeof *x->around);
  sw_tape_count(t, &x->faces, sizeof *x->face);
  SIZE(shape_count), SIZE(clamped_shapes), sw_tape_uint32(t, &x->axis);
  sw_tape_expect(t, x->rings <= x->particles && x->per_ring <= x->particles, "rings of a mesh");
  DOUBLE(friction), DOUBLE(slide_rate2), DOUBLE(length), DOUBLE(solid_rate2), DOUBLE(rate2);
  DOUBLE(repel_distance), DOUBLE(repel_stiffness), DOUBLE(wall), DOUBLE(line_skin), DOUBLE(skin),
      DOUBLE(proud);
}

static void tape_lists(sw_tape *t, sw_web *x, size_t shape_size) {
  const size_t n = x->particles;
  size_t sides = x->side_first && !sw_tape_reads(t) ? x->side_first[n] : 0;
  OPTIONAL(first, x->rings + 1);
  ARRAY(link, x->links), ARRAY(fold, x->folds), ARRAY(solid, x->solids);
  OPTIONAL(slide, x->slides), OPTIONAL(crease, x->creases), OPTIONAL(yield, x->links),
      OPTIONAL(hardening, x->links);
  sw_tape_optional(t, &x->shapes, x->shape_count, shape_size);
  OPTIONAL(ring_links, x->rings + 1), OPTIONAL(ring_solids, x->rings + 1);
  ARRAY(mass, n), ARRAY(s, n), ARRAY(behind, n), OPTIONAL(along, n);
  OPTIONAL(share, x->per_ring), OPTIONAL(section, 2 * x->per_ring);
  OPTIONAL(around, x->around_count), OPTIONAL(face, 3 * x->faces);
  ARRAY(outer, n), ARRAY(side_first, n + 1);
  sw_tape_count(t, &sides, sizeof *x->side);
  OPTIONAL(side, sides);
  if (!sw_tape_reads(t) || !sw_tape_good(t)) return;
  sw_tape_expect(t, x->side_first[n] == sides, "the surface of a mesh");
}

/* 1 if all are below the limit. */
static int all_below(const uint32_t *x, size_t count, size_t limit) {
  for (size_t i = 0; i < count; i++)
    if (x[i] >= limit) return 0;
  return 1;
}

/* 1 if the list rises from 0 and never exceeds the limit. */
static int is_index(const size_t *x, size_t count, size_t limit) {
  if (!x || x[0] != 0 || x[count - 1] > limit) return 0;
  for (size_t i = 0; i + 1 < count; i++)
    if (x[i] > x[i + 1]) return 0;
  return 1;
}

/* 1 if the particles of a part exist, are all different and, in a banded web, are no more than a
 * ring apart. */
static int is_part(const sw_web *w, const uint32_t *node, size_t count) {
  if (!all_below(node, count, w->particles)) return 0;
  size_t low = SIZE_MAX, high = 0;
  for (size_t i = 0; i < count; i++) {
    for (size_t j = 0; j < i; j++)
      if (node[i] == node[j]) return 0;
    const size_t ring = w->banded ? sw_web_ring_of(w, node[i]) : 0;
    low = ring < low ? ring : low, high = ring > high ? ring : high;
  }
  return high - low <= 1;
}

static int are_rings(const sw_web *w) {
  if (!w->per_ring) return !w->first && !w->rings && !w->banded && w->length > 0;
  if (w->rings < 2 || !is_index(w->first, w->rings + 1, w->particles)) return 0;
  if (w->first[w->rings] != w->particles || !w->share || !w->section || !w->along) return 0;
  for (size_t r = 0; r < w->rings; r++) {
    const size_t wide = w->first[r + 1] - w->first[r];
    if (wide != 1 && wide != w->per_ring) return 0;
    if (w->banded && wide != w->per_ring) return 0;
  }
  return is_index(w->ring_links, w->rings + 1, w->links) &&
         is_index(w->ring_solids, w->rings + 1, w->solids) && w->axis <= w->per_ring &&
         all_below(w->around, w->around ? w->around_count : 0, w->per_ring) &&
         all_below(w->face, w->face ? 3 * w->faces : 0, w->per_ring);
}

static int are_parts(const sw_web *w) {
  for (size_t i = 0; i < w->links; i++) {
    const uint32_t node[2] = {w->link[i].a, w->link[i].b};
    if (!is_part(w, node, 2) || !isfinite(w->link[i].k) || !(w->link[i].rest > 0)) return 0;
  }
  for (size_t i = 0; i < w->folds; i++) {
    const uint32_t node[3] = {w->fold[i].a, w->fold[i].b, w->fold[i].c};
    if (!is_part(w, node, 3)) return 0;
  }
  SW_ITEMS(const sw_web_solid, s, w->solid, w->solids) {
    if ((s->count != 6 && s->count != 8) || s->shape >= w->shape_count || !w->shapes) return 0;
    if (w->clamped_shapes >= w->shape_count - s->shape) return 0;
    if (!is_part(w, s->node, s->count)) return 0;
  }
  for (size_t i = 0; i < w->creases; i++) {
    if (!w->crease) return 0;
    const uint32_t node[4] = {w->crease[i].a, w->crease[i].b, w->crease[i].c, w->crease[i].d};
    if (!is_part(w, node, 4)) return 0;
  }
  for (size_t i = 0; i < w->slides; i++)
    if (!w->slide || !is_part(w, w->slide[i].node, SW_SLIDE_NODES)) return 0;
  return (w->yield == NULL) == (w->hardening == NULL);
}

static void check_web(sw_tape *t, const sw_web *w) {
  if (!sw_tape_good(t)) return;
  sw_tape_expect(t, w->particles > 0 && w->particles < UINT32_MAX, "a mesh without particles");
  if (w->shape_count && !w->shapes) sw_tape_damaged(t, "a mesh without its elements");
  sw_tape_finite(t, w->mass, w->particles, "mass");
  sw_tape_finite(t, w->s, w->particles, "arc length");
  sw_tape_finite(t, w->behind, w->particles, "stiffness");
  if (!sw_tape_good(t)) return;
  sw_tape_expect(t, are_rings(w), "the rings of a mesh");
  if (sw_tape_good(t)) sw_tape_expect(t, are_parts(w), "the parts of a mesh");
  if (!sw_tape_good(t)) return;
  const size_t sides = w->side_first[w->particles];
  sw_tape_expect(t,
                 is_index(w->side_first, w->particles + 1, sides) && (!sides || w->side) &&
                     all_below(w->side, sides, w->particles),
                 "the surface of a mesh");
  for (size_t i = 0; i < w->particles && sw_tape_good(t); i++)
    sw_tape_expect(t, w->mass[i] > 0, "a particle without mass");
}

static void retain_web(void *web) { sw_web_retain(web); }
static void release_web(void *web) { sw_web_release(web); }

void sw_tape_web(sw_tape *t, sw_web **web, size_t shape_size) {
  static const sw_sharing sharing = {retain_web, release_web};
  if (sw_tape_share(t, web, &sharing)) return;
  if (!sw_tape_object(t, web, sizeof **web)) return;
  if (sw_tape_reads(t)) (*web)->references = 1;
  SW_TAPE_STRUCT(t, sw_web_link, 24);
  SW_TAPE_STRUCT(t, sw_web_fold, 32);
  SW_TAPE_STRUCT(t, sw_web_solid, 40);
  SW_TAPE_STRUCT(t, sw_web_slide, 56);
  SW_TAPE_STRUCT(t, sw_web_crease, 32);
  tape_sizes(t, *web);
  tape_lists(t, *web, shape_size);
  if (sw_tape_reads(t)) check_web(t, *web);
}

/* --- plans ----------------------------------------------------------------------- */

static void check_plan(sw_tape *t, const sw_plan *p) {
  if (!sw_tape_good(t)) return;
  if (p->web)
    sw_tape_expect(t, p->web->particles == p->nodes && !p->edges, "the plan of a mesh");
  else
    sw_tape_expect(t, p->nodes >= 2 && p->edges == p->nodes - 1, "the plan of a wire");
  sw_tape_finite(t, p->s, p->nodes, "arc length");
  for (size_t c = 0; c < p->clamp_count && sw_tape_good(t); c++) {
    const sw_clamp_hinge *h = &p->clamps[c];
    sw_tape_expect(t, h->node < p->nodes && h->edge < p->edges && (h->side == 1 || h->side == -1),
                   "a clamp of a plan");
  }
}

static void tape_plan_web(sw_tape *t, sw_plan *p, sw_web *own, size_t shape_size) {
  enum { NONE, OWN, OTHER };
  int kind = !p->web ? NONE : p->web == own ? OWN : OTHER;
  sw_tape_int(t, &kind);
  if (kind == OTHER) sw_tape_web(t, &p->web, shape_size);
  if (kind != OWN || !sw_tape_reads(t)) return;
  sw_tape_expect(t, own != NULL, "the plan of a mesh");
  p->web = sw_web_retain(own);
}

static void retain_plan(void *plan) { sw_plan_retain(plan); }
static void release_plan(void *plan) { sw_plan_release(plan); }

void sw_tape_plan(sw_tape *t, sw_plan **plan, sw_web *own, size_t shape_size) {
  static const sw_sharing sharing = {retain_plan, release_plan};
  if (sw_tape_share(t, plan, &sharing)) return;
  if (!sw_tape_object(t, plan, sizeof **plan)) return;
  if (sw_tape_reads(t)) (*plan)->references = 1;
  sw_plan *x = *plan;
  SW_TAPE_STRUCT(t, sw_plan, 248);
  SW_TAPE_STRUCT(t, sw_clamp_hinge, 48);
  SW_TAPE_STRUCT(t, sw_span, 40);
  sw_tape_count(t, &x->nodes, sizeof *x->s);
  SIZE(edges), DOUBLE(length);
  sw_tape_beam(t, &x->beam);
  tape_plan_web(t, x, own, shape_size);
  sw_tape_count(t, &x->clamp_count, sizeof *x->clamps);
  sw_tape_count(t, &x->span_count, sizeof *x->spans);
  const size_t n = x->nodes, hinges = n + x->clamp_count;
  ARRAY(s, n), ARRAY(rest, n), ARRAY(lumped, n), ARRAY(mass_own, n), ARRAY(mass_next, n);
  ARRAY(hinge, n), ARRAY(held, n), ARRAY(clamps, x->clamp_count), ARRAY(spans, x->span_count);
  OPTIONAL(rest_bend, 2 * hinges), OPTIONAL(rest_twist, hinges), OPTIONAL(drawn_arc, x->edges);
  if (sw_tape_reads(t)) check_plan(t, x);
}
