/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calibrates a wire's lattice, places its particles, and checks its rest shape. */
#include "strand/strand.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "state/hinge.h"
#include "strand/maker.h"

/* SKIN: depth of surface particles below the surface, over the radius, so that a touching body has
 * a side to be on [-]. Solid elements have the section's full size and the thinnest skin (THINNEST)
 * that keeps particles out of touching bodies; the ring of a composite's shell lies within its
 * wall. */
static const double SKIN = 0.1, THINNEST = 0.03;

static double inset(const sw_strand_plan *p) {
  const int whole = p->body == SW_BODY_SOLID || strcmp(p->mesh, "composite") == 0;
  return whole ? 0.0 : SKIN;
}

/* Returns the distance of the surface from the outermost particles. */
static double skin_of(const sw_lattice *l, double radius) {
  double most = 0;
  for (size_t i = 0; i < l->particles; i++)
    most = fmax(most, hypot(l->at[3 * i], l->at[3 * i + 1]));
  return fmax(THINNEST * radius, radius - most);
}

enum { DIRECTIONS = 720 };

/* Returns the section's mean reach over all directions. A polygon's is below that of its
 * corners. */
static double mean_reach(const sw_lattice *l) {
  const double step = 2.0 * M_PI / DIRECTIONS;
  double sum = 0;
  for (int k = 0; k < DIRECTIONS; k++) {
    const double x = cos(step * k), y = sin(step * k);
    double most = 0;
    for (size_t i = 0; i < l->particles; i++)
      most = fmax(most, x * l->at[3 * i] + y * l->at[3 * i + 1]);
    sum += most;
  }
  return sum / DIRECTIONS;
}

/* Returns the mean reach of the requested section. */
static double own_reach(const sw_strand_plan *p, double radius) {
  const sw_cubic_args *a = &p->lattice.cubic;
  const int flat = strcmp(p->mesh, "cubic") == 0 && a->section == SW_SECTION_RECTANGLE;
  return flat ? (a->width + a->height) / M_PI : radius;
}

/* Returns the mean distance of solid elements' surface outside the section's own. A polygon must
 * reach further out to be as stiff as a round section, and it has a skin. */
static double proud_of(const sw_strand_plan *p, const sw_lattice *l, double skin, double radius) {
  if (p->body != SW_BODY_SOLID) return 0;
  return fmax(0.0, mean_reach(l) + skin - own_reach(p, radius));
}

/* --- the wall along the wire --------------------------------------------------------- */

/* Largest share of the wire's EI that its wall may have by itself; the ring has the rest. It is the
 * share of a wall a third of the radius thick; thicker walls do not buckle [-]. */
static const double MOST_ALONG = 0.02;

static double round_of(const sw_beam *beam) {
  return 2.0 * M_PI * sqrt(2.0 * beam->EI_axis[0] / beam->EA);
}

double sw_strand_wall_along(const sw_strand_plan *p, const sw_beam *beam) {
  /* folds slightly bent at rest have no defined direction */
  if (isnan(p->wall) || p->curved || p->rest_twist != 0) return 0;
  return fmin(p->wall, MOST_ALONG * beam->EI_axis[0] / round_of(beam));
}

/* --- calibration -------------------------------------------------------------------- */

/* Fills what the calibration of a mesh depends on. */
static sw_status need_of(const sw_strand_plan *p, const sw_beam *beam, double spacing,
                         double tolerance, sw_strand_need *out, sw_error *err) {
  memset(out, 0, sizeof *out);
  out->args.mesh = sw_calibrate_mesh(p->mesh), out->args.body = p->body;
  out->args.squeeze = p->squeeze, out->args.spacing = spacing, out->args.tolerance = tolerance;
  memcpy(&out->lattice, &p->lattice, sizeof out->lattice);
  sw_lattice_args *lattice = &out->lattice;
  sw_section section = p->section;
  section.density = section.spin_inertia = (double)NAN;
  /* with the beam's values given, E only sets the ratio of a composite's materials */
  if (p->body == SW_BODY_SPRINGS || out->args.mesh != SW_LATTICE_COMPOSITE) section.E = (double)NAN;
  if (p->body == SW_BODY_SPRINGS) section.nu = (double)NAN;
  section.EA = beam->EA, section.GJ = beam->GJ;
  section.EI = beam->EI_axis[0] - sw_strand_wall_along(p, beam) * round_of(beam);
  section.mass_per_length = beam->mass;
  section.radius = (1.0 - inset(p)) * beam->radius;
  if (section.EI2 > 0) lattice->cubic.EI2 = section.EI2;
  section.EI2 = (double)NAN;
  out->section = section;
  if (!isnan(p->wall) && (out->args.mesh != SW_LATTICE_TUBE || lattice->tube.core))
    return sw_fail(err, SW_EINVAL,
                   "wire '%s': wall_bending = %.6g N m goes with model = 'tube' and core = false",
                   p->name, p->wall);
  if (!isnan(p->wall)) { /* chords and wide diagonals would also keep the ring round */
    if (lattice->tube.brace < 0) lattice->tube.brace = 0;
    if (lattice->tube.reach == 0) lattice->tube.reach = 1;
  }
  return SW_OK;
}

