-- SPDX-License-Identifier: GPL-3.0-or-later
-- `softworld --view` alone, in a real browser: forms put a scene together; it is run, changed, run again and
-- saved. The saved script gives the same numbers.
package.path = "./?.lua;" .. package.path
local begun = require "spec.page.begun"
local program = dofile "spec/host/program.lua"
local socket = require "socket"

local folder, page, address

local begin, text, click, fill, submit, closed, set_duration, add, wait_for = begun.begin, begun.text,
  begun.click, begun.fill, begun.submit, begun.closed, begun.set_duration, begun.add, begun.wait_for

local TELL = [[
for _, x in ipairs((scene:find("cord"):positions())) do io.write(("%a "):format(x)) end
print()
]]

-- The same as `softworld --view`, except that it prints the numbers of its scene when a file "tell" appears.
local SCRIPT = [[
require "softworld"
local view = require("softworld.view.view").nothing { open = false }
io.stderr:write(view.address, "\n")
while true do
  view:wait(0.1)
  if os.remove "tell" then
    local scene = view.scene
]] .. TELL .. [[
    io.stdout:flush()
  end
end
]]

local told = 0

-- The numbers of the view's scene; the view must be between two runs.
local function numbers()
  program.write(folder .. "/tell", "")
  for _ = 1, 200 do
    local file = io.open(folder .. "/out")
    local said = file:read "a"
    file:close()
    if #said > told and said:find "\n$" then
      local line = said:sub(told + 1)
      told = #said
      return line
    end
    socket.sleep(0.05)
  end
  error "nothing was printed"
end

local function steps(count)
  for _ = 1, count do
    local before = page:run "return player.state.get('time')"
    page:run [[player.link.order("step")]]
    page:wait(("return player.state.get('time') > %.9f + 1e-6"):format(before))
  end
end

-- Drags the chosen object by its arrow along z.
local function drag_up(name)
  page:run([[
    const actor = player.view.actors.find((a) => a.name === arguments[0]);
    player.state.set({ selected: actor.id });]], name)
  page:run "player.view.stage.draw()"
  local at = page:run [=[
    const { stage } = player.view;
    const p = player.view.find(player.state.get("selected")).group.position.clone();
    p.z += 0.09 * stage.camera.position.distanceTo(p);
    const s = stage.onScreen(p), b = stage.canvas.getBoundingClientRect();
    return [b.left + s[0], b.top + s[1]];]=]
  page:pointer({ at, { at[1], at[2] - 10 }, { at[1], at[2] - 30 } }, true)
end

