-- SPDX-License-Identifier: GPL-3.0-or-later
--- Adds to pictures what they show besides wires and obstacles: grippers and clamps, with their place in each
-- frame.
-- @module softworld.scene.drawn
local core = require "softworld.core"
local build = require "softworld.scene.build"
local leave = require "softworld.scene.leave"
local vec = require "softworld.vec"

local drawn = {}

-- Returns the direction of the nearest wire at the point closest to `at`; frame as scene:frame gives it.
local function tangent_near(frame, at)
  local best, along = math.huge, { 1, 0, 0 }
  for _, x in ipairs(frame.wires) do
    for i = 1, #x - 5, 3 do
      local a, b = { x[i], x[i + 1], x[i + 2] }, { x[i + 3], x[i + 4], x[i + 5] }
      local d = vec.norm(vec.sub(vec.scale(vec.add(a, b), 0.5), at))
      local t = d < best and vec.unit(vec.sub(b, a))
      if t then best, along = d, t end
    end
  end
  return along
end

-- Returns the rotation, relative to the pose, that puts the x axis along the wire there.
local function lean(scene, frame, pose)
  local up = vec.unit(vec.scale(scene:gravity(), -1)) or { 0, 0, 1 }
  local facing = vec.facing(tangent_near(frame, pose.position), up)
  return vec.multiply(vec.conjugate(pose.rotation), facing)
end

local function slot_of(object)
  local _, slot = core.number(object)
  return slot and slot + 1
end

local function placed(pose, turned, held)
  return { position = pose.position, rotation = vec.multiply(pose.rotation, turned), held = held }
end

-- Returns the number and the span of the gripper's grasp at this time, or nil.
local function span_at(gripper, t)
  for i = #gripper.spans, 1, -1 do
    local span = gripper.spans[i]
    if t >= span.from and (not span.to or t <= span.to) then return i, span end
  end
end

-- Returns the poses, frame by frame, of a gripper without pads as obstacles; false before it has a place.
local function gripper_poses(scene, gripper, frames)
  local list, turned, last, grasps = {}, {}, false, nil
  local carrier = gripper.carrier and slot_of(gripper.carrier)
  local pads = gripper.tool and slot_of(gripper.tool) -- once this tool is there, its pads are drawn instead
  local function pose_in(frame)
    local i, span = span_at(gripper, frame.t)
    local by_hold = i and not (span.carried and frame.t >= span.carried)
    return by_hold and frame.holds[slot_of(gripper.past[i])] or carrier and frame.tools[carrier] or nil, i
  end
  for _, frame in ipairs(frames) do -- aligned with the wire in the first frame of each grasp
    local pose, i = pose_in(frame)
    if i and pose and not turned[i] then turned[i] = lean(scene, frame, pose) end
    grasps = grasps or i
  end
  grasps = grasps or 1
  if gripper.first_at then
    last = { position = gripper.first_at, rotation = turned[grasps] or { 1, 0, 0, 0 }, held = false }
  end
  for f, frame in ipairs(frames) do
    local pose, i = pose_in(frame)
    grasps = i or grasps
    if pads and frame.tools[pads] then
      last = false
    elseif pose then
      last = placed(pose, turned[grasps] or { 1, 0, 0, 0 }, i ~= nil)
    elseif last and last.held then
      last = { position = last.position, rotation = last.rotation, held = false }
    end
    list[f] = not (gripper.left and frame.t > gripper.left) and last
  end
  return list
end

local function hold_poses(scene, entry, frames)
  local list, slot, turned = {}, slot_of(entry.object), nil
  for f, frame in ipairs(frames) do
    local pose = frame.holds[slot]
    list[f] = false
    if pose and pose.held then
      turned = turned or lean(scene, frame, pose)
      list[f] = placed(pose, turned, true)
    end
  end
  return list
end

local function show(list, kind, frames, shown, poses)
  list[#list + 1] = shown
  for f, frame in ipairs(frames) do frame[kind][#list] = poses[f] end
end

-- Returns a gripper's entry: when it held what, and where it is otherwise; slots from 0.
local function gripper_of(gripper)
  local spans = {}
  for i, span in ipairs(gripper.spans) do
    spans[i] = { from = span.from, to = span.to, carried = span.carried, hold = slot_of(gripper.past[i]) - 1 }
  end
  return { name = gripper.name, width = gripper.width or 0.02, spans = spans, first_at = gripper.first_at,
    carrier = gripper.carrier and slot_of(gripper.carrier) - 1,
    tool = gripper.tool and slot_of(gripper.tool) - 1, left = gripper.left }
end

--- Adds doc.particles: { name, radius, edges of the surface } of each object of particles.
function drawn.add_particles(scene, doc)
  doc.particles = leave.all(scene, "particles")
end

--- Adds to a document what a player draws besides wires: doc.grips, doc.holds, doc.particles. Entries of
-- doc.obstacles get their slots and the name of the gripper they belong to.
function drawn.describe(scene, doc)
  local data, theirs = build.data(scene), {}
  doc.grips, doc.holds = {}, {}
  for _, g in ipairs(data.grippers) do
    for _, hold in ipairs(g.past) do theirs[hold] = true end
    doc.grips[#doc.grips + 1] = gripper_of(g)
    for _, o in ipairs(g.obstacles or {}) do
      local slot = slot_of(o)
      if slot and doc.obstacles[slot] then doc.obstacles[slot].part = g.name end
    end
  end
  for i, o in ipairs(doc.obstacles) do o.slot = i - 1 end
  for _, h in ipairs(data.holds) do
    if not theirs[h.object] and core.exists(h.object) then
      doc.holds[#doc.holds + 1] = { name = h.name, kind = h.kind, width = h.width,
        slot = slot_of(h.object) - 1 }
    end
  end
  drawn.add_particles(scene, doc)
end

--- Adds grips and clamps to a document with frames (of scene:frame): the lists doc.grips and doc.clamps of
-- { name, width, kind }, and in each frame one pose per entry, false where the object is not there.
function drawn.add(scene, doc)
  local data, theirs = build.data(scene), {}
  for _, frame in ipairs(doc.frames) do -- obstacles made later are not there yet
    for i = #frame.obstacles + 1, #data.obstacles do frame.obstacles[i] = false end
  end
  doc.grips, doc.clamps = {}, {}
  for _, frame in ipairs(doc.frames) do frame.grips, frame.clamps = {}, {} end
  for _, g in ipairs(data.grippers) do
    for _, hold in ipairs(g.past) do theirs[hold] = true end
    if #g.past > 0 or g.carrier then
      show(doc.grips, "grips", doc.frames, { name = g.name, width = g.width or 0.02 },
        gripper_poses(scene, g, doc.frames))
    end
  end
  for _, h in ipairs(data.holds) do
    local kind = h.kind == "grip" and "grips" or h.kind ~= "hold" and "clamps" or nil
    if kind and not theirs[h.object] then
      show(doc[kind], kind, doc.frames, { name = h.name, width = h.width or 0.02, kind = h.kind },
        hold_poses(scene, h, doc.frames))
    end
  end
end

return drawn
