-- SPDX-License-Identifier: GPL-3.0-or-later
--- What all drawers of a run's pictures share: which frames, from where, how thick thin wires are drawn, and
-- the words below.
-- @module softworld.output.looks
local number = require "softworld.output.number"
local povscene = require "softworld.output.povscene"
local solid = require "softworld.output.solid"
local view = require "softworld.output.view"

local looks = {}

local gap = 10            -- between pictures [px]
local least_pixels = 3.2  -- thinner wires are drawn thicker, and the picture says so [px]
local least_grip = 10     -- smaller grippers are drawn larger, and the picture says so [px]

-- Returns the frame nearest to each time, or count frames evenly spread, first and last included; for a run
-- that failed, the last count frames.
function looks.frames(run, count, times)
  local total, list = #run.frames, {}
  for k, t in ipairs(times or {}) do
    for _, frame in ipairs(run.frames) do
      if not list[k] or math.abs(frame.t - t) < math.abs(list[k].t - t) then list[k] = frame end
    end
  end
  if times and #list > 0 then return list end
  count = math.min(count, total)
  for k = 1, run.ok == false and count or 0 do list[k] = run.frames[total - count + k] end
  for k = #list, count - 1 do
    list[k + 1] = run.frames[count > 1 and 1 + math.floor(k * (total - 1) / (count - 1) + 0.5) or total]
  end
  return list
end

--- Returns how many pictures stand side by side: as given, else three, or two of four.
function looks.columns(given, count)
  return math.min(given or count == 4 and 2 or 3, count)
end

-- Returns points that the drawn grippers reach; the camera must show them.
local function grip_points(run, smallest)
  local points = {}
  for _, frame in ipairs(run.frames) do
    for i, pose in ipairs(frame.grips or {}) do
      local width = math.max(smallest, (run.grips and run.grips[i] or {}).width or 0)
      local p, q = solid.pose(pose or nil)
      for _, side in ipairs(pose and { -1, 1 } or {}) do
        local x, y, z = solid.rotate(q, 0, 1.5 * side * width, povscene.grip_reach * width)
        points[#points + 1] = { p[1] + x, p[2] + y, p[3] + z }
      end
    end
  end
  return points
end

local function thickness_of(run, per_metre)
  local thinnest = math.huge
  for _, wire in ipairs(run.wires) do thinnest = math.min(thinnest, wire.radius) end
  local wanted = least_pixels / (2 * thinnest * per_metre)
  return wanted <= 1.1 and 1 or math.ceil(wanted * 2) / 2
end

function looks.of(run, width, height, options)
  local setting = type(options.camera) == "table" and options.camera or nil
  local look = { size = solid.bounds(run).size, smallest_grip = 0 }
  for _ = 1, 2 do -- the second pass knows the drawn size of grippers
    look.camera = view.camera(run, width / height, setting, grip_points(run, look.smallest_grip))
    look.per_metre = view.scale(look.camera, width)
    look.smallest_grip = least_grip / look.per_metre
  end
  look.thickness = options.thickness or thickness_of(run, look.per_metre)
  return look
end

local function has_plane(run)
  for _, o in ipairs(run.obstacles or {}) do
    if solid.flat(o) then return true end
  end
  return false
end

local foot_letter = 7.6 -- width of a letter in the line below the pictures [px]

-- Returns the line below the pictures, for a sheet of this width [px].
function looks.foot(run, look, width)
  local notes = {}
  if has_plane(run) and look.technique ~= "wireframe" then
    local side = number.text(povscene.square(look.size), "m"):gsub("(%d)%.0+ ", "%1 ")
    notes[1] = "squares of " .. side
  end
  if look.thickness ~= 1 then
    notes[#notes + 1] = string.format("wire drawn %g times as thick", look.thickness)
  end
  for _, grip in ipairs(run.grips or {}) do
    if (grip.width or 0) < look.smallest_grip then
      notes[#notes + 1] = "grippers not to scale"
      break
    end
  end
  if run.ok == false then
    local text, most = "FAILED " .. tostring(run.reason), (width - 2 * gap) // foot_letter
    text = #notes > 0 and text .. "; " .. table.concat(notes, ", ") or text
    return #text > most and text:sub(1, most - 3) .. "..." or text
  end
  return table.concat(notes, ", ")
end

local function time_caption(run, frame)
  local digits = (run.time or 1) < 0.1 and 4 or 2
  return string.format("t = %." .. digits .. "f s", frame.t)
end

function looks.caption(run, frame, i, options)
  local words = options.captions and options.captions[i]
  local failed = run.ok == false and frame == run.frames[#run.frames] and ", the run FAILED" or ""
  return options.caption or time_caption(run, frame) .. failed .. (words and ": " .. words or "")
end

return looks
