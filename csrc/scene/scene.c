/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Life of a scene and of what is in it. */
#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "scene/world.h"

static const sw_param scene_rows[] = {
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_scene_args, name),
     "name used in messages and files"},
    {"gravity", SW_PARAM_VECTOR, "m/s2", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_scene_args, gravity), "gravity (default {0, 0, -9.81})"},
};
const sw_params sw_scene_params = SW_PARAMS("scene", scene_rows);

static const double STANDARD_GRAVITY = 9.81; /* [m/s2] */

sw_status sw_scene_new(const sw_scene_args *args, sw_scene **out, sw_error *err) {
  sw_scene *s = sw_alloc(1, sizeof *s);
  if (!s) return sw_fail(err, SW_ENOMEM, "scene: out of memory");
  memcpy(s->name, args->name[0] ? args->name : "scene", args->name[0] ? sizeof s->name : 6);
  s->gravity = isnan(args->gravity.x) ? sw_v(0, 0, -STANDARD_GRAVITY) : args->gravity;
  *out = s;
  return SW_OK;
}

void sw_scene_clear_hold(sw_scene_hold *h) {
  sw_free(h->s);
  sw_free(h->local);
  sw_free(h->particle);
  sw_free(h->log.rows);
  sw_drive_free(&h->drive);
  sw_motion_release(h->feed.motion);
  sw_mesh_free(&h->feed.shape);
}

void sw_scene_clear_obstacle(sw_scene_obstacle *o) {
  sw_shape_release(o->shape);
  sw_drive_free(&o->drive);
  sw_free(o->log.rows);
}

void sw_scene_free(sw_scene *s) {
  if (!s) return;
  for (size_t i = 0; i < s->wire_count; i++) sw_scene_clear_body(&s->wires[i]);
  for (size_t i = 0; i < s->force_count; i++) sw_scene_clear_force(&s->forces[i]);
  for (size_t i = 0; i < s->hold_count; i++) sw_scene_clear_hold(&s->holds[i]);
  for (size_t i = 0; i < s->obstacle_count; i++) sw_scene_clear_obstacle(&s->obstacles[i]);
  sw_scene_orphan_snapshots(s);
  sw_stepper_free(&s->stepper);
  sw_contact_free(s->contact);
  sw_pairs_free(s->pairs);
  sw_crowd_free(s->crowd);
  sw_scene_drop_rules(s, 0);
  sw_free(s->rules);
  sw_system_free(&s->system);
  sw_scene_forget_contact(s);
  sw_scene_forget_histories(s);
  sw_scene_drop_frames(s);
  sw_free(s->frames);
  sw_free(s->hold_slot);
  sw_free(s->wires);
  sw_free(s->holds);
  sw_free(s->obstacles);
  sw_free(s->forces);
  sw_free(s->joins);
  sw_free(s);
}

const char *sw_scene_name(const sw_scene *s) { return s->name; }
double sw_scene_time(const sw_scene *s) { return s->time; }
sw_vec sw_scene_gravity(const sw_scene *s) { return s->gravity; }
sw_status sw_scene_set_gravity(sw_scene *s, sw_vec gravity, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  s->gravity = gravity;
  s->discontinuous = 1;
  return SW_OK;
}

sw_status sw_scene_readable(const sw_scene *s, sw_error *err) {
  if (!s->diverged) return SW_OK;
  return sw_fail(err, SW_EDIVERGED,
                 "scene '%s': the last run diverged (%.300s); its numbers mean nothing, restore a "
                 "snapshot or build the scene anew",
                 s->name, s->why.text);
}

int sw_scene_busy(const sw_scene *s) { return s->running > 0; }

sw_status sw_scene_editable(const sw_scene *s, sw_error *err) {
  if (s->running)
    return sw_fail(err, SW_EBUSY,
                   "scene '%s' cannot be changed or measured from inside a step or a function of "
                   "time",
                   s->name);
  return SW_OK;
}

sw_scene_wire *sw_scene_find_body(const sw_scene *s, sw_handle h, sw_error *err) {
  if (h.slot < s->wire_count && s->wires[h.slot].generation == h.generation)
    return &s->wires[h.slot];
  sw_fail(err, SW_EDEAD, "this object is not of scene '%s' any more", s->name);
  return NULL;
}

