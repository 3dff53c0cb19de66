/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a wire's values to a mesh and the targets of its springs, and advice if there are no such
 * springs. */
#include "calibrate/calibrate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "calibrate/calibrate_inner.h"
#include "calibrate/composite_solid.h"

static const double OF_LIMIT = 0.6; /* chosen spacing over the largest allowed [-] */

static const double NEAR = 1e-10; /* relative error of EA at which a radius is accepted [-] */
static const double FADED = 0.02; /* stiffness over first guess at which a spring is gone [-] */
enum { RADII = 12 };              /* most radii tried [-] */

static const char *const meshes[] = {"tube", "radial", "cubic", "composite", NULL};
static const char *const bodies[] = {"springs", "solid", NULL};

#define AT(member) offsetof(sw_calibrate_args, member)
static const sw_param rows[] = {
    {"mesh", SW_PARAM_CHOICE, "-", NAN, 0, 0, SW_PARAM_REQUIRED, meshes, AT(mesh),
     "arrangement of the particles: rings, layers and sectors, voxels, or a shell around cores"},
    {"spacing", SW_PARAM_NUMBER, "m", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(spacing),
     "distance of slices along the wire (default: chosen; of cubic such that voxels are cubes)"},
    {"squeeze", SW_PARAM_NUMBER, "Pa", NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(squeeze),
     "stiffness of the section between two plates: force per length over approach, the wire "
     "neither stretched nor bent (default: as the springs give)"},
    {"tolerance", SW_PARAM_NUMBER, "-", 1e-6, 0, 1, SW_PARAM_ABOVE_MIN, NULL, AT(tolerance),
     "allowed error of the springs, as a share of each target; 1 accepts the nearest possible "
     "springs"},
    {"body", SW_PARAM_CHOICE, "-", SW_BODY_SPRINGS, 0, 0, 0, bodies, AT(body),
     "springs between the particles; or solid elements with Poisson's ratio nu, and springs only "
     "for the rest of EA, EI and GJ"},
};
const sw_params sw_calibrate_params = SW_PARAMS("calibrate", rows);

int sw_calibrate_mesh(const char *name) {
  int i = 0;
  while (meshes[i + 1] && strcmp(meshes[i], name) != 0) i++;
  return i;
}

const sw_params *sw_lattice_params(int mesh) {
  static const sw_params *const all[] = {&sw_tube_params, &sw_radial_params, &sw_cubic_params,
                                         &sw_composite_params};
  return all[mesh];
}

void *sw_lattice_place(sw_lattice_args *args, int mesh) {
  void *const all[] = {&args->tube, &args->radial, &args->cubic, &args->composite};
  return all[mesh];
}

/* --- the mesh ------------------------------------------------------------------- */

/* Returns the spacing above which the diagonals that GJ needs give more than EI by themselves: GJ =
 * 2 M k h R^4 s^2/l^2 and EI = (M/2) h R^2 (k_L + 2 k h^2/l^2) with k_L > 0. */
static double largest_spacing(double R, double EI, double GJ, long reach, long particles) {
  return R * sqrt(2 * EI / GJ) * fabs(sin(2 * M_PI * (double)reach / (double)particles));
}

static double ring_limit(const sw_calibrate_args *args, const sw_lattice_args *mesh,
                         const sw_beam *beam) {
  if (args->mesh == SW_LATTICE_TUBE)
    return largest_spacing(mesh->tube.ring_radius, beam->EI, beam->GJ, sw_tube_reach(&mesh->tube),
                           mesh->tube.particles);
  if (args->mesh == SW_LATTICE_RADIAL)
    return largest_spacing(beam->radius, beam->EI, beam->GJ, 1, mesh->radial.particles);
  return HUGE_VAL;
}