/* 1 for a tube without core whose wall is put where EA and EI agree. */
static int has_free_ring(const sw_strand_need *need) {
  const sw_tube_args *tube = &need->lattice.tube;
  return need->args.mesh == SW_LATTICE_TUBE && !tube->core && isnan(tube->ring_radius);
}

static sw_status calibrate(const sw_strand_plan *p, const sw_strand_need *need, sw_calibration *out,
                           sw_error *err) {
  sw_lattice_args lattice = need->lattice;
  sw_error why = {""};
  sw_status status = sw_calibrate(&need->args, &need->section, &lattice, out, &why);
  if (status == SW_EINVAL && has_free_ring(need)) { /* a thin wall needs its ring further out */
    sw_section section = need->section;
    section.radius *= (1.0 - THINNEST) / (1.0 - SKIN);
    lattice = need->lattice;
    sw_calibration_free(out);
    status = sw_calibrate(&need->args, &section, &lattice, out, &why);
  }
  if (status == SW_OK) return SW_OK;
  const char *text = strncmp(why.text, "calibrate: ", 11) == 0 ? why.text + 11 : why.text;
  const char *also = isnan(p->spacing) && strstr(text, "spacing = ")
                         ? "; spacing is the wire's length over segments"
                         : "";
  return sw_fail(err, status, "wire '%s' as %s: %.400s%s", p->name, p->mesh, text, also);
}

sw_status sw_strand_slices(const sw_strand_plan *p, const sw_beam *beam, double length, size_t *out,
                           sw_error *err) {
  double spacing = p->spacing;
  if (isnan(spacing)) {
    sw_calibration any = {0};
    sw_strand_need need;
    SW_TRY(need_of(p, beam, spacing, 1.0, &need, err));
    const sw_status status = calibrate(p, &need, &any, err);
    spacing = any.lattice.spacing;
    sw_calibration_free(&any);
    SW_TRY(status);
  }
  const double count = ceil(length / spacing - 1e-6);
  if (!(count < 1e7))
    return sw_fail(err, SW_EINVAL, "wire '%s': slices every %g m are too many", p->name, spacing);
  *out = (size_t)fmax(2.0, count);
  return SW_OK;
}

/* --- where particles are --------------------------------------------------------------- */

/* Returns the place of particle i of the section at node r, in axes across, across, along. */
static sw_vec in_section(const sw_strand_maker *m, size_t r, size_t i) {
  sw_vec at = sw_vec_at(m->lattice->at, i);
  const size_t n = 3 * m->lattice->particles;
  if (sw_strand_is_line(m, r + 1) || (r > 0 && sw_strand_is_line(m, r - 1)))
    return at; /* a lever keeps the section undeformed */
  for (size_t s = 0; m->warp && m->lie && s < SW_CELL_STRAINS; s++)
    at = sw_madd(at, sw_vec_at(m->warp + s * n, i), m->lie->strains[SW_CELL_STRAINS * r + s]);
  return at;
}

/* Returns the place of a line's particle. A lever is straight in front of its section. */
static sw_vec on_line(const sw_strand_maker *m, size_t r) {
  const int left = r > 0 && sw_strand_is_ring(m, r - 1), right = sw_strand_is_ring(m, r + 1);
  if ((!left && !right) || !m->lie) return sw_vec_at(m->mesh->x, r);
  const size_t ring = left ? r - 1 : r + 1;
  const double d = m->mesh->s[r] - m->mesh->s[ring];
  return sw_madd(sw_vec_at(m->mesh->x, ring), sw_load(m->lie->frames + 6 * ring), d);
}