sw_scene_wire *sw_scene_find_wire(const sw_scene *s, sw_handle h, sw_error *err) {
  sw_scene_wire *w = sw_scene_find_body(s, h, err);
  if (!w || !sw_scene_is_loose(w)) return w;
  sw_fail(err, SW_EINVAL, "'%s' is an object of particles, not a wire", w->name);
  return NULL;
}

sw_scene_hold *sw_scene_find_hold(const sw_scene *s, sw_handle h, sw_error *err) {
  if (h.slot < s->hold_count && s->holds[h.slot].generation == h.generation)
    return &s->holds[h.slot];
  sw_fail(err, SW_EDEAD, "this clamp is not of scene '%s' any more", s->name);
  return NULL;
}

sw_scene_obstacle *sw_scene_find_obstacle(const sw_scene *s, sw_handle h, sw_error *err) {
  if (h.slot < s->obstacle_count && s->obstacles[h.slot].generation == h.generation &&
      s->obstacles[h.slot].alive)
    return &s->obstacles[h.slot];
  sw_fail(err, SW_EDEAD, "this obstacle is not of scene '%s' any more", s->name);
  return NULL;
}

const char *sw_scene_wire_name(const sw_scene *s, sw_handle h) {
  const sw_scene_wire *w = sw_scene_find_body(s, h, NULL);
  return w ? w->name : NULL;
}

const char *sw_scene_hold_name(const sw_scene *s, sw_handle h, const char **kind, int *held) {
  const sw_scene_hold *hold = sw_scene_find_hold(s, h, NULL);
  if (!hold) return NULL;
  *kind = hold->cls->name;
  *held = hold->alive;
  return hold->name;
}

const char *sw_scene_obstacle_name(const sw_scene *s, sw_handle h, const char **kind,
                                   int *present) {
  if (h.slot >= s->obstacle_count || s->obstacles[h.slot].generation != h.generation) return NULL;
  *kind = sw_shape_kind(s->obstacles[h.slot].shape);
  *present = s->obstacles[h.slot].alive;
  return s->obstacles[h.slot].name;
}

/* A name for an unnamed object: "wire1", "box2", ... */
void sw_scene_give_name(char *out, const char *wanted, const char *kind, size_t number) {
  if (wanted[0])
    memcpy(out, wanted, SW_NAME_SIZE);
  else
    snprintf(out, SW_NAME_SIZE, "%s%zu", kind, number + 1);
}

/* --- wires ------------------------------------------------------------------ */

static const char *const rest_names[] = {"straight", "path", NULL};

static const sw_param wire_rows[] = {
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_wire_args, name),
     "name used in messages and series"},
    {"model", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "wire model: 'rod' (default), 'string', or a mesh: 'tube', 'radial', 'cubic', 'composite'"},
    {"from", SW_PARAM_VECTOR, "m", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(sw_wire_args, from),
     "start of a straight wire (s = 0)"},
    {"to", SW_PARAM_VECTOR, "m", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(sw_wire_args, to),
     "end of a straight wire"},
    {"path", SW_PARAM_OTHER, "m", 0, 0, 0, 0, NULL, 0,
     "list of points the wire lies along, instead of from and to"},
    {"segments", SW_PARAM_INTEGER, "-", 0, 0, 1e7, 0, NULL, offsetof(sw_wire_args, segments),
     "number of segments, 2 or more (default 50; of a mesh slices, as many as their spacing "
     "gives)"},
    {"rest", SW_PARAM_CHOICE, "-", 0, 0, 0, 0, rest_names, offsetof(sw_wire_args, rest),
     "shape without load: 'straight' or as 'path' has it"},
    {"normal", SW_PARAM_VECTOR, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_wire_args, normal),
     "with EI = {EI1, EI2}: bending in the plane of the wire and this has EI1"},
    {"rolls", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(sw_wire_args, rolls),
     "true: friction also turns the wire about its axis, so that it rolls and is twisted"},
    {"rest_twist", SW_PARAM_NUMBER, "rad/m", 0, -1e6, 1e6, 0, NULL,
     offsetof(sw_wire_args, rest_twist), "twist without load; it is drawn untwisted"},
};
const sw_params sw_wire_params = SW_PARAMS("wire", wire_rows);

