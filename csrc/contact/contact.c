/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Life of the contact, candidates of a step, memory between steps, read-outs. */
#include "contact/contact.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "contact/touch.h"

static const double PI = 3.14159265358979323846;

/* A wire at rest sinks in by this much when a single touch carries its whole
 * weight [m]. */
static const double ALLOWED_PENETRATION = 20e-6;
/* Stiffness over mass/hbar^2 in implicit steps: far above what the step
 * resolves, so that the gap closes to a thousandth of the free fall [-]. */
static const double IMPLICIT_SHARE = 1000.0;
/* An explicit step is stable while k h^2 / m stays below 4 [-]. */
static const double EXPLICIT_SHARE = 0.2;
static const double STAGE_SHARE = 0.3; /* hbar of the default method over the step [-] */

sw_status sw_contact_new(const sw_contact_obstacle *obstacles, size_t count, sw_contact_place place,
                         void *user, sw_contact **out) {
  sw_contact *c = sw_alloc(1, sizeof *c);
  if (!c) return SW_ENOMEM;
  c->obstacles = sw_alloc(count, sizeof *c->obstacles);
  c->start = sw_alloc(count, sizeof *c->start);
  c->now = sw_alloc(count, sizeof *c->now);
  c->flat = sw_alloc(count, sizeof *c->flat);
  c->dense = sw_alloc(count, sizeof *c->dense);
  c->bounds = (sw_bounds *)sw_alloc(count, sizeof *c->bounds);
  if (!c->obstacles || !c->start || !c->now || !c->flat || !c->dense || !c->bounds) {
    sw_contact_free(c);
    return SW_ENOMEM;
  }
  memcpy(c->obstacles, obstacles, count * sizeof *obstacles);
  for (size_t o = 0; o < count; o++)
    c->flat[o] = strcmp(sw_shape_kind(obstacles[o].shape), "plane") == 0;
  c->count = count;
  c->fresh = 1;
  c->place = place;
  c->user = user;
  *out = c;
  return SW_OK;
}

sw_status sw_contact_copy(const sw_contact *c, sw_contact **out) {
  const size_t bytes = c->memory_count * sizeof *c->memory;
  SW_TRY(sw_contact_new(c->obstacles, c->count, c->place, c->user, out));
  const sw_status status = sw_contact_set_memory(*out, c->memory, bytes, c->fresh);
  if (status == SW_OK) return SW_OK;
  sw_contact_free(*out);
  *out = NULL;
  return status;
}

void sw_contact_keep(sw_contact *c, const size_t *ids, size_t count) {
  for (size_t o = 0; o < c->count; o++) {
    c->obstacles[o].off = 1;
    for (size_t k = 0; k < count; k++)
      if (ids[k] == (size_t)c->obstacles[o].id) c->obstacles[o].off = 0;
  }
}

void sw_contact_free(sw_contact *c) {
  if (!c) return;
  sw_free(c->obstacles);
  sw_free(c->start);
  sw_free(c->now);
  sw_free(c->flat);
  sw_free(c->dense);
  sw_free(c->bounds);
  sw_free(c->candidates);
  sw_free(c->touches);
  sw_free(c->last);
  sw_free(c->memory);
  sw_free(c->next_memory);
  sw_free(c->pressed);
  sw_free(c->barriers);
  sw_free(c->impacts);
  sw_free(c->marks);
  sw_free(c);
}

/* --- candidates --------------------------------------------------------------- */

static sw_status place_all(sw_contact *c, double t, sw_contact_at *out, sw_error *err) {
  for (size_t o = 0; o < c->count; o++) {
    sw_motion_state m;
    SW_TRY(c->place(c->user, c->obstacles[o].id, t, &m, err));
    out[o] = (sw_contact_at){m.pose, m.v, m.omega};
  }
  return SW_OK;
}

