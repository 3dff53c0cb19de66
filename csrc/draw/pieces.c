/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cuts a line where it passes behind surfaces. */
#include "draw/pieces.h"

#include "base/alloc.h"
#include "base/each.h"

enum { MOST_STEPS = 20000 };
static const double STEP = 2.0; /* length of the tested parts of a line [samples] */
/* Distance of a line over a face's up to which the line is visible [-] */
static const double LENIENT = 1.0015;

/* The smallest near (farthest face) of a sample and its neighbours, as lines lie on faces' rims. */
static double near_around(const sw_layer *l, double x, double y) {
  double least = HUGE_VAL;
  for (int k = -1; k <= 1; k++)
    for (int j = -1; j <= 1; j++) {
      const double a = floor(x) + j, b = floor(y) + k;
      if (!(a >= 0 && b >= 0 && a < (double)l->width && b < (double)l->height)) continue;
      least = fmin(least, (double)l->near[l->width * (size_t)b + (size_t)a]);
    }
  return isfinite(least) ? least : 0;
}

static int below_floor(const sw_pieces *p, double x, double y, double near) {
  const sw_vec at = sw_madd(p->view->camera.at, sw_view_ray(p->view, x, y), 1 / (near * LENIENT));
  SW_ITEMS(const sw_floor, f, p->d->floors, p->d->floor_count) {
    if (sw_dot(f->normal, sw_sub(p->view->camera.at, f->point)) > 0 &&
        sw_dot(f->normal, sw_sub(at, f->point)) < 0)
      return 1;
  }
  return 0;
}

int sw_in_front(const sw_pieces *p, double x, double y, double near) {
  return near * LENIENT >= near_around(p->layer, x, y) && !below_floor(p, x, y, near);
}

static sw_status add(sw_pieces *p, const double from[3], const double to[3], int hidden) {
  SW_TRY(SW_GROW(p->list, p->room, p->count + 1));
  sw_stretch *last = p->count ? &p->list[p->count - 1] : NULL;
  if (last && last->hidden == hidden && last->to[0] == from[0] && last->to[1] == from[1]) {
    last->to[0] = to[0], last->to[1] = to[1];
    return SW_OK;
  }
  /* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): sw_grow has made the list */
  p->list[p->count++] = (sw_stretch){{from[0], from[1]}, {to[0], to[1]}, hidden};
  return SW_OK;
}

/* Finds the stretch of the line a b inside the view, as shares of the line; 0: none. */
static int within(const sw_view *v, const double a[3], const double b[3], double *from,
                  double *to) {
  const double size[2] = {v->width, v->height};
  *from = 0, *to = 1;
  for (int k = 0; k < 2; k++) {
    const double d = b[k] - a[k], low = -20 - a[k], high = size[k] + 20 - a[k];
    if (d == 0 && (low > 0 || high < 0)) return 0;
    if (d == 0) continue;
    *from = fmax(*from, fmin(low / d, high / d)), *to = fmin(*to, fmax(low / d, high / d));
  }
  return *from < *to;
}

sw_status sw_line_stretches(sw_pieces *p, const float from[3], const float to[3], double lift) {
  sw_vec a = sw_vec_of(from), b = sw_vec_of(to);
  double pa[3], pb[3], first, last;
  const double za = sw_dot(sw_sub(a, p->view->camera.at), p->view->camera.forward) - p->view->near;
  const double zb = sw_dot(sw_sub(b, p->view->camera.at), p->view->camera.forward) - p->view->near;
  p->count = 0;
  if (za <= 0 && zb <= 0) return SW_OK;
  if (za <= 0) a = sw_lerp(a, b, -1.0001 * za / (zb - za) + 1e-9);
  if (zb <= 0) b = sw_lerp(b, a, -1.0001 * zb / (za - zb) + 1e-9);
  if (!sw_view_project(p->view, a, pa) || !sw_view_project(p->view, b, pb)) return SW_OK;
  if (!within(p->view, pa, pb, &first, &last)) return SW_OK;
  const double length = (last - first) * hypot(pb[0] - pa[0], pb[1] - pa[1]);
  const size_t steps = 1 + (size_t)fmin(MOST_STEPS, length / STEP);
  double before[3] = {0, 0, 0};
  for (size_t k = 0; k <= steps; k++) {
    const double t = first + (last - first) * (double)k / (double)steps;
    const double mid = t - 0.5 * (last - first) / (double)steps;
    double at[3];
    for (int c = 0; c < 3; c++) at[c] = pa[c] + t * (pb[c] - pa[c]);
    const double x = pa[0] + mid * (pb[0] - pa[0]), y = pa[1] + mid * (pb[1] - pa[1]);
    const double near = 1 / (1 / (pa[2] + mid * (pb[2] - pa[2])) - lift);
    if (k) SW_TRY(add(p, before, at, !sw_in_front(p, x, y, near)));
    for (int c = 0; c < 3; c++) before[c] = at[c];
  }
  return SW_OK;
}
