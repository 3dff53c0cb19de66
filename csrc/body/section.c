/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a wire that is a mesh of particles as a wire: the line through the middles of its rings,
 * the forces that its sections carry, and their deformation. */
#include "body/section.h"

#include <math.h>

#include "force/solid.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "strand/ring.h"
#include "system/axial.h"
#include "system/system.h"

/* --- sections -------------------------------------------------------------------- */

/* Adds the force of an element on the corners of its first ring. */
static void add_solid_force(const sw_plan *p, const double *x, const sw_web_solid *s, sw_vec about,
                            sw_vec *force, sw_vec *moment) {
  double at[3 * SW_SOLID_NODES], g[3 * SW_SOLID_NODES];
  for (uint32_t i = 0; i < s->count; i++) sw_store(at + 3 * i, sw_vec_at(x, s->node[i]));
  sw_solid_eval((const sw_solid *)p->web->shapes + sw_plan_shape(p, s), at, SW_WANT_FORCE, g, NULL);
  for (uint32_t i = 0; i < s->count / 2; i++) {
    const sw_vec f = sw_neg(sw_load(g + 3 * i));
    *force = sw_add(*force, f);
    *moment = sw_add(*moment, sw_cross(sw_sub(sw_load(at + 3 * i), about), f));
  }
}

/* Returns the force of the wire after slice number r (between rings r and r + 1) on the wire before
 * it, and its moment about a point [N], [N m]. */
static void slice_force(const sw_plan *p, const double *x, const double *T, size_t r, sw_vec about,
                        sw_vec *force, sw_vec *moment) {
  const sw_web *w = p->web;
  *force = *moment = sw_v(0, 0, 0);
  const size_t next = w->first[r + 1];
  for (size_t e = w->ring_links[r]; e < w->ring_links[r + 1]; e++) {
    const sw_web_link *link = &w->link[e];
    if (link->b < next) continue; /* within ring r */
    const sw_vec a = sw_vec_at(x, link->a), d = sw_sub(sw_vec_at(x, link->b), a);
    const sw_vec f = sw_scale(d, T[e] / sw_norm(d));
    *force = sw_add(*force, f);
    *moment = sw_add(*moment, sw_cross(sw_sub(a, about), f));
  }
  for (size_t k = w->ring_solids[r]; k < w->ring_solids[r + 1]; k++)
    add_solid_force(p, x, &w->solid[k], about, force, moment);
}

/* Returns by how much the axial forces `pull` of a slice's springs exceed T, along the axis [N]. */
static double slice_excess(const sw_plan *p, const double *x, const double *T, const double *pull,
                           size_t r, sw_vec axis) {
  const sw_web *w = p->web;
  double sum = 0;
  for (size_t e = w->ring_links[r]; e < w->ring_links[r + 1]; e++) {
    const sw_web_link *link = &w->link[e];
    if (link->b < w->first[r + 1]) continue; /* within ring r */
    const sw_vec d = sw_sub(sw_vec_at(x, link->b), sw_vec_at(x, link->a));
    sum += (pull[e] - T[e]) * sw_dot(d, axis) / sw_norm(d);
  }
  return sum;
}

sw_slice sw_strand_slice(const sw_plan *p, const double *x, const double *T, const double *pull,
                         size_t r) {
  const sw_web *w = p->web;
  const sw_vec a = sw_web_centre(w, x, r), b = sw_web_centre(w, x, r + 1),
               about = sw_lerp(a, b, 0.5);
  const sw_vec t0 = sw_web_facing(w, x, r), t1 = sw_web_facing(w, x, r + 1);
  const sw_vec axis = sw_unit_or(sw_add(t0, t1), t0);
  const double h = w->s[w->first[r + 1]] - w->s[w->first[r]];
  const double curvature = 2.0 * asin(fmin(1.0, 0.5 * sw_dist(t0, t1))) / h;
  sw_vec force, moment;
  slice_force(p, x, T, r, about, &force, &moment);
  const double elastic = sw_dot(force, axis);
  const double more = pull == T ? 0.0 : slice_excess(p, x, T, pull, r, axis);
  return (sw_slice){elastic + more, elastic, sw_dot(moment, axis), curvature,
                    sw_scale(sw_unit_or(sw_sub(t1, t0), sw_v(0, 0, 0)), curvature)};
}

double sw_strand_moment(const sw_plan *p, const double *x, const double *T, double place) {
  double f;
  const size_t r = sw_plan_locate(p, place, &f);
  const sw_vec about = sw_lerp(sw_web_centre(p->web, x, r), sw_web_centre(p->web, x, r + 1), 0.5);
  const sw_vec axis = sw_unit_or(
      sw_add(sw_web_facing(p->web, x, r), sw_web_facing(p->web, x, r + 1)), sw_v(1, 0, 0));
  sw_vec force, moment;
  slice_force(p, x, T, r, about, &force, &moment);
  return sw_norm(sw_madd(moment, axis, -sw_dot(moment, axis)));
}