/* Axis-parallel box around a turned box. */
static sw_bounds world_bounds(const sw_shape *shape, const sw_pose *pose) {
  const sw_bounds b = sw_shape_bounds(shape);
  if (!isfinite(b.min.x + b.max.x + b.min.y + b.max.y + b.min.z + b.max.z))
    return (sw_bounds){{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
  const sw_vec half = sw_scale(sw_sub(b.max, b.min), 0.5);
  const sw_vec middle = sw_pose_point(*pose, sw_scale(sw_add(b.max, b.min), 0.5));
  const sw_vec ex = sw_rotate(pose->q, sw_v(half.x, 0, 0));
  const sw_vec ey = sw_rotate(pose->q, sw_v(0, half.y, 0));
  const sw_vec ez = sw_rotate(pose->q, sw_v(0, 0, half.z));
  const sw_vec reach =
      sw_v(fabs(ex.x) + fabs(ey.x) + fabs(ez.x), fabs(ex.y) + fabs(ey.y) + fabs(ez.y),
           fabs(ex.z) + fabs(ey.z) + fabs(ez.z));
  return (sw_bounds){sw_sub(middle, reach), sw_add(middle, reach)};
}

static int outside(const sw_bounds *b, sw_vec low, sw_vec high) {
  return low.x > b->max.x || high.x < b->min.x || low.y > b->max.y || high.y < b->min.y ||
         low.z > b->max.z || high.z < b->min.z;
}

static sw_vec low_of(sw_vec a, sw_vec b) {
  return sw_v(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z));
}
static sw_vec high_of(sw_vec a, sw_vec b) {
  return sw_v(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z));
}

double sw_flight_reserve(const sw_contact *c, const sw_system *s, sw_vec v) {
  const double g = sw_norm(sw_load(s->gravity));
  const double reserve = 1.5, least = 1e-4; /* [-], [m] */
  return reserve * c->h * (sw_norm(v) + g * c->h) + least;
}

/* Widest gap at the step's start that can close within it, with reserve. */
static double reach_of(const sw_contact *c, const sw_system *s, const sw_body *b, size_t node,
                       size_t o) {
  if (c->regime == SW_CONTACT_STATIC)
    return b->plan->length + (b->plan->web ? 2.0 * b->plan->beam.radius : 0.0);
  const sw_vec x = sw_load(s->x + 3 * node);
  const double wall = sw_norm(sw_obstacle_velocity(&c->start[o], x)) * c->h;
  const double skin = 1.5; /* of the radius: what is this near is always looked at [-] */
  return b->plan->beam.radius * skin + wall +
         c->widening * sw_flight_reserve(c, s, sw_load(s->v + 3 * node));
}

static sw_status add_candidate(sw_contact *c, const sw_body *b, size_t body, size_t node,
                               size_t other, int o, int segment) {
  SW_TRY(sw_grow((void **)&c->candidates, &c->candidate_capacity, c->candidate_count + 1,
                 sizeof *c->candidates));
  c->candidates[c->candidate_count++] =
      (sw_candidate){.obstacle = o,
                     .segment = segment,
                     .node = node,
                     .other = other,
                     .body = body,
                     .radius = b->plan->beam.radius,
                     .skin = sw_plan_skin(b->plan, node - b->first_node),
                     .mass = b->plan->lumped[node - b->first_node]};
  return SW_OK;
}

/* The other end of segment number k (from 1) that starts at node i, or i: there is none. */
static size_t other_end(const sw_plan *p, size_t i, int k) {
  const sw_web *w = p->web;
  if (!w) return k == 1 && i + 1 < p->nodes ? i + 1 : i;
  const size_t at = w->side_first[i] + (size_t)k - 1;
  return at < w->side_first[i + 1] ? w->side[at] : i;
}

static sw_status segment_candidates(sw_contact *c, const sw_system *s, size_t body, size_t i,
                                    size_t o, double reach) {
  const sw_body *b = &s->bodies[body];
  const size_t node = b->first_node + i;
  const sw_vec x = sw_load(s->x + 3 * node);
  for (int k = 1; other_end(b->plan, i, k) != i; k++) {
    const size_t other = b->first_node + other_end(b->plan, i, k);
    const sw_vec y = sw_load(s->x + 3 * other);
    const double wide = fmax(reach, reach_of(c, s, b, other, o));
    const sw_vec w = sw_v(wide, wide, wide);
    if (!outside(&c->bounds[o], sw_sub(low_of(x, y), w), sw_add(high_of(x, y), w)))
      SW_TRY(add_candidate(c, b, body, node, other, (int)o, k));
  }
  return SW_OK;
}

/* Pads are met by particles alone where these lie close enough: between them the pad's edges would
 * come and go along one edge of the surface after the other, and take its force to and fro. */
static const double CLOSE = 3.0; /* rings along the pad's face, its x and z [-] */