/* Places the particles across the line of the mesh's nodes; sections are carried along without
 * twist. */
static void place_particles(const sw_strand_maker *m) {
  const sw_mesh *mesh = m->mesh;
  const size_t n = m->lattice->particles;
  sw_vec t = sw_mesh_tangent(mesh, 0);
  const sw_vec wanted = sw_madd(m->plan->normal, t, -sw_dot(m->plan->normal, t));
  sw_vec u = isfinite(wanted.x) ? sw_unit_or(wanted, sw_perpendicular(t)) : sw_perpendicular(t);
  for (size_t r = 0; r < mesh->n; r++) {
    const sw_vec next = sw_mesh_tangent(mesh, r), middle = sw_vec_at(mesh->x, r);
    u = sw_carry_unit(u, t, next);
    t = next;
    if (m->lie) t = sw_load(m->lie->frames + 6 * r), u = sw_load(m->lie->frames + 6 * r + 3);
    const sw_vec w = sw_cross(t, u);
    if (!sw_strand_is_ring(m, r)) sw_store(m->strand->x + 3 * m->first[r], on_line(m, r));
    for (size_t i = 0; i < n && sw_strand_is_ring(m, r); i++) {
      const sw_vec at = in_section(m, r, i), across = sw_madd(sw_scale(u, at.x), w, at.y);
      sw_store(m->strand->x + 3 * (m->first[r] + i), sw_madd(sw_add(middle, across), t, at.z));
    }
  }
}

static sw_status new_particles(sw_strand_maker *m) {
  sw_strand *s = m->strand;
  const size_t n = m->mesh->n;
  m->first = sw_alloc(n + 1, sizeof *m->first);
  if (!m->first) return SW_ENOMEM;
  for (size_t r = 0; r < n; r++)
    m->first[r + 1] = m->first[r] + (sw_strand_is_ring(m, r) ? m->lattice->particles : 1);
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(s->x, 3 * m->first[n]), SW_ROOM(s->v, 3 * m->first[n]),
                      SW_ROOM(s->a, 3 * m->first[n])));
  place_particles(m);
  return SW_OK;
}

static sw_status make(sw_strand_maker *m) {
  SW_TRY(new_particles(m));
  return sw_strand_fill(m);
}

/* Finds the sections' displacements under unit strains. */
static sw_status find_warp(sw_strand_maker *m, sw_error *err) {
  const sw_cell cell = sw_lattice_cell(m->lattice);
  m->warp = sw_alloc(3 * SW_CELL_STRAINS * cell.particles, sizeof *m->warp);
  if (!m->warp) return sw_fail(err, SW_ENOMEM, "wire '%s': out of memory", m->plan->name);
  const sw_status status = sw_cell_warp(&cell, m->k, m->lattice->share, m->warp, err);
  if (status == SW_OK) return SW_OK;
  sw_free(m->warp);
  return status;
}

enum { MOST_PARTICLES = 1000000 }; /* the matrix of this many takes gigabytes */

sw_status sw_strand_check_count(const sw_strand_plan *p, size_t rings, size_t per_ring,
                                sw_error *err) {
  if (rings <= MOST_PARTICLES / per_ring) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "wire '%s': %zu slices of %zu particles or more are too many; at most %d "
                 "particles are allowed",
                 p->name, rings - 1, per_ring, (int)MOST_PARTICLES);
}

/* A fold's angle has no sign, so a fold bent at rest could bend either way. */
static sw_status check_rest(const sw_strand_plan *p, const sw_lattice *l, sw_error *err) {
  for (size_t i = 0; p->curved && i < l->links; i++)
    if (l->link[i].bend)
      return sw_fail(
          err, SW_EINVAL,
          "wire '%s': rest = 'path' needs a mesh without springs against bending, which "
          "are straight at rest; make %s",
          p->name,
          strcmp(p->mesh, "composite") == 0 ? "core = 'radial' or 'cubic'" : "bend = false");
  return SW_OK;
}

/* Shorter wires, over the radius, are pieces to be pressed, not bent [-]. */
static const double SHORT = 4.0;