static const char *const body_names[] = {"springs", "solid", NULL};
#define AT(member) offsetof(sw_wire_mesh_args, member)
static const sw_param mesh_rows[] = {
    {"spacing", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(spacing),
     "of a mesh's slices along the wire (chosen when not given); the length is an even number of "
     "them"},
    {"squeeze", SW_PARAM_NUMBER, "Pa", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(squeeze),
     "stiffness of the section: line force of two plates on opposite sides over their approach "
     "(not given: as the springs come out)"},
    {"wall", SW_PARAM_NUMBER, "N m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(wall),
     "of a tube with core = false: bending stiffness of its wall per length, E t^3 / (12 (1 - "
     "nu^2)), against flattening and ovalisation; takes the place of chords (brace)"},
    {"body", SW_PARAM_CHOICE, "-", SW_BODY_SPRINGS, 0, 0, 0, body_names, AT(body),
     "springs between the particles, or solid elements of finite strain with nu"},
};
#undef AT
const sw_params sw_wire_mesh_params = SW_PARAMS("wire", mesh_rows);

enum { USUAL_SEGMENTS = 50 };

static const double SHORTEST_SEGMENT = 1e-9; /* of the wire's length [-] */

static sw_status check_mesh(const char *name, const sw_mesh *m, sw_error *err) {
  const double total = m->s[m->n - 1];
  if (!(total > 0) || !isfinite(total))
    return sw_fail(err, SW_EINVAL, "wire '%s': its points give a length of %g m", name, total);
  for (size_t i = 0; i + 1 < m->n; i++)
    if (!(m->s[i + 1] - m->s[i] > SHORTEST_SEGMENT * total))
      return sw_fail(err, SW_EINVAL, "wire '%s': the path turns back on itself near s = %g m", name,
                     m->s[i]);
  return SW_OK;
}

/* The normal must be across the wire where it starts. */
static const double LEAST_SINE = 1e-3; /* of the angle between both [-] */

static const double LARGEST_TWIST = 1.5; /* of a segment at rest, with frames [rad] */

/* A mesh of particles has its frames by itself. */
static sw_status check_mesh_frames(const sw_scene_wire *w, const sw_drawing *a, sw_error *err) {
  if (a->rolls)
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': rolls goes with model = 'rod'; a %s, whose surface is of particles, "
                   "rolls by itself",
                   w->name, w->cls->name);
  return SW_OK;
}

static sw_status add_frames(sw_scene_wire *w, sw_mesh *m, sw_error *err) {
  const int two = w->beam.EI_axis[0] != w->beam.EI_axis[1];
  const sw_drawing *a = &w->drawing;
  const sw_vec along = sw_unit_or(sw_sub(sw_load(m->x + 3), sw_load(m->x)), sw_v(1, 0, 0));
  const int given = isfinite(a->normal.x);
  w->beam.rolls = a->rolls;
  w->beam.curved = a->rest == SW_REST_PATH;
  w->beam.rest_twist = a->rest_twist;
  if (!w->beam.framed && !given && a->rest == SW_REST_STRAIGHT && a->rest_twist == 0 && !a->rolls)
    return SW_OK;
  if (w->cls->mesh) return check_mesh_frames(w, a, err);
  if (strcmp(w->cls->name, "rod") != 0)
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': rest, rest_twist, normal, rolls and two values of EI go with "
                   "model = 'rod'",
                   w->name);
  if (two && !given)
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': two values of EI need normal = {x, y, z}, the "
                   "direction in which the first one bends",
                   w->name);
  if (given && !(sw_norm(sw_cross(sw_unit_or(a->normal, along), along)) > LEAST_SINE))
    return sw_fail(err, SW_EINVAL, "wire '%s': normal must not be along the wire's start", w->name);
  w->beam.framed = w->beam.framed || a->rest == SW_REST_PATH || a->rolls;
  if (!w->beam.framed) return SW_OK; /* a normal that makes no difference */
  const double segment = m->s[m->n - 1] / (double)(m->n - 1);
  if (!(fabs(a->rest_twist) * segment < LARGEST_TWIST))
    return sw_fail(
        err, SW_EINVAL,
        "wire '%s': rest_twist = %g rad/m turns a segment of %.4g m by more than %g rad; "
        "it needs more segments",
        w->name, a->rest_twist, segment, LARGEST_TWIST);
  if (sw_mesh_add_frames(m, given ? a->normal : sw_perpendicular(along),
                         a->rest == SW_REST_STRAIGHT, a->rest_twist) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "wire '%s': out of memory", w->name);
  return SW_OK;
}

