-- SPDX-License-Identifier: GPL-3.0-or-later
-- The server of the live view: who is let in, which messages are accepted; pages never change the results of
-- a run.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local jsonread = require "softworld.output.jsonread"
local program = dofile "spec/host/program.lua"
local saving = require "spec.scene.saving"
local visitor = require "spec.page.visitor"
local websocket = require "spec.page.websocket"
local core = sw.core

local function scene_of()
  local scene = sw.scene { name = "served" }
  scene:obstacle { name = "floor", shape = "plane", friction = 0.3 }
  scene:wire { name = "wire", E = 5e7, density = 1500, radius = 0.003, segments = 30, from = { 0.3, 0, 0.1 },
    to = { -0.3, 0, 0.05 } }
  return scene
end

-- A scene with its view; returns port and path of its page too.
local function viewed(more)
  local args = { open = false }
  for key, value in pairs(more or {}) do args[key] = value end
  local scene = scene_of()
  local view = scene:view(args)
  local port, path = view.address:match "^http://127%.0%.0%.1:(%d+)(/%x+/)$"
  return scene, view, math.tointeger(port), path
end

local function run_of(scene) return scene:run { duration = 0.4, dt = 0.002 } end

local function bits_of(scene)
  assert(run_of(scene).ok)
  return saving.all(scene)
end

-- Waits until the server has noticed.
local function until_pages(view, count)
  local due = core.clock() + 5
  while view.pages ~= count and core.clock() < due do core.sleep(0.02) end
  assert.equal(count, view.pages)
end

