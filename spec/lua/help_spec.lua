-- SPDX-License-Identifier: GPL-3.0-or-later
-- help of values: sw, its parts, methods, and names that are no topics.
local sw = require "softworld"

-- Returns what help prints.
local function shown(value)
  local lines, before = {}, print
  rawset(_G, "print", function(text) lines[#lines + 1] = tostring(text) end)
  local fine, why = pcall(sw.help, value)
  rawset(_G, "print", before)
  assert.is_true(fine, why)
  return table.concat(lines, "\n")
end

describe("help", function()
  it("of sw lists its functions", function()
    local text = shown(sw)
    assert.truthy(text:find("^functions of sw"))
    for _, call in ipairs{ "sw.scene{...}", "sw.load(file)", "sw.cable.define{...}", "sw.tune.minimise{" } do
      assert.truthy(text:find("  " .. call, 1, true), call)
    end
  end)

  it("of a part of sw, or of a method, is its page or its parameters", function()
    assert.truthy(shown(sw.units):find("^Units\n"))
    assert.truthy(shown(sw.cable):find("^The catalogue of cables\n"))
    assert.truthy(shown(sw.tune):find("^sw.tune.minimise{ f =, ... }: finds where f is smallest"))
    assert.truthy(shown(sw.load):find("sw.load(file): reads a scene", 1, true))
    assert.truthy(shown(sw.scene):find("acceleration of gravity", 1, true))
    assert.truthy(shown(sw.scene{}.remove):find("^scene:remove%(object or name%)"))
  end)

  it("knows cables and units by their names", function()
    assert.truthy(shown "GXL 1.5":find("^GXL 1.5: automotive wire"))
    assert.equal("sw.units.mm(x) is x times 0.001 in m; help 'units' lists all units", shown "mm")
    assert.truthy(shown "GXL 1.6":find("no help on 'GXL 1.6'", 1, true))
  end)

  it("knows kinds of events, which reports name", function()
    assert.matches("^event `passed`: a wire slips over a part of itself.*help \"grip\"$", shown "passed")
    assert.matches("^event `slip`: .*; see help \"gripper\"$", shown "slip")
    assert.truthy(shown "energy":find("^Where the energy went"))
    assert.truthy(shown "slipp":find("no help on 'slipp'", 1, true))
  end)

  it("of other values shows them", function()
    assert.truthy(shown(print):find "^function")
    assert.equal("5", shown(5))
    assert.truthy(shown(sw.cable "GXL 1.5"):find(":bend_limit(use, diameter)", 1, true))
  end)
end)
