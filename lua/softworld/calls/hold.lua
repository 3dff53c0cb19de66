-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of the methods and fields that the core gives clamps, pins, grips, feeds and sliders.
-- @module softworld.calls.hold
local rows = require "softworld.rows"

rows.calls{
  { "clamp.name", nil, "name in messages and series", "text" },
  { "clamp.kind", nil, "name of the method that made it", "text" },
  { "clamp.held", nil, "true as long as it holds", "true or false" },
  { "clamp:force", "", "on the wire", "{x, y, z} [N]" },
  { "clamp:moment", "{ at = }", "moment on the wire, about a point [m] (default: the held point)",
    "{x, y, z} [N m]" },
  { "clamp:pose", "position, rotation", "its pose, or sets it", "{x, y, z} [m], {w, x, y, z}" },
  { "clamp:follow", "{ points =, times =, ... }",
    "moves it along a trajectory; nil stops it, see help 'trajectory'" },
  { "clamp:release", "", "lets go" },
  { "clamp:crash", "", "the last time that it pushed the wire into an obstacle",
    "t [s], depth [m], name; or nil" },
  { "clamp:get", "", "present values of its parameters", "a table" },
  { "clamp:set", "{...}", "changes parameters from now on, such as a slider's friction" },
  { "clamp:read", "", "all readings of its kind, by name", "a table" },
  { "clamp:log", "t1, t2", "values of each step between two times, and one more step on each side",
    "{ t, force, moment, point, t, ... } [s], [N], [N m], [m]; count" },
}
for kind, list in pairs{
  slider = { { "place", "", "its place along the rail", "s [m], speed [m/s], force [N]" } },
  feed = {
    { "fed", "", "length paid out so far, without load", "m" },
    { "feed", "{ length =, speed = or duration = }", "pays out this length from now on", "seconds it takes" },
    { "speed", "v", "the present speed, or sets it", "m/s" },
    { "push", "force", "drives the wire by a force instead of a speed [N]" },
    { "force_limit", "force", "force above which the drive slips; nil: never", "N" },
    { "drive_force", "", "force of the drive on the wire; the guide's walls bear the rest", "N" },
  },
} do
  for _, c in ipairs(list) do
    rows.call("clamp:" .. c[1], c[2], ("%s (a %s)"):format(c[3], kind), { gives = c[4] })
  end
end
