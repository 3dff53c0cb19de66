-- SPDX-License-Identifier: GPL-3.0-or-later
-- The page of a check in a real browser: the numbers of the terminal, links to time and place, pictures,
-- limits in the charts, use by keys, odd names, and no numbers for a failed run.
local browser = require "spec.page.browser"
local files = require "spec.output.files"
local number = require "softworld.output.number"
local runs = require "spec.page.runs"
local sw = require "softworld"

local folder, page

setup(function()
  folder = files.folder()
  page = browser.open(1280, 720)
end)

teardown(function()
  if page then page:close() end
  files.remove(folder)
end)

local function open(name) page:go("file://" .. folder .. "/" .. name) end

local function assert_calm()
  for _, line in ipairs(page:console()) do
    assert.is_true(line.level ~= "SEVERE" and line.level ~= "WARNING", line.level .. ": " .. line.message)
  end
end

local function fails(words, f, ...)
  local fine, why = pcall(f, ...)
  assert.is_false(fine)
  assert.truthy(why:find(words, 1, true), why)
end

-- A gripper lifts the end of a cable and lays it down.
local function laying(name, dt)
  local scene = sw.scene { name = name or "lay" }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  local cable = scene:wire { name = "cable", cable = "GXL 1.5", segments = 30, from = { 0, 0, 0.0015 },
    to = { 0.3, 0, 0.0015 } }
  local left = scene:gripper { name = "left", pads = { width = 0.02 } }
  scene:process(function(p)
    left:grasp(cable, { s = 0.02 })
    p:step("lift", function() left:move { by = { 0.05, 0, 0.08 }, duration = 0.3 } end)
    p:step("lay", function() left:move { by = { 0, 0, -0.08 }, duration = 0.3 } end)
  end)
  return scene:run { dt = dt or 0.005, frame = 0.02 }, scene, cable
end

-- The shown cells of the rows, in the order of the page: number from 1, verdict, value, limit, margin, link.
local cells = [[
  return [...document.querySelectorAll("table.rows tbody")].map((b) => {
    const r = b.rows[0], text = (k) => r.children[k].firstChild ? r.children[k].firstChild.textContent : "";
    return [b.id.slice(4), text(0), text(2), text(3), text(4)];
  });]]

