-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of the methods and fields that the core gives obstacles, joins, forces and objects of particles.
-- @module softworld.calls.obstacle
local rows = require "softworld.rows"

rows.calls{
  { "obstacle.name", nil, "name in messages and series", "text" },
  { "obstacle.shape", nil, "its shape, in its own axes", "a shape" },
  { "obstacle.present", nil, "whether it is still in its scene", "true or false" },
  { "obstacle:force", "", "force of wires on it: mean over the last step, impacts included",
    "{x, y, z} [N]" },
  { "obstacle:moment", "{ at = }", "moment of wires on it, about a point [m] (default: the world's origin, "
    .. "not its own)", "{x, y, z} [N m]" },
  { "obstacle:over", "t1, t2, { window = }", "its loads between two times; without times, of the whole "
    .. "series",
    "see help 'peaks'" },
  { "obstacle:pose", "position, rotation", "its pose, or sets it", "{x, y, z} [m], {w, x, y, z}" },
  { "obstacle:follow", "{ points =, times =, ... }",
    "moves it along a trajectory; nil stops it, see help 'trajectory'" },
  { "obstacle:remove", "", "takes it out of the scene" },
  { "obstacle:log", "t1, t2", "values of each step between two times, and one more step on each side",
    "{ t, fx, fy, fz, span, t, ... } [s], [N], [s], count" },

  { "join.name", nil, "name in messages and series", "text" },
  { "join.held", nil, "true as long as it holds", "true or false" },
  { "join:force", "k", "on its end number k", "{x, y, z} [N]" },
  { "join:moment", "k", "moment on its end number k, about its point", "{x, y, z} [N m]" },
  { "join:read", "", "of a tie: distance, tension, peak, whether it broke", "a table [m], [N], [s]" },
  { "join:log", "t1, t2", "of a tie: values of each step between two times, and one more step on each side",
    "{ t, fx, fy, fz, t, ... } [s], [N], count" },
  { "join:release", "", "lets go" },

  { "force.kind", nil, "name of its kind", "text" },
  { "force.held", nil, "true as long as it acts", "true or false" },
  { "force:read", "wire", "readings of its kind for a wire", "a table" },
  { "force:call_it", "name", "sets its name in events" },
  { "force:log", "t1, t2", "values of each step between two times, and one more step on each side",
    "{ t, fx, fy, fz, t, ... } [s], [N] on wires, count" },
  { "force:release", "", "ends its action" },

  { "particles.name", nil, "name in messages and series", "text" },
  { "particles.present", nil, "whether it is still in its scene", "true or false" },
  { "particles.count", nil, "number of particles", "count" },
  { "particles.mass", nil, "mass of all particles", "kg" },
  { "particles.radius", nil, "radius of each", "m" },
  { "particles:positions", "", "of all", "{x1, y1, z1, x2, ...} [m]" },
  { "particles:velocities", "", "of all", "{vx1, vy1, vz1, vx2, ...} [m/s]" },
  { "particles:particle", "i", "of one", "{x, y, z} [m], {x, y, z} [m/s]" },
  { "particles:links", "", "values of all links", "pull [N], strain, lasting strain: three lists" },
  { "particles:energy", "", "energy of this object alone, by kind", "a table [J]" },
  { "particles:set_velocity", "v, omega, about",
    "moves it like a rigid body, or by a list with three numbers for each particle [m/s]" },

  { "snapshot:close", "", "frees its memory" },
}
