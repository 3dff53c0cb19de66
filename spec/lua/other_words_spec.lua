-- SPDX-License-Identifier: GPL-3.0-or-later
-- Words of other programs and textbooks (csrc/base/other_words.def): messages propose the name used here.
local sw = require "softworld"
local core = require "softworld.core"

local FILE = "csrc/base/other_words.def"

local function rows()
  local list = {}
  for line in io.lines(FILE) do
    local word, name = line:match '^SW_OTHER%("([^"]+)", "([^"]+)"%)$'
    if word then list[#list + 1] = { word = word, name = name } end
  end
  return list
end

local function message(of) return select(2, pcall(of)) end

describe("another word for a name", function()
  local scene = sw.scene{}
  local wire = scene:wire{ E = 5e6, density = 1000, radius = 0.002, from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
  local hold = scene:clamp(wire, { s = 0 })
  for asked, case in pairs{
    ["a wire's poisson"] = { "nu", function() scene:wire{ poisson = 0.4 } end },
    ["a wire's Youngs_Modulus"] = { "E", function() scene:wire{ Youngs_Modulus = 1e6 } end },
    ["an obstacle's mu"] = { "friction", function() scene:obstacle{ shape = "plane", mu = 0.3 } end },
    ["an obstacle's position"] = { "at", function() scene:obstacle{ shape = "plane", position = {} } end },
    ["the shape floor"] = { "plane", function() scene:obstacle{ shape = "floor" } end },
    ["a run's time_step"] = { "dt", function() scene:run{ duration = 1, time_step = 0.01 } end },
    ["backward-euler"] = { "implicit-euler", function()
      scene:run{ duration = 1, integrator = "backward-euler" }
    end },
    ["a clamp's at"] = { "s", function() scene:clamp(wire, { at = 0 }) end },
    ["a channel's path"] = { "points", function() scene:channel{ path = {} } end },
    ["a path's waypoints"] = { "points", function() hold:follow{ waypoints = {} } end },
    ["scene:step"] = { "run", function() scene:step() end },
    ["a force spring"] = { "tether", function() scene:force{ kind = "spring" } end },
  } do
    it("is answered with it: " .. asked, function()
      local why = message(case[2])
      assert.truthy(why:find(("did you mean '%s'?"):format(case[1]), 1, true), why)
    end)
  end

  it("is proposed only where the name is known", function()
    assert.equal("nu", core.nearest("mu", { "nu", "radius" })) -- near, as any typo
    assert.equal("friction", core.nearest("mu", { "nu", "friction" }))
    assert.is_nil(core.nearest("poisson", { "radius", "at" }))
    assert.equal("nu", core.nearest("Poisson's ratio", { "E", "nu" }))
  end)

  it("stands in the list once, in order, for a name that the program has", function()
    local file = assert(io.popen "cat $(find lua csrc -name '*.lua' -o -name '*.c' -o -name '*.h')")
    local sources, before, seen = file:read "a", "", {}
    file:close()
    assert.is_true(#rows() > 60)
    for _, row in ipairs(rows()) do
      local key = row.word .. "/" .. row.name
      assert.is_true(before <= row.word, row.word)
      assert.is_nil(seen[key], key)
      before, seen[key] = row.word, true
      local name = row.name:gsub("%p", "%%%0")
      assert.truthy(sources:find('"' .. name .. '"') or sources:find("[%.:]" .. name .. "%f[^%w_]"), row.name)
    end
  end)
end)
