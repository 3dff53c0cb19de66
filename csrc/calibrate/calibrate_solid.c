/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solid elements calibrated to a wire. A beam of elements alone has EA = E a s^2, EI = E b s^4 and
 * GJ = E c s^4 if its section is scaled by s, whatever the distance of slices. Modulus and scale
 * therefore make EA and EI exact for a wire of one material; the scale is near 1 and corrects for
 * the mesh's corners. GJ then follows from nu; a nu up to 0.03 off the wire's corrects for corners
 * and for warping that the mesh cannot follow. A composite, whose core has its own modulus and nu,
 * meets EA and EI in the same way, with the ratio of core to shell modulus given. Springs along the
 * wire only add to EA and EI: if the wire is stiffer in these, the elements take the modulus of GJ.
 * If it is softer (slipping strands bend easily but hardly untwist), diagonals carry a part of GJ;
 * the least squares of the springs' fit find which part. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"
#include "calibrate/calibrate_inner.h"
#include "calibrate/composite_solid.h"

static const double RUBBER_POISSON = 0.45; /* of insulation, nearly incompressible [-] */
static const double HIGHEST = 0.4999;      /* largest Poisson's ratio with accurate numbers [-] */
static const double ONE_MATERIAL = 0.05;   /* largest error of EI of one material with EA [-] */
static const double GJ_NEAR = 0.02;        /* largest error of GJ that nu can correct [-] */
static const double LEAST = 0.01; /* of EA and EI, where the search of springs starts [-] */

static const double MOST_OFF = 0.03; /* largest correction of Poisson's ratio for GJ [-] */
enum { CORRECTIONS = 8 };

enum { SHARE_SIZE = SW_CELL_SIZE + 1, CORE_SOLID = SW_GROUP_OF_CORE + SW_GROUP_SOLID };
static const unsigned ALONG =
    1U << SW_GROUP_LONGITUDINAL | 1U << SW_GROUP_INNER | 1U << SW_GROUP_CORE;

typedef struct task {
  sw_calibrate_args args; /* with the spacing in use */
  const sw_beam *beam;
  sw_lattice_args *mesh;
  sw_calibration *c;
  int rounded;                           /* 1: the voxels' outer corners lie on the circles [-] */
  double scale;                          /* of the section [-] */
  double ratio;                          /* modulus of a composite's core over the shell's [-] */
  double unit[SW_TARGETS];               /* values for elements of 1 Pa, scale 1 */
  double shares[SW_GROUPS * SHARE_SIZE]; /* parts of unit springs */
} task;

static int is_composite(const task *t) { return t->args.mesh == SW_LATTICE_COMPOSITE; }

/* Sets the modulus of all elements; E: the shell's, or that of all. */
static void set_modulus(task *t, double E) {
  t->c->k[SW_GROUP_SOLID] = E;
  t->c->k[CORE_SOLID] = is_composite(t) ? t->ratio * E : 0;
}

static double share(const task *t, int group, int strain) {
  return t->shares[group * SHARE_SIZE + strain * (SW_CELL_STRAINS + 1)];
}

/* Returns the square of the radius of gyration about y, weighted by moduli. */
static double gyration2(const task *t) {
  const sw_cubic_args *cubic = &t->mesh->cubic;
  const double r = t->beam->radius;
  if (is_composite(t)) {
    const sw_composite_areas of = sw_composite_measure(&t->c->composite);
    return (of.shell_I + t->ratio * of.core_I) / (of.shell + t->ratio * of.core);
  }
  if (t->args.mesh == SW_LATTICE_CUBIC && cubic->section == SW_SECTION_RECTANGLE)
    return cubic->width * cubic->width / 12;
  if (t->args.mesh == SW_LATTICE_CUBIC && cubic->section == SW_SECTION_ANNULUS)
    return 0.25 * (r * r + cubic->inner * cubic->inner);
  return 0.25 * r * r;
}

static int one_material(const task *t) {
  const double *target = t->c->target;
  return fabs(target[SW_TARGET_EI] / (target[SW_TARGET_EA] * gyration2(t)) - 1) <= ONE_MATERIAL;
}