describe("the server of a view", function()
  local scene, view, port, path

  setup(function() scene, view, port, path = viewed() end)
  teardown(function() view:close() end)

  it("gives its page to clients with the token, under a policy that lets nothing else in", function()
    local status, text = websocket.get(port, path)
    assert.equal(200, status)
    local token = path:match "%x+"
    assert.equal(32, #token) -- 128 bits
    assert.truthy(text:find("Content-Security-Policy: default-src 'none';", 1, true))
    assert.truthy(text:find(("connect-src ws://127.0.0.1:%d "):format(port), 1, true))
    assert.truthy(text:find("Referrer-Policy: no-referrer", 1, true)) -- the address is the secret
    assert.is_nil(text:find('http-equiv="Content-Security-Policy"', 1, true))
    assert.equal(200, (websocket.get(port, path, { Host = "localhost:" .. port })))
  end)

  it("refuses other tokens, paths, hosts and methods", function()
    for _, wrong in ipairs { "/", "/index.html", "/" .. ("0"):rep(32) .. "/", path:sub(1, -2), path .. "x",
      path .. "../../etc/passwd", path:upper():gsub("[^A-F]", "A"), "/%2e%2e" } do
      assert.is_true((websocket.get(port, wrong)) ~= 200, wrong)
    end
    for _, host in ipairs { "evil.example", "evil.example:" .. port, "127.0.0.1", "127.0.0.1:1",
      "127.0.0.1:" .. port .. ".x", false } do
      assert.is_true((websocket.get(port, path, { Host = host })) ~= 200, tostring(host))
    end
    assert.equal(405, (websocket.request(port, { "POST " .. path .. " HTTP/1.1", "Host: 127.0.0.1:" .. port,
      "Content-Length: 0" })))
  end)

  it("opens sockets only to its own page", function()
    local fine = websocket.open(port, path .. "s")
    assert.truthy(fine)
    fine:close()
    for _, origin in ipairs { "http://evil.example", "http://127.0.0.1:1", "null",
      "https://127.0.0.1:" .. port, "http://127.0.0.1:" .. port .. ".evil.example", false } do
      assert.is_nil(websocket.open(port, path .. "s", { Origin = origin }))
    end
    assert.is_nil(websocket.open(port, path .. "s", { Host = "evil.example:" .. port }))
    assert.is_nil(websocket.open(port, "/" .. ("0"):rep(32) .. "/s"))
    until_pages(view, 0)
  end)

  it("accepts eight pages", function()
    local pages = {}
    for k = 1, 8 do
      pages[k] = assert(websocket.open(port, path .. "s"))
      until_pages(view, k)
    end
    assert.is_nil(websocket.open(port, path .. "s"))
    for _, page in ipairs(pages) do page:close() end
    until_pages(view, 0)
    local again = assert(websocket.open(port, path .. "s"))
    again:close()
    until_pages(view, 0)
  end)

  it("sends a frame, and the next one once the page has drawn it", function()
    local page = assert(websocket.open(port, path .. "s"))
    local frames, kinds = 0, {}
    view:wait(0.3)
    while true do
      local text, opcode = page:receive(0.2)
      if not text then break end
      if opcode == 2 then
        frames = frames + 1
        assert.equal("\x78", text:sub(9, 9)) -- of zlib, after the numbers of scene and session
      else
        kinds[jsonread.decode(text).kind] = true
      end
    end
    assert.equal(1, frames)
    assert.is_true(kinds.scene and kinds.state and kinds.lines and kinds.forms and kinds.events)
    scene:set { gravity = { 0, 0, -1 } }
    scene:run { duration = 0.01, dt = 0.002 }
    local text, kind = page:receive(0.2)
    while text do
      assert.equal(1, kind) -- no frame: the first one was not drawn yet
      text, kind = page:receive(0.2)
    end
    page:send "a"
    view:wait(0.3)
    local _, opcode
    repeat _, opcode = page:receive(1) until opcode ~= 1
    assert.equal(2, opcode)
    page:close()
    until_pages(view, 0)
  end)

  it("closes pages that send too much at once, fragments, or binary frames", function()
    for _, say in ipairs {
      function(page) page:send(("x"):rep(65536)) end,
      function(page) page:send("{}", { last = false }) end,
      function(page) page:send("{}", { opcode = 2 }) end,
      function(page) page:raw(("\xff"):rep(100)) end,
    } do
      local page = assert(websocket.open(port, path .. "s"))
      say(page)
      assert.is_true(page:closed())
      page:close()
    end
    until_pages(view, 0)
  end)
end)

describe("a run that pages watch", function()
  local plain = bits_of(scene_of())

  local function same(prepare, more)
    local scene, view, port, path = viewed(more)
    local pages = prepare(function() return assert(websocket.open(port, path .. "s")) end, view)
    local bits = bits_of(scene)
    for _, page in ipairs(pages or {}) do page:close() end
    view:close()
    assert.is_nil(saving.difference(plain, bits))
    return scene
  end

  it("has the bits of a run without a view", function()
    same(function() end)
    same(function(open) return { open(), open() } end)
  end)

  it("has these bits when pages send garbage", function()
    math.randomseed(7)
    same(function(open)
      local page = open()
      for k = 1, 400 do
        local bytes = {}
        for i = 1, math.random(1, 60) do bytes[i] = string.char(math.random(0, 255)) end
        page:send(table.concat(bytes))
        if k % 5 == 0 then page:send(('{"do":%d}'):format(k)) end
      end
      for _, text in ipairs { "{}", "[]", "null", '"pause"', '{"do":null}', '{"do":"set"}',
        '{"do":"set","object":3}', '{"do":"set","object":"floor","values":{"friction":-1}}',
        '{"do":"nothing"}', '{"do":{}}', ("["):rep(5000), '{"do":"pull"}', '{"do":"reach","to":[1,2]}',
        '{"do":"speed","value":"fast"}', '{"do":"speed","value":-1}', '{"do":"back","id":99}', '{"do":"let"}',
        '{"do":"set","object":"\\u0000","values":{}}', '{"do":"run","duration":-1}' } do page:send(text) end
      core.sleep(0.3)
      return { page }
    end)
  end)

  it("is paused by a page, and ends in good order on its request", function()
    local scene, view, port, path = viewed()
    local page = assert(websocket.open(port, path .. "s"))
    page:send '{"do":"stop"}'
    core.sleep(0.2)
    local run = run_of(scene)
    assert.is_true(run.ok)
    assert.equal("stopped from the page", run.reason)
    page:close()
    view:close()
  end)

  it("continues when pages stop reading, and closes within two seconds", function()
    local scene, view, port, path = viewed()
    local pages = {}
    for k = 1, 8 do pages[k] = assert(websocket.open(port, path .. "s")) end
    local bits = bits_of(scene)
    assert.is_nil(saving.difference(plain, bits))
    local begun = core.clock()
    view:close()
    assert.is_true(core.clock() - begun < 2)
    for _, page in ipairs(pages) do page:close() end
  end)

  it("survives orders to remove objects that never existed", function()
    local scene, view = viewed()
    local page = visitor.open(view)
    for k, what in ipairs { '"made":7', '"made":7,"object":"nothing"', '"made":7,"force":"x"', '"made":"x"',
      '"made":[1]', '"force":7', '"force":"x"', '"object":"nothing"', '"object":""', '"object":[1]' } do
      page.socket:send(('{"do":"remove","ask":%d,%s}'):format(k, what))
    end
    page:hear(0.5)
    local none = "there is no such force"
    for k = 1, 3 do assert.same({ ask = k, ok = false, text = none }, page.answers[k]) end
    for k = 4, 10 do assert.is_false(page.answers[k].ok) end
    assert.same({ "floor", "wire" }, scene:names())
    page:close()
  end)

  it("never turns the texts of a page into Lua", function()
    local scene, view, port, path = viewed()
    local page = assert(websocket.open(port, path .. "s"))
    for _, text in ipairs {
      [[{"do":"set","object":"floor\"):set{} os.exit(3) --","values":{"friction":1}}]],
      [[{"do":"set","object":"floor","values":{"friction":"1 } os.exit(3) --"}}]],
      [[{"do":"set","object":"floor","values":{"friction = 1 } os.exit(3) --":1}}]],
      [[{"do":"pull","wire":"wire\" .. os.exit(3) .. \"","s":0,"to":[0,0,0],"force":1,"stiffness":1}]],
      [[{"do":"pull","wire":"wire","s":0,"to":[0,0,"0} os.exit(3)"],"force":1,"stiffness":1}]],
    } do page:send(text) end
    view:wait(0.5)
    assert.near(0.3, scene:find("floor"):get().friction, 0)
    page:close()
    view:close()
  end)
end)

describe("scene:view", function()
  it("reports a port that is taken, and wrong arguments", function()
    local _, view, port = viewed()
    local other = scene_of()
    local fine, message = pcall(function() other:view { port = port, open = false } end)
    assert.is_false(fine)
    assert.truthy(message:find("server_spec%.lua:%d+: scene:view: port %d+ is used by another program"),
      message)
    assert.error_matches(function() other:view { port = 70000 } end, "port = 70000")
    assert.error_matches(function() other:view { prt = 1 } end, "did you mean 'port'")
    view:close()
    assert.error_matches(function() view:wait(1) end, "has been closed")
    assert.error_matches(function() return view.adress end, "did you mean 'address'")
    local again = other:view { port = port, open = false }
    assert.equal(again, other:view())
    again:close()
  end)

  it("leaves Ctrl-C to the run, whether its page reads or not", function()
    local script = ([[
package.path = %q .. ";" .. package.path
local sw = require "softworld"
local scene = sw.scene {}
scene:wire { E = 5e7, density = 1500, radius = 0.003, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
local view = scene:view { open = false }
local port, path = view.address:match ":(%%d+)(/.*)"
local page = require "spec.page.websocket".open(port, path .. "s")
local begun
local fine = pcall(scene.run, scene, { duration = 1e6, dt = 0.001 })
begun = sw.core.clock()
view:close()
print(fine, sw.core.clock() - begun < 2)
]]):format(require "lfs".currentdir() .. "/?.lua")
    local name = program.write(os.tmpname(), script)
    local out = program.run({ name }, { before = "env --default-signal=INT", signals = { 0.5 } })
    os.remove(name)
    assert.equal("false\ttrue\n", out)
  end)
end)
