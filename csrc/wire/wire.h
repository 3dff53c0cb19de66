/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wire models. A model is a recipe: its inner forces with their values, and whether the wire
 * carries compression and twist. The scene looks the forces up by name. */
#ifndef SW_WIRE_WIRE_H
#define SW_WIRE_WIRE_H

#include <stddef.h>

#include "base/param.h"
#include "base/status.h"
#include "state/plan.h"

/* Default Poisson's ratio: cable polymers lie between 0.3 and 0.45 [-]. */
#define SW_USUAL_POISSON 0.35

enum { SW_RECIPE_MAX = 8, SW_RECIPE_ARGS = 4 };

typedef struct sw_recipe_term {
  const char *force;           /* name in the force registry */
  double args[SW_RECIPE_ARGS]; /* argument struct, in the order of its header */
} sw_recipe_term;

typedef struct sw_recipe {
  size_t count;
  sw_recipe_term terms[SW_RECIPE_MAX];
  int push;  /* 1: edges carry compression */
  int twist; /* 1: the wire resists twist between two holds */
} sw_recipe;

typedef struct sw_wire_class {
  const char *name;
  const char *summary;
  void (*recipe)(const sw_beam *beam, sw_recipe *out);
  const char
      *mesh; /* the lattice of particles that this model is (room calibrate); NULL: line of nodes */
} sw_wire_class;

/* The recipe of all mesh models; the mesh has their springs. */
void sw_web_recipe(const sw_beam *beam, sw_recipe *out);

const sw_wire_class *sw_wire_find(const char *name);
const sw_wire_class *const *sw_wire_all(void); /* NULL-terminated */

/* A user's values for a wire's section; NAN = not given. */
typedef struct sw_section {
  double EA;              /* [N] */
  double EI;              /* [N m2] */
  double EI2;             /* across the normal, if different [N m2] */
  double GJ;              /* [N m2] */
  double mass_per_length; /* [kg/m] */
  double radius;          /* [m] */
  double E;               /* Young's modulus [Pa] */
  double nu;              /* Poisson's ratio [-] */
  double density;         /* [kg/m3] */
  double spin_inertia;    /* inertia of turning about the axis, per length [kg m] */
} sw_section;

#define SW_EI_MOST 1e15                   /* [N m2] */
extern const sw_params sw_section_params; /* rows of sw_section */

/* Fills the beam from the given values: E, nu, density and radius of a solid circle, overridden by
 * EA, EI, GJ, mass_per_length. SW_EINVAL naming the missing or inconsistent value. object names the
 * wire in messages. */
sw_status sw_section_beam(const char *object, const sw_section *section, sw_beam *out,
                          sw_error *err);

#endif
