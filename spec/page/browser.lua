-- SPDX-License-Identifier: GPL-3.0-or-later
-- A Chromium without a window, driven by chromedriver (WebDriver, JSON over HTTP). It renders in software,
-- so no graphics card is needed.
local json = require "dkjson"
local http = require "socket.http"
local ltn12 = require "ltn12"

local browser = {}
browser.__index = browser

http.TIMEOUT = 120 -- [s], for one order

local function order(self, method, path, body)
  local text = body and json.encode(body) or method == "POST" and "{}" or nil
  local parts = {}
  local _, code = http.request { url = self.address .. path, method = method, sink = ltn12.sink.table(parts),
    source = text and ltn12.source.string(text) or nil,
    headers = { ["Content-Type"] = "application/json", ["Content-Length"] = text and #text or 0 } }
  local answer = json.decode(table.concat(parts), 1, json.null) or {}
  if code ~= 200 then
    local value = answer.value or {}
    error(("chromedriver: %s %s: %s %s"):format(method, path, tostring(code),
      tostring(value.message or table.concat(parts))), 0)
  end
  return answer.value
end

-- Starts chromedriver; self.root is its address if it runs.
local function start(self)
  self.pipe = assert(io.popen("exec chromedriver --port=0 2>&1", "r"))
  for line in self.pipe:lines() do
    local port = line:match "successfully on port (%d+)"
    if port then
      self.root = "http://127.0.0.1:" .. port
      return
    end
  end
  self.pipe:close()
end

--- Opens a browser with a window of this size [px]; close it after use.
function browser.open(width, height)
  local w, h = width or 1280, height or 720
  local self = setmetatable({ folder = os.tmpname() }, browser)
  os.remove(self.folder)
  assert(os.execute("mkdir -p '" .. self.folder .. "'"))
  for _ = 1, 3 do -- the port it draws may be taken meanwhile
    if not self.root then start(self) end
  end
  assert(self.root, "chromedriver does not start: sh scripts/setup.sh --test")
  self.address = self.root
  local session = order(self, "POST", "/session", { capabilities = { alwaysMatch = {
    browserName = "chrome",
    ["goog:loggingPrefs"] = { browser = "ALL" },
    ["goog:chromeOptions"] = { args = { "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
      "--use-angle=swiftshader", "--use-gl=angle", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
      "--hide-scrollbars", "--no-first-run", "--disable-background-networking", "--lang=en",
      "--user-data-dir=" .. self.folder, ("--window-size=%d,%d"):format(w, h) } } } } })
  self.address = self.root .. "/session/" .. session.sessionId
  order(self, "POST", "/timeouts", { script = 60000, pageLoad = 60000 })
  local size = self:run "return [window.innerWidth, window.innerHeight]"
  order(self, "POST", "/window/rect", { width = 2 * w - size[1], height = 2 * h - size[2] })
  return self
end

function browser:close()
  pcall(order, self, "DELETE", "")
  self.address = self.root
  pcall(order, self, "GET", "/shutdown")
  self.pipe:close()
  os.execute("rm -rf '" .. self.folder .. "'")
end

--- Opens an address, such as file:///..., and waits until the page is ready; foreign: a page that is not
-- ours.
function browser:go(address, foreign)
  order(self, "POST", "/url", { url = address })
  if foreign then return end
  self:wait "return document.body && document.body.classList.contains('ready')"
end

--- Runs a piece of JavaScript and returns its result; its arguments are arguments[0] and on.
function browser:run(script, ...)
  local value = order(self, "POST", "/execute/sync", { script = script,
    args = setmetatable({ ... }, { __jsontype = "array" }) })
  if value == json.null then return nil end
  return value
end

--- The same for a script that calls done(result), its last argument.
function browser:call(script, ...)
  local value = order(self, "POST", "/execute/async", {
    script = "const done = arguments[arguments.length - 1];" .. script,
    args = setmetatable({ ... }, { __jsontype = "array" }) })
  if value == json.null then return nil end
  return value
end

--- Waits until a script returns a true value; raises an error after 30 s.
function browser:wait(script)
  local value = self:call([[
    const begun = Date.now(), look = new Function(arguments[0]);
    (function again() {
      const value = look();
      if (value || Date.now() - begun > 30000) done(value); else setTimeout(again, 20);
    })();]], script)
  if not value then error("the page never got there: " .. script, 2) end
  return value
end

--- Presses keys, one after the other: characters, or names such as "ArrowRight".
local codes = { ArrowLeft = "\u{E012}", ArrowRight = "\u{E014}", Home = "\u{E011}", End = "\u{E010}",
  Tab = "\u{E004}", Enter = "\u{E007}", Escape = "\u{E00C}", Shift = "\u{E008}" }
function browser:keys(...)
  local actions = {}
  for _, key in ipairs { ... } do
    actions[#actions + 1] = { type = "keyDown", value = codes[key] or key }
    actions[#actions + 1] = { type = "keyUp", value = codes[key] or key }
  end
  order(self, "POST", "/actions", { actions = { { type = "key", id = "keys", actions = actions } } })
end

--- Moves the pointer along points of the window [px], pressed (true) or not.
function browser:pointer(points, pressed)
  local actions = {}
  for i, p in ipairs(points) do
    actions[#actions + 1] = { type = "pointerMove", duration = i > 1 and 30 or 0,
      x = math.floor(p[1]), y = math.floor(p[2]) }
    if i == 1 and pressed then actions[#actions + 1] = { type = "pointerDown", button = 0 } end
  end
  if pressed then actions[#actions + 1] = { type = "pointerUp", button = 0 } end
  order(self, "POST", "/actions", { actions = { { type = "pointer", id = "mouse", actions = actions,
    parameters = { pointerType = "mouse" } } } })
end

--- Returns a picture of the window, a PNG file as base64.
function browser:picture() return order(self, "GET", "/screenshot") end

--- Returns the console messages since the last call: a list of { level =, message = }.
function browser:console() return order(self, "POST", "/se/log", { type = "browser" }) end

return browser
