/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds meshes, tubes, balls, lines and a floor to a drawing, as triangles, balls and edges. */
#include "draw/drawing.h"

#include <string.h>

#include "base/alloc.h"

enum { MOST = 10000000, SIDES = 20, CAP_SIDES = SIDES };
static const double SMOOTH = 0.866; /* cosine of 30 degrees: flatter edges are shaded smooth [-] */
static const double FLAT = 0.9999;  /* cosine of the angle below which faces have no edge [-] */
static const double WIDEST = 1.6;   /* widest ring of a tube at a corner, over its radius [-] */
static const float LINE = 1.7f, EDGE = 1.1f; /* widths of lines and of edges [px] */

sw_status sw_drawing_new(sw_drawing **out) {
  *out = sw_alloc(1, sizeof **out);
  return *out ? SW_OK : SW_ENOMEM;
}

void sw_drawing_free(sw_drawing *d) {
  if (!d) return;
  SW_FREE_ALL(d->faces, d->balls, d->lines, d->edges, d->pieces, d->floors, d->is_tube, d);
}

static int all_finite(const double *p, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (!isfinite(p[i]) || fabs(p[i]) > 1e15) return 0;
  return 1;
}

static sw_status begin_object(sw_drawing *d, int is_tube) {
  SW_TRY(SW_GROW(d->is_tube, d->object_room, d->object_count + 1));
  d->is_tube[d->object_count] = (uint8_t)is_tube;
  return SW_OK;
}

static const float *colour_at(const sw_paint *paint, size_t i) {
  return paint->colours ? paint->colours + 3 * i : paint->colour;
}

static sw_corner corner_of(sw_vec p, sw_vec n, const float *colour) {
  sw_corner c;
  sw_vec_to(c.p, p), sw_vec_to(c.n, n);
  memcpy(c.colour, colour, sizeof c.colour);
  return c;
}

static void add_face(sw_drawing *d, sw_corner a, sw_corner b, sw_corner c, float gloss) {
  sw_face *f = &d->faces[d->face_count++];
  f->c[0] = a, f->c[1] = b, f->c[2] = c;
  f->object = (uint32_t)d->object_count, f->gloss = gloss;
}

/* --- meshes ---------------------------------------------------------------------- */

/* A mesh while it is added: positions of points, normals of faces, and the faces around each point.
 */
typedef struct mesh {
  sw_vec *place, *normal;
  uint32_t *first, *around;
  const uint32_t *corners;
  size_t points, count;
} mesh;

static void free_mesh(mesh *m) {
  sw_free(m->place), sw_free(m->normal), sw_free(m->first), sw_free(m->around);
}

static sw_status read_mesh(mesh *m, const double *points, sw_pose pose) {
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(m->place, m->points), SW_ROOM(m->normal, m->count),
                      SW_ROOM(m->first, m->points + 1), SW_ROOM(m->around, 3 * m->count)));
  for (size_t i = 0; i < m->points; i++) m->place[i] = sw_pose_point(pose, sw_vec_at(points, i));
  for (size_t f = 0; f < m->count; f++) {
    const uint32_t *c = m->corners + 3 * f;
    const sw_vec a = m->place[c[0]];
    m->normal[f] =
        sw_unit_or(sw_cross(sw_sub(m->place[c[1]], a), sw_sub(m->place[c[2]], a)), sw_v(0, 0, 0));
    for (size_t k = 0; k < 3; k++) m->first[c[k] + 1]++;
  }
  for (size_t i = 0; i < m->points; i++) m->first[i + 1] += m->first[i];
  for (size_t k = 3 * m->count; k-- > 0;)
    m->around[--m->first[m->corners[k] + 1]] = (uint32_t)(k / 3);
  /* first[i + 1] is the start of point i's faces in around */
  return SW_OK;
}