describe("the page of a check", function()
  local run, check, cable

  setup(function()
    local scene
    run, scene, cable = laying()
    assert.equal("lay", scene.name)
    check = run:check { use = "movement", limits = { peak_moment = 0.004, max_sidewall = false,
      peak_force = { max = 0.2, source = "sheet" }, cycle_time = 0.5 } }
    assert.equal(folder .. "/check.html", check:report(folder .. "/check.html"))
    open "check.html"
  end)

  it("has the terminal's numbers, backed by exact ones, with the worst first", function()
    local shown, order = page:run(cells), { FAIL = 1, OPEN = 2, PASS = 3 }
    assert.equal(#check.rows, #shown)
    local before = 0
    for _, line in ipairs(shown) do
      local row = check.rows[tonumber(line[1])]
      local function text(key)
        local given = row[key] and number.text(row[key], row.unit ~= "-" and row.unit or nil) or "–"
        return (given:gsub(" u(%a)", " µ%1"))
      end
      assert.equal(row.verdict, line[2])
      assert.equal(text "value", line[3])
      assert.equal(row.limit and (row.side == "max" and "≤ " or "≥ ") .. text "limit" or "–", line[4])
      assert.equal(text "margin", line[5])
      assert.is_true(order[row.verdict] >= before)
      before = order[row.verdict]
    end
    for i, row in ipairs(check.rows) do
      assert.equal(row.value, page:run(("return player.data.check.rows[%d].value"):format(i - 1)))
    end
    assert.equal("FAIL", page:run "return document.querySelector('#status').textContent")
    assert_calm()
  end)

  it("starts at the worst row that has a time, and fits its window", function()
    assert.equal(check:row("left.peak_moment").time, page:run "return player.state.get('time')")
    assert.equal(1, page:run "return document.querySelectorAll('tbody[aria-current]').length")
    assert.is_true(page:run [[
      const p = document.querySelector("#panel-check");
      return p.scrollWidth <= p.clientWidth && document.documentElement.scrollWidth <= innerWidth;]])
  end)

  it("goes to a row's time and place by its link, also by keys and from an address", function()
    local k
    for i, row in ipairs(check.rows) do
      if row.name == "cable.min_bend_radius" then k = i end
    end
    local row = check.rows[k]
    local where = "return [player.state.get('time'), player.state.get('probe')?.s, location.hash]"
    local function there()
      local found = page:run(where)
      assert.near(row.time, found[1], 1e-12)
      assert.near(row.s, found[2], 1e-12)
      assert.equal("row=" .. k, found[3]:match "row=%d+")
    end
    page:run([[
      player.state.set({ time: 0, probe: null });
      document.querySelector(arguments[0]).focus();]], ("#row-%d a"):format(k))
    page:keys "Enter"
    there()
    page:go("about:blank", true)
    open("check.html#row=" .. k)
    there()
    page:run "location.hash = '#t=0.1'"
    page:wait "return player.state.get('time') === 0.1"
  end)

  it("has pictures of steps and places, which link to their times", function()
    local list = page:run [[
      return player.check.pictures.map((p) => {
        const c = p.button.querySelector("canvas");
        const data = new Uint32Array(c.getContext("2d").getImageData(0, 0, c.width, c.height).data.buffer);
        return [p.t, p.button.innerText, new Set(data).size];
      });]]
    local words = ""
    for i, p in ipairs(list) do
      assert.is_true(i == 1 or p[1] > list[i - 1][1], "in the order of time")
      assert.is_true(p[3] > 50, "drawn")
      words = words .. p[2]
    end
    for _, part in ipairs { "left.peak_moment", "cable.max_tension", "end of lift" } do
      assert.truthy(words:find(part, 1, true), words)
    end
    page:run "player.check.pictures[0].button.click()"
    assert.near(list[1][1], page:run "return player.state.get('time')", 1e-12)
  end)

  -- The limit applies to the inside of a bend; the chart of the centreline shows it larger by the wire's
  -- radius.
  it("draws limits in the charts, distant ones only on request", function()
    local list = page:run [[
      return player.charts.list.flatMap((c) => c.group.curves.filter((k) => k.limit)
        .map((k) => [k.name, k.values[0], k.values[k.values.length - 1], k.on]));]]
    local by = {}
    for _, c in ipairs(list) do
      assert.equal(c[2], c[3])
      by[c[1]] = c
    end
    assert.same({ 0.004, true }, { by["limit of left.peak_moment"][2], by["limit of left.peak_moment"][4] })
    assert.near(0.015 + cable.radius, by["limit of cable.min_bend_radius (centre line)"][2], 1e-12)
    assert.is_false(by["limit of cable.max_tension"][4])
  end)

  it("is complete in dark and light, and redraws its pictures", function()
    for _, theme in ipairs { "dark", "light" } do
      local colours = page:run([[
        player.state.set({ theme: arguments[0], tab: "check" });
        const style = getComputedStyle(document.querySelector(".rows tbody th"));
        const c = player.check.pictures[0].button.querySelector("canvas").getContext("2d");
        return [style.color, Math.max(...c.getImageData(4, 4, 1, 1).data.slice(0, 3))];]], theme)
      local ink = tonumber(colours[1]:match "%d+")
      assert.equal(theme == "dark", ink > 128)
      assert.equal(theme == "dark", colours[2] < 128)
    end
  end)

  it("shows nothing of a later run", function()
    local first, scene = laying("first")
    local early = first:check {}
    scene:run { duration = 0.1, dt = 0.01 }
    early:report(folder .. "/early.html")
    open "early.html"
    local last = page:run "return [player.data.runs[0].series.time.at(-1), player.transport.span[1]]"
    for _, time in ipairs(last) do assert.near(first.time, time, 1e-12) end
  end)

  it("shows the result of study:change", function()
    local study = sw.study { name = "s", workers = 0, parameters = { a = { 0, 1, start = 1 } },
      evaluate = function(p)
        return run:check { limits = { cycle_time = { max = 0.4 + p.a, sure = true } } }
      end }
    check:report(folder .. "/change.html", { change = study:change "cycle_time", title = "with change" })
    open "change.html"
    assert.truthy(page:run("return document.querySelector('.what').innerText"):find("cycle_time", 1, true))
    assert.equal("with change", page:run "return document.title")
    fails("change must be what study:change gave, got 5", check.report, check, "x.html", { change = 5 })
  end)

  it("is an error when it cannot be written", function()
    fails("check:report expects the name of an .html file, got nil", check.report, check)
    fails("does not end in .html", check.report, check, folder .. "/check.txt")
    fails("did you mean 'title'?", check.report, check, "x.html", { titel = "x" })
    local other, scene = laying()
    local gone = other:check {}
    scene:close()
    fails("scene 'lay' has been closed", gone.report, gone, folder .. "/gone.html")
    local again, back = laying()
    local restored, snapshot = again:check {}, back:snapshot()
    back:restore(snapshot)
    fails("were lost when a snapshot was restored", restored.report, restored, folder .. "/gone.html")
  end)
end)

describe("the page of a check that has no numbers", function()
  it("gives the reason and no numbers, for a failed run and for one cut short", function()
    local scene = sw.scene { name = "cut" }
    scene:wire { name = "w", cable = "GXL 1.5", from = { 0, 0, 1 }, to = { 0.2, 0, 1 }, segments = 8 }
    local cut = scene:run { duration = 1, dt = 0.01, max_steps = 10 }
    for name, run in pairs { torn = runs.failed(), cut = cut } do
      local check = run:check {}
      check:report(folder .. "/" .. name .. ".html")
      open(name .. ".html")
      assert.is_nil(page:run "return document.querySelector('table, .picture, .plot')")
      local text = page:run "return document.body.innerText"
      assert.truthy(text:find(check.reason, 1, true), text)
      assert.equal("FAIL", page:run "return document.querySelector('#status').textContent")
      assert.is_true(page:run "return player.data.runs.every((r) => !r.series && !r.summary)")
      assert_calm()
    end
  end)

  it("has rows without pictures where no frames were stored", function()
    local scene = sw.scene { name = "none" }
    scene:wire { name = "w", cable = "GXL 1.5", from = { 0, 0, 1 }, to = { 0.2, 0, 1 }, segments = 8 }
    scene:run({ duration = 0.1, dt = 0.01, frames = false }):check():report(folder .. "/none.html")
    open "none.html"
    assert.is_true(#page:run(cells) >= 4)
    page:run "document.querySelector('table.rows a').click()"
    assert_calm()
  end)
end)

describe("names of scenes, wires, rows, sources and steps", function()
  it("are shown as text, whatever they contain", function()
    local odd = 'a "b" </script><img src=x onerror="bad=1"> \u{202E}live <!-- \' &amp;'
    local scene = sw.scene { name = odd }
    local wire = scene:wire { name = odd, cable = "GXL 1.5", from = { 0, 0, 1 }, to = { 0.2, 0, 1 } }
    scene:clamp(wire, { s = 0 })
    scene:process(function(p) p:step(odd, function() p:wait(0.1) end) end)
    local check = scene:run({ dt = 0.01 }):check { limits = { max_strain = false }, checks = {
      { name = odd .. "2", unit = "m", max = 1, source = odd, of = function() return 2, 0.1, 0.05 end },
      { name = "raises", unit = "m", max = 1, of = function() error(odd) end } } }
    check:report(folder .. "/odd.html")
    open "odd.html"
    assert.is_nil(page:run "return window.bad || document.querySelector('img')")
    assert.equal(odd, page:run "return document.querySelector('h1').textContent")
    assert.truthy(page:run "return document.querySelector('.rows').textContent":find(odd .. "2", 1, true))
    -- characters that change the direction of text end with their element
    assert.equal(0, page:run [[
      const found = [...document.querySelectorAll("#panel-check *")].filter((e) => [...e.childNodes]
        .some((n) => n.nodeType === 3 && n.data.includes("\u202e")));
      return found.filter((e) => getComputedStyle(e).unicodeBidi !== "isolate").length;]])
    assert_calm()
  end)
end)
