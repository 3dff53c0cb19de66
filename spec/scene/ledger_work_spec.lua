-- SPDX-License-Identifier: GPL-3.0-or-later
-- Work of what moves a wire that touches something. Forces of a method's stages may be off at the steps'
-- ends; the impulse on the wire is not. So the work hardly depends on the step, and almost no energy is
-- unexplained. Both are shares of the energy in play.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local t = require "spec.physics.tools"

local ACROSS = { axis = { 1, 0, 0 }, angle = math.pi / 2 }
local SOFT = { E = 5e6, density = 1500, radius = 0.0025 }

local function wire_in(s, kind, length, height, segments)
  local args = { from = { 0, 0, height }, to = { length, 0, height }, segments = segments }
  if kind == "soft" then
    for k, v in pairs(SOFT) do args[k] = v end
  else
    args.cable = kind
  end
  local w = s:wire(args)
  s:force{ kind = "damping", on = w, mass = 1, stiffness = 1e-3 }
  return w
end

-- A wire lies over a peg; one end is moved back and down. bend: makes a bending force from EI, or nil.
local function over_peg(kind, bend)
  return function(s)
    local w = wire_in(s, kind, 0.4, 0.2, 40)
    s:obstacle{ shape = "cylinder", radius = 0.025, length = 0.4, at = { 0.16, 0, 0.15 },
      rotation = ACROSS, friction = 0.2 }
    local force = bend and bend(w:get().EI)
    if force then
      force.on = w
      s:force(force)
    end
    s:clamp(w, { s = 0 })
    s:clamp(w, { s = 0.4 }):follow{ points = { { 0, 0, 0 }, { -0.12, 0.02, -0.1 } }, relative = true,
      duration = 0.7, start = 0.2 }
    return 1.0
  end
end

local function plastic(EI)
  return { kind = "plastic", yield_moment = 10 * EI, hardening = 0.2 * EI }
end

local function stick_slip(EI)
  return { kind = "stick_slip", EI_stick = 4 * EI, friction_moment = 5 * EI }
end

-- A wire pulled out of a clip by a gripper on either side.
local function out_of_clip(kind)
  return function(s)
    local w = wire_in(s, kind, 0.3, 0.03, 48)
    local weight = w:get().mass_per_length * 0.3 * 9.81
    s:clip{ at = { 0.15, 0, 0.03 }, width = 0.01, insertion = 4 * weight, retention = 8 * weight,
      friction = 0.2 }
    for _, place in ipairs{ 0.12, 0.18 } do
      local hand = s:gripper{ pads = { width = 1e-3 } }
      hand:grasp(w, { s = place })
      hand:move{ points = { { 0, 0, 0 }, { 0, 0, 0.03 } }, duration = 0.5, relative = true, start = 0.1 }
    end
    return 0.8
  end
end

-- A guide that moves back above a table lays wire down.
local function laid(kind)
  return function(s)
    local w = wire_in(s, kind, 0.1, 0.05, 10)
    s:obstacle{ shape = "plane", friction = 0.4 }
    local f = s:feed(w, { s = 0 })
    s:process(function(p) p:feed(f, { length = 0.2, duration = 0.5 }) end)
    f:follow{ points = { { 0, 0, 0 }, { -0.2, 0, 0 } }, relative = true, duration = 0.5 }
    return 0.6
  end
end

-- A plate pushes a hanging wire aside and comes back.
local function pushed(kind)
  return function(s)
    local w = wire_in(s, kind, 0.3, 0.2, 30)
    local plate = s:obstacle{ shape = "box", size = { 0.02, 0.1, 0.1 }, at = { 0.2, 0, 0.15 },
      rotation = { axis = { 0, 1, 0 }, angle = 0.4 }, friction = 0.3 }
    s:clamp(w, { s = 0 })
    plate:follow{ points = { { 0, 0, 0 }, { -0.02, 0.01, 0.06 }, { 0, 0, 0 } }, times = { 0.1, 0.5, 0.9 },
      relative = true }
    return 1.0
  end
end

local cases = {
  { "soft wire over a peg", over_peg "soft", "holds" },
  { "cable over a peg", over_peg "FLRY-B 0.5", "holds" },
  { "plastic cable over a peg", over_peg("FLRY-B 0.5", plastic), "holds" },
  { "plastic wire over a peg", over_peg("soft", plastic), "holds" },
  { "stick-slip cable over a peg", over_peg("GXL 1.5", stick_slip), "holds" },
  { "cable out of a clip", out_of_clip "GXL 1.5", "holds" },
  { "soft wire out of a clip", out_of_clip "soft", "holds" },
  { "cable laid by a guide", laid "FLRY-B 0.5", "feeds" },
  { "soft wire laid by a guide", laid "soft", "feeds" },
  { "cable pushed by a plate", pushed "GXL 1.5", "obstacles" },
}

local function ledger(build, dt)
  local s = sw.scene{}
  local duration = build(s)
  local run = t.fine(s:run{ dt = dt, duration = duration })
  return run:ledger(), run
end

describe("the ledger of a wire that touches something", function()
  for _, case in ipairs(cases) do
    local name, build, worker = table.unpack(case)
    it("gives the same work at any step: " .. name, function()
      local fine = ledger(build, 5e-4)
      for _, dt in ipairs{ 2e-2, 1e-2, 5e-3, 2e-3 } do
        local l, run = ledger(build, dt)
        local what = (" at steps of %g s"):format(dt)
        t.below(5e-3, l.gap / l.play, "from nowhere [-]" .. what)
        -- a feed starts abruptly: the step decides how fast the wire follows
        t.near(0, (l.work[worker] - fine.work[worker]) / fine.play, worker == "feeds" and 0.025 or 0.005,
          "work [-]" .. what)
        t.below(0.03, l.redone.count / run.steps, "steps redone [-]" .. what)
      end
    end)
  end

  -- Energy that flowed in a step is lost at once, not stored until the step is taken. Each of the ten runs
  -- reads the scene's energy again, and must find no change in between.
  it("counts the loss of plastic bending once", function()
    local s = sw.scene{}
    over_peg("FLRY-B 0.5", plastic)(s)
    local changes, lost, play = 0, 0, 0
    for _ = 1, 10 do
      local l = t.fine(s:run{ dt = 0.01, duration = 0.1 }):ledger()
      changes, lost = changes + math.abs(l.work.changes), lost + l.lost.plasticity
      play = math.max(play, l.play)
    end
    t.share(s:energy().dissipated, lost, 1e-9, "lost [J]")
    t.below(1e-3, changes / play, "changes [-]")
  end)
end)