static size_t faces_of(const mesh *m, uint32_t point, const uint32_t **list) {
  const size_t from = m->first[point + 1];
  const size_t to = point + 1 < m->points ? m->first[point + 2] : 3 * m->count;
  *list = m->around + from;
  return to - from;
}

static sw_vec normal_at(const mesh *m, size_t face, uint32_t point) {
  const uint32_t *list;
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = faces_of(m, point, &list); k-- > 0;)
    if (sw_dot(m->normal[list[k]], m->normal[face]) > SMOOTH) sum = sw_add(sum, m->normal[list[k]]);
  return sw_unit_or(sum, m->normal[face]);
}

/* Returns the other face at the edge a b of a face; the face itself if there is none. */
static size_t beyond(const mesh *m, size_t face, uint32_t a, uint32_t b) {
  const uint32_t *list;
  for (size_t k = faces_of(m, a, &list); k-- > 0;) {
    const uint32_t *c = m->corners + 3 * (size_t)list[k];
    if (list[k] != face && (c[0] == b || c[1] == b || c[2] == b)) return list[k];
  }
  return face;
}

static sw_status add_edges(sw_drawing *d, const mesh *m, const sw_paint *paint) {
  SW_TRY(SW_GROW(d->edges, d->edge_room, d->edge_count + 3 * m->count));
  for (size_t f = 0; f < m->count; f++)
    for (size_t k = 0; k < 3; k++) {
      const uint32_t a = m->corners[3 * f + k], b = m->corners[3 * f + (k + 1) % 3];
      const size_t other = beyond(m, f, a, b);
      const double bend = other == f ? 0 : sw_dot(m->normal[f], m->normal[other]);
      if (other < f || bend > FLAT) continue;
      sw_line *e = &d->edges[d->edge_count++];
      sw_vec_to(e->p[0], m->place[a]), sw_vec_to(e->p[1], m->place[b]);
      for (size_t c = 0; c < 3; c++) e->colour[c] = 0.55f * paint->colour[c];
      e->width = EDGE;
      sw_vec_to(e->n[0], sw_scale(m->normal[f], bend > SMOOTH));
      sw_vec_to(e->n[1], sw_scale(m->normal[other], bend > SMOOTH));
    }
  return SW_OK;
}

static sw_status add_mesh(sw_drawing *d, const mesh *m, const sw_paint *paint) {
  SW_TRY(SW_GROW(d->faces, d->face_room, d->face_count + m->count));
  SW_TRY(add_edges(d, m, paint));
  for (size_t f = 0; f < m->count; f++) {
    const uint32_t *c = m->corners + 3 * f;
    sw_corner at[3];
    for (size_t k = 0; k < 3; k++)
      at[k] = corner_of(m->place[c[k]], normal_at(m, f, c[k]), colour_at(paint, c[k]));
    add_face(d, at[0], at[1], at[2], paint->gloss);
  }
  d->object_count++;
  return SW_OK;
}

sw_status sw_drawing_mesh(sw_drawing *d, const double *points, size_t point_count,
                          const uint32_t *corners, size_t count, sw_pose pose,
                          const sw_paint *paint) {
  mesh m = {.corners = corners, .points = point_count, .count = count};
  const double place[7] = {pose.p.x, pose.p.y, pose.p.z, pose.q.w, pose.q.x, pose.q.y, pose.q.z};
  if (!all_finite(points, 3 * point_count) || !all_finite(place, 7)) return SW_EINVAL;
  if (d->face_count + count > MOST) return SW_EINVAL;
  for (size_t k = 0; k < 3 * count; k++)
    if (corners[k] >= point_count) return SW_EINVAL;
  sw_status status = begin_object(d, 0);
  if (status == SW_OK) status = read_mesh(&m, points, pose);
  if (status == SW_OK) status = add_mesh(d, &m, paint);
  free_mesh(&m);
  return status;
}

/* --- tubes ------------------------------------------------------------------------- */