static sw_status check(const task *t, const sw_section *section, sw_error *err) {
  if (t->args.mesh == SW_LATTICE_TUBE)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: mesh = 'tube' is one ring of particles, without room for solid "
                   "elements; use mesh = 'radial', or mesh = 'cubic' with section = 'annulus'");
  if (!isnan(t->args.squeeze))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: squeeze = %g Pa goes with body = 'springs'; the squeeze stiffness "
                   "of solid elements follows from EA, EI, GJ and nu",
                   t->args.squeeze);
  if (!isnan(section->spin_inertia))
    return sw_fail(err, SW_EINVAL, "calibrate: spin_inertia goes with mesh = 'tube' only");
  if (!isnan(section->nu) && !(section->nu >= 0 && section->nu <= HIGHEST))
    return sw_fail(err, SW_EINVAL, "calibrate: nu = %g of solid elements must be in [0, %g]",
                   section->nu, HIGHEST);
  return SW_OK;
}

static void choose_composite_poisson(const task *t, const sw_section *section) {
  sw_calibration *c = t->c;
  sw_composite_poisson(&t->mesh->composite, section, t->beam, &c->composite, t->ratio, &c->nu,
                       &c->core_nu);
  const int fits = one_material(t) || !isnan(section->nu);
  if (!fits || isnan(c->nu)) c->nu = RUBBER_POISSON;
  if (!isnan(t->mesh->composite.core_nu)) return;
  c->core_nu = c->nu;
}

/* Returns the given Poisson's ratio, or the ratio that gives both GJ and EI of a round wire. */
static double poisson(const task *t, const sw_section *section) {
  const int flat =
      t->args.mesh == SW_LATTICE_CUBIC && t->mesh->cubic.section == SW_SECTION_RECTANGLE;
  const double fits = t->beam->EI / t->beam->GJ - 1;
  if (!isnan(section->nu)) return section->nu;
  return !flat && one_material(t) && fits >= 0 && fits <= 0.49 ? fits : RUBBER_POISSON;
}

/* Returns the default spacing: about the width of the outermost elements. Only the wire's curvature
 * needs shorter ones. */
static double usual_spacing(const task *t) {
  const sw_composite *c = &t->c->composite;
  const double r = t->beam->radius;
  const double M = is_composite(t) ? (double)c->ring : (double)t->mesh->radial.particles;
  const double layers =
      is_composite(t) ? (double)(c->layers + c->core_layers) : (double)t->mesh->radial.layers;
  const double chord = 2 * r * sin(M_PI / M);
  return fmin(0.75 * r, fmax(chord, r / layers));
}

/* Moves the outer corners of voxels to the nearer of the section's circles. Otherwise obstacles
 * would press on stairs, and GJ would be 5 % too small. A corner is outer if it has fewer than four
 * elements. Masses then follow the elements' areas. */
static sw_status round_voxels(const task *t, sw_lattice *l, sw_error *err) {
  const double r = t->beam->radius;
  const double inner =
      t->mesh->cubic.section == SW_SECTION_ANNULUS ? t->mesh->cubic.inner : -r; /* never nearer */
  int *elements SW_LOCAL = sw_alloc(l->particles, sizeof *elements);
  if (!elements) return sw_fail(err, SW_ENOMEM, "calibrate: out of memory");
  for (size_t m = 0; m < l->solids; m++)
    for (int a = 0; a < 4; a++) elements[l->solid[m].particle[a]]++;
  for (size_t i = 0; i < l->particles; i++) {
    double *at = l->at + 3 * i, out = hypot(at[0], at[1]);
    const double goal = fabs(out - r) <= fabs(out - inner) ? r : inner;
    if (elements[i] == 4 || !(out > 0)) continue;
    at[0] *= goal / out;
    at[1] *= goal / out;
  }
  sw_lattice_share(l);
  return SW_OK;
}

static sw_status fresh(task *t, double scale, unsigned groups, sw_error *err) {
  sw_calibration *c = t->c;
  sw_lattice_free(&c->lattice);
  if (is_composite(t))
    SW_TRY(
        sw_calibrate_composite_lattice(&c->composite, t->beam, t->args.spacing, &c->lattice, err));
  else
    SW_TRY(sw_calibrate_lattice(&t->args, t->beam, t->mesh, &c->lattice, err));
  if (t->rounded) SW_TRY(round_voxels(t, &c->lattice, err));
  for (size_t m = 0; m < c->lattice.solids; m++)
    c->lattice.solid[m].nu = c->lattice.solid[m].group == CORE_SOLID ? c->core_nu : c->nu;
  c->scale = scale;
  sw_lattice_keep(&c->lattice, groups);
  sw_lattice_scale(&c->lattice, scale);
  sw_calibrate_count(c);
  memset(c->k, 0, sizeof c->k);
  return SW_OK;
}

