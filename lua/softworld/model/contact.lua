-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of contact between wires: they pass through each other, or touch.
-- @module softworld.model.contact
local facts = require "softworld.model.facts"
local record = require "softworld.scene.record"

local contact = { name = "contact", rungs = {
  { name = "none", as = "no touches of wires", leaves = "touches of wires with wires and with themselves" },
  { name = "wires", as = "touches of wires", leaves = "nothing" } } }

function contact.given(context)
  if context.scripted_contact then return "as the script says, scene:wire_contact", 2 end
end

function contact.apply(context, rung)
  if context.scripted_contact then return end
  context.data.touching = nil
  if rung == 2 then record.quietly(context.scene.wire_contact, context.scene, {}) end
end

-- Room between the swept boxes of wires a and b [m]; negative: they meet.
local function room(a, b)
  local most = -math.huge
  for k = 1, 3 do
    most = math.max(most, a[k] - b[k + 3], b[k] - a[k + 3])
  end
  return most
end

function contact.look(context)
  local boxes, turning = facts.swept()
  local least = math.huge
  for i, a in ipairs(boxes) do
    for j = i + 1, #boxes do
      local wide = context.data.wires[i].object.radius + context.data.wires[j].object.radius
      least = math.min(least, room(a, boxes[j]) - a.step - boxes[j].step - wide)
    end
  end
  return { room = least, turning = turning, frames = #boxes > 0 }
end

function contact.free(_, rung, f)
  if rung ~= 1 or not f.frames or f.room <= 0 or f.turning >= math.pi then return nil end
  local apart = f.room < math.huge and ("the boxes that wires sweep stay %.3g m apart, and "):format(f.room)
    or ""
  return ("wires cannot meet: %sno wire turns by more than %.3g rad along its length (limit %.3g)"):format(
    apart, f.turning, math.pi)
end

return contact
