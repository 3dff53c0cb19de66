/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gripper's pads on a mesh and a rigid grip on a rod take each other's place. */
#ifndef SW_REMODEL_EXCHANGE_H
#define SW_REMODEL_EXCHANGE_H

#include "grip/frozen.h"
#include "remodel/line.h"
#include "remodel/remodel.h"
#include "scene/gripper.h"

/* Put the built scene where it is in balance with its accelerations; those of the wire are
 * before (count x 3), of its rings or nodes. Velocities stay. */
sw_status sw_frozen_balance(sw_scene *scene, size_t wire, const double *rings, size_t count,
                            sw_balance *balance);

/* One end of the grip on a rod that stands for pads on a mesh; in the world's axes. */
typedef struct sw_grip_end {
  double s;        /* arc length [m] */
  sw_vec at;       /* where the rod is there [m] */
  sw_vec director; /* and where it goes to, along the arc length [-] */
  sw_clamp_give give;
  size_t ring; /* of the mesh, from which on the rod lies like that [-] */
  double turn; /* by which that is turned along the way from there to here [rad] */
} sw_grip_end;

/* A gripper's pads and a rigid grip take each other's place on a wire, or nothing is changed. */
typedef struct sw_exchange {
  sw_handle tool;
  size_t wire;
  sw_frozen *frozen;
  sw_line *line;
  sw_grip_end *ends; /* (2) of the rod */
  sw_balance *balance;
  /* The change itself, in the built scene; of the wire's accelerations before (count x 3). */
  sw_status (*change)(sw_scene *scene, const struct sw_exchange *exchange, const double *rings,
                      size_t count, sw_freeze_report *out, sw_error *err);
} sw_exchange;
sw_status sw_frozen_exchange(sw_scene *scene, const sw_exchange *exchange, sw_freeze_report *out,
                             sw_error *err);

/* The ends, before and after the pads, with which the rod gives way like the mesh and lies
 * where the mesh lies outside of the pads. The scene is built; f knows its stations and frames. */
sw_status sw_frozen_condense(sw_scene *scene, const sw_tool *tool, sw_frozen *f,
                             sw_grip_end ends[2], sw_error *err);

#endif
