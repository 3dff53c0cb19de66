/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calibration of a mesh: springs, or solid elements and springs, with which the mesh as a beam is
 * exactly the wire: EA, EI, GJ, and on request a stiffness of springs against squeezing. */
#ifndef SW_CALIBRATE_CALIBRATE_H
#define SW_CALIBRATE_CALIBRATE_H

#include "base/param.h"
#include "base/tape.h"
#include "calibrate/cell.h"
#include "calibrate/composite.h"
#include "calibrate/lattice.h"
#include "wire/wire.h"

enum { SW_LATTICE_TUBE, SW_LATTICE_RADIAL, SW_LATTICE_CUBIC, SW_LATTICE_COMPOSITE };
enum { SW_BODY_SPRINGS, SW_BODY_SOLID };

/* Returns the number of the mesh called name, which must be one of them. */
int sw_calibrate_mesh(const char *name);

typedef struct sw_calibrate_args {
  int mesh;         /* [-] */
  double squeeze;   /* stiffness against squeezing; NAN: not requested [Pa] */
  double spacing;   /* NAN: chosen [m] */
  double tolerance; /* largest residual that is accepted [-] */
  int body;         /* SW_BODY_SPRINGS or SW_BODY_SOLID [-] */
} sw_calibrate_args;
extern const sw_params sw_calibrate_params;

/* Arguments of all meshes; only those of the chosen mesh are read. */
typedef struct sw_lattice_args {
  sw_tube_args tube;
  sw_radial_args radial;
  sw_cubic_args cubic;
  sw_composite_args composite;
} sw_lattice_args;
const sw_params *sw_lattice_params(int mesh);
void *sw_lattice_place(sw_lattice_args *args, int mesh); /* the struct that the rows fill */

/* For meshes of several materials: sets those of EA, EI, GJ and mass per length that *section
 * leaves open. object names the wire in messages. */
sw_status sw_calibrate_materials(const char *object, int mesh, int body,
                                 const sw_lattice_args *args, sw_section *section, sw_error *err);

/* EI: bending in the plane of x and z; EI2: in the plane of y and z. */
enum { SW_TARGET_EA, SW_TARGET_EI, SW_TARGET_EI2, SW_TARGET_GJ, SW_TARGET_SQUEEZE, SW_TARGETS };
extern const char *const sw_target_names[SW_TARGETS];
extern const char *const sw_target_units[SW_TARGETS];

typedef struct sw_calibration {
  sw_lattice lattice;
  double k[SW_GROUPS];         /* stiffness [N/m, of bending N m, of solid Pa]; 0 without links */
  size_t links[SW_GROUPS];     /* number in one slice; of solid the elements [-] */
  double target[SW_TARGETS];   /* NAN: not requested */
  double residual[SW_TARGETS]; /* reached / target - 1; NAN: not requested [-] */
  sw_cell_result reached;
  int faded;              /* group that softened most from its first guess; SW_GROUPS: none */
  double fading;          /* its stiffness over the first guess [-] */
  double mass_per_length; /* NAN: not given [kg/m] */
  double nu;              /* of solid elements, whose modulus is k[SW_GROUP_SOLID]; else 0 [-] */
  double core_nu;         /* the same for a composite's core [-] */
  double scale;           /* mesh size over the section's size; 1 for springs [-] */
  sw_composite composite; /* all 0 for other meshes */
} sw_calibration;

/* SW_EINVAL if the slices of a coreless tube with a bending wall would wrinkle under bending. */
sw_status sw_calibrate_check_bent(const sw_calibration *c, sw_error *err);

/* Calibrates a mesh. Free out with sw_calibration_free, also after an error. section: the wire's
 * values; EA, EI and GJ must follow from it. SW_EINVAL names the value that is out of range, or the
 * target that the mesh cannot reach and a remedy. */
sw_status sw_calibrate(const sw_calibrate_args *args, const sw_section *section,
                       sw_lattice_args *mesh, sw_calibration *out, sw_error *err);
void sw_calibration_free(sw_calibration *calibration);
/* Reading fills an empty calibration; free it also after a failure. */
void sw_tape_calibration(sw_tape *tape, sw_calibration *calibration);

/* Finds the springs of a lattice for the targets of out, starting from first guesses. With elements
 * the search starts from out->k. */
sw_status sw_calibrate_fit(sw_calibration *out, sw_error *err);

/* sw_calibrate for a composite, once beam has the wire's values and out its targets and mass. */
sw_status sw_calibrate_composite(const sw_calibrate_args *args, const sw_section *section,
                                 const sw_beam *beam, const sw_composite_args *given,
                                 sw_calibration *out, sw_error *err);

double sw_reached(const sw_cell_result *result, int target); /* [unit of the target] */

#endif
