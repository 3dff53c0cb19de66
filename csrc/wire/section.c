/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beam stiffness from section and material. Solid circle: A = pi r^2, I = pi r^4/4, J = 2 I, G =
 * E/(2 (1 + nu)). */
#include <math.h>
#include <stddef.h>

#include "wire/wire.h"

/* Limits are far beyond any real wire; products of these values stay finite. */
#define ROW(name, unit, least, most, doc) \
  { #name, SW_PARAM_NUMBER, unit, NAN, least, most, 0, NULL, offsetof(sw_section, name), doc }

static const sw_param rows[] = {
    ROW(EA, "N", 1e-12, 1e15, "axial stiffness"),
    {"EI", SW_PARAM_NUMBER, "N m2", NAN, 0, SW_EI_MOST, 0, NULL, offsetof(sw_section, EI),
     "bending stiffness, or {EI1, EI2} with normal; 0 is for model = 'string' only"},
    ROW(GJ, "N m2", 1e-30, 1e15, "twist stiffness"),
    ROW(mass_per_length, "kg/m", 1e-12, 1e9, "mass per length"),
    ROW(radius, "m", 1e-9, 1e3, "outer radius"),
    ROW(E, "Pa", 1e-3, 1e15, "Young's modulus of a solid round wire"),
    {"nu", SW_PARAM_NUMBER, "-", NAN, -1, 0.5, SW_PARAM_ABOVE_MIN, NULL, offsetof(sw_section, nu),
     "Poisson's ratio of a solid round wire (0.35 when not given)"},
    ROW(density, "kg/m3", 1e-6, 1e9, "density of a solid round wire"),
    ROW(spin_inertia, "kg m", 1e-30, 1e15,
        "with rolls: rotational inertia per length about the axis (that of a solid wire, "
        "mass_per_length radius^2/2, when not given)"),
};

const sw_params sw_section_params = SW_PARAMS("wire", rows);

/* No part of the section lies outside the radius, so spin_inertia <= mass radius^2. */
static sw_status set_spin_inertia(const char *object, const sw_section *c, sw_beam *out,
                                  sw_error *err) {
  const double most = out->mass * c->radius * c->radius;
  out->spin_inertia = isnan(c->spin_inertia) ? 0.5 * most : c->spin_inertia;
  if (out->spin_inertia <= most * (1 + 1e-9)) return SW_OK;
  return sw_fail(err, SW_EINVAL,
                 "%s: spin_inertia = %.6g kg m must be in (0, %.6g] kg m, mass_per_length times "
                 "radius^2",
                 object, out->spin_inertia, most);
}

sw_status sw_section_beam(const char *object, const sw_section *c, sw_beam *out, sw_error *err) {
  if (isnan(c->radius))
    return sw_fail(err, SW_EINVAL, "%s: radius is required [m]: outer radius of the wire", object);
  const double area = M_PI * c->radius * c->radius;
  const double I = 0.25 * area * c->radius * c->radius;
  const double nu = isnan(c->nu) ? SW_USUAL_POISSON : c->nu;
  *out = (sw_beam){.radius = c->radius};
  out->EA = isnan(c->EA) ? c->E * area : c->EA;
  out->EI = isnan(c->EI) ? c->E * I : c->EI;
  out->GJ = !isnan(c->GJ) ? c->GJ : !isnan(c->E) ? c->E * I / (1 + nu) : out->EI / (1 + nu);
  out->mass = isnan(c->mass_per_length) ? c->density * area : c->mass_per_length;
  out->E = isnan(c->E) ? out->EA / area : c->E;
  if (isnan(out->EA))
    return sw_fail(err, SW_EINVAL, "%s: give EA [N], or E [Pa] for a solid round wire", object);
  if (isnan(out->EI))
    return sw_fail(err, SW_EINVAL, "%s: give EI [N m2], or E [Pa] for a solid round wire", object);
  if (isnan(out->mass))
    return sw_fail(err, SW_EINVAL,
                   "%s: give mass_per_length [kg/m], or density [kg/m3] for a solid round wire",
                   object);
  out->EI_axis[0] = out->EI;
  out->EI_axis[1] = c->EI2 > 0 ? c->EI2 : out->EI;
  out->framed = c->EI2 > 0;
  if (out->framed && isnan(c->GJ))
    return sw_fail(err, SW_EINVAL, "%s: two values of EI need GJ too [N m2]", object);
  out->EI = fmin(out->EI_axis[0], out->EI_axis[1]);
  return set_spin_inertia(object, c, out, err);
}
