-- SPDX-License-Identifier: GPL-3.0-or-later
--- What a computation tells to the choices of a model: whether obstacles rub, how near wires come to each
-- other, how they speed up.
-- @module softworld.model.facts
local build = require "softworld.scene.build"

local facts = {}

--- A share as text.
function facts.percent(share) return ("%.2g %%"):format(100 * share) end

--- Names of obstacles with friction that pressed on something in the run.
function facts.rubbing(scene, start)
  local names = {}
  for _, o in ipairs(build.data(scene).obstacles) do
    local rows, count = o.object:log()
    local rubs = o.object:get().friction > 0
    for i = 0, rubs and count - 1 or -1 do
      local pressed = rows[5 * i + 2] ~= 0 or rows[5 * i + 3] ~= 0 or rows[5 * i + 4] ~= 0
      if pressed and rows[5 * i + 1] >= start then
        names[#names + 1] = o.name
        break
      end
    end
  end
  return names
end

local kept -- frames of the run that is looked at, read once for all choices

--- f(...) while the frames of a run are kept.
function facts.reading(scene, start, f, ...)
  kept = {}
  for i = 1, scene:frame_count() do
    local frame = scene:frame(i)
    if frame.t >= start then
      frame.number = i
      kept[#kept + 1] = frame
    end
  end
  local fine, result = pcall(f, ...)
  kept = nil
  if not fine then error(result, 0) end
  return result
end

--- Call look(frame) for these frames, in order.
function facts.frames(look)
  for _, frame in ipairs(kept) do look(frame) end
end

local function change(x, before, i) return x[i] - before[i] end

--- Largest acceleration of what moves along the frames, by second differences over equal spans [m/s2]; nil
-- where there are less than three.
function facts.acceleration()
  local a, b, most = nil, nil, nil
  facts.frames(function(c)
    if a and b then
      local first, second = b.t - a.t, c.t - b.t
      for w, x in ipairs(first > 0 and second > 0 and c.wires or {}) do
        local y, z = b.wires[w], a.wires[w]
        local fits = y and z and #x == #y and #y == #z
        for i = 1, fits and #x - 2 or 0, 3 do
          local sum = 0
          for k = i, i + 2 do
            local v = change(x, y, k) / second - change(y, z, k) / first
            sum = sum + (2 * v / (first + second)) ^ 2
          end
          if sum > (most or -1) then most = sum end
        end
      end
    end
    a, b = b, c
  end)
  return most and most ^ 0.5
end

local function grow(box, x, y, z)
  local at = { x, y, z }
  for k = 1, 3 do
    box[k], box[k + 3] = math.min(box[k], at[k]), math.max(box[k + 3], at[k])
  end
end

--- Angle by which a polyline turns in all [rad].
local function turning(x)
  local sum = 0
  for i = 4, #x - 5, 3 do
    local dot, a, b = 0, 0, 0
    for k = i, i + 2 do
      local u, v = x[k] - x[k - 3], x[k + 3] - x[k]
      dot, a, b = dot + u * v, a + u * u, b + v * v
    end
    if a > 0 and b > 0 then sum = sum + math.acos(math.max(-1, math.min(1, dot / (a * b) ^ 0.5))) end
  end
  return sum
end

--- Swept boxes of the wires { x1, y1, z1, x2, y2, z2 } [m], grown by how far points move between frames; and
-- the largest angle by which one turns along its length [rad].
function facts.swept()
  local boxes, most, before = {}, 0, nil
  facts.frames(function(frame)
    for w, x in ipairs(frame.wires) do
      local box = boxes[w] or { math.huge, math.huge, math.huge, -math.huge, -math.huge, -math.huge,
        step = 0 }
      boxes[w] = box
      for i = 1, #x - 2, 3 do
        grow(box, x[i], x[i + 1], x[i + 2])
        local old = before and before[w]
        if old and #old == #x then
          local d = (x[i] - old[i]) ^ 2 + (x[i + 1] - old[i + 1]) ^ 2 + (x[i + 2] - old[i + 2]) ^ 2
          box.step = math.max(box.step, d ^ 0.5)
        end
      end
      most = math.max(most, turning(x))
    end
    before = frame.wires
  end)
  return boxes, most
end

return facts
