-- SPDX-License-Identifier: GPL-3.0-or-later
--- The command `softworld new NAME`: writes a script to begin with.
-- @module softworld.program.new
local core = require "softworld.core"
local sink = require "softworld.output.sink"

local text = [=[
-- @title@: a gripper lifts a wire over a wall and lays it down behind it.
-- Run it:            softworld @file@
-- Look it over:      softworld lint @file@
-- What there is:     softworld doc, softworld doc wire, ...
local sw = require "softworld"
local mm, MPa = sw.units.mm, sw.units.MPa -- everything is in SI units; these convert

-- 1. The place of work. Obstacles: plane box sphere cylinder capsule torus hull mesh (STL, OBJ, PLY).
local scene = sw.scene { name = @name@ }
scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
scene:obstacle { name = "wall", shape = "box", size = mm { 20, 400, 60 }, at = mm { 150, 0, 30 },
  friction = 0.3 }

-- 2. The wire, straight on the table. Instead of E, density and radius: cable = "GXL 1.5", see sw.cables().
local wire = scene:wire { name = "wire", E = MPa(50), density = 1500, radius = mm(2.5),
  from = mm { 100, 0, 2.5 }, to = mm { -500, 0, 2.5 }, segments = 60 }
scene:force { kind = "damping", on = wire, stiffness = sw.units.ms(5) }

-- 3. What happens, step by step. s is the arc length from the wire's start [m].
local gripper = scene:gripper { name = "gripper", pads = { width = mm(20) } }
scene:process(function(p)
  gripper:grasp(wire, { s = mm(30) })
  gripper:move { by = mm { 0, 0, 120 }, speed = 0.25 }
  gripper:move { by = mm { 250, 0, 0 }, speed = 0.25 }
  gripper:move { by = mm { 0, 0, -115 }, speed = 0.25 }
  gripper:release()
  p:wait(0.5)
end)

-- 4. Compute it. tolerance: how far places may be off [m].
local run = scene:run { tolerance = 1e-4, progress = true }
assert(run.ok, run.reason)

-- 5. What came out.
run:summary()
print(("peak force of the gripper: %.3g N; smallest bend radius: %.3g mm"):format(gripper.peak_force,
  1e3 * wire:min_bend_radius()))
run:picture { path = @png@, count = 3, colour = "curvature" } -- a strip of pictures
run:report(@html@) -- open this in a browser: the run moves
-- run:save(@csv@)                                                  -- a table for a spreadsheet
-- run:chart { path = @svg@, columns = { "gripper.force" } }        -- needs gnuplot
]=]

local function usage(why)
  io.stderr:write("softworld: ", why, "; usage: softworld new NAME\n")
  return 2
end

--- Returns the exit status: 0; 1 if the file exists or cannot be written; 2 for a wrong call.
return function(name, more)
  if not name then return usage "new wants a name" end
  if more then return usage "new takes one name" end
  local path = name:find "%.lua$" and name or name .. ".lua"
  local base = sink.base(path):gsub("%.lua$", "")
  if base == "" then return usage(("'%s' is not the name of a file"):format(name)) end
  if name:sub(1, 1) == "-" then return usage(("there is no option '%s'"):format(name)) end
  if base:find "%c" then return usage "the name has control characters" end
  if core.kind(path) then
    io.stderr:write(("softworld: %s is there already; nothing was written\n"):format(path))
    return 1
  end
  local words = { title = base, file = sink.base(path), name = ("%q"):format(base) }
  for _, kind in ipairs { "png", "html", "csv", "svg" } do words[kind] = ("%q"):format(base .. "."
    .. kind) end
  local fine, why = pcall(sink.write_file, path, (text:gsub("@(%l+)@", words)))
  if not fine then
    io.stderr:write("softworld: ", why, "\n")
    return 1
  end
  print(("wrote %s; run it: softworld %s"):format(path, sink.quote(path)))
  return 0
end
