-- SPDX-License-Identifier: GPL-3.0-or-later
-- object:log(t1, t2) returns the steps between two times and one more on each side. Loads computed from
-- these equal the loads computed from all steps.
local sw = require "softworld"

local function scene_of()
  local scene = sw.scene{}
  local plane = scene:obstacle{ name = "plane", shape = "plane", friction = 0.3 }
  local wire = scene:wire{ name = "wire", cable = "GXL 1.5", from = { 0, 0, 0.03 }, to = { 0.3, 0, 0.03 },
    segments = 12 }
  scene:force{ kind = "damping", on = wire, mass = 1, stiffness = 1e-3 }
  local clamp = scene:clamp(wire, { s = 0 })
  local tie = scene:tie(wire, { s = 0.3, to = { 0.3, 0, 0.1 }, slack = 0.09 })
  local hand = scene:gripper{ name = "hand", pads = { width = 0.01 } }
  scene:process(function(p)
    hand:grasp(wire, { s = 0.2 })
    hand:move{ by = { 0, 0, 0.03 }, duration = 0.1 }
    p:wait(0.05)
    hand:release()
    p:wait(0.05)
  end)
  assert.is_true(scene:run{ dt = 0.005 }.ok)
  return scene, { wire = { wire, 3 }, clamp = { clamp, 10 }, plane = { plane, 5 }, tie = { tie.object, 4 } },
    { clamp = clamp, plane = plane, tie = tie, hand = hand }
end

-- Rows of a flat list, as lists.
local function rows_of(flat, count, width)
  local list = {}
  for i = 1, count do list[i] = { table.unpack(flat, width * (i - 1) + 1, width * i) } end
  return list
end

describe("object:log", function()
  it("gives the steps between two times, and one more on each side", function()
    local scene, all = scene_of()
    for name, it in pairs(all) do
      local object, width = it[1], it[2]
      local flat, count = object:log()
      local whole = rows_of(flat, count, width)
      for _, span in ipairs{ { -1, 9 }, { 0.05, 0.1 }, { whole[3][1], whole[5][1] }, { 0.0712, 0.0712 },
        { 7, 8 }, { -3, -2 }, { 0.1, 0.05 } } do
        local wanted = {}
        for i, row in ipairs(whole) do
          local before, after = whole[i - 1], whole[i + 1]
          local inside = row[1] >= span[1] and row[1] <= span[2]
          local first = row[1] < span[1] and (not after or after[1] >= span[1])
          local last = row[1] > span[2] and (not before or before[1] <= span[2])
          if inside or first or last then wanted[#wanted + 1] = row end
        end
        if span[1] <= span[2] then
          local some, n = object:log(span[1], span[2])
          assert.same(wanted, rows_of(some, n, width), name .. " from " .. span[1])
        end
      end
      assert.same(flat, (object:log(nil, nil)))
      assert.has_error(function() object:log(0 / 0) end)
      assert.has_error(function() object:log(0, "late") end)
      assert.is_true(select(2, object:log(0.1, 0.05)) <= 3) -- no crash
    end
    scene:close()
  end)

  it("leaves loads as they are: two halves add up to the whole", function()
    local scene, _, objects = scene_of()
    local half, ends = scene.time / 2, scene.time
    for name, object in pairs(objects) do
      local whole, one, two = object:over(), object:over(0, half), object:over(half, ends)
      for k = 1, 3 do
        local sum, off = one.impulse[k] + two.impulse[k], 1e-3 * (1e-3 + whole.impulse_size)
        assert.is_near(whole.impulse[k], sum, off, name)
      end
      assert.equal(whole.raw_peak_force, math.max(one.raw_peak_force, two.raw_peak_force))
    end
    scene:close()
  end)
end)
