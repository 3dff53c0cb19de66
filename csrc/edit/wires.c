/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires of a scene: checks of the user's values, and the making of wires from them. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/build.h"
#include "edit/edit.h"
#include "record/wear.h"
#include "record/zone.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "state/mesh.h"
#include "state/plan.h"

const char *const sw_breaking_flags[] = {"given", "measured", "computed", "guessed", NULL};
static const char *const rest_names[] = {"straight", "path", NULL};

static const sw_param wire_rows[] = {
    SW_NAME_ROW(sw_wire_args),
    {"model", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0,
     "wire model: 'rod' (default), 'string', a mesh: 'tube', 'radial', 'cubic', 'composite', or "
     "'auto'"},
    {"from", SW_PARAM_VECTOR, "m", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(sw_wire_args, from),
     "start of a straight wire (s = 0)"},
    {"to", SW_PARAM_VECTOR, "m", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(sw_wire_args, to),
     "end of a straight wire"},
    {"path", SW_PARAM_OTHER, "m", 0, 0, 0, 0, NULL, 0,
     "list of points the wire lies along, instead of from and to"},
    {"segments", SW_PARAM_INTEGER, "-", 0, 0, 1e7, 0, NULL, offsetof(sw_wire_args, segments),
     "number of segments, 2 or more (default 50); of a mesh the number of slices (default: by "
     "their spacing)"},
    {"rest", SW_PARAM_CHOICE, "-", 0, 0, 0, 0, rest_names, offsetof(sw_wire_args, rest),
     "shape without load: 'straight', or the shape of 'path'"},
    {"normal", SW_PARAM_VECTOR, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_wire_args, normal),
     "with EI = {EI1, EI2}: bending in the plane of the wire and this direction has EI1"},
    {"rolls", SW_PARAM_BOOLEAN, "-", 0, 0, 1, 0, NULL, offsetof(sw_wire_args, rolls),
     "true: friction acts at the surface, so that the wire rolls and is twisted; else at its axis"},
    {"rest_twist", SW_PARAM_NUMBER, "rad/m", 0, -1e6, 1e6, 0, NULL,
     offsetof(sw_wire_args, rest_twist), "twist without load; it is drawn untwisted"},
    {"breaking_load", SW_PARAM_NUMBER, "N", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL,
     offsetof(sw_wire_args, breaking_load),
     "tension above which an event says that the wire would break (default: the cable's)"},
    {"breaking_flag", SW_PARAM_CHOICE, "-", 0, 0, 0, 0, sw_breaking_flags,
     offsetof(sw_wire_args, breaking_flag), "source of the breaking load"},
};
const sw_params sw_wire_params = SW_PARAMS("wire", wire_rows);

static const char *const body_names[] = {"springs", "solid", NULL};
#define AT(member) offsetof(sw_wire_mesh_args, member)
static const sw_param mesh_rows[] = {
    {"spacing", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(spacing),
     "distance of a mesh's slices along the wire (default: chosen); the length is an even number "
     "of slices"},
    {"squeeze", SW_PARAM_NUMBER, "Pa", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(squeeze),
     "stiffness of the section: line force of two plates on opposite sides over their approach "
     "(not given: as the springs give)"},
    {"wall_bending", SW_PARAM_NUMBER, "N m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(wall),
     "of a tube with core = false: bending stiffness of its wall per length, E t^3 / (12 (1 - "
     "nu^2)), against flattening and ovalisation; takes the place of chords (brace)"},
    {"body", SW_PARAM_CHOICE, "-", SW_BODY_SPRINGS, 0, 0, 0, body_names, AT(body),
     "springs between the particles, or solid elements (finite strain) with Poisson's ratio nu"},
};
#undef AT
const sw_params sw_wire_mesh_params = SW_PARAMS("wire", mesh_rows);

enum { USUAL_SEGMENTS = 50 };

static const double SHORTEST_SEGMENT = 1e-9; /* of the wire's length [-] */

static sw_status check_mesh(const char *name, const sw_mesh *m, sw_error *err) {
  const double total = m->s[m->n - 1];
  if (!(total > 0) || !isfinite(total))
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': its points give a length of %g m; it must be above 0 m", name,
                   total);
  for (size_t i = 0; i + 1 < m->n; i++)
    if (!(m->s[i + 1] - m->s[i] > SHORTEST_SEGMENT * total))
      return sw_fail(err, SW_EINVAL, "wire '%s': the path turns back on itself near s = %g m", name,
                     m->s[i]);
  return SW_OK;
}

/* The normal must not be along the wire's start. */
static const double LEAST_SINE = 1e-3; /* sine of the angle between them [-] */

static const double LARGEST_TWIST = 1.5; /* turn of a segment at rest, with frames [rad] */

