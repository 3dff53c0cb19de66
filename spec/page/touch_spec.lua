-- SPDX-License-Identifier: GPL-3.0-or-later
-- The live view in a real browser: objects of a run under way are removed and come back by undo, and the
-- pointer leads a gripper. The saved script gives the same numbers.
package.path = "./?.lua;" .. package.path
local browser = require "spec.page.browser"
local program = dofile "spec/host/program.lua"
local socket = require "socket"

local folder, page

local SCENE = [[
local sw = require "softworld"
local scene = sw.scene { name = "touched" }
scene:obstacle { name = "floor", shape = "plane", friction = 0.3 }
local function rod(name, y)
  return scene:wire { name = name, E = 5e7, density = 1500, radius = 0.004, segments = 20,
    from = { 0.3, y, 0.12 }, to = { -0.2, y, 0.12 } }
end
local a, b = rod("a", 0), rod("b", 0.1)
scene:clamp(b, { s = 0, name = "fixed" })
scene:force { kind = "damping", mass = 1 }
local hand = scene:gripper { name = "hand", at = { 0.3, 0, 0.12 } }
hand:grasp(a, { s = 0 })
]]
local TELL = [[
for _, x in ipairs((scene:find("a"):positions())) do io.write(("%a "):format(x)) end
io.write(run:ledger().gap < 0.02 * run:ledger().play and "no gap" or "a gap", " ", run:ledger().work.holds)
print()
]]

local function read(name)
  local file = io.open(folder .. "/" .. name)
  local all = file and file:read "a" or ""
  if file then file:close() end
  return all
end

local function until_there(name, pattern)
  for _ = 1, 400 do
    local found = read(name):match(pattern)
    if found then return found end
    socket.sleep(0.05)
  end
  error(name .. " never came: " .. read "err")
end

local function order(name, more)
  page:run("player.link.order(arguments[0], arguments[1] || {})", name, more)
end
local function time() return page:run "return player.state.get('time')" end
local function script() return page:run "return player.panel.lines.script" end
local function things() return page:run "return document.querySelector('ul.things').innerText" end
local function click(selector) page:run("document.querySelector(arguments[0]).click()", selector) end
local function steps(count)
  for _ = 1, count do
    local before = time()
    order "step"
    page:wait(("return player.state.get('time') > %.9f + 1e-6"):format(before))
  end
end
local function is_there(kind, name)
  return page:run([[return player.view.actors.some((a) => a.kind === arguments[0] && a.name === arguments[1]
    && a.there)]], kind, name)
end
local function gone(name)
  page:wait(("return !player.panel.build.things('wire').includes(%q)"):format(name))
end
local function there(name)
  page:wait(("return player.view.actors.find((a) => a.name === %q).there"):format(name))
end

-- A removed object is still visible in the past; undo brings it back and returns to the time before the
-- removal.
local function comes_back(name, time_before)
  page:run "player.transport.go(0)"
  there(name)
  page:keys "End"
  click "[aria-label='Undo']"
  page:wait(("return player.panel.build.things('wire').includes(%q)"):format(name))
  page:wait(("return Math.abs(player.state.get('time') - %.12f) < 1e-9"):format(time_before))
  there(name)
end

setup(function()
  folder = program.folder()
  page = browser.open(1280, 720)
  program.write(folder .. "/run.lua", SCENE .. [[
local view = scene:view { open = false, paused = true }
local file = io.open("address", "w")
file:write(view.address)
file:close()
local run = scene:run { duration = 20, dt = 0.004 }
assert(run.ok, run.reason)
]] .. TELL .. "io.stdout:flush() view:wait(60)")
  local path = program.path:find "^/" and program.path or require "lfs".currentdir() .. "/" .. program.path
  os.execute(("cd '%s' && '%s' run.lua >out 2>err & echo $! >'%s/pid'"):format(folder, path, folder))
  page:go(until_there("address", "http%S+/$"))
  page:run [[document.getElementById("tab-build").click()]]
end)

teardown(function()
  os.execute("kill " .. read "pid" .. " 2>/dev/null")
  if page then page:close() end
  os.execute("rm -rf " .. program.quote(folder))
end)

