-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of the methods and fields that the core gives a wire.
-- @module softworld.calls.wire
local core = require "softworld.core"
local rows = require "softworld.rows"

rows.calls{
  { "wire.name", nil, "name in messages and series", "text" },
  { "wire.model", nil, "rod, string, tube, radial, cubic or composite", "text" },
  { "wire.length", nil, "its length without load, without the wire on spools", "m" },
  { "wire.segments", nil, "number of edges, or slices of a mesh", "count" },
  { "wire.radius", nil, "of its outside", "m" },
  { "wire.beam", nil, "its section's stiffness", "EA [N], EI, GJ [N m2], mass_per_length [kg/m], ..." },
  { "wire:cable", "", "its entry in the catalogue", "an entry or nil" },
  -- place
  { "wire:position", "s", "place of its centre line at s", "{x, y, z} [m]" },
  { "wire:tangent", "s", "direction of its centre line at s", "{x, y, z}" },
  { "wire:velocity", "s", "of its centre line at s", "{x, y, z} [m/s]" },
  { "wire:positions", "", "of all nodes", "{x1, y1, z1, x2, ...} [m], {s1, s2, ...} [m]" },
  { "wire:velocities", "", "of all nodes", "{vx1, vy1, vz1, vx2, ...} [m/s]" },
  { "wire:particles", "", "particles of a mesh, ring by ring; of other wires the nodes",
    "{x1, y1, z1, x2, ...} [m], {s1, s2, ...} [m]" },
  { "wire:set_velocity", "v, omega, about", "moves it like a rigid body with v [m/s] and omega [rad/s] about "
    .. "a point [m]" },
}

-- internal forces and the like: tension, curvature, ...
for _, r in ipairs(core.registry().readouts) do
  rows.calls{ { "wire:" .. r.name, r.at_place and "s" or "", r.summary, r.unit } }
end

rows.calls{
  { "wire:strain", "s", "of the fibres outside and inside of the bend", "two numbers" },
  { "wire:stress", "s", "of the fibres outside and inside of the bend", "two numbers [Pa]" },
  { "wire:max_tension", "{ window =, now = }", "largest of the run, see help 'peaks'",
    "T [N], s [m], t [s]" },
  { "wire:min_bend_radius", "{ now = }", "smallest of the run", "radius [m], s [m], t [s]" },
  { "wire:bend_sharpness", "{ now = }",
    "how coarse the edges are for that bend, as shares of its curvature: its change from node to node; the "
      .. "part of this by acceleration; how much more, and how much less, a wire at rest may be bent between "
      .. "nodes; the curvature of the round obstacle that presses there, or 0; of a mesh all 0 (not known), "
      .. "but near a hold, where slices bend less than a beam",
    "five numbers [-]" },
  { "wire:max_strain", "{ now = }", "largest of a fibre in the run", "strain, s [m], t [s]" },
  { "wire:max_stress", "{ now = }", "largest of a fibre in the run", "stress [Pa], s [m], t [s]" },
  { "wire:max_torsion", "{ now = }", "largest of the run", "torsion [rad/m], s [m], t [s]" },
  { "wire:bend_limit", "{ use =, now = }", "whether the allowed bend radius is kept",
    "{ ok, radius, limit [m], s [m], t [s] }" },
  -- sections of meshes
  { "wire:section", "s", "a section of a mesh; print it, or read it", "see help 'sections'" },
  { "wire:width", "s, direction", "width of the section at s, across a direction", "m" },
  { "wire:contact_pressure", "s", "pressure of obstacles on the section at s; without s on all sections",
    "a list of { pressure, area, s, at }, .largest [Pa]" },
  { "wire:von_mises", "s", "von Mises stress of solid elements at s; without s of all",
    "a list of { stress, s, at }, .largest [Pa]" },
  { "wire:max_ovalisation", "{ now = }", "largest ovalisation of a section in the run",
    "share, s [m], t [s]" },
  { "wire:folded", "", "where a section of springs first folded through itself", "s [m], t [s], or nothing" },
  { "wire:calibration", "", "springs of its mesh and how they were computed", "see help 'calibrate'" },
  -- the whole wire
  { "wire:frequencies", "{ modes =, shapes =, alone = }", "natural frequencies about the present equilibrium",
    "{ f1, f2, ... } [Hz], see help 'vibration'" },
  { "wire:remodel", "{ model =, ... }", "another model or other edges from now on", "see help 'remodel'" },
  { "wire:log", "t1, t2", "values of each step between two times, and one more step on each side",
    "{ t, tension, curvature, t, ... } [s], [N], [1/m], count" },
}
