-- SPDX-License-Identifier: GPL-3.0-or-later
-- Counts the methods that random calls reach: how often each was called, and how often without an error.
-- Watching wraps a function around each method, so places in messages may differ.
local core = require("softworld").core

local reach = { counts = {} }
local seen = {}

local function finish(count, fine, ...)
  if fine then count.fine = count.fine + 1 end
  if not fine then error((...), 0) end
  return ...
end

local function watched(method, count)
  return function(...)
    count.called = count.called + 1
    return finish(count, pcall(method, ...))
  end
end

--- Counts the calls of this class's methods from now on.
function reach.watch(kind, class)
  if seen[class] then return end
  seen[class] = true
  local names = {}
  for name, method in next, class do
    if type(name) == "string" and type(method) == "function" and name:sub(1, 2) ~= "__" then
      names[#names + 1] = name
    end
  end
  for _, name in ipairs(names) do
    local full = kind .. "." .. name
    reach.counts[full] = reach.counts[full] or { called = 0, fine = 0 }
    rawset(class, name, watched(class[name], reach.counts[full]))
  end
end

--- Watches all classes of the core, and classes made in Lua as soon as an object exists.
function reach.begin()
  for kind, class in pairs(core.class) do reach.watch(kind, class) end
end

function reach.object(object, kind)
  local meta = getmetatable(object)
  if type(object) == "table" and type(meta) == "table" then reach.watch(kind, meta) end
end

--- Returns the counts as lines of a file; sums those of many files.
function reach.text()
  local lines = {}
  for name, count in pairs(reach.counts) do
    lines[#lines + 1] = ("%s %d %d\n"):format(name, count.called, count.fine)
  end
  return table.concat(lines)
end

function reach.add(sums, text)
  for name, called, fine in text:gmatch "(%S+) (%d+) (%d+)\n" do
    local sum = sums[name] or { called = 0, fine = 0 }
    sum.called, sum.fine = sum.called + tonumber(called), sum.fine + tonumber(fine)
    sums[name] = sum
  end
end

--- Returns the called methods, the least reached first.
function reach.list(sums)
  local names = {}
  for name in pairs(sums) do names[#names + 1] = name end
  table.sort(names, function(a, b)
    if sums[a].fine ~= sums[b].fine then return sums[a].fine < sums[b].fine end
    return a < b
  end)
  local lines = {}
  for i, name in ipairs(names) do
    lines[i] = ("%8d of %8d  %s"):format(sums[name].fine, sums[name].called, name)
  end
  return table.concat(lines, "\n")
end

return reach
