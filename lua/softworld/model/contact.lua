-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of contact between wires: they pass through each other, or touch.
-- @module softworld.model.contact
local facts = require "softworld.model.facts"
local number = require "softworld.output.number"
local record = require "softworld.scene.record"

local NEARLY = 1e-3 -- angle by which a straight wire turns at most [rad]

local contact = { name = "contact", by_itself = true, rungs = {
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

-- Returns the room between the swept boxes of wires a and b [m]; negative: they overlap.
local function room(a, b)
  local most = -math.huge
  for k = 1, 3 do
    most = math.max(most, a[k] - b[k + 3], b[k] - a[k + 3])
  end
  return most
end

-- Returns the room between the surfaces of two wires, or of one and itself [m], and how it was found: by
-- "boxes", or by the "axes" in the frames if the boxes overlap. Room above `most` is not searched.
local function room_between(context, boxes, i, j, most)
  local wide = context.data.wires[i].object.radius + context.data.wires[j].object.radius
  local between = i < j and room(boxes[i], boxes[j]) - boxes[i].step - boxes[j].step - wide or -1
  if between > 0 then return between, "boxes" end
  return facts.apart(i, j, wide, most < math.huge and most + wide or nil) - wide, "axes"
end

-- True if wires are in each other in the last frame. straight: by their edges alone, without the bow beside
-- them.
local function cross_at_end(context, count, straight)
  for i = 1, count do
    for j = i, count do
      local wide = context.data.wires[i].object.radius + context.data.wires[j].object.radius
      if facts.apart_at_end(i, j, wide, straight) < wide then return true end
    end
  end
  return false
end

--- True if this rung may not stay by a comparison on level k, unless it is the last: wires end in each other,
-- which is no state of real wires. Touching wires may snap past each other on finer edges only. Long edges
-- may seem to be in each other by their bow alone; then the next level is asked.
function contact.doubtful(f, k) return f.crossed or k == 1 and f.bowed or false end

function contact.look(context)
  if context.data.touching then return {} end -- with touches the distance tells nothing
  local boxes, turning = facts.swept()
  local f = { room = math.huge, turning = turning, frames = #boxes > 0 }
  for i = 1, #boxes do
    for j = turning < math.pi and i + 1 or i, #boxes do
      local most = context.watching and context.data.wires[i].object.radius or math.huge
      local between, sort = room_between(context, boxes, i, j, math.min(f.room, most))
      if between < f.room then f.room, f.sort = between, i == j and "itself" or sort end
      if f.room <= 0 then
        if not context.watching then
          f.bowed = cross_at_end(context, #boxes)
          f.crossed = f.bowed and cross_at_end(context, #boxes, true)
        end
        return f
      end
    end
  end
  return f
end

--- True if wires may pass through each other, where touches would hold them apart.
function contact.first(f) return f.frames and f.room <= 0 end

-- How wires keep away from each other, by how that was found.
local apart = { boxes = "the boxes that they sweep stay at least %s apart",
  axes = "they stay at least %s apart, also between frames" }

-- Returns why no wire touches itself, as text.
local function alone(f)
  local most = ("along its length a wire turns by at most %.3g rad"):format(f.turning)
  if f.turning < NEARLY then return "they stay straight" end
  if f.turning < math.pi then
    return ("%s; to touch itself it must turn by %.3g rad"):format(most, math.pi)
  end
  return ("%s, enough to touch itself (possible from %.3g rad on), but it comes no nearer to itself than %s")
    :format(most, math.pi, number.text(f.room, "m"))
end

function contact.free(_, rung, f)
  if rung ~= 1 or not f.frames or f.room <= 0 then return nil end
  local room_is = apart[f.sort] and apart[f.sort]:format(number.text(f.room, "m")) .. "; " or ""
  return ("wires cannot meet: %s%s"):format(room_is, alone(f))
end

--- Returns why wires may meet from here on, by what the run showed so far.
function contact.broken(f)
  return f.frames and f.room <= 0 and "wires came closer together than they move between two frames" or nil
end

--- Lets wires touch each other from here on.
function contact.onward(context) record.quietly(context.scene.wire_contact, context.scene, {}) end

return contact
