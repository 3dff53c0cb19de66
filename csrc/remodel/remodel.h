/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes a wire's model during a run, and puts a rigid grip in place of a gripper's pads. */
#ifndef SW_REMODEL_REMODEL_H
#define SW_REMODEL_REMODEL_H

#include "edit/wires.h"
#include "scene/scene.h"

typedef struct sw_remodel_report {
  double energy_before, energy_after; /* of the scene [J] */
  sw_vec about;                       /* the wire's centre of mass before [m] */
  double before[6], after[6];         /* momentum and its moment [N s], [N m s] */
} sw_remodel_report;

/* Gives the wire another model. Of args only model and segments are read. mesh: as for a new wire,
 * with this wire's section. region: from and to [m]; the wire becomes a mesh only there and beside
 * clamps, and elsewhere a line with the segments of a rod. NULL: all of the wire changes. */
sw_status sw_scene_remodel(sw_scene *scene, sw_handle wire, const sw_wire_args *args,
                           const sw_wire_mesh_args *mesh, const double *region,
                           sw_remodel_report *out, sw_error *err);
extern const sw_params sw_remodel_params;

/* Brings a built scene to rest near its present state, to a tolerance [m] in at most `most`
 * iterations. The stepping code provides it, see sw_scene_balance. */
typedef sw_status sw_balance(sw_scene *scene, double tolerance, long most, sw_error *err);

/* Report of an exchange between pads and a rigid grip. */
typedef struct sw_freeze_report {
  sw_handle hold;                     /* of the frozen wire [-] */
  double s1, s2;                      /* held interval [m] */
  double energy_before, energy_after; /* of the scene [J] */
  double before[6], after[6];         /* momentum and its moment [N s], [N m s] */
  sw_vec force, moment;               /* of the tool before, about its centre [N], [N m] */
  int on_rod;                         /* 1: the thawed pads press on a rod */
} sw_freeze_report;

/* Turns the wire, a mesh between the tool's pads, into a rod that the tool holds rigidly where the
 * pads press. The deformed sections are kept; the pads no longer touch the wire. SW_EINVAL when the
 * pads do not press on a mesh. */
sw_status sw_scene_tool_freeze(sw_scene *scene, sw_handle tool, sw_handle wire, sw_balance *balance,
                               sw_freeze_report *out, sw_error *err);
/* What the jaws do after a thaw. */
typedef enum sw_thaw {
  SW_THAW_HOLDS,  /* go on with their force */
  SW_THAW_OPENS,  /* open */
  SW_THAW_LEAVES, /* open, and the wire stays a rod */
} sw_thaw;
/* Turns it back into a mesh: between the pads as it was, with their friction; elsewhere as the rod
 * lies. If the wire is a mesh between the pads of another tool by now, it stays as it is. Jaws that
 * open on a rod begin where they only touch it. */
sw_status sw_scene_tool_thaw(sw_scene *scene, sw_handle tool, sw_thaw then, sw_balance *balance,
                             sw_freeze_report *out, sw_error *err);

#endif