static sw_status reach(task *t, sw_error *err) {
  const sw_cell cell = sw_lattice_cell(&t->c->lattice);
  SW_TRY(sw_cell_stiffness(&cell, t->c->k, &t->c->reached, NULL, err));
  sw_calibrate_residuals(t->c);
  return SW_OK;
}

static int is_good(const task *t, double near_GJ) {
  for (int g = 0; g < SW_TARGETS; g++) {
    const double allowed = fmax(t->args.tolerance, g == SW_TARGET_GJ ? near_GJ : 0);
    if (fabs(t->c->residual[g]) > allowed) return 0;
  }
  return 1;
}

/* Measures elements of 1 Pa, and finds the scale for one material. */
static sw_status measure(task *t, sw_error *err) {
  SW_TRY(fresh(t, 1, 0, err));
  set_modulus(t, 1);
  SW_TRY(reach(t, err));
  for (int g = 0; g < SW_TARGETS; g++) t->unit[g] = sw_reached(&t->c->reached, g);
  t->scale = sqrt(gyration2(t) * t->unit[SW_TARGET_EA] / t->unit[SW_TARGET_EI]);
  return SW_OK;
}

static sw_status elements_alone(task *t, sw_error *err) {
  const double *target = t->c->target, *unit = t->unit;
  const double s2 =
      target[SW_TARGET_EI] / target[SW_TARGET_EA] * unit[SW_TARGET_EA] / unit[SW_TARGET_EI];
  SW_TRY(fresh(t, sqrt(s2), 0, err));
  set_modulus(t, target[SW_TARGET_EA] / (unit[SW_TARGET_EA] * s2));
  return reach(t, err);
}

/* The same, with the Poisson's ratio that also gives GJ. If no allowed ratio does, GJ is as near as
 * possible. */
static sw_status one_that_twists(task *t, sw_error *err) {
  const double nu = t->c->nu, core_nu = t->c->core_nu;
  SW_TRY(elements_alone(t, err));
  if (!is_good(t, GJ_NEAR)) return SW_OK;
  for (int k = 0; k < CORRECTIONS && !is_good(t, 0); k++) {
    const double fits = (1 + t->c->nu) * (1 + t->c->residual[SW_TARGET_GJ]) - 1;
    const double off = fmax(-MOST_OFF, fmin(fits - nu, MOST_OFF)); /* the same for core and shell */
    t->c->nu = fmin(HIGHEST, nu + off);
    t->c->core_nu = fmin(HIGHEST, core_nu + off);
    SW_TRY(measure(t, err));
    SW_TRY(elements_alone(t, err));
  }
  return SW_OK;
}

/* Finds each group's shares of EA, EI and GJ for unit springs. */
static void measure_springs(task *t) {
  const sw_cell cell = sw_lattice_cell(&t->c->lattice);
  double one[SW_GROUPS], S[SW_CELL_SIZE];
  for (int g = 0; g < SW_GROUPS; g++) one[g] = g != SW_GROUP_SOLID && g != CORE_SOLID;
  sw_cell_affine(&cell, one, S, t->shares);
}

/* Finds springs along the wire with this EA and EI. The springs off the axis give EI: all with the
 * same modulus if this leaves some EA for the axis, else the outermost alone. 0: there are none. */
