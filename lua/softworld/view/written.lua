-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes the script of a scene that forms put together: a line of Lua for each item of the list, see
-- softworld.view.draft.
-- @module softworld.view.written
local checks = require "softworld.checks"
local core = require "softworld.core"
local fill = require "softworld.view.fill"
local functions = require "softworld.view.functions"
local literal = require "softworld.scene.literal"

--- processes: most processes of a script.
local written = { processes = 6 }

local MOST_LOCALS = 120 -- of the 200 that Lua allows

--- Classes in the order of their lines; rank: the place of a class.
local order = { "obstacle", "wire", "particles", "gripper", "hold", "fixing", "force", "contact", "observer",
  "step", "check" }
written.rank = {}
for i, class in ipairs(order) do written.rank[class] = i end

local function fail(text, ...) error(text:format(...), 0) end

-- Names that objects cannot have as variables, because the script and typed functions use them.
local taken_words = checks.set "scene sw p run require _ENV"
for word in pairs(functions.names()) do taken_words[word] = true end

-- Returns the variables of objects that other items refer to: { [name] = word }.
local function words_of(items)
  local needed, words, used, count = {}, {}, {}, 0
  for _, item in ipairs(items) do
    for _, name in ipairs(fill.names(item.kind, item.values)) do needed[name] = true end
  end
  for _, item in ipairs(items) do
    local name = item.name
    if name and needed[name] and literal.is_name(name) and not taken_words[name] and not used[name]
      and count < MOST_LOCALS then
      words[name], used[name], count = name, true, count + 1
    end
  end
  return words
end

local function in_order(items)
  local sorted, place = {}, {}
  for i, item in ipairs(items) do sorted[i], place[item] = item, i end
  table.sort(sorted, function(a, b)
    local ra, rb = written.rank[a.kind.class], written.rank[b.kind.class]
    if ra ~= rb then return ra < rb end
    return place[a] < place[b]
  end)
  return sorted
end

local function word_in(words, items)
  local known = {}
  for _, item in ipairs(items) do
    if item.name then known[item.name] = true end
  end
  return function(name)
    if not known[name] then fail("there is nothing named '%s'", name) end
    return words[name] or ("scene:find(%s)"):format(fill.source(name))
  end
end

-- Returns where functions are in the script: { from, to = lines of the script, what }.
local function places_of(lines, owners)
  local places, at = {}, 1
  for i, text in ipairs(lines) do
    local count = select(2, text:gsub("\n", ""))
    local item = owners[i]
    for _, field in ipairs(item and item.kind.fields or {}) do
      if field.type == "function" and item.values[field.name] then
        local before = text:sub(1, (text:find("function(" .. field.args .. ")\n", 1, true) or 1) - 1)
        local head = at + select(2, before:gsub("\n", ""))
        local size = 1 + select(2, item.values[field.name]:gsub("\n", ""))
        places[#places + 1] = { from = head + 1, to = head + size,
          what = ("%s of %s"):format(field.name, item.name or item.kind.kind:gsub("_", " ")) }
      end
    end
    at = at + count + 1
  end
  return places
end

local function steps_of(items, lines, word, texts, owners)
  for number = 1, written.processes do
    local own = {}
    for _, item in ipairs(items) do
      if item.kind.class == "step" and item.process == number then own[#own + 1] = item end
    end
    if #own > 0 then lines[#lines + 1] = "\nscene:process(function(p)" end
    for _, item in ipairs(own) do
      texts[item.id] = fill.line(item.kind, item.values, word)
      lines[#lines + 1], owners[#lines + 1] = "  " .. texts[item.id], item
    end
    if #own > 0 then lines[#lines + 1] = "end)" end
  end
end

--- Returns the script of a list, the line of each item by id, and where its functions are.
function written.script(now)
  local owners, texts, lines = {}, {}, { "-- Written by SoftWorld " .. core.version .. ".",
    'local sw = require "softworld"', "", "local scene = sw.scene " .. fill.source(now.scene) }
  local items = in_order(now.items)
  local words = words_of(items)
  local word = word_in(words, items)
  for _, item in ipairs(items) do
    if item.kind.class == "check" then
      texts[item.id] = fill.line(item.kind, item.values, word)
    elseif item.kind.class ~= "step" then
      local text = fill.line(item.kind, item.values, word)
      texts[item.id] = text
      owners[#lines + 1] = item
      lines[#lines + 1] = words[item.name] and ("local %s = %s"):format(item.name, text) or text
    end
  end
  steps_of(items, lines, word, texts, owners)
  return table.concat(lines, "\n") .. "\n", texts, places_of(lines, owners)
end

return written
