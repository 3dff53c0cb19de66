/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is kept of every accepted state: extremes, forces, frames. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "base/simd.h"
#include "scene/events.h"
#include "scene/world.h"
#include "state/clamp.h"

/* The largest of |t2 - t1| / hinge length, squared: the curvature to second
 * order in the hinge angle; the exact angle is taken at the place found. */
SW_HOT
static double largest_curvature2(size_t n, const double *restrict hinge, const double *restrict tx,
                                 const double *restrict ty, const double *restrict tz) {
  double largest = 0;
  for (size_t i = 1; i + 1 < n; i++) {
    const double dx = tx[i] - tx[i - 1], dy = ty[i] - ty[i - 1], dz = tz[i] - tz[i - 1];
    const double k2 = hinge[i] > 0 ? (dx * dx + dy * dy + dz * dz) / (hinge[i] * hinge[i]) : 0.0;
    largest = largest > k2 ? largest : k2;
  }
  return largest;
}

static double angle_of_chord(double chord) { return 2.0 * asin(fmin(1.0, 0.5 * chord)); }

static double hinge_chord(const sw_field *f, size_t i) {
  double d2 = 0;
  for (int k = 0; k < 3; k++) {
    const double d = f->tangent[k][i] - f->tangent[k][i - 1];
    d2 += d * d;
  }
  return sqrt(d2);
}

static double clamp_curvature(const sw_system *s, const sw_body *b, const sw_clamp_hinge *h) {
  const sw_field *f = &b->field;
  const sw_vec t = sw_v(f->tangent[0][h->edge], f->tangent[1][h->edge], f->tangent[2][h->edge]);
  return sw_clamp_curvature(h, s->directors_now, s->normals_now, t);
}

static void curvature_extreme(const sw_system *s, const sw_body *b, sw_extreme *out) {
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  const double bound2 =
      largest_curvature2(p->nodes, p->hinge, f->tangent[0], f->tangent[1], f->tangent[2]);
  *out = (sw_extreme){.s = p->s[0]};
  for (size_t i = 1; i + 1 < p->nodes; i++) {
    if (!(p->hinge[i] > 0)) continue;
    const double chord = hinge_chord(f, i);
    if (chord * chord < (1 - 1e-12) * bound2 * p->hinge[i] * p->hinge[i]) continue;
    *out = (sw_extreme){.value = angle_of_chord(chord) / p->hinge[i], .s = p->s[i]};
    break;
  }
  for (size_t c = 0; c < p->clamp_count; c++) {
    const sw_clamp_hinge *h = &p->clamps[c];
    const double value = clamp_curvature(s, b, h);
    if (value > out->value) *out = (sw_extreme){.value = value, .s = p->s[h->node]};
  }
}

static void tension_extreme(const sw_system *s, const sw_body *b, sw_extreme *out) {
  const double *T = sw_system_pull(s, b);
  *out = (sw_extreme){.value = -HUGE_VAL};
  for (size_t e = 0; e < b->plan->edges; e++)
    if (T[e] > out->value)
      *out = (sw_extreme){.value = T[e], .s = 0.5 * (b->plan->s[e] + b->plan->s[e + 1])};
}

/* Outermost fibres at hinges, by the mean axial force of both edges and the chord
 * |t2 - t1| for the angle, exact to its third order. */
SW_HOT
static double largest_hinge_strain(size_t n, double half_compliance, double radius,
                                   const double *restrict T, const double *restrict hinge,
                                   const double *restrict tx, const double *restrict ty,
                                   const double *restrict tz) {
  double largest = -HUGE_VAL;
  for (size_t i = 1; i + 1 < n; i++) {
    const double dx = tx[i] - tx[i - 1], dy = ty[i] - ty[i - 1], dz = tz[i] - tz[i - 1];
    const double chord = sqrt(dx * dx + dy * dy + dz * dz);
    const double bent = hinge[i] > 0 ? radius * chord / hinge[i] : 0.0;
    const double strain = half_compliance * (T[i] + T[i - 1]) + bent;
    largest = largest > strain ? largest : strain;
  }
  return largest;
}

