/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A wire that pads have squeezed for real is carried on as a rod which the tool holds rigidly, and
 * given back to the pads later. What they held is kept: the particles with their springs' forces,
 * in the tool's axes, and the friction between pads and particles. Rings that were pressed move
 * with the tool like the grip that stands for them; those beside them turn with the rod. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/remodel_inner.h"
#include "scene/save.h"
#include "state/hinge.h"
#include "state/state_tape.h"

struct sw_frozen {
  int references;
  sw_handle wire, hold;
  const sw_wire_class *cls;
  sw_mesh mesh;       /* one node for each ring, as they lay */
  sw_strand strand;   /* likewise */
  sw_pose pose;       /* of the tool then */
  size_t first, last; /* rings that were pressed */
  double inside[2];   /* so far inside of them a rod's grip ends before, and after [m] */
  sw_vec across;      /* how the pads close, in the tool's axes [-] */
  double *frame;      /* (rings x 6) tangent, direction across then [-] */
  sw_stations stations;
  void *memory; /* of contact then */
  size_t bytes;
  size_t node, nodes; /* the wire's first one in it, how many it had */
  sw_jaw jaw;
};

void sw_frozen_retain(sw_frozen *f) {
  if (f) f->references++;
}

void sw_frozen_release(sw_frozen *f) {
  if (!f || --f->references > 0) return;
  sw_mesh_free(&f->mesh);
  sw_strand_free(&f->strand);
  sw_region_free(&f->stations);
  sw_free(f->frame);
  sw_free(f->memory);
  sw_free(f);
}

/* --- what goes on as it was ----------------------------------------------------------------
 *
 * A rod and a mesh do not lie quite alike under the same forces. The wire that takes over is put
 * where it is in balance with the inertia that the other one had, by micrometres: else it would
 * begin to swing, and the gripper feel that. */

enum { MOST_POSES = 200 }; /* iterations; without a result the wire stays as it lies [-] */
static const double BALANCED = 1e-8; /* of the shifts that end them, of the wire's length [-] */

/* Add the forces that velocities make; work: (2 x freedoms). */
static sw_status add_friction_of_motion(sw_scene *s, double *force, double *work, sw_error *err) {
  sw_system *system = &s->system;
  const size_t n = 3 * system->nodes;
  double *still = work, *a = work + system->freedoms;
  const sw_coupling coupling = system->coupling;
  memset(still, 0, system->freedoms * sizeof *still);
  system->coupling.eval = NULL; /* contact does not know velocities */
  sw_status status = sw_system_acceleration(system, s->time, system->x, system->v, a, err);
  for (size_t i = 0; i < n && status == SW_OK; i++) force[i] += system->delta[i];
  if (status == SW_OK) status = sw_system_acceleration(system, s->time, system->x, still, a, err);
  for (size_t i = 0; i < n && status == SW_OK; i++) force[i] -= system->delta[i];
  system->coupling = coupling;
  return status;
}

/* Put the built scene where it is in balance with the accelerations that it has: of the wire those
 * of its rings or nodes before (rings x 3). Velocities stay. */
static sw_status balance(sw_scene *s, size_t wire, const double *rings, size_t count) {
  const sw_settle_args args = {.tolerance = BALANCED, .max_iterations = MOST_POSES};
  const size_t n = s->system.freedoms;
  const sw_body *b = &s->system.bodies[wire];
  const sw_web *web = b->plan->web;
  sw_settle_report report = {0};
  sw_error ignored = {""};
  double *dead = sw_alloc(5 * n, sizeof *dead);
  if (!dead) return SW_ENOMEM;
  double *v = dead + n, *a = dead + 2 * n;
  memcpy(v, s->system.v, n * sizeof *v);
  memcpy(a, s->system.a, n * sizeof *a);
  const int alike = count == (web ? web->rings : b->plan->nodes); /* none came for narrow gaps */
  for (size_t i = 0; i < b->plan->nodes; i++) {
    const size_t r = web ? sw_web_ring_of(web, i) : i;
    sw_store(a + 3 * (b->first_node + i), alike ? sw_vec_at(rings, r) : sw_v(0, 0, 0));
  }
  sw_inertia_of(&s->system, a, dead);
  if (add_friction_of_motion(s, dead, dead + 3 * n, &ignored) != SW_OK) {
    sw_free(dead);
    return SW_OK;
  }
  s->system.dead = dead;
  const sw_status status = sw_scene_rest(s, s->time, NULL, &args, NULL, &report, &ignored);
  s->system.dead = NULL;
  memcpy(s->system.v, v, n * sizeof *v);
  memcpy(s->system.a, a, n * sizeof *a);
  sw_free(dead);
  return status == SW_ENOMEM || status == SW_ECALLBACK ? status : SW_OK;
}