sw_status sw_scene_draw(sw_scene_wire *w, size_t segments, sw_mesh *out, sw_error *err) {
  const sw_drawing *d = &w->drawing;
  sw_status status = sw_mesh_along(out, d->points, d->count, segments);
  if (status == SW_OK) status = check_mesh(w->name, out, err);
  if (status == SW_OK) status = add_frames(w, out, err);
  if (status != SW_OK) {
    sw_mesh_free(out);
    return status;
  }
  out->EA = w->beam.EA;
  if (d->length > 0) out->scale = out->s[out->n - 1] / d->length;
  return SW_OK;
}

/* Keep what the wire is drawn along; frees nothing on failure. */
static sw_status keep_drawing(sw_scene_wire *w, const sw_wire_args *args, const double *points,
                              size_t count) {
  w->drawing = (sw_drawing){.count = count,
                            .normal = args->normal,
                            .rest = args->rest,
                            .rolls = args->rolls,
                            .rest_twist = args->rest_twist};
  w->drawing.points = sw_alloc(3 * count, sizeof *points);
  if (!w->drawing.points) return SW_ENOMEM;
  memcpy(w->drawing.points, points, 3 * count * sizeof *points);
  return SW_OK;
}

/* Can the force act on the wire? */
static sw_status check_wire(const sw_force_class *cls, const sw_scene_wire *w, const void *args,
                            sw_error *err) {
  sw_recipe recipe;
  int by_angle = 0;
  w->cls->recipe(&w->beam, &recipe);
  if ((cls->flags & SW_FORCE_AT_PLACE) && sw_scene_is_loose(w))
    return sw_fail(err, SW_EINVAL,
                   "force %s: '%s' is an object of particles, which has no arc length s; kind = "
                   "'push' takes particles",
                   cls->name, w->name);
  if ((cls->flags & SW_FORCE_OF_WEB) && !w->cls->mesh)
    return sw_fail(err, SW_EINVAL,
                   "force %s: wire '%s' is a %s; it goes with objects of particles and with models "
                   "that are meshes",
                   cls->name, w->name, w->cls->name);
  if (w->cls->mesh && !(cls->flags & SW_FORCE_ANY_BODY) && sw_scene_is_loose(w))
    return sw_fail(err, SW_EINVAL, "force %s: '%s' is an object of particles; it goes with wires",
                   cls->name, w->name);
  if (w->cls->mesh && !(cls->flags & SW_FORCE_ANY_BODY))
    return sw_fail(err, SW_EINVAL,
                   "force %s: wire '%s' is a %s, a mesh of particles, which it does not know; it "
                   "goes with model = 'rod'",
                   cls->name, w->name, w->cls->name);
  for (size_t k = 0; k < recipe.count; k++) by_angle |= strcmp(recipe.terms[k].force, "bend") == 0;
  if ((cls->flags & SW_FORCE_BY_ANGLE) && !by_angle)
    return sw_fail(err, SW_EINVAL,
                   "force %s: wire '%s' is a %s, whose bending it cannot correct; it goes with "
                   "model = 'rod'",
                   cls->name, w->name, w->cls->name);
  if (cls->commit && w->beam.framed)
    return sw_fail(err, SW_EINVAL,
                   "force %s: wire '%s' is curved at rest, has two values of EI or rolls, which it "
                   "does not know",
                   cls->name, w->name);
  return cls->check ? cls->check(args, &w->beam, err) : SW_OK;
}

sw_status sw_scene_check_line(const sw_scene_wire *w, const char *what, sw_error *err) {
  if (!w->cls->mesh) return SW_OK;
  if (sw_scene_is_loose(w))
    return sw_fail(err, SW_EINVAL, "%s: '%s' is an object of particles; it goes with wires only",
                   what, w->name);
  return sw_fail(err, SW_EINVAL,
                 "%s: wire '%s' is a %s, a mesh of particles; it goes with rods "
                 "and strings only",
                 what, w->name, w->cls->name);
}

