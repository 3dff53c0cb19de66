/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The unloaded shape of fed wire, also behind the guide. */
#include "link/spool.h"

#include <math.h>

#include "state/hinge.h"

sw_quat sw_spool_turn(sw_vec t, sw_vec m1) {
  const sw_vec m2 = sw_cross(t, m1); /* the quaternion of the matrix (t m1 m2) */
  const double trace = t.x + m1.y + m2.z;
  if (trace > 0) return sw_quat_unit((sw_quat){1 + trace, m1.z - m2.y, m2.x - t.z, t.y - m1.x});
  if (t.x >= m1.y && t.x >= m2.z)
    return sw_quat_unit((sw_quat){m1.z - m2.y, 1 + t.x - m1.y - m2.z, m1.x + t.y, m2.x + t.z});
  if (m1.y >= m2.z)
    return sw_quat_unit((sw_quat){m2.x - t.z, m1.x + t.y, 1 + m1.y - t.x - m2.z, m2.y + m1.z});
  return sw_quat_unit((sw_quat){t.y - m1.x, m2.x + t.z, m2.y + m1.z, 1 + m2.z - t.x - m1.y});
}

sw_vec sw_spool_tangent(sw_quat q) { return sw_rotate(q, sw_v(1, 0, 0)); }
sw_vec sw_spool_normal(sw_quat q) { return sw_rotate(q, sw_v(0, 1, 0)); }

static sw_quat rest_turn(const sw_mesh *m, double s) {
  const sw_mesh_frame f = sw_mesh_frame_at(m, s);
  return sw_spool_turn(f.rest_tangent, f.rest_normal);
}

/* Continues a curve from (x, q) over a length u at the constant body rate w per length. */
static sw_rest_place go_on(sw_vec x, sw_quat q, sw_vec w, double u) {
  const double rate = sw_norm(w), angle = rate * u;
  sw_vec way = sw_v(u, 0, 0);
  if (fabs(angle) > 1e-9) {
    const sw_vec a = sw_scale(w, 1 / rate);
    way = sw_scale(a, a.x * (u - sin(angle) / rate));
    way.x += sin(angle) / rate;
    way = sw_madd(way, sw_cross(a, sw_v(1, 0, 0)), (1 - cos(angle)) / rate);
  }
  return (sw_rest_place){sw_add(x, sw_rotate(q, way)),
                         sw_quat_unit(sw_quat_mul(q, sw_quat_exp(sw_scale(w, u))))};
}

sw_rest_place sw_spool_at(const sw_mesh *m, double s) {
  const size_t last = m->n - 1;
  if (s < m->s[0] || s > m->s[last]) {
    const int before = s < m->s[0];
    const size_t end = before ? 0 : last, i = before ? 1 : last - 1;
    const size_t j = last < 4 ? i : before ? 3 : last - 3;
    sw_vec w = sw_v(0, 0, 0);
    if (i != j) {
      const sw_quat a = rest_turn(m, m->s[i]), b = rest_turn(m, m->s[j]);
      w = sw_scale(sw_quat_log(sw_quat_mul(sw_quat_conj(a), b)), 1 / (m->s[j] - m->s[i]));
    }
    return go_on(sw_vec_at(m->rest, end), rest_turn(m, m->s[end]), w, s - m->s[end]);
  }
  const size_t i = sw_mesh_node(m, s), e = i > 0 ? i - 1 : 0;
  const double l = m->s[e + 1] - m->s[e], f = (s - m->s[e]) / l;
  const sw_vec a = sw_vec_at(m->rest, e), b = sw_vec_at(m->rest, e + 1);
  const double chord = sw_dist(a, b);
  const sw_vec ta = sw_spool_tangent(rest_turn(m, m->s[e])),
               tb = sw_spool_tangent(rest_turn(m, m->s[e + 1]));
  const sw_vec near =
      sw_add(sw_scale(a, (1 + 2 * f) * (1 - f) * (1 - f)), sw_scale(b, f * f * (3 - 2 * f)));
  return (sw_rest_place){sw_add(near, sw_add(sw_scale(ta, chord * f * (1 - f) * (1 - f)),
                                             sw_scale(tb, -chord * f * f * (1 - f)))),
                         rest_turn(m, s)};
}

/* Sets the unloaded frame of an edge from the curve's frame at the edge's middle. */
static void shape_edge(sw_mesh *m, const sw_mesh *shape, size_t e) {
  const sw_quat q = sw_spool_at(shape, 0.5 * (m->s[e] + m->s[e + 1])).q;
  const sw_vec along = sw_sub(sw_vec_at(m->rest, e + 1), sw_vec_at(m->rest, e));
  const sw_vec t = sw_unit_or(along, sw_spool_tangent(q));
  sw_store(m->rest_normal + 3 * e, sw_carry_unit(sw_spool_normal(q), sw_spool_tangent(q), t));
}

void sw_spool_node(sw_mesh *m, const sw_mesh *shape, size_t node) {
  sw_store(m->rest + 3 * node, sw_spool_at(shape, m->s[node]).x);
  if (node > 0) shape_edge(m, shape, node - 1);
  if (node + 1 < m->n) shape_edge(m, shape, node);
}
