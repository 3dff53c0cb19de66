/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triangles of wires' surfaces, frame by frame. */
#include "film/skin.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/vec.h"

typedef struct tailor {
  const sw_scene *s;
  const sw_skin_args *a;
  size_t sections, around;
  int loose, meshed;
  double radius;
  sw_vec across; /* direction to corner 0 of the first section, from the frame before */
} tailor;

/* Returns the points of frame k, or of the nearest frame that has any; step: floats from one point
 * to the next. NULL: no frame has points. */
static const float *points_of(const tailor *t, size_t k, size_t *count, size_t *step) {
  for (size_t away = 0; away < t->a->count; away++)
    for (int side = 0; side < 2; side++) {
      const size_t at = side ? k + away : k - away; /* below 0 it wraps to a huge number */
      size_t around;
      if (at >= t->a->count) continue;
      const float *p =
          t->meshed ? sw_scene_frame_surface(t->s, t->a->frames[at], t->a->wire, count, &around)
                    : sw_scene_frame_wire(t->s, t->a->frames[at], t->a->wire, count);
      *step = t->meshed ? SW_FRAME_SURFACE : 3;
      if (p && t->meshed && around != t->around) continue;
      if (p && *count) return p;
    }
  return NULL;
}

/* Point k of section i of t->sections, interpolated between the sections of the frame. */
static sw_vec point_at(const tailor *t, const float *p, size_t count, size_t step, size_t i,
                       size_t k) {
  const size_t each = t->meshed ? t->around : 1, there = count / each;
  const double x =
      t->sections > 1 ? (double)i * (double)(there - 1) / (double)(t->sections - 1) : 0;
  const size_t low = (size_t)x, high = low + 1 < there ? low + 1 : low;
  return sw_lerp(sw_vec_of(p + step * (each * low + k)), sw_vec_of(p + step * (each * high + k)),
                 x - (double)low);
}

/* --- a section ---------------------------------------------------------------------- */

static void round_section(tailor *t, sw_vec p, sw_vec along, sw_vec *across, float *at, float *n) {
  *across = sw_unit_or(sw_madd(*across, along, -sw_dot(*across, along)), sw_perpendicular(along));
  const sw_vec side = sw_cross(along, *across);
  for (size_t k = 0; k < t->around; k++) {
    const double a = 2 * M_PI * (double)k / (double)t->around;
    const sw_vec out = sw_add(sw_scale(*across, cos(a)), sw_scale(side, sin(a)));
    sw_vec_to(at + 3 * k, sw_madd(p, out, t->radius)), sw_vec_to(n + 3 * k, out);
  }
}

static void tube(tailor *t, const float *p, size_t count, size_t step, float *at, float *n) {
  sw_vec before = sw_v(1, 0, 0), across = t->across;
  for (size_t i = 0; i < t->sections; i++) {
    const sw_vec here = point_at(t, p, count, step, i, 0);
    const sw_vec after =
        i + 1 < t->sections
            ? sw_unit_or(sw_sub(point_at(t, p, count, step, i + 1, 0), here), before)
            : before;
    const sw_vec along = i ? sw_unit_or(sw_add(before, after), after) : after;
    round_section(t, here, along, &across, at + 3 * t->around * i, n + 3 * t->around * i);
    if (i == 0) t->across = across;
    before = after;
  }
}

static void meshed(const tailor *t, const float *p, size_t count, size_t step, float *at,
                   float *n) {
  const size_t w = t->around;
  for (size_t i = 0; i < t->sections; i++)
    for (size_t k = 0; k < w; k++)
      sw_vec_to(at + 3 * (w * i + k), point_at(t, p, count, step, i, k));
  for (size_t i = 0; i < t->sections; i++)
    for (size_t k = 0; k < w; k++) {
      const size_t last = i + 1 < t->sections ? i + 1 : i, first = i ? i - 1 : i;
      const sw_vec on =
          sw_sub(sw_vec_of(at + 3 * (w * last + k)), sw_vec_of(at + 3 * (w * first + k)));
      const sw_vec round = sw_sub(sw_vec_of(at + 3 * (w * i + (k + 1) % w)),
                                  sw_vec_of(at + 3 * (w * i + (k + w - 1) % w)));
      sw_vec_to(n + 3 * (w * i + k), sw_unit_or(sw_cross(round, on), sw_v(0, 0, 1)));
    }
}

/* Makes the ends: a separate ring and a middle point at each end, so that the edges stay sharp. */
static void ends(const tailor *t, float *at, float *n) {
  const size_t w = t->around, body = w * t->sections;
  for (size_t e = 0; e < 2; e++) {
    const size_t ring = e ? body - w : 0, inner = e ? ring - w : w, own = body + e * (w + 1);
    sw_vec middle = sw_v(0, 0, 0), within = sw_v(0, 0, 0);
    for (size_t k = 0; k < w; k++) {
      middle = sw_madd(middle, sw_vec_of(at + 3 * (ring + k)), 1 / (double)w);
      within = sw_madd(within, sw_vec_of(at + 3 * (inner + k)), 1 / (double)w);
    }
    const sw_vec out = sw_unit_or(sw_sub(middle, within), sw_v(0, 0, 1));
    memcpy(at + 3 * own, at + 3 * ring, 3 * w * sizeof *at);
    sw_vec_to(at + 3 * (own + w), middle);
    for (size_t k = 0; k <= w; k++) sw_vec_to(n + 3 * (own + k), out);
  }
}

