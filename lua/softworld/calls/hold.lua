-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of the methods and fields that the core gives clamps, pins, grips, feeds and sliders.
-- @module softworld.calls.hold
local rows = require "softworld.rows"

rows.calls{
  { "clamp.name", nil, "name in messages and series", "text" },
  { "clamp.kind", nil, "the method that made it", "text" },
  { "clamp.held", nil, "whether it holds still", "true or false" },
  { "clamp:force", "", "on the wire", "{x, y, z} [N]" },
  { "clamp:moment", "", "on the wire, about the clamp's place", "{x, y, z} [N m]" },
  { "clamp:pose", "position, rotation", "where it is, or puts it there", "{x, y, z} [m], {w, x, y, z}" },
  { "clamp:follow", "{ points =, times =, ... }",
    "moves it along a trajectory; nil stops it, see help 'trajectory'" },
  { "clamp:release", "", "lets go" },
  { "clamp:crash", "", "when it drove the wire into an obstacle last", "t [s], depth [m], name; or nil" },
  { "clamp:get", "", "values of its rows, as it is now", "a table" },
  { "clamp:set", "{...}", "those that may be changed, such as a slider's friction, from now on" },
  { "clamp:read", "", "all that its kind has to tell, by name", "a table" },
  { "clamp:log", "t1, t2", "steps, between two times and one more on each side",
    "{ t, force, moment, point, t, ... } [s], [N], [N m], [m]; count" },
}
for kind, list in pairs{
  slider = { { "place", "", "along its rail", "s [m], speed [m/s], force [N]" } },
  feed = {
    { "fed", "", "length paid out so far, without load", "m" },
    { "feed", "{ length =, speed = or duration = }", "pays out that length from now on", "seconds it takes" },
    { "speed", "v", "the present speed, or sets it", "m/s" },
    { "push", "force", "drives the wire by a force instead of a speed [N]" },
    { "force_limit", "force", "the drive slips above it; nil: never", "N" },
    { "drive_force", "", "of the drive on the wire; the guide's walls bear the rest", "N" },
  },
} do
  for _, c in ipairs(list) do
    rows.call("clamp:" .. c[1], c[2], ("%s (a %s)"):format(c[3], kind), { gives = c[4] })
  end
end
