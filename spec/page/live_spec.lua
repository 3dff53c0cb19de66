-- SPDX-License-Identifier: GPL-3.0-or-later
-- The live view in a real browser: a run in its own process is watched, paused, pulled by hand and changed.
-- The saved script gives the same numbers.
package.path = "./?.lua;" .. package.path
local browser = require "spec.page.browser"
local program = dofile "spec/host/program.lua"
local socket = require "socket"

local folder, page, run

local SCENE = [[
local sw = require "softworld"
local scene = sw.scene { name = "by hand" }
local floor = scene:obstacle { name = "floor", shape = "plane", friction = 0.3 }
scene:obstacle { name = "wall", shape = "box", size = { 0.02, 0.3, 0.08 }, at = { 0.2, 0, 0.04 },
  friction = 0.3 }
local wire = scene:wire { name = "wire", E = 5e7, density = 1500, radius = 0.004, segments = 30,
  from = { 0.5, 0, 0.12 }, to = { -0.2, 0, 0.12 } }
scene:clamp(wire, { s = 0, name = "fixed" })
]]
local TELL = [[
for _, x in ipairs((scene:find("wire"):positions())) do io.write(("%a "):format(x)) end
print()
]]

-- Starts a run, paused at its beginning; finish() reads its output.
local function begin(script)
  local self = { out = folder .. "/out" }
  program.write(folder .. "/run.lua", script)
  local path = program.path:find "^/" and program.path or require "lfs".currentdir() .. "/" .. program.path
  os.execute(("cd '%s' && '%s' run.lua >out 2>err & echo $! >'%s/pid'"):format(folder, path, folder))
  for _ = 1, 200 do
    local file = io.open(folder .. "/address")
    self.address = file and file:read "a"
    if file then file:close() end
    if self.address and self.address:find "/$" then break end
    socket.sleep(0.05)
  end
  assert(self.address, "the run does not begin")
  return self
end

local function finish(self)
  for _ = 1, 400 do
    local file = io.open(self.out)
    local text = file:read "a"
    file:close()
    if text:find "\n" then return text end
    socket.sleep(0.05)
  end
  error "the run does not end"
end

local function order(name, more)
  page:run("player.link.order(arguments[0], arguments[1] || {})", name, more)
end

-- Frames come at most 30 times a second; a state is reported within a tenth of a second.
local function time() return page:run "return player.state.get('time')" end
local function place(s)
  return page:run([=[
    const p = player.view.actors.find((a) => a.kind === "wire").place(arguments[0]).point;
    return [p.x, p.y, p.z];]=], s)
end
local function on_screen(s)
  return page:run([=[
    const p = player.view.actors.find((a) => a.kind === "wire").place(arguments[0]).point;
    const b = player.view.stage.canvas.getBoundingClientRect(), at = player.view.stage.onScreen(p);
    return [b.left + at[0], b.top + at[1]];]=], s)
end
local function text(selector)
  return page:run("return document.querySelector(arguments[0]).innerText", selector)
end
local function value(id, given)
  page:run([[
    const f = document.getElementById(arguments[0]);
    f.value = arguments[1];
    f.dispatchEvent(new Event("change"));]], id, given)
end

setup(function()
  folder = program.folder()
  page = browser.open(1280, 720)
  run = begin(SCENE .. [[
local view = scene:view { open = false, paused = true }
local file = io.open("address", "w")
file:write(view.address)
file:close()
local run = scene:run { duration = 10, dt = 0.004 } -- longer than it is looked at on a slow machine
assert(run.ok, run.reason)
]] .. TELL)
  page:go(run.address)
end)

teardown(function()
  local file = io.open(folder .. "/pid")
  if file then
    os.execute("kill " .. file:read "n" .. " 2>/dev/null")
    file:close()
  end
  if page then page:close() end
  os.execute("rm -rf " .. program.quote(folder))
end)

