-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of the methods and fields that the core gives obstacles, joins, forces and objects of particles.
-- @module softworld.calls.obstacle
local rows = require "softworld.rows"

rows.calls{
  { "obstacle.name", nil, "name in messages and series", "text" },
  { "obstacle.shape", nil, "its shape, in its own axes", "a shape" },
  { "obstacle.present", nil, "whether it is in its scene still", "true or false" },
  { "obstacle:force", "", "of wires on it: the mean over the last step, blows included", "{x, y, z} [N]" },
  { "obstacle:moment", "", "of wires on it, about its origin", "{x, y, z} [N m]" },
  { "obstacle:over", "t1, t2, { window = }", "its loads between two times, which may be left out",
    "see help 'peaks'" },
  { "obstacle:pose", "position, rotation", "where it is, or puts it there", "{x, y, z} [m], {w, x, y, z}" },
  { "obstacle:follow", "{ points =, times =, ... }",
    "moves it along a trajectory; nil stops it, see help 'trajectory'" },
  { "obstacle:remove", "", "takes it out of the scene" },
  { "obstacle:log", "t1, t2", "steps, between two times and one more on each side",
    "{ t, fx, fy, fz, span, t, ... } [s], [N], [s], count" },

  { "join.name", nil, "name in messages and series", "text" },
  { "join.held", nil, "whether it holds still", "true or false" },
  { "join:force", "k", "on its end number k", "{x, y, z} [N]" },
  { "join:moment", "k", "on its end number k, about its point", "{x, y, z} [N m]" },
  { "join:read", "", "of a tie: distance, tension, peak, whether it broke", "a table [m], [N], [s]" },
  { "join:log", "t1, t2", "of a tie: steps, between two times and one more on each side",
    "{ t, fx, fy, fz, t, ... } [s], [N], count" },
  { "join:release", "", "lets go" },

  { "force.kind", nil, "what it is", "text" },
  { "force.held", nil, "whether it acts still", "true or false" },
  { "force:read", "wire", "what its kind has to tell of a wire", "a table" },
  { "force:call_it", "name", "its name in events" },
  { "force:log", "t1, t2", "steps, between two times and one more on each side",
    "{ t, fx, fy, fz, t, ... } [s], [N] on wires, count" },
  { "force:release", "", "it acts no more" },

  { "particles.name", nil, "name in messages and series", "text" },
  { "particles.present", nil, "whether it is in its scene still", "true or false" },
  { "particles.count", nil, "number of particles", "count" },
  { "particles.mass", nil, "of all of them", "kg" },
  { "particles.radius", nil, "of each", "m" },
  { "particles:positions", "", "of all", "{x1, y1, z1, x2, ...} [m]" },
  { "particles:velocities", "", "of all", "{vx1, vy1, vz1, vx2, ...} [m/s]" },
  { "particles:particle", "i", "of one", "{x, y, z} [m], {x, y, z} [m/s]" },
  { "particles:links", "", "of all links", "pull [N], strain, lasting strain: three lists" },
  { "particles:energy", "", "of it alone, by kind", "a table [J]" },
  { "particles:set_velocity", "v, omega, about",
    "as a rigid body, or a list with three numbers for each [m/s]" },

  { "snapshot:close", "", "gives its memory back" },
}
