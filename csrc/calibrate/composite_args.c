/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters of a composite, and checks of their combinations. */
#include <math.h>

#include "calibrate/composite.h"

static const char *const cores[] = {"line", "radial", "cubic", NULL};

#define AT(member) offsetof(sw_composite_args, member)
#define VALUE(name, unit, doc) \
  { #name, SW_PARAM_NUMBER, unit, NAN, 0, HUGE_VAL, SW_PARAM_ABOVE_MIN, NULL, AT(name), doc }
#define COUNT(name, most, doc) \
  { #name, SW_PARAM_INTEGER, "-", 0, 0, most, 0, NULL, AT(name), doc }
static const sw_param rows[] = {
    {"core", SW_PARAM_CHOICE, "-", SW_CORE_RADIAL, 0, 0, 0, cores, AT(core),
     "a line of particles with springs against bending, layers, or voxels"},
    {"cores", SW_PARAM_INTEGER, "-", 1, 1, SW_COMPOSITE_CORES, 0, NULL, AT(cores),
     "equal cores: one at the axis; 2 to 6 around it; 7 are six around one"},
    VALUE(core_radius, "m",
          "radius of each core (default: 0.6 of the wire's radius; of several cores 0.95 of the "
          "largest that fits)"),
    VALUE(wall, "m",
          "thickness of the shell (default: down to a single core; around several cores 0.2 of the "
          "wire's radius)"),
    VALUE(core_EA, "N",
          "of each core (default: EA less that of a wall that has the rest of EI; of one material "
          "by areas)"),
    VALUE(core_EI, "N m2",
          "of each core about its own axis (default: that of one material that gives the wire's EI "
          "or EA, the softer of both)"),
    VALUE(core_GJ, "N m2", "of each core, with the same default; core = 'line' has none"),
    VALUE(core_mass, "kg/m", "of each core (default: by areas)"),
    VALUE(core_E, "Pa",
          "with body = 'solid': Young's modulus of the core; E [Pa] is that of the shell (default: "
          "core_EA over its area, else from EA and EI; with E that of one material)"),
    {"core_nu", SW_PARAM_NUMBER, "-", NAN, 0, 0.4999, 0, NULL, AT(core_nu),
     "with body = 'solid': Poisson's ratio of the core (default: nu, that of the shell)"},
    VALUE(core_density, "kg/m3",
          "with body = 'solid': density of the core; density is that of the shell"),
    {"bonded", SW_PARAM_BOOLEAN, "-", 1, 0, 1, 0, NULL, AT(bonded),
     "true: springs hold core and shell together; false: they slide, and links of sw.calibrate "
     "with slide = true name the particles that face each other"},
    {"bond", SW_PARAM_NUMBER, "-", 1, 0, 100, SW_PARAM_ABOVE_MIN, NULL, AT(bond),
     "stiffness of bonds over the usual one, which is that of bars of the shell's modulus, with at "
     "most a tenth of the shell's or the cores' EA from slice to slice"},
    {"friction", SW_PARAM_NUMBER, "-", 0, 0, 100, 0, NULL, AT(friction),
     "with bonded = false, in a scene: friction coefficient between shell and cores along the "
     "wire"},
    {"grip", SW_PARAM_NUMBER, "N/m", 0, 0, HUGE_VAL, 0, NULL, AT(grip),
     "with bonded = false, in a scene: radial force per length on each core without bends and "
     "squeezes, which add to it; drawing out a core needs friction * grip * length"},
    COUNT(particles, 64,
          "particles of the shell's ring, 3 or more, a multiple of the cores around the axis; 0 "
          "chooses 12 or more"),
    COUNT(reach, 31, "particles that a diagonal of the shell spans, below half a ring; 0 chooses"),
    COUNT(layers, 6,
          "with body = 'solid': layers of the shell; 0: layers about a third of the wire's radius "
          "thick"),
    COUNT(core_particles, 48,
          "of a radial core: particles of each layer, 3 or more; 0 chooses, 6 as a rule"),
    COUNT(core_layers, 6,
          "layers of a radial core; 0: 2 for one core, 1 for each of several; with body = 'solid' "
          "as thick as layers"),
    COUNT(core_across, 16,
          "of a cubic core: voxels across; 0: 4 for one core, 2 for each of several"),
};
const sw_params sw_composite_params = SW_PARAMS("calibrate", rows);

/* Refuses values of sliding parts for bonded ones. */
static sw_status check_sliding(const sw_composite_args *a, sw_error *err) {
  if (a->bonded && a->friction != 0)
    return sw_fail(err, SW_EINVAL, "calibrate: friction = %g goes with bonded = false",
                   a->friction);
  if (a->bonded && a->grip != 0)
    return sw_fail(err, SW_EINVAL, "calibrate: grip = %g N/m goes with bonded = false", a->grip);
  return SW_OK;
}

/* Also refuses numbers of a core mesh that was not chosen. */
sw_status sw_composite_check(const sw_composite_args *a, sw_error *err) {
  const struct {
    const char *name;
    long value;
    int kind;
  } all[] = {{"core_particles", a->core_particles, SW_CORE_RADIAL},
             {"core_layers", a->core_layers, SW_CORE_RADIAL},
             {"core_across", a->core_across, SW_CORE_CUBIC}};
  for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
    if (all[i].value != 0 && a->core != all[i].kind)
      return sw_fail(err, SW_EINVAL, "calibrate: %s = %ld goes with core = '%s', not with '%s'",
                     all[i].name, all[i].value, cores[all[i].kind], cores[a->core]);
  if (a->core_particles == 1 || a->core_particles == 2)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_particles = %ld is not allowed; it must be 0 (chooses) or in "
                   "[3, 48]",
                   a->core_particles);
  if (!a->bonded && a->bond != 1)
    return sw_fail(err, SW_EINVAL, "calibrate: bond = %g goes with bonded = true", a->bond);
  return check_sliding(a, err);
}

sw_status sw_composite_check_springs(const sw_composite_args *a, sw_error *err) {
  const struct {
    const char *name, *unit;
    double value;
  } all[] = {{"core_E", "Pa", a->core_E},
             {"core_nu", "-", a->core_nu},
             {"core_density", "kg/m3", a->core_density},
             {"layers", "-", a->layers ? (double)a->layers : (double)NAN}};
  for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
    if (!isnan(all[i].value))
      return sw_fail(err, SW_EINVAL,
                     "calibrate: %s = %.6g %s goes with body = 'solid'; for springs give core_EA, "
                     "core_EI, core_GJ and core_mass",
                     all[i].name, all[i].value, all[i].unit);
  return SW_OK;
}

/* Refuses parameters that elements do not use: the core is of one material and part of the same
 * mesh. */
static sw_status check_unused(const sw_composite_args *a, sw_error *err) {
  const struct {
    const char *name, *unit;
    double value, none;
    const char *why;
  } all[] = {
      {"core_EI", "N m2", a->core_EI, (double)NAN, "follows from core_E or core_EA"},
      {"core_GJ", "N m2", a->core_GJ, (double)NAN, "follows from core_E or core_EA, and core_nu"},
      {"bond", "-", a->bond, 1, "is for springs: elements share their particles"},
      {"reach", "-", (double)a->reach, 0, "is of springs"},
      {"core_particles", "-", (double)a->core_particles, 0,
       "follows from particles, which core and shell share"}};
  for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
    const int unused = isnan(all[i].none) ? isnan(all[i].value) : all[i].value == all[i].none;
    if (!unused)
      return sw_fail(err, SW_EINVAL,
                     "calibrate: %s = %.6g %s does not go with body = 'solid': it %s; leave it out",
                     all[i].name, all[i].value, all[i].unit, all[i].why);
  }
  return SW_OK;
}

sw_status sw_composite_check_solid(const sw_composite_args *a, sw_error *err) {
  if (a->cores != 1)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: cores = %ld does not go with body = 'solid', which has one core at "
                   "the axis; take cores = 1, or body = 'springs'",
                   a->cores);
  if (!a->bonded)
    return sw_fail(
        err, SW_EINVAL,
        "calibrate: bonded = false does not go with body = 'solid', whose core and shell "
        "are one mesh; take bonded = true, or body = 'springs'");
  if (a->core != SW_CORE_RADIAL)
    return sw_fail(
        err, SW_EINVAL,
        "calibrate: core = '%s' does not go with body = 'solid'; take core = 'radial', or "
        "body = 'springs'",
        cores[a->core]);
  if (!isnan(a->core_E) && !isnan(a->core_EA))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_E = %.6g Pa and core_EA = %.6g N describe the same stiffness; "
                   "give one of them",
                   a->core_E, a->core_EA);
  if (!isnan(a->core_density) && !isnan(a->core_mass))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_density = %.6g kg/m3 and core_mass = %.6g kg/m describe the "
                   "same mass; give one of them",
                   a->core_density, a->core_mass);
  return check_unused(a, err);
}