static int springs_along(task *t, double EA, double EI) {
  double *k = t->c->k;
  const double EA_out = share(t, SW_GROUP_LONGITUDINAL, SW_CELL_STRETCH);
  const double EA_in = share(t, SW_GROUP_INNER, SW_CELL_STRETCH);
  const double EI_out = share(t, SW_GROUP_LONGITUDINAL, SW_CELL_ABOUT_Y);
  const double EI_in = share(t, SW_GROUP_INNER, SW_CELL_ABOUT_Y);
  const double EA_core = share(t, SW_GROUP_CORE, SW_CELL_STRETCH);
  const double EI_core = share(t, SW_GROUP_CORE, SW_CELL_ABOUT_Y);
  const int core = EA_core > 0;
  for (int both = EI_in > 0; both >= 0; both--) {
    const double EAs = EA_out + both * EA_in, EIs = EI_out + both * EI_in;
    const double b = core ? EA_core : EA_in, d = core ? EI_core : EI_in;
    const double det = EAs * d - EIs * b; /* rows: EA, EI; columns: off the axis, on it */
    if (!(fabs(det) > 0) || (both && !core)) continue;
    const double off = (EA * d - EI * b) / det, at = (EAs * EI - EIs * EA) / det;
    if (!(off >= 0) || !(at >= 0)) continue;
    k[SW_GROUP_LONGITUDINAL] = off;
    if (t->c->links[SW_GROUP_INNER]) k[SW_GROUP_INNER] = both ? off : core ? 0 : at;
    if (core) k[SW_GROUP_CORE] = at;
    return 1;
  }
  return 0;
}

/* The elements give GJ, springs along the wire the rest of EA and EI. *possible: 0 if the elements
 * alone already exceed EA or EI. */
static sw_status with_springs(task *t, int *possible, sw_error *err) {
  const double *target = t->c->target, s2 = t->scale * t->scale;
  const double E = target[SW_TARGET_GJ] / (t->unit[SW_TARGET_GJ] * s2 * s2);
  SW_TRY(fresh(t, t->scale, ALONG, err));
  measure_springs(t);
  *possible = springs_along(t, target[SW_TARGET_EA] - E * t->unit[SW_TARGET_EA] * s2,
                            target[SW_TARGET_EI] - E * t->unit[SW_TARGET_EI] * s2 * s2);
  set_modulus(t, E);
  return *possible ? reach(t, err) : SW_OK;
}

/* Returns the largest modulus of the elements at which elements, and the diagonals that supply the
 * rest of GJ, leave some of a target that the diagonals contribute to as well. */
static double room(const task *t, int target, int strain, double power) {
  const double s4 = pow(t->scale, 4), *wanted = t->c->target;
  const double per_GJ =
      share(t, SW_GROUP_DIAGONAL, strain) / share(t, SW_GROUP_DIAGONAL, SW_CELL_TWIST);
  const double own = t->unit[target] * pow(t->scale, power);
  const double left = (1 - LEAST) * wanted[target] - wanted[SW_TARGET_GJ] * per_GJ;
  return fmax(left, LEAST * wanted[target]) /
         fmax(own - t->unit[SW_TARGET_GJ] * s4 * per_GJ, LEAST * own);
}

/* The elements give most of EA or EI, diagonals the rest of GJ; the fit searches all of them. */
static sw_status with_diagonals(task *t, sw_error *err) {
  const double *target = t->c->target, s2 = t->scale * t->scale;
  const double least_EA = LEAST * target[SW_TARGET_EA], least_EI = LEAST * target[SW_TARGET_EI];
  double *k = t->c->k;
  SW_TRY(fresh(t, t->scale, ALONG | 1U << SW_GROUP_DIAGONAL, err));
  measure_springs(t);
  const double whole = target[SW_TARGET_GJ] / (t->unit[SW_TARGET_GJ] * s2 * s2);
  const double E = fmin((1 - LEAST) * whole, fmin(room(t, SW_TARGET_EI, SW_CELL_ABOUT_Y, 4),
                                                  room(t, SW_TARGET_EA, SW_CELL_STRETCH, 2)));
  const double diagonal =
      target[SW_TARGET_GJ] * (1 - E / whole) / share(t, SW_GROUP_DIAGONAL, SW_CELL_TWIST);
  const double EA = target[SW_TARGET_EA] - E * t->unit[SW_TARGET_EA] * s2 -
                    diagonal * share(t, SW_GROUP_DIAGONAL, SW_CELL_STRETCH);
  const double EI = target[SW_TARGET_EI] - E * t->unit[SW_TARGET_EI] * s2 * s2 -
                    diagonal * share(t, SW_GROUP_DIAGONAL, SW_CELL_ABOUT_Y);
  springs_along(t, fmax(EA, least_EA), fmax(EI, least_EI));
  set_modulus(t, E);
  k[SW_GROUP_DIAGONAL] = diagonal;
  for (int g = 0; g < SW_GROUPS; g++) /* the fit works on logarithms */
    if (t->c->links[g] && !(k[g] > 0)) k[g] = least_EA / fmax(share(t, g, SW_CELL_STRETCH), 1e-300);
  return sw_calibrate_fit(t->c, err);
}