/* The particles of a wire that is a mesh, along its drawing. */
static sw_status draw_strand(sw_scene_wire *w, const sw_wire_args *args,
                             const sw_wire_mesh_args *mesh, sw_error *err) {
  const sw_drawing *d = &w->drawing;
  const sw_strand_plan plan = {.name = w->name,
                               .mesh = w->cls->mesh,
                               .spacing = mesh->spacing,
                               .squeeze = mesh->squeeze,
                               .body = mesh->body,
                               .wall = mesh->wall,
                               .lattice = mesh->lattice,
                               .section = mesh->section,
                               .normal = d->normal,
                               .curved = d->rest == SW_REST_PATH,
                               .rest_twist = d->rest_twist};
  size_t slices = (size_t)args->segments;
  double length = 0;
  if (slices && !isnan(mesh->spacing))
    return sw_fail(err, SW_EINVAL, "wire '%s': give segments or spacing, not both", w->name);
  for (size_t i = 0; i + 1 < d->count; i++)
    length += sw_dist(sw_vec_at(d->points, i), sw_vec_at(d->points, i + 1));
  if (!slices) SW_TRY(sw_strand_slices(&plan, &w->beam, length, &slices, err));
  SW_TRY(sw_scene_draw(w, slices, &w->mesh, err));
  return sw_strand_new(&plan, &w->beam, &w->mesh, NULL, &w->strand, err);
}

sw_status sw_scene_check_rules(const sw_scene *s, size_t wire, const sw_scene_wire *as,
                               sw_error *err) {
  for (size_t k = 0; k < s->force_count; k++)
    if (s->forces[k].alive && (s->forces[k].wire < 0 || s->forces[k].wire == (long)wire))
      SW_TRY(check_wire(s->forces[k].cls, as, s->forces[k].args, err));
  for (size_t k = 0; k < s->rule_count; k++) {
    const sw_scene_rule *r = &s->rules[k];
    int mine = r->count == 0;
    for (size_t i = 0; i < r->count; i++) mine |= r->wires[i] == wire;
    if (mine && r->rule.on) SW_TRY(sw_scene_check_line(as, "scene:wire_contact", err));
  }
  return SW_OK;
}

void sw_scene_clear_body(sw_scene_wire *w) {
  sw_mesh_free(&w->mesh);
  sw_strand_free(&w->strand);
  sw_free(w->drawing.points);
  sw_free(w->twisted);
}

static sw_status draw_wire(sw_scene *s, sw_scene_wire *w, const sw_wire_args *args,
                           const sw_wire_mesh_args *mesh, sw_error *err) {
  const size_t segments = args->segments ? (size_t)args->segments : USUAL_SEGMENTS;
  if (args->segments == 1)
    return sw_fail(err, SW_EINVAL, "wire '%s': segments = 1 is not allowed; it must be 2 or more",
                   w->name);
  if (w->cls->mesh)
    SW_TRY(draw_strand(w, args, mesh, err));
  else
    SW_TRY(sw_scene_draw(w, segments, &w->mesh, err));
  if (!w->cls->mesh && args->rest_twist != 0 && sw_scene_draw_untwisted(w) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "wire '%s': out of memory", w->name);
  return sw_scene_check_rules(s, s->wire_count, w, err);
}

sw_status sw_scene_add_wire(sw_scene *s, const sw_wire_args *args, const sw_beam *beam,
                            const sw_wire_mesh_args *mesh, const double *points, size_t count,
                            sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  const double straight[6] = {args->from.x, args->from.y, args->from.z,
                              args->to.x,   args->to.y,   args->to.z};
  sw_scene_wire w = {.generation = s->serial + 1, .cls = sw_wire_all()[args->model], .beam = *beam};
  sw_scene_give_name(w.name, args->name, "wire", s->wire_count);
  if (!points && (isnan(args->from.x) || isnan(args->to.x)))
    return sw_fail(err, SW_EINVAL, "wire '%s': give from and to, or path [m]", w.name);
  if (points && count < 2)
    return sw_fail(err, SW_EINVAL, "wire '%s': path needs at least two points", w.name);
  SW_TRY(sw_scene_thaw(s));
  SW_TRY(sw_grow((void **)&s->wires, &s->wire_capacity, s->wire_count + 1, sizeof *s->wires));
  sw_status status = keep_drawing(&w, args, points ? points : straight, points ? count : 2);
  if (status == SW_OK) status = draw_wire(s, &w, args, mesh, err);
  if (status != SW_OK) {
    sw_scene_clear_body(&w);
    return status;
  }
  w.drawing.length = w.mesh.s[w.mesh.n - 1];
  *out = (sw_handle){(uint32_t)s->wire_count, ++s->serial};
  s->wires[s->wire_count++] = w;
  return SW_OK;
}

