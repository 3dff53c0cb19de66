/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deformation of the sections of a wire that is a mesh: widths, ovalisation, torsion, strain of the
 * surface. */
#include <math.h>

#include "body/build.h"
#include "read/section.h"
#include "scene/parts.h"
#include "scene/review.h"
#include "scene/wire.h"
#include "state/hinge.h"
#include "strand/ring.h"

/* --- the place ---------------------------------------------------------------------- */

/* A place on a mesh. */
typedef struct spot {
  const sw_scene_wire *wire;
  const sw_web *web;
  const double *x; /* places of its particles [m] */
  size_t ring;     /* ring before the place; the next ring exists, too [-] */
  double f;        /* share of the way to the next ring [-] */
  size_t slice;    /* this slice and the next one have the nearest middles [-] */
  int single;      /* 1: there is no next slice */
  double between;  /* share of the way between their middles, outside 0 to 1 near ends [-] */
} spot;

static sw_status open_mesh(sw_scene *s, sw_handle h, const char *what, spot *out, sw_error *err) {
  sw_scene_wire *wire;
  SW_TRY(sw_scene_open_wire(s, h, &wire, err));
  const sw_body *b = &sw_scene_system(s)->bodies[h.slot];
  *out = (spot){.wire = wire, .web = b->plan->web, .x = sw_scene_system(s)->x + 3 * b->first_node};
  if (sw_scene_has_sections(wire)) return SW_OK;
  sw_scene_asks_other_model(s);
  sw_fail(err, SW_EINVAL,
          "wire:%s: wire '%s' is a %s, whose section does not change; this is for meshes of "
          "particles (model = 'tube', 'radial', 'cubic', ...)",
          what, wire->name, wire->cls->name);
  return SW_EINVAL;
}

static double ring_s(const sw_web *w, size_t ring) { return w->s[w->first[ring]]; }

static sw_status open_place(sw_scene *s, sw_handle h, double place, spot *p, sw_error *err) {
  SW_TRY(open_mesh(s, h, "section", p, err));
  SW_TRY(sw_scene_check_place(p->wire, place, err));
  p->ring =
      sw_plan_locate(sw_scene_system(s)->bodies[h.slot].plan, place + p->wire->mesh.s[0], &p->f);
  const size_t slices = p->web->rings - 1;
  if (!sw_web_is_ring(p->web, p->ring) || !sw_web_is_ring(p->web, p->ring + 1))
    return sw_fail(
        err, SW_EINVAL,
        "wire '%s': at s = %.6g m it is a line of particles, whose section does not "
        "change; it has sections only in the region of wire:remodel, or of a mixed grasp "
        "that is not frozen (freeze that one first, to grasp elsewhere)",
        p->wire->name, place);
  p->slice = p->f < 0.5 && p->ring > 0 ? p->ring - 1 : p->ring;
  if (p->slice + 1 >= slices) p->slice = slices > 1 ? slices - 2 : 0;
  if (p->slice < p->ring && !sw_web_is_ring(p->web, p->slice)) p->slice = p->ring;
  const int more = p->slice + 1 < slices && sw_web_is_ring(p->web, p->slice + 2);
  if (!more && p->slice == p->ring && p->ring > 0 && sw_web_is_ring(p->web, p->ring - 1))
    p->slice = p->ring - 1;
  p->single = p->slice + 1 >= slices || !sw_web_is_ring(p->web, p->slice + 2);
  p->between = p->single ? 0.0 : (double)p->ring + p->f - ((double)p->slice + 0.5);
  return SW_OK;
}

/* Returns the tangent of the middle line at the spot, interpolated between the rings. */
static sw_vec tangent_of(const spot *p) {
  const sw_vec a = sw_web_facing(p->web, p->x, p->ring);
  return sw_unit_or(sw_lerp(a, sw_web_facing(p->web, p->x, p->ring + 1), p->f), a);
}

static void outline_of(const spot *p, double *out) {
  double next[3 * SW_OUTLINE];
  sw_strand_outline(p->web, p->x, p->ring, out);
  sw_strand_outline(p->web, p->x, p->ring + 1, next);
  for (size_t i = 0; i < 3 * p->web->around_count; i++) out[i] += p->f * (next[i] - out[i]);
}

/* --- torsion ------------------------------------------------------------------------ */

/* Finds the turn and its rate at the spot, and where the section's x has turned to. */
static void torsion(const spot *p, sw_section_shape *out) {
  const sw_web *w = p->web;
  const size_t last = p->ring + 1 > p->slice + 2 ? p->ring + 1 : p->slice + 2;
  size_t start = p->ring; /* where the mesh of this spot begins */
  while (start > 0 && sw_web_is_ring(w, start - 1)) start--;
  sw_vec t = sw_web_facing(w, p->x, start), u = sw_perpendicular(t);
  double before = sw_strand_turned(w, p->x, start, t, u), sum = 0, ends[2] = {0, 0},
         rate[2] = {0, 0};
  u = sw_turned(u, t, before);
  before = 0;
  sw_vec carried = u;
  for (size_t r = start + 1; r <= last && r < w->rings && sw_web_is_ring(w, r); r++) {
    const sw_vec next = sw_web_facing(w, p->x, r);
    u = sw_carry_unit(u, t, next);
    t = next;
    const double now = sw_strand_turned(w, p->x, r, t, u), step = remainder(now - before, 2 * M_PI);
    before = now;
    sum += step;
    if (r <= p->ring) ends[0] = sum, carried = u;
    if (r == p->ring + 1) ends[1] = sum;
    if (r == p->slice + 1) rate[0] = rate[1] = step / (ring_s(w, r) - ring_s(w, r - 1));
    if (r == p->slice + 2) rate[1] = step / (ring_s(w, r) - ring_s(w, r - 1));
  }
  out->turn = ends[0] + p->f * (ends[1] - ends[0]);
  out->twist_rate = rate[0] + p->between * (rate[1] - rate[0]);
  carried = sw_carry_unit(carried, sw_web_facing(w, p->x, p->ring), out->tangent);
  out->axis = sw_turned(carried, out->tangent, out->turn);
}