static void keep_largest(sw_extreme *kept, const sw_extreme *now) {
  if (now->value > kept->value) *kept = *now;
}

/* The same of a wire that is not straight at rest: without the bend that it has then. */
static void framed_strain(const sw_system *s, const sw_body *b, sw_extreme *out) {
  const sw_plan *p = b->plan;
  const double *T = s->tension + b->first_edge, EA = p->beam.EA, radius = p->beam.radius;
  *out = (sw_extreme){.value = T[0] / EA, .s = p->s[0]};
  keep_largest(out, &(sw_extreme){.value = T[p->edges - 1] / EA, .s = p->s[p->edges]});
  for (size_t i = 1; i + 1 < p->nodes; i++) {
    const double bent = radius * sw_scene_flexure(s, b, i), mean = 0.5 * (T[i] + T[i - 1]) / EA;
    keep_largest(out, &(sw_extreme){.value = mean + bent, .s = p->s[i]});
  }
  for (size_t c = 0; c < p->clamp_count; c++) {
    const double bent = radius * sw_scene_flexure(s, b, p->nodes + c);
    keep_largest(out, &(sw_extreme){.value = T[p->clamps[c].edge] / EA + bent,
                                    .s = p->s[p->clamps[c].node]});
  }
}

static void strain_extreme(const sw_system *s, const sw_body *b, sw_extreme *out) {
  if (b->plan->beam.curved) {
    framed_strain(s, b, out);
    return;
  }
  const sw_plan *p = b->plan;
  const sw_field *f = &b->field;
  const double *T = s->tension + b->first_edge, EA = p->beam.EA, radius = p->beam.radius;
  const double bound = largest_hinge_strain(p->nodes, 0.5 / EA, radius, T, p->hinge, f->tangent[0],
                                            f->tangent[1], f->tangent[2]);
  *out = (sw_extreme){.value = T[0] / EA, .s = p->s[0]}; /* free and pinned ends are not bent */
  keep_largest(out, &(sw_extreme){.value = T[p->edges - 1] / EA, .s = p->s[p->edges]});
  for (size_t i = 1; i + 1 < p->nodes && bound > out->value; i++) {
    const double chord = hinge_chord(f, i), mean = 0.5 * (T[i] + T[i - 1]) / EA;
    const double per_length = p->hinge[i] > 0 ? radius / p->hinge[i] : 0.0;
    if (mean + per_length * chord < bound - 1e-12 * fabs(bound)) continue;
    *out = (sw_extreme){.value = mean + per_length * angle_of_chord(chord), .s = p->s[i]};
    break;
  }
  for (size_t c = 0; c < p->clamp_count; c++) {
    const sw_clamp_hinge *h = &p->clamps[c];
    const double bent = radius * clamp_curvature(s, b, h);
    keep_largest(out, &(sw_extreme){.value = T[h->edge] / EA + bent, .s = p->s[h->node]});
  }
}

void sw_scene_wire_now(sw_scene *s, size_t w, sw_wire_extremes *now) {
  if (s->wires[w].strand.web) {
    sw_strand_extremes(s, w, now);
    now->curvature.time = now->tension.time = now->strain.time = s->time;
    now->ovalisation.time = now->folding.time = s->time;
    return;
  }
  curvature_extreme(&s->system, &s->system.bodies[w], &now->curvature);
  tension_extreme(&s->system, &s->system.bodies[w], &now->tension);
  strain_extreme(&s->system, &s->system.bodies[w], &now->strain);
  now->ovalisation = now->folding = (sw_extreme){.value = -HUGE_VAL};
  now->curvature.time = now->tension.time = now->strain.time = s->time;
}

void sw_scene_keep_extremes(sw_wire_extremes *kept, const sw_wire_extremes *now) {
  keep_largest(&kept->curvature, &now->curvature);
  keep_largest(&kept->tension, &now->tension);
  keep_largest(&kept->strain, &now->strain);
  keep_largest(&kept->ovalisation, &now->ovalisation);
  if (!(kept->folding.value > 0)) keep_largest(&kept->folding, &now->folding); /* the first fold */
}