/* Returns the unit vector nearest to across that is normal to along; so across is carried along the
 * tube without twist. */
static sw_vec carried(sw_vec across, sw_vec along) {
  return sw_unit_or(sw_madd(across, along, -sw_dot(across, along)), sw_perpendicular(along));
}

typedef struct ring {
  sw_corner c[SIDES];
} ring;

static ring ring_at(sw_vec p, sw_vec along, sw_vec *across, double radius, double widen,
                    sw_vec inward, const float *colour) {
  ring r;
  *across = carried(*across, along);
  const sw_vec side = sw_cross(along, *across);
  for (int k = 0; k < SIDES; k++) {
    const double a = 2 * M_PI * k / SIDES;
    const sw_vec n = sw_add(sw_scale(*across, cos(a)), sw_scale(side, sin(a)));
    const double in = sw_dot(n, inward);
    /* the ring is wider only in the plane of the bend, so that the tube keeps its width */
    r.c[k] =
        corner_of(sw_madd(sw_madd(p, n, radius), inward, radius * in * (widen - 1)), n, colour);
  }
  return r;
}

static void add_cap(sw_drawing *d, const ring *r, sw_vec p, sw_vec out, float gloss) {
  const sw_corner middle = corner_of(p, out, r->c[0].colour);
  for (int k = 0; k < SIDES; k++) {
    sw_corner a = r->c[k], b = r->c[(k + 1) % SIDES];
    sw_vec_to(a.n, out), sw_vec_to(b.n, out);
    add_face(d, middle, a, b, gloss);
  }
}

static sw_vec direction(const double *points, size_t from, size_t to, sw_vec fallback) {
  return sw_unit_or(sw_sub(sw_vec_at(points, to), sw_vec_at(points, from)), fallback);
}

static void add_piece(sw_drawing *d, const double *points, size_t i, double radius,
                      const sw_paint *paint) {
  sw_piece *q = &d->pieces[d->piece_count++];
  for (size_t k = 0; k < 2; k++) sw_vec_to(q->p[k], sw_vec_at(points, i + k));
  for (size_t c = 0; c < 3; c++)
    q->colour[c] = 0.5f * (colour_at(paint, i)[c] + colour_at(paint, i + 1)[c]);
  q->radius = (float)radius;
}

static void add_tube(sw_drawing *d, const double *points, size_t count, double radius,
                     const sw_paint *paint) {
  sw_vec before = direction(points, 0, 1, sw_v(1, 0, 0)), across = sw_perpendicular(before);
  ring last;
  for (size_t i = 0; i < count; i++) {
    const sw_vec p = sw_vec_at(points, i);
    const sw_vec after = i + 1 < count ? direction(points, i, i + 1, before) : before;
    const sw_vec along = sw_unit_or(sw_add(before, after), after);
    const double half = fmax(sw_dot(along, after), 1 / WIDEST);
    const sw_vec inward = sw_unit_or(sw_sub(after, before), sw_v(0, 0, 0));
    const ring now = ring_at(p, along, &across, radius, 1 / half, inward, colour_at(paint, i));
    for (int k = 0; i && k < SIDES; k++) {
      const int next = (k + 1) % SIDES;
      add_face(d, last.c[k], last.c[next], now.c[next], paint->gloss);
      add_face(d, last.c[k], now.c[next], now.c[k], paint->gloss);
    }
    if (i) add_piece(d, points, i - 1, radius, paint);
    if (!i) add_cap(d, &now, p, sw_neg(after), paint->gloss);
    if (i + 1 == count) add_cap(d, &now, p, before, paint->gloss);
    last = now, before = after;
  }
}

