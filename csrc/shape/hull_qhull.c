/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Convex hull by qhull (Barber, Dobkin and Huhdanpaa, ACM TOMS 22, 1996). */
#include "shape/hull_qhull.h"

#include <libqhull_r/libqhull_r.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"

enum { MESSAGE_SIZE = 4096 }; /* size of qhull's text; its first line is used [B] */

static sw_vec centre_of(const double *points, size_t n) {
  sw_vec sum = {0, 0, 0};
  for (size_t i = 0; i < n; i++) sum = sw_madd(sum, sw_load(points + 3 * i), 1.0 / (double)n);
  return sum;
}

/* Centres the points and scales their largest coordinate to 1, so that qhull's tolerances and ours
 * do not depend on units. Returns the largest coordinate before [m]. */
static double to_unit(const double *points, size_t n, double *unit) {
  const sw_vec centre = centre_of(points, n);
  double largest = 0;
  for (size_t i = 0; i < n; i++) {
    const sw_vec p = sw_sub(sw_load(points + 3 * i), centre);
    largest = fmax(largest, fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))));
  }
  for (size_t i = 0; i < n && largest > 0; i++)
    sw_store(unit + 3 * i, sw_scale(sw_sub(sw_load(points + 3 * i), centre), 1 / largest));
  return largest;
}

/* Finds the point numbers of a triangular facet, anticlockwise seen from outside. 0: not a
 * triangle. */
static int facet_corners(qhT *qh, facetT *facet, const double *unit, int corner[3]) {
  vertexT *vertex, **vertexp;
  int k = 0;
  FOREACHvertex_(facet->vertices) {
    if (k == 3) return 0;
    corner[k++] = qh_pointid(qh, vertex->point);
  }
  if (k != 3) return 0;
  const sw_vec a = sw_load(unit + 3 * (size_t)corner[0]);
  const sw_vec b = sw_load(unit + 3 * (size_t)corner[1]);
  const sw_vec c = sw_load(unit + 3 * (size_t)corner[2]);
  const sw_vec n = sw_cross(sw_sub(b, a), sw_sub(c, a));
  if (sw_dot(n, sw_load(facet->normal)) < 0) {
    const int kept = corner[1];
    corner[1] = corner[2], corner[2] = kept;
  }
  return 1;
}

static sw_status collect(qhT *qh, const double *unit, int **indices, size_t *triangle_count) {
  facetT *facet;
  size_t count = 0, room = 0;
  FORALLfacets room++;
  *indices = sw_alloc(3 * room, sizeof **indices);
  if (!*indices) return SW_ENOMEM;
  FORALLfacets {
    int corner[3];
    if (!facet_corners(qh, facet, unit, corner)) continue;
    memcpy(*indices + 3 * count, corner, sizeof corner);
    count++;
  }
  *triangle_count = count;
  return SW_OK;
}

static sw_status flat(const char *object, sw_error *err) {
  return sw_fail(err, SW_EINVAL,
                 "%s: the points lie in one plane or on one line; a hull needs four that do not",
                 object);
}

static sw_status refused(const char *object, int code, char *message, sw_error *err) {
  if (code == qh_ERRsingular || code == qh_ERRprec) return flat(object, err);
  if (code == qh_ERRmem) return sw_fail(err, SW_ENOMEM, "%s: out of memory", object);
  message[strcspn(message, "\n")] = '\0';
  return sw_fail(err, SW_EINVAL, "%s: no hull could be made (%s)", object, message);
}

/* Receives qhull's output: its messages, and progress reports, at which it can be stopped. */
typedef struct listener {
  qhT *qh;
  char message[MESSAGE_SIZE];
  size_t length;
  int stopped; /* 1: the user wants to stop */
} listener;

static const char PROGRESS[] = "\nAt "; /* start of a progress report */

static ssize_t listen(void *cookie, const char *text, size_t size) {
  listener *l = cookie;
  if (size >= sizeof PROGRESS - 1 && memcmp(text, PROGRESS, sizeof PROGRESS - 1) == 0) {
    if (!sw_interrupted()) return (ssize_t)size;
    l->stopped = 1;
    l->qh->STOPadd = 1; /* add no further point */
    return (ssize_t)size;
  }
  const size_t room = sizeof l->message - 1 - l->length, part = size < room ? size : room;
  memcpy(l->message + l->length, text, part);
  l->length += part;
  return (ssize_t)size;
}

static sw_status run(const char *object, double *unit, size_t n, int **indices,
                     size_t *triangle_count, sw_error *err) {
  char command[] = "qhull Qt TF500"; /* TF500: report progress every 500 facets */
  qhT state, *qh = &state;
  listener l = {.qh = qh};
  int left = 0, total = 0;
  FILE *text = fopencookie(&l, "w", (cookie_io_functions_t){.write = listen});
  if (!text) return sw_fail(err, SW_ENOMEM, "%s: out of memory", object);
  setvbuf(text, NULL, _IONBF, 0);
  qh_zero(qh, text);
  const int code = qh_new_qhull(qh, 3, (int)n, unit, 0, command, NULL, text);
  sw_status status = SW_EINTR;
  if (!l.stopped)
    status =
        code ? refused(object, code, l.message, err) : collect(qh, unit, indices, triangle_count);
  qh_freeqhull(qh, !qh_ALL);
  qh_memfreeshort(qh, &left, &total);
  fclose(text);
  if (status == SW_ENOMEM) sw_fail(err, status, "%s: out of memory", object);
  return status;
}

sw_status sw_hull_triangles(const char *object, const double *points, size_t n, int **indices,
                            size_t *triangle_count, sw_error *err) {
  *indices = NULL;
  *triangle_count = 0;
  double *unit SW_LOCAL = sw_alloc(3 * n, sizeof *unit);
  if (!unit) return sw_fail(err, SW_ENOMEM, "%s: out of memory", object);
  const double largest = to_unit(points, n, unit);
  return largest > 0 ? run(object, unit, n, indices, triangle_count, err) : flat(object, err);
}