static void find_dense(sw_contact *c, const sw_plan *p) {
  double widest = 0;
  const int rings = p->web && p->web->per_ring;
  for (size_t i = 0; rings && i < p->nodes; i++) widest = fmax(widest, p->web->along[i]);
  for (size_t o = 0; o < c->count; o++) {
    const sw_bounds b = sw_shape_bounds(c->obstacles[o].shape);
    const sw_vec size = sw_sub(b.max, b.min);
    c->dense[o] = rings && c->obstacles[o].grips > 0 && fmin(size.x, size.z) > CLOSE * widest;
  }
}

static sw_status node_candidates(sw_contact *c, const sw_system *s, size_t body, size_t i) {
  const sw_body *b = &s->bodies[body];
  const size_t node = b->first_node + i;
  const sw_vec x = sw_load(s->x + 3 * node);
  for (size_t o = 0; o < c->count; o++) {
    const double reach = reach_of(c, s, b, node, o);
    const sw_vec r = sw_v(reach, reach, reach);
    sw_closest near;
    if (c->obstacles[o].off) continue;
    if (!outside(&c->bounds[o], sw_sub(x, r), sw_add(x, r)) &&
        sw_shape_point(c->obstacles[o].shape, sw_pose_local(c->start[o].pose, x), reach, &near))
      SW_TRY(add_candidate(c, b, body, node, node, (int)o, 0));
    if (!c->flat[o] && !c->dense[o]) SW_TRY(segment_candidates(c, s, body, i, o, reach));
  }
  return SW_OK;
}

/* Order of candidates and memory: node, then obstacle, then inside of segment. */
static int before(const sw_contact *c, const sw_memory *m, const sw_candidate *k) {
  if (m->node != k->node) return m->node < k->node;
  const int id = c->obstacles[k->obstacle].id;
  if (m->obstacle != id) return m->obstacle < id;
  return m->segment < k->segment;
}

static void match_memory(sw_contact *c) {
  size_t m = 0;
  for (size_t i = 0; i < c->candidate_count; i++) {
    sw_candidate *k = &c->candidates[i];
    while (m < c->memory_count && before(c, &c->memory[m], k)) m++;
    k->memory = m;
    const int id = c->obstacles[k->obstacle].id;
    while (m < c->memory_count && c->memory[m].node == k->node && c->memory[m].obstacle == id &&
           c->memory[m].segment == k->segment)
      m++;
    k->memory_end = m;
    k->last = k->last_end = 0;
  }
}

void sw_contact_stiffness(sw_contact_regime regime, double force, double nominal, double *base,
                          double *rate2) {
  *base = force / ALLOWED_PENETRATION;
  *rate2 = 0;
  if (regime == SW_CONTACT_IMPLICIT)
    *rate2 = IMPLICIT_SHARE / (STAGE_SHARE * STAGE_SHARE * nominal * nominal);
  if (regime == SW_CONTACT_EXPLICIT) {
    *base = 0;
    *rate2 = EXPLICIT_SHARE / (nominal * nominal);
  }
}

/* Touches of an object of particles are at least as stiff as this share of a bound on what holds
 * a particle: it may be without weight [-]. */
static const double HARD_SHARE = 1.0;

/* A mesh shorter than so many radii is a slice, there for its section, which does not bend [-]. Its
 * touches are so many times as stiff as a solid section of its EA is against squeezing [-]. */
static const double SLICE = 1.0, HARDER = 100.0;
/* Of a ring with a wall: as its wall times length over radius^3 [-]. */
static const double HARDER_WALL = 1e5;

/* Force that a touch is to carry of the body [N]. */
static double usual_force(const sw_plan *p, double weight) {
  const double L = p->length, r = p->beam.radius;
  if (!p->web || L >= SLICE * r) return fmax(weight, p->beam.EI / (L * L));
  const double solid = HARDER * p->beam.EA * L / (PI * r * r);
  const double ring = HARDER_WALL * p->web->wall * L / (r * r * r);
  return fmax(weight, ALLOWED_PENETRATION * (ring > 0 ? ring : solid));
}

/* Stiffness of a wire's new touches: for its weight or for what bends it. */
/* Line stiffness of one side of a round section between plates, of its mean modulus: a solid
 * cylinder has F/(E R) = 0.084 at an approach of a tenth of its diameter (plane strain, finite
 * elements) [-]. */
static const double SECTION = 2.0 * 0.084 / 0.2;

/* A pad on a wire without a section: as soft as the section would be, and not stiffer than its
 * force needs. Rigid against rigid, no force could be set [N/m]. */
