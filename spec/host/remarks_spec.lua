-- SPDX-License-Identifier: GPL-3.0-or-later
-- Remarks on values that are allowed but probably a mistake.
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/host"
local program = dofile(here .. "/program.lua")
local script = program.script
local tools = require "spec.shape.tools"

local start = 'local sw = require "softworld" local s = sw.scene{}\n'
local good = "E = 50e6, density = 1500, radius = 0.0025, from = {0, 0, 0.1}, to = {1, 0, 0.1}"

local function wire(change) return ("s:wire{ %s }"):format(change) end

describe("remarks", function()
  after_each(program.clean)

  local cases = {
    { wire "E = 50e6, density = 1500, radius = 2.5, from = {0,0,9}, to = {1,0,9}",
      "radius = 2.5 m is above 0.1 m; did you mean sw.units.mm(2.5)?" },
    { wire "E = 50, density = 1500, radius = 0.0025, from = {0,0,1}, to = {1,0,1}",
      "E = 50 Pa is below 10000 Pa; did you mean sw.units.MPa(50)?" },
    { wire "E = 50e6, density = 1500000, radius = 0.0025, from = {0,0,1}, to = {1,0,1}",
      "density = 1.5e+06 kg/m3 is above" },
    { wire "E = 50e6, density = 1500, radius = 0.0025, from = {0,0,1}, to = {500,0,1}",
      "length = 500 m is above 300 m; did you mean sw.units.mm(500)?" },
    { wire "E = 50e6, density = 1500, radius = 0.0025, from = {0,0,1}, to = {300,0,1}",
      "wire 'wire1' is 300 m long, with edges of 6 m; did you mean 300 mm?" },
    { "s:obstacle{ shape = 'plane', friction = 30 }", "friction = 30 is above 3" },
    { "s:obstacle{ shape = 'plane', friction = 0.1, kinetic_friction = 0.3 }",
      "obstacle 'plane1': kinetic_friction = 0.3 is above friction = 0.1" },
    { "sw.scene{ gravity = {0, 0, 9.81} }", "gravity = 9.81 m/s2 along z points up; did you mean -9.81?" },
    { "local g = s:gripper{ at = {0, 0, 0} } g:move{ by = {0, 0, -100}, speed = 1 }",
      "by = -100 m is below -20 m; did you mean sw.units.mm(-100)?" },
    { "local g = s:gripper{ at = {0, 0, 0} } g:move{ to = {0, 0, 100}, speed = 1 }",
      "to = 100 m is above 20 m; did you mean sw.units.mm(100)?" },
    { "s:obstacle{ shape = 'plane' } " .. wire("E = 50e6, density = 1500, radius = 0.0025, "
      .. "from = {0,0,0.1}, to = {1,0,-0.1}"),
      "wire 'wire1' begins inside 'plane1': it reaches 102.5 mm into it at (1, 0, -0.1) m" },
    { wire(good) .. " s:obstacle{ name = 'ball', shape = 'sphere', radius = 0.1, at = {0.5, 0, 0.1} }",
      "wire 'wire1' begins inside 'ball'" },
    { "sw.scene{ gravity = {0, 0, -9810} }", "did you mean sw.units.mm_per_s2(9810)?" },
    { "s:gripper{ pads = { width = 20 } }", "did you mean sw.units.mm(20)?" },
    { "local g = s:gripper{ at = {0, 0, 0} } g:move{ by = {0, 0, 1}, speed = 200 }",
      "did you mean sw.units.mm_per_s(200)?" },
    { "local g = s:gripper{ at = {0, 0, 0} } g:rotate{ axis = {0, 0, 1}, angle = -90, duration = 1 }",
      "gripper 'gripper1': move: angle = -90 rad is 14.3 turns; did you mean sw.units.deg(-90)?" },
    { "s:obstacle{ name = 'peg', shape = 'box', size = {1, 1, 1}, rotation = { axis = {1, 0, 0}, "
      .. "angle = 45 } }",
      "obstacle 'peg': angle = 45 rad is 7.16 turns; did you mean sw.units.deg(45)?" },
    { "s:obstacle{ shape = 'plane' } "
      .. "s:clip{ at = {0, 0, -0.05}, width = 0.01, insertion = 5, retention = 9 }",
      "clip 'clip1': its seat is 50 mm inside 'plane1', where no wire can lie" },
    { "local w = " .. wire(good) .. " s:feed(w, { s = 0.5, speed = 100 })",
      "feed 'feed1': speed = 100 m/s is above 20 m/s; did you mean sw.units.mm_per_s(100)?" },
    { "s:gripper{ rating = { force = 5e5 } }", "gripper 'gripper1': rating: force = 500000 N is above" },
    { "s:clip{ at = {0, 0, 0}, width = 8, insertion = 5, retention = 9 }", "sw.units.mm(8)" },
    { "local w = " .. wire(good)
      .. " s:tie(w, { s = 0.5, to = {0.5, 0, 0.15}, slack = 0.02, strength = 50 })",
      "the places are 50 mm apart and the slack is 20 mm: the tie pulls them together with 3e+03 N at once, "
        .. "and breaks. Its pull at rest is right; its pull before and its peaks depend on the time step" },
    { "local w = " .. wire("E = 5e7, density = 1500, radius = 0.001, from = {0,0,1}, to = {0.4,0,1}")
      .. " w:remodel{ model = 'composite' }", "wire 'wire1' as composite has 33375 particles" },
    { wire "model = 'radial', E = 5e7, density = 1500, radius = 0.001, from = {0,0,1}, to = {0.4,0,1}",
      "wire 'wire1' as radial has 15130 particles" },
    { wire(good .. ", segments = 20") .. " s:obstacle{ name = 'peg', shape = 'cylinder', radius = 0.01, "
      .. "length = 1, at = {0.5, 0, -1} }", "wire 'wire1': its edges of 50 mm are longer than the radius of "
      .. "'peg', 10 mm, so the wire goes round it as a polygon" },
    { "s:obstacle{ name = 'peg', shape = 'capsule', radius = 0.01, length = 1, at = {0.5, 0, -3} } "
      .. wire(good .. ", segments = 20"), "segments = 200 makes edges half as long as the radius" },
    { "s:obstacle{ name = 'peg', shape = 'mesh', format = 'obj', at = {0.5, 0, -3}, data = "
      .. ("%q"):format(tools.obj(tools.ball(0.01, 40, 40))):gsub("\\\n", "\\n") .. " } "
      .. wire(good .. ", segments = 20"), "its edges of 50 mm are longer than the radius of 'peg', 10" },
  }
  for _, case in ipairs(cases) do
    it("appear for " .. case[1], function()
      local _, err, code = script(start .. case[1])
      assert.truthy(err:find("script.lua:2: remark: ", 1, true), err)
      assert.truthy(err:find(case[2], 1, true), err)
      assert.equal(0, code)
    end)
  end

  it("tell of a process that never ran, when the script ends", function()
    local begin = start .. "local w = " .. wire(good) .. "\nlocal g = s:gripper{}\n"
      .. "s:process(function(p)\n  g:grasp(w, { s = 0.1 })\nend)\n"
    local _, err, code = script(begin .. "s:process(function(p) end)")
    assert.equal("script.lua:4: remark: this process never ran: scene:run{...} computes what it describes\n",
      (err:gsub("^.*/", "")))
    assert.equal(0, code)
    for _, use in ipairs { "s:run{ duration = 0.01 }", "s:settle()", "sw.remarks = false", "error 'x'",
      ("s:save(%q)"):format(program.folder() .. "/x.sws"),
      "sw.study { name = 'a', parameters = { x = { 0, 1 } }, evaluate = function() return { y = 1 } end }",
    } do
      _, err = script(begin .. use)
      assert.is_nil(err:find "never ran", use)
    end
    _, err = script(start .. wire(good))
    assert.equal("", err)
  end)

  it("tell that loads are read before anything has run", function()
    local begin = start .. "local w = " .. wire(good) .. [[

local o, g = s:obstacle{ shape = 'plane' }, s:gripper{}
local c = s:clamp(w, { s = 0 })
]]
    local reads = { ["g.peak_force"] = "gripper", ["g:over(0, 1).mean_force"] = "gripper",
      ["o:over().peak_force"] = "obstacle", ["c:over().impulse"] = "clamp" }
    for read, of in pairs(reads) do
      local _, err, code = script(("%slocal x = %s\nx = %s"):format(begin, read, read))
      local _, count = err:gsub("remark: " .. of .. ":over: nothing has run yet, so there is no record", "")
      assert.equal(2, count, err) -- once for each line
      assert.equal(0, code)
      for _, use in ipairs{ "s:settle()", "s:run{ duration = 0.01 }",
        "s:observe{ call = function() return " .. read .. " == 3 end } s:run{ duration = 0.01 }",
        "sw.remarks = false" } do
        _, err = script(("%s%s\nlocal x = %s"):format(begin, use, read))
        assert.is_nil(err:find("nothing has run", 1, true), use .. err)
      end
    end
    -- these are the values of the present state, and right
    local _, err = script(begin .. "local r, t = w:min_bend_radius(), w:max_tension()")
    assert.equal("", err)
  end)

  it("do not appear for ties that are slack or exactly as long as the distance", function()
    local _, err = script(start .. "local w = " .. wire(good) .. [[

      s:tie(w, { s = 0.5, to = { 0.5, 0, 0.15 } }) s:tie(w, { s = 0.2 })
      s:tie(w, { s = 0.3, to = { 0.3, 0, 0.15 }, slack = 0.06 })]])
    assert.equal("", err)
  end)

  it("appear once per line", function()
    local _, err = script(start
      .. "for i = 1, 5 do s:obstacle{ shape = 'plane', friction = 10 * i } end\n"
      .. "s:obstacle{ shape = 'plane', friction = 30 }")
    local _, count = err:gsub("remark", "")
    assert.equal(2, count)
  end)

  it("do not appear for usual values", function()
    local _, err = script(start .. [[
      s:obstacle{ shape = "plane", friction = 0.4 }
      s:obstacle{ shape = "box", size = {0.1, 0.1, 0.1}, at = {0.5, 0, 0.05} }
      s:obstacle{ shape = "cylinder", radius = 0.05, length = 0.1, at = {0.5, 2, 0.05} }
      s:wire{ cable = "GXL 1.5", from = {0, 0.2, 0.0014}, to = {1, 0.2, 0.0014} }
      s:wire{ E = 50e6, density = 1500, radius = 0.0025, from = {0, 0, 0.1025}, to = {1, 0, 0.1025} }
      local g = s:gripper{ at = {0.5, 0, 0.1025}, pads = { width = 0.02, friction = 0.6 } }
      s:clip{ at = {0.2, 0.4, 0.03}, width = 0.008, insertion = 12, retention = 40, friction = 0.3 }]])
    assert.equal("", err)
  end)

  it("are silenced by sw.remarks = false", function()
    local _, err = script(start .. "sw.remarks = false\ns:obstacle{ shape = 'plane', friction = 30 }")
    assert.equal("", err)
  end)

  -- Two wires that nothing lets touch are looked at when a run ends. One that had diverged has no places: the
  -- run raised an error about them instead of returning its reason.
  it("are left out of a run that has diverged", function()
    local out, err, code = script(start .. [[
      for k = 1, 2 do
        local w = s:wire{ E = 1e9, density = 1000, segments = 30, radius = 0.002, from = { 0, k, 0.1 },
          to = { 0.3, k, 0.1 } }
        s:clamp(w, { s = 0 })
      end
      local run = s:run{ duration = 0.5, dt = 0.02, integrator = "rk4", unstable = true }
      print(run.ok, run.reason:match "diverged" or run.reason)]])
    assert.same({ "", 0 }, { err, code })
    assert.matches("^false\t", out)
  end)

  -- The radius of the round surface that facets approximate was read of removed obstacles too.
  it("are left out of obstacles that were removed", function()
    local out, err = script(start .. [[
      local c = s:channel{ points = { { -0.1, 0, 0 }, { 0.2, 0, 0 }, { 0.4, 0, 0 } }, width = 0.02,
        depth = 0.02 }
      c:close()
      c:open()
      s:obstacle{ shape = "cylinder", radius = 1e-3, length = 0.1, at = { 0, 0, 2 } }:remove()
      s:wire{ E = 1e7, density = 1000, segments = 20, radius = 2e-3, from = { 0.2, 0, 0.1 },
        to = { 0.4, 0, 0.1 } }
      print(s:run{ duration = 0.01 }.ok)]])
    assert.same({ "true\n", "" }, { out, err })
  end)

  it("change nothing: a wire with unusual values runs", function()
    local out, err, code = script(start .. wire("E = 5e3, density = 1500, radius = 0.0025, "
      .. "from = {0,0,1}, to = {1,0,1}") .. " print(s:run{ duration = 0.01 }.ok)")
    assert.equal("true\n", out)
    assert.truthy(err:find("remark", 1, true))
    assert.equal(0, code)
  end)
end)
