/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives a wire another model during a run. The wire's middle line carries over shape, stretch,
 * twist and velocity. Mass and arc lengths stay the same; the smallest rigid motion that does so
 * restores momentum and angular momentum. Sections of a new mesh deform under stretch, bend and
 * twist as in an endless mesh. Other deformation of sections, such as squeezing, is lost; the
 * change of energy shows how much. */
#include "remodel/remodel.h"

#include <math.h>

#include "base/alloc.h"
#include "body/bends.h"
#include "body/body.h"
#include "body/build.h"
#include "body/join.h"
#include "body/other_edges.h"
#include "edit/edit.h"
#include "link/hold.h"
#include "read/reading.h"
#include "remodel/borne.h"
#include "remodel/exchange.h"
#include "remodel/line.h"
#include "save/life.h"
#include "scene/drive.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"

static const sw_param rows[] = {
    {"model", SW_PARAM_OTHER, "-", 0, 0, 0, 0, NULL, 0, "the new model of the wire"},
    {"segments", SW_PARAM_INTEGER, "-", 0, 0, 1e7, 0, NULL, offsetof(sw_wire_args, segments),
     "number of segments, 2 or more (default 50); of a mesh the number of slices (default: by "
     "their spacing)"},
    {"region", SW_PARAM_OTHER, "m", 0, 0, 0, 0, NULL, 0,
     "{s1, s2}: the wire becomes a mesh only there and beside clamps; elsewhere it is a line of "
     "particles with EA and EI, without twist (not given: all of the wire)"},
    {"normal", SW_PARAM_VECTOR, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL,
     offsetof(sw_wire_args, normal),
     "of a line that becomes a mesh: direction of a corner of its sections in the middle of the "
     "region; a squeeze along it does not turn them (not given: any)"},
};
const sw_params sw_remodel_params = SW_PARAMS("remodel", rows);

static sw_status becomes_mesh(const sw_strand_plan *plan, const sw_scene_wire *w, const sw_line *l,
                              sw_scene_wire *out, sw_error *err) {
  const sw_strand_lie lie = {.frames = l->frame,
                             .strains = l->strain,
                             .ring = l->stations->ring,
                             .spacing = l->stations->spacing};
  SW_TRY(sw_strand_new(plan, &w->beam, &out->mesh, &lie, &out->strand, err));
  sw_line_spin(l, out->strand.web, out->strand.x, out->strand.v);
  return SW_OK;
}

/* --- holds ---------------------------------------------------------------------------------- */

/* The wire's living holds take hold of its new model, each at its present pose. */
static sw_status retake(sw_scene *s, size_t wire, sw_error *err) {
  unsigned char *waits SW_LOCAL = sw_alloc(sw_scene_hold_slots(s), 1);
  if (!waits) return SW_ENOMEM;
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++) {
    sw_hold *h = sw_scene_hold_in(s, k);
    waits[k] = h->alive && h->wire == wire;
    if (waits[k]) h->alive = 0; /* its old place must not be in the way of the other holds */
  }
  for (size_t k = 0; k < sw_scene_hold_slots(s); k++) {
    sw_motion_state now;
    sw_hold *h = sw_scene_hold_in(s, k);
    if (!waits[k]) continue;
    SW_TRY(sw_drive_eval(s, &h->drive, sw_scene_time(s), &now, err));
    SW_TRY(sw_scene_rehold(s, h, now.pose, err));
  }
  /* only now: nodes move along the curve there, up to holds that hold them */
  return sw_scene_wire_in(s, wire)->strand.web ? SW_OK : sw_line_refine(s, wire);
}

/* --- all of it ----------------------------------------------------------------------- */