static double pad_stiffness(const sw_plan *p, double grips) {
  const double r = p->beam.radius, length = p->length / (double)p->edges;
  return fmin(SECTION * p->beam.EA / (PI * r * r) * length, grips / ALLOWED_PENETRATION);
}

static void set_stiffness(sw_contact *c, const sw_system *s, size_t body, size_t first) {
  const sw_plan *p = s->bodies[body].plan;
  const double L = p->length, weight = p->beam.mass * L * sw_norm(sw_load(s->gravity));
  double base, rate2;
  sw_contact_stiffness(c->regime, usual_force(p, weight), c->nominal, &base, &rate2);
  if (p->web && !p->web->per_ring && c->regime != SW_CONTACT_EXPLICIT)
    rate2 = fmax(rate2, HARD_SHARE * 0.5 * (p->web->rate2 + p->web->solid_rate2));
  for (size_t i = first; i < c->candidate_count; i++) {
    sw_candidate *k = &c->candidates[i];
    const double grips = c->obstacles[k->obstacle].grips;
    k->usual = fmax(base, rate2 * k->mass);
    k->given = grips > 0 && !p->web && c->regime != SW_CONTACT_EXPLICIT;
    if (k->given) k->usual = pad_stiffness(p, grips);
  }
}

sw_status sw_contact_find_candidates(sw_contact *c, sw_system *s, sw_error *err) {
  sw_bounds *bounds = c->bounds;
  sw_status status = SW_OK;
  c->candidate_count = c->touch_count = c->last_count = 0;
  c->unmarked = 1;
  for (size_t o = 0; o < c->count; o++)
    bounds[o] = world_bounds(c->obstacles[o].shape, &c->start[o].pose);
  for (size_t b = 0; b < s->body_count && status == SW_OK; b++) {
    const size_t first = c->candidate_count;
    const sw_web *web = s->bodies[b].plan->web;
    find_dense(c, s->bodies[b].plan);
    for (size_t i = 0; i < s->bodies[b].plan->nodes && status == SW_OK; i++)
      if (!web || web->outer[i]) status = node_candidates(c, s, b, i);
    set_stiffness(c, s, b, first);
  }
  if (status != SW_OK) return sw_fail(err, status, "contact: out of memory");
  match_memory(c);
  return SW_OK;
}

sw_status sw_contact_begin_step(sw_contact *c, sw_system *s, sw_contact_regime regime, double t,
                                double h, double nominal, sw_error *err) {
  c->time = t;
  c->h = h;
  c->nominal = nominal;
  c->regime = regime;
  c->barrier_count = c->impact_count = c->pressed_count = 0;
  c->plastic = 0;
  c->widening = 1.0;
  SW_TRY(place_all(c, t, c->start, err));
  return sw_contact_find_candidates(c, s, err);
}

sw_status sw_contact_begin_look(sw_contact *c, sw_system *s, double t, sw_error *err) {
  SW_TRY(sw_contact_begin_step(c, s, SW_CONTACT_STATIC, t, 0, 0, err));
  for (size_t i = 0; i < c->memory_count; i++) {
    sw_memory *m = &c->memory[i];
    if (m->normal_force > 0 && m->depth > 0) m->k = m->normal_force / m->depth;
  }
  return SW_OK;
}

sw_status sw_contact_begin_stage(void *contact, sw_system *s, double time, double hbar,
                                 const double *y, sw_error *err) {
  sw_contact *c = contact;
  (void)s, (void)hbar, (void)y;
  c->pressed_before = c->pressed_count;
  c->stage_time = time;
  c->updates = c->looked = 0;
  return place_all(c, time, c->now, err);
}

int sw_contact_moves(const sw_contact *c) {
  for (size_t o = 0; o < c->count; o++) {
    const sw_pose *a = &c->start[o].pose, *b = &c->now[o].pose;
    const sw_quat p = a->q, q = b->q;
    if (sw_dist(a->p, b->p) > 0 || p.w != q.w || p.x != q.x || p.y != q.y || p.z != q.z) return 1;
  }
  return 0;
}

/* --- memory ------------------------------------------------------------------- */

