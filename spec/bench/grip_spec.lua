-- SPDX-License-Identifier: GPL-3.0-or-later
-- The benchmark of grippers: the two-plate test succeeds with every way of gripping, and hard grips end in
-- the expected status.
local sw = require "softworld"
local benchgrip = require "bench.grip"

describe("the two-plate test", function()
  for _, way in ipairs(benchgrip.ways) do
    it("succeeds with " .. way[1], function()
      local row = benchgrip.two_plates(way, 0.02)
      assert.is_true(row.ok, row.reason)
      assert.equal(4, #row.phases)
      local weight = 1200 * math.pi * 0.003 ^ 2 * 0.2 * 9.81
      assert(math.abs(row.force / weight - 1) < 0.05, ("force %g, weight %g"):format(row.force, weight))
      assert(row.droop > 0.003 and row.droop < 0.1, "droop " .. row.droop)
      if way[3] ~= "imposed" then assert(row.height < 0.0064, "height " .. row.height) end
    end)
  end
end)

describe("hard grips", function()
  it("hold, are lost or are refused, and the program carries on", function()
    local seen = {}
    benchgrip.add_all(function(item, run, o)
      if o.model == "rod" then
        local row = run(o)
        seen[item] = row.status
      end
    end)
    assert.equal("ok", seen["grip thrown at 1 m/s"])
    assert.equal("lost", seen["lifted with friction 0"])
    assert.equal("ok", seen["lifted with friction 5"])
    assert.equal("refused", seen["a force of 100 kN"])
    assert.is_true(sw.scene{} ~= nil)
  end)
end)
