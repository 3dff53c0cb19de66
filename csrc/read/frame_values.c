/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of a wire's nodes in a frame: at the nodes of a line, at the middle line of a mesh. */
#include <math.h>
#include <string.h>

#include "body/body.h"
#include "body/section.h"
#include "body/side.h"
#include "body/spin.h"
#include "body/touching.h"
#include "read/extremes.h"
#include "read/kept_frames.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "state/plan.h"
#include "system/axial.h"

/* Returns sw_angle_of_chord(chord) within 5e-9, without its cost for small angles. */
static double quick_angle(double chord) {
  const double c2 = chord * chord;
  return c2 < 1e-3 ? chord * (1 + c2 / 24) : sw_angle_of_chord(chord);
}

/* Returns the stress of the outermost fibre, from the axial force and the bend minus that at
 * rest. */
static double fibre_stress(const sw_beam *beam, double T, double bent) {
  return beam->E * (T / beam->EA + beam->radius * bent);
}

static void line_values(const sw_system *s, const sw_body *b, float *out) {
  const sw_plan *p = b->plan;
  const int turns = b->spin_block || b->has_twist, curved = p->beam.curved;
  const double *T = sw_system_pull(s, b);
  for (size_t i = 0; i < p->nodes; i++)
    out[SW_FRAME_VALUES * i + SW_FRAME_TENSION] = (float)sw_line_between_middles(p, T, p->s[i]);
  T = sw_system_elastic(s, b); /* takes the room of the other ones */
  for (size_t i = 0; i < p->nodes; i++, out += SW_FRAME_VALUES) {
    const double mean = sw_line_between_middles(p, T, p->s[i]);
    const int inner = i > 0 && i + 1 < p->nodes && p->hinge[i] > 0;
    const double bent = inner ? quick_angle(sw_scene_hinge_chord(&b->field, i)) / p->hinge[i] : 0.0;
    out[SW_FRAME_CURVATURE] = (float)bent;
    out[SW_FRAME_TWIST] = turns ? (float)sw_scene_torque(s, b, p->s[i]) : 0.0f;
    out[SW_FRAME_STRESS] =
        (float)fibre_stress(&p->beam, mean, inner && curved ? sw_scene_flexure(s, b, i) : bent);
    out[SW_FRAME_ARC] = (float)(p->s[i] - p->s[0]);
  }
}

/* Sets the values at clamps, whose bend is that relative to the held direction, and at joints. */
static void side_values(const sw_system *s, const sw_body *b, float *out) {
  const sw_plan *p = b->plan;
  const double *T = sw_system_elastic(s, b);
  sw_bent_side h;
  for (size_t next = 0; sw_scene_next_side(s, b, &next, &h);) {
    float *at = out + SW_FRAME_VALUES * h.node;
    const double bent = sw_scene_side_curvature(s, b, &h);
    const double beyond = p->beam.curved ? sw_scene_side_flexure(s, b, &h) : bent;
    at[SW_FRAME_CURVATURE] = fmaxf(at[SW_FRAME_CURVATURE], (float)bent);
    at[SW_FRAME_STRESS] =
        fmaxf(at[SW_FRAME_STRESS], (float)fibre_stress(&p->beam, T[h.edge], beyond));
  }
}

static void strand_values(sw_scene *s, size_t w, size_t n, float *out) {
  const sw_body *b = &sw_scene_system(s)->bodies[w];
  const double *arc = sw_scene_wire_in(s, w)->mesh.s;
  for (size_t i = 0; i < n; i++, out += SW_FRAME_VALUES) {
    sw_point_state at;
    sw_strand_at(s, sw_scene_wire_in(s, w), b, arc[i], &at);
    out[SW_FRAME_TENSION] = (float)at.tension, out[SW_FRAME_CURVATURE] = (float)at.curvature;
    out[SW_FRAME_TWIST] = (float)at.twist_moment;
    out[SW_FRAME_STRESS] = (float)(b->plan->beam.E * at.strain);
    out[SW_FRAME_ARC] = (float)(arc[i] - arc[0]);
  }
}

/* Adds a share of a force to the system's node, if it is the body's. */
static void press(const sw_body *b, size_t node, double share, double normal, sw_vec force,
                  float *out) {
  if (node < b->first_node || node >= b->first_node + b->plan->nodes) return;
  const sw_web *web = b->plan->web;
  const size_t i = node - b->first_node;
  float *at = out + SW_FRAME_VALUES * (web ? sw_web_ring_of(web, i) : i);
  at[SW_FRAME_CONTACT] += (float)(share * normal);
  at[SW_FRAME_FORCE] += (float)(share * force.x);
  at[SW_FRAME_FORCE + 1] += (float)(share * force.y);
  at[SW_FRAME_FORCE + 2] += (float)(share * force.z);
}

static void press_obstacles(const sw_scene *s, const sw_body *b, float *out) {
  size_t k = 0, end = 0;
  if (sw_scene_contact(s))
    sw_contact_touches_of(sw_scene_contact(s), b->first_node, b->first_node + b->plan->nodes, &k,
                          &end);
  for (; k < end; k++) {
    sw_contact_push p;
    if (!sw_contact_push_at(sw_scene_contact(s), sw_scene_system(s), k, &p)) continue;
    press(b, p.node, 1 - p.at, p.normal_force, p.force, out);
    press(b, p.other, p.at, p.normal_force, p.force, out);
  }
}

/* Adds the force at a place where two bodies press on each other: the first body bears the force,
 * the second its opposite. */
static void press_place(const sw_scene *s, const sw_body *b, const sw_pair_place *p, float *out) {
  const sw_vec force = sw_madd(p->friction, p->normal, p->normal_force);
  for (int k = 0; k < 2; k++) {
    if (&sw_scene_system(s)->bodies[p->body[k]] != b) continue;
    const sw_vec own = k ? sw_neg(force) : force;
    press(b, p->node[k], 1 - p->at[k], p->normal_force, own, out);
    if (p->at[k] > 0) press(b, p->end[k], p->at[k], p->normal_force, own, out);
  }
}

static void press_wires(const sw_scene *s, const sw_body *b, float *out) {
  size_t next[2] = {0, 0};
  sw_pair_place p;
  while (sw_scene_next_place(s, (size_t)(b - sw_scene_system(s)->bodies), next, &p))
    press_place(s, b, &p, out);
}

void sw_scene_node_values(sw_scene *s, size_t w, size_t n, float *out) {
  sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  memset(out, 0, SW_FRAME_VALUES * n * sizeof *out);
  if (b->plan->web) {
    strand_values(s, w, n, out);
  } else {
    line_values(system, b, out);
    side_values(system, b, out);
  }
  press_obstacles(s, b, out);
  press_wires(s, b, out);
}