/* Accelerations of a wire's rings, or of its nodes (count x 3), to be freed; NULL: no memory. */
static double *accelerations(const sw_scene *s, size_t wire, size_t *count) {
  const sw_body *b = &s->system.bodies[wire];
  const sw_web *web = b->plan->web;
  const double *a = s->system.a + 3 * b->first_node;
  *count = web ? web->rings : b->plan->nodes;
  double *out = sw_alloc(3 * *count, sizeof *out);
  for (size_t r = 0; out && r < *count; r++) {
    if (web)
      sw_web_middle(web, a, r, out + 3 * r);
    else
      sw_store(out + 3 * r, sw_vec_at(a, r));
  }
  return out;
}

/* --- from pads to a grip --------------------------------------------------------------- */

static int is_pad(const sw_tool *t, int obstacle) {
  for (size_t k = 0; k < t->pads; k++)
    if (t->pad[k].obstacle == (size_t)obstacle) return 1;
  return 0;
}

/* Rings that the tool presses; 0: there are none. */
static int pressed_rings(const sw_scene *s, const sw_tool *t, const sw_body *b, sw_frozen *f) {
  f->first = SIZE_MAX, f->last = 0;
  for (size_t k = 0; s->contact && k < sw_contact_touches(s->contact); k++) {
    sw_contact_push p;
    if (!sw_contact_push_at(s->contact, &s->system, k, &p) || !is_pad(t, p.obstacle)) continue;
    if (p.node < b->first_node || p.node >= b->first_node + b->plan->nodes) continue;
    const size_t r = sw_web_ring_of(b->plan->web, p.node - b->first_node);
    if (r < f->first) f->first = r;
    if (r > f->last) f->last = r;
  }
  return f->first <= f->last;
}

static sw_status keep_stations(const sw_web *web, const sw_mesh *mesh, sw_stations *out) {
  out->n = web->rings;
  out->s = sw_alloc(web->rings, sizeof *out->s);
  out->ring = sw_alloc(web->rings, sizeof *out->ring);
  if (!out->s || !out->ring) return SW_ENOMEM;
  for (size_t r = 0; r < web->rings; r++) {
    out->s[r] = mesh->s[r] - mesh->s[0];
    out->ring[r] = (unsigned char)sw_web_is_ring(web, r);
  }
  return SW_OK;
}

static sw_status keep_memory(const sw_scene *s, const sw_body *b, sw_frozen *f) {
  const void *memory = sw_contact_memory(s->contact, &f->bytes);
  f->memory = sw_alloc(f->bytes, 1);
  if (!f->memory) return SW_ENOMEM;
  if (f->bytes) memcpy(f->memory, memory, f->bytes);
  f->node = b->first_node, f->nodes = b->plan->nodes;
  return SW_OK;
}

/* --- how far inside the pads a rod's grip has to end --------------------------------------------
 *
 * Sections give way under the pads: what a moment turns the wire by where it leaves them is more
 * than by a clamp there. The rod's grip ends as much further inside as makes it turn the same. */