sw_status sw_calibrate_lattice(const sw_calibrate_args *args, const sw_beam *beam,
                               sw_lattice_args *mesh, sw_lattice *out, sw_error *err) {
  sw_tube_args *tube = &mesh->tube;
  double h = args->spacing;
  if (args->mesh == SW_LATTICE_CUBIC)
    return sw_lattice_cubic(&mesh->cubic, beam->radius, h, out, err);
  if (args->mesh == SW_LATTICE_TUBE && isnan(tube->ring_radius)) tube->ring_radius = beam->radius;
  const double limit = OF_LIMIT * ring_limit(args, mesh, beam);
  if (args->mesh == SW_LATTICE_TUBE) {
    const double chord = 2 * tube->ring_radius * sin(M_PI / (double)tube->particles);
    /* a limit of 0: the mesh itself refuses this reach */
    if (isnan(h)) h = limit > 1e-6 * chord ? fmin(chord, limit) : chord;
    return sw_lattice_tube(tube, h, out, err);
  }
  const double chord = 2 * beam->radius * sin(M_PI / (double)mesh->radial.particles);
  if (isnan(h)) h = fmin(fmin(chord, beam->radius / (double)mesh->radial.layers), limit);
  return sw_lattice_radial(&mesh->radial, beam->radius, h, out, err);
}

sw_status sw_calibrate_composite_lattice(const sw_composite *place, const sw_beam *beam, double h,
                                         sw_lattice *out, sw_error *err) {
  const double R = beam->radius, ring = (double)place->ring;
  const double limit = OF_LIMIT * largest_spacing(R, beam->EI, beam->GJ, 1, (long)place->ring);
  const double layer = R / (double)(place->layers + place->core_layers);
  if (isnan(h)) h = fmin(fmin(2 * R * sin(M_PI / ring), layer), limit);
  return sw_lattice_composite_solid(place, h, out, err);
}

sw_status sw_calibrate_materials(const char *object, int mesh, int body,
                                 const sw_lattice_args *args, sw_section *section, sw_error *err) {
  if (mesh != SW_LATTICE_COMPOSITE || body != SW_BODY_SOLID) return SW_OK;
  return sw_composite_section(object, &args->composite, section, err);
}

/* --- the wire -------------------------------------------------------------------- */

/* Checks the section. E and nu are those of a solid round wire. */
static sw_status check_section(const sw_calibrate_args *args, const sw_section *c,
                               const sw_cubic_args *cubic, sw_error *err) {
  const int round = args->mesh != SW_LATTICE_CUBIC || cubic->section == SW_SECTION_CIRCLE;
  const int flat = args->mesh == SW_LATTICE_CUBIC && cubic->section == SW_SECTION_RECTANGLE;
  if (!round && (isnan(c->EA) || isnan(c->EI) || isnan(c->GJ) || !isnan(c->density)))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: E, nu and density describe a solid round wire; give EA [N], EI [N "
                   "m2] and GJ [N m2] of this section, and mass_per_length [kg/m]");
  if (args->mesh == SW_LATTICE_CUBIC && !flat && !isnan(cubic->EI2))
    return sw_fail(err, SW_EINVAL, "calibrate: EI2 goes with section = 'rectangle'");
  if (flat && isnan(cubic->EI2) && fabs(cubic->width - cubic->height) > 0)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: a rectangle of %g m times %g m needs EI2 [N m2] too, for bending "
                   "in the plane of y and z",
                   cubic->width, cubic->height);
  if (c->EI == 0)
    return sw_fail(err, SW_EINVAL, "calibrate: EI = 0 N m2 is not allowed; it must be above 0");
  return SW_OK;
}