/* SW_EINVAL for rolls: a mesh of particles rolls by itself. */
static sw_status check_mesh_frames(const sw_scene_wire *w, const sw_drawing *a, sw_error *err) {
  if (a->rolls)
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': rolls goes with model = 'rod'; a %s has a surface of particles and "
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
  if (!w->beam.framed) return SW_OK; /* the normal makes no difference */
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
  sw_drawing *d = &w->drawing;
  d->segments = segments;
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

/* Keeps the path that the wire is drawn along; frees nothing on failure. */
static sw_status keep_drawing(sw_scene_wire *w, const sw_wire_args *args, const double *points,
                              size_t count) {
  w->drawing = (sw_drawing){.count = count,
                            .normal = args->normal,
                            .rest = args->rest,
                            .rolls = args->rolls,
                            .rest_twist = args->rest_twist,
                            .breaking_load = args->breaking_load,
                            .breaking_flag = args->breaking_flag};
  w->drawing.points = sw_alloc(3 * count, sizeof *points);
  if (!w->drawing.points) return SW_ENOMEM;
  memcpy(w->drawing.points, points, 3 * count * sizeof *points);
  return SW_OK;
}

sw_strand_recent *sw_wire_recent_new(void) { return sw_strand_recent_new(); }
void sw_wire_recent_free(sw_strand_recent *recent) { sw_strand_recent_free(recent); }

sw_strand_plan sw_scene_strand_plan(const sw_scene_wire *w, const sw_wire_class *cls,
                                    const sw_wire_mesh_args *mesh) {
  return (sw_strand_plan){.name = w->name,
                          .mesh = cls->mesh,
                          .spacing = mesh->spacing,
                          .squeeze = mesh->squeeze,
                          .body = mesh->body,
                          .wall = mesh->wall,
                          .lattice = mesh->lattice,
                          .section = mesh->section,
                          .normal = w->drawing.normal,
                          .curved = w->drawing.rest == SW_REST_PATH,
                          .rest_twist = w->drawing.rest_twist,
                          .recent = mesh->recent};
}

/* Makes the particles of a wire that is a mesh, along its drawing. */
static sw_status draw_strand(sw_scene_wire *w, const sw_wire_args *args,
                             const sw_wire_mesh_args *mesh, sw_error *err) {
  const sw_drawing *d = &w->drawing;
  const sw_strand_plan plan = sw_scene_strand_plan(w, w->cls, mesh);
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

void sw_scene_clear_body(sw_scene_wire *w) {
  sw_mesh_free(&w->mesh);
  sw_strand_free(&w->strand);
  sw_free(w->drawing.points);
  sw_free(w->twisted);
  sw_window_free(&w->window);
  sw_wear_free(&w->wear);
  sw_spun_free(&w->spun);
  sw_zones_forget(&w->zones);
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
  return sw_scene_check_rules(s, sw_scene_wire_slots(s), w, err);
}

sw_status sw_scene_add_wire(sw_scene *s, const sw_wire_args *args, const sw_beam *beam,
                            const sw_wire_mesh_args *mesh, const double *points, size_t count,
                            sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_editable(s, err));
  const double straight[6] = {args->from.x, args->from.y, args->from.z,
                              args->to.x,   args->to.y,   args->to.z};
  sw_scene_wire w = {.cls = sw_wire_all()[args->model], .beam = *beam};
  sw_scene_give_name(w.name, args->name, "wire", sw_scene_wire_slots(s));
  if (!points && (isnan(args->from.x) || isnan(args->to.x)))
    return sw_fail(err, SW_EINVAL, "wire '%s': give from and to, or path [m]", w.name);
  if (points && count < 2)
    return sw_fail(err, SW_EINVAL, "wire '%s': path needs at least two points", w.name);
  SW_TRY(sw_scene_unbuild(s));
  sw_status status = keep_drawing(&w, args, points ? points : straight, points ? count : 2);
  if (status == SW_OK) status = draw_wire(s, &w, args, mesh, err);
  if (status == SW_OK) {
    w.drawing.length = w.mesh.s[w.mesh.n - 1];
    w.number = sw_scene_bodies_made(s);
    status = sw_scene_add(s, SW_OF_BODY, &w, out);
  }
  if (status == SW_OK)
    sw_scene_let_out(s);
  else
    sw_scene_clear_body(&w);
  return status;
}

const sw_calibration *sw_scene_wire_calibration(const sw_scene *s, sw_handle h) {
  const sw_scene_wire *w = sw_scene_find_wire(s, h, NULL);
  return w && w->strand.calibrated ? &w->strand.calibrated->calibration : NULL;
}

const char *sw_scene_wire_model(const sw_scene *s, sw_handle h) {
  const sw_scene_wire *w = sw_scene_find_wire(s, h, NULL);
  return w ? w->cls->name : NULL;
}
