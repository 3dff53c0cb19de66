/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arc lengths of the nodes of a wire that becomes a line: even, with nodes at its holds and joins.
 * A node moved there afterwards, on edges that cut the corner at a hold, would be held beside the
 * wire's place. */
#include <string.h>

#include "base/alloc.h"
#include "body/body.h"
#include "body/join.h"
#include "edit/edit.h"
#include "link/hold.h"
#include "remodel/line.h"
#include "scene/parts.h"
#include "state/mesh.h"

/* Makes a node of exactly this arc length, and keeps it from now on. */
static sw_status place(sw_mesh *m, double s, double *keep, size_t *count) {
  double placed;
  SW_TRY(sw_mesh_place(m, s, keep, *count, &placed));
  m->s[sw_mesh_node(m, placed)] = s;
  keep[(*count)++] = s;
  return SW_OK;
}

/* Places joins, and the ends of all living holds of the wire, as they will take hold of the line.
 */
static sw_status place_links(const sw_scene *s, size_t wire, sw_mesh *m) {
  const size_t joins = sw_scene_join_places(s, wire, NULL);
  size_t count = 0;
  double *keep SW_LOCAL = sw_alloc(2 * (sw_scene_living_holds(s) + joins) + 1, sizeof *keep);
  if (!keep) return SW_ENOMEM;
  const double *joined = keep + 2 * sw_scene_living_holds(s) + joins;
  sw_scene_join_places(s, wire, keep + 2 * sw_scene_living_holds(s) + joins);
  for (size_t k = 0; k < joins; k++) SW_TRY(place(m, joined[k], keep, &count));
  SW_EACH(hold, h, s) {
    if (!h->alive || h->wire != wire) continue;
    double ends[2];
    const sw_hold_args a = sw_scene_rehold_args(h);
    sw_body_interval(m, &a, &ends[0], &ends[1]);
    for (size_t k = 0; k < 2; k++) SW_TRY(place(m, ends[k], keep, &count));
  }
  return SW_OK;
}

sw_status sw_line_places(const sw_scene *s, size_t wire, double length, size_t segments,
                         double **out, size_t *count) {
  const double ends[6] = {0, 0, 0, length, 0, 0};
  sw_mesh m = {0};
  *out = NULL, *count = 0;
  SW_TRY(sw_mesh_along(&m, ends, 2, segments));
  m.EA = 1; /* unstressed edges along the x axis: their arc lengths only */
  sw_status status = place_links(s, wire, &m);
  if (status == SW_OK && !(*out = sw_alloc(m.n, sizeof **out))) status = SW_ENOMEM;
  if (status == SW_OK) {
    memcpy(*out, m.s, m.n * sizeof **out);
    *count = m.n;
  }
  sw_mesh_free(&m);
  return status;
}