static sw_status remember(sw_contact *c, const sw_touch *t) {
  const sw_contact_at *o = &c->now[t->obstacle];
  const sw_quat back = sw_quat_conj(o->pose.q);
  SW_TRY(sw_grow((void **)&c->next_memory, &c->next_capacity, c->next_count + 1,
                 sizeof *c->next_memory));
  sw_memory *m = &c->next_memory[c->next_count++];
  *m = (sw_memory){.obstacle = c->obstacles[t->obstacle].id,
                   .segment = t->segment,
                   .node = t->node,
                   .feature = t->feature,
                   .at = t->at,
                   .normal_force = t->press.normal_force,
                   .sliding = t->press.next_sliding,
                   .depth = t->press.normal_force / t->press.k,
                   .k = sw_press_eased(&t->press, c->candidates[t->candidate].usual, t->stiffer),
                   .normal = sw_rotate(back, t->press.normal),
                   .point = t->local};
  if (!(t->press.normal_force > 0)) return SW_OK;
  m->slid = t->slid + sw_norm(t->press.slip);
  m->elastic = sw_rotate(back, sw_scale(t->press.tangential, -1.0 / sw_press_grip(&t->press)));
  return SW_OK;
}

void sw_contact_commit(sw_contact *c, sw_system *s) {
  (void)s;
  c->next_count = 0;
  c->fresh = 0;
  for (size_t i = 0; i < c->touch_count; i++)
    if (remember(c, &c->touches[i]) != SW_OK) break; /* a lost anchor only starts anew */
  sw_memory *swap = c->memory;
  const size_t capacity = c->memory_capacity;
  c->memory = c->next_memory, c->memory_capacity = c->next_capacity;
  c->next_memory = swap, c->next_capacity = capacity;
  c->memory_count = c->next_count;
}

const void *sw_contact_memory(const sw_contact *c, size_t *bytes) {
  *bytes = c->memory_count * sizeof *c->memory;
  return c->memory;
}

int sw_contact_is_fresh(const sw_contact *c) { return c->fresh; }

sw_status sw_contact_set_memory(sw_contact *c, const void *memory, size_t bytes, int fresh) {
  const size_t n = bytes / sizeof *c->memory;
  SW_TRY(sw_grow((void **)&c->memory, &c->memory_capacity, n, sizeof *c->memory));
  if (n) memcpy(c->memory, memory, bytes);
  c->memory_count = n;
  c->fresh = fresh;
  c->touch_count = 0;
  return SW_OK;
}

size_t sw_contact_layout(void) { return 4096 * sizeof(sw_memory) + sizeof(sw_touch); }

const void *sw_contact_seen(const sw_contact *c, size_t *bytes) {
  *bytes = c->touch_count * sizeof *c->touches;
  return c->touches;
}

sw_status sw_contact_set_seen(sw_contact *c, const void *seen, size_t bytes, size_t nodes) {
  const size_t n = bytes / sizeof *c->touches;
  c->touch_count = 0;
  if (bytes % sizeof *c->touches != 0) return SW_EINVAL;
  SW_TRY(sw_grow((void **)&c->touches, &c->touch_capacity, n, sizeof *c->touches));
  if (n) memcpy(c->touches, seen, bytes);
  for (size_t i = 0; i < n; i++) {
    const sw_touch *t = &c->touches[i];
    if (t->obstacle < 0 || (size_t)t->obstacle >= c->count || t->node >= nodes || t->other >= nodes)
      return SW_EINVAL;
  }
  c->touch_count = n;
  return SW_OK;
}

int sw_contact_memory_fits(const void *memory, size_t bytes, size_t nodes, size_t obstacles) {
  const size_t count = bytes / sizeof(sw_memory);
  for (size_t i = 0; i < count; i++) {
    sw_memory m;
    memcpy(&m, (const char *)memory + i * sizeof m, sizeof m);
    if (m.node >= nodes || m.obstacle < 0 || (size_t)m.obstacle >= obstacles || m.segment < 0 ||
        !isfinite(m.at))
      return 0;
  }
  return bytes % sizeof(sw_memory) == 0;
}

sw_status sw_contact_inherit(sw_contact *c, const void *memory, size_t bytes, int fresh,
                             const size_t *new_node) {
  size_t kept = 0;
  SW_TRY(sw_contact_set_memory(c, memory, bytes, fresh));
  for (size_t i = 0; i < c->memory_count; i++) {
    const size_t node = new_node[c->memory[i].node];
    if (node == SIZE_MAX) continue;
    c->memory[kept] = c->memory[i];
    c->memory[kept++].node = node;
  }
  c->memory_count = kept;
  return SW_OK;
}

static int in_order(const void *a, const void *b) {
  const sw_memory *p = a, *q = b;
  if (p->node != q->node) return p->node < q->node ? -1 : 1;
  if (p->obstacle != q->obstacle) return p->obstacle < q->obstacle ? -1 : 1;
  if (p->segment != q->segment) return p->segment < q->segment ? -1 : 1;
  return (p->at > q->at) - (p->at < q->at);
}

