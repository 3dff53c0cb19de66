/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contacts of a segment, between its ends, with the convex edges and corners of a mesh: pairs of
 * nearest places whose direction lies in the cone of normals of the edge or corner, i.e. points
 * away from all faces and edges that meet there. */
#include "shape/trimesh.h"

typedef struct query {
  const sw_trimesh *mesh;
  sw_vec a, b, d; /* [m] */
  double length, reach;
  int have_ends;
  sw_closest end_a, end_b; /* nearest places of the ends; gap HUGE_VAL: none */
  int count;
  sw_closest *out;
  int beside[SW_CLOSEST_MAX]; /* 1: the place is on the edge beside the nearest one */
} query;

/* Largest tilt out of the cone, over the angle between the faces, at which an edge still counts.
 * The two edges of a bridged face thus hand over smoothly [-]. */
static const double hand_over = 0.05;
/* Convex edges with a sine of the angle between their faces from `flat` to `blunt` (25 degrees) are
 * those of a round surface's facets [-]. */
static const double flat = 1e-3, blunt = 0.42;
/* A segment on such a surface lies on one facet and rocks on its edges. It also touches further
 * edges if the nearest one is nearer by less than this share of reach. A wire's reach is twice its
 * radius, and a soft touch at rest may be 0.05 of it deep, so this must be above 0.025. Otherwise a
 * taut cable would pass from edge to edge by jumps: where the tilt of hand_over is less than this
 * depth, one edge bears much of the push, and none as soon as the cable tilts a little more, so
 * there is no balance between the two. With 0.01 17 of 18 cables drawn through a groove in poses
 * fail, with 0.03 4 (spec/contact/hollow_mesh_spec), and of 150 over cylinders none does
 * (spec/contact/faceted_capstan_spec) [-]. */
static const double as_near = 0.03;
static const double most_nearer = 1e-4; /* upper limit of it, for queries with any reach [m] */
/* The same tilt for corners, as a cosine [-]. */
static const double corner_slack = 1e-6;
/* Cosine above which an end's nearest place is on the flank of a place between the ends [-]. */
static const double same_flank = 0.995;
/* Places nearer to the segment's ends are left to the ends' own queries [-]. */
static const double inside = 1e-9;

/* --- triangles near a segment -------------------------------------------------- */

static int passes(const sw_bounds *box, sw_vec a, sw_vec d, double reach) {
  double from = 0, to = 1;
  sw_clip(a.x, d.x, box->min.x - reach, box->max.x + reach, &from, &to);
  sw_clip(a.y, d.y, box->min.y - reach, box->max.y + reach, &from, &to);
  sw_clip(a.z, d.z, box->min.z - reach, box->max.z + reach, &from, &to);
  return from <= to;
}

void sw_trimesh_near(const sw_trimesh *mesh, sw_vec a, sw_vec b, double reach,
                     sw_trimesh_visit visit, void *context) {
  int stack[SW_TREE_DEPTH], top = 0;
  const sw_vec d = sw_sub(b, a);
  stack[top++] = 0;
  while (top > 0) {
    const int number = stack[--top];
    const sw_tree_node *node = &mesh->nodes[number];
    if (!passes(&node->bounds, a, d, reach)) continue;
    for (int i = 0; i < node->count; i++) visit(context, node->first + i);
    if (node->count > 0) continue;
    stack[top++] = node->first;
    stack[top++] = number + 1;
  }
}

/* --- collecting contacts -------------------------------------------------- */

/* Finds the gaps at the segment's ends, once, when first needed. */
static void look_at_ends(query *q) {
  if (q->have_ends) return;
  q->have_ends = 1;
  if (!sw_trimesh_distance(q->mesh, q->a, HUGE_VAL, &q->end_a)) q->end_a.gap = HUGE_VAL;
  if (!sw_trimesh_distance(q->mesh, q->b, HUGE_VAL, &q->end_b)) q->end_b.gap = HUGE_VAL;
}

/* 1 if the segment's ends are as near to the face that the place is on. In a groove the nearest
 * place of an end may be on the other flank, and says nothing about this one. */
static int no_better_than_ends(const query *q, const sw_closest *c) {
  if (sw_dot(q->end_a.normal, c->normal) < same_flank) return 0;
  if (sw_dot(q->end_b.normal, c->normal) < same_flank) return 0;
  return sw_no_better(c->gap, q->end_a.gap, q->end_b.gap, c->at, q->length);
}

static int known(const query *q, const sw_closest *c) {
  const double same_place = 1e-6, same_way = 1e-6; /* over the length; in the cosine [-] */
  for (int i = 0; i < q->count; i++)
    if (fabs(q->out[i].at - c->at) < same_place &&
        sw_dot(q->out[i].normal, c->normal) > 1 - same_way)
      return 1;
  return 0;
}

/* Makes room for a place in the full list; places on edges beside the nearest one go first. 0: the
 * new one is not kept. */
