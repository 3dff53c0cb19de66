/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Another model for a wire in mid-run: shape, stretch, twist and velocity go over through the
 * wire's middle line. Mass and arc lengths are the same; momentum and angular momentum are made
 * the same by the smallest rigid motion that does it. Sections of a new mesh give way to stretch,
 * bend and twist as those of an endless one do. What else deformed them, as squeezing does, is
 * lost; the energy tells how much. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/region.h"
#include "scene/world.h"
#include "state/hinge.h"

static const sw_param rows[] = {
    {"model", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0, "the model that the wire is to have"},
    {"segments", SW_PARAM_INTEGER, "-", 0, 0, 1e7, 0, NULL, offsetof(sw_wire_args, segments),
     "number of segments, 2 or more (default 50; of a mesh slices, as many as their spacing "
     "gives)"},
    {"region", SW_PARAM_OTHER, "m", 0, 0, 0, 0, NULL, 0,
     "{s1, s2}: only there, and beside clamps, the wire is the mesh; elsewhere a line of particles "
     "of a rod's EA and EI, without twist (not given: all of it)"},
};
const sw_params sw_remodel_params = SW_PARAMS("remodel", rows);

/* The middle line at even arc lengths. */
typedef struct line {
  size_t n;
  double length;               /* [m] */
  double start;                /* arc length of the first one in the mesh [m] */
  double *s, *tension;         /* (n) from the start [m], [N] */
  double *x, *v;               /* (n x 3) [m], [m/s] */
  double *frame;               /* (n x 6) tangent, direction across [-] */
  double *turn;                /* (n) twist since the start [rad] */
  double *strain;              /* (n x 4) of the beam, as a cell has them [-], [1/m] */
  const sw_stations *stations; /* which of them are rings; n 0: all */
  void *block;
} line;

static sw_status new_line(size_t n, line *out) {
  *out = (line){.n = n};
  double *p = sw_alloc(19 * n, sizeof *p);
  if (!p) return SW_ENOMEM;
  out->block = p;
  out->s = p, out->tension = p + n, out->turn = p + 2 * n;
  out->x = p + 3 * n, out->v = p + 6 * n, out->frame = p + 9 * n, out->strain = p + 15 * n;
  return SW_OK;
}

/* --- what it is ---------------------------------------------------------------------- */

/* Twist per length of a rod at arc length s of its mesh [rad/m]. */
static double rod_rate(const sw_scene *s, const sw_body *b, double at) {
  const sw_plan *p = b->plan;
  for (size_t k = 0; b->has_twist && k < p->span_count; k++) {
    const sw_span *span = &p->spans[k];
    if (at >= p->s[span->first] && at <= p->s[span->last + 1])
      return s->system.twist[b->first_span + k] / span->length;
  }
  return p->beam.rest_twist;
}

/* Where the x of a section's lattice has gone, across its tangent. */
static sw_vec section_x(const sw_web *w, const double *x, size_t ring, sw_vec t) {
  double at[3];
  sw_web_middle(w, x, ring, at);
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t k = 0; k < w->around_count; k++) {
    const uint32_t i = w->around[k];
    const sw_vec r = sw_sub(sw_vec_at(x, w->first[ring] + i), sw_load(at));
    const double X = w->section[2 * i], Y = w->section[2 * i + 1];
    sum = sw_madd(sum, r, X);              /* as if turned by nothing */
    sum = sw_madd(sum, sw_cross(r, t), Y); /* and by a quarter turn: y comes to x */
  }
  return sw_unit_or(sw_madd(sum, t, -sw_dot(sum, t)), sw_perpendicular(t));
}

/* Twist from one place to another against carrying the direction along. */
static double turn_between(sw_vec t0, sw_vec u0, sw_vec t1, sw_vec u1) {
  const sw_edge_frame a = {t0, u0}, b = {t1, u1};
  return sw_hinge_twist(&a, &b, 0.0);
}

