-- SPDX-License-Identifier: GPL-3.0-or-later
-- The player in a real browser: opened from disk, it shows and moves the scene, gives numbers, and is used
-- by keys and pointer.
local runs = require "spec.page.runs"
local stage = require "spec.page.stage"
local sw = require "softworld"

local page, folder

setup(function() page, folder = stage.open() end)
teardown(stage.close)

local address, assert_calm, colour_count, fingerprint, time, text = stage.address, stage.assert_calm,
  stage.colour_count, stage.fingerprint, stage.time, stage.text

-- Chooses an item from the export menu.
local function export(words)
  return ([[
    [...document.querySelectorAll("#menu [role=menuitem]")].find((b) => /%s/.test(b.textContent)).click();]])
    :format(words)
end

describe("the player", function()
  local run

  setup(function()
    run = runs.laying()
    assert.equal(folder .. "/laying.html", run:report(folder .. "/laying.html"))
    page:go(address "laying.html")
  end)

  before_each(function()
    page:run [[
      player.state.set({ time: 0, playing: false, tab: "charts", probe: null, selected: null, tool: null });]]
  end)

  it("draws the scene, with a silent console and without network", function()
    assert.is_true(colour_count() > 200)
    assert.equal("laying", text "h1")
    assert.equal("ok", text "#status")
    assert.equal(0, page:run [[
      const fetched = performance.getEntriesByType("resource");
      return fetched.filter((e) => !/^(data|blob):/.test(e.name)).length;]])
    local html = io.open(folder .. "/laying.html"):read "a"
    assert.is_nil(html:find('src="http', 1, true) or html:find('href="http', 1, true))
    assert.truthy(html:find("three.js authors", 1, true) and html:find("Dan Vanderkam", 1, true))
    assert.truthy(html:find("The above copyright notice", 1, true))
    assert_calm()
  end)

  it("has the wire in the run's positions, at every frame", function()
    local frames = run:frames()
    for _, f in ipairs { 1, #frames // 2, #frames } do
      local x = page:run([[
        player.state.set({ time: arguments[0] });
        const w = player.view.actors.find((a) => a.kind === "wire");
        return [...w.nodes.slice(0, 3 * w.count)];]], frames[f].t)
      assert.equal(#frames[f].wires[1], #x)
      -- half a thousandth of the radius, and 32-bit rounding
      for i, given in ipairs(frames[f].wires[1]) do assert.near(given, x[i], 0.5e-3 * 0.003 + 1e-7) end
    end
  end)

  it("moves the wire and the charts' cursor with its slider", function()
    local before = fingerprint()
    local where = page:run [[
      const b = document.querySelector("#time").getBoundingClientRect();
      return [b.left, b.top, b.width, b.height];]]
    local y = where[2] + where[4] / 2
    page:pointer({ { where[1] + 0.3 * where[3], y }, { where[1] + 0.5 * where[3], y } }, true)
    local t, last = time(), run.time
    assert.near(0.5 * last, t, 0.02 * last)
    assert.is_true(fingerprint() ~= before)
    local shown = page:run [[
      const c = player.charts.list[0], m = /translateX\(([-\d.]+)px\)/.exec(c.cursor.style.transform);
      const due = c.graph.toDomXCoord(player.state.get("time"));
      return [Number(m[1]), due, c.cursor.getBoundingClientRect().height];]]
    assert.near(shown[2], shown[1], 0.01)
    assert.is_true(shown[3] > 50)
  end)

  it("takes its time from a click on a chart, and the numbers follow", function()
    local spot = page:run [[
      const c = player.charts.list[0], a = c.graph.getArea(), b = c.plot.getBoundingClientRect();
      return [b.left + a.x + 0.25 * a.w, b.top + a.y + a.h / 2, c.graph.toDataXCoord(a.x + 0.25 * a.w)];]]
    page:pointer({ { spot[1], spot[2] } }, true)
    assert.near(spot[3], time(), 0.01 * run.time)
    local series, column = run:series(), nil
    for _, c in ipairs(series.columns) do if c.name == "hand.force" then column = c end end
    local nearest = 1
    for i, t in ipairs(series.time) do
      if math.abs(t - time()) < math.abs(series.time[nearest] - time()) then nearest = i end
    end
    local told = page:run [[
      const c = player.charts.list[0].group.curves.find((k) => k.name === "hand.force");
      const now = player.state.get("time"), { time } = c.run.series;
      let i = 0;
      time.forEach((t, k) => { if (Math.abs(t - now) < Math.abs(time[i] - now)) i = k; });
      return c.values[i];]]
    assert.near(column.values[nearest], told, 1e-6 * math.abs(column.values[nearest]))
  end)

  it("zooms all its charts together", function()
    local box = page:run [[
      const c = player.charts.list[0], a = c.graph.getArea(), b = c.plot.getBoundingClientRect();
      return [b.left + a.x, b.top + a.y + a.h / 2, a.w];]]
    local function at(share) return { box[1] + share * box[3], box[2] } end
    page:pointer({ at(0.2), at(0.5), at(0.6) }, true)
    local windows = page:run "return player.charts.list.map((c) => c.graph.xAxisRange())"
    assert.is_true(#windows > 1)
    for _, w in ipairs(windows) do
      assert.near(0.2 * run.time, w[1], 0.05 * run.time)
      assert.near(0.6 * run.time, w[2], 0.05 * run.time)
    end
    page:run "player.charts.list[0].graph.resetZoom()"
  end)

  it("is played, stepped and rotated by keys", function()
    page:run "document.activeElement.blur()"
    local frames = run:frames()
    page:keys "ArrowRight"
    assert.near(frames[2].t, time(), 1e-9)
    page:keys("ArrowRight", "ArrowRight", "ArrowLeft")
    assert.near(frames[3].t, time(), 1e-9)
    page:keys "End"
    assert.near(run.time, time(), 1e-6)
    page:keys "Home"
    assert.near(0, time(), 1e-9)
    page:keys " "
    page:wait "return player.state.get('time') > 0.05"
    page:keys " "
    assert.is_false(page:run "return player.state.get('playing')")
    local before = fingerprint()
    page:keys "d"
    assert.is_true(fingerprint() ~= before)
    page:keys("4", "1", "v", "m", "x", "c")
    assert.same({ true, "measure", 0, "tension" },
      page:run "const v = player.state.values; return [v.arrows, v.tool, v.cut, v.quantity]")
    page:keys("v", "m", "x")
    page:run "player.state.set({ quantity: 'curvature' })"
    assert_calm()
  end)

  it("plays to the end and stops, or starts again", function()
    page:run "player.state.set({ time: player.transport.span[1] - 0.05, playing: true })"
    page:wait "return !player.state.get('playing')"
    assert.near(run.time, time(), 1e-6)
    page:run "player.state.set({ loop: true, time: player.transport.span[1] - 0.05, playing: true })"
    page:wait "return player.state.get('time') < 0.5"
    page:run "player.state.set({ playing: false, loop: false })"
  end)

  it("is walked through by the tab key, with a visible focus and a name for each control", function()
    page:run "document.activeElement.blur()"
    local seen = {}
    for _ = 1, 14 do
      page:keys "Tab"
      local name, outline = table.unpack(page:run [[
        const e = document.activeElement, s = getComputedStyle(e);
        return [e.id || e.getAttribute("aria-label") || e.textContent || e.tagName, s.outlineStyle];]])
      seen[#seen + 1] = name
      assert.equal("solid", outline, name)
    end
    assert.is_true(#seen == 14 and seen[1] ~= seen[2])
    local nameless = page:run [[
      const named = (e) => e.getAttribute("aria-label") || e.textContent.trim() || e.title
        || (e.labels && e.labels.length) || getComputedStyle(e).display === "none";
      return [...document.querySelectorAll("button, input, select, [role=tab], [role=img]")]
        .filter((e) => !named(e)).map((e) => e.outerHTML);]]
    assert.same({}, nameless)
  end)

  it("marks events on the slider, and goes to them", function()
    assert.equal(1, page:run "return document.querySelectorAll('.mark').length")
    local words = page:run "return document.querySelector('.mark').title"
    assert.truthy(words:find("the hand is up", 1, true))
    page:run "document.querySelector('.mark').click()"
    assert.near(run.events[1].time, time(), 1e-9)
    page:run "document.querySelector('#tab-events').click()"
    assert.truthy(text "#panel-events":find("the hand is up", 1, true))
  end)

  it("shows results, script and version", function()
    page:run "document.querySelector('#tab-results').click()"
    local shown = text "#panel-results"
    for _, row in ipairs(run:document().summary) do
      assert.truthy(shown:find(row.label, 1, true), row.label)
    end
    page:run "document.querySelector('#tab-script').click()"
    assert.truthy(text "#panel-script":find("SoftWorld " .. sw.version, 1, true))
  end)

  it("reads the values of a wire at a clicked point", function()
    local spot = page:run [[
      player.state.set({ time: 1.0 });
      player.view.stage.look("front");
      const w = player.view.actors.find((a) => a.kind === "wire"), p = w.place(0.15).point;
      player.view.stage.draw();
      const at = player.view.stage.onScreen(p), b = player.view.stage.canvas.getBoundingClientRect();
      return [at[0] + b.left, at[1] + b.top];]]
    page:pointer({ { spot[1] + 0.5, spot[2] + 0.5 } }, true)
    local probe = page:run "return player.state.get('probe')"
    assert.truthy(probe)
    assert.near(0.15, probe.s, 0.02)
    local card = text ".card"
    assert.truthy(card:find("Tension", 1, true) and card:find("Bend radius", 1, true), card)
    local told = page:run("return player.view.find(arguments[0].id).value(0, arguments[0].s)", probe)
    local frames, best = run:frames(), nil
    for _, f in ipairs(frames) do
      if not best or math.abs(f.t - 1.0) < math.abs(best.t - 1.0) then best = f end
    end
    local low, high = math.huge, -math.huge
    for _, x in ipairs(best.values[1].tension) do low, high = math.min(low, x), math.max(high, x) end
    assert.is_true(told > low - 0.01 * (high - low) and told < high + 0.01 * (high - low))
  end)

  it("measures between two points on moving objects", function()
    local length = page:run [[
      const w = player.view.actors.find((a) => a.kind === "wire");
      player.state.set({ time: 0, tool: "measure" });
      player.view.measured = [{ actor: w, s: 0.1 }, { actor: w, s: 0.4 }];
      player.view.update();
      return player.view.label.textContent;]]
    assert.equal("300.0 mm", length) -- the wire lies straight
    page:run "player.state.set({ time: 1.2 })"
    assert.is_true(page:run "return parseFloat(player.view.label.textContent)" < 300)
  end)

  it("hides objects, cuts, and colours by other quantities", function()
    local before = fingerprint()
    page:run "document.querySelector('input[aria-label=\"Show wall\"]').click()"
    local without = fingerprint()
    assert.is_true(before ~= without)
    page:run "document.querySelector('input[aria-label=\"Show wall\"]').click()"
    assert.equal(before, fingerprint())
    page:run "player.state.set({ cut: 0, cutAt: 0.6 })"
    assert.is_true(before ~= fingerprint())
    page:run "player.state.set({ cut: null })"
    page:run "player.state.set({ time: 1, quantity: 'tension' })"
    local first = text ".legend-name"
    assert.truthy(first:find("Tension", 1, true))
    local tension = fingerprint()
    page:run "player.state.set({ quantity: 'stress' })"
    assert.is_true(tension ~= fingerprint())
    page:run "player.state.set({ quantity: 'curvature' })"
  end)

  it("exports pictures, tables and links", function()
    local png = page:call([[
      const old = URL.createObjectURL;
      URL.createObjectURL = (blob) => {
        URL.createObjectURL = old;
        blob.arrayBuffer().then((b) => done([blob.type, new Uint8Array(b).slice(1, 4).join(), b.byteLength]));
        return old.call(URL, blob);
      };]] .. export "PNG")
    assert.equal("image/png", png[1])
    assert.equal("80,78,71", png[2])
    assert.is_true(png[3] > 5000)
    local csv = page:call([[
      const old = URL.createObjectURL;
      URL.createObjectURL = (blob) => {
        URL.createObjectURL = old;
        blob.text().then(done);
        return old.call(URL, blob);
      };]] .. export "CSV")
    local lines = select(2, csv:gsub("\n", ""))
    assert.is_true(lines > 100)
    assert.truthy(csv:match "^t %[s%],hand%.force %[N%]")
    local named = page:call([[
      player.data.runs[0].series.columns[0].name = "=1+2,\n";
      const old = URL.createObjectURL;
      URL.createObjectURL = (blob) => {
        URL.createObjectURL = old;
        blob.text().then(done);
        return old.call(URL, blob);
      };
    ]] .. export "CSV")
    assert.truthy(named:match '^t %[s%],"\'=1%+2,  %[N%]"', named:sub(1, 60)) -- no formula, no second row
    page:go(address "laying.html" .. "#t=1.25&camera=1,-2,1.5,0.1,0,0.05")
    page:run "document.title" -- the same page: only its hash has changed
    page:wait "return Math.abs(player.state.get('time') - 1.25) < 1e-9"
    local pose = page:run "return player.view.stage.pose()"
    for i, x in ipairs { 1, -2, 1.5, 0.1, 0, 0.05 } do assert.near(x, pose[i], 1e-6) end
  end)

  it("records a film", function()
    local size = page:call([[
      const old = URL.createObjectURL;
      URL.createObjectURL = (blob) => {
        if (blob.type === "video/webm") { URL.createObjectURL = old; done(blob.size); }
        return old.call(URL, blob);
      };
      player.state.set({ speed: 2 });]] .. export "WebM") -- slow enough for pictures on a busy machine
    assert.is_true(size > 10000)
    assert_calm()
  end)

  it("has a dark and a light theme", function()
    page:run "player.state.set({ theme: 'dark' })"
    local dark = page:run "return getComputedStyle(document.body).backgroundColor"
    page:run "player.state.set({ theme: 'light' })"
    assert.is_true(dark ~= page:run "return getComputedStyle(document.body).backgroundColor")
  end)
end)