static int make_room(query *q, const sw_closest *c, int beside) {
  int i = q->count - 1;
  while (i >= 0 && !q->beside[i]) i--;
  if (i < 0 && !beside) i = q->count - 1;
  if (i < 0 || ((beside || !q->beside[i]) && q->out[i].gap <= c->gap)) return 0;
  for (q->count--; i < q->count; i++) q->out[i] = q->out[i + 1], q->beside[i] = q->beside[i + 1];
  return 1;
}

/* Keeps the SW_CLOSEST_MAX nearest, in order. */
static void insert(query *q, const sw_closest *c, int beside) {
  if (q->count == SW_CLOSEST_MAX && !make_room(q, c, beside)) return;
  int place = q->count++;
  for (; place > 0 && q->out[place - 1].gap > c->gap; place--)
    q->out[place] = q->out[place - 1], q->beside[place] = q->beside[place - 1];
  q->out[place] = *c, q->beside[place] = beside;
}

static void offer(query *q, const sw_closest *c, int beside) {
  if (!(fabs(c->gap) < q->reach)) return;
  look_at_ends(q);
  if (no_better_than_ends(q, c) || known(q, c)) return;
  insert(q, c, beside);
}

/* Returns where the line x + t d is 0, limited to the segment; `otherwise` if d is 0. */
static double zero_of(double x, double d, double otherwise) {
  return d != 0 ? sw_limit(-x / d, 0, 1) : otherwise;
}

/* 1 if this edge cuts the segment, 0 if the solid lies between them. Where the segment is half way
 * between the planes of the edge's two faces, these planes must be about the nearest surface. A
 * border cuts if the segment pierces its face. w leads from the edge to the segment's first end. */
static int cut(const query *q, const sw_trimesh_edge *edge, sw_vec w, double at) {
  const double nearest = 0.5;   /* allows a third face near the edge's ends [-] */
  const double touching = 1e-9; /* share of the size [-] */
  const sw_vec one = sw_load(q->mesh->normals + 3 * (size_t)edge->tri[0]);
  sw_closest there;
  if (edge->tri[1] < 0) {
    const double place = zero_of(sw_dot(one, w), sw_dot(one, q->d), at);
    const double near = touching * q->mesh->size;
    return sw_trimesh_distance(q->mesh, sw_lerp(q->a, q->b, place), HUGE_VAL, &there) &&
           fabs(there.gap) <= near;
  }
  const sw_vec two = sw_load(q->mesh->normals + 3 * (size_t)edge->tri[1]);
  const sw_vec split = sw_sub(one, two);
  const double place = zero_of(sw_dot(split, w), sw_dot(split, q->d), at);
  const double height = sw_dot(one, sw_madd(w, q->d, place));
  if (!sw_trimesh_distance(q->mesh, sw_lerp(q->a, q->b, place), HUGE_VAL, &there)) return 0;
  return there.gap < 0 && height < 0 && there.gap <= nearest * height;
}

/* Height of one of the edge's triangles over the edge [m]. */
static double height_over(const sw_trimesh *mesh, const sw_trimesh_edge *edge, int side) {
  const sw_triangle t = sw_trimesh_triangle(mesh, edge->tri[side]);
  const sw_vec from = sw_trimesh_vertex(mesh, edge->v[0]);
  double height = 0;
  for (int i = 0; i < 3; i++) height = fmax(height, sw_dot(edge->into[side], sw_sub(t.v[i], from)));
  return height;
}

static int in_edge_cone(const sw_trimesh_edge *edge, sw_vec n) {
  const double slack = hand_over * edge->sine;
  if (sw_dot(n, edge->into[0]) > slack) return 0;
  return edge->tri[1] < 0 || sw_dot(n, edge->into[1]) <= slack;
}

static double nearer_by(const query *q) { return fmin(as_near * q->reach, most_nearer); }

/* 1 if the edge is one of a round surface's facets, and the next edge that n leans to is nearer to
 * the segment by little enough. */
static int beside_cone(const query *q, const sw_trimesh_edge *edge, sw_vec n) {
  if (edge->tri[1] < 0 || !(edge->sine > flat) || !(edge->sine < blunt)) return 0;
  if (!(sw_dot(n, edge->normal) > 0)) return 0;
  for (int side = 0; side < 2; side++) {
    const double lean = sw_dot(n, edge->into[side]);
    if (lean > hand_over * edge->sine && lean * height_over(q->mesh, edge, side) > nearer_by(q))
      return 0;
  }
  return 1;
}

