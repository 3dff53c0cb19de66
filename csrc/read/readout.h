/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of a wire that are one number. Each is one sw_readout, one name in SW_READOUTS, and a
 * method of wires in Lua. Each is right for every model, or refuses with SW_EINVAL and a text that
 * names the wire and its model; a 0 is a true 0. */
#ifndef SW_READ_READOUT_H
#define SW_READ_READOUT_H

#include "scene/scene.h"

typedef struct sw_readout {
  const char *name, *unit;
  const char *summary; /* one line without a full stop */
  int at_place;        /* 1: takes an arc length [m] */
  sw_status (*read)(sw_scene *scene, sw_handle wire, double s, double *out, sw_error *err);
} sw_readout;

#define SW_READOUTS(X) X(curvature) X(tension) X(twist_moment) X(spin) X(bend_energy)

#define SW_READOUT(name) extern const sw_readout sw_readout_##name;
SW_READOUTS(SW_READOUT)
#undef SW_READOUT

/* All read-outs, NULL-terminated. */
const sw_readout *const *sw_readout_all(void);

#endif
