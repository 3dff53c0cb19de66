-- SPDX-License-Identifier: GPL-3.0-or-later
-- A script saved in Latin-1: its names are not UTF-8, but the files it writes are.
local sw = require "softworld"
local files = require "spec.output.files"

describe("names in Latin-1", function()
  local scene = sw.scene{ name = "K\228fig" }
  local wire = scene:wire{ name = "gr\252n <b>", cable = "GXL 1.5", from = { 0, 0, 0.1 },
    to = { 0.3, 0, 0.1 }, segments = 10 }
  scene:clamp(wire, { s = 0, name = "\214se" })
  local run = scene:run{ duration = 0.05 }
  local folder = files.folder()
  local base = folder .. "/out"
  teardown(function() files.remove(folder) end)

  local function text_of(name)
    local file = assert(io.open(base .. name, "rb"))
    local text = file:read "a"
    file:close()
    return text
  end

  local function holds(name, wanted)
    local text = text_of(name)
    assert.truthy(utf8.len(text))
    assert.truthy(text:find(wanted, 1, true), wanted)
    return text
  end

  it("are UTF-8 in a chart", function()
    run:chart{ path = base .. ".svg", title = "M\252nchen\1" }
    local text = holds(".svg", "M\u{fc}nchen")
    assert.truthy(text:find("gr\u{fc}n", 1, true))
    assert.falsy(text:find "[\1-\8]")
  end)

  it("are UTF-8 in a run's page", function()
    run:report(base .. ".html")
    holds(".html", "<title>K\u{e4}fig")
  end)

  it("are UTF-8 in files for ParaView", function()
    run:vtk(base .. ".pvd")
    local text = holds(".vtk/wires_00000.vtp", "gr\u{fc}n &lt;b&gt;.tension")
    assert.falsy(text:find "[\1-\8]")
  end)

  it("are UTF-8 in a check for CI", function()
    run:check{ limits = { max_tension = 10 } }:junit(base .. ".xml")
    holds(".xml", "gr\u{fc}n &lt;b&gt;")
  end)

  it("are UTF-8 in JSON", function()
    run:save(base .. ".json")
    holds(".json", "gr\u{fc}n <b>")
  end)
end)
