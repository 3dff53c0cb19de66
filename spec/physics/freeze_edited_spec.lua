-- SPDX-License-Identifier: GPL-3.0-or-later
-- gripper:freeze() right after a change of the scene, at the same instant. A change takes the touches of the
-- last step away until the next one, and pads that pressed with newtons were told not to press. What they
-- press stays in their memory, and a freeze finds it there: it is the same freeze as without the change.
local sw = require "softworld"
local t = require "spec.physics.tools"

-- Freezes a grip, right after a change or not: its event, and the wire's end some time after.
local function frozen(change, contact)
  local scene <close> = sw.scene{}
  local w = scene:wire{ E = 8.68e7, density = 1400, radius = 0.003, from = { 0, 0, 0.1 }, segments = 13,
    to = { 0.3, 0, 0.1 } }
  local g = scene:gripper{ pads = { width = 0.01, friction = 0.8, opening = 0.01 } }
  scene:clamp(w, { s = 0 })
  if contact then scene:wire_contact{ friction = 0.3 } end
  scene:process(function(p)
    g:grasp(w, { s = 0.1, approach = "mixed", force = 8, speed = 0.2, spacing = 0.002, region = 0.02,
      freeze = false })
    p:wait(0.05)
    if change then change(scene, w) end
    g:freeze()
    p:wait(0.1)
  end)
  t.fine(scene:run{ dt = 2e-3 })
  for _, e in ipairs(g.events) do
    if e.kind == "frozen" then return e, w:position(w.length), g:force(), g.tool:state().margin end
  end
end

local function check(change, contact)
  local right, at, force, margin = frozen(nil, contact)
  local e, x, f, m = frozen(change, contact)
  for k = 1, 3 do
    t.near(right.force[k], e.force[k], 0.02, "force of the pads [N]")
    t.near(force[k], f[k], 0.02, "force of the gripper [N]")
    t.near(at[k], x[k], 2e-6, "end of the wire [m]")
  end
  t.share(margin, m, 0.02, "margin [-]")
end

describe("gripper:freeze() right after a change at the same instant", function()
  it("is the same freeze: after another force was made", function()
    check(function(scene) scene:force{ kind = "damping", mass = 1e-6 } end)
  end)

  it("is the same freeze: after an obstacle far away was made, with contact of wires", function()
    check(function(scene) scene:obstacle{ shape = "sphere", radius = 0.01, at = { 0, 0, -1 } } end, true)
  end)
end)

describe("a mixed grasp by an unknown model", function()
  it("is refused before its pads are made", function()
    local scene <close> = sw.scene{}
    local w = scene:wire{ E = 8.68e7, density = 1400, radius = 0.003, from = { 0, 0, 0.1 }, segments = 13,
      to = { 0.3, 0, 0.1 } }
    local g = scene:gripper{ pads = { width = 0.01, friction = 0.8, opening = 0.01 } }
    scene:clamp(w, { s = 0 })
    scene:process(function()
      local fine, why = pcall(g.grasp, g, w, { s = 0.1, approach = "mixed", force = 8, model = "radiall" })
      assert.is_false(fine)
      assert.truthy(why:find("did you mean 'radial'", 1, true), why)
      assert.is_nil(g.tool)
    end)
    t.fine(scene:run{ dt = 2e-3 })
  end)
end)

describe("a release of a frozen grip while a force for rods is on the wire", function()
  -- The mesh that would come back was refused, and so was the release. The force never yields: it does
  -- nothing.
  it("leaves the wire a rod, as a release without the force does", function()
    local function free(force)
      local scene <close> = sw.scene{}
      local w = scene:wire{ E = 8.68e7, density = 1400, radius = 0.003, from = { 0, 0, 0.1 }, segments = 13,
        to = { 0.3, 0, 0.1 } }
      local g = scene:gripper{ pads = { width = 0.01, friction = 0.8, opening = 0.01 } }
      scene:clamp(w, { s = 0 })
      scene:force{ kind = "damping", mass = 5 }
      scene:process(function(p)
        g:grasp(w, { s = 0.1, approach = "mixed", force = 8, speed = 0.2, spacing = 0.002, region = 0.02 })
        if force then scene:force{ kind = "plastic", on = w, yield_moment = 10 } end
        p:wait(0.02)
        g:release()
        assert.equal("rod", w.model)
        assert.is_nil(g.wire)
        p:wait(1.5)
      end)
      t.fine(scene:run{ dt = 2e-3 })
      return w:position(w.length)[3]
    end
    t.near(free(false), free(true), 1e-4, "height of the wire's end [m]")
  end)
end)