static sw_status log_holds(sw_scene *s, sw_error *err) {
  for (size_t k = 0; k < s->system.hold_count; k++) {
    sw_scene_hold *h = &s->holds[s->hold_slot[k]];
    const sw_hold_state *at = &s->system.hold_states[k];
    double row[SW_LOG_SIZE];
    sw_system_reaction(&s->system, (int)k, at->pose.p, &h->force, &h->moment);
    SW_TRY(sw_hold_look_out(s, h, err));
    row[SW_LOG_TIME] = s->time;
    sw_store(row + SW_LOG_FORCE, h->force);
    sw_store(row + SW_LOG_MOMENT, h->moment);
    sw_store(row + SW_LOG_POINT, at->pose.p);
    if (h->cls->feeds) h->feed.drive = sw_feed_drive(s, h, s->system.x);
    if (sw_log_add(&h->log, row, SW_LOG_SIZE) != SW_OK)
      return sw_fail(err, SW_ENOMEM, "out of memory for the series of '%s'", h->name);
  }
  return SW_OK;
}

static sw_status observe_contact(sw_scene *s, sw_error *err) {
  size_t node = 0;
  const double depth = sw_scene_deepest(s, &node);
  if (depth > s->deepest.value) {
    size_t b = 0;
    while (b + 1 < s->system.body_count && s->system.bodies[b + 1].first_node <= node) b++;
    const sw_body *body = &s->system.bodies[b];
    const double *arc = body->plan->s;
    s->deepest = (sw_extreme){depth, arc[node - body->first_node] - arc[0], s->time};
  }
  for (size_t k = 0; k < s->obstacle_count; k++) {
    sw_scene_obstacle *o = &s->obstacles[k];
    sw_vec force, moment;
    double row[SW_LOG_OBSTACLE_SIZE];
    if (!o->alive || !s->contact) continue;
    sw_contact_force(s->contact, (int)k, sw_v(0, 0, 0), &force, &moment);
    row[0] = s->time;
    sw_store(row + 1, force);
    if (sw_log_add(&o->log, row, SW_LOG_OBSTACLE_SIZE) != SW_OK)
      return sw_fail(err, SW_ENOMEM, "out of memory for the series of '%s'", o->name);
  }
  return SW_OK;
}

/* What forces on wires have found. */
static void tell_news(sw_scene *s) {
  sw_force_news news;
  for (size_t w = 0; w < s->system.body_count; w++) {
    const sw_body *b = &s->system.bodies[w];
    for (size_t k = 0; k < b->term_count; k++) {
      if (!sw_term_news(&b->terms[k], &news)) continue;
      const int id = b->terms[k].id;
      const char *name = id >= 0 ? s->forces[id].name : "";
      const double s0 = b->plan->s[0];
      sw_scene_tell(s, news.kind, name, news.s - s0, news.value, "%s '%s', wire '%s': %s",
                    b->terms[k].cls->name, name, s->wires[w].name, news.text);
    }
  }
}

sw_status sw_scene_observe(sw_scene *s, sw_error *err) {
  sw_feed_follow(s);
  sw_jaw_follow(s);
  for (size_t w = 0; w < s->wire_count; w++) s->wires[w].untwisted = 0;
  SW_TRY(sw_system_place_holds(&s->system, s->time, s->system.x, NULL, NULL, err));
  sw_system_refresh(&s->system);
  sw_scene_watch_ties(s);
  sw_system_commit(&s->system, s->time);
  tell_news(s);
  for (size_t w = 0; w < s->wire_count; w++) {
    sw_wire_extremes now;
    sw_scene_wire_now(s, w, &now);
    sw_scene_keep_extremes(&s->wires[w].extremes, &now);
  }
  SW_TRY(log_holds(s, err));
  if (sw_scene_has_contact(s)) SW_TRY(observe_contact(s, err));
  return sw_tool_observe(s, err);
}

void sw_scene_reset_extremes(sw_scene *s) {
  for (size_t w = 0; w < s->wire_count; w++) {
    const sw_extreme least = {.value = -HUGE_VAL};
    s->wires[w].extremes = (sw_wire_extremes){least, least, least, least, least};
    if (s->built) s->system.bodies[w].pushed = 0;
  }
  s->deepest = (sw_extreme){0};
}
