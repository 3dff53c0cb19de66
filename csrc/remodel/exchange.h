/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exchanges a gripper's pads on a mesh for a rigid grip on a rod, and back. */
#ifndef SW_REMODEL_EXCHANGE_H
#define SW_REMODEL_EXCHANGE_H

#include "grip/frozen.h"
#include "remodel/line.h"
#include "remodel/remodel.h"
#include "scene/gripper.h"

/* Moves the built scene to where it is in balance with its accelerations. rings: the wire's
 * accelerations before the exchange (count x 3), at its rings or nodes. Velocities stay. */
sw_status sw_frozen_balance(sw_scene *scene, size_t wire, const double *rings, size_t count,
                            sw_balance *balance);

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