describe("the live view", function()
  it("draws the scene of a paused run, with a silent console", function()
    local colours = page:run [=[
      const view = player.view, from = view.stage.canvas, to = document.createElement("canvas");
      to.width = from.width; to.height = from.height;
      view.stage.draw();
      const c = to.getContext("2d");
      c.drawImage(from, 0, 0);
      return new Set(new Uint32Array(c.getImageData(0, 0, to.width, to.height).data.buffer)).size;]=]
    assert.is_true(colours > 200)
    assert.equal("by hand", text "h1")
    assert.equal("held", text "#status")
    assert.equal(0, time())
    for _, line in ipairs(page:console()) do
      assert.is_true(line.level ~= "SEVERE" and line.level ~= "WARNING", line.level .. ": " .. line.message)
    end
  end)

  -- dt = 0.004 s: each step is one dt, as long as nothing is touched.
  it("takes exactly one step on request", function()
    page:keys "ArrowRight"
    page:wait "return player.state.get('time') > 0"
    socket.sleep(0.3)
    assert.near(0.004, time(), 1e-9)
    page:keys "ArrowRight"
    page:wait "return player.state.get('time') > 0.005"
    assert.near(0.008, time(), 1e-9)
  end)

  it("continues slowly, and pauses again", function()
    order("speed", { value = 0.05 })
    page:keys " "
    page:wait "return player.state.get('time') > 0.02"
    assert.equal("running", text "#status")
    local begun, from = socket.gettime(), time()
    socket.sleep(1)
    -- 0.05 times as fast as the clock, within one frame
    assert.is_true(time() - from <= 0.05 * (socket.gettime() - begun) + 0.02)
    page:keys " "
    page:wait "return player.state.get('run').holds"
    local held = time()
    socket.sleep(0.4)
    assert.near(held, time(), 0.005)
    assert.equal("held", text "#status")
  end)

  it("moves a dragged point of the wire to the pointer", function()
    local s, before = 0.65, place(0.65)
    local at = on_screen(s)
    local way = { at }
    for _, up in ipairs { 20, 60, 110 } do way[#way + 1] = { at[1], at[2] - up } end
    for _ = 1, 30 do way[#way + 1] = way[#way] end
    -- the run continues only now, so the wire is still where it was seen, even on a slow machine
    page:run "setTimeout(() => player.link.order('go'), 150)"
    page:pointer(way, true)
    page:wait "return player.panel.lines.script && /hand:release/.test(player.panel.lines.script)"
    order "pause"
    page:wait "return player.state.get('run').holds"
    local after = place(s)
    assert.is_true(after[3] > before[3] + 0.005, ("from %g to %g m"):format(before[3], after[3]))
    local lines = text ".lines"
    assert.truthy(lines:find('hand = scene:force { kind = "pull", on = scene:find("wire")', 1, true), lines)
    assert.truthy(lines:find("hand:release()", 1, true))
    assert.truthy(page:run "return player.state.get('events').some((e) => e.kind === 'hand')")
    assert.is_true(page:run "return document.querySelectorAll('.mark').length" > 0)
  end)

  it("changes a value of an object, refuses one out of range, and undoes the change", function()
    page:run [[
      const what = document.getElementById("what");
      what.value = "wall";
      what.dispatchEvent(new Event("change"));]]
    local row = text ".rows"
    assert.truthy(row:find("friction", 1, true) and row:find("0 … 100", 1, true), row)
    value("row-friction", "0.8")
    page:wait [[return document.getElementById("row-friction").value === "0.8"
      && /scene:find\("wall"\):set { friction = 0.8 }/.test(document.querySelector(".lines").innerText)]]
    value("row-friction", "-1")
    page:wait [[return /friction = -1 is not allowed/.test(document.querySelector(".lines .why")?.innerText)]]
    page:run [[document.querySelector("[aria-label='Undo the last change']").click()]]
    page:wait [[return document.getElementById("row-friction").value === "0.3"]]
    page:wait [[return document.getElementById("row-kinetic_friction").value === "0.3"]]
    value("row-friction", "0.5")
    page:wait [[return document.getElementById("row-friction").value === "0.5"]]
  end)

  it("shows the past and returns to the present", function()
    local present = time()
    page:run "player.transport.go(0.004)"
    assert.near(0.004, time(), 1e-9)
    assert.is_false(page:run "return player.state.get('follow')")
    page:keys "End"
    page:wait "return player.state.get('follow')"
    order "step"
    page:wait(("return player.state.get('time') > %.9f"):format(present))
  end)

  -- Orders that came together were one step; the kept state below then waited for its third step in vain.
  it("makes as many steps as are asked for at once", function()
    local before = time()
    page:run "for (let k = 0; k < 5; k++) player.link.order('step')"
    page:wait(("return player.state.get('time') > %.9f"):format(before + 4.5 * 0.004))
  end)

  it("goes back to a kept state, and drops what came later", function()
    local before = time()
    order "keep"
    page:wait "return player.state.get('run').snapshots.length === 2"
    -- a frame may still be on its way to the page
    local kept = page:run "return player.state.get('run').snapshots[1].time"
    assert.is_true(kept > before - 1e-9 and kept < before + 0.05, ("%g after %g"):format(kept, before))
    for _ = 1, 3 do order "step" end
    page:wait(("return player.state.get('time') > %.9f"):format(kept + 0.008))
    value("row-friction", "0.9")
    page:wait [[return document.getElementById("row-friction").value === "0.9"]]
    page:run [[document.querySelectorAll(".states button")[1].click()]]
    page:wait(("return Math.abs(player.state.get('time') - %.12f) < 1e-9"):format(kept))
    page:wait [[return document.getElementById("row-friction").value === "0.5"]]
    assert.is_nil(page:run("return player.panel.lines.script"):find("0.9", 1, true))
  end)

  it("is the same after the page is reloaded", function()
    local before = time()
    page:go(run.address)
    assert.near(before, time(), 1e-9)
    assert.equal("held", text "#status")
    assert.truthy(text ".lines":find("hand:release()", 1, true))
  end)

  it("saves everything done as a script that gives the same numbers, to the last bit", function()
    local script = page:run "return player.panel.lines.script"
    order("speed", {})
    order "go"
    local numbers = finish(run)
    program.write(folder .. "/again.lua", script .. TELL)
    local out, err, code = program.run { folder .. "/again.lua" }
    assert.equal(0, code, err)
    assert.equal(numbers:match "[^\n]*\n$", out:match "[^\n]*\n$")
  end)

  it("says when the program has ended", function()
    page:wait [[return document.getElementById("status").innerText === "not connected"]]
  end)
end)
