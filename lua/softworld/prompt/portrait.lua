-- SPDX-License-Identifier: GPL-3.0-or-later
--- What the prompt prints of an object below its name: what it is made of, its state, its extremes so far.
-- @module softworld.prompt.portrait
local core = require "softworld.core"
local build = require "softworld.scene.build"
local checks = require "softworld.checks"
local number = require "softworld.output.number"

local portrait = {}

local STRAIGHT = 1e5 -- radius over the wire's length from which it counts as straight [-]

local function value_of(fine, ...)
  if fine then return ... end
  if checks.is_interrupt(...) then error((...), 0) end
end

-- Returns the value of a call, or nil if the call fails.
local function try(f, ...) return value_of(pcall(f, ...)) end

local function vector(v) return ("(%.4g, %.4g, %.4g)"):format(v[1], v[2], v[3]) end

local function at(s, t)
  local words = {}
  if type(s) == "number" then words[#words + 1] = ("s = %.4g m"):format(s) end
  if type(t) == "number" then words[#words + 1] = ("t = %.4g s"):format(t) end
  return #words > 0 and " (" .. table.concat(words, ", ") .. ")" or ""
end

function portrait.wire(wire)
  local lines = {}
  local cable = try(wire.cable, wire)
  lines[1] = ("%s, radius %s%s"):format(wire.model, number.text(wire.radius, "m"),
    cable and (", cable '%s'"):format(cable.name or tostring(cable)) or "")
  local beam = try(function() return wire.beam end)
  if beam and type(beam.EI) == "number" then
    lines[1] = ("%s, EI %s, %.3g kg/m"):format(lines[1], number.text(beam.EI, "N m2"), beam.mass_per_length)
  end
  local from, to = try(wire.position, wire, 0), try(wire.position, wire, wire.length)
  if from and to then
    lines[#lines + 1] = ("from %s to %s m"):format(vector(from), vector(to))
  end
  local radius, s, t = try(wire.min_bend_radius, wire)
  if radius and radius < STRAIGHT * wire.length then
    lines[#lines + 1] = ("smallest bend radius so far %s%s"):format(number.text(radius, "m"), at(s, t))
  end
  local tension, ts, tt = try(wire.max_tension, wire)
  if tension then
    lines[#lines + 1] = ("largest tension so far %s%s"):format(number.text(tension, "N"), at(ts, tt))
  end
  return lines
end

local function names_of(list)
  local names = {}
  for i, entry in ipairs(list) do names[i] = entry.name end
  if #names > 8 then names[9] = ("... %d more"):format(#names - 8) end
  return table.concat(names, ", ", 1, math.min(#names, 9))
end

function portrait.scene(scene)
  local data, lines = build.data(scene), {}
  for _, kind in ipairs { "wires", "particles", "obstacles", "holds", "grippers", "fixings" } do
    if #data[kind] > 0 then lines[#lines + 1] = ("%s: %s"):format(kind, names_of(data[kind])) end
  end
  return lines
end

function portrait.obstacle(obstacle)
  local p = try(obstacle.pose, obstacle)
  local lines = {}
  if p then
    lines[1] = ("at %s m%s"):format(vector(p), obstacle.present and "" or ", removed")
  end
  return lines
end

function portrait.gripper(gripper)
  local lines = {}
  local p = try(gripper.position, gripper)
  if p then lines[1] = ("at %s m"):format(vector(p)) end
  local f = try(gripper.force, gripper)
  if f then lines[#lines + 1] = ("force on its wires %s N"):format(vector(f)) end
  local peak = try(function() return gripper.peak_force end)
  if type(peak) == "number" then
    lines[#lines + 1] = ("peak force so far %s"):format(number.text(peak, "N"))
  end
  return lines
end

local function kind_of(value)
  local meta = debug.getmetatable(value)
  return core.type(value) or type(meta) == "table" and rawget(meta, "__name") or nil
end

--- Returns the lines below the name, each indented and after a line end; nil for other values.
return function(value)
  local make = portrait[kind_of(value)]
  local lines = make and try(make, value)
  if not lines or #lines == 0 then return nil end
  return "\n  " .. table.concat(lines, "\n  ")
end