/* --- triangles -------------------------------------------------------------------------- */

static void put_triangles(const tailor *t, uint32_t *to) {
  const uint32_t w = (uint32_t)t->around, body = w * (uint32_t)t->sections;
  for (uint32_t i = 0; i + w < body; i += w)
    for (uint32_t k = 0; k < w; k++) {
      const uint32_t a = i + k, b = i + (k + 1) % w;
      const uint32_t two[6] = {a, b, b + w, a, b + w, a + w};
      memcpy(to, two, sizeof two), to += 6;
    }
  for (uint32_t e = 0; e < 2; e++)
    for (uint32_t k = 0; k < w; k++) {
      const uint32_t own = body + e * (w + 1), next = (k + 1) % w;
      *to++ = own + w, *to++ = own + (e ? k : next), *to++ = own + (e ? next : k);
    }
}

/* --- all frames ------------------------------------------------------------------------------ */

/* Makes frame k. Call it for the frames in order. */
static void fill(tailor *t, size_t k, const sw_skin *skin, float *at) {
  size_t count, step;
  const float *p = points_of(t, k, &count, &step);
  float *n = at + 3 * skin->corners;
  if (t->loose) {
    for (size_t i = 0; i < t->sections; i++)
      sw_vec_to(at + 3 * i, point_at(t, p, count, step, i, 0));
    return;
  }
  if (t->meshed)
    meshed(t, p, count, step, at, n);
  else
    tube(t, p, count, step, at, n);
  ends(t, at, n);
}

static void bound(const float *at, size_t corners, float *out) {
  for (int c = 0; c < 3; c++) out[c] = at[c], out[3 + c] = at[c];
  for (size_t i = 0; i < 3 * corners; i++) {
    out[i % 3] = fminf(out[i % 3], at[i]);
    out[3 + i % 3] = fmaxf(out[3 + i % 3], at[i]);
  }
}

static sw_status look(tailor *t, sw_error *err) {
  size_t count = 0, step, around = 0;
  t->loose = sw_scene_frame_is_loose(t->s, t->a->wire);
  for (size_t k = 0; k < t->a->count && !t->loose && !around; k++)
    if (!sw_scene_frame_surface(t->s, t->a->frames[k], t->a->wire, &count, &around)) around = 0;
  t->meshed = around > 0;
  t->around = t->loose ? 1 : around ? around : t->a->sides;
  t->radius = t->a->thickness * sw_scene_frame_radius(t->s, t->a->wire);
  t->across = sw_v(0, 0, 1);
  if (!t->a->count || !points_of(t, 0, &count, &step) ||
      (!t->loose && count / (t->meshed ? around : 1) < 2))
    return sw_fail(err, SW_EINVAL, "no frame has this wire");
  t->sections = t->meshed ? count / around : count;
  return SW_OK;
}

static sw_status make(tailor *t, int (*interrupted)(void), sw_skin *out) {
  const size_t w = t->around;
  out->normals = !t->loose;
  out->corners = t->loose ? t->sections : w * t->sections + 2 * (w + 1);
  out->triangles = t->loose ? 0 : 2 * w * (t->sections - 1) + 2 * w;
  const size_t size = 3 * out->corners * (out->normals ? 2 : 1);
  out->data = sw_alloc(t->a->count, size * sizeof *out->data);
  out->bounds = sw_alloc(t->a->count, 6 * sizeof *out->bounds);
  out->triangle = sw_alloc(out->triangles, 3 * sizeof *out->triangle);
  if (!out->data || !out->bounds || !out->triangle) return SW_ENOMEM;
  if (!t->loose) put_triangles(t, out->triangle);
  for (size_t k = 0; k < t->a->count; k++) {
    if (interrupted && interrupted()) return SW_EINTR;
    fill(t, k, out, out->data + size * k);
  }
  for (size_t k = t->a->count; k-- > 0;) {
    float *at = out->data + size * k;
    for (size_t i = 0; t->a->differences && k && i < size; i++) at[i] -= out->data[i];
    bound(at, out->corners, out->bounds + 6 * k);
  }
  return SW_OK;
}

sw_status sw_skin_make(const sw_scene *s, const sw_skin_args *args, int (*interrupted)(void),
                       sw_skin *out, sw_error *err) {
  tailor t = {.s = s, .a = args};
  *out = (sw_skin){.corners = 0};
  SW_TRY(look(&t, err));
  const sw_status status = make(&t, interrupted, out);
  if (status != SW_OK) sw_skin_free(out);
  return status == SW_ENOMEM ? sw_fail(err, status, "out of memory for surfaces") : status;
}

void sw_skin_free(sw_skin *skin) {
  sw_free(skin->data), sw_free(skin->bounds), sw_free(skin->triangle);
  skin->data = skin->bounds = NULL, skin->triangle = NULL;
}