describe("a run changed by hand", function()
  it("loses a wire with its clamp, also in the picture, and gets it back by undo", function()
    steps(5)
    assert.is_true(is_there("wire", "b") and is_there("hold", "fixed"))
    local before = time()
    click "[aria-label='Remove b']"
    gone "b"
    assert.is_nil(things():find "fixed")
    assert.truthy(script():find('scene:remove "b"', 1, true))
    steps(3)
    assert.is_false(is_there("wire", "b"))
    assert.is_true(is_there("wire", "a"))
    assert.truthy(page:run "return player.state.get('events').some((e) => e.kind === 'removed')")
    comes_back("b", before)
    assert.truthy(things():find "fixed")
    assert.is_nil(script():find("scene:remove", 1, true))
  end)

  it("loses a force of the script, which has no name", function()
    assert.truthy(things():find "damping")
    click "[aria-label='Remove damping']"
    page:wait [[return !/damping/.test(document.querySelector("ul.things").innerText)]]
    assert.truthy(script():find("scene:remove(scene:forces()[1])", 1, true))
    steps(2)
  end)

  it("loses its last wire, continues without it, and gets it back by undo", function()
    click "[aria-label='Remove b']"
    gone "b"
    steps(1)
    local before = time()
    click "[aria-label='Remove a']"
    gone "a"
    steps(2)
    assert.is_false(is_there("wire", "a"))
    assert.is_true(is_there("gripper", "hand"))
    assert.truthy(page:run "return player.state.get('events').some((e) => /no wire is left/.test(e.text))")
    comes_back("a", before)
    steps(1)
  end)

  it("has its gripper led by the pointer, within the speed limit, in events and energy", function()
    page:run [[player.state.set({ lead: 0.1 })]]
    order("speed", { value = 0.25 })
    local from
    for _ = 1, 100 do -- a busy machine draws late
      from = page:run [=[
      const view = player.view, p = view.actors.find((a) => a.kind === "gripper").group.position;
      const b = view.stage.canvas.getBoundingClientRect();
      for (let dy = 0; dy < 60; dy += 2) { // where the picture shows the gripper
        for (const dx of [0, -6, 6]) {
          const at = view.stage.onScreen(p), x = b.left + at[0] + dx, y = b.top + at[1] - dy;
          if (view.hitAt(x, y)?.actor.kind === "gripper") return [x, y, p.x, p.y, p.z];
        }
      }
      return null;]=]
      if from then break end
      socket.sleep(0.05)
    end
    assert(from, "the gripper is not in the picture")
    local way = { { from[1], from[2] } }
    for _, up in ipairs { 20, 60, 100 } do way[#way + 1] = { from[1], from[2] - up } end
    for _ = 1, 30 do way[#way + 1] = way[#way] end
    local begun = time()
    page:run "setTimeout(() => player.link.order('go'), 150)"
    page:pointer(way, true)
    page:wait "return player.panel.lines.script && /hand\"\\):stop/.test(player.panel.lines.script)"
    order "pause"
    page:wait "return player.state.get('run').holds"
    local to = page:run [=[
      const p = player.view.actors.find((a) => a.kind === "gripper").group.position;
      return [p.x, p.y, p.z];]=]
    local moved = ((to[1] - from[3]) ^ 2 + (to[2] - from[4]) ^ 2 + (to[3] - from[5]) ^ 2) ^ 0.5
    assert.is_true(to[3] > from[5] + 0.005, ("from %g to %g m"):format(from[5], to[3]))
    assert.is_true(moved <= 0.1 * (time() - begun) + 1e-4, ("%g m in %g s"):format(moved, time() - begun))
    local said = page:run [[
      return player.state.get("events").filter((e) => e.kind === "hand").map((e) => e.text);]]
    assert.are.same({ "gripper 'hand' is led by hand", "gripper 'hand' is let go by hand" }, said)
    steps(5)
    local still = page:run [=[return player.view.actors.find((a) => a.kind === "gripper").group.position.z]=]
    assert.near(to[3], still, 1e-4)
  end)

  it("loses the gripper, and its wire falls", function()
    click "[aria-label='Remove hand']"
    page:wait [[return !/hand/.test(document.querySelector("ul.things").innerText)]]
    steps(3)
    assert.is_false(is_there("gripper", "hand"))
  end)

  it("is saved as a script that gives the same numbers, to the last bit", function()
    order "stop"
    local numbers = until_there("out", "[^\n]*\n$")
    page:wait "return /the run is ended/.test(player.panel.lines.script)"
    local saved = script()
    program.write(folder .. "/again.lua", saved .. TELL)
    local out, err, code = program.run { folder .. "/again.lua" }
    assert.equal(0, code, err)
    assert.equal(numbers, out:match "[^\n]*\n$")
    assert.truthy(numbers:find "no gap")
    assert.is_true(tonumber(numbers:match "(%S+)\n$") > 0) -- the gripper has lifted the wire's end
  end)

  it("leaves the console without warnings", function()
    for _, line in ipairs(page:console()) do
      assert.is_true(line.level ~= "SEVERE" and line.level ~= "WARNING", line.level .. ": " .. line.message)
    end
  end)
end)