/* Second moment of a ring's particles across the axis of a couple, and axial parts of a turn. */
static double couple(const sw_web *web, const double *x, size_t ring, sw_vec t, sw_vec axis,
                     double *load) {
  const sw_vec e = sw_cross(t, axis), middle = sw_strand_middle(web, x, ring);
  double sum = 0;
  for (size_t p = web->first[ring]; p < web->first[ring + 1]; p++) {
    const double arm = sw_dot(sw_sub(sw_vec_at(x, p), middle), e);
    sum += arm * arm;
    if (load) sw_store(load + 3 * p, sw_scale(t, arm));
  }
  return sum;
}

/* Turn of a ring by shifts of its particles [rad]. */
static double turn_of(const sw_web *web, const double *x, size_t ring, sw_vec t, sw_vec axis,
                      const double *shift) {
  const sw_vec e = sw_cross(t, axis), middle = sw_strand_middle(web, x, ring);
  double sum = 0;
  for (size_t p = web->first[ring]; p < web->first[ring + 1]; p++)
    sum += sw_dot(sw_vec_at(shift, p), t) * sw_dot(sw_sub(sw_vec_at(x, p), middle), e);
  return sum / couple(web, x, ring, t, axis, NULL);
}

enum { OUTSIDE = 3 }; /* the couple acts so many rings outside the pads [-] */

/* Of one side: -1 before, 1 after. Nothing where the wire ends between the pads. */
static sw_status find_inside(sw_scene *s, const sw_tool *tool, sw_frozen *f, int side, double *load,
                             sw_error *err) {
  size_t pads_only[SW_TOOL_PADS];
  for (size_t k = 0; k < tool->pads; k++) pads_only[k] = tool->pad[k].obstacle;
  const sw_body *b = &s->system.bodies[f->wire.slot];
  const sw_web *web = b->plan->web;
  const double *x = s->system.x + 3 * b->first_node;
  const size_t face = side < 0 ? f->first : f->last;
  size_t ring = face;
  for (int k = 0; k < OUTSIDE; k++) {
    const size_t next = side < 0 ? ring - 1 : ring + 1;
    if (next >= web->rings || !sw_web_is_ring(web, next)) break; /* below 0 is above all, too */
    ring = next;
  }
  f->inside[side > 0] = 0;
  if (ring == face) return SW_OK;
  const sw_vec t = sw_strand_facing(web, x, ring);
  const sw_vec pads = sw_rotate(f->pose.q, f->across);
  const sw_vec axis = sw_unit_or(sw_madd(pads, t, -sw_dot(pads, t)), sw_perpendicular(t));
  memset(load, 0, 3 * web->particles * sizeof *load);
  const double second = couple(web, x, ring, t, axis, load);
  for (size_t i = 0; i < 3 * web->particles; i++) load[i] /= second; /* a moment of 1 N m */
  SW_TRY(sw_scene_linearise(s, pads_only, tool->pads, err));
  SW_TRY(sw_system_deflect(&s->system, f->wire.slot, load));
  const double turn = turn_of(web, x, ring, t, axis, load); /* [rad/(N m)] */
  const double way = fabs(f->stations.s[ring] - f->stations.s[face]);
  f->inside[side > 0] = fmax(0.0, turn * b->plan->beam.EI - way);
  return SW_OK;
}

/* Both sides; together less than the pressed length. */
static sw_status find_insides(sw_scene *s, const sw_tool *t, sw_frozen *f, sw_error *err) {
  static const double MOST = 0.45; /* of the pressed length, each [-] */
  const sw_body *b = &s->system.bodies[f->wire.slot];
  const double most = MOST * (f->stations.s[f->last] - f->stations.s[f->first]);
  double *load = sw_alloc(3 * b->plan->nodes, sizeof *load);
  if (!load) return SW_ENOMEM;
  f->across = sw_unit_or(s->obstacles[t->pad[0].obstacle].drive.opens, sw_v(0, 1, 0));
  sw_status status = find_inside(s, t, f, -1, load, err);
  if (status == SW_OK) status = find_inside(s, t, f, 1, load, err);
  for (int k = 0; k < 2; k++) f->inside[k] = fmin(f->inside[k], most);
  sw_free(load);
  return status;
}