const sw_calibration *sw_scene_wire_calibration(const sw_scene *s, sw_handle h) {
  const sw_scene_wire *w = sw_scene_find_wire(s, h, NULL);
  return w && w->strand.kit ? &w->strand.kit->calibration : NULL;
}

const char *sw_scene_wire_model(const sw_scene *s, sw_handle h) {
  const sw_scene_wire *w = sw_scene_find_wire(s, h, NULL);
  return w ? w->cls->name : NULL;
}

/* --- obstacles -------------------------------------------------------------- */

static const sw_param obstacle_rows[] = {
    {"name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(sw_obstacle_args, name),
     "name used in messages and series"},
    {"at", SW_PARAM_VECTOR, "m", 0, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(sw_obstacle_args, at),
     "place of the shape's origin"},
    {"rotation", SW_PARAM_ROTATION, "rad", 0, 0, 0, 0, NULL, offsetof(sw_obstacle_args, rotation),
     "turn of the shape: { axis = {x, y, z}, angle = } or quaternion {w, x, y, z}"},
    {"friction", SW_PARAM_NUMBER, "-", 0.3, 0, 100, 0, NULL, offsetof(sw_obstacle_args, friction),
     "Coulomb friction coefficient"},
    {"restitution", SW_PARAM_NUMBER, "-", 0, 0, 1, 0, NULL, offsetof(sw_obstacle_args, restitution),
     "share of the approach speed kept in an impact"},
};
const sw_params sw_obstacle_params = SW_PARAMS("obstacle", obstacle_rows);

sw_status sw_scene_add_obstacle(sw_scene *s, sw_shape *shape, const sw_obstacle_args *args,
                                sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_scene_thaw(s));
  SW_TRY(sw_grow((void **)&s->obstacles, &s->obstacle_capacity, s->obstacle_count + 1,
                 sizeof *s->obstacles));
  sw_scene_obstacle *o = &s->obstacles[s->obstacle_count];
  *o = (sw_scene_obstacle){.generation = ++s->serial,
                           .alive = 1,
                           .drive = {.pose = {args->at, args->rotation}},
                           .friction = args->friction,
                           .restitution = args->restitution};
  sw_scene_give_name(o->name, args->name, sw_shape_kind(shape), s->obstacle_count);
  o->shape = sw_shape_retain(shape);
  *out = (sw_handle){(uint32_t)s->obstacle_count++, s->serial};
  return SW_OK;
}

sw_status sw_scene_remove_obstacle(sw_scene *s, sw_handle obstacle, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_scene_thaw(s));
  o->alive = 0;
  return SW_OK;
}

sw_status sw_scene_obstacle_follow(sw_scene *s, sw_handle obstacle, sw_motion *motion, int relative,
                                   sw_error *err) {
  sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(sw_drive_follow(s, &o->drive, o->name, motion, relative, err));
  s->discontinuous = 1;
  return SW_OK;
}

sw_status sw_scene_obstacle_pose(sw_scene *s, sw_handle obstacle, sw_pose *out, sw_error *err) {
  sw_motion_state now;
  const sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_drive_eval(s, &o->drive, s->time, &now, err));
  *out = now.pose;
  return SW_OK;
}

sw_status sw_scene_obstacle_shape(sw_scene *s, sw_handle obstacle, sw_shape **out, sw_error *err) {
  const sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  *out = o->shape;
  return SW_OK;
}

sw_status sw_scene_obstacle_set_pose(sw_scene *s, sw_handle obstacle, sw_pose pose, sw_error *err) {
  sw_scene_obstacle *o = sw_scene_find_obstacle(s, obstacle, err);
  if (!o) return SW_EDEAD;
  SW_TRY(sw_scene_editable(s, err));
  sw_drive_free(&o->drive);
  o->drive.pose = pose;
  s->discontinuous = 1;
  return SW_OK;
}

sw_status sw_scene_obstacle_force(sw_scene *s, sw_handle obstacle, sw_vec about, sw_vec *force,
                                  sw_vec *moment, sw_error *err) {
  if (!sw_scene_find_obstacle(s, obstacle, err)) return SW_EDEAD;
  SW_TRY(sw_scene_readable(s, err));
  *force = *moment = sw_v(0, 0, 0);
  if (s->contact) sw_contact_force(s->contact, (int)obstacle.slot, about, force, moment);
  return SW_OK;
}

/* --- forces ----------------------------------------------------------------- */

