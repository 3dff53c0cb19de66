/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The middle line of a wire, which carries it over to another model. */
#include "remodel/line.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/interrupt.h"
#include "link/hold.h"
#include "read/reading.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "state/hinge.h"

static sw_status new_line(size_t n, sw_line *out) {
  *out = (sw_line){.n = n};
  double *p = sw_alloc(19 * n, sizeof *p);
  if (!p) return SW_ENOMEM;
  out->block = p;
  out->s = p, out->tension = p + n, out->turn = p + 2 * n;
  out->x = p + 3 * n, out->v = p + 6 * n, out->frame = p + 9 * n, out->strain = p + 15 * n;
  return SW_OK;
}

/* --- the old model -------------------------------------------------------------------- */

/* Returns a rod's twist per length at arc length s of its mesh [rad/m]. */
static double rod_rate(const sw_scene *s, const sw_body *b, double at) {
  const sw_plan *p = b->plan;
  for (size_t k = 0; b->has_twist && k < p->span_count; k++) {
    const sw_span *span = &p->spans[k];
    if (at >= p->s[span->first] && at <= p->s[span->last + 1])
      return sw_scene_system(s)->twist[b->first_span + k] / span->length;
  }
  return p->beam.rest_twist;
}

/* Returns the mean direction of a section's lattice x axis, across the section's tangent. */
static sw_vec section_x(const sw_web *w, const double *x, size_t ring, sw_vec t) {
  double at[3];
  sw_web_middle(w, x, ring, at);
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < w->around_count; k++) {
    const uint32_t i = w->around[k];
    const sw_vec r = sw_sub(sw_vec_at(x, w->first[ring] + i), sw_load(at));
    const double X = w->section[2 * i], Y = w->section[2 * i + 1];
    sum = sw_madd(sum, r, X);              /* the x parts */
    sum = sw_madd(sum, sw_cross(r, t), Y); /* the y parts, turned by -90 degrees onto x */
  }
  return sw_unit_or(sw_madd(sum, t, -sw_dot(sum, t)), sw_perpendicular(t));
}

/* Returns the twist between two frames, relative to carrying the direction along [rad]. */
static double turn_between(sw_vec t0, sw_vec u0, sw_vec t1, sw_vec u1) {
  const sw_edge_frame a = {t0, u0}, b = {t1, u1};
  return sw_hinge_twist(&a, &b, 0.0);
}

/* 1 if a hold keeps the line rigid at this arc length of its mesh. */
static int is_rigid(const sw_scene *s, size_t wire, double at) {
  SW_EACH(hold, h, s)
    if (h->alive && h->wire == wire && h->s1 <= at && at <= h->s2) return 1;
  return 0;
}

static sw_status sample(sw_scene *s, sw_handle h, const double *at, sw_line *out, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h.slot);
  SW_TRY(sw_scene_wire_length(s, h, &out->length, err));
  out->start = w->mesh.s[0];
  for (size_t i = 0; i < out->n; i++) {
    const double even = out->length * ((double)i / (double)(out->n - 1));
    out->s[i] = at ? at[i] : i + 1 == out->n ? out->length : even;
  }
  for (size_t i = 0; i < out->n; i++) {
    sw_point_state p;
    if (sw_interrupted()) return SW_EINTR;
    SW_TRY(sw_scene_wire_at(s, h, out->s[i], &p, err));
    /* between the nodes in a grip it is straight: on a curve its edges would be too long there */
    const int rigid = !w->strand.web && is_rigid(s, h.slot, out->start + out->s[i]);
    sw_store(out->x + 3 * i, rigid ? p.chord : p.position);
    sw_store(out->v + 3 * i, p.velocity);
    sw_store(out->frame + 6 * i, p.tangent);
    out->tension[i] = p.elastic;
  }
  return SW_OK;
}

/* Directions across the line: those of the mesh, or carried along a rod with its twist. */
static void sample_frames(const sw_scene *s, size_t wire, sw_line *out) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const sw_web *web = b->plan->web;
  const double *x = system->x + 3 * b->first_node;
  const sw_vec normal = sw_scene_wire_in(s, wire)->drawing.normal;
  sw_vec t = sw_load(out->frame), u = sw_perpendicular(t);
  if (!web && isfinite(normal.x)) u = sw_unit_or(sw_madd(normal, t, -sw_dot(normal, t)), u);
  for (size_t i = 0; i < out->n; i++) {
    const sw_vec next = sw_load(out->frame + 6 * i);
    double f, turn = 0;
    sw_vec v = sw_carry_unit(u, t, next);
    if (web) {
      const size_t r = sw_plan_locate(b->plan, out->start + out->s[i], &f) + (f > 0.5);
      const sw_vec mine = sw_web_is_ring(web, r) ? section_x(web, x, r, next) : v;
      turn = i ? turn_between(t, u, next, mine) : 0.0;
      v = mine;
    } else if (i) {
      const double ds = out->s[i] - out->s[i - 1];
      turn = rod_rate(s, b, out->start + 0.5 * (out->s[i] + out->s[i - 1])) * ds;
      v = sw_rotate(sw_quat_exp(sw_scale(next, turn)), v);
    }
    out->turn[i] = (i ? out->turn[i - 1] : 0.0) + turn;
    sw_store(out->frame + 6 * i + 3, v);
    t = next, u = v;
  }
}