/* All that has to be known to come back. */
static sw_status keep(sw_scene *s, const sw_tool *t, sw_handle wire, sw_frozen *f, sw_line *line,
                      sw_error *err) {
  sw_scene_wire *w = &s->wires[wire.slot];
  const sw_body *b = &s->system.bodies[wire.slot];
  sw_motion_state now;
  SW_TRY(sw_drive_eval(s, &t->drive, s->time, &now, err));
  f->pose = now.pose;
  f->wire = wire, f->cls = w->cls, f->jaw = t->jaw;
  sw_strand_take(w, &s->system, b);
  SW_TRY(sw_mesh_copy(&w->mesh, &f->mesh));
  SW_TRY(sw_strand_copy(&w->strand, &f->strand));
  SW_TRY(keep_stations(w->strand.web, &w->mesh, &f->stations));
  SW_TRY(keep_memory(s, b, f));
  SW_TRY(sw_line_read(s, wire, f->stations.n, f->stations.s, line, err));
  f->frame = sw_alloc(6 * f->stations.n, sizeof *f->frame);
  if (!f->frame) return SW_ENOMEM;
  memcpy(f->frame, line->frame, 6 * f->stations.n * sizeof *f->frame);
  return find_insides(s, t, f, err);
}

/* The rod that the line is. */
static sw_status become_rod(sw_scene *s, sw_handle wire, const sw_line *line, sw_error *err) {
  sw_scene_wire next = {.cls = sw_wire_find("rod")};
  sw_status status = sw_line_mesh(&s->wires[wire.slot], line, &next.mesh);
  if (status == SW_OK) status = sw_line_twist(line, &next);
  if (status == SW_OK) status = sw_scene_thaw(s);
  if (status == SW_OK) return sw_scene_replace_wire(s, wire.slot, &next, err);
  sw_mesh_free(&next.mesh);
  sw_free(next.twisted);
  return status;
}

/* How the section nearest to an arc length faces. */
static sw_vec facing_at(const sw_frozen *f, double s) {
  size_t r = f->first;
  while (r < f->last && f->stations.s[r] < s) r++;
  if (r > f->first && s - f->stations.s[r - 1] < f->stations.s[r] - s) r--;
  return sw_load(f->frame + 6 * r);
}

/* The tool's grip on the rod; where it leaves the grip it goes on as the sections face there. */
static sw_status grip(sw_scene *s, sw_handle tool, const sw_frozen *f, sw_freeze_report *out,
                      sw_error *err) {
  const sw_hold_class *cls = sw_hold_find("grip");
  sw_hold_args args;
  sw_params_default(&cls->params, &args);
  out->s1 = f->stations.s[f->first] + f->inside[0];
  out->s2 = f->stations.s[f->last] - f->inside[1];
  args.s = 0.5 * (out->s1 + out->s2);
  args.width = out->s2 - out->s1;
  args.direction = sw_v(NAN, NAN, NAN);
  SW_TRY(sw_scene_add_hold(s, cls, f->wire, &args, &out->hold, err));
  sw_scene_hold *h = &s->holds[out->hold.slot];
  h->director[0] = facing_at(f, out->s1);
  h->director[1] = facing_at(f, out->s2);
  return sw_scene_tool_hold(s, tool, out->hold, err);
}

