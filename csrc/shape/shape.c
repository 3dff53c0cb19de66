/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all shapes share: making, counting references, sending queries on. */
#include "shape/shape.h"

#include <string.h>

#include "base/alloc.h"
#include "shape/shape_class.h"

static const sw_shape_class *const classes[] = {
#define X(name) &sw_shape_class_##name,
#include "shape/list.def"
#undef X
};
static const char *const kinds[] = {
#define X(name) #name,
#include "shape/list.def"
#undef X
    NULL};
enum { CLASSES = sizeof classes / sizeof classes[0] };

const char *const *sw_shape_kinds(void) { return kinds; }

const sw_shape_class *sw_shape_class_find(const char *kind) {
  for (size_t i = 0; i < CLASSES; i++)
    if (strcmp(classes[i]->kind, kind) == 0) return classes[i];
  return NULL;
}

const sw_params *sw_shape_class_params(const sw_shape_class *class) { return &class->params; }

sw_status sw_shape_new(const sw_shape_class *class, const sw_shape_args *args,
                       const sw_shape_source *source, sw_shape **out, sw_error *err) {
  static const sw_shape_source nothing;
  *out = NULL;
  sw_shape *shape = sw_alloc(1, class->size);
  if (!shape) return sw_fail(err, SW_ENOMEM, "%s: out of memory", class->params.object);
  shape->class = class;
  shape->references = 1;
  const sw_status status = class->create(shape, args, source ? source : &nothing, err);
  if (status != SW_OK) {
    sw_shape_release(shape);
    return status;
  }
  *out = shape;
  return SW_OK;
}

sw_shape *sw_shape_retain(sw_shape *shape) {
  if (shape) shape->references++;
  return shape;
}

void sw_shape_release(sw_shape *shape) {
  if (!shape || --shape->references > 0) return;
  if (shape->class->destroy) shape->class->destroy(shape);
  sw_free(shape);
}

sw_bounds sw_shape_bounds(const sw_shape *shape) { return shape->bounds; }
const char *sw_shape_kind(const sw_shape *shape) { return shape->class->kind; }

void sw_shape_triangles(const sw_shape *shape, const double **vertices, size_t *vertex_count,
                        const int **indices, size_t *triangle_count) {
  *vertices = NULL, *indices = NULL;
  *vertex_count = *triangle_count = 0;
  if (shape->class->triangles)
    shape->class->triangles(shape, vertices, vertex_count, indices, triangle_count);
}

/* --- queries -------------------------------------------------------------- */

/* Sum of the coordinates' sizes; NaN stays NaN [m] */
static inline double size_of(sw_vec p) { return fabs(p.x) + fabs(p.y) + fabs(p.z); }

int sw_shape_point(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  if (!(size_of(p) < SW_SHAPE_FAR)) return 0;
  return shape->class->distance(shape, p, reach, out);
}

int sw_shape_segment(const sw_shape *shape, sw_vec a, sw_vec b, double reach,
                     sw_closest out[SW_CLOSEST_MAX]) {
  if (!(size_of(a) + size_of(b) < SW_SHAPE_FAR) || !(reach > -SW_SHAPE_FAR)) return 0;
  const sw_bounds swept = sw_bounds_of(a, b, fmax(reach, 0));
  if (!sw_bounds_meet(&swept, &shape->bounds)) return 0;
  if (sw_norm2(sw_sub(b, a)) == 0) return 0;
  return shape->class->segment(shape, a, b, reach, out);
}

int sw_shape_sweep(const sw_shape *shape, sw_vec a0, sw_vec b0, sw_vec a1, sw_vec b1, double margin,
                   sw_closest *out, double *when) {
  const double relative = 1e-10; /* tolerance in parts of the largest coordinate [-] */
  const double size = fmax(fmax(size_of(a0), size_of(b0)), fmax(size_of(a1), size_of(b1)));
  const double all = size_of(a0) + size_of(b0) + size_of(a1) + size_of(b1);
  if (!(all < SW_SHAPE_FAR) || !(margin >= 0 && margin < SW_SHAPE_FAR)) return 0;
  if (sw_norm2(sw_sub(a1, a0)) == 0 && sw_norm2(sw_sub(b1, b0)) == 0) return 0;
  const sw_sweep path = {a0, b0, a1, b1, margin, relative * (size + margin)};
  const sw_bounds one = sw_bounds_of(a0, b0, margin), two = sw_bounds_of(a1, b1, margin);
  const sw_bounds low = sw_bounds_of(one.min, two.min, 0), high = sw_bounds_of(one.max, two.max, 0);
  const sw_bounds swept = {low.min, high.max};
  if (!sw_bounds_meet(&swept, &shape->bounds)) return 0;
  if (shape->class->sweep) return shape->class->sweep(shape, &path, out, when);
  return sw_convex_sweep(shape, &path, out, when);
}
