/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Another model for a wire during a run, and a rigid grip in place of a gripper's pads. */
#ifndef SW_REMODEL_REMODEL_H
#define SW_REMODEL_REMODEL_H

#include "edit/wires.h"
#include "scene/scene.h"

typedef struct sw_remodel_report {
  double energy_before, energy_after; /* of the scene [J] */
  sw_vec about;                       /* the wire's centre of mass before [m] */
  double before[6], after[6];         /* its momentum and the moment of that [N s], [N m s] */
} sw_remodel_report;

/* Another model for the wire from now on: of args model and segments are read. mesh: as for a new
 * wire, its section that of the wire. region: from and to [m]; only there, and beside clamps, the
 * wire is the mesh, elsewhere a line of as many segments as a rod; NULL: all of it. */
sw_status sw_scene_remodel(sw_scene *scene, sw_handle wire, const sw_wire_args *args,
                           const sw_wire_mesh_args *mesh, const double *region,
                           sw_remodel_report *out, sw_error *err);
extern const sw_params sw_remodel_params;

/* Brings a built scene to rest where it is, to a tolerance in so many iterations at most: who steps
 * gives it, see sw_scene_balance [m]. */
typedef sw_status sw_balance(sw_scene *scene, double tolerance, long most, sw_error *err);

/* What a change between pads and a rigid grip did. */
typedef struct sw_freeze_report {
  sw_handle hold;                     /* of the frozen wire [-] */
  double s1, s2;                      /* held interval [m] */
  double energy_before, energy_after; /* of the scene [J] */
  double before[6], after[6];         /* momentum and its moment [N s], [N m s] */
  sw_vec force, moment;               /* of the tool before, about its centre [N], [N m] */
} sw_freeze_report;

/* The wire, a mesh between the tool's pads, becomes a rod that the tool holds rigidly where the
 * pads press on it; its deformed sections are kept. Pads no longer touch it. SW_EINVAL when
 * they do not press on a mesh. */
sw_status sw_scene_tool_freeze(sw_scene *scene, sw_handle tool, sw_handle wire, sw_balance *balance,
                               sw_freeze_report *out, sw_error *err);
/* Back again: the mesh as it was between the pads, with their friction; elsewhere as the rod lies.
 */
sw_status sw_scene_tool_thaw(sw_scene *scene, sw_handle tool, sw_balance *balance,
                             sw_freeze_report *out, sw_error *err);

#endif
