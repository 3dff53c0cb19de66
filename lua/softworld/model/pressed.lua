-- SPDX-License-Identifier: GPL-3.0-or-later
--- Where wires are pressed in a run, and by how much.
-- @module softworld.model.pressed
local build = require "softworld.scene.build"
local facts = require "softworld.model.facts"
local flat = require "softworld.model.flat"

local pressed = {}

local PLACE = 0.1     -- of the largest load of its time: from there a place is pressed [-]
local FLATTENED = 0.1 -- no more flattening than this is needed to count [-]
local OVAL = 1.5      -- flattening over ovalisation: a solid section widens little [-]
local OPPOSED = -0.5  -- cosine of forces that press from both sides [-]

-- Is s at pads whose grip is chosen by itself, with the edge beside?
local function at_pads(context, wire, s, spacing)
  for _, asked in ipairs(context.data.auto and context.data.auto.asked or {}) do
    local from = type(asked.s) == "number" and math.abs(s - asked.s) or 0
    if asked.wire == wire and from <= asked.gripper.pads.width / 2 + 1.5 * spacing then return true end
  end
  return false
end

-- Loads on the nodes of a line in one frame, and the largest [N/m].
local function loads_of(context, wire, values, x)
  local loads, most = {}, 0
  local spacing = values and x and #x > 3
    and ((x[4] - x[1]) ^ 2 + (x[5] - x[2]) ^ 2 + (x[6] - x[3]) ^ 2) ^ 0.5 or 0
  for k = 1, spacing > 0 and #values.contact or 0 do
    local load = values.contact[k] / spacing
    if load > 0 and not at_pads(context, wire, (k - 1) * spacing, spacing) then
      loads[k], most = load, math.max(most, load)
    end
  end
  return loads, most
end

-- From where to where loads of their time's largest size press on a line [m].
local function reach(wire, loads, most, count, from, to)
  local edge = wire.length / (count - 1)
  for k, load in pairs(loads) do
    if load >= PLACE * most then
      local s = (k - 1) * edge
      from = math.min(from or wire.length, math.max(0, s - edge / 2))
      to = math.max(to or 0, math.min(wire.length, s + edge / 2))
    end
  end
  return from, to
end

--- Largest force per length of touches on a line, of the stored frames [N/m], and from where to where it is
-- pressed [m]: whenever that flattens it by a tenth, or is a tenth of its largest.
function pressed.line(context, wire, w, body)
  local most, seen = 0, {}
  facts.frames(function(frame)
    local loads, top = loads_of(context, wire, frame.values[w], frame.wires[w])
    most = math.max(most, top)
    if top > 0 then seen[#seen + 1] = { loads = loads, top = top, count = #frame.values[w].contact } end
  end)
  local enough = PLACE * math.min(most, flat.stiffness(body, FLATTENED) * FLATTENED * 2 * body.radius)
  local from, to
  for _, s in ipairs(seen) do
    if s.top >= enough then from, to = reach(wire, s.loads, s.top, s.count, from, to) end
  end
  return most, from, to
end

--- The same of a wire that is a mesh in a region: of the lines beside it.
function pressed.beside(wire, w, region)
  local most = 0
  facts.frames(function(frame)
    local values, x = frame.values[w], frame.wires[w]
    local s, n = 0, values and x and #values.contact or 0
    for k = 1, n - 1 do
      local i = 3 * k
      local step = ((x[i + 1] - x[i - 2]) ^ 2 + (x[i + 2] - x[i - 1]) ^ 2 + (x[i + 3] - x[i]) ^ 2) ^ 0.5
      local outside = s + step < region[1] or s > region[2]
      if outside and step > 0 then most = math.max(most, values.contact[k] / step) end
      s = s + step
    end
  end)
  return most
end

--- By how much a mesh was flattened in the run, over its width.
function pressed.mesh(wire)
  local fine, oval = pcall(wire.max_ovalisation, wire)
  return fine and oval and OVAL * oval or 0
end

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

--- Did two obstacles push against each other, with something between them?
function pressed.between(context, start)
  local peaks = {}
  for _, o in ipairs(build.data(context.scene).obstacles) do
    local rows, count = o.object:log()
    local peak, most = nil, 0
    for i = 0, count - 1 do
      local force = { rows[5 * i + 2], rows[5 * i + 3], rows[5 * i + 4] }
      local size = dot(force, force)
      if rows[5 * i + 1] >= start and size > most then peak, most = force, size end
    end
    peaks[#peaks + 1] = peak
  end
  for i, a in ipairs(peaks) do
    for j = i + 1, #peaks do
      local b = peaks[j]
      if dot(a, b) < OPPOSED * (dot(a, a) * dot(b, b)) ^ 0.5 then return true end
    end
  end
  return false
end

return pressed
