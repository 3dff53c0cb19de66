-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs of an evaluation that are ok but have events which evaluate did not look at: the evaluation keeps the
-- first event, in its row, the table, the files, and beside the best.
local sw = require "softworld"
local unread = require "softworld.unread"

local tmp = os.tmpname()
local page_path = tmp .. ".html"

-- A wire held at both ends is stretched by up to 2 mm in 0.2 m, far above its breaking load from 0.4 mm on.
local function stretched(by, looks)
  local scene = sw.scene{}
  local wire = scene:wire{ cable = "GXL 1.5", segments = 20, from = { 0, 0, 0.05 }, to = { 0.2, 0, 0.05 } }
  local hold = scene:clamp(wire, { s = 0 })
  scene:clamp(wire, { s = wire.length })
  hold:follow{ points = { { 0, 0, 0 }, { -by, 0, 0 } }, relative = true, duration = 0.05 }
  local run = scene:run{ dt = 0.005, duration = 0.1, frames = false }
  local count = looks and #run.events or nil
  return { pull = hold:over().peak_force, count = count }
end

local function study_of(options)
  return sw.study{ name = "stretched", seed = 1, workers = options.workers, file = options.file,
    parameters = { by = { 0.0001, 0.002, unit = "m" } },
    evaluate = function(p) return stretched(p.by, options.looks) end }
end

local function read(path)
  local file = assert(io.open(path))
  local text = file:read "a"
  file:close()
  return text
end

teardown(function()
  os.remove(tmp)
  os.remove(page_path)
end)

describe("events of an evaluation's runs", function()
  it("stand in the row, the table, the files and beside the best, with any number of workers", function()
    local texts = {}
    for _, workers in ipairs{ 0, 2 } do
      local study = study_of{ workers = workers }
      local rows = study:sweep{ grid = 3 }
      assert.is_nil(rows[1].events)
      assert.truthy(rows[2].events:find("^breaking: wire 'wire1' is pulled by"))
      local table_text, text = tostring(rows), tostring(study)
      assert.truthy(table_text:find("number +by +pull +events\n"))
      assert.truthy(text:find("2 evaluations ok, but with events (first 1.2): breaking: ", 1, true), text)
      local csv = read(study:csv(tmp))
      assert.truthy(csv:find("pass,failed,events\n", 1, true))
      assert.truthy(csv:find('"breaking: wire', 1, true))
      local page = read(study:report(page_path))
      assert.truthy(page:find("breaking: wire", 1, true))
      texts[#texts + 1] = table_text .. text .. csv
    end
    assert.equal(texts[1], texts[2])
  end)

  it("are told with a minimum and a front", function()
    local study = study_of{ workers = 0 }
    local found = study:minimise("pull", { evaluations = 6 })
    assert.is_nil(tostring(found):find("event", 1, true)) -- the gentlest pull breaks nothing
    local other = sw.study{ name = "harder", seed = 1, workers = 0,
      parameters = { by = { 0.001, 0.002, unit = "m" } },
      evaluate = function(p) return stretched(p.by) end }
    local worse = other:minimise("pull", { evaluations = 6 })
    assert.truthy(tostring(worse):find("its run had an event: breaking: wire", 1, true), tostring(worse))
    assert.truthy(tostring(other):find("    its run had an event: breaking", 1, true))
    assert.truthy(tostring(other:front{ "pull", "by" }):find("(its run had an event: breaking)", 1, true))
  end)

  it("are not kept if evaluate looks at them", function()
    local rows = study_of{ workers = 0, looks = true }:sweep{ grid = 3 }
    assert.is_true(rows[3].count > 0)
    for _, row in ipairs(rows) do assert.is_nil(row.events) end
  end)

  it("stay in the journal, and are found there again", function()
    os.remove(tmp)
    local before = tostring(study_of{ workers = 0, file = tmp }:sweep{ grid = 3 })
    local again = study_of{ workers = 0, file = tmp }
    assert.equal(before, tostring(again:sweep{ grid = 3 }))
    assert.equal(0, again.computed)
    assert.truthy(before:find("breaking", 1, true))
  end)

  it("give way to a result of the same name", function()
    local study = sw.study{ name = "named", seed = 1, workers = 0, parameters = { by = { 0.001, 0.002 } },
      evaluate = function(p) return { pull = stretched(p.by).pull, events = 7 } end }
    local rows = study:sweep{ grid = 2 }
    assert.equal(7, rows[1].events)
    assert.truthy(tostring(rows):find("number +by +events +pull\n"))
    assert.truthy(tostring(study:minimise("pull", { evaluations = 4 })))
    assert.truthy(tostring(study:front{ "pull", "events" }))
  end)

  it("of the script itself stay unread meanwhile", function()
    local function noted()
      local _, text = unread.finish()
      return text or ""
    end
    noted()
    stretched(0.002)
    study_of{ workers = 0 }:sweep{ grid = 3 }
    local text = noted()
    assert.truthy(text:find("has 1 event", 1, true), text)
    assert.is_nil(text:find("\n", 1, true), text)
  end)
end)