static sw_status change_to_rod(sw_scene *s, sw_handle tool, sw_frozen *f, const sw_line *line,
                               const double *a, size_t count, sw_freeze_report *out,
                               sw_error *err) {
  sw_vec about;
  sw_momentum_of(s, f->wire.slot, &about, out->before);
  out->energy_before = sw_scene_total_energy(s, err);
  SW_TRY(become_rod(s, f->wire, line, err));
  SW_TRY(grip(s, tool, f, out, err));
  f->hold = out->hold;
  SW_TRY(sw_scene_tool_pads_on(s, tool, 0, err));
  SW_TRY(sw_scene_build(s, err));
  SW_TRY(balance(s, f->wire.slot, a, count));
  SW_TRY(sw_momentum_match(s, f->wire.slot, about, out->before));
  sw_momentum_about(s, f->wire.slot, about, out->after);
  out->energy_after = sw_scene_total_energy(s, err);
  sw_scene_hold *h = &s->holds[out->hold.slot];
  sw_motion_state at;
  SW_TRY(sw_drive_eval(s, &h->drive, s->time, &at, err));
  h->force = out->force; /* until a step tells: what the pads did */
  h->moment = sw_sub(out->moment, sw_cross(sw_sub(at.pose.p, f->pose.p), out->force));
  return SW_OK;
}

static sw_status check_freeze(const sw_scene *s, const sw_tool *t, sw_handle wire, sw_error *err) {
  const sw_scene_wire *w = sw_scene_find_wire(s, wire, err);
  if (!w) return SW_EDEAD;
  if (t->frozen)
    return sw_fail(err, SW_EINVAL, "gripper '%s' holds its wire rigidly already", t->name);
  if (!w->strand.web || !w->strand.web->per_ring)
    return sw_fail(err, SW_EINVAL,
                   "gripper '%s': wire '%s' is a %s; only a mesh has sections that pads deform",
                   t->name, w->name, w->cls->name);
  return SW_OK;
}

sw_status sw_scene_tool_freeze(sw_scene *s, sw_handle tool, sw_handle wire, sw_freeze_report *out,
                               sw_error *err) {
  sw_line line = {0};
  sw_snapshot *before = NULL;
  sw_error ignored;
  *out = (sw_freeze_report){0};
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err));
  const sw_tool *t = sw_scene_find_tool(s, tool, err);
  if (!t) return SW_EDEAD;
  SW_TRY(check_freeze(s, t, wire, err));
  SW_TRY(sw_scene_build(s, err));
  sw_frozen *f = sw_alloc(1, sizeof *f);
  if (!f) return sw_fail(err, SW_ENOMEM, "gripper: out of memory");
  f->references = 1;
  if (!pressed_rings(s, t, &s->system.bodies[wire.slot], f)) {
    sw_frozen_release(f);
    return sw_fail(err, SW_EINVAL, "gripper '%s' does not press on wire '%s'", t->name,
                   s->wires[wire.slot].name);
  }
  sw_status status = sw_scene_tool_force(s, tool, NULL, &out->force, &out->moment, err);
  if (status == SW_OK) status = keep(s, t, wire, f, &line, err);
  if (status == SW_OK) status = sw_scene_snapshot(s, &before, err);
  size_t count = 0;
  double *a = status == SW_OK ? accelerations(s, wire.slot, &count) : NULL;
  if (status == SW_OK && !a) status = SW_ENOMEM;
  if (status == SW_OK) status = change_to_rod(s, tool, f, &line, a, count, out, err);
  sw_free(a);
  sw_line_free(&line);
  if (status == SW_OK) {
    s->tools[tool.slot].frozen = f;
    s->discontinuous = SW_GOES_ON;
    s->tools[tool.slot].now.lost_time = NAN;
  } else {
    if (before) sw_scene_restore(s, before, &ignored);
    sw_frozen_release(f);
  }
  sw_snapshot_free(before);
  return status == SW_ENOMEM ? sw_fail(err, status, "gripper: out of memory") : status;
}

/* --- and back ------------------------------------------------------------------------------ */

/* Directions across the rod's line start anywhere: turn them so that the ring that the tool holds
 * has the one that went with the tool. */