static sw_status check_bent(const sw_strand_plan *p, const sw_calibration *c, double length,
                            double radius, sw_error *err) {
  sw_error why = {""};
  if (isnan(p->wall) || length < SHORT * radius) return SW_OK;
  const sw_status status = sw_calibrate_check_bent(c, &why);
  return status == SW_OK
             ? status
             : sw_fail(err, status, "wire '%s' as %s: %.400s", p->name, p->mesh, why.text);
}

/* Makes the calibration of a mesh, or takes over a recent one. */
static sw_status calibrated_of(const sw_strand_plan *p, const sw_beam *beam, double spacing,
                               sw_strand_calibrated **out, sw_error *err) {
  sw_strand_need need;
  SW_TRY(need_of(p, beam, spacing, 1e-6, &need, err));
  *out = sw_strand_recent_find(p->recent, &need);
  if (*out) return SW_OK;
  *out = sw_alloc(1, sizeof **out);
  if (!*out) return sw_fail(err, SW_ENOMEM, "wire '%s': out of memory", p->name);
  (*out)->references = 1;
  SW_TRY(calibrate(p, &need, &(*out)->calibration, err));
  sw_strand_recent_keep(p->recent, &need, *out);
  return SW_OK;
}

sw_status sw_strand_new(const sw_strand_plan *plan, const sw_beam *beam, const sw_mesh *mesh,
                        const sw_strand_lie *lie, sw_strand *out, sw_error *err) {
  const double even = (mesh->s[mesh->n - 1] - mesh->s[0]) / (double)(mesh->n - 1);
  const double spacing = lie && lie->ring ? lie->spacing : even;
  memset(out, 0, sizeof *out);
  SW_TRY(sw_strand_check_count(plan, mesh->n, 1, err));
  SW_TRY(calibrated_of(plan, beam, spacing, &out->calibrated, err));
  const sw_calibration *c = &out->calibrated->calibration;
  SW_TRY(sw_strand_check_count(plan, mesh->n, c->lattice.particles, err));
  SW_TRY(check_rest(plan, &c->lattice, err));
  SW_TRY(check_bent(plan, c, mesh->s[mesh->n - 1] - mesh->s[0], beam->radius, err));
  sw_strand_maker m = {.plan = plan,
                       .beam = beam,
                       .ring = lie ? lie->ring : NULL,
                       .lattice = &c->lattice,
                       .mesh = mesh,
                       .k = c->k,
                       .lie = lie,
                       .strand = out};
  if (lie) SW_TRY(find_warp(&m, err));
  const sw_status made = make(&m);
  sw_free(m.warp);
  sw_free(m.first);
  if (!m.web) sw_free(m.around);
  if (made != SW_OK) return sw_fail(err, SW_ENOMEM, "wire '%s': out of memory", plan->name);
  out->web->skin = skin_of(m.lattice, beam->radius);
  out->web->proud = proud_of(plan, m.lattice, out->web->skin, beam->radius);
  out->web->line_skin = beam->radius;
  out->web->wall = isnan(plan->wall) ? 0.0 : plan->wall;
  return SW_OK;
}

void sw_strand_free(sw_strand *s) {
  sw_web_release(s->web);
  sw_strand_calibrated_release(s->calibrated);
  SW_FREE_ALL(s->x, s->v, s->a, s->axial, s->rate);
  memset(s, 0, sizeof *s);
}

static double *copy_of(const double *from, size_t n) {
  double *to = sw_alloc(n, sizeof *to);
  if (to) memcpy(to, from, n * sizeof *to);
  return to;
}

sw_status sw_strand_copy(const sw_strand *from, sw_strand *to) {
  memset(to, 0, sizeof *to);
  if (!from->web) return SW_OK;
  const size_t n = 3 * from->web->particles;
  to->web = sw_web_retain(from->web);
  to->calibrated = from->calibrated;
  if (to->calibrated) to->calibrated->references++;
  to->x = copy_of(from->x, n);
  to->v = copy_of(from->v, n);
  to->a = copy_of(from->a, n);
  to->axial = copy_of(from->axial, from->web->links);
  if (from->rate) to->rate = copy_of(from->rate, from->web->links);
  const int whole = !from->rate || to->rate;
  if (to->x && to->v && to->a && to->axial && whole) return SW_OK;
  sw_strand_free(to);
  return SW_ENOMEM;
}
