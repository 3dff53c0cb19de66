-- SPDX-License-Identifier: GPL-3.0-or-later
-- `softworld --view` without a script, in a real browser.
package.path = "./?.lua;" .. package.path
local begun = require "spec.page.begun"
local program = dofile "spec/host/program.lua"

local folder, page

setup(function() page, folder = begun.open() end)
teardown(begun.close)

local begin, stop, text, click, fill, submit, closed, set_duration, add, wait_for = begun.begin,
  begun.stop, begun.text, begun.click, begun.fill, begun.submit, begun.closed, begun.set_duration,
  begun.add, begun.wait_for

local function choose(kind)
  page:run([[
    const s = document.querySelector(".form-box .choose select");
    s.value = arguments[0];
    s.dispatchEvent(new Event("change"));]], kind)
end

describe("softworld --view without a script", function()
  it("opens a page with an empty scene until Ctrl-C, during a run or not", function()
    stop()
    page:go(begin "--view")
    assert.equal("at the start", text "#status")
    stop()
    page:wait [[return document.getElementById("status").innerText === "not connected"]]
    page:go(begin "--view")
    add "wire"
    submit()
    closed()
    set_duration "1e5"
    click "#run"
    page:wait "return player.state.get('run').running && player.state.get('time') > 0.1"
    stop()
    page:wait [[return document.getElementById("status").innerText === "not connected"]]
  end)

  it("joins wires, makes a net, and waits for a gripper's load", function()
    page:go(begin "--view")
    for _, name in ipairs { "cord", "branch" } do
      add "wire"
      fill("name", name)
      if name == "branch" then
        fill("from", "0.25", "0", "0.1")
        fill("to", "0.25", "0.2", "0.1")
      end
      submit()
      closed()
      wait_for(name)
    end
    add "fixing"
    choose "join"
    fill("one", "cord")
    fill("s", "0.25")
    fill("other", "branch")
    fill("other_s", "0")
    submit()
    closed()
    wait_for "join1"
    add "particles"
    fill("name", "net")
    submit()
    closed()
    wait_for "net"
    add "gripper"
    fill("name", "hand")
    submit()
    closed()
    wait_for "hand"
    for _, step in ipairs { { "grasp", "s", "0.5" }, { "wait_for_force", "force", "0.01" } } do
      click "#add-step"
      choose(step[1])
      if step[1] ~= "grasp" then assert.truthy(text ".form-box":find "Lua functions, in a script") end
      fill(step[2], step[3])
      submit()
      closed()
    end
    local wait = "p:wait_until({ on = hand, force = 0.01 }, { timeout = 1 })"
    assert.truthy(text "ol.things":find(wait, 1, true))
    assert.is_true(page:run [[return player.view.actors.some((a) => a.kind === "particles" && a.there)]])
    set_duration ""
    click "#run"
    page:wait "return player.state.get('run').done"
    assert.equal("ended", text "#status")
    for _, line in ipairs(page:console()) do
      assert.is_true(line.level ~= "SEVERE" or line.message:find("CONNECTION_REFUSED") ~= nil, line.message)
    end
    stop()
  end)

  it("accepts functions when allowed to, shows the faulty line, and saves them", function()
    local function has_function()
      add "force"
      return page:run [[return [...document.querySelector(".form-box .choose select").options]
        .some((o) => o.value === "function")]]
    end
    page:go(begin "--view")
    add "wire"
    submit()
    closed()
    assert.is_false(has_function())
    stop()
    page:go(begin "--view --functions")
    add "wire"
    submit()
    closed()
    assert.is_true(has_function())
    choose "function"
    local function body(words)
      page:run("document.querySelector('textarea.code').value = arguments[0]", words)
      submit()
    end
    body "f[3] = f[3] + 0.01\nf[6] = = 2"
    page:wait "return /^function.func: line 2: /.test(document.querySelector('.form-box .why').innerText)"
    assert.equal("f[6] = = 2", page:run [[const a = document.activeElement;
      return a.value.slice(a.selectionStart, a.selectionEnd)]])
    body "if t > 0.2 then\n  f[3] = scene.nothing.at\nend"
    closed()
    click "#run"
    page:wait "return /line 2 of func of function .line [0-9]+ of the script./.test(document.body.innerText)"
    page:wait "return player.state.get('time') > 0.15" -- as far as it went
    click "ul.things li:nth-child(2) .thing-name"
    page:wait "return document.querySelector('textarea.code')"
    body "f[3] = f[3] + 0.001 * math.sin(20 * t)"
    closed()
    click "#run"
    page:wait "return player.state.get('run').done && player.state.get('run').ok"
    local script = page:run "return player.panel.build.script"
    local source = "kind = function(t, x, v, f)\nf[3] = f[3] + 0.001 * math.sin(20 * t)\nend"
    assert.truthy(script:find(source, 1, true), script)
    program.write(folder .. "/typed.lua", script)
    local _, err, code = program.run { folder .. "/typed.lua" }
    assert.equal(0, code, err)
    stop()
  end)

  it("is refused beside -e or -i without a script", function()
    for _, words in ipairs { { "--view", "-e", "x = 1" }, { "--view", "-i" }, { "--view", "-v" } } do
      local _, err, code = program.run(words)
      assert.equal(2, code)
      assert.truthy(err:find "a script is missing")
    end
  end)
end)
