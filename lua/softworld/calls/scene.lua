-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of the methods and fields that the core gives a scene. Calls that make objects also have parameters
-- of their own, see help 'wire', 'obstacle', 'clamp', ...
-- @module softworld.calls.scene
local core = require "softworld.core"
local rows = require "softworld.rows"

for _, hold in ipairs(core.registry().holds) do
  rows.calls{ { "scene:" .. hold.name, "wire, {...}", hold.summary, "a clamp" } }
end

rows.calls{
  { "scene.name", nil, "name in messages and files", "text" },
  { "scene.time", nil, "time of its present state", "s" },
  -- parts
  { "scene:wire", "{...}", "a wire, a cable or a tube", "a wire" },
  { "scene:obstacle", "{...}", "a rigid body, fixed or moving", "an obstacle" },
  { "scene:force", "{...}", "acts on wires: damping, wind, a spring, a function of your own", "a force" },
  { "scene:join", "{ ends = {...} }", "wires fixed to each other", "a join" },
  { "scene:particles", "{...}", "any object made of particles", "an object" },
  { "scene:hold", "object, { particles = {...} }", "holds particles", "a clamp" },
  { "scene:wire_contact", "{...}", "which wires touch each other, and how" },
  { "scene:gravity", "g", "the present gravity, or sets it", "{x, y, z} [m/s2]" },
  { "scene:find", "name", "finds the object of this name", "a wire, an obstacle, ..." },
  { "scene:names", "", "names that scene:find knows", "a list" },
  -- computations
  { "scene:run", "{ duration =, dt =, ... }", "computes the motion, see help 'results'", "a run" },
  { "scene:settle", "{ tolerance = }", "finds the equilibrium",
    "{ ok, reason, iterations, residual [N], events, ... }" },
  { "scene:snapshot", "", "keeps its state, for scene:restore", "a snapshot" },
  { "scene:restore", "snapshot", "goes back to the state, with the same bits" },
  { "scene:save", "file", "writes the whole scene to a file; sw.load reads it" },
  { "scene:resume", "file", "goes on from a file that a run of the same script saved",
    "true, or false: no such file" },
  { "scene:close", "", "frees its memory" },
  -- readings
  { "scene:energy", "", "kinetic, gravity, stored by kind, and their total, now", "a table [J]" },
  { "scene:evaluate", "wire, {...}", "energy and force of each kind of force on a wire; changes nothing",
    "{ kind = { energy [J], force [N], product [N], count } }" },
  { "scene:penetration", "", "largest penetration depth of a wire in an obstacle",
    "depth [m], s [m], t [s], now [m]" },
  { "scene:contacts", "", "touches of wires and obstacles, now", "count" },
  { "scene:touches", "", "where wires touch each other, now",
    "a list of { wires, s [m], point [m], normal, force, friction, normal_force [N] }" },
  { "scene:events", "", "events of the run", "a list, and the number of events that had no room" },
  { "scene:tell", "{ kind =, text =, object =, s =, value =, time = }", "adds an event of your own" },
  { "scene:stable_dt", "", "longest stable step of explicit methods", "s" },
  -- for players
  { "scene:frame_count", "", "frames that the run kept", "count" },
  { "scene:frame", "i", "one frame: positions of all that is drawn", "a table" },
  { "scene:clear_frames", "", "forgets them" },
}