sw_status sw_drawing_tube(sw_drawing *d, const double *points, size_t count, double radius,
                          const sw_paint *paint) {
  if (count < 2) return SW_OK;
  if (!all_finite(points, 3 * count) || !all_finite(&radius, 1)) return SW_EINVAL;
  if (count > MOST / (2 * SIDES) || d->face_count + 2 * SIDES * count > MOST) return SW_EINVAL;
  SW_TRY(begin_object(d, 1));
  SW_TRY(SW_GROW(d->faces, d->face_room, d->face_count + 2 * SIDES * (count - 1) + 2 * CAP_SIDES));
  SW_TRY(SW_GROW(d->pieces, d->piece_room, d->piece_count + count));
  add_tube(d, points, count, radius, paint);
  d->object_count++;
  return SW_OK;
}

/* --- balls, lines, floors -------------------------------------------------------------- */

sw_status sw_drawing_balls(sw_drawing *d, const double *points, size_t count, double radius,
                           const sw_paint *paint) {
  if (!all_finite(points, 3 * count) || !all_finite(&radius, 1)) return SW_EINVAL;
  if (d->ball_count + count > MOST) return SW_EINVAL;
  SW_TRY(begin_object(d, 0));
  SW_TRY(SW_GROW(d->balls, d->ball_room, d->ball_count + count));
  for (size_t i = 0; i < count; i++) {
    sw_ball *b = &d->balls[d->ball_count++];
    sw_vec_to(b->p, sw_vec_at(points, i));
    memcpy(b->colour, colour_at(paint, i), sizeof b->colour);
    b->radius = (float)radius, b->gloss = paint->gloss;
  }
  d->object_count++;
  return SW_OK;
}

sw_status sw_drawing_lines(sw_drawing *d, const double *points, size_t count,
                           const sw_paint *paint) {
  if (!all_finite(points, 6 * count) || d->line_count + count > MOST) return SW_EINVAL;
  SW_TRY(SW_GROW(d->lines, d->line_room, d->line_count + count));
  for (size_t i = 0; i < count; i++) {
    sw_line *l = &d->lines[d->line_count++];
    for (size_t k = 0; k < 2; k++) sw_vec_to(l->p[k], sw_vec_at(points, 2 * i + k));
    memcpy(l->colour, colour_at(paint, 2 * i), sizeof l->colour);
    l->width = LINE;
  }
  return SW_OK;
}

sw_status sw_drawing_floor(sw_drawing *d, sw_vec point, sw_vec normal, double square, double reach,
                           const sw_paint *paint) {
  const double given[8] = {point.x, point.y, point.z, normal.x, normal.y, normal.z, square, reach};
  if (!all_finite(given, 8) || !(square > 0) || !(reach > 0)) return SW_EINVAL;
  SW_TRY(SW_GROW(d->floors, d->floor_room, d->floor_count + 1));
  sw_floor *f = &d->floors[d->floor_count++];
  f->point = point, f->normal = sw_unit_or(normal, sw_v(0, 0, 1));
  f->across = sw_perpendicular(f->normal), f->square = square, f->reach = reach;
  memcpy(f->colour, paint->colour, sizeof f->colour);
  return SW_OK;
}

int sw_drawing_bounds(const sw_drawing *d, sw_vec *low, sw_vec *high) {
  float lo[3] = {HUGE_VALF, HUGE_VALF, HUGE_VALF}, hi[3] = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
  for (size_t i = 0; i < d->face_count; i++)
    for (size_t k = 0; k < 9; k++) {
      const float x = d->faces[i].c[k / 3].p[k % 3];
      lo[k % 3] = fminf(lo[k % 3], x), hi[k % 3] = fmaxf(hi[k % 3], x);
    }
  for (size_t i = 0; i < d->ball_count; i++)
    for (size_t k = 0; k < 3; k++) {
      const sw_ball *b = &d->balls[i];
      lo[k] = fminf(lo[k], b->p[k] - b->radius), hi[k] = fmaxf(hi[k], b->p[k] + b->radius);
    }
  *low = sw_vec_of(lo), *high = sw_vec_of(hi);
  return lo[0] <= hi[0];
}
