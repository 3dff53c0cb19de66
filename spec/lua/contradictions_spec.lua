-- SPDX-License-Identifier: GPL-3.0-or-later
-- Arguments that contradict one another, or would be left out in silence, are errors that say what to do.
local sw = require "softworld"
local mm = sw.units.mm

local function lifted()
  local scene = sw.scene { name = "lifted" }
  local table_ = scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  local wire = scene:wire { name = "wire", cable = "GXL 1.5", segments = 10, from = mm { 0, 0, 1.5 },
    to = mm { 300, 0, 1.5 } }
  local hand = scene:gripper { name = "hand", pads = { width = mm(10) } }
  return scene, hand, wire, table_
end

local function refused(text, f, ...)
  local fine, why = pcall(f, ...)
  assert.is_false(fine, "accepted: " .. text)
  assert.is_truthy(tostring(why):find(text, 1, true), tostring(why))
end

describe("gripper:move", function()
  local up = { 0, 0, 0.1 }

  it("refuses two targets, and words that do not go with the target", function()
    local _, hand, wire = lifted()
    hand:grasp(wire, { s = 0.1 })
    local way = { { 0, 0, 0 }, up }
    for text, args in pairs {
      ["give by or to, not both"] = { by = up, to = up },
      ["give to or points, not both"] = { to = up, points = way },
      ["give by or path, not both"] = { by = up, path = way },
      ["give by or func, not both"] = { by = up, func = function() return up end, duration = 1 },
      ["a function is given as func"] = { path = function() return up end, duration = 1 },
      ["scale goes with a path that names a file; sw.units.mm converts"] = { points = way, scale = 1e-3,
        relative = true },
      ["by is relative to the present place"] = { by = up, relative = false },
      ["to is a place of the scene"] = { to = up, relative = true },
      ["rotation goes with to"] = { by = up, rotation = { 1, 0, 0, 0 } },
    } do
      args.speed = not args.func and not args.duration and 0.1 or nil
      refused("gripper:move: ", hand.move, hand, args)
      refused(text, hand.move, hand, args)
    end
    hand:move { by = up, speed = 0.1, relative = true }
  end)
end)

describe("gripper:grasp", function()
  it("names the gripper and s for a place below 0", function()
    local _, hand, wire = lifted()
    refused("gripper 'hand': s = -1 m is not allowed; it must be at least 0 m", hand.grasp, hand, wire,
      { s = -1 })
  end)
end)

describe("loads between two times", function()
  -- Zeros would be taken for loads that were measured.
  it("are refused where the interval lies ahead or ends before it begins", function()
    local scene, hand, wire, table_ = lifted()
    local clamp = scene:clamp(wire, { s = wire.length, name = "clamp" })
    local tie = scene:tie(wire, { s = 0.1, to = { 0.1, 0, 0.2 }, name = "tie" })
    scene:process(function()
      hand:grasp(wire, { s = 0.01 })
      hand:move { by = mm { 0, 0, 20 }, duration = 0.3 }
    end)
    local run = scene:run { dt = 0.01 }
    for name, object in pairs { gripper = hand, obstacle = table_, clamp = clamp, tie = tie } do
      refused(name .. ":over: t2 = 0.1 s is before t1 = 0.2 s", object.over, object, 0.2, 0.1)
      refused(name .. ":over: t1 = 5 s is not recorded yet; the scene is at t = 0.3 s", object.over, object,
        5, 6)
      refused("nan s is not allowed; it must be finite", object.over, object, 0 / 0)
      assert.is_near(0.1, object:over(0.1, 0.2).duration, 0.01) -- whole steps
      assert.equal(0, object:over(run.time).duration)
    end
    assert.is_near(0.2, hand:over(0.1, 5).duration, 0.01) -- up to now
  end)
end)

describe("a gripper that held nothing", function()
  it("says so beside its loads of 0", function()
    local scene, hand = lifted()
    local run = scene:run { duration = 0.1, dt = 0.01 }
    assert.equal("0 N (it held nothing)", hand:over().peak_force_text)
    local notes = 0
    for _, row in ipairs(run:document().summary) do
      if row.label:find "^hand: peak" then notes = notes + (row.where == "(it held nothing)" and 1 or 0) end
    end
    assert.equal(2, notes)
  end)
end)

describe("a picture of a run", function()
  it("is refused at a time that the run has not reached", function()
    local scene = lifted()
    local run = scene:run { duration = 0.1, dt = 0.01 }
    local name = os.tmpname()
    local path = name .. ".png"
    for call, args in pairs { picture = { path = path, t = 5 }, pictures = { path = path, times = { 5 } } } do
      refused(("run:%s: the time = 5 s is not in the run, which goes from 0 s to 0.1 s"):format(call),
        run[call], run, args)
    end
    refused("run:obj: the time = 5 s is not in the run", run.obj, run, "x.obj", { t = 5 })
    refused("run:picture: times[2] = 0.2 s is not in the run", run.picture, run, { path = path,
      times = { 0, 0.2 } })
    assert.is_nil(io.open(path))
    assert.equal(path, run:picture { path = path, t = 0.1 }.path)
    os.remove(path)
    os.remove(name)
  end)
end)

describe("scene:obstacle", function()
  it("tells what stands for a tube", function()
    local scene = lifted()
    refused("there is no shape 'tube'; for a bore take a channel with a lid, a torus or a mesh, see help "
      .. "'insert'", scene.obstacle, scene, { shape = "tube", radius = 0.01 })
  end)
end)
