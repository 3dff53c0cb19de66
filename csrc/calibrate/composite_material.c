/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Materials of a core and the shell around it, and the beam that they form. Sections stay plane, so
 * EA = sum of E_i A_i, EI = sum of E_i I_i and GJ = sum of G_i J_i. Parts with different Poisson's
 * ratios also press on each other under tension, which increases EA (Hill, J. Mech. Phys. Solids 12
 * (1964) 199): by 0.1 % for nu = 0.3 and 0.4, but by several % if one part is nearly incompressible
 * and the other is like cork. The mesh has this effect too; it is calibrated to the sums. */
#include <math.h>
#include <string.h>

#include "calibrate/composite_solid.h"

static const double FITS = 0.49;  /* largest Poisson's ratio taken from EI and GJ [-] */
static const double APART = 1e6;  /* largest ratio of two parts' moduli [-] */
static const double SOLVED = 1e4; /* largest ratio that EA and EI can determine [-] */

/* Returns the given modulus of the core; NAN: not given. */
static double core_modulus(const sw_composite_args *a, const sw_composite *c) {
  return isnan(a->core_E) ? a->core_EA / sw_composite_measure(c).core : a->core_E;
}

static void fill(double *value, double with) {
  if (isnan(*value)) *value = with;
}

/* Passes an error on under the name of the wire. */
static sw_status renamed(const char *object, sw_status status, const sw_error *why, sw_error *err) {
  const char *text = strncmp(why->text, "calibrate: ", 11) == 0 ? why->text + 11 : why->text;
  return sw_fail(err, status, "%s: %.400s", object, text);
}

sw_status sw_composite_section(const char *object, const sw_composite_args *args,
                               sw_section *section, sw_error *err) {
  sw_composite c;
  sw_error why = {""};
  if (isnan(section->radius) || isnan(section->E)) return SW_OK; /* reported later, or not given */
  const sw_status status = sw_composite_place_solid(args, section->radius, &c, &why);
  if (status != SW_OK) return renamed(object, status, &why, err);
  const sw_composite_areas of = sw_composite_measure(&c);
  const double given = core_modulus(args, &c), E = section->E, core_E = isnan(given) ? E : given;
  const double nu = isnan(section->nu) ? SW_USUAL_POISSON : section->nu;
  const double core_nu = isnan(args->core_nu) ? nu : args->core_nu;
  fill(&section->EA, E * of.shell + core_E * of.core);
  fill(&section->EI, E * of.shell_I + core_E * of.core_I);
  fill(&section->GJ, E * of.shell_I / (1 + nu) + core_E * of.core_I / (1 + core_nu));
  if (!isnan(args->core_density) && !isnan(section->density))
    fill(&section->mass_per_length, section->density * of.shell + args->core_density * of.core);
  return SW_OK;
}

/* Ratio for a given core modulus. The shell has the rest of EA, unless its modulus is given too. */
static sw_status given_ratio(const sw_composite_args *a, const sw_section *section,
                             const sw_beam *beam, const sw_composite_areas *of, double core_E,
                             double *ratio, sw_error *err) {
  const double left = beam->EA - core_E * of->core;
  const double E = isnan(section->E) ? left / of->shell : section->E;
  const double most = beam->EA / (isnan(a->core_E) ? 1 : of->core);
  const char *name = isnan(a->core_E) ? "core_EA" : "core_E";
  const char *unit = isnan(a->core_E) ? "N" : "Pa";
  const double value = isnan(a->core_E) ? a->core_EA : a->core_E;
  if (!(E > 0))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: %s = %.6g %s must be in (0, %.6g) %s, so that the shell has a part "
                   "of the wire's EA = %.6g N",
                   name, value, unit, most, unit, beam->EA);
  *ratio = core_E / E;
  if (*ratio <= APART && *ratio >= 1 / APART) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "calibrate: %s = %.6g %s makes the core %.3g times as stiff as the shell, whose E "
                 "is %.6g Pa; allowed are %g to %g times",
                 name, value, unit, *ratio, E, 1 / APART, APART);
}

sw_status sw_composite_ratio(const sw_composite_args *a, const sw_section *section,
                             const sw_beam *beam, const sw_composite *c, double *ratio,
                             sw_error *err) {
  const sw_composite_areas of = sw_composite_measure(c);
  const double core_E = core_modulus(a, c);
  if (!isnan(core_E)) return given_ratio(a, section, beam, &of, core_E, ratio, err);
  /* EI (As + x Ac) = EA (Is + x Ic) */
  const double x =
      (beam->EA * of.shell_I - beam->EI * of.shell) / (beam->EI * of.core - beam->EA * of.core_I);
  *ratio = x >= 1 / SOLVED && x <= SOLVED ? x : 1;
  return SW_OK;
}

void sw_composite_poisson(const sw_composite_args *a, const sw_section *section,
                          const sw_beam *beam, const sw_composite *c, double ratio, double *nu,
                          double *core_nu) {
  const sw_composite_areas of = sw_composite_measure(c);
  const double E = beam->EI / (of.shell_I + ratio * of.core_I);
  const double shell = E * of.shell_I, core = ratio * E * of.core_I;
  *nu = section->nu;
  *core_nu = isnan(a->core_nu) ? section->nu : a->core_nu;
  if (!isnan(*nu)) return;
  const double known = isnan(*core_nu) ? 0 : core / (1 + *core_nu);
  const double x = (isnan(*core_nu) ? shell + core : shell) / (beam->GJ - known) - 1;
  if (x >= 0 && x <= FITS) *nu = x;
  if (isnan(*core_nu)) *core_nu = *nu;
}
