-- SPDX-License-Identifier: GPL-3.0-or-later
--- Where wires are pressed in a run, and by how much.
-- @module softworld.model.pressed
local facts = require "softworld.model.facts"
local flat = require "softworld.model.flat"

local pressed = {}

local PLACE = 0.1     -- of the largest load of its time: from there a place is pressed [-]
local FLATTENED = 0.1 -- no more flattening than this is needed to count [-]
local OVAL, RING = 1.5, 1.1 -- flattening over ovalisation: a solid section widens less than a ring [-]

-- Where pads are whose grip is chosen by itself: middles and half lengths [m].
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

--- What presses on a line, of the stored frames: the largest force per length of touches [N/m]; from where
-- to where it is pressed [m], whenever that flattens it by a tenth, or is a tenth of its largest; and the
-- largest by which it is pressed from both sides [N/m]. No line tells that force, as faces that leave it no
-- room push as hard as can be.
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

--- The same of a wire that is a mesh in a region: of the lines beside it.
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

--- By how much a mesh was flattened in the run, over its width.
function pressed.mesh(wire, body)
  local fine, oval = pcall(wire.max_ovalisation, wire)
  return fine and oval and (body.inner and RING or OVAL) * oval or 0
end

return pressed
