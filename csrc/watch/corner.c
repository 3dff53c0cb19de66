/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reports a rod whose smallest bend radius of the run is that of a corner of the path it was drawn
 * along. The path goes straight from point to point. Where it turns by a at a point, edges h that
 * are shorter than the way p between points have the radius h/a there: the shorter the edges, the
 * smaller. A smooth curve through the points has p/a. */
#include <math.h>

#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "watch/observe.h"

/* Edges longer than this share of the way between points have a radius near that of a smooth curve
 * [-]. */
static const double RESOLVED = 0.8;

/* A bend is that of a corner if the curvature changes by this share of itself from node to node, up
 * to this many edges from it: a straight wire that was drawn with a corner springs open, and the
 * bend spreads within a step. Smooth bends beside corners had 0.1 at most, corners 0.47 to 2 [-].
 */
static const double ALONE = 0.4, SPREAD = 4.0;
/* A bend of more than this times the corner's comes from something else [-]. */
static const double MOST = 2.0;

/* A corner of the path: how far along it is, its turn, the mean way to the points beside it [m],
 * [rad], [m]. */
typedef struct corner {
  double s, turn, apart;
} corner;

static double turn_between(sw_vec a, sw_vec b) {
  return atan2(sw_norm(sw_cross(a, b)), sw_dot(a, b));
}

static double length_of(const sw_drawing *d) {
  double length = 0;
  for (size_t i = 1; i < d->count; i++)
    length += sw_dist(sw_vec_at(d->points, i - 1), sw_vec_at(d->points, i));
  return length;
}

/* Finds the sharpest corner within `reach` of s, both along the path; turn 0: none [m]. */
static corner corner_near(const sw_drawing *d, double s, double reach) {
  corner sharpest = {0};
  double along = 0;
  for (size_t i = 1; i + 1 < d->count; i++) {
    const sw_vec before = sw_sub(sw_vec_at(d->points, i), sw_vec_at(d->points, i - 1));
    const sw_vec after = sw_sub(sw_vec_at(d->points, i + 1), sw_vec_at(d->points, i));
    const double turn = turn_between(before, after);
    along += sw_norm(before);
    if (fabs(along - s) <= reach && turn > sharpest.turn)
      sharpest = (corner){along, turn, 0.5 * (sw_norm(before) + sw_norm(after))};
  }
  return sharpest;
}

/* Returns the length of the shorter edge beside the node at s, without load. Beside a hold, whose
 * nodes are moved to its ends, it may be far shorter than others [m]. */
static double edge_at(const sw_mesh *m, double s) {
  size_t i = 0;
  while (i + 1 < m->n && fabs(m->s[i + 1] - s) <= fabs(m->s[i] - s)) i++;
  const double before = i > 0 ? m->s[i] - m->s[i - 1] : HUGE_VAL;
  const double after = i + 1 < m->n ? m->s[i + 1] - m->s[i] : HUGE_VAL;
  return fmin(before, after);
}

/* Path over mesh [-]. */
static double scale_of(const sw_scene_wire *w) {
  return length_of(&w->drawing) / (w->drawing.length * w->mesh.scale);
}

double sw_corner_turn(const sw_scene_wire *w, double s, double reach) {
  if (w->drawing.count < 3) return 0;
  const double scale = scale_of(w);
  return corner_near(&w->drawing, s * scale, reach * scale).turn;
}

static void tell(sw_scene *s, const sw_scene_wire *w, const sw_extreme *bend, corner c,
                 double edge) {
  const int rest = w->beam.curved;
  sw_scene_tell(s, "corner", w->name, bend->s - w->mesh.s[0], c.apart / c.turn,
                "the sharpest bend of wire '%s', %.3g mm at s = %.4g m, is a corner of %s "
                "(%.3g degrees); shorter edges make it sharper. A smooth curve has %.3g mm. "
                "Give points every %.3g mm%s",
                w->name, 1e3 / bend->value, bend->s - w->mesh.s[0],
                rest ? "its unloaded shape" : "its drawn path", c.turn * 180.0 / M_PI,
                1e3 * c.apart / c.turn, 1e3 * edge, rest ? "" : ", or call scene:settle first");
}

/* The corner decides the bend if this is nearer to that of an edge than to that of a smooth curve.
 */
static void watch(sw_scene *s, const sw_scene_wire *w) {
  const sw_extreme *bend = &w->extremes.curvature;
  const sw_drawing *d = &w->drawing;
  if (d->count < 3 || w->strand.web || !(w->beam.EI > 0) || !(bend->value > 0)) return;
  if (w->extremes.sharp.uneven < ALONE) return;
  const double scale = scale_of(w);
  const double edge = edge_at(&w->mesh, bend->s);
  const corner c = corner_near(d, bend->s * scale, SPREAD * edge * scale);
  if (!(c.turn > 0) || edge > RESOLVED * c.apart || bend->value * edge > MOST * c.turn) return;
  if (bend->value > c.turn / sqrt(edge * c.apart)) tell(s, w, bend, c, edge);
}

void sw_scene_end_corners(sw_scene *s) {
  for (size_t k = 0; k < sw_scene_wire_slots(s); k++) {
    const sw_scene_wire *w = sw_scene_wire_in(s, k);
    if (!sw_scene_is_loose(w)) watch(s, w);
  }
}
