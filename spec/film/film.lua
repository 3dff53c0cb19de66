-- SPDX-License-Identifier: GPL-3.0-or-later
-- Reads a film in the format of csrc/film/film.h: inflates it (RFC 1950, 1951) and decodes its tracks.
local film = {}

-- --- inflate ------------------------------------------------------------------------------

-- Canonical Huffman code of a list of code lengths (from 1): returns decode(bit) -> symbol, from 0.
local function huffman(lengths)
  local count, offset, symbols = {}, {}, {}
  for l = 0, 15 do count[l] = 0 end
  for _, l in ipairs(lengths) do count[l] = count[l] + 1 end
  count[0] = 0
  offset[1] = 0
  for l = 1, 14 do offset[l + 1] = offset[l] + count[l] end
  for s, l in ipairs(lengths) do
    if l > 0 then
      symbols[offset[l]] = s - 1
      offset[l] = offset[l] + 1
    end
  end
  return function(bit)
    local code, first, index = 0, 0, 0
    for l = 1, 15 do
      code = code | bit()
      if code - count[l] < first then return symbols[index + code - first] end
      index, first = index + count[l], (first + count[l]) << 1
      code = code << 1
    end
    error "no such code"
  end
end

local length_base = { 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59, 67, 83,
  99, 115, 131, 163, 195, 227, 258 }
local length_extra = { 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0 }
local order = { 16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15 }

function film.inflate(bytes)
  local at, hold, held = 3, 0, 0
  local function bits(n)
    while held < n do
      hold, held, at = hold | bytes:byte(at) << held, held + 8, at + 1
    end
    local value = hold & (1 << n) - 1
    hold, held = hold >> n, held - n
    return value
  end
  local function bit() return bits(1) end
  local function tables()
    local n_length, n_distance, n_code = bits(5) + 257, bits(5) + 1, bits(4) + 4
    local lengths = {}
    for i = 1, 19 do lengths[i] = 0 end
    for i = 1, n_code do lengths[order[i] + 1] = bits(3) end
    local code, all = huffman(lengths), {}
    while #all < n_length + n_distance do
      local symbol = code(bit)
      local value, again = symbol, 1
      if symbol == 16 then value, again = all[#all], 3 + bits(2)
      elseif symbol == 17 then value, again = 0, 3 + bits(3)
      elseif symbol == 18 then value, again = 0, 11 + bits(7) end
      for _ = 1, again do all[#all + 1] = value end
    end
    return huffman{ table.unpack(all, 1, n_length) }, huffman{ table.unpack(all, n_length + 1) }
  end
  local function fixed()
    local lengths, distances = {}, {}
    for i = 0, 287 do lengths[i + 1] = i < 144 and 8 or i < 256 and 9 or i < 280 and 7 or 8 end
    for i = 1, 30 do distances[i] = 5 end
    return huffman(lengths), huffman(distances)
  end
  local out = {}
  local last
  repeat
    last = bits(1)
    local kind = bits(2)
    if kind == 0 then
      bits(held % 8)
      local size = bits(16)
      bits(16)
      for _ = 1, size do out[#out + 1] = bits(8) end
    else
      local code, distance_code
      if kind == 1 then code, distance_code = fixed() else code, distance_code = tables() end
      while true do
        local symbol = code(bit)
        if symbol == 256 then break end
        if symbol < 256 then
          out[#out + 1] = symbol
        else
          local length = length_base[symbol - 256] + bits(length_extra[symbol - 256])
          local d = distance_code(bit)
          local extra = d < 4 and 0 or d // 2 - 1
          local distance = d < 4 and d + 1 or (2 + d % 2 << extra) + 1 + bits(extra)
          for _ = 1, length do out[#out + 1] = out[#out + 1 - distance] end
        end
      end
    end
  until last == 1
  local parts = {}
  for i = 1, #out, 4096 do
    parts[#parts + 1] = string.char(table.unpack(out, i, math.min(i + 4095, #out)))
  end
  return table.concat(parts)
end

-- --- tracks -------------------------------------------------------------------------------

local kinds = { "wire", "value", "surface", "pressed", "particles", "obstacle", "hold", "tool" }

--- Returns { times, tracks = { { kind, channel, width, object, line, scale, offset, frames = { flat numbers }
-- } } }.
function film.read(packed)
  local bytes = film.inflate(packed)
  assert(bytes:sub(1, 8) == "SWFILM1\n")
  local frames, count, at = ("<I4I4"):unpack(bytes, 9)
  local result = { times = {}, tracks = {} }
  for f = 1, frames do result.times[f], at = ("<d"):unpack(bytes, at) end
  local function varint()
    local x, shift = 0, 0
    while true do
      local b = bytes:byte(at)
      at = at + 1
      x, shift = x | (b & 127) << shift, shift + 7
      if b < 128 then return x end
    end
  end
  for k = 1, count do
    local t = { frames = {} }
    local kind
    kind, t.channel, t.width, t.object, t.line, t.scale, t.offset, at = ("<BBI2I4I4dd"):unpack(bytes, at)
    t.kind = kinds[kind + 1]
    result.tracks[k] = t
    local values = t.kind == "value" or t.kind == "pressed" or kind > 4 and t.channel == 2
    local counts, before = {}, nil
    for f = 1, frames do counts[f] = varint() end
    for f = 1, frames do
      local now, flat, side = {}, {}, t.width * t.line
      for i = 1, counts[f] * t.width do
        local z = varint()
        local code = (z >> 1 ~ -(z & 1)) + (before and before[i] or 0)
        if i > side then code = code + now[i - side] - (before and before[i - side] or 0) end
        code = code & 0xffffffff
        now[i] = code
        local signed = code >= 1 << 31 and code - (1 << 32) or code
        flat[i] = values and code == 0 and 0 / 0 or signed * t.scale + t.offset
      end
      before = counts[f] == (counts[f + 1] or -1) and now or nil
      t.frames[f] = flat
    end
  end
  assert(at == #bytes + 1, "something follows")
  return result
end

--- Returns the track of a kind, an object (from 0) and a channel.
function film.track(read, kind, object, channel)
  for _, t in ipairs(read.tracks) do
    if t.kind == kind and t.object == object and t.channel == (channel or 0) then return t end
  end
end

return film