static sw_status read_beam(const sw_calibrate_args *args, const sw_section *given,
                           const sw_lattice_args *mesh, sw_beam *beam, sw_error *err) {
  sw_section c = *given;
  const int flat = args->mesh == SW_LATTICE_CUBIC && mesh->cubic.section == SW_SECTION_RECTANGLE;
  SW_TRY(check_section(args, given, &mesh->cubic, err));
  SW_TRY(sw_calibrate_materials("calibrate", args->mesh, args->body, mesh, &c, err));
  if (flat && isnan(c.radius)) c.radius = 0.5 * hypot(mesh->cubic.width, mesh->cubic.height);
  if (flat && isnan(c.radius)) c.radius = 1; /* sides are missing: the mesh reports it */
  if (isnan(c.mass_per_length) && isnan(c.density)) c.mass_per_length = 1;
  c.spin_inertia = NAN; /* that of the mesh, see spread_mass */
  return sw_section_beam("calibrate", &c, beam, err);
}

static void set_targets(const sw_calibrate_args *args, const sw_beam *beam,
                        const sw_lattice_args *mesh, double *target) {
  const int flat = args->mesh == SW_LATTICE_CUBIC && mesh->cubic.section == SW_SECTION_RECTANGLE;
  target[SW_TARGET_EA] = beam->EA;
  target[SW_TARGET_EI] = beam->EI;
  target[SW_TARGET_EI2] = !flat ? (double)NAN : isnan(mesh->cubic.EI2) ? beam->EI : mesh->cubic.EI2;
  target[SW_TARGET_GJ] = beam->GJ;
  target[SW_TARGET_SQUEEZE] = args->squeeze;
}

/* Divides the mass between ring and core so that the slice has the given spin inertia. */
static sw_status spread_mass(const sw_calibrate_args *args, const sw_section *c,
                             const sw_tube_args *tube, sw_calibration *out, sw_error *err) {
  if (isnan(c->spin_inertia)) return SW_OK;
  if (args->mesh != SW_LATTICE_TUBE || !tube->core || isnan(out->mass_per_length))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: spin_inertia can be chosen for mesh = 'tube' with core = true and "
                   "mass_per_length [kg/m] only");
  const double most = out->mass_per_length * tube->ring_radius * tube->ring_radius;
  const double ring = c->spin_inertia / most;
  if (!(ring <= 1))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: spin_inertia = %.6g kg m must be in (0, %.6g] kg m, "
                   "mass_per_length times the ring's radius^2",
                   c->spin_inertia, most);
  const size_t M = out->lattice.particles - 1;
  for (size_t i = 0; i < M; i++) out->lattice.share[i] = ring / (double)M;
  out->lattice.share[M] = 1 - ring;
  return SW_OK;
}

/* --- targets that cannot be reached ---------------------------------------------------- */

static void tube_advice(const sw_calibrate_args *args, const sw_tube_args *tube,
                        const sw_calibration *c, int worst, double limit, char *text, size_t n) {
  const double R = tube->ring_radius, h = c->lattice.spacing;
  const double fits = sqrt(2 * c->target[SW_TARGET_EI] / c->target[SW_TARGET_EA]);
  if (args->mesh == SW_LATTICE_TUBE && h > 0.85 * limit)
    snprintf(text, n,
             "the diagonals that GJ needs are too stiff in bending: spacing = %.4g m must be "
             "less than about %.4g m, or increase reach = %ld",
             h, 0.8 * limit, sw_tube_reach(tube));
  else if (args->mesh == SW_LATTICE_RADIAL && h > 0.85 * limit)
    snprintf(text, n,
             "the diagonals that GJ needs are too stiff in bending: spacing = %.4g m must be "
             "less than about %.4g m, or give fewer particles",
             h, 0.8 * limit);
  else if (worst == SW_TARGET_SQUEEZE)
    snprintf(text, n, "give another squeeze, or more %s",
             args->mesh == SW_LATTICE_TUBE ? "chords (brace)" : "layers");
  else if (args->mesh == SW_LATTICE_TUBE && tube->core && fits > R / 1.1)
    snprintf(text, n,
             "particles with EI at the radius R have an EA of at least about 2 EI/R^2: increase "
             "ring_radius = %.4g m to about %.4g m or more%s",
             R, 1.1 * fits, tube->bend ? "" : ", or give bend = true");
  else if (args->mesh == SW_LATTICE_TUBE && !tube->core)
    snprintf(text, n,
             "particles with EI at the radius R have an EA of about 2 EI/R^2: give core = true, or "
             "leave out ring_radius = %.4g m, so that it is computed",
             R);
  else
    snprintf(text, n, "try another spacing than %.4g m, more particles, or another radius", h);
}