static void replace(sw_scene *s, size_t wire, sw_scene_wire *with) {
  sw_scene_wire *w = sw_scene_wire_in(s, wire);
  sw_mesh_free(&w->mesh);
  sw_strand_free(&w->strand);
  sw_free(w->twisted);
  w->cls = with->cls, w->mesh = with->mesh, w->strand = with->strand;
  w->twisted = with->twisted, w->twisted_count = with->twisted_count, w->untwisted = 0;
  w->remade = with->strand.web != NULL;
  w->wear.holds = 0; /* the directions across the wire differ, even at the same places */
  sw_scene_forget_mesh(s, wire);
}

sw_status sw_remodel_check_forces(const sw_scene *s, size_t wire, const sw_wire_class *cls,
                                  sw_error *err) {
  sw_scene_wire as = *sw_scene_wire_in(s, wire);
  as.cls = cls;
  return sw_scene_check_rules(s, wire, &as, err);
}

static sw_status check(const sw_scene *s, size_t wire, const sw_wire_class *cls, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  if (w->mesh.rest)
    return sw_fail(err, SW_EINVAL,
                   "remodel: wire '%s' is curved at rest, has two values of EI or rolls; such "
                   "wires cannot be remodelled",
                   w->name);
  if (w->drawing.rest == SW_REST_PATH)
    return sw_fail(err, SW_EINVAL, "remodel: wire '%s' is curved at rest", w->name);
  if (w->mesh.s[0] != 0) return sw_fail(err, SW_EINVAL, "remodel: wire '%s' has been fed", w->name);
  const sw_joint *join = cls->mesh ? sw_scene_joined(s, wire) : NULL;
  if (join)
    return sw_fail(
        err, SW_EINVAL,
        "remodel: wire '%s' is joined by '%s': a joined wire cannot become a mesh (model "
        "'%s'), as a mixed grasp would also make it; release the join first, keep model "
        "'rod', or grasp it by 'plates' or 'imposed'",
        w->name, join->name, cls->name);
  SW_EACH(hold, h, s)
    if (h->alive && h->wire == wire && sw_hold_passes(h))
      return sw_fail(err, SW_EINVAL, "remodel: wire '%s' is fed by '%s'", w->name, h->name);
  SW_EACH(hold, h, s)
    if (h->alive && h->wire == wire && h->cls->hold->rail)
      return sw_fail(err, SW_EINVAL, "remodel: wire '%s' slides along '%s'", w->name, h->name);
  return sw_remodel_check_forces(s, wire, cls, err);
}

sw_status sw_scene_replace_wire(sw_scene *s, size_t wire, sw_scene_wire *with, sw_error *err) {
  replace(s, wire, with);
  return retake(s, wire, err);
}

static sw_status make(sw_scene *s, size_t wire, const sw_strand_plan *plan, const sw_line *l,
                      sw_scene_wire *out, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  sw_status status = sw_line_mesh(w, l, &out->mesh);
  if (status == SW_OK)
    status = out->cls->mesh ? becomes_mesh(plan, w, l, out, err) : sw_line_twist(l, out);
  if (status == SW_OK) return SW_OK;
  sw_mesh_free(&out->mesh);
  sw_strand_free(&out->strand);
  sw_free(out->twisted);
  return status == SW_ENOMEM ? sw_fail(err, status, "remodel: out of memory") : status;
}

/* Reads the line; first determines the number of its nodes. */
static sw_status read_line(sw_scene *s, sw_handle h, const sw_wire_args *args,
                           const sw_strand_plan *plan, const sw_wire_class *cls,
                           const sw_stations *stations, sw_line *out, sw_error *err) {
  size_t segments = stations->n ? stations->n - 1 : (size_t)args->segments;
  double length;
  SW_TRY(sw_scene_wire_length(s, h, &length, err));
  if (!segments && cls->mesh)
    SW_TRY(sw_strand_slices(plan, &sw_scene_wire_in(s, h.slot)->beam, length, &segments, err));
  if (segments < 2) segments = 50;
  if (cls->mesh) SW_TRY(sw_strand_check_count(plan, segments + 1, 1, err));
  if (cls->mesh || stations->n) return sw_line_read(s, h, segments + 1, stations->s, out, err);
  double *places = NULL;
  size_t count;
  sw_status status = sw_line_places(s, h.slot, length, segments, &places, &count);
  if (status != SW_OK) return sw_fail(err, status, "remodel: out of memory");
  status = sw_line_read(s, h, count, places, out, err);
  sw_free(places);
  return status;
}