/* --- strain ------------------------------------------------------------------------- */

static double line_strain(const spot *p, size_t slice, size_t particle) {
  const size_t *first = p->web->first;
  const double l = sw_dist(sw_vec_at(p->x, first[slice] + particle),
                           sw_vec_at(p->x, first[slice + 1] + particle));
  return l / p->web->along[first[slice] + particle] - 1.0;
}

/* Returns the mean strain of the two lines round the wire that meet at point k of a ring's
 * outline. */
static double hoop_strain(const spot *p, size_t ring, size_t k) {
  const sw_web *w = p->web;
  const double *at = p->x + 3 * w->first[ring];
  const size_t n = w->around_count;
  const uint32_t three[3] = {w->around[(k + n - 1) % n], w->around[k], w->around[(k + 1) % n]};
  double sum = 0;
  for (int i = 0; i < 2; i++) {
    const double *a = w->section + 2 * (size_t)three[i], *b = w->section + 2 * (size_t)three[i + 1];
    const double l = sw_dist(sw_vec_at(at, three[i]), sw_vec_at(at, three[i + 1]));
    sum += l / hypot(b[0] - a[0], b[1] - a[1]) - 1.0;
  }
  return 0.5 * sum;
}

static void strains(const spot *p, sw_section_shape *out) {
  const sw_web *w = p->web;
  const size_t next = p->single ? p->slice : p->slice + 1;
  for (size_t k = 0; k < w->around_count; k++) {
    const double a = line_strain(p, p->slice, w->around[k]);
    const double b = line_strain(p, next, w->around[k]);
    const double c = hoop_strain(p, p->ring, k), d = hoop_strain(p, p->ring + 1, k);
    out->axial[k] = a + p->between * (b - a);
    out->hoop[k] = c + p->f * (d - c);
  }
}

/* --- the whole ---------------------------------------------------------------------- */

sw_status sw_scene_wire_outline(sw_scene *s, sw_handle h, size_t *count, sw_error *err) {
  spot p = {0};
  SW_TRY(open_mesh(s, h, "section", &p, err));
  *count = p.web->around_count;
  return SW_OK;
}

/* Returns the area within the surface, which lies `skin` outside the outline. */
static double area_of(const sw_section_shape *p) {
  double area = 0, round = 0;
  for (size_t k = 0; k < p->count; k++) {
    const sw_vec a = sw_sub(sw_vec_at(p->particles, k), p->middle);
    const sw_vec b = sw_sub(sw_vec_at(p->particles, (k + 1) % p->count), p->middle),
                 d = sw_sub(b, a);
    area += 0.5 * sw_dot(sw_cross(a, b), p->tangent);
    round += sw_norm(sw_madd(d, p->tangent, -sw_dot(d, p->tangent)));
  }
  return area + p->skin * round + M_PI * p->skin * p->skin;
}

sw_status sw_scene_wire_section(sw_scene *s, sw_handle h, double place, sw_section_shape *out,
                                sw_error *err) {
  spot p = {0};
  SW_TRY(open_place(s, h, place, &p, err));
  const sw_web *w = p.web;
  out->count = w->around_count;
  out->skin = w->skin - w->proud;
  out->tangent = tangent_of(&p);
  out->middle = sw_lerp(sw_web_centre(w, p.x, p.ring), sw_web_centre(w, p.x, p.ring + 1), p.f);
  outline_of(&p, out->particles);
  sw_outline_widen(out->particles, out->count, out->tangent, out->skin, out->surface);
  const sw_widths wide = sw_outline_widths(out->particles, out->count, out->tangent);
  out->least = wide.least + 2.0 * out->skin, out->largest = wide.largest + 2.0 * out->skin;
  out->least_way = wide.least_way, out->largest_way = wide.largest_way;
  out->ovalisation = sw_outline_ovalisation(w, out->particles, out->tangent);
  out->area = area_of(out);
  torsion(&p, out);
  strains(&p, out);
  return SW_OK;
}

sw_status sw_scene_wire_width(sw_scene *s, sw_handle h, double place, sw_vec direction,
                              double *width, sw_error *err) {
  spot p = {0};
  double outline[3 * SW_OUTLINE], low = HUGE_VAL, high = -HUGE_VAL;
  SW_TRY(open_place(s, h, place, &p, err));
  const sw_vec t = tangent_of(&p), across = sw_madd(direction, t, -sw_dot(direction, t));
  if (!(sw_norm(across) > 1e-9 * sw_norm(direction)))
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': the direction {%.4g, %.4g, %.4g} of a width must not be along the "
                   "wire or zero",
                   p.wire->name, direction.x, direction.y, direction.z);
  const sw_vec way = sw_unit_or(across, t);
  outline_of(&p, outline);
  for (size_t k = 0; k < p.web->around_count; k++) {
    const double at = sw_dot(sw_vec_at(outline, k), way);
    low = fmin(low, at), high = fmax(high, at);
  }
  *width = high - low + 2.0 * (p.web->skin - p.web->proud);
  return SW_OK;
}