static void cubic_advice(const sw_cubic_args *cubic, const sw_calibration *c, int worst, char *text,
                         size_t n) {
  const double ratio = c->target[SW_TARGET_EI] / c->target[SW_TARGET_EA];
  double most = 0;
  for (size_t i = 0; i < c->lattice.particles; i++) most = fmax(most, fabs(c->lattice.at[3 * i]));
  if (worst == SW_TARGET_SQUEEZE)
    snprintf(text, n, "give another squeeze");
  else if (ratio > 0.5 * most * most)
    snprintf(text, n,
             "EI/EA = %.3g m2 of the wire is too close to %.3g m2 of the outermost particles: make "
             "the section larger",
             ratio, most * most);
  else if (cubic->section == SW_SECTION_RECTANGLE)
    snprintf(text, n,
             "EI/EI2 must be near (width/height)^2 = %.4g; if it is, increase across = %ld",
             cubic->width * cubic->width / (cubic->height * cubic->height), cubic->across);
  else
    snprintf(text, n, "increase across = %ld, to an even number", cubic->across);
}

/* 1 if springs meet the targets only by releasing the section's shape. If a squeeze stiffness was
 * requested, soft springs are intended. */
static int is_gone(const sw_calibration *c) {
  return c->fading < FADED && isnan(c->target[SW_TARGET_SQUEEZE]);
}

static sw_status check_reached(const sw_calibrate_args *args, const sw_lattice_args *mesh,
                               const sw_beam *beam, const sw_calibration *c, sw_error *err) {
  char text[256];
  int worst = 0;
  for (int t = 1; t < SW_TARGETS; t++)
    if (fabs(c->residual[t]) > fabs(c->residual[worst])) worst = t;
  const int near = fabs(c->residual[worst]) <= args->tolerance;
  if (args->tolerance == 1 || (near && !is_gone(c))) return SW_OK;
  if (args->mesh == SW_LATTICE_CUBIC)
    cubic_advice(&mesh->cubic, c, worst, text, sizeof text);
  else
    tube_advice(args, &mesh->tube, c, worst, ring_limit(args, mesh, beam), text, sizeof text);
  if (near)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: EA, EI and GJ are reached together only with %s springs close to "
                   "zero (%.2g of the usual stiffness); %s",
                   sw_group_names[c->faded], c->fading, text);
  return sw_fail(err, SW_EINVAL,
                 "calibrate: no springs of this mesh give %s = %.6g %s; the nearest have %.6g %s "
                 "(%+.2g %%); %s",
                 sw_target_names[worst], c->target[worst], sw_target_units[worst],
                 sw_reached(&c->reached, worst), sw_target_units[worst], 100 * c->residual[worst],
                 text);
}

/* Makes lattice, masses and springs of a mesh with all arguments known. */
static sw_status try_mesh(const sw_calibrate_args *args, const sw_section *section,
                          const sw_beam *beam, sw_lattice_args *mesh, sw_calibration *out,
                          sw_error *err) {
  sw_lattice_free(&out->lattice);
  SW_TRY(sw_calibrate_lattice(args, beam, mesh, &out->lattice, err));
  sw_lattice_drop_solids(&out->lattice);
  SW_TRY(spread_mass(args, section, &mesh->tube, out, err));
  return sw_calibrate_fit(out, err);
}

/* Finds the ring radius of a coreless tube. A single ring has EA near 2 EI/R^2; R must make this
 * the wire's EA, and for a wall of one material this R lies in the wall. The exact R is found by
 * iteration with springs that have EI and GJ only; with EA as a target too, hoops would go soft to
 * meet it. */