static void try_edge(query *q, int number) {
  const double parallel = 1e-6; /* sine of the angle taken as 0 [-] */
  const double ends = 1e-9;     /* slack at the ends, over the edge's length [-] */
  const sw_trimesh_edge *edge = &q->mesh->edges[number];
  const sw_vec p = sw_trimesh_vertex(q->mesh, edge->v[0]);
  const sw_vec v = sw_sub(sw_trimesh_vertex(q->mesh, edge->v[1]), p);
  const sw_vec across = sw_cross(q->d, v), w = sw_sub(q->a, p);
  const double size2 = sw_norm2(across), vv = sw_norm2(v), dv = sw_dot(q->d, v);
  if (!(size2 > parallel * parallel * q->length * q->length * vv)) return;
  const double dd = q->length * q->length, dw = sw_dot(q->d, w), vw = sw_dot(v, w);
  const double at = (dv * vw - vv * dw) / size2, t = (dd * vw - dv * dw) / size2;
  if (!(at > inside && at < 1 - inside)) return;
  sw_vec n = sw_scale(across, 1 / sqrt(size2));
  double gap = sw_dot(n, w);
  if (edge->tri[1] < 0 ? gap < 0 : sw_dot(n, edge->normal) < 0) n = sw_neg(n), gap = -gap;
  int beside = 0;
  if (!in_edge_cone(edge, n)) {
    const sw_vec back = sw_neg(n);
    if (in_edge_cone(edge, back))
      n = back, gap = -gap;
    else if (!(beside = gap >= 0 && beside_cone(q, edge, n)))
      return;
  }
  /* A cutting edge is the way out even if the place is beyond its end by about the depth. */
  const double past = ends + (gap < 0 ? -2 * gap / sqrt(vv) : 0);
  if (!(t >= -past && t <= 1 + past)) return;
  const sw_closest c = {gap, at, n, sw_madd(p, v, t), sw_trimesh_edge_feature(q->mesh, number)};
  if (gap >= 0 || (gap > -q->reach && cut(q, edge, w, at))) offer(q, &c, beside);
}

/* 1 if n leans out of a corner's cone by so little that no neighbour is nearer by more than this.
 * slack: share of the distance to the neighbour [-]; nearer [m]; facets: 1 if all edges there must
 * be those of a round surface's facets. */
static int in_corner_cone(const sw_trimesh *mesh, int v, sw_vec n, double slack, double nearer,
                          int facets) {
  const sw_trimesh_corner *corner = &mesh->corners[v];
  const sw_vec p = sw_trimesh_vertex(mesh, v);
  for (int i = 0; i < corner->count; i++) {
    const sw_trimesh_edge *edge = &mesh->edges[mesh->corner_edges[corner->first + i]];
    const int other = edge->v[0] == v ? edge->v[1] : edge->v[0];
    const sw_vec along = sw_sub(sw_trimesh_vertex(mesh, other), p);
    if (facets && (edge->tri[1] < 0 || !(edge->sine < blunt))) return 0;
    if (sw_dot(n, along) > slack * sw_norm(along) + nearer) return 0;
  }
  return 1;
}

static void try_corner(query *q, int v) {
  const double touching = 1e-11; /* share of the size below which w has no direction [-] */
  const sw_vec p = sw_trimesh_vertex(q->mesh, v);
  const double at = sw_dot(q->d, sw_sub(p, q->a)) / (q->length * q->length);
  if (!(at > inside && at < 1 - inside)) return;
  const sw_vec w = sw_sub(sw_madd(q->a, q->d, at), p);
  const double gap = sw_norm(w);
  if (!(gap < q->reach)) return;
  const sw_vec along = sw_scale(q->d, 1 / q->length), up = q->mesh->corners[v].normal;
  sw_vec n = sw_unit_or(sw_madd(up, along, -sw_dot(up, along)), sw_perpendicular(along));
  if (gap > touching * q->mesh->size) n = sw_scale(w, 1 / gap);
  const int beside = !in_corner_cone(q->mesh, v, n, corner_slack, 0, 0);
  if (beside && !in_corner_cone(q->mesh, v, n, 0, nearer_by(q), 1)) return; /* only edges cut in */
  const sw_closest c = {gap, at, n, p, sw_trimesh_corner_feature(q->mesh, v)};
  offer(q, &c, beside);
}

/* Tries the edges and corners that this triangle owns. */
static void try_triangle(void *context, int tri) {
  query *q = context;
  const sw_trimesh *mesh = q->mesh;
  for (size_t i = 3 * (size_t)tri; i < 3 * (size_t)tri + 3; i++) {
    const int edge = mesh->sides[i], v = mesh->indices[i];
    if (mesh->edges[edge].tri[0] == tri && (mesh->edges[edge].flags & SW_CONVEX)) try_edge(q, edge);
    if (mesh->corners[v].owner == tri && (mesh->corners[v].flags & SW_CONVEX)) try_corner(q, v);
  }
}

/* Drops places on edges beside the nearest one that are not about as near. */
static void drop_farther(query *q) {
  int kept = 0;
  for (int i = 0; i < q->count; i++)
    if (!q->beside[i] || q->out[i].gap < q->out[0].gap + nearer_by(q)) q->out[kept++] = q->out[i];
  q->count = kept;
}

int sw_trimesh_segment(const sw_trimesh *mesh, sw_vec a, sw_vec b, double reach, sw_closest *out) {
  const sw_vec d = sw_sub(b, a);
  const double length = sw_norm(d);
  if (!(reach > 0) || !(length > 0)) return 0;
  query q = {.mesh = mesh, .a = a, .b = b, .d = d, .length = length, .reach = reach, .out = out};
  sw_trimesh_near(mesh, a, b, reach, try_triangle, &q);
  drop_farther(&q);
  return q.count;
}