enum { USUAL_SEGMENTS = 50 }; /* default for a wire that is a line [-] */

static sw_status plan_region(sw_scene *s, sw_handle h, const sw_wire_args *args,
                             const sw_strand_plan *plan, const double *region, sw_stations *out,
                             sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, h.slot);
  size_t slices;
  double length;
  SW_TRY(sw_scene_wire_length(s, h, &length, err));
  if (!plan->mesh)
    return sw_fail(err, SW_EINVAL,
                   "remodel: region goes with a model that is a mesh, not with a line; leave "
                   "region out to change the whole wire");
  if (!(region[0] >= 0) || !(region[1] <= length * (1 + 1e-9)) || !(region[0] < region[1]))
    return sw_fail(err, SW_EINVAL,
                   "remodel: region = {%.6g, %.6g} m is not on wire '%s'; it must be two arc "
                   "lengths, the first one less, within [0, %.6g] m",
                   region[0], region[1], w->name, length);
  if (w->beam.rest_twist != 0)
    return sw_fail(err, SW_EINVAL,
                   "remodel: wire '%s' is twisted without load, and the lines beside a region "
                   "cannot be; leave region out",
                   w->name);
  SW_TRY(sw_strand_slices(plan, &w->beam, length, &slices, err));
  const double segments = args->segments ? (double)args->segments : USUAL_SEGMENTS;
  return sw_region_plan(s, h.slot, region, length / (double)slices, length / segments, out, err);
}

/* Twist above which a change to lines is refused; they cannot carry twist [rad]. */
static const double LEAST_TWIST = 1e-3;

static sw_status check_twist(const sw_scene_wire *w, const sw_line *l, sw_error *err) {
  double most = 0;
  for (size_t i = 0; l->turn && i < l->n; i++) most = fmax(most, fabs(l->turn[i]));
  if (most <= LEAST_TWIST) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "remodel: wire '%s' is twisted by %.3g rad, which lines beside a region cannot "
                 "carry; leave region out",
                 w->name, most);
}

static const double LEAST_SINE = 1e-3; /* of the angle between a normal and the wire [-] */

/* Turns the sections of a mesh to be, if asked for. A wire that is a mesh keeps its sections. */
static sw_status face(const sw_scene *s, size_t wire, const sw_wire_args *args,
                      const double *region, sw_line *l, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  if (!isfinite(args->normal.x)) return SW_OK;
  if (w->strand.web || !sw_wire_all()[args->model]->mesh)
    return sw_fail(err, SW_EINVAL,
                   "remodel: wire '%s': normal goes with a rod or string that becomes a mesh",
                   w->name);
  const double middle = region ? 0.5 * (region[0] + region[1]) : 0.5 * l->s[l->n - 1];
  if (sw_line_face(l, &w->beam, middle, args->normal, LEAST_SINE)) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "remodel: wire '%s': normal = {%.6g, %.6g, %.6g} must not be zero or along the "
                 "wire at s = %.6g m",
                 w->name, args->normal.x, args->normal.y, args->normal.z, middle);
}

/* Replaces the wire. A rod that becomes a rod with other edges keeps its twist, and its bends
 * beside holds. The line has the twist of the new edges, but not that in the give of clamps. */
