/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exchanges a gripper's pads on a mesh for a rigid grip on a rod, and back. */
#ifndef SW_REMODEL_EXCHANGE_H
#define SW_REMODEL_EXCHANGE_H

#include "grip/frozen.h"
#include "remodel/line.h"
#include "remodel/remodel.h"
#include "scene/gripper.h"

/* SW_EINVAL if a force acts on the wire that does not go with this model. */
sw_status sw_remodel_check_forces(const sw_scene *scene, size_t wire, const sw_wire_class *cls,
                                  sw_error *err);

/* Moves the built scene to where it is in balance with its accelerations. rings: the wire's
 * accelerations before the exchange (count x 3), at its rings or nodes. Velocities stay. */
sw_status sw_frozen_balance(sw_scene *scene, size_t wire, const double *rings, size_t count,
                            sw_balance *balance);

/* A rigid grip that must bear the force of the pads along the wire. */
typedef struct sw_match {
  sw_handle hold;
  size_t wire;
  sw_vec along; /* direction of the wire between the pads, in the tool's axes [-] */
  sw_quat q;    /* orientation of the tool [-] */
  sw_vec about; /* centre of the tool [m] */
  const sw_freeze_report *was;
  const double *rings; /* see sw_frozen_balance */
  size_t count;
  sw_balance *balance;
} sw_match;
/* Balances the wire as sw_frozen_balance does, with the grip shifted along it so that it bears the
 * pads' force, and tells if it does not. A wire that is free to move along itself is only
 * balanced. */
sw_status sw_frozen_match(sw_scene *scene, const sw_match *match);
/* Tells of a force and moment about the tool's centre that differ from those before. to: what bears
 * the wire now, for the text. */
void sw_frozen_tell_jump(sw_scene *scene, size_t wire, const sw_freeze_report *was, sw_vec force,
                         sw_vec moment, const char *to);

/* One end of the grip on a rod that replaces pads on a mesh; in the world's axes. */
typedef struct sw_grip_end {
  double s;        /* arc length [m] */
  sw_vec at;       /* the rod's place there [m] */
  sw_vec director; /* the rod's direction there, along the arc length [-] */
  sw_clamp_give give;
  size_t ring; /* ring of the mesh from which outwards the rod lies like the mesh [-] */
  double turn; /* the load's twist of the rod between that ring and this end [rad] */
} sw_grip_end;

/* An exchange of pads and a rigid grip on a wire. It succeeds, or changes nothing. */
typedef struct sw_exchange {
  sw_handle tool;
  size_t wire;
  sw_frozen *frozen;
  sw_line *line;
  sw_grip_end *ends; /* (2) of the rod */
  sw_balance *balance;
  /* Makes the change in the built scene. rings: accelerations as for sw_frozen_balance. */
  sw_status (*change)(sw_scene *scene, const struct sw_exchange *exchange, const double *rings,
                      size_t count, sw_freeze_report *out, sw_error *err);
} sw_exchange;
sw_status sw_frozen_exchange(sw_scene *scene, const sw_exchange *exchange, sw_freeze_report *out,
                             sw_error *err);

/* Finds the rod's ends before and after the pads at which the rod yields like the mesh, and lies
 * where the mesh lies outside the pads. The scene is built; f holds its stations and frames. */
sw_status sw_frozen_condense(sw_scene *scene, const sw_tool *tool, sw_frozen *f,
                             sw_grip_end ends[2], sw_error *err);

#endif
