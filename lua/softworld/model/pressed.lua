-- SPDX-License-Identifier: GPL-3.0-or-later
--- Finds where wires are pressed in a run, and how much.
-- @module softworld.model.pressed
local facts = require "softworld.model.facts"
local flat = require "softworld.model.flat"

local pressed = {}

local PLACE = 0.1     -- least load of a pressed place over the largest load of its time [-]
local FLATTENED = 0.1 -- flattening that always counts [-]
local OVAL, RING = 1.5, 1.1 -- flattening over ovalisation: a solid section widens less than a ring [-]

-- Returns the places of pads whose grip is chosen automatically: middles and half lengths [m].
local function pads_on(context, wire)
  local list = {}
  for _, asked in ipairs(context.data.auto and context.data.auto.asked or {}) do
    if asked.wire == wire then
      local known = type(asked.s) == "number"
      list[#list + 1] = known and asked.s or 0
      list[#list + 1] = known and asked.gripper.pads.width / 2 or math.huge
    end
  end
  return list
end

--- Returns what presses on a line in the stored frames: the largest force per length of touches [N/m]; from
-- where to where it is pressed [m], by at least PLACE of its largest load or of the load that flattens it by
-- a tenth; and the largest load from both sides [N/m]. A line cannot tell the last one, because faces that
-- leave it no room push arbitrarily hard.
function pressed.line(context, wire, w, body)
  local rows = facts.press(w, PLACE, pads_on(context, wire))
  local most, squeeze, from, to = 0, 0, nil, nil
  for i = 1, #rows, 5 do most, squeeze = math.max(most, rows[i]), math.max(squeeze, rows[i + 1]) end
  local enough = PLACE * math.min(most, flat.stiffness(body, FLATTENED) * FLATTENED * 2 * body.radius)
  for i = 1, #rows, 5 do
    if rows[i] >= enough then
      local edge = wire.length / (rows[i + 4] - 1)
      from = math.min(from or wire.length, math.max(0, (rows[i + 2] - 0.5) * edge))
      to = math.max(to or 0, math.min(wire.length, (rows[i + 3] + 0.5) * edge))
    end
  end
  return most, from, to, squeeze
end

--- Returns the largest force per length on the lines beside the mesh region of a wire [N/m].
function pressed.beside(scene, w, region)
  local most = 0
  facts.touched(w, function(forces, _, number)
    local s, x = 0, scene:frame(number).wires[w]
    for k = 1, #forces - 1 do
      local i = 3 * k
      local step = ((x[i + 1] - x[i - 2]) ^ 2 + (x[i + 2] - x[i - 1]) ^ 2 + (x[i + 3] - x[i]) ^ 2) ^ 0.5
      local outside = s + step < region[1] or s > region[2]
      if outside and step > 0 then most = math.max(most, forces[k] / step) end
      s = s + step
    end
  end)
  return most
end

--- Returns by how much a mesh was flattened in the run, over its width.
function pressed.mesh(wire, body)
  local fine, oval = pcall(wire.max_ovalisation, wire)
  return fine and oval and (body.inner and RING or OVAL) * oval or 0
end

return pressed
