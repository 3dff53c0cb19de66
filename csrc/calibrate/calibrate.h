/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Springs, or solid elements and springs, of a mesh for which it is, as a beam, exactly the wire:
 * EA, EI, GJ, and the resistance of springs against squeezing when that is asked for. */
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

/* The number of the mesh called name, which is one of them. */
int sw_calibrate_mesh(const char *name);

typedef struct sw_calibrate_args {
  int mesh;         /* [-] */
  double squeeze;   /* NAN: not asked for [Pa] */
  double spacing;   /* NAN: chosen [m] */
  double tolerance; /* largest residual that is no error [-] */
  int body;         /* springs, or elements [-] */
} sw_calibrate_args;
extern const sw_params sw_calibrate_params;

/* Arguments of the mesh that was chosen; the others are not looked at. */
typedef struct sw_lattice_args {
  sw_tube_args tube;
  sw_radial_args radial;
  sw_cubic_args cubic;
  sw_composite_args composite;
} sw_lattice_args;
const sw_params *sw_lattice_params(int mesh);
void *sw_lattice_place(sw_lattice_args *args, int mesh); /* what the rows are read into */

/* Where a mesh has several materials: puts EA, EI, GJ and mass per length into *section, where
 * these are not given. object names the wire in messages. */
sw_status sw_calibrate_materials(const char *object, int mesh, int body,
                                 const sw_lattice_args *args, sw_section *section, sw_error *err);

/* EI: bending in the plane of x and z; EI2: of y and z. */
enum { SW_TARGET_EA, SW_TARGET_EI, SW_TARGET_EI2, SW_TARGET_GJ, SW_TARGET_SQUEEZE, SW_TARGETS };
extern const char *const sw_target_names[SW_TARGETS];
extern const char *const sw_target_units[SW_TARGETS];

typedef struct sw_calibration {
  sw_lattice lattice;
  double k[SW_GROUPS];         /* of groups without links 0 [N/m, of bending N m, of solid Pa] */
  size_t links[SW_GROUPS];     /* of one slice; of solid its elements [-] */
  double target[SW_TARGETS];   /* NAN: not asked for */
  double residual[SW_TARGETS]; /* reached / target - 1; NAN likewise [-] */
  sw_cell_result reached;
  int faded;              /* group that is softest by its first guess; SW_GROUPS: none is softer */
  double fading;          /* its stiffness by that guess [-] */
  double mass_per_length; /* NAN: not given [kg/m] */
  double nu;              /* of solid elements, whose modulus is k[SW_GROUP_SOLID]; else 0 [-] */
  double core_nu;         /* likewise of a composite's core [-] */
  double scale; /* particles are so many times as far out as the section's; 1 of springs [-] */
  sw_composite composite; /* of other meshes all 0 */
} sw_calibration;

/* SW_EINVAL when the slices of a tube that is a ring alone, with a wall that bends, would wrinkle
 * under bending. */
sw_status sw_calibrate_check_bent(const sw_calibration *c, sw_error *err);

/* out is to be freed with sw_calibration_free also after an error. section: as of a wire; EA,
 * EI and GJ must come out of it. SW_EINVAL names the value that is out of range, or the target
 * that no springs of the mesh can reach and a remedy. */
sw_status sw_calibrate(const sw_calibrate_args *args, const sw_section *section,
                       sw_lattice_args *mesh, sw_calibration *out, sw_error *err);
void sw_calibration_free(sw_calibration *calibration);
/* Reading fills an empty one, which is freed also after a failure. */
void sw_tape_calibration(sw_tape *tape, sw_calibration *calibration);

/* Searches the springs of a lattice for the targets of out, from their first guesses; one with
 * elements from out->k. */
sw_status sw_calibrate_fit(sw_calibration *out, sw_error *err);

/* sw_calibrate for a composite, once the wire's values are read into beam and the targets and
 * mass of out are set. */
sw_status sw_calibrate_composite(const sw_calibrate_args *args, const sw_section *section,
                                 const sw_beam *beam, const sw_composite_args *given,
                                 sw_calibration *out, sw_error *err);

double sw_reached(const sw_cell_result *result, int target); /* [unit of the target] */

#endif
