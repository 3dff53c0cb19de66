-- SPDX-License-Identifier: GPL-3.0-or-later
-- Forms of a view during a run, and in a view that starts with an empty scene.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local json = require "softworld.output.json"
local leaving = require "softworld.view.leaving"
local orders = require "softworld.view.orders"
local saving = require "spec.scene.saving"
local viewing = require "softworld.view.view"
local visitor = require "spec.page.visitor"

local WIRE = { name = "cord", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.5, 0, 0.1 } }

local function an_order(class, kind, values, serial)
  return { ["do"] = "add", class = class, kind = kind, values = values, serial = serial }
end

describe("orders to add and remove objects during a run", function()
  local function scene_of()
    local scene = sw.scene { name = "live" }
    scene:wire(WIRE)
    scene:gripper { name = "hand" }
    return scene
  end
  local function line(scene, m) return orders.line(scene, m) end
  local function run(scene, text) load(text, "=x", "t", { scene = scene })() end

  it("give one line for each object, and one that removes it again", function()
    local scene = scene_of()
    local text, inverse = line(scene, an_order("obstacle", "plane", {}))
    assert.equal('scene:obstacle { name = "plane1", shape = "plane" }', text)
    run(scene, text)
    assert.equal('scene:find("plane1"):remove()', inverse())
    run(scene, inverse())
    assert.is_false(scene:find("plane1").present)
    text, inverse = line(scene, an_order("hold", "pin", { _on = "cord", s = 0.2 }))
    run(scene, text)
    assert.equal('scene:find("pin1"):release()', inverse())
    text, inverse = line(scene, { ["do"] = "add", class = "force", kind = "drag", serial = 3,
      values = { on = "cord", linear = 0.1 } })
    assert.equal('made[3] = scene:force { kind = "drag", on = scene:find("cord"), linear = 0.1 }', text)
    assert.equal("made[3]:release()", inverse())
  end)

  it("also remove wires, grippers and the script's own forces", function()
    local scene = scene_of()
    scene:force { kind = "damping", mass = 1 }
    local function take(m)
      m["do"] = "remove"
      local text = line(scene, m)
      run(scene, text)
      return text
    end
    assert.equal("scene:remove(scene:forces()[1])", take { force = 1 })
    assert.equal('scene:remove "hand"', take { object = "hand" })
    assert.equal('scene:remove "cord"', take { object = "cord" })
    assert.equal("", json.encode(leaving.objects(scene, {})):gsub("[%[%]]", ""))
  end)

  it("have a line that makes an object again where the state cannot go back", function()
    local scene = scene_of()
    scene:obstacle { name = "box", shape = "box", size = { 0.1, 0.1, 0.1 } }:set { at = { 0, 1, 0 } }
    scene:force { kind = "drag", on = scene:find "cord", linear = 0.5 }
    local box = leaving.again(scene, { object = "box" }, 7)
    assert.equal('scene:obstacle { name = "box (2)", shape = "box", at = { 0, 1, 0 }, '
      .. "rotation = { 1, 0, 0, 0 }, size = { 0.1, 0.1, 0.1 } }", (box:gsub("%s+", " "):gsub("%.0", "")))
    assert.equal('made[7] = scene:force { kind = "drag", on = scene:find("cord"), linear = 0.5 }',
      leaving.again(scene, { force = 1 }, 7))
    scene:remove "box"
    load(box, "=x", "t", { scene = scene })()
    assert.are.same({ 0, 1, 0 }, (scene:find "box (2)":pose()))
    assert.is_nil(leaving.again(scene, { object = "cord" }, 8)) -- what the wire did is only in a state
  end)

  it("lead a gripper along a straight path at the given speed, and let it stay", function()
    local scene = scene_of()
    local grip = scene:gripper { name = "moved", at = { 0, 0, 0.2 } }
    local text = line(scene, { ["do"] = "lead", gripper = "moved", to = { 0.1, 0, 0.2 }, speed = 0.5 })
    assert.equal('scene:find("moved"):move { to = { 0.1, 0, 0.2 }, speed = 0.5, law = "linear" }', text)
    run(scene, text)
    scene:run { duration = 0.1, dt = 0.01 }
    assert.near(0.05, grip:position()[1], 1e-9) -- 0.5 m/s for 0.1 s
    run(scene, line(scene, { ["do"] = "leave", gripper = "moved" }))
    scene:run { duration = 0.1, dt = 0.01 }
    assert.near(0.05, grip:position()[1], 1e-9)
    assert.equal('scene:find("moved"):stop()',
      line(scene, { ["do"] = "lead", gripper = "moved", to = grip:position(), speed = 0.5 }))
  end)

  it("report objects that cannot be removed, or cannot exist", function()
    local scene = scene_of()
    local function refused(m, words)
      local fine, message = pcall(orders.line, scene, m)
      assert.is_false(fine)
      assert.truthy(tostring(message):find(words), message)
    end
    refused({ ["do"] = "remove", force = 1 }, "there is no such force")
    refused({ ["do"] = "remove", force = "1)] os.exit(3) --" }, "there is no such force")
    refused({ ["do"] = "lead", gripper = "cord", to = { 0, 0, 0 }, speed = 1 }, "'cord' is not a gripper")
    refused({ ["do"] = "lead", gripper = "hand", to = { 0, 0, 0 }, speed = 0 }, "speed")
    refused({ ["do"] = "lead", gripper = "hand", to = { 0, 0, 0 }, speed = 1 }, "'hand' has no place yet")
    refused({ ["do"] = "remove", object = "nobody" }, "nothing named 'nobody'")
    refused({ ["do"] = "remove", object = "" }, "the scene itself cannot be taken away")
    refused({ ["do"] = "remove", made = "1] os.exit(3) --" }, "made is not a number")
    refused({ ["do"] = "remove", object = { "cord" } }, "is not a name")
    refused(an_order("step", "wait", { seconds = 1 }), "while a run is under way")
    refused(an_order("obstacle", "sphere", { radius = -1 }), "radius = %-1 m")
    refused(an_order("hold", "pin", { _on = "cord\") os.exit(3) --" }),
      "nothing named")
    refused(an_order("hold", "pin", { s = 0 }), "on which wire")
    refused({ ["do"] = "set", object = "cord", values = { at = { 0 / 0, 0, 0 } } }, "has nothing to set")
    local nan = 0 / 0
    refused({ ["do"] = "pull", wire = "cord", s = nan, to = { 0, 0, 0 }, force = 1, stiffness = 1 },
      "s is not a number")
  end)
end)

