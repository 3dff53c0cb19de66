-- SPDX-License-Identifier: GPL-3.0-or-later
-- Wires that press on each other get other edges in motion: by a remodel, or by a clamp that is made and
-- released. Nothing moves then, so forces and places stay. With the fault their touches were forgotten: a
-- taut pair of cables pulled with 7 and 24 % more than before (GXL 1.5, H07V-K 4), or the run failed; three
-- cables that lay on each other kept 3 % more force between them.
local sw = require "softworld"
local t = require "spec.physics.tools"

local function sum_of(scene)
  local sum = 0
  for _, touch in ipairs(scene:touches()) do sum = sum + t.norm(touch.force) end
  return sum
end

-- Two cables twisted about each other, drawn taut by 0.1 %. Returns the pull and the force between them,
-- before a change, in the step after it, and later. alone: each in a run of its own.
local function pair(o)
  local scene <close> = sw.scene{ gravity = { 0, 0, 0 } }
  local r, length, pitch, holds, wires = sw.cable(o.cable).outer_diameter.value / 2, 0.2, 0.08, {}, {}
  scene:wire_contact{ friction = 0.3 }
  for i = 0, 1 do
    local path = {}
    for k = 0, 200 do
      local a = 2 * math.pi * length * k / 200 / pitch + math.pi * i + (o.turned or 0)
      local at = o.swapped and 201 - k or k + 1
      path[at] = { length * k / 200, 1.02 * r * math.cos(a), 1.02 * r * math.sin(a) }
    end
    wires[i + 1] = scene:wire{ cable = o.cable, path = path, segments = 60 }
  end
  scene:force{ kind = "damping", mass = 20, stiffness = 0.001 }
  for i, w in ipairs(wires) do
    local near, far = o.swapped and w.length or 0, o.swapped and 0 or w.length
    scene:clamp(w, { s = near })
    holds[i] = scene:clamp(w, { s = far })
    holds[i]:follow{ points = { { 0, 0, 0 }, { 2e-4, 0, 0 } }, relative = true, duration = 0.3 }
  end
  local out, dt = {}, o.dt or 0.004
  local function look()
    out[#out + 1] = { pull = holds[1]:force()[1] + holds[2]:force()[1], between = sum_of(scene) }
  end
  local function change()
    if o.segments then
      wires[2]:remodel{ model = "rod", segments = o.segments }
    else
      scene:clamp(wires[1], { s = 0.111 }):release()
    end
  end
  local function course(wait)
    wait(0.5)
    look()
    change()
    for _, duration in ipairs{ dt, 0.2 } do
      wait(duration)
      look()
    end
  end
  if o.alone then
    course(function(duration) t.fine(scene:run{ duration = duration, dt = dt }) end)
  else
    scene:process(function(p) course(function(duration) p:wait(duration) end) end)
    t.fine(scene:run{ dt = dt })
  end
  return out
end

-- A cable lies on two others that are clamped at both ends, and is pressed on them by 2 N/m.
local function three(cable, which, segments)
  local scene <close> = sw.scene{}
  local r, length, wires = sw.cable(cable).outer_diameter.value / 2, 0.3, {}
  scene:obstacle{ shape = "plane", friction = 0.4 }
  scene:wire_contact{ friction = 0.4 }
  for i, y in ipairs{ -r, r } do
    wires[i] = scene:wire{ cable = cable, from = { 0, y, r }, to = { length, y, r }, segments = 40 }
    scene:clamp(wires[i], { s = 0 })
    scene:clamp(wires[i], { s = length })
  end
  local z = r + 3 ^ 0.5 * r
  wires[3] = scene:wire{ cable = cable, from = { 0.02, 0, z }, to = { length - 0.02, 0, z }, segments = 37 }
  for k = 0, 26 do
    local at = math.min(k * 0.01, wires[3].length)
    scene:force{ kind = "point", on = wires[3], s = at, force = { 0, 0, -0.02 } }
  end
  scene:force{ kind = "damping", mass = 20, stiffness = 0.001 }
  t.fine(scene:run{ duration = 0.5, dt = 0.004 })
  local before, z0 = sum_of(scene), wires[3]:position(0.13)[3]
  wires[which]:remodel{ model = "rod", segments = segments }
  t.fine(scene:run{ duration = 0.3, dt = 0.004 })
  return before, sum_of(scene), wires[3]:position(0.13)[3] - z0
end

describe("wires that press on each other and get other edges", function()
  for _, case in ipairs{
    { "GXL 1.5", 60 }, { "GXL 1.5", 77 }, { "GXL 1.5", 45 }, { "GXL 1.5" }, { "H07V-K 4", 77 },
    { "H07V-K 4", 45 }, { "H07V-K 4" }, { "FLRY-B 0.5", 77 }, { "FLRY-B 0.5", 45 }, { "FLRY-B 0.5" },
    { "GXL 1.5", 77, dt = 1e-3 }, { "GXL 1.5", 77, turned = 0.5 }, { "GXL 1.5", 77, swapped = true },
  } do
    local cable, segments = case[1], case[2]
    it(("keep pull and force: %s, %s%s%s%s"):format(cable, segments or "a clamp", case.dt and ", 1 ms" or "",
      case.turned and ", turned" or "", case.swapped and ", swapped" or ""), function()
      local out = pair{ cable = cable, segments = segments, dt = case.dt, turned = case.turned,
        swapped = case.swapped }
      for i = 2, 3 do
        t.share(out[1].pull, out[i].pull, 0.002, "pull [N]")
        t.share(out[1].between, out[i].between, 0.02, "force between them [N]")
      end
    end)
  end

  -- A node that lay open beside a pressed one of the other wire took that one's force as well: H07V-K 4 got
  -- 20 uJ from nowhere. Within a longer run that was a small share; a run of its own failed.
  it("keep them where the change comes after rest, in a run of its own", function()
    for _, case in ipairs{
      { "GXL 1.5", 60 }, { "FLRY-B 0.5", 60 }, { "H07V-K 4", 60 }, { "H07V-K 4", 77 }, { "H07V-K 4", 45 },
      { "H07V-K 4" }, { "H07V-K 4", 60, turned = 0.5 }, { "H07V-K 4", 60, swapped = true },
    } do
      local cable, segments = case[1], case[2]
      local out = pair{ cable = cable, segments = segments, alone = true, turned = case.turned,
        swapped = case.swapped }
      local same = segments == 60 -- the same edges: nothing changes
      for i = 2, 3 do
        local what = ("%s, %s segments"):format(cable, segments or "a clamp,")
        t.share(out[1].pull, out[i].pull, same and 1e-6 or 0.002, "pull [N]: " .. what)
        t.share(out[1].between, out[i].between, same and 1e-6 or 0.02, "force between them [N]: " .. what)
      end
    end
  end)

  it("keep the force between three that lie on each other", function()
    for _, cable in ipairs{ "GXL 1.5", "FLRY-B 0.5" } do
      for _, case in ipairs{ { 3, 23 }, { 3, 50 }, { 1, 57 } } do
        local before, after, risen = three(cable, case[1], case[2])
        local what = ("%s, wire %d, %d segments"):format(cable, case[1], case[2])
        t.share(before, after, 0.01, "force between them [N]: " .. what)
        t.near(0, risen, 5e-7, "rise [m]: " .. what)
      end
    end
  end)
end)
