-- SPDX-License-Identifier: GPL-3.0-or-later
--- Checks that another program has written its file to the end: gnuplot and ffmpeg report no error if the
-- disk is full.
-- @module softworld.output.whole
local sink = require "softworld.output.sink"

local whole = {}

local TAIL = 64 -- enough for the end of each format [B]
local ends = { svg = "</svg>%s*$", png = "IEND\xAE\x42\x60\x82$", pdf = "%%%%EOF%s*$", gif = "\x3B$" }

-- Returns the size that an EBML file declares: that of its header and of its one segment; nil if it declares
-- none.
local function size_of_webm(file)
  local at = 0
  for _ = 1, 2 do -- the header, then the segment: identifier of 4 bytes, length, content
    file:seek("set", at)
    local head = file:read(12)
    if not head or #head < 12 then return math.huge end
    local first, bytes = head:byte(5), 1
    while bytes < 8 and first < 0x100 >> bytes do bytes = bytes + 1 end
    local length = string.unpack(">I" .. bytes, head, 5) & (1 << 7 * bytes) - 1
    if length == (1 << 7 * bytes) - 1 then return nil end
    at = at + 4 + bytes + length
  end
  return at
end

local function is_whole(file, kind)
  local size = file:seek "end"
  if size == 0 then return false end
  if kind == "webm" then return (size_of_webm(file) or size) <= size end
  file:seek("set", math.max(0, size - TAIL))
  return not ends[kind] or file:read "a":find(ends[kind]) ~= nil
end

--- Gives a finished temporary file its final name, as sink.commit. If the file is cut short, it is removed
-- and an error says so.
function whole.commit(temporary, path)
  local file <close> = io.open(temporary, "rb")
  if file and not is_whole(file, sink.extension(path)) then
    sink.discard(temporary)
    sink.fail("cannot write %s: the file was cut short; is the disk full?", path)
  end
  sink.commit(temporary, path)
end

return whole