describe("a view that starts with an empty scene", function()
  it("is unchanged after meaningless messages", function()
    local page = visitor.open(viewing.nothing { open = false })
    local view = page.view
    page:add("wire", "rod", WIRE)
    page:hear(0.2)
    local scene = view.scene
    for _, text in ipairs { '{"do":"draft"}', '{"do":"draft","what":{}}', '{"do":"draft","what":"add"}',
      '{"do":"draft","what":"new"}', '{"do":"draft","what":"__index"}',
      '{"do":"draft","what":"change","id":1}',
      '{"do":"draft","what":"put","id":1,"values":{"nonsense":1}}', '{"do":"draft","what":"put","id":1}',
      '{"do":"draft","what":"put","id":1,"values":{"from":[0,0]}}',
      '{"do":"draft","what":"scene","values":[1]}',
      '{"do":"draft","what":"shift","id":1,"by":1}', '{"do":"draft","what":"redo","ask":{"a":[]}}',
      '{"do":"start"}', '{"do":"start","values":{"duration":"1"}}', '{"do":"start","values":{"dt":0}}',
      '{"do":"start","values":{"save":"/tmp/x"}}', '{"do":"start","values":{"integrator":"\\u0000"}}',
      '{"do":"add","class":"obstacle","kind":"plane","values":{}}', '{"do":"add"}', '{"do":"remove"}',
      '{"do":"remove","object":"cord"}', '{"do":"remove","made":1e308}', '{"do":"add","serial":[]}',
      '{"do":"set","object":"","values":{"gravity":[0,0,0]}}', '{"do":"undo"}', '{"do":"back","id":1}' } do
      page.socket:send(text)
    end
    page:hear(0.3)
    assert.equal(scene, view.scene) -- nothing was built anew
    assert.equal(1, #scene:names())
    assert.equal(0, scene.time)
    page:close()
  end)

  it("says why it cannot run, in the words of a script but without a place", function()
    local page = visitor.open(viewing.nothing { open = false })
    page:ask { ["do"] = "run", duration = 0.1 }
    page:hear(0.2)
    assert.equal("scene 'scene': there is no wire", page.got.lines.lines[2].error)
    page:close()
  end)

  it("follows its page, answers, and gives a script of the same bits, also for actions by hand", function()
    local page = visitor.open(viewing.nothing { open = false })
    local view, got = page.view, page.got
    local function go(text, seconds)
      if text then page.socket:send(text) end
      page:hear(seconds or 0.15)
      local list = got.answers and got.answers.answers or {}
      return list[#list]
    end
    go()
    assert.is_true(got.state.draft and got.state.at_start)
    go(json.encode { ["do"] = "draft", what = "add", class = "wire", kind = "rod", values = WIRE, ask = "a" })
    local answer = go([[{"do":"draft","what":"add","class":"hold","kind":"clamp",]]
      .. [["values":{"_on":"cord","s":3},"ask":"b"}]])
    assert.equal("b", answer.ask)
    assert.equal("clamp 'clamp1': s = 3 m is not on wire 'cord'; it must be in [0, 0.5] m; is this in mm?",
      answer.text)
    go [[{"do":"draft","what":"add","class":"hold","kind":"clamp","values":{"_on":"cord","s":0},"ask":"c"}]]
    go [[{"do":"set","object":"","values":{"gravity":[0,0,-1]},"ask":"d"}]]
    assert.is_nil(got.lines.script:find "gravity")
    assert.truthy(go([[{"do":"start","values":{},"ask":"e"}]]).text:find "^scene:run: .*give duration")
    go('{"do":"start","values":{"duration":0.2,"dt":0.004},"ask":"f"}', 0.4)
    assert.is_true(got.state.done and got.state.ok)
    go [[{"do":"set","object":"","values":{"gravity":[0,0,-1]},"ask":"g"}]]
    go [[{"do":"add","class":"force","kind":"drag","values":{"on":"cord","linear":0.1},"ask":"h"}]]
    go([[{"do":"run","duration":0.1}]], 0.3)
    assert.near(0.3, view.scene.time, 1e-12)
    assert.is_nil(saving.difference(saving.all(view.scene), saving.all(page:by_script())))
    go [[{"do":"again","ask":"i"}]]
    assert.equal(0, view.scene.time)
    assert.is_true(got.state.at_start)
    page:close()
  end)
end)