static void align(const sw_frozen *f, const sw_pose *now, sw_line *l) {
  const size_t r = f->first;
  const sw_quat moved = sw_quat_mul(now->q, sw_quat_conj(f->pose.q));
  const sw_vec t = sw_load(l->frame + 6 * r), u = sw_load(l->frame + 6 * r + 3);
  const sw_vec true_t = sw_rotate(moved, sw_load(f->frame + 6 * r));
  const sw_vec true_u = sw_carry_unit(sw_rotate(moved, sw_load(f->frame + 6 * r + 3)), true_t, t);
  const double angle = atan2(sw_dot(sw_cross(u, true_u), t), sw_dot(u, true_u));
  for (size_t k = 0; k < l->n; k++) {
    const sw_vec axis = sw_load(l->frame + 6 * k), v = sw_load(l->frame + 6 * k + 3);
    sw_store(l->frame + 6 * k + 3, sw_rotate(sw_quat_exp(sw_scale(axis, angle)), v));
  }
}

/* a, known in the frame (t, u) of one line, in that of another. */
static sw_vec turned(const double *from, const double *to, sw_vec a) {
  const sw_vec t = sw_load(from), u = sw_load(from + 3), w = sw_cross(t, u);
  const sw_vec t2 = sw_load(to), u2 = sw_load(to + 3), w2 = sw_cross(t2, u2);
  return sw_madd(sw_madd(sw_scale(t2, sw_dot(a, t)), u2, sw_dot(a, u)), w2, sw_dot(a, w));
}

/* What pads press on stays where it was between them; the middle goes with the rod that stands for
 * it, and what lies between shears in between. */
static void place_pressed(const sw_frozen *f, const sw_motion_state *tool, const sw_line *l,
                          size_t r, const sw_web *web, double *x) {
  const sw_vec middle = sw_pose_local(f->pose, sw_vec_at(f->mesh.x, r));
  const sw_vec off = sw_sub(sw_vec_at(l->x, r), sw_pose_point(tool->pose, middle));
  double widest = 0;
  for (size_t p = web->first[r]; p < web->first[r + 1]; p++) {
    const sw_vec at = sw_pose_local(f->pose, sw_vec_at(x, p));
    widest = fmax(widest, fabs(sw_dot(sw_sub(at, middle), f->across)));
  }
  for (size_t p = web->first[r]; p < web->first[r + 1]; p++) {
    const sw_vec at = sw_pose_local(f->pose, sw_vec_at(x, p));
    const double far = fabs(sw_dot(sw_sub(at, middle), f->across));
    const double share = widest > 0 ? 1.0 - far / widest : 0.0;
    sw_store(x + 3 * p, sw_madd(sw_pose_point(tool->pose, at), off, share));
  }
}

/* Particles of the strand, whose places are those of then, to where they are now. */
static void place(const sw_frozen *f, const sw_motion_state *tool, const sw_line *l,
                  sw_strand *strand) {
  const sw_web *web = strand->web;
  double *x = strand->x, *v = strand->v;
  for (size_t r = 0; r < web->rings; r++) {
    if (r >= f->first && r <= f->last) {
      place_pressed(f, tool, l, r, web, x);
      continue;
    }
    for (size_t p = web->first[r]; p < web->first[r + 1]; p++) {
      const sw_vec off = sw_sub(sw_vec_at(x, p), sw_vec_at(f->mesh.x, r));
      sw_store(x + 3 * p,
               sw_add(sw_vec_at(l->x, r), turned(f->frame + 6 * r, l->frame + 6 * r, off)));
    }
  }
  sw_line_spin(l, web, x, v);
  for (size_t p = web->first[f->first]; p < web->first[f->last + 1]; p++) {
    const sw_vec arm = sw_sub(sw_vec_at(x, p), tool->pose.p);
    sw_store(v + 3 * p, sw_add(tool->v, sw_cross(tool->omega, arm)));
  }
  memset(strand->a, 0, 3 * web->particles * sizeof *strand->a);
  for (size_t e = 0; e < web->links; e++) {
    const sw_web_link *k = &web->link[e];
    const double length = sw_dist(sw_vec_at(x, k->a), sw_vec_at(x, k->b));
    if (!sw_web_is_ring(web, sw_web_ring_of(web, k->a)))
      strand->axial[e] = k->k * (length - k->rest); /* of a line: as it lies now */
  }
}

