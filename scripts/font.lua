-- SPDX-License-Identifier: GPL-3.0-or-later
-- Extracts outlines of a TrueType font's letters for pictures: lua5.4 scripts/font.lua FONT.ttf OUTPUT
-- csrc/draw/text.c describes the output. Curves become straight lines.
local input, output = arg[1], arg[2]

local file = assert(io.open(input, "rb"))
local font = file:read "a"
file:close()

local STEPS = 4 -- lines for each curve

local function read(format, at) return (">" .. format):unpack(font, at + 1) end

local tables = {}
for k = 0, read("I2", 4) - 1 do
  local name, _, at, size = read("c4I4I4I4", 12 + 16 * k)
  tables[name] = { at = at, size = size }
end

assert(read("I2", tables.head.at + 18) == 2048, "a font of 2048 units is expected")
local long_places = read("i2", tables.head.at + 50) == 1
local metrics = read("I2", tables.hhea.at + 34)

local function place_of(glyph)
  if long_places then
    return read("I4", tables.loca.at + 4 * glyph), read("I4", tables.loca.at + 4 * glyph + 4)
  end
  return 2 * read("I2", tables.loca.at + 2 * glyph), 2 * read("I2", tables.loca.at + 2 * glyph + 2)
end

local function advance_of(glyph)
  return read("I2", tables.hmtx.at + 4 * math.min(glyph, metrics - 1))
end

-- Returns a map from code point to glyph, from the table of format 4.
local function characters()
  local at
  for k = 0, read("I2", tables.cmap.at + 2) - 1 do
    local platform, encoding, offset = read("I2I2I4", tables.cmap.at + 4 + 8 * k)
    local place = tables.cmap.at + offset
    if platform == 3 and encoding == 1 and read("I2", place) == 4 then at = place end
  end
  assert(at, "the font has no table of characters that is known here")
  local count, map = read("I2", at + 6) // 2, {}
  for k = 0, count - 1 do
    local last = read("I2", at + 14 + 2 * k)
    local first = read("I2", at + 16 + 2 * count + 2 * k)
    local delta = read("I2", at + 16 + 4 * count + 2 * k)
    local where = at + 16 + 6 * count + 2 * k
    local offset = read("I2", where)
    for code = first, math.min(last, 0xfffe) do
      local glyph = offset == 0 and code or read("I2", where + offset + 2 * (code - first))
      if glyph ~= 0 then map[code] = (glyph + delta) % 65536 end
    end
  end
  return map
end

local outlines_of

local function parts_of(at)
  local list, more = {}, true
  while more do
    local flags, glyph = read("I2I2", at)
    at = at + 4
    local x, y
    if flags & 1 ~= 0 then x, y, at = read("i2i2", at) else x, y, at = read("i1i1", at) end
    at = at - 1
    assert(flags & (8 | 64 | 128) == 0, "parts of letters that are turned or scaled are not known here")
    for _, outline in ipairs(outlines_of(glyph)) do
      local moved = {}
      for i, p in ipairs(outline) do moved[i] = { p[1] + x, p[2] + y, on = p.on } end
      list[#list + 1] = moved
    end
    more = flags & 32 ~= 0
  end
  return list
end

-- Reads the coordinates of one direction: differences of one byte, two bytes, or none.
local function coordinates(at, flags, short, same)
  local list, value = {}, 0
  for i, flag in ipairs(flags) do
    if flag & short ~= 0 then
      value = value + (flag & same ~= 0 and 1 or -1) * read("I1", at)
      at = at + 1
    elseif flag & same == 0 then
      value = value + read("i2", at)
      at = at + 2
    end
    list[i] = value
  end
  return list, at
end

function outlines_of(glyph)
  local from, to = place_of(glyph)
  if from == to then return {} end
  local at = tables.glyf.at + from
  local count = read("i2", at)
  at = at + 10
  if count < 0 then return parts_of(at) end
  local ends, flags = {}, {}
  for k = 1, count do ends[k] = read("I2", at + 2 * k - 2) + 1 end
  at = at + 2 * count
  at = at + 2 + read("I2", at)
  while #flags < ends[count] do
    local flag = read("I1", at)
    at = at + 1
    local times = 1
    if flag & 8 ~= 0 then times, at = 1 + read("I1", at), at + 1 end
    for _ = 1, times do flags[#flags + 1] = flag end
  end
  local x, y
  x, at = coordinates(at, flags, 2, 16)
  y = coordinates(at, flags, 4, 32)
  local list, first = {}, 1
  for _, last in ipairs(ends) do
    local outline = {}
    for i = first, last do outline[#outline + 1] = { x[i], y[i], on = flags[i] & 1 ~= 0 } end
    list[#list + 1], first = outline, last + 1
  end
  return list
end

local function middle(a, b) return { (a[1] + b[1]) / 2, (a[2] + b[2]) / 2, on = true } end

-- Returns an outline of straight lines only. Between two successive off-curve points the curve passes
-- through their middle.
local function straight(outline)
  local full, out = {}, {}
  for i, p in ipairs(outline) do
    local before = outline[i > 1 and i - 1 or #outline]
    if not p.on and not before.on then full[#full + 1] = middle(before, p) end
    full[#full + 1] = p
  end
  for i, p in ipairs(full) do
    if p.on then
      out[#out + 1] = p
    else
      local a, b = full[i > 1 and i - 1 or #full], full[i % #full + 1]
      for k = 1, STEPS - 1 do
        local t = k / STEPS
        local u = 1 - t
        out[#out + 1] = { u * u * a[1] + 2 * u * t * p[1] + t * t * b[1],
          u * u * a[2] + 2 * u * t * p[2] + t * t * b[2] }
      end
    end
  end
  return out
end

local map, letters, count = characters(), {}, 0
local function add(code)
  local glyph = map[code]
  if not glyph then return end
  local outlines = outlines_of(glyph)
  local parts = { ("<I2I2I2"):pack(code, advance_of(glyph), #outlines) }
  for _, outline in ipairs(outlines) do
    local points = straight(outline)
    parts[#parts + 1] = ("<I2"):pack(#points)
    for _, p in ipairs(points) do
      parts[#parts + 1] = ("<i2i2"):pack(math.floor(p[1] + 0.5), math.floor(p[2] + 0.5))
    end
  end
  letters[#letters + 1], count = table.concat(parts), count + 1
end
for code = 32, 126 do add(code) end
for code = 160, 255 do add(code) end
for code = 0x391, 0x3c9 do add(code) end -- Greek
for _, code in ipairs { 0x2013, 0x2014, 0x2212, 0x2264, 0x2265, 0x2026 } do add(code) end

local out = assert(io.open(output, "wb"))
out:write(("<I2"):pack(count), table.concat(letters))
out:close()