static sw_status exchange(sw_scene *s, size_t wire, sw_scene_wire *next, sw_error *err) {
  sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const int rods = !w->strand.web && !next->strand.web && w->beam.EI > 0;
  sw_wire_bends bends = {0};
  if (rods) {
    SW_SWAP(w->twisted, next->twisted);
    SW_SWAP(w->twisted_count, next->twisted_count);
  }
  sw_status kept = rods ? sw_scene_read_bends(s, wire, &bends) : SW_OK;
  if (kept == SW_OK && rods) kept = sw_line_carry(s, wire, &next->mesh);
  sw_status status = kept == SW_OK ? sw_scene_replace_wire(s, wire, next, err) : kept;
  if (status == SW_OK && rods) kept = sw_scene_give_all_bends(s, wire, &bends);
  sw_wire_bends_free(&bends);
  return kept == SW_OK ? status : sw_fail(err, kept, "remodel: out of memory");
}

static sw_status change(sw_scene *s, sw_handle h, const sw_strand_plan *plan, const sw_line *l,
                        sw_scene_wire *next, sw_remodel_report *out, sw_error *err) {
  sw_vec about;
  sw_momentum_of(s, h.slot, &about, out->before);
  out->about = about;
  out->energy_before = sw_scene_total_energy(s, err);
  SW_TRY(make(s, h.slot, plan, l, next, err));
  sw_borne borne = {0};
  sw_span_ends ends = {0};
  sw_status thawed = sw_borne_read(s, h.slot, &borne);
  if (thawed == SW_OK) thawed = sw_scene_read_spans(s, h.slot, &ends);
  if (thawed == SW_OK) thawed = sw_scene_unbuild(s);
  if (thawed != SW_OK) {
    sw_borne_free(&borne);
    sw_span_ends_free(&ends);
    sw_mesh_free(&next->mesh);
    sw_strand_free(&next->strand);
    sw_free(next->twisted);
    return sw_fail(err, thawed, "remodel: out of memory");
  }
  sw_status status = exchange(s, h.slot, next, err);
  if (status == SW_OK) status = sw_scene_build(s, err);
  if (status == SW_OK) sw_scene_turn_spans(s, h.slot, &ends);
  sw_span_ends_free(&ends);
  if (status == SW_OK) status = sw_borne_exchange(s, h.slot, &borne, err);
  sw_borne_free(&borne);
  if (status != SW_OK) return status;
  if (sw_momentum_match(s, h.slot, about, out->before) != SW_OK)
    return sw_fail(err, SW_ENOMEM, "remodel: out of memory");
  sw_momentum_about(s, h.slot, about, out->after);
  out->energy_after = sw_scene_total_energy(s, err);
  return SW_OK;
}

sw_status sw_scene_remodel(sw_scene *s, sw_handle h, const sw_wire_args *args,
                           const sw_wire_mesh_args *mesh, const double *region,
                           sw_remodel_report *out, sw_error *err) {
  *out = (sw_remodel_report){0};
  SW_TRY(sw_scene_ready(s, err));
  if (!sw_scene_find_wire(s, h, err)) return SW_EDEAD;
  const sw_wire_class *cls = sw_wire_all()[args->model];
  SW_TRY(check(s, h.slot, cls, err));
  SW_TRY(sw_scene_build(s, err));
  const sw_strand_plan plan = sw_scene_strand_plan(sw_scene_wire_in(s, h.slot), cls, mesh);
  sw_line l = {0};
  sw_scene_wire next = {.cls = cls};
  sw_snapshot *before = NULL;
  sw_error ignored;
  sw_stations stations = {0};
  sw_status status = region ? plan_region(s, h, args, &plan, region, &stations, err) : SW_OK;
  if (status == SW_OK) status = read_line(s, h, args, &plan, cls, &stations, &l, err);
  l.stations = &stations;
  if (status == SW_OK) status = face(s, h.slot, args, region, &l, err);
  if (status == SW_OK && region) status = check_twist(sw_scene_wire_in(s, h.slot), &l, err);
  if (status == SW_OK) status = sw_scene_snapshot(s, &before, err);
  if (status == SW_OK) status = change(s, h, &plan, &l, &next, out, err);
  if (status != SW_OK && before) sw_scene_restore(s, before, &ignored);
  sw_snapshot_free(before);
  sw_region_free(&stations);
  sw_line_free(&l);
  return status;
}
