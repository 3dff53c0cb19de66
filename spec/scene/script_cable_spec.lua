-- SPDX-License-Identifier: GPL-3.0-or-later
-- scene:script of wires of a script's own cables: the text defines them, so that it runs in a new process.
local sw = require "softworld"
local program = require "host.program"

local count = 0

local function fields()
  count = count + 1
  return { name = "of script_cable_spec " .. count, outer_diameter = 0.004, mass_per_length = 0.02, EA = 1e4,
    EI = { value = 1.1e-3, low = 1e-3, high = 2e-3 }, GJ = 1e-3, friction = 0.3, flag = "guessed",
    source = "a \"test\"", spread = 0.1, temperature = { low = 0, high = 60 },
    bend = { rule = "IEC 62440", use = "fixed" } }
end

local function calibrated()
  count = count + 1
  return sw.calibration { name = "calibrated " .. count, outer_diameter = 0.004, mass_per_length = 0.02,
    EI = 1e-3, pull = { length = 1, points = { { 10, 0.001 }, { 20, 0.002 }, { 30, 0.0031 } } } }
end

-- Returns the script of a scene with a wire of each cable.
local function script(...)
  local scene = sw.scene {}
  for k, cable in ipairs { ... } do
    scene:wire { cable = cable, from = { 0, k, 0 }, to = { 1, k, 0 } }
  end
  return scene:script(), scene
end

-- Runs a script in a new process; returns the EI and the cable of its first wire, as text.
local function elsewhere(text)
  local folder = program.folder()
  program.write(folder .. "/s.lua", text)
  local out, err, code = program.run { "-e", ("local s = dofile %q local w = s:wires()[1] "
    .. "print(w.beam.EI, w:cable()) assert(s:script() == io.open(%q):read 'a')"):format(folder .. "/s.lua",
    folder .. "/s.lua") }
  assert.same({ "", 0 }, { err, code })
  return out
end

describe("scene:script with a script's own cable", function()
  after_each(program.clean)

  it("defines a cable of sw.cable.define, given or named", function()
    local own = sw.cable.define(fields())
    for _, given in ipairs { own, own.name } do
      local text, scene = script(given, "GXL 1.5", given)
      assert.equal(1, select(2, text:gsub("sw%.cable%.read", "")))
      assert.truthy(text:find('cable = "GXL 1.5"', 1, true), text)
      local wire = scene:wires()[1]
      assert.equal(("%s\t%s\n"):format(wire.beam.EI, wire:cable()), elsewhere(text))
    end
  end)

  it("defines the cable of a calibration, before and after its define", function()
    local found = calibrated()
    local text = script(found.cable)
    assert.truthy(elsewhere(text):find(found.name .. ": calibrated", 1, true))
    local defined = found:define()
    assert.is_true(rawequal(defined, found.cable))
    assert.equal(text, script(found.cable))
    assert.equal(text, script(found.name))
  end)

  it("needs no change of the fields' table, and refuses a cable that was changed", function()
    local given = fields()
    local own = sw.cable.define(given)
    local text, scene = script(own)
    given.EI.value = 5
    assert.equal(text, scene:script())
    own.EI.value = 1.2e-3
    local fine, why = pcall(scene.script, scene)
    assert.is_false(fine)
    assert.truthy(why:find(("scene:wire.cable is the cable '%s', and it was changed after it was made, which "
      .. "is not written; make it with sw.cable.define"):format(own.name), 1, true), why)
  end)
end)
