-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pages of the player: of several runs, of a mesh, of a failed run, of a run without frames.
local runs = require "spec.page.runs"
local stage = require "spec.page.stage"
local sw = require "softworld"

local page, folder

setup(function() page, folder = stage.open() end)
teardown(stage.close)

local address, assert_calm, colour_count, fingerprint, time, text = stage.address, stage.assert_calm,
  stage.colour_count, stage.fingerprint, stage.time, stage.text

describe("a page of", function()
  it("several runs has all of them on one time axis", function()
    local a, b = runs.laying(), runs.laying { name = "farther", far = 1.4 }
    sw.report { a, b, path = folder .. "/both.html", title = "two ways" }
    page:go(address "both.html")
    assert.equal("two ways", text "h1")
    assert.equal(2, page:run "return player.view.actors.filter((a) => a.kind === 'wire' && a.there).length")
    page:run "player.state.set({ time: 1.2 })"
    local apart = page:run [[
      const [a, b] = player.view.actors.filter((w) => w.kind === "wire");
      return a.place(0).point.distanceTo(b.place(0).point);]]
    assert.is_true(apart > 0.01) -- the first hand has arrived, the second one is still on its way
    local labels = page:run "return player.charts.list[0].group.curves.map((c) => c.label)"
    assert.truthy(table.concat(labels, " "):find("1: hand.force", 1, true))
    assert.truthy(table.concat(labels, " "):find("2: hand.force", 1, true))
    page:run "document.querySelector('#tab-results').click()"
    assert.truthy(text "#panel-results":find("farther", 1, true))
    assert.near(b.time, page:run "return player.transport.span[1]", 1e-6)
    assert_calm()
  end)

  it("a mesh shows its surface", function()
    local run = runs.mesh()
    run:report(folder .. "/mesh.html")
    page:go(address "mesh.html")
    assert.is_true(colour_count() > 200)
    local frame = run:frames()[3]
    local points = page:run([[
      player.state.set({ time: arguments[0] });
      const w = player.view.actors.find((a) => a.kind === "wire");
      return [...w.surface.geometry.attributes.position.array.slice(0, 60)];]], frame.t)
    for i, x in ipairs(points) do assert.near(frame.surfaces[1].points[i], x, 0.5e-3 * 0.005 + 1e-7) end
    page:run "player.state.set({ time: player.transport.span[1], quantity: null })"
    local plain = fingerprint()
    page:run "player.state.set({ quantity: 'pressed' })"
    assert.equal("Surface contact [N]", text ".legend-name")
    assert.is_true(plain ~= fingerprint())
    assert_calm()
  end)

  it("a failed run gives the reason, shows the motion up to the failure, and has no numbers", function()
    local run = runs.failed()
    run:report(folder .. "/torn.html")
    page:go(address "torn.html")
    assert.equal("FAILED", text "#status")
    assert.truthy(text "#banner":find(run.reason, 1, true))
    assert.truthy(text "#panel-results":find(run.reason, 1, true))
    assert.truthy(page:run "return getComputedStyle(document.querySelector('.watermark')).display !== 'none'")
    assert.is_true(page:run "return player.data.runs[0].film.times.length" > 2)
    assert.is_true(colour_count() > 50)
    local one = page:run [[
      const r = player.data.runs[0], numbers = document.querySelectorAll("td.number").length;
      const values = [...r.film.tracks.values()].filter((t) => t.kind === "value" && t.channel !== 8);
      return [r.series === null, r.summary === undefined, numbers, values.length];]]
    assert.same({ true, true, 0, 0 }, one)
    page:run "player.state.set({ probe: { id: '0 wire 0', s: 0.2 } })"
    assert.truthy(text ".card":find("no numbers", 1, true))
    assert.is_nil(text ".card":find("Tension", 1, true))
    page:run "document.querySelector('#tab-charts').click()"
    assert.truthy(text "#panel-charts":find("no series", 1, true))
    assert_calm()
  end)

  it("a run without frames has only charts, and says so", function()
    local run = runs.laying { frames = false }
    run:report(folder .. "/plain.html")
    page:go(address "plain.html")
    assert.truthy(text "#stage":find("No frames were stored", 1, true))
    assert.is_true(page:run [[
      return player.charts.list.length > 0 && player.charts.list.every((c) => c.graph);]])
    page:run "document.querySelector('.mark').click()"
    assert.near(run.events[1].time, time(), 1e-9)
    page:run "document.activeElement.blur()"
    page:keys("Home", "t", "c", "f", "ArrowRight")
    assert_calm()
  end)

  it("names with quotes, tags and the end of a script element is harmless", function()
    local nasty = [["</script><script>window.hit=1</script>]]
      .. [[<img src=x onerror=window.hit=1>'\ <!-- &amp; @data@ %1]]
    local name = nasty:sub(1, 60)
    local run = runs.laying { name = name, wall = name, wire = nasty:sub(10, 60), note = nasty }
    sw.report { run, path = folder .. "/nasty.html", title = nasty }
    page:go(address "nasty.html")
    assert.equal(nasty, page:run "return document.querySelector('h1').textContent")
    assert.equal(nasty, page:run "return document.title")
    page:run "document.querySelector('#tab-events').click()"
    assert.truthy(page:run("return document.querySelector('#panel-events').textContent"):find(nasty, 1, true))
    page:run "document.querySelector('#tab-results').click()"
    assert.is_nil(page:run "return window.hit")
    assert.equal(0, page:run "return document.querySelectorAll('img').length")
    assert_calm()
  end)
end)
