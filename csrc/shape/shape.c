/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions shared by all shapes: making, reference counting, dispatch of queries. */
#include "shape/shape.h"

#include <stdint.h>
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
const char *sw_shape_class_summary(const sw_shape_class *class) { return class->summary; }
const char *sw_shape_class_sample(const sw_shape_class *class) { return class->sample; }
const sw_shape_wrong *sw_shape_class_wrong(const sw_shape_class *class) { return class->wrong; }
unsigned sw_shape_class_traits(const sw_shape_class *class) { return class->traits; }
int sw_shape_class_convex(const sw_shape_class *class) {
  return class->support != NULL || (class->traits & SW_SHAPE_FLAT);
}

static sw_status copy(const void *from, size_t bytes, const void **to) {
  if (!from) return SW_OK;
  void *own = sw_alloc(bytes, 1);
  if (!own) return SW_ENOMEM;
  if (bytes) memcpy(own, from, bytes);
  *to = own;
  return SW_OK;
}

static sw_status remember(sw_shape *shape, const sw_shape_args *args, const sw_shape_source *from) {
  const void *points = NULL, *bytes = NULL;
  sw_status status = copy(from->points, 3 * from->point_count * sizeof(double), &points);
  if (status == SW_OK) status = copy(from->bytes, from->byte_count, &bytes);
  shape->args = *args;
  shape->source = (sw_shape_source){points, from->point_count, bytes, from->byte_count};
  return status;
}

sw_status sw_shape_new(const sw_shape_class *class, const sw_shape_args *args,
                       const sw_shape_source *source, sw_shape **out, sw_error *err) {
  static const sw_shape_source nothing;
  *out = NULL;
  sw_shape *shape = sw_alloc(1, class->size);
  if (!shape) return sw_fail(err, SW_ENOMEM, "%s: out of memory", class->params.object);
  shape->class = class;
  shape->references = 1;
  if (!source) source = &nothing;
  sw_status status = class->create(shape, args, source, err);
  if (status == SW_OK && remember(shape, args, source) != SW_OK)
    status = sw_fail(err, SW_ENOMEM, "%s: out of memory", class->params.object);
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
  SW_FREE_ALL((void *)(uintptr_t)shape->source.points, (void *)(uintptr_t)shape->source.bytes,
              shape);
}

sw_bounds sw_shape_bounds(const sw_shape *shape) { return shape->bounds; }
const char *sw_shape_kind(const sw_shape *shape) { return shape->class->kind; }

int sw_shape_is(const sw_shape *shape, unsigned trait) {
  return (shape->class->traits & trait) != 0;
}

sw_status sw_shape_triangles(const sw_shape *shape, int around, sw_triangles *out) {
  *out = (sw_triangles){0};
  return shape->class->triangles ? shape->class->triangles(shape, around, out) : SW_OK;
}

void sw_shape_bones(const sw_shape *shape, sw_bone_visit visit, void *user) {
  if (shape->class->bones) shape->class->bones(shape, visit, user);
}

int sw_shape_has_edges(const sw_shape *shape) {
  const sw_shape_class *k = shape->class;
  return k->sharp && !(k->faceted && k->faceted(shape));
}

double sw_shape_facet(const sw_shape *shape, double *radius) {
  *radius = 0;
  return shape->class->facet ? shape->class->facet(shape, radius) : 0.0;
}

int sw_shape_is_open(const sw_shape *shape) {
  return shape->class->open && shape->class->open(shape);
}

double sw_shape_roundness(const sw_shape *shape) {
  return shape->class->roundness ? shape->class->roundness(shape) : 0.0;
}

double sw_shape_middle(const sw_shape *shape, sw_vec p, sw_vec *q, sw_vec *along) {
  return shape->class->middle ? shape->class->middle(shape, p, q, along) : 0.0;
}

int sw_shape_over_face(const sw_shape *shape, const sw_vec *p, size_t count) {
  return shape->class->over_face && shape->class->over_face(shape, p, count);
}

sw_sharp sw_shape_sharp(const sw_shape *shape, int feature, sw_vec *along) {
  return shape->class->sharp ? shape->class->sharp(shape, feature, along) : SW_SHARP_NOT;
}

