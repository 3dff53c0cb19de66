-- SPDX-License-Identifier: GPL-3.0-or-later
--- Peak values by time step in scenes with impacts: forces on a table, a wall and a gripper, and tension of a
-- wire, as means over the window of 10 ms. Shows which peaks still depend on the step.
-- @module bench.peaks
local sw = require "softworld"

local peaks = {}

peaks.steps = { 0.02, 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4, 1e-4, 5e-5 } -- [s]
peaks.apart = 0.15 -- a larger relative difference from the value at the shortest step is marked [-]

local soft = { { E = 1e6, density = 1200, radius = 0.003 }, { E = 5e6, density = 1500, radius = 0.0025 },
  { E = 5e7, density = 1500, radius = 0.0025 } }
peaks.cables = { "GXL 1.5", "GXL 0.5", "FLRY-B 0.5", "FLRY-B 10", "identified white", "soft 1 MPa",
  "soft 5 MPa", "soft 50 MPa" }

local function wire_of(scene, cable, from, to, segments)
  local args = { from = from, to = to, segments = segments }
  local k = cable == "soft 1 MPa" and 1 or cable == "soft 5 MPa" and 2 or cable == "soft 50 MPa" and 3
  if not k then args.cable = cable end
  for key, value in pairs(soft[k] or {}) do args[key] = value end
  local wire = scene:wire(args)
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 1e-3 }
  return wire
end

local function ground(scene) return scene:obstacle{ shape = "plane", friction = 0.3 } end