static sw_slice blend(sw_slice a, sw_slice b, double f) {
  return (sw_slice){a.tension + f * (b.tension - a.tension),
                    a.elastic + f * (b.elastic - a.elastic),
                    a.twist_moment + f * (b.twist_moment - a.twist_moment),
                    a.curvature + f * (b.curvature - a.curvature), sw_lerp(a.bend, b.bend, f)};
}

/* Interpolates between the middles of slices, where values belong, and extrapolates to the ends. */
static sw_slice slice_at(const sw_plan *p, const double *x, const double *T, const double *pull,
                         size_t r, double f) {
  const size_t slices = p->web->rings - 1;
  if (slices == 1) return sw_strand_slice(p, x, T, pull, 0);
  size_t k = f < 0.5 ? (r > 0 ? r - 1 : 0) : r;
  if (k + 1 >= slices) k = slices - 2;
  const double at = (double)r + f - ((double)k + 0.5);
  return blend(sw_strand_slice(p, x, T, pull, k), sw_strand_slice(p, x, T, pull, k + 1), at);
}

void sw_strand_at(const sw_scene *s, const sw_scene_wire *wire, const sw_body *b, double place,
                  sw_point_state *out) {
  sw_system *system = sw_scene_system(s);
  const sw_web *w = wire->strand.web;
  const double *x = system->x + 3 * b->first_node, *v = system->v + 3 * b->first_node;
  double f;
  const size_t r = sw_plan_locate(b->plan, place, &f);
  const sw_vec x0 = sw_web_centre(w, x, r), x1 = sw_web_centre(w, x, r + 1);
  const sw_vec t0 = sw_web_facing(w, x, r), t1 = sw_web_facing(w, x, r + 1);
  const double l = sw_dist(x0, x1), h00 = (1 + 2 * f) * (1 - f) * (1 - f);
  const double h10 = f * (1 - f) * (1 - f), h01 = f * f * (3 - 2 * f), h11 = f * f * (f - 1);
  const sw_slice at =
      slice_at(b->plan, x, sw_system_elastic(system, b), sw_system_pull(system, b), r, f);
  const double EA = wire->beam.EA, bent = fmax(0.0, at.curvature) * wire->beam.radius;
  out->across = sw_v(0, 0, 0);
  out->chord = sw_lerp(x0, x1, f);
  out->position = sw_add(sw_add(sw_scale(x0, h00), sw_scale(t0, l * h10)),
                         sw_add(sw_scale(x1, h01), sw_scale(t1, l * h11)));
  out->velocity = sw_lerp(sw_web_centre(w, v, r), sw_web_centre(w, v, r + 1), f);
  out->tangent = sw_unit_or(sw_lerp(t0, t1, f), t0);
  out->curvature = fmax(0.0, at.curvature);
  out->tension = at.tension;
  out->elastic = at.elastic;
  out->twist_moment = at.twist_moment;
  out->spin = 0;
  out->strain = at.elastic / EA + bent;
  out->least_strain = at.elastic / EA - bent;
}

void sw_strand_extremes(const sw_scene *s, size_t wire, double *tension, sw_wire_extremes *now) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[wire];
  const sw_web *w = b->plan->web;
  const double *x = system->x + 3 * b->first_node, *T = sw_system_elastic(system, b),
               *pull = sw_system_pull(system, b);
  const double EA = b->plan->beam.EA, GJ = b->plan->beam.GJ;
  const sw_extreme least = {.value = -HUGE_VAL};
  *now = (sw_wire_extremes){least, least, least, least, least, least, least, 0, {0, 0, 0, 0, 0}};
  if (!w->rings) return; /* an object of particles */
  for (size_t r = 0; r + 1 < w->rings; r++) {
    const sw_slice at = sw_strand_slice(b->plan, x, T, pull, r);
    if (tension) tension[r] = at.tension;
    const double place = 0.5 * (w->s[w->first[r]] + w->s[w->first[r + 1]]);
    const double strain = at.elastic / EA + b->plan->beam.radius * at.curvature;
    if (at.curvature > now->curvature.value)
      now->curvature = (sw_extreme){.value = at.curvature, .s = place};
    if (at.tension > now->tension.value)
      now->tension = (sw_extreme){.value = at.tension, .s = place};
    if (strain > now->strain.value) now->strain = (sw_extreme){.value = strain, .s = place};
    if (GJ > 0 && fabs(at.twist_moment) / GJ > now->torsion.value)
      now->torsion = (sw_extreme){.value = fabs(at.twist_moment) / GJ, .s = place};
  }
  now->ovalisation = sw_strand_ovalisation(w, x);
  now->folding = sw_strand_folding(w, x);
}
