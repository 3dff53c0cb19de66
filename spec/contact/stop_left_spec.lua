-- SPDX-License-Identifier: GPL-3.0-or-later
-- A stiff cable on two posts, or on two other cables, is drawn along itself, and its hold stops at once. On a
-- table it keeps all of its friction (spec/contact/stop_at_once_spec). Here waves, and how stiff friction is
-- before it slides, decide how much is left: 0.26 to 0.81 of mu m g on posts in steps of 0.5 to 20 ms, and
-- -0.38 for 0.66 on cables, without an event.
local sw = require "softworld"

local LENGTH = 0.3 -- [m]

local function drawn(o, dt)
  local scene = sw.scene{}
  local r = o.cable and sw.cable(o.cable).outer_diameter.value / 2 or o.radius
  scene:force{ kind = "damping", mass = 1, stiffness = 1e-3 }
  local z = r + 0.003
  if o.on == "table" then scene:obstacle{ shape = "plane", at = { 0, 0, z - r }, friction = 0.25 } end
  for _, x in ipairs{ 0.05, 0.25 } do
    if o.on == "posts" then
      scene:obstacle{ shape = "cylinder", at = { x, 0, 0 }, length = 0.1, radius = 0.003, friction = 0.25,
        rotation = { axis = { 1, 0, 0 }, angle = math.pi / 2 } }
    elseif o.on == "wires" then
      local rail = scene:wire{ E = 1e9, density = 1500, radius = 0.003, from = { x, -0.05, 0 },
        to = { x, 0.05, 0 }, segments = 10 }
      for k = 0, 10 do scene:clamp(rail, { s = 0.01 * k }) end
    end
  end
  local wire = scene:wire{ cable = o.cable, E = o.E, density = o.E and 1500, radius = o.radius,
    from = { 0, 0, z }, to = { LENGTH, 0, z }, segments = o.segments }
  scene:wire_contact{ friction = 0.25 }
  local hold = scene:clamp(wire, { s = 0 })
  if o.on ~= "table" then scene:settle() end -- settled touches give way less
  hold:follow{ relative = true, duration = 0.4, law = o.law or "linear",
    points = { { 0, 0, 0 }, { -0.03, 0, 0 } } }
  local run = scene:run{ dt = dt, duration = 0.6, tolerance = o.tolerance }
  local told = 0
  for _, e in ipairs(run.events) do
    local words = "stopped at once.* compare the forces at rest$"
    if e.kind == "coarse" and e.text:find(words) then told = told + 1 end
  end
  scene:close()
  return told
end

describe("a cable on few supports whose hold stops at once", function()
  for _, on in ipairs{ "posts", "wires" } do
    it("has an event: " .. on, function()
      for k, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5", "FLRY-B 10" } do
        for _, dt in ipairs{ 0.02, 0.01, 0.002 } do
          local told = drawn({ on = on, cable = cable, segments = 28 + k }, dt)
          assert.equal(1, told, ("%s, %g s"):format(cable, dt))
        end
      end
      local by = { on = on, cable = "GXL 1.5", segments = 30, tolerance = 1e-4 }
      assert.equal(1, drawn(by, 0.02), "by tolerance")
    end)
  end

  it("has none on a table, if it is soft, or if it slows down", function()
    for _, dt in ipairs{ 0.01, 0.002 } do
      assert.equal(0, drawn({ on = "table", cable = "GXL 1.5", segments = 30 }, dt))
      assert.equal(0, drawn({ on = "wires", E = 1e7, radius = 0.0015, segments = 30 }, dt))
      assert.equal(0, drawn({ on = "wires", cable = "GXL 1.5", segments = 30, law = "minimum-jerk" }, dt))
    end
  end)
end)
