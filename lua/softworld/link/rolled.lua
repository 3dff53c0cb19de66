-- SPDX-License-Identifier: GPL-3.0-or-later
--- Wires that are curved at rest and roll in clips. A clip does not keep a wire from turning about its axis:
-- it does not squeeze it, and its friction acts along it only. An event tells how far such a wire has turned
-- since it was first seen in the seat.
-- @module softworld.link.rolled
local build = require "softworld.scene.build"
local core = require "softworld.core"
local vec = require "softworld.vec"

local rolled = {}

local TOLD = 0.5 -- smaller turns are left out [rad]
local MORE = 1.02 -- an angle that has grown by this factor is told instead of the last one [-]

-- Returns the wires of a scene that are curved at rest, as rods.
local function curved(scene)
  local list
  for _, entry in ipairs(build.data(scene).wires) do
    local wire = entry.object
    if core.exists(wire) and core.data(wire).curved and wire.model == "rod" then
      list = list or {}
      list[#list + 1] = wire
    end
  end
  return list
end

-- Returns the angle of the wire's material about its axis in the clip [rad], and where [m]; nil without
-- frames.
local function angle_of(clip, wire)
  local s = core.nearest_place(wire, clip.at)
  local across = core.across(wire, s)
  if not across then return nil end
  local t = wire:tangent(s)
  local out = vec.across(clip.direction, t)
  return math.atan(vec.dot(vec.cross(out, across), t), vec.dot(out, across)), s
end

local function tell(clip, wire, s, turn, time)
  clip.scene:tell{ kind = "rolled", object = clip.name, s = s, value = turn, time = time,
    text = ("wire '%s', which is curved at rest, has rolled in clip '%s' by %.3g degrees: a clip does not "
    .. "keep a wire from turning about its axis. If the real one squeezes it, hold it there by a clamp or a "
    .. "gripper"):format(wire.name, clip.name, math.deg(turn)) }
end

local function look_at(clip, wire)
  local all = clip.turned or {}
  local angle, s = nil, nil
  if clip:seated(wire) then angle, s = angle_of(clip, wire) end
  local seen = all[wire.name]
  if not angle or not seen then
    if seen and seen.told then return end
    all[wire.name] = angle and { angle = angle } or nil
    clip.turned = all
    return
  end
  local turn = math.abs(angle - seen.angle)
  turn = math.min(turn, 2 * math.pi - turn)
  if turn <= MORE * (seen.told or TOLD / MORE) then return end
  seen.told, seen.time = turn, seen.time or clip.scene.time
  tell(clip, wire, s, turn, seen.time)
end

--- Looks at all clips of a scene.
function rolled.look(scene)
  local wires
  for _, entry in ipairs(build.data(scene).fixings) do
    local clip = entry.fixing
    if getmetatable(clip).__name == "clip" and clip:exists() then
      wires = wires or curved(scene)
      if not wires then return end
      for _, wire in ipairs(wires) do
        if clip.on == nil or clip.on == wire then look_at(clip, wire) end
      end
    end
  end
end

return rolled