static sw_status find_radius(const sw_calibrate_args *args, const sw_section *section,
                             const sw_beam *beam, sw_lattice_args *mesh, sw_calibration *out,
                             sw_error *err) {
  double *R = &mesh->tube.ring_radius;
  *R = sqrt(2 * beam->EI / beam->EA);
  out->target[SW_TARGET_EA] = (double)NAN;
  for (int i = 0; i < RADII; i++) {
    SW_TRY(try_mesh(args, section, beam, mesh, out, err));
    const double ratio = sw_reached(&out->reached, SW_TARGET_EA) / beam->EA;
    *R *= sqrt(ratio);
    if (fabs(ratio - 1) < NEAR) break;
  }
  out->target[SW_TARGET_EA] = beam->EA;
  if (*R <= beam->radius * (1 + 1e-9)) return try_mesh(args, section, beam, mesh, out, err);
  return sw_fail(err, SW_EINVAL,
                 "calibrate: a tube without core that has EA = %.6g N and EI = %.6g N m2 needs its "
                 "wall at %.4g m, outside of radius = %.4g m; more particles need a little less",
                 beam->EA, beam->EI, *R, beam->radius);
}

sw_status sw_calibrate(const sw_calibrate_args *args, const sw_section *section,
                       sw_lattice_args *mesh, sw_calibration *out, sw_error *err) {
  sw_beam beam;
  memset(out, 0, sizeof *out);
  SW_TRY(read_beam(args, section, mesh, &beam, err));
  out->mass_per_length =
      isnan(section->mass_per_length) && isnan(section->density) ? (double)NAN : beam.mass;
  out->scale = 1;
  set_targets(args, &beam, mesh, out->target);
  if (args->body == SW_BODY_SOLID) return sw_calibrate_solid(args, section, &beam, mesh, out, err);
  if (args->mesh == SW_LATTICE_COMPOSITE)
    return sw_calibrate_composite(args, section, &beam, &mesh->composite, out, err);
  if (args->mesh == SW_LATTICE_TUBE && !mesh->tube.core && isnan(mesh->tube.ring_radius))
    SW_TRY(find_radius(args, section, &beam, mesh, out, err));
  else
    SW_TRY(try_mesh(args, section, &beam, mesh, out, err));
  return check_reached(args, mesh, &beam, out, err);
}

/* Least hoop stiffness of a coreless ring, over its wall's, Et h/chord. If slices are longer than
 * largest_spacing, only soft hoops let EI and GJ be met together. Bent to a strain of 1 %, slices
 * with hoops below a fifth wrinkle (at 0.06 the moment drops by 30 %); at 0.5 they do not [-]. */
static const double LEAST_HOOP = 0.3;

sw_status sw_calibrate_check_bent(const sw_calibration *c, sw_error *err) {
  const size_t M = c->lattice.particles;
  const double R = hypot(c->lattice.at[0], c->lattice.at[1]), h = c->lattice.spacing;
  const double chord = 2 * R * sin(M_PI / (double)M);
  const double wall = c->target[SW_TARGET_EA] / (2 * M_PI * R) * h / chord;
  if (c->k[SW_GROUP_HOOP] >= LEAST_HOOP * wall) return SW_OK;
  return sw_fail(
      err, SW_EINVAL,
      "slices of spacing = %.4g m have hoops of %.2g of their wall's stiffness and would "
      "wrinkle when the tube is bent; make spacing less than about %.4g m, or give fewer "
      "than %zu particles",
      h, c->k[SW_GROUP_HOOP] / wall,
      0.8 * largest_spacing(R, c->target[SW_TARGET_EI], c->target[SW_TARGET_GJ], 1, (long)M), M);
}

void sw_calibration_free(sw_calibration *c) {
  sw_lattice_free(&c->lattice);
  sw_free(c->composite.slide);
}