-- Each adds its objects for a cable; returns the object whose force is measured, the wire, the duration [s].
local makers = {
  laying = function(scene, cable)
    local table_ = ground(scene)
    scene:obstacle{ shape = "box", size = { 0.01, 0.2, 0.02 }, at = { 0.12, 0, 0.01 }, friction = 0.3 }
    local wire = wire_of(scene, cable, { 0, 0, 0.03 }, { 0.3, 0, 0.03 }, 30)
    local g = scene:gripper{}
    scene:process(function()
      g:grasp(wire, { s = 0.28 })
      g:move{ by = { -0.02, 0, -0.025 }, duration = 0.2 }
    end)
    return table_, wire, 0.22
  end,
  drop = function(scene, cable)
    local table_ = ground(scene)
    return table_, wire_of(scene, cable, { 0, 0, 0.03 }, { 0.3, 0, 0.04 }, 30), 0.15
  end,
  throw = function(scene, cable)
    local wall = scene:obstacle{ shape = "box", size = { 0.1, 2, 2 }, at = { 0.36, 0, 0 }, friction = 0.3 }
    local wire = wire_of(scene, cable, { 0, 0, 0 }, { 0.3, 0, 0 }, 30)
    wire:set_velocity{ 1, 0, 0.2 }
    return wall, wire, 0.06
  end,
  poke = function(scene, cable)
    local tilt, free = 0.4, 0.06
    local n = { -math.cos(tilt), 0, math.sin(tilt) }
    local wall = scene:obstacle{ shape = "box", size = { 0.02, 0.4, 0.4 }, friction = 0.3,
      at = { free + 0.0035 - 0.01 * n[1], 0, -0.01 * n[3] }, rotation = { axis = { 0, 1, 0 }, angle = tilt } }
    local wire = wire_of(scene, cable, { -0.03, 0, 0 }, { free, 0, 0 }, 18)
    scene:clamp(wire, { s = 0.03 }):follow{ points = { { 0, 0, 0 }, { 0.01, 0, 0 } }, duration = 0.1,
      law = "linear", relative = true }
    return wall, wire, 0.12
  end,
  peg = function(scene, cable)
    local peg = scene:obstacle{ shape = "cylinder", radius = 0.01, length = 0.2, friction = 0.3,
      at = { 0.15, 0, -0.02 }, rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
    local wire = wire_of(scene, cable, { 0, 0, 0.005 }, { 0.3, 0, 0.005 }, 30)
    return peg, wire, 0.12
  end,
  clip = function(scene, cable)
    scene:clip{ at = { 0.1, 0, 0 }, width = 0.01, insertion = 2, retention = 5, friction = 0.25 }
    local wire = wire_of(scene, cable, { 0, 0, 0.015 }, { 0.2, 0, 0.015 }, 20)
    local g = scene:gripper{}
    scene:process(function(p)
      g:grasp(wire, { s = 0.1 })
      g:move{ by = { 0, 0, -0.015 }, speed = 0.2, law = "linear" }
      p:wait(0.02)
    end)
    return g, wire, 0.1
  end,
  gripper = function(scene, cable)
    ground(scene)
    local wire = wire_of(scene, cable, { 0, 0, 0.003 }, { 0.3, 0, 0.003 }, 30)
    local g = scene:gripper{}
    scene:process(function(p)
      g:grasp(wire, { s = 0.02 })
      p:wait(0.03)
      g:move{ by = { 0, 0, 0.03 }, speed = 0.4, law = "linear" }
    end)
    return g, wire, 0.12
  end,
}
peaks.scenes = { "laying", "drop", "throw", "poke", "peg", "clip", "gripper" }

local function measure(item, cable, dt)
  local scene = sw.scene{ gravity = item == "throw" and { 0, 0, 0 } or nil }
  local part, wire, duration = makers[item](scene, cable)
  local fine, run = pcall(scene.run, scene, { duration = duration, dt = dt })
  local row = { group = "peaks", item = item, model = cable, integrator = "tr-bdf2", dt = dt,
    segments = wire.segments, status = "ok" }
  if not fine or not run.ok then
    row.status, row.reason = "failed", tostring(fine and run.reason or run)
  else
    local m, l = part:over(), run:ledger()
    row.peak, row.impulse, row.tension = m.peak_force, m.impulse_size, (wire:max_tension())
    row.coarse = m.peak_force_coarse or false
    row.weight = 9.81 * wire.beam.mass_per_length * wire.length
    row.gain, row.steps, row.rejected, row.wall = l.gained / l.play, run.steps, run.rejected, run.cpu
  end
  scene:close()
  return row
end

-- Returns the ratio of value to last; if last is near 0, the difference counts relative to `least`.
local function against(value, last, least) return 1 + (value - last) / math.max(last, least) end

-- Sets the ratios to the values at the shortest step in the columns of the rows.
local function compare(rows)
  local last = rows[#rows]
  for _, r in ipairs(rows) do
    if r.peak and last.peak then
      r.expected, r.ratio = last.peak, against(r.peak, last.peak, 0.1 * r.weight)
      r.change = against(r.tension, last.tension, r.weight)
      r.pushed = against(r.impulse, last.impulse, 0.01 * r.weight)
      r.note = ("impulse %.3g N s, tension %.3g N"):format(r.impulse, r.tension)
    end
  end
end

--- Measures all rows; calls add(row) for each, and say(format, ...) for progress. quick: few cables, no short
-- steps.
function peaks.measure(quick, add, say)
  for k, cable in ipairs(peaks.cables) do
    if not quick or k % 3 == 1 then
      say("peaks: %s", cable)
      for _, item in ipairs(peaks.scenes) do
        local rows = {}
        for i, dt in ipairs(peaks.steps) do
          if not quick or i <= 5 then rows[#rows + 1] = measure(item, cable, dt) end
        end
        compare(rows)
        for _, row in ipairs(rows) do add(row) end
      end
    end
  end
end

local function lines_of(rows, key, format)
  local lines, order, off = {}, {}, {}
  for _, r in ipairs(rows) do
    if r.group == "peaks" then
      local name = ("  %-8s %-17s"):format(r.item, r.model)
      if not lines[name] then lines[name], order[#order + 1], off[name] = name, name, 0 end
      local value = r[key]
      local apart = value and math.abs(value - 1) or 0
      off[name] = math.max(off[name], apart)
      lines[name] = lines[name] .. (value and format:format(value, apart > peaks.apart and "*" or " ")
        or ("%9s"):format "failed")
    end
  end
  return lines, order, off
end

--- Prints tables of filtered peak, impulse and tension over the values at the shortest step.
function peaks.print(rows)
  for _, what in ipairs{ { "ratio", "largest force, mean of 10 ms" }, { "pushed", "impulse" },
    { "change", "largest tension, mean of 10 ms" } } do
    print(("\n%s, over that at the shortest step; *: off by more than %g %%\n"):format(what[2],
      100 * peaks.apart))
    local head = ("  %-8s %-17s"):format("scene", "cable")
    for _, dt in ipairs(peaks.steps) do head = head .. ("%9s"):format(("%g ms"):format(1e3 * dt)) end
    print(head)
    local lines, order, off = lines_of(rows, what[1], "%8.3f%s")
    local marked = 0
    for _, name in ipairs(order) do
      print(lines[name])
      if off[name] > peaks.apart then marked = marked + 1 end
    end
    print(("  %d of %d depend on the step"):format(marked, #order))
  end
end

return peaks