static sw_status sample(sw_scene *s, sw_handle h, const double *at, line *out, sw_error *err) {
  const sw_scene_wire *w = &s->wires[h.slot];
  SW_TRY(sw_scene_wire_length(s, h, &out->length, err));
  out->start = w->mesh.s[0];
  for (size_t i = 0; i < out->n; i++) {
    const double even = out->length * ((double)i / (double)(out->n - 1));
    out->s[i] = at ? at[i] : i + 1 == out->n ? out->length : even;
  }
  for (size_t i = 0; i < out->n; i++) {
    sw_point_state p;
    SW_TRY(sw_scene_wire_at(s, h, out->s[i], &p, err));
    sw_store(out->x + 3 * i, p.position);
    sw_store(out->v + 3 * i, p.velocity);
    sw_store(out->frame + 6 * i, p.tangent);
    out->tension[i] = p.tension;
  }
  return SW_OK;
}

/* Directions across the line: those of the mesh, or carried along with the rod's twist. */
static void sample_frames(const sw_scene *s, size_t wire, line *out) {
  const sw_body *b = &s->system.bodies[wire];
  const sw_web *web = b->plan->web;
  const double *x = s->system.x + 3 * b->first_node;
  const sw_vec normal = s->wires[wire].drawing.normal;
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

/* What the sections are strained by: differences of their frames, beyond rest. */
static void find_strains(const sw_beam *beam, line *l) {
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

/* --- momentum -------------------------------------------------------------------------- */

/* Momentum of velocities v and its moment about a point: out, 6 numbers [N s], [N m s]. */
static void momentum(const sw_plan *p, const double *x, const double *v, sw_vec about,
                     double out[6]) {
  sw_vec P = sw_v(0, 0, 0), L = sw_v(0, 0, 0);
  for (size_t i = 0; i < p->nodes; i++) {
    sw_vec m = sw_scale(sw_vec_at(v, i), p->mass_own[i]);
    if (i > 0) m = sw_madd(m, sw_vec_at(v, i - 1), p->mass_next[i - 1]);
    if (i + 1 < p->nodes) m = sw_madd(m, sw_vec_at(v, i + 1), p->mass_next[i]);
    P = sw_add(P, m);
    L = sw_add(L, sw_cross(sw_sub(sw_vec_at(x, i), about), m));
  }
  sw_store(out, P);
  sw_store(out + 3, L);
}

/* Solves A y = b by elimination with full pivoting; directions in which A all but vanishes get
 * nothing. */
static void solve6(double A[6][6], double b[6], double y[6]) {
  static const double LEAST = 1e-10; /* of the largest pivot [-] */
  size_t column[6] = {0, 1, 2, 3, 4, 5}, rank = 0;
  double most = 0;
  for (; rank < 6; rank++) {
    size_t pi = rank, pj = rank;
    for (size_t i = rank; i < 6; i++)
      for (size_t j = rank; j < 6; j++)
        if (fabs(A[i][j]) > fabs(A[pi][pj])) pi = i, pj = j;
    if (rank == 0) most = fabs(A[pi][pj]);
    if (!(fabs(A[pi][pj]) > LEAST * most)) break;
    for (size_t j = 0; j < 6; j++) {
      const double t = A[rank][j];
      A[rank][j] = A[pi][j], A[pi][j] = t;
    }
    const double t = b[rank];
    b[rank] = b[pi], b[pi] = t;
    for (size_t i = 0; i < 6; i++) {
      const double u = A[i][rank];
      A[i][rank] = A[i][pj], A[i][pj] = u;
    }
    const size_t c = column[rank];
    column[rank] = column[pj], column[pj] = c;
    for (size_t i = rank + 1; i < 6; i++) {
      const double f = A[i][rank] / A[rank][rank];
      for (size_t j = rank; j < 6; j++) A[i][j] -= f * A[rank][j];
      b[i] -= f * b[rank];
    }
  }
  memset(y, 0, 6 * sizeof *y);
  for (size_t i = rank; i-- > 0;) {
    double sum = b[i];
    for (size_t j = i + 1; j < rank; j++) sum -= A[i][j] * y[column[j]];
    y[column[i]] = sum / A[i][i];
  }
}

/* A rigid motion of what is free: number k < 3 shifts, else turns about a point; the turn's
 * speed is that at a distance. */
static void rigid(const sw_plan *p, const double *x, sw_vec about, double distance, size_t k,
                  double *v) {
  const sw_vec unit = sw_v(k % 3 == 0, k % 3 == 1, k % 3 == 2);
  for (size_t i = 0; i < p->nodes; i++) {
    const sw_vec arm = sw_scale(sw_sub(sw_vec_at(x, i), about), 1.0 / distance);
    const sw_vec at = k < 3 ? unit : sw_cross(unit, arm);
    sw_store(v + 3 * i, p->held[i] == SW_FREE ? at : sw_v(0, 0, 0));
  }
}

/* Give the built wire the momentum wanted. */
static sw_status match_momentum(sw_scene *s, size_t wire, sw_vec about, const double wanted[6]) {
  const sw_body *b = &s->system.bodies[wire];
  const double *x = s->system.x + 3 * b->first_node, size = b->plan->length;
  double *v = s->system.v + 3 * b->first_node, A[6][6], off[6], now[6], y[6], column[6];
  double *field = sw_alloc(3 * b->plan->nodes, sizeof *field);
  if (!field) return SW_ENOMEM;
  momentum(b->plan, x, v, about, now);
  for (size_t k = 0; k < 6; k++) {
    rigid(b->plan, x, about, size, k, field);
    momentum(b->plan, x, field, about, column);
    for (size_t i = 0; i < 6; i++) A[i][k] = column[i] / (i < 3 ? 1.0 : size);
    off[k] = (wanted[k] - now[k]) / (k < 3 ? 1.0 : size);
  }
  solve6(A, off, y);
  for (size_t k = 0; k < 6; k++) {
    rigid(b->plan, x, about, size, k, field);
    for (size_t i = 0; i < 3 * b->plan->nodes; i++) v[i] += y[k] * field[i];
  }
  sw_free(field);
  return SW_OK;
}

/* --- what it becomes --------------------------------------------------------------------- */

/* Nodes on the line. */
static sw_status line_mesh(const sw_scene_wire *w, const line *l, sw_mesh *out) {
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

/* Sections turn with the line: the velocities of their particles. */
static void spin_sections(const line *l, const sw_web *web, const double *x, double *v) {
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

static sw_status becomes_mesh(const sw_strand_plan *plan, const sw_scene_wire *w, const line *l,
                              sw_scene_wire *out, sw_error *err) {
  const sw_strand_lie lie = {.frames = l->frame,
                             .strains = l->strain,
                             .ring = l->stations->ring,
                             .spacing = l->stations->spacing};
  SW_TRY(sw_strand_new(plan, &w->beam, &out->mesh, &lie, &out->strand, err));
  spin_sections(l, out->strand.web, out->strand.x, out->strand.v);
  return SW_OK;
}

/* Twist by parts, for whatever spans the rod has. */
static sw_status becomes_rod(const line *l, sw_scene_wire *out) {
  out->twisted = sw_alloc(l->n, sizeof *out->twisted);
  if (!out->twisted) return SW_ENOMEM;
  for (size_t i = 0; i + 1 < l->n; i++)
    out->twisted[i] = (sw_twisted){l->s[i], l->s[i + 1], l->turn[i + 1] - l->turn[i]};
  out->twisted_count = l->n - 1;
  return SW_OK;
}

/* --- holds ---------------------------------------------------------------------------------- */

/* The wire's living holds take hold of what it has become, each where its pose is now. */
static sw_status retake(sw_scene *s, size_t wire, sw_error *err) {
  for (size_t k = 0; k < s->hold_count; k++) {
    sw_scene_hold *h = &s->holds[k];
    sw_motion_state now;
    if (!h->alive || h->wire != wire) continue;
    SW_TRY(sw_drive_eval(s, &h->drive, s->time, &now, err));
    SW_TRY(sw_scene_rehold(s, h, now.pose));
  }
  return SW_OK;
}

/* --- all of it ---------------------------------------------------------------------------------
 */

static sw_status check(const sw_scene *s, size_t wire, const sw_wire_class *cls, sw_error *err) {
  const sw_scene_wire *w = &s->wires[wire];
  sw_scene_wire as = *w;
  as.cls = cls;
  if (w->mesh.rest)
    return sw_fail(err, SW_EINVAL,
                   "remodel: wire '%s' is curved at rest, has two values of EI or rolls; only "
                   "wires without frames are remodelled",
                   w->name);
  if (w->drawing.rest == SW_REST_PATH)
    return sw_fail(err, SW_EINVAL, "remodel: wire '%s' is curved at rest", w->name);
  if (w->mesh.s[0] != 0) return sw_fail(err, SW_EINVAL, "remodel: wire '%s' has been fed", w->name);
  if (cls->mesh && sw_scene_joined(s, wire)) return sw_scene_check_line(&as, "scene:join", err);
  for (size_t k = 0; k < s->hold_count; k++)
    if (s->holds[k].alive && s->holds[k].wire == wire && s->holds[k].cls->feeds)
      return sw_fail(err, SW_EINVAL, "remodel: wire '%s' is fed by '%s'", w->name,
                     s->holds[k].name);
  return sw_scene_check_rules(s, wire, &as, err);
}

static double total_energy(sw_scene *s, sw_error *err) {
  sw_energy e;
  double sum = 0;
  if (sw_scene_energy(s, &e, err) != SW_OK) return (double)NAN;
  for (size_t k = 0; k < e.count; k++) sum += e.value[k];
  return sum;
}

static void replace(sw_scene *s, size_t wire, sw_scene_wire *with) {
  sw_scene_wire *w = &s->wires[wire];
  sw_mesh_free(&w->mesh);
  sw_strand_free(&w->strand);
  sw_free(w->twisted);
  w->cls = with->cls, w->mesh = with->mesh, w->strand = with->strand;
  w->twisted = with->twisted, w->twisted_count = with->twisted_count, w->untwisted = 0;
  s->kept.changed = wire + 1;
  s->discontinuous = 1;
}

static sw_status make(sw_scene *s, size_t wire, const sw_strand_plan *plan, const line *l,
                      sw_scene_wire *out, sw_error *err) {
  const sw_scene_wire *w = &s->wires[wire];
  sw_status status = line_mesh(w, l, &out->mesh);
  if (status == SW_OK)
    status = out->cls->mesh ? becomes_mesh(plan, w, l, out, err) : becomes_rod(l, out);
  if (status == SW_OK) return SW_OK;
  sw_mesh_free(&out->mesh);
  sw_strand_free(&out->strand);
  sw_free(out->twisted);
  return status == SW_ENOMEM ? sw_fail(err, status, "remodel: out of memory") : status;
}

static void about_now(const sw_scene *s, size_t wire, sw_vec *about, double out[6]) {
  const sw_body *b = &s->system.bodies[wire];
  const double *x = s->system.x + 3 * b->first_node;
  double mass = 0;
  sw_vec sum = sw_v(0, 0, 0);
  for (size_t i = 0; i < b->plan->nodes; i++) {
    sum = sw_madd(sum, sw_vec_at(x, i), b->plan->lumped[i]);
    mass += b->plan->lumped[i];
  }
  *about = sw_scale(sum, 1.0 / mass);
  momentum(b->plan, x, s->system.v + 3 * b->first_node, *about, out);
}

/* The line, once the number of its nodes is known. */
static sw_status read_line(sw_scene *s, sw_handle h, const sw_wire_args *args,
                           const sw_strand_plan *plan, const sw_wire_class *cls,
                           const sw_stations *stations, line *out, sw_error *err) {
  size_t segments = stations->n ? stations->n - 1 : (size_t)args->segments;
  double length;
  SW_TRY(sw_scene_wire_length(s, h, &length, err));
  if (!segments && cls->mesh)
    SW_TRY(sw_strand_slices(plan, &s->wires[h.slot].beam, length, &segments, err));
  if (segments < 2) segments = 50;
  if (new_line(segments + 1, out) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "remodel: out of memory");
  SW_TRY(sample(s, h, stations->s, out, err));
  sample_frames(s, h.slot, out);
  find_strains(&s->wires[h.slot].beam, out);
  return SW_OK;
}

enum { USUAL_SEGMENTS = 50 }; /* of a wire that is a line, when nobody says [-] */

static sw_status plan_region(sw_scene *s, sw_handle h, const sw_wire_args *args,
                             const sw_strand_plan *plan, const double *region, sw_stations *out,
                             sw_error *err) {
  const sw_scene_wire *w = &s->wires[h.slot];
  size_t slices;
  double length;
  SW_TRY(sw_scene_wire_length(s, h, &length, err));
  if (!plan->mesh)
    return sw_fail(err, SW_EINVAL,
                   "remodel: region goes with a model that is a mesh, not with a "
                   "line; without it the whole wire changes");
  if (!(region[0] >= 0) || !(region[1] <= length * (1 + 1e-9)) || !(region[0] < region[1]))
    return sw_fail(err, SW_EINVAL,
                   "remodel: region = {%.6g, %.6g} m is not on wire '%s'; it must be two arc "
                   "lengths, the first one less, within [0, %.6g] m",
                   region[0], region[1], w->name, length);
  if (w->beam.rest_twist != 0)
    return sw_fail(err, SW_EINVAL,
                   "remodel: wire '%s' is twisted without load, which lines beside a region are "
                   "not; leave region out",
                   w->name);
  SW_TRY(sw_strand_slices(plan, &w->beam, length, &slices, err));
  const double segments = args->segments ? (double)args->segments : USUAL_SEGMENTS;
  return sw_region_plan(s, h.slot, region, length / (double)slices, length / segments, out, err);
}

/* More than this is lost in lines [rad]. */
static const double LEAST_TWIST = 1e-3;

static sw_status check_twist(const sw_scene_wire *w, const line *l, sw_error *err) {
  double most = 0;
  for (size_t i = 0; l->turn && i < l->n; i++) most = fmax(most, fabs(l->turn[i]));
  if (most <= LEAST_TWIST) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "remodel: wire '%s' is twisted by %.3g rad, which lines beside a region cannot "
                 "carry; leave region out",
                 w->name, most);
}

static sw_status change(sw_scene *s, sw_handle h, const sw_strand_plan *plan, const line *l,
                        sw_scene_wire *next, sw_remodel_report *out, sw_error *err) {
  sw_vec about;
  about_now(s, h.slot, &about, out->before);
  out->about = about;
  out->energy_before = total_energy(s, err);
  SW_TRY(make(s, h.slot, plan, l, next, err));
  const sw_status thawed = sw_scene_thaw(s);
  if (thawed != SW_OK) {
    sw_mesh_free(&next->mesh);
    sw_strand_free(&next->strand);
    sw_free(next->twisted);
    return sw_fail(err, thawed, "remodel: out of memory");
  }
  replace(s, h.slot, next);
  SW_TRY(retake(s, h.slot, err));
  SW_TRY(sw_scene_build(s, err));
  if (match_momentum(s, h.slot, about, out->before) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "remodel: out of memory");
  const sw_body *b = &s->system.bodies[h.slot];
  momentum(b->plan, s->system.x + 3 * b->first_node, s->system.v + 3 * b->first_node, about,
           out->after);
  out->energy_after = total_energy(s, err);
  return SW_OK;
}

sw_status sw_scene_remodel(sw_scene *s, sw_handle h, const sw_wire_args *args,
                           const sw_wire_mesh_args *mesh, const double *region,
                           sw_remodel_report *out, sw_error *err) {
  *out = (sw_remodel_report){0};
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_readable(s, err));
  if (!sw_scene_find_wire(s, h, err)) return SW_EDEAD;
  const sw_wire_class *cls = sw_wire_all()[args->model];
  SW_TRY(check(s, h.slot, cls, err));
  SW_TRY(sw_scene_build(s, err));
  const sw_strand_plan plan = sw_scene_strand_plan(&s->wires[h.slot], cls, mesh);
  line l = {0};
  sw_scene_wire next = {.cls = cls};
  sw_snapshot *before = NULL;
  sw_error ignored;
  sw_stations stations = {0};
  sw_status status = region ? plan_region(s, h, args, &plan, region, &stations, err) : SW_OK;
  if (status == SW_OK) status = read_line(s, h, args, &plan, cls, &stations, &l, err);
  l.stations = &stations;
  if (status == SW_OK && region) status = check_twist(&s->wires[h.slot], &l, err);
  if (status == SW_OK) status = sw_scene_snapshot(s, &before, err);
  if (status == SW_OK) status = change(s, h, &plan, &l, &next, out, err);
  if (status != SW_OK && before) sw_scene_restore(s, before, &ignored);
  sw_snapshot_free(before);
  sw_region_free(&stations);
  sw_free(l.block);
  return status;
}