static sw_status become_mesh(sw_scene *s, const sw_frozen *f, const sw_motion_state *tool,
                             const sw_line *line, sw_error *err) {
  sw_scene_wire next = {.cls = f->cls};
  sw_status status = sw_mesh_copy(&f->mesh, &next.mesh);
  if (status == SW_OK) status = sw_strand_copy(&f->strand, &next.strand);
  if (status == SW_OK) status = sw_scene_thaw(s);
  if (status != SW_OK) {
    sw_mesh_free(&next.mesh);
    sw_strand_free(&next.strand);
    return status;
  }
  memcpy(next.mesh.x, line->x, 3 * line->n * sizeof *line->x);
  memcpy(next.mesh.v, line->v, 3 * line->n * sizeof *line->v);
  place(f, tool, line, &next.strand);
  return sw_scene_replace_wire(s, f->wire.slot, &next, err);
}

static sw_status change_to_mesh(sw_scene *s, sw_handle tool, const sw_frozen *f, sw_line *line,
                                const double *a, size_t count, sw_freeze_report *out,
                                sw_error *err) {
  const sw_tool *t = &s->tools[tool.slot];
  size_t pads[SW_TOOL_PADS];
  sw_motion_state now;
  sw_vec about;
  SW_TRY(sw_drive_eval(s, &t->drive, s->time, &now, err));
  SW_TRY(sw_line_read(s, f->wire, f->stations.n, f->stations.s, line, err));
  align(f, &now.pose, line);
  sw_momentum_of(s, f->wire.slot, &about, out->before);
  out->energy_before = sw_scene_total_energy(s, err);
  SW_TRY(sw_scene_release_hold(s, f->hold, err));
  SW_TRY(become_mesh(s, f, &now, line, err));
  SW_TRY(sw_scene_tool_pads_on(s, tool, 1, err));
  SW_TRY(sw_scene_build(s, err));
  for (size_t k = 0; k < t->pads; k++) pads[k] = t->pad[k].obstacle;
  const size_t first = s->system.bodies[f->wire.slot].first_node;
  SW_TRY(sw_contact_add_memory(s->contact, f->memory, f->bytes, f->node, f->node + f->nodes, first,
                               pads, t->pads));
  SW_TRY(balance(s, f->wire.slot, a, count));
  SW_TRY(sw_momentum_match(s, f->wire.slot, about, out->before));
  sw_momentum_about(s, f->wire.slot, about, out->after);
  out->energy_after = sw_scene_total_energy(s, err);
  return SW_OK;
}

sw_status sw_scene_tool_thaw(sw_scene *s, sw_handle tool, sw_freeze_report *out, sw_error *err) {
  sw_line line = {0};
  sw_snapshot *before = NULL;
  sw_error ignored;
  *out = (sw_freeze_report){0};
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err));
  const sw_tool *t = sw_scene_find_tool(s, tool, err);
  if (!t) return SW_EDEAD;
  sw_frozen *f = t->frozen;
  if (!f) return sw_fail(err, SW_EINVAL, "gripper '%s' does not hold its wire rigidly", t->name);
  if (s->wires[f->wire.slot].strand.web)
    return sw_fail(err, SW_EINVAL, "gripper '%s': wire '%s' was remodelled while it was held",
                   t->name, s->wires[f->wire.slot].name);
  SW_TRY(sw_scene_build(s, err));
  sw_status status = sw_scene_tool_force(s, tool, NULL, &out->force, &out->moment, err);
  if (status == SW_OK) status = sw_scene_snapshot(s, &before, err);
  size_t count = 0;
  double *a = status == SW_OK ? accelerations(s, f->wire.slot, &count) : NULL;
  if (status == SW_OK && !a) status = SW_ENOMEM;
  if (status == SW_OK) status = change_to_mesh(s, tool, f, &line, a, count, out, err);
  sw_free(a);
  sw_line_free(&line);
  if (status == SW_OK) {
    sw_tool *thawed = &s->tools[tool.slot];
    thawed->jaw = f->jaw;
    thawed->jaw.since = s->time, thawed->jaw.speed = 0;
    thawed->frozen = NULL;
    s->discontinuous = SW_GOES_ON;
    thawed->now.lost_time = NAN;
    sw_frozen_release(f);
  } else if (before) {
    sw_scene_restore(s, before, &ignored);
  }
  sw_snapshot_free(before);
  return status == SW_ENOMEM ? sw_fail(err, status, "gripper: out of memory") : status;
}

