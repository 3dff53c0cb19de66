-- SPDX-License-Identifier: GPL-3.0-or-later
-- The page of a study in a real browser: it shows the table, and a click selects a row.
local browser = require "spec.page.browser"
local program = require "host.program"
local sw = require "softworld"

local NAME = "grip </script><b>&\"" -- no part of this name may become markup of the page

local function study(changes)
  local args = { name = NAME, workers = 2, seed = 2,
    parameters = { force = { 0.5, 20, unit = "N", log = true }, speed = { 0.05, 0.5, unit = "m/s" },
      kind = { choices = { "rod", "tube" } } },
    evaluate = function(p)
      if p.force * p.random() > 14 then error("crushed </script>", 0) end
      return { time = 1 / p.speed, margin = 2 / p.force + p.speed }
    end,
    constraints = { margin = { max = 0.9 } } }
  for key, value in pairs(changes or {}) do args[key] = value end
  return sw.study(args)
end

describe("the page of a study", function()
  local page, folder, s, rows

  setup(function()
    folder = program.folder()
    page = browser.open(1280, 800)
    s = study()
    s:sweep { count = 200 }
    s:spread { count = 40 }
    rows = s:table()
    assert.equal(folder .. "/s.html", s:report(folder .. "/s.html"))
    page:go("file://" .. folder .. "/s.html")
  end)

  teardown(function()
    if page then page:close() end
    program.clean()
  end)

  local function text(selector)
    return page:run("return document.querySelector(arguments[0]).textContent", selector)
  end

  local function count(what)
    local n = 0
    for _, row in ipairs(rows) do
      if row[what] then n = n + 1 end
    end
    return n
  end

  it("gives the number of evaluations, and the console stays silent", function()
    assert.equal(NAME, text "h1")
    assert.equal("240 evaluations", text "#count")
    assert.equal(count "pass" .. " meet the constraints", text "#passed")
    assert.equal(count "failed" .. " failed", text "#failed")
    assert.is_true(count "failed" > 0)
    assert.equal(240, page:run "return document.querySelectorAll('tbody tr').length")
    assert.equal(0, #page:console())
  end)

  it("shows parameters and results of a clicked row, and how to compute it again", function()
    local row
    for _, one in ipairs(rows) do
      if one.pass == false then row = one end
    end
    page:run("document.querySelector(`tr[data-at='${arguments[0]}']`).click()", row.part .. "." .. row.number)
    assert.equal(("Evaluation %d.%d"):format(row.part, row.number), text "#detail h2")
    local words = text "#detail"
    for _, name in ipairs { "force", "speed", "time" } do
      local number = words:match(name .. " ?%[?[^%]%d]*%]?([%d.]+)")
      assert.is_true(math.abs(tonumber(number) / row[name] - 1) < 1e-4, name .. ": " .. words)
    end
    assert.truthy(words:find(row.kind, 1, true))
    assert.truthy(text("#detail dd.over"):find("(at most 0.9)", 1, true))
    -- the shown line is right: it gives the same numbers
    local number, part = text("#line"):match "study:again%((%d+), (%d+)%)"
    assert.is_true(s:again(tonumber(number) | 0, tonumber(part) | 0).margin == row.margin)
  end)

  it("selects a clicked point", function()
    -- a point of the first part, with no other one near it
    local found = page:run [[
      const p = document.getElementById("plot").getBoundingClientRect();
      const far = (a, b) => a === b || Math.hypot(a[1] - b[1], a[2] - b[2]) > 6;
      const one = placed.find((a) => a[0].part === 1 && a[0].number < 200 && placed.every((b) => far(a, b)));
      return [p.x + 1 + one[1], p.y + 1 + one[2], one[0].number];]]
    page:pointer({ found }, true)
    assert.equal(("Evaluation 1.%d"):format(found[3]), text "#detail h2")
    page:run "document.getElementById('plot').focus()"
    page:keys "ArrowRight"
    assert.equal(("Evaluation 1.%d"):format(found[3] + 1), text "#detail h2")
  end)

  it("shows why an evaluation has failed", function()
    local row
    for _, one in ipairs(rows) do row = row or one.failed and one end
    page:run("document.querySelector(`tr[data-at='${arguments[0]}']`).click()", row.part .. "." .. row.number)
    assert.equal("failed: crushed </script>", text "#detail .wrong")
  end)

  it("sorts, and hides rows that break constraints and other parts", function()
    page:run "document.querySelector('#only').click()"
    assert.equal(count "pass", page:run "return document.querySelectorAll('tbody tr').length")
    page:run "[...document.querySelectorAll('th button')].find((b) => /time/.test(b.textContent)).click()"
    local best = s:best "time"
    assert.equal(best.part .. "." .. best.number, text "tbody td")
    page:run "choose('part', 2); choose('only', false)"
    assert.equal(40, page:run "return document.querySelectorAll('tbody tr').length")
    assert.equal(0, #page:console())
  end)

  it("draws choices, colours and both themes, with points in its picture", function()
    local function colours()
      return page:run [[const c = document.getElementById("plot"), d = c.getContext("2d");
        return new Set(new Uint32Array(d.getImageData(0, 0, c.width, c.height).data.buffer)).size;]]
    end
    page:run "choose('part', 0); choose('x', 1)"
    assert.is_true(colours() > 20)
    page:run "choose('colour', 0); document.getElementById('theme').click()"
    assert.is_true(colours() > 100)
    page:run "document.querySelectorAll('#small button')[2].click()"
    assert.equal("2", page:run "return document.getElementById('x').value")
    for _, line in ipairs(page:console()) do -- the browser warns when pixels are read
      assert.is_true(line.level ~= "SEVERE", line.message)
    end
  end)

  it("plays the requested runs, computed again with the same bits", function()
    local lifted = study { name = "a lift", parameters = { EI = { 1e-3, 1e-2, unit = "N m2" } },
      evaluate = function(p)
        local scene = sw.scene {}
        local wire = scene:wire { EI = p.EI, EA = 1e3, mass_per_length = 0.02, radius = 0.002, segments = 8,
          from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
        scene:clamp(wire, { s = 0 })
        assert(scene:run { duration = 0.1, dt = 0.01 }.ok)
        return { margin = 0.1, droop = -wire:position(0.3)[3] }
      end }
    lifted:sweep { count = 6 }
    local best, path = lifted:best "droop", folder .. "/a lift.html"
    lifted:report(path, { play = { best, 2, best } })
    page:go("file://" .. path:gsub(" ", "%%20"))
    for _, number in ipairs { best.number, 2 } do
      page:run("document.querySelector(`tr[data-at='1.${arguments[0]}']`).click()", number)
      assert.equal(("a%%20lift-1.%d.html"):format(number),
        page:run "return document.getElementById('play').getAttribute('href')")
    end
    local other = best.number == 1 and 3 or 1
    page:run("document.querySelector(`tr[data-at='1.${arguments[0]}']`).click()", other)
    assert.is_true(page:run "return !document.getElementById('play') && !!document.getElementById('line')")
    page:run "document.querySelector(`tr[data-at='1.2']`).click()"
    page:run "document.getElementById('play').click()"
    for _ = 1, 100 do -- until the player's page is loaded
      local there = "return !!document.querySelector('canvas') && !document.getElementById('small')"
      if page:run(there) then break end
      program.shell "sleep 0.1"
    end
    assert.truthy(page:run("return location.href"):find("a%%20lift%-1%.2%.html$"))
    assert.equal(0, #page:console())
    local many = {}
    for k = 1, 201 do many[k] = 1 end
    for words, play in pairs { ["'all', got 3"] = 3, ["there is no evaluation 77"] = { 77 },
      ["play has 201 evaluations"] = many } do
      local fine, why = pcall(lifted.report, lifted, folder .. "/no.html", { play = play })
      assert.is_false(fine)
      assert.truthy(why:find(words, 1, true), why)
    end
    local fine, why = pcall(s.report, s, folder .. "/no.html", { play = { s:best "time" } })
    assert.is_false(fine)
    assert.truthy(why:find("has no run of a scene to be played", 1, true), why)
    assert.is_nil(io.open(folder .. "/no.html"))
    page:go("file://" .. folder .. "/s.html")
  end)

  it("shows 20000 rows of a larger table", function()
    local many = study { constraints = {}, evaluate = function(p) return { y = p.force } end }
    many:sweep { count = 30000, workers = 0 }
    many:report(folder .. "/many.html")
    page:go("file://" .. folder .. "/many.html")
    assert.equal("30000 evaluations", text "#count")
    assert.equal("Shown are 20000 of 30000 evaluations.", text "#note")
    assert.truthy(text("#more"):find("500 of 20000 are shown", 1, true))
    assert.is_true(page:run "return document.getElementById('passed').hidden")
  end)

  it("reports wrong arguments", function()
    assert.error_matches(function() study():report(folder .. "/x.html") end, "there is no evaluation to show")
    for _, path in ipairs { "x.pdf", 3, "" } do
      assert.error_matches(function() s:report(path) end, "the name of a file that ends in .html is wanted")
    end
    assert.error_matches(function() s:report "/nowhere/x.html" end, "cannot write /nowhere/x.html")
  end)
end)