static sw_status refuse(const task *t, sw_error *err) {
  const sw_calibration *c = t->c;
  const double r = t->beam->radius, ratio = c->target[SW_TARGET_EI] / c->target[SW_TARGET_EA];
  char advice[160];
  int worst = 0;
  for (int g = 1; g < SW_TARGETS; g++)
    if (fabs(c->residual[g]) > fabs(c->residual[worst])) worst = g;
  if (ratio > 0.45 * r * r)
    snprintf(advice, sizeof advice, "EI/EA = %.3g m2 is too close to half of radius^2 = %.3g m2",
             ratio, r * r);
  else
    snprintf(advice, sizeof advice,
             "reduce spacing = %.4g m, or give a nu for which GJ is near EI/(1 + nu) = %.4g N m2",
             c->lattice.spacing, c->target[SW_TARGET_EI] / (1 + c->nu));
  return sw_fail(err, SW_EINVAL,
                 "calibrate: no solid elements with nu = %.4g and springs of this mesh give %s = "
                 "%.6g %s; the nearest have %.6g %s (%+.2g %%); %s",
                 c->nu, sw_target_names[worst], c->target[worst], sw_target_units[worst],
                 sw_reached(&c->reached, worst), sw_target_units[worst], 100 * c->residual[worst],
                 advice);
}

/* Tries elements alone, which must give EA, EI and nearly GJ; else adds springs. */
static sw_status fit(task *t, double spacing, sw_error *err) {
  int possible = 0;
  sw_status status = measure(t, err);
  if (status == SW_EINVAL && t->rounded) { /* walls of one or two voxels may become too distorted */
    t->rounded = 0;
    status = measure(t, err);
  }
  SW_TRY(status);
  if (one_material(t)) {
    SW_TRY(one_that_twists(t, err));
    if (is_good(t, GJ_NEAR)) return SW_OK;
  }
  SW_TRY(with_springs(t, &possible, err));
  if (possible && is_good(t, 0)) return SW_OK;
  t->args.spacing = spacing; /* diagonals need short slices */
  SW_TRY(with_diagonals(t, err));
  return is_good(t, 0) ? SW_OK : refuse(t, err);
}

/* Sets places and materials of core and shell. */
static sw_status begin_composite(task *t, const sw_section *section, double *core_share,
                                 sw_error *err) {
  const sw_composite_args *given = &t->mesh->composite;
  sw_composite *place = &t->c->composite;
  SW_TRY(sw_composite_place_solid(given, t->beam->radius, place, err));
  SW_TRY(sw_composite_core_share(given, place, t->c->mass_per_length, core_share, err));
  SW_TRY(sw_composite_ratio(given, section, t->beam, place, &t->ratio, err));
  choose_composite_poisson(t, section);
  return SW_OK;
}

static sw_status finish_composite(task *t, double core_share, sw_error *err) {
  sw_calibration *c = t->c;
  sw_composite_weigh(&c->composite, core_share, &c->lattice);
  c->composite.ring_radius *= c->scale;
  return sw_composite_parts(&c->composite, &c->lattice, c->k, err);
}

sw_status sw_calibrate_solid(const sw_calibrate_args *args, const sw_section *section,
                             const sw_beam *beam, sw_lattice_args *mesh, sw_calibration *out,
                             sw_error *err) {
  task t = {.args = *args, .beam = beam, .mesh = mesh, .c = out, .ratio = 1};
  const int composite = args->mesh == SW_LATTICE_COMPOSITE;
  double core_share = 0;
  SW_TRY(check(&t, section, err));
  if (composite)
    SW_TRY(begin_composite(&t, section, &core_share, err));
  else
    out->nu = poisson(&t, section);
  if (isnan(t.args.spacing) && args->mesh != SW_LATTICE_CUBIC) t.args.spacing = usual_spacing(&t);
  t.rounded = args->mesh == SW_LATTICE_CUBIC && mesh->cubic.section != SW_SECTION_RECTANGLE;
  SW_TRY(fit(&t, args->spacing, err));
  return composite ? finish_composite(&t, core_share, err) : SW_OK;
}
