-- SPDX-License-Identifier: GPL-3.0-or-later
--- Grippers and clamps in pictures and exchanged scenes, as solids in the axes of their pose: the wire lies
-- along x, jaws close along y, the stem goes up along z.
-- @module softworld.output.props
local povscene = require "softworld.output.povscene"

local props = {}

local colours = povscene.colours

local function box(size, at, colour)
  return { shape = { shape = "box", size = size }, at = at, colour = colour }
end

local function tube(length, radius, at, colour, rotation)
  return { shape = { shape = "cylinder", length = length, radius = radius }, at = at, colour = colour,
    rotation = rotation }
end

local half = math.sqrt(0.5)
local along_x, along_y = { half, 0, half, 0 }, { half, half, 0, 0 } -- rotations of shapes that lie along z

--- Returns a gripper: two jaws, palm and stem.
-- @tparam number w width of its jaws [m]
-- @tparam number gap from the pose to each jaw [m]
-- @treturn {table,...} `shape` (an obstacle's), `at` [m], `rotation`, `colour`
function props.grip(w, gap)
  local thick = 0.45 * w
  local list = {}
  for k, side in ipairs { -1, 1 } do
    list[k] = box({ w, thick, 2.6 * w }, { 0, side * (gap + thick / 2), 0.7 * w }, colours.jaw)
  end
  list[3] = box({ 1.3 * w, 2.8 * w, 0.6 * w }, { 0, 0, 2.2 * w }, colours.palm)
  local length = (povscene.grip_reach - 2.5) * w
  list[4] = tube(length, 0.4 * w, { 0, 0, 2.5 * w + length / 2 }, colours.palm)
  return list
end

local makers = {}

-- Two plates on a block, one above the wire and one below.
function makers.clamp(w)
  return { box({ 2 * w, 2 * w, 0.7 * w }, { 0, 0, 0.65 * w }, colours.jaw),
    box({ 2 * w, 2 * w, 0.7 * w }, { 0, 0, -0.65 * w }, colours.jaw),
    box({ 2 * w, 0.4 * w, 2 * w }, { 0, 0.8 * w, 0 }, colours.jaw) }
end

-- A ball on an axle across the wire.
function makers.pin(w)
  return { { shape = { shape = "sphere", radius = 0.8 * w }, at = { 0, 0, 0 }, colour = colours.jaw },
    tube(3.2 * w, 0.3 * w, { 0, 0, 0 }, colours.jaw, along_y) }
end

-- A sleeve around the wire.
function makers.feed(w)
  return { tube(3.2 * w, w, { 0, 0, 0 }, colours.jaw, along_x) }
end

--- Returns a hold that stands still or is moved by hand.
-- @tparam string kind clamp, pin, feed
-- @tparam number w half of its size [m]
-- @treturn {table,...} as props.grip
function props.clamp(kind, w) return (makers[kind] or makers.clamp)(w) end

--- Returns all grippers and clamps of a frame: lists of such parts with `pose`.
-- @tparam table run
-- @tparam table frame one of run.frames
-- @tparam table look `thickness` factor on the wires' radius, `smallest_grip` width [m]
-- @treturn {table,...} `name`, `kind`, `number`, `pose`, `parts`
function props.of(run, frame, look)
  local list = {}
  local radius = run.wires[1] and run.wires[1].radius or 0
  for i, pose in ipairs(frame.grips or {}) do
    local shown = run.grips and run.grips[i] or {}
    local w = math.max(shown.width or 0, look.smallest_grip)
    local closed = math.min(radius * look.thickness, 0.4 * w)
    if pose then
      list[#list + 1] = { name = shown.name, kind = "grip", number = i, pose = pose,
        parts = props.grip(w, pose.held and closed or closed + 0.5 * w) }
    end
  end
  for i, pose in ipairs(frame.clamps or {}) do
    local shown = run.clamps[i]
    local w = math.max(2.2 * radius * look.thickness, 0.5 * look.smallest_grip)
    if pose then
      list[#list + 1] = { name = shown.name, kind = shown.kind or "clamp", number = i, pose = pose,
        parts = props.clamp(shown.kind, w) }
    end
  end
  return list
end

return props
