-- SPDX-License-Identifier: GPL-3.0-or-later
-- Speaks to the server of a live view as a browser does: requests and websockets (RFC 6455). Specs can also
-- send what no browser would send.
local socket = require "socket"

local websocket = {}
websocket.__index = websocket

local function connect(port)
  local c = assert(socket.tcp())
  c:settimeout(10)
  assert(c:connect("127.0.0.1", port))
  return c
end

--- Sends a request of these lines; returns the status and the full text of the answer.
function websocket.request(port, lines)
  local c = connect(port)
  c:send(table.concat(lines, "\r\n") .. "\r\n\r\n")
  local text, _, rest = c:receive "*a"
  c:close()
  text = text or rest or ""
  return tonumber(text:match "^HTTP/1%.1 (%d+)"), text
end

--- The lines of a request for the page; more replaces headers, a value of false leaves one out.
function websocket.get(port, path, more)
  local headers = { Host = "127.0.0.1:" .. port }
  for key, value in pairs(more or {}) do headers[key] = value or nil end
  local lines = { ("GET %s HTTP/1.1"):format(path) }
  for key, value in pairs(headers) do lines[#lines + 1] = ("%s: %s"):format(key, value) end
  return websocket.request(port, lines)
end

--- Opens a websocket; returns nil and the status if it is refused.
function websocket.open(port, path, more)
  local headers = { Host = "127.0.0.1:" .. port, Origin = "http://127.0.0.1:" .. port, Upgrade = "websocket",
    Connection = "Upgrade", ["Sec-WebSocket-Key"] = "c29mdHdvcmxkIHNwZWNz", ["Sec-WebSocket-Version"] = "13" }
  for key, value in pairs(more or {}) do headers[key] = value or nil end
  local c = connect(port)
  local lines = { ("GET %s HTTP/1.1"):format(path) }
  for key, value in pairs(headers) do lines[#lines + 1] = ("%s: %s"):format(key, value) end
  c:send(table.concat(lines, "\r\n") .. "\r\n\r\n")
  local first = c:receive "*l"
  local status = first and tonumber(first:match "^HTTP/1%.1 (%d+)")
  if status ~= 101 then
    c:close()
    return nil, status
  end
  repeat local line = c:receive "*l" until not line or line == ""
  return setmetatable({ socket = c }, websocket)
end

--- Sends a frame; options: opcode (text), size that the frame claims to have, last = false.
function websocket:send(text, options)
  options = options or {}
  local size, first = options.size or #text, (options.last == false and 0 or 128) + (options.opcode or 1)
  local head = size < 126 and string.pack(">BB", first, 128 + size)
    or size < 65536 and string.pack(">BBI2", first, 128 + 126, size)
    or string.pack(">BBI8", first, 128 + 127, size)
  return self.socket:send(head .. "\0\0\0\0" .. text) -- a mask of zeros
end

--- Sends bytes unchanged.
function websocket:raw(bytes) return self.socket:send(bytes) end

--- Returns the next message and its opcode; nil after a time [s], or nil and "closed" once the socket is
-- closed.
function websocket:receive(seconds)
  self.socket:settimeout(seconds or 5)
  local head, why = self.socket:receive(2)
  if not head then return nil, why end
  local first, size = head:byte(1, 2)
  if size == 126 then
    size = (">I2"):unpack((self.socket:receive(2)))
  elseif size == 127 then
    size = (">I8"):unpack((self.socket:receive(8)))
  end
  local body = size > 0 and self.socket:receive(size) or ""
  if first & 15 == 9 then -- ping
    self:send(body or "", { opcode = 10 })
    return self:receive(seconds)
  end
  if first & 15 == 8 then return nil, "closed" end
  return body, first & 15
end

--- Returns whether the server has closed the socket within a time [s].
function websocket:closed(seconds)
  local due = socket.gettime() + (seconds or 5)
  while socket.gettime() < due do
    local text, why = self:receive(math.max(0.01, due - socket.gettime()))
    if not text and why == "closed" then return true end
  end
  return false
end

function websocket:close() self.socket:close() end

return websocket