-- The saved script prints the numbers of the view's scene.
local function same_numbers()
  local script = page:run "return player.panel.build.script"
  program.write(folder .. "/again.lua", script .. TELL)
  local out, err, code = program.run { folder .. "/again.lua" }
  assert.equal(0, code, err)
  local line = numbers()
  assert.is_true(#line > 1000)
  assert.equal(line, out:match "[^\n]*\n$")
  return script
end

local function things() return text "ul.things" end
setup(function()
  page, folder = begun.open()
  program.write(folder .. "/run.lua", SCRIPT)
  address = begin "run.lua"
  page:go(address)
end)

teardown(begun.close)

describe("a view that starts with an empty scene", function()
  it("opens an empty scene at its start", function()
    assert.equal("at the start", text "#status")
    assert.truthy(text(".stage > .empty"):find "Nothing is here yet")
    assert.truthy(text "#panel-build":find "Begin with a wire")
    assert.equal("– –", page:run [[
      return [...document.querySelectorAll(".legend .end")].map((e) => e.value).join(" ");]])
    for _, line in ipairs(page:console()) do
      assert.is_true(line.level ~= "SEVERE" and line.level ~= "WARNING", line.level .. ": " .. line.message)
    end
  end)

  it("makes a wire of the catalogue, and shows its values and their sources", function()
    add "wire"
    fill("cable", "GXL 2.5")
    local sheet = text ".sheet"
    for _, words in ipairs { "0.0035 m", "measured", "makers' tables" } do
      assert.truthy(sheet:find(words, 1, true), sheet)
    end
    local field = begun.FIELD:gsub("arguments%[0%]", '"E"')
    assert.is_true(page:run(field .. "return all[0].closest('.row').hidden"))
    fill("name", "cord")
    fill("from", "0", "0", "0.1")
    fill("to", "0.4", "0", "0.1")
    submit()
    closed()
    wait_for 'cable = "GXL 2.5"'
    page:wait "return player.view.actors.some((a) => a.kind === 'wire' && a.group.visible)"
  end)

  it("makes an obstacle of a chosen shape", function()
    add "obstacle"
    page:run [[
      const s = document.querySelector(".form-box .choose select");
      s.value = "box";
      s.dispatchEvent(new Event("change"));]]
    fill("name", "block")
    fill("size", "0.05", "0.2", "0.05")
    fill("at", "0.3", "0", "0.025")
    submit()
    closed()
    wait_for "block"
  end)

  it("refuses a wrong value at the form with the core's message, and changes nothing", function()
    local before = things()
    add "hold"
    fill("s", "3")
    submit()
    page:wait [[return document.querySelector(".form .why").innerText
      === "clamp 'clamp1': s = 3 m is not on wire 'cord'; it must be in [0, 0.4] m; is this in mm?"]]
    assert.equal(before, things())
    fill("s", "zero")
    submit()
    page:wait [[return /s: 'zero' is no number/.test(document.querySelector(".form .why").innerText)]]
    fill("s", "0")
    submit()
    closed()
    wait_for "clamp1"
  end)

  it("moves the chosen object by its handles, as its form does", function()
    drag_up "block"
    page:wait [=[return player.panel.build.items.find((i) => i.name === "block").values.at[2] > 0.03]=]
    local place = page:run [=[return player.panel.build.items.find((i) => i.name === "block").values.at]=]
    assert.equal(0.3, place[1]) -- along the arrow only, in whole millimetres
    assert.equal(0, place[2])
    assert.near(0, (1000 * place[3] + 0.5) % 1 - 0.5, 1e-9)
    click "[aria-label='Undo']"
    page:wait [=[return player.panel.build.items.find((i) => i.name === "block").values.at[2] === 0.025]=]
  end)

  it("removes an object with everything that refers to it, and brings it back", function()
    click "[aria-label='Remove cord']"
    page:wait [[return !/clamp1/.test(document.querySelector("ul.things").innerText)]]
    assert.is_nil(things():find "cord")
    click "[aria-label='Undo']"
    wait_for "clamp1"
    assert.truthy(things():find "cord")
  end)

  it("changes an object through its form", function()
    page:run [[[...document.querySelectorAll(".thing-name")].find((b) => /block/.test(b.innerText)).click()]]
    fill("friction", "0.7")
    submit()
    closed()
    wait_for "friction = 0.7"
  end)

  it("saves a run that was ended, wound back and continued", function()
    set_duration "5"
    page:run [[player.link.order("pause")]]
    click "#run"
    page:wait "return player.state.get('run').running && player.state.get('run').holds"
    steps(3)
    page:run [[player.link.order("keep")]]
    page:wait "return player.state.get('run').snapshots.length === 2"
    steps(3)
    page:run [[player.link.order("stop")]]
    page:wait "return player.state.get('run').done"
    assert.equal("ended", text "#status")
    page:run [[
      player.link.order("back", { id: 2 });
      player.link.order("go");
      player.link.order("run", { duration: 0.25 });]]
    page:wait "return player.state.get('run').done && player.state.get('time') > 0.27"
    same_numbers()
    click "#again"
    page:wait "return player.state.get('run').at_start && player.state.get('time') === 0"
  end)

  it("runs a gripper's steps, and goes back to the start", function()
    add "gripper"
    fill("name", "hand")
    fill("at", "0.4", "0", "0.2")
    submit()
    closed()
    for _, step in ipairs { { "grasp", "s", "0.38" }, { "move", "by", "-0.05", "0", "0.05" },
      { "wait", "seconds", "0.05" }, { "release" } } do
      click "#add-step"
      page:run([[
        const s = document.querySelector(".form-box .choose select");
        s.value = arguments[0];
        s.dispatchEvent(new Event("change"));]], step[1])
      if step[2] then fill(table.unpack(step, 2)) end
      submit()
      closed()
    end
    assert.equal(4, page:run "return document.querySelectorAll('ol.things > li').length")
    set_duration "0.8"
    click "#run"
    page:wait "return player.state.get('run').done"
    assert.equal("ended", text "#status")
    assert.near(0.8, page:run "return player.state.get('time')", 1e-6)
    click "#again"
    page:wait "return player.state.get('run').at_start && player.state.get('time') === 0"
    assert.equal("at the start", text "#status")
  end)

  it("is the same on a reloaded page", function()
    page:go(address)
    assert.truthy(things():find "block" and things():find "clamp1")
    assert.equal(4, page:run "return document.querySelectorAll('ol.things > li').length")
  end)

  it("adds an object while a run is paused, and removes it", function()
    set_duration "5"
    page:run [[player.link.order("pause")]]
    click "#run"
    page:wait "return player.state.get('run').running && player.state.get('run').holds"
    assert.truthy(text "#panel-build":find "A run is under way")
    add "obstacle"
    fill("name", "late")
    submit()
    closed()
    wait_for "late"
    assert.is_true(page:run [[return Boolean(document.querySelector("[aria-label='Remove hand']"))]])
    drag_up "block"
    page:wait [[return /scene:find\("block"\):set { at = { 0.3, 0, /.test(player.panel.build.script)]]
    click "[aria-label='Remove late']"
    page:wait [[return !/late/.test(document.querySelector("ul.things").innerText)]]
    assert.truthy(page:run [[return /scene:find\("late"\):remove\(\)/.test(player.panel.build.script)]])
    steps(2)
    add "wire"
    fill("name", "later")
    fill("from", "0", "0.1", "0.3")
    fill("to", "0.2", "0.1", "0.3")
    submit()
    closed()
    wait_for "later"
    page:run [[player.link.order("set", { object: "", values: { gravity: [0, 0, -5] } })]]
    page:wait [[return /gravity = { 0, 0, -5 }/.test(player.panel.build.script)]]
    steps(3)
    local before = page:run "return player.state.get('time')" -- the gripper is on its way
    for _, name in ipairs { "cord", "hand" } do
      click(("[aria-label='Remove %s']"):format(name))
      page:wait(([[return !document.querySelector("[aria-label='Remove %s']")]]):format(name))
      steps(2)
      click "[aria-label='Undo']"
      page:wait(([[return Boolean(document.querySelector("[aria-label='Remove %s']"))]]):format(name))
      page:wait(([[return /^back to t = [0-9.]+ s, before '%s' was removed$/.test(
        document.getElementById("say").innerText)]]):format(name))
      page:wait(("return Math.abs(player.state.get('time') - %.12f) < 1e-9"):format(before))
    end
    assert.is_nil(page:run("return player.panel.build.script"):find("scene:remove", 1, true))
    page:run [[player.link.order("stop")]]
    page:wait "return player.state.get('run').done"
  end)

  it("saves a script that prints the same numbers, also for actions by hand", function()
    page:run [[player.link.order("go"); player.link.order("run", { duration: 0.5 })]]
    page:wait "return player.state.get('run').done && player.state.get('time') > 0.5"
    local script = same_numbers()
    assert.truthy(script:find("hand:grasp(cord, { s = 0.38 })", 1, true), script)
    assert.truthy(script:find("-- the run is ended", 1, true), script)
  end)
end)