/* Strains of the sections: differences of their frames, minus those at rest. */
static void find_strains(const sw_beam *beam, sw_line *l) {
  for (size_t i = 0; i < l->n; i++) {
    const size_t a = i > 0 ? i - 1 : 0, b = i + 1 < l->n ? i + 1 : i;
    const double ds = l->s[b] - l->s[a];
    const sw_vec t = sw_load(l->frame + 6 * i), u = sw_load(l->frame + 6 * i + 3);
    const sw_vec bend =
        sw_scale(sw_sub(sw_load(l->frame + 6 * b), sw_load(l->frame + 6 * a)), 1.0 / ds);
    double *strain = l->strain + SW_CELL_STRAINS * i;
    strain[SW_CELL_STRETCH] = l->tension[i] / beam->EA;
    strain[SW_CELL_ABOUT_X] = -sw_dot(bend, sw_cross(t, u));
    strain[SW_CELL_ABOUT_Y] = sw_dot(bend, u);
    strain[SW_CELL_TWIST] = (l->turn[b] - l->turn[a]) / ds - beam->rest_twist;
  }
}

int sw_line_face(sw_line *l, const sw_beam *beam, double s, sw_vec towards, double least) {
  size_t at = 0;
  for (size_t i = 1; i < l->n; i++)
    if (fabs(l->s[i] - s) < fabs(l->s[at] - s)) at = i;
  const sw_vec t = sw_load(l->frame + 6 * at), u = sw_load(l->frame + 6 * at + 3);
  const sw_vec way = sw_unit_or(towards, t), wanted = sw_madd(way, t, -sw_dot(way, t));
  if (!(sw_norm(wanted) > least)) return 0;
  const double turn = atan2(sw_dot(sw_cross(u, wanted), t), sw_dot(u, wanted));
  for (size_t i = 0; i < l->n; i++) {
    const sw_vec along = sw_load(l->frame + 6 * i);
    const sw_quat q = sw_quat_exp(sw_scale(along, turn));
    sw_store(l->frame + 6 * i + 3, sw_rotate(q, sw_load(l->frame + 6 * i + 3)));
  }
  find_strains(beam, l);
  return 1;
}

void sw_line_free(sw_line *l) {
  sw_free(l->block);
  l->block = NULL;
}

sw_status sw_line_read(sw_scene *s, sw_handle h, size_t n, const double *at, sw_line *out,
                       sw_error *err) {
  if (new_line(n, out) != SW_OK) return sw_fail(err, SW_ENOMEM, "remodel: out of memory");
  SW_TRY(sample(s, h, at, out, err));
  sample_frames(s, h.slot, out);
  find_strains(&sw_scene_wire_in(s, h.slot)->beam, out);
  return SW_OK;
}

/* --- the new model ------------------------------------------------------------------------ */

sw_status sw_line_mesh(const sw_scene_wire *w, const sw_line *l, sw_mesh *out) {
  const double ends[6] = {0, 0, 0, l->length, 0, 0};
  if (!l->block) return SW_ENOMEM;
  SW_TRY(sw_mesh_along(out, ends, 2, l->n - 1));
  memcpy(out->s, l->s, l->n * sizeof *out->s);
  memcpy(out->x, l->x, 3 * l->n * sizeof *out->x);
  memcpy(out->v, l->v, 3 * l->n * sizeof *out->v);
  for (size_t i = 0; i + 1 < l->n; i++) out->tension[i] = 0.5 * (l->tension[i] + l->tension[i + 1]);
  out->EA = w->beam.EA, out->scale = w->mesh.scale, out->drawn = 0;
  return SW_OK;
}

void sw_line_spin(const sw_line *l, const sw_web *web, const double *x, double *v) {
  for (size_t r = 0; r < l->n; r++) {
    const size_t a = r > 0 ? r - 1 : 0, b = r + 1 < l->n ? r + 1 : r;
    const sw_vec way = sw_sub(sw_vec_at(l->x, b), sw_vec_at(l->x, a));
    const sw_vec rate = sw_sub(sw_vec_at(l->v, b), sw_vec_at(l->v, a));
    const sw_vec t = sw_load(l->frame + 6 * r);
    const sw_vec omega = sw_scale(sw_cross(t, rate), 1.0 / fmax(sw_norm(way), 1e-30));
    for (size_t i = web->first[r]; i < web->first[r + 1]; i++) {
      const sw_vec arm = sw_sub(sw_vec_at(x, i), sw_vec_at(l->x, r));
      sw_store(v + 3 * i, sw_add(sw_vec_at(l->v, r), sw_cross(omega, arm)));
    }
  }
}

/* Stores the twist edge by edge, for any spans that the rod may have. */
sw_status sw_line_twist(const sw_line *l, sw_scene_wire *out) {
  out->twisted = sw_alloc(l->n, sizeof *out->twisted);
  if (!out->twisted) return SW_ENOMEM;
  for (size_t i = 0; i + 1 < l->n; i++)
    out->twisted[i] = (sw_twisted){l->s[i], l->s[i + 1], l->turn[i + 1] - l->turn[i]};
  out->twisted_count = l->n - 1;
  return SW_OK;
}
