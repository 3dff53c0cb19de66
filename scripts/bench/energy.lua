-- SPDX-License-Identifier: GPL-3.0-or-later
--- Spurious energy gains by integrator, cable and step: a wire thrown at a wall, a wire dropped on one.
-- @module bench.energy
local sw = require "softworld"

local energy = {}

energy.steps = { 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4, 1e-4, 5e-5 } -- [s]
energy.cables = { "GXL 1.5", "FLRY-B 10", "identified white", "soft" }

local function wire_of(scene, cable, from, to)
  if cable ~= "soft" then return scene:wire{ cable = cable, from = from, to = to, segments = 45 } end
  return scene:wire{ E = 50e6, density = 1500, radius = 0.0025, from = from, to = to, segments = 45 }
end

local scenes = {
  { name = "thrown", make = function(cable)
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    scene:obstacle{ shape = "box", size = { 0.1, 2, 2 }, at = { 1.15, 0, 0 }, friction = 0.3 }
    local wire = wire_of(scene, cable, { 0, 0, 0 }, { 1, 0, 0 })
    wire:set_velocity{ 2, 0, 0.4 }
    return scene, 0.12
  end },
  { name = "dropped", make = function(cable)
    local scene = sw.scene{}
    scene:obstacle{ shape = "plane", friction = 0.3 }
    scene:obstacle{ shape = "box", size = { 0.01, 1, 0.1 }, at = { 0.45, 0, 0.05 }, friction = 0.3 }
    wire_of(scene, cable, { 0, 0, 0.15 }, { 1, 0, 0.15 })
    return scene, 0.4
  end },
}

local function measure(integrator, cable, item, dt)
  local scene, duration = item.make(cable)
  local fine, run = pcall(scene.run, scene, { duration = duration, dt = dt, integrator = integrator })
  local row = { group = "energy", item = item.name .. " " .. cable, model = "rod", segments = 45,
    integrator = integrator, dt = dt }
  if not fine then
    row.status, row.reason = "refused", tostring(run)
    return row
  end
  local l = run:ledger()
  row.gain, row.change = l.gained / l.play, l.redone.count / math.max(1, l.steps)
  row.steps, row.rejected, row.wall = run.steps, run.rejected, run.cpu
  row.status, row.reason = run.ok and "ok" or "failed", not run.ok and run.reason or nil
  return row
end

--- Measures all rows; calls add(row) for each, and say(format, ...) for progress.
function energy.measure(integrators, quick, add, say)
  for _, integrator in ipairs(integrators) do
    for _, cable in ipairs(energy.cables) do
      say("energy: %s, %s", integrator, cable)
      for _, item in ipairs(scenes) do
        for k, dt in ipairs(energy.steps) do
          if not quick or k <= 3 then add(measure(integrator, cable, item, dt)) end
        end
      end
    end
  end
end

--- Prints a table of gains [% of the energy in play] by step; f: the run failed and reported it.
function energy.print(rows)
  print "\nenergy from nowhere [% of what was in play]; f: the run failed and said so; -: refused\n"
  local head = ("  %-26s %-18s"):format("scene", "integrator")
  for _, dt in ipairs(energy.steps) do head = head .. ("%9s"):format(("%g ms"):format(1e3 * dt)) end
  print(head)
  local lines, order = {}, {}
  for _, r in ipairs(rows) do
    if r.group == "energy" then
      local key = ("  %-26s %-18s"):format(r.item, r.integrator)
      if not lines[key] then lines[key], order[#order + 1] = key, key end
      local text = r.gain and ("%.2g%s"):format(100 * r.gain, r.status == "failed" and "f" or "") or "-"
      lines[key] = lines[key] .. ("%9s"):format(text)
    end
  end
  for _, key in ipairs(order) do print(lines[key]) end
end

return energy
