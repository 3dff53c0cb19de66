-- SPDX-License-Identifier: GPL-3.0-or-later
-- A page of a live view without a browser: it sends orders, receives messages, and runs the script that it
-- would save.
local json = require "softworld.output.json"
local jsonread = require "softworld.output.jsonread"
local websocket = require "spec.page.websocket"

local visitor = {}
visitor.__index = visitor

--- Opens a page of this view: view, socket, got = the last message of each kind, answers = by the mark of the
-- order.
function visitor.open(view)
  local port, path = view.address:match "^http://127%.0%.0%.1:(%d+)(/%x+/)$"
  local socket = assert(websocket.open(math.tointeger(port), path .. "s"))
  return setmetatable({ view = view, socket = socket, got = {}, answers = {} }, visitor)
end

--- Receives all waiting messages, after the view has waited for a time [s] if no run is under way.
function visitor:hear(seconds)
  if seconds then self.view:wait(seconds) end
  while true do
    local text, opcode = self.socket:receive(0.02)
    if not text then return end
    local m = opcode == 1 and jsonread.decode(text)
    if m then self.got[m.kind] = m else self.socket:send "a" end
    for _, answer in ipairs(m and m.kind == "answers" and m.answers or {}) do
      self.answers[answer.ask] = answer
    end
  end
end

--- Sends an order, a table; its answer has the mark.
function visitor:ask(order, mark)
  order.ask = mark
  self.socket:send(json.encode(order))
end

--- Adds an object or step to the list of forms; process: of a step.
function visitor:add(class, kind, values, process, mark)
  self:ask({ ["do"] = "draft", what = "add", class = class, kind = kind, values = values, process = process },
    mark)
end

--- The final scene of the script that the page would save.
function visitor:by_script()
  local text = assert(self.got.lines.script, self.got.lines.unsaved)
  return assert(load((text:gsub("run:summary%(%)\n$", "return scene"))))()
end

--- Closes the page and its view.
function visitor:close()
  self.socket:close()
  self.view:close()
end

return visitor