void sw_shape_ridges(const sw_shape *shape, sw_vec a, sw_vec b, double reach, sw_ridge_visit visit,
                     void *user) {
  if (shape->class->ridges) shape->class->ridges(shape, a, b, reach, visit, user);
}

int sw_shape_points_out(const sw_shape *shape, const sw_ridge *ridge, sw_vec n, double share) {
  return shape->class->points_out && shape->class->points_out(shape, ridge, n, share);
}

/* --- files ------------------------------------------------------------------ */

/* Puts a source on a tape. A count of 0 means that the shape has no such input. */
static void tape_source(sw_tape *t, sw_shape_source *source) {
  void *points = (void *)(uintptr_t)source->points, *bytes = (void *)(uintptr_t)source->bytes;
  sw_tape_count(t, &source->point_count, 3 * sizeof(double));
  sw_tape_count(t, &source->byte_count, 1);
  sw_tape_optional(t, &points, source->point_count, 3 * sizeof(double));
  sw_tape_optional(t, &bytes, source->byte_count, 1);
  source->points = points, source->bytes = bytes;
}

static void retain(void *shape) { sw_shape_retain(shape); }
static void release(void *shape) { sw_shape_release(shape); }

void sw_tape_shape(sw_tape *t, sw_shape **shape) {
  static const sw_sharing sharing = {retain, release};
  char word[SW_NAME_SIZE];
  sw_shape_args args = {0};
  sw_shape_source source = {0};
  if (sw_tape_share(t, shape, &sharing)) return;
  if (!sw_tape_reads(t)) args = (*shape)->args, source = (*shape)->source;
  SW_TAPE_STRUCT(t, sw_shape_args, 64);
  SW_TAPE_STRUCT(t, sw_shape_source, 32);
  const char *kind = sw_tape_word(t, sw_tape_reads(t) ? NULL : (*shape)->class->kind, word);
  sw_tape_raw(t, &args, sizeof args);
  tape_source(t, &source);
  if (!sw_tape_reads(t)) return;
  *shape = NULL;
  const sw_shape_class *class = sw_shape_class_find(kind);
  sw_tape_expect(t, class != NULL, "a shape of an unknown kind");
  if (class && sw_tape_good(t)) t->status = sw_params_check(&class->params, &args, 0, t->err);
  if (class && sw_tape_good(t)) t->status = sw_shape_new(class, &args, &source, shape, t->err);
  sw_free((void *)(uintptr_t)source.points);
  sw_free((void *)(uintptr_t)source.bytes);
}

/* --- queries -------------------------------------------------------------- */

int sw_shape_meets(const sw_shape *shape, sw_vec a, sw_vec b, double reach) {
  const sw_bounds near = sw_bounds_of(a, b, reach);
  return sw_bounds_meet(&near, &shape->bounds);
}

/* Returns the sum of the coordinates' absolute values; NaN stays NaN [m]. */
static inline double size_of(sw_vec p) { return fabs(p.x) + fabs(p.y) + fabs(p.z); }

int sw_shape_point(const sw_shape *shape, sw_vec p, double reach, sw_closest *out) {
  if (!(size_of(p) < SW_SHAPE_FAR)) return 0;
  return shape->class->distance(shape, p, reach, out);
}

int sw_shape_beside(const sw_shape *shape, sw_vec p, double reach, const sw_closest *nearest,
                    sw_closest out[SW_CLOSEST_MAX]) {
  return shape->class->beside ? shape->class->beside(shape, p, reach, nearest, out) : 0;
}

int sw_shape_point_like(const sw_shape *shape, sw_vec p, double reach, sw_vec way,
                        sw_closest *out) {
  sw_closest others[SW_CLOSEST_MAX];
  if (!sw_shape_point(shape, p, reach, out)) return 0;
  const int n = sw_shape_beside(shape, p, reach, out, others);
  for (int i = 0; i < n; i++)
    if (sw_dot(others[i].normal, way) > sw_dot(out->normal, way)) *out = others[i];
  return 1;
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
  const double relative = 1e-10; /* tolerance over the largest coordinate [-] */
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
  if (sw_shape_class_convex(shape->class)) return sw_convex_sweep(shape, &path, out, when);
  return sw_any_sweep(shape, &path, out, when);
}
