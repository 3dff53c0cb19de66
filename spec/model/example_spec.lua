-- SPDX-License-Identifier: GPL-3.0-or-later
-- The example of chosen models, run as a user would run it.
local program = dofile "spec/host/program.lua"

describe("example 25", function()
  teardown(program.clean)

  it("takes three models for three tolerances", function()
    local out, err, code = program.run { "examples/25_auto.lua" }
    assert.same({ 0, "" }, { code, err })
    local words = {}
    for share, motion, twist in out:gmatch "asked for ([%d.]+) %%: (%a+), (%a+)" do
      words[#words + 1] = ("%s %s %s"):format(share, motion, twist)
    end
    assert.same({ "30 poses held", "5 dynamic held", "0.5 dynamic rolling" }, words)
    assert.is_nil(out:find("NOT met", 1, true))
    assert.truthy(out:find("twist rolling: with ", 1, true))
  end)
end)
