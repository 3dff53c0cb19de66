/* SPDX-License-Identifier: GPL-3.0-or-later */
/* wire:frequencies. */

#include "bind/child.h"

static void push_note(lua_State *L, const sw_modes_result *r) {
  lsw_set_number(L, "growth", r->growth);
  lsw_say(L,
          "unstable in %zu direction%s: the wire would buckle or tip over, growing e-fold in %.2g "
          "s; the frequencies listed are of the other motions",
          r->unstable, r->unstable == 1 ? "" : "s", 1.0 / r->growth);
  lua_setfield(L, -2, "note");
}

/* wire:frequencies{ modes =, shapes = } -> { f1, f2, ... [Hz], unstable = [-], growth = [1/s],
 * note = text, shapes = [1/sqrt(kg)] } */
int lsw_wire_frequencies(lua_State *L) {
  sw_modes_args args;
  size_t nodes;
  lua_settop(L, 2);
  const lsw_self w = lsw_check_self(L, &lsw_class_wire);
  lsw_arguments(L, 2, "wire:frequencies", &sw_modes_params, &args);
  const size_t modes = (size_t)args.modes, each = args.shapes ? 3 * modes : 0;
  sw_modes_result r = {.frequencies = lua_newuserdatauv(L, modes * sizeof(double), 0)};
  double *shapes = lsw_room(L, w, sw_scene_wire_nodes, each, &nodes);
  if (args.shapes) r.shapes = shapes;
  lua_getiuservalue(L, 1, 1); /* Lua functions as forces need the scene at index 1 */
  lua_replace(L, 1);
  LSW_DO_FORCES(L, sw_scene_wire_modes, w.scene, w.id, &args, sw_interrupted, &r);
  lsw_push_flat(L, r.frequencies, r.count);
  lsw_set_integer(L, "unstable", r.unstable);
  if (r.unstable) push_note(L, &r);
  if (args.shapes) lsw_push_rows(L, r.shapes, r.count, 3 * nodes), lua_setfield(L, -2, "shapes");
  return 1;
}