sw_status sw_contact_add_memory(sw_contact *c, const void *memory, size_t bytes, size_t old_first,
                                size_t old_end, size_t new_first, const size_t *obstacles,
                                size_t count) {
  const sw_memory *from = memory;
  const size_t n = bytes / sizeof *from;
  SW_TRY(sw_grow((void **)&c->memory, &c->memory_capacity, c->memory_count + n, sizeof *c->memory));
  for (size_t i = 0; i < n; i++) {
    int wanted = 0;
    for (size_t k = 0; k < count; k++) wanted |= (size_t)from[i].obstacle == obstacles[k];
    if (!wanted || from[i].node < old_first || from[i].node >= old_end) continue;
    c->memory[c->memory_count] = from[i];
    c->memory[c->memory_count++].node += new_first - old_first;
  }
  if (c->memory_count) qsort(c->memory, c->memory_count, sizeof *c->memory, in_order);
  c->fresh = 0;
  return SW_OK;
}

/* --- read-outs ---------------------------------------------------------------- */

void sw_contact_force(const sw_contact *c, int id, sw_vec about, sw_vec *force, sw_vec *moment) {
  *force = *moment = sw_v(0, 0, 0);
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    if (c->obstacles[t->obstacle].id != id || !(t->press.normal_force > 0)) continue;
    const sw_vec f = sw_neg(sw_madd(t->press.tangential, t->press.normal, t->press.normal_force));
    *force = sw_add(*force, f);
    *moment = sw_add(*moment, sw_cross(sw_sub(t->point, about), f));
  }
}

static double place_of(const sw_system *s, const sw_touch *t) {
  const sw_body *b = &s->bodies[t->body];
  const sw_plan *p = b->plan;
  const size_t a = t->node - b->first_node, e = t->other - b->first_node;
  const double *arc = p->web ? p->web->s : p->s;
  return arc[a] + t->at * (arc[e] - arc[a]) - (p->web ? 0.0 : arc[0]);
}

void sw_contact_add_grip(const sw_contact *c, const sw_system *s, int id, sw_contact_grip *sum) {
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    const double N = t->press.normal_force;
    if (c->obstacles[t->obstacle].id != id || !(N > 0)) continue;
    sum->normal += N;
    sum->most += t->friction * N;
    sum->tangent = sw_add(sum->tangent, t->press.tangential);
    sum->slip = sw_madd(sum->slip, t->press.slip, N);
    sum->sliding += t->press.next_sliding ? N : 0.0;
    sum->place += N * place_of(s, t);
  }
}

double sw_contact_penetration(const sw_contact *c, size_t *node) {
  double deepest = 0;
  for (size_t i = 0; i < c->touch_count; i++) {
    const double depth = c->touches[i].forgiven - c->touches[i].press.gap_after;
    if (depth <= deepest) continue;
    deepest = depth;
    if (node) *node = c->touches[i].node;
  }
  return deepest;
}

size_t sw_contact_count(const sw_contact *c) {
  size_t n = 0;
  for (size_t i = 0; i < c->touch_count; i++) n += c->touches[i].press.normal_force > 0;
  return n;
}

size_t sw_contact_touches(const sw_contact *c) { return c->touch_count; }

int sw_contact_push_at(const sw_contact *c, const sw_system *s, size_t k, sw_contact_push *out) {
  const sw_touch *t = &c->touches[k];
  const sw_press *p = &t->press;
  *out = (sw_contact_push){.obstacle = c->obstacles[t->obstacle].id,
                           .node = t->node,
                           .other = t->other,
                           .at = t->at,
                           .normal_force = p->normal_force,
                           .point = t->point,
                           .place = place_of(s, t),
                           .slid = t->slid + sw_norm(p->slip),
                           .force = sw_madd(p->tangential, p->normal, p->normal_force)};
  return p->normal_force > 0;
}

double sw_contact_energy(const sw_contact *c) {
  double sum = 0;
  for (size_t i = 0; i < c->touch_count; i++) {
    const sw_touch *t = &c->touches[i];
    if (!(t->press.normal_force > 0)) continue;
    sum += 0.5 * t->press.normal_force * t->press.normal_force / t->press.k;
    sum += 0.5 * sw_norm2(t->press.tangential) / sw_press_grip(&t->press);
  }
  return sum;
}