/* --- on a tape ---------------------------------------------------------------------------- */

static void tape_handle(sw_tape *t, sw_handle *h) {
  SW_TAPE_STRUCT(t, sw_handle, 8);
  sw_tape_uint32(t, &h->slot), sw_tape_uint32(t, &h->generation);
}

static void tape_fields(sw_tape *t, sw_frozen *f) {
  char word[SW_NAME_SIZE];
  SW_TAPE_STRUCT(t, sw_frozen, 528);
  SW_TAPE_STRUCT(t, sw_stations, 32);
  sw_tape_mark(t, "contact", sw_contact_layout());
  tape_handle(t, &f->wire), tape_handle(t, &f->hold);
  const char *model = sw_tape_word(t, sw_tape_reads(t) ? NULL : f->cls->name, word);
  if (sw_tape_reads(t)) f->cls = sw_wire_find(model);
  sw_tape_mesh(t, &f->mesh);
  sw_tape_strand(t, &f->strand);
  sw_tape_pose(t, &f->pose), sw_tape_vec(t, &f->across);
  sw_tape_size(t, &f->first), sw_tape_size(t, &f->last);
  sw_tape_double(t, &f->inside[0]), sw_tape_double(t, &f->inside[1]);
  sw_tape_count(t, &f->stations.n, sizeof *f->stations.s);
  SW_TAPE_ARRAY(t, f->frame, 6 * f->stations.n);
  SW_TAPE_ARRAY(t, f->stations.s, f->stations.n), SW_TAPE_ARRAY(t, f->stations.ring, f->stations.n);
  sw_tape_double(t, &f->stations.spacing);
  sw_tape_count(t, &f->bytes, 1);
  sw_tape_array(t, &f->memory, f->bytes, 1);
  sw_tape_size(t, &f->node), sw_tape_size(t, &f->nodes);
  sw_tape_jaw(t, &f->jaw);
}

void sw_tape_frozen(sw_tape *t, sw_frozen **frozen) {
  int there = !sw_tape_reads(t) && *frozen != NULL;
  sw_tape_int(t, &there);
  if (!there) return;
  if (sw_tape_reads(t)) {
    *frozen = sw_tape_good(t) ? sw_alloc(1, sizeof **frozen) : NULL;
    if (!*frozen) {
      sw_tape_fail(t, SW_ENOMEM);
      return;
    }
    (*frozen)->references = 1;
  }
  if (*frozen) tape_fields(t, *frozen);
}

int sw_frozen_fits(const sw_frozen *f, const sw_scene *s) {
  const sw_web *web = f->strand.web;
  if (!f->cls || !f->cls->mesh || !web || !web->per_ring || !f->strand.kit || f->mesh.rest)
    return 0;
  if (f->wire.slot >= s->wire_count || s->wires[f->wire.slot].generation != f->wire.generation)
    return 0;
  if (f->mesh.n != web->rings || f->stations.n != web->rings) return 0;
  if (f->first > f->last || f->last >= web->rings || f->nodes != web->particles) return 0;
  for (size_t i = 0; i < f->stations.n; i++)
    if (!isfinite(f->stations.s[i]) || (i && !(f->stations.s[i - 1] < f->stations.s[i]))) return 0;
  if (f->node > SIZE_MAX - f->nodes || web->around_count > SW_OUTLINE) return 0;
  return sw_contact_memory_fits(f->memory, f->bytes, SIZE_MAX, s->obstacle_count);
}