static sw_status check_force(const sw_scene *s, const sw_force_class *cls, sw_handle wire,
                             const void *args, sw_error *err) {
  for (size_t w = 0; w < s->wire_count; w++)
    if (!wire.generation || w == wire.slot) SW_TRY(check_wire(cls, &s->wires[w], args, err));
  return SW_OK;
}

void sw_scene_clear_force(sw_scene_force *f) { sw_free(f->particle); }

static sw_status check_some(const sw_force_class *cls, const sw_scene_wire *w,
                            const sw_force_some *some, sw_error *err) {
  if (!w) return sw_fail(err, SW_EINVAL, "force %s: on is required: the object", cls->name);
  if (!some->count)
    return sw_fail(err, SW_EINVAL, "force %s: particles of '%s': none", cls->name, w->name);
  for (size_t i = 0; i < some->count; i++)
    if (some->particle[i] >= w->strand.web->particles)
      return sw_fail(err, SW_EINVAL, "force %s: '%s' has no particle %lu; it has %zu, from 1 on",
                     cls->name, w->name, (unsigned long)some->particle[i] + 1,
                     w->strand.web->particles);
  return SW_OK;
}

/* The scene's own list instead of the caller's. SW_ENOMEM. */
static sw_status own_list(sw_scene_force *f) {
  sw_force_some some;
  memcpy(&some, f->args, sizeof some);
  f->particle = sw_alloc(some.count, sizeof *f->particle);
  if (!f->particle) return SW_ENOMEM;
  memcpy(f->particle, some.particle, some.count * sizeof *f->particle);
  some.particle = f->particle;
  memcpy(f->args, &some, sizeof some);
  return SW_OK;
}

sw_status sw_scene_add_force(sw_scene *s, const sw_force_class *cls, sw_handle wire,
                             const void *args, size_t args_size, sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  const sw_scene_wire *w = wire.generation ? sw_scene_find_body(s, wire, err) : NULL;
  if (wire.generation && !w) return SW_EDEAD;
  if (args_size > SW_FORCE_ARGS_MAX) return sw_fail(err, SW_ELIMIT, "force: too many arguments");
  if (cls->flags & SW_FORCE_AT_PLACE) {
    double at;
    memcpy(&at, args, sizeof at); /* by contract the first member is s */
    if (!w) return sw_fail(err, SW_EINVAL, "force %s: on is required: the wire", cls->name);
    const double length = w->mesh.s[w->mesh.n - 1] - w->mesh.s[0];
    if (at > length * (1 + 1e-12))
      return sw_fail(err, SW_EINVAL, "force %s: s = %g m is beyond the end of wire '%s' at %g m",
                     cls->name, at, w->name, length);
  }
  SW_TRY(check_force(s, cls, wire, args, err));
  if (cls->flags & SW_FORCE_ON_SOME) SW_TRY(check_some(cls, w, args, err));
  SW_TRY(sw_scene_thaw(s));
  SW_TRY(sw_grow((void **)&s->forces, &s->force_capacity, s->force_count + 1, sizeof *s->forces));
  sw_scene_force *f = &s->forces[s->force_count];
  *f = (sw_scene_force){.generation = s->serial + 1,
                        .alive = 1,
                        .cls = cls,
                        .wire = wire.generation ? (long)wire.slot : -1,
                        .scale = w ? w->mesh.scale : 1.0};
  if (args_size) memcpy(f->args, args, args_size);
  if (cls->flags & SW_FORCE_ON_SOME) SW_TRY(own_list(f));
  if (w && cls->flags & SW_FORCE_AT_PLACE) f->args[0] += w->mesh.s[0]; /* stays with the wire */
  *out = (sw_handle){(uint32_t)s->force_count++, ++s->serial};
  return SW_OK;
}

const sw_force_class *sw_scene_force_class(const sw_scene *s, sw_handle h) {
  const int known = h.slot < s->force_count && s->forces[h.slot].generation == h.generation;
  return known ? s->forces[h.slot].cls : NULL;
}

sw_status sw_scene_remove_force(sw_scene *s, sw_handle force, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  if (!sw_scene_force_class(s, force))
    return sw_fail(err, SW_EDEAD, "this force is not of scene '%s' any more", s->name);
  if (!s->forces[force.slot].alive) return SW_OK;
  SW_TRY(sw_scene_thaw(s));
  s->forces[force.slot].alive = 0;
  return SW_OK;
}
