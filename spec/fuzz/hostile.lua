-- SPDX-License-Identifier: GPL-3.0-or-later
-- Hostile arguments for random calls, besides numbers and texts: tables that raise errors, and callbacks
-- that do what a callback should not do.
local sw = require "softworld"
local core = sw.core

local hostile = { acted = 0 } -- how often a callback changed an object

local function raises() error("raised by the caller", 0) end

--- Tables and texts.
local function tables()
  local T = {}
  T.raise = setmetatable({}, { __index = raises, __newindex = raises, __len = raises, __pairs = raises,
    __tostring = raises, __call = raises, __eq = raises, __lt = raises, __le = raises, __unm = raises,
    __add = raises, __concat = raises, __close = raises })
  T.self = {}
  T.self[1], T.self.from, T.self.points, T.self.tolerance = T.self, T.self, T.self, T.self
  T.names = setmetatable({}, { __name = 12, __index = function(_, key) return key end })
  T.string = setmetatable({}, { __tostring = function() return {} end, __name = "wire" })
  T.long = {}
  for i = 1, 3000 do T.long[i] = i end
  T.obj = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
  T.stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    .. "endloop\nendfacet\nendsolid a\n"
  return T
end

-- Callbacks that do not depend on an object.
local function plain(v)
  local F, count, marked = {}, 0, { "thrown by the caller" }
  hostile.marked = marked
  F.raise = raises
  function F.raise_table() error(marked, 0) end
  function F.yield()
    if coroutine.isyieldable() then coroutine.yield() end
    return 0.01
  end
  function F.nonsense() return "x", {}, print end
  function F.nans(_, _, _, f)
    if type(f) == "table" then f[1] = 0 / 0 end
    return 0 / 0, { 0 / 0, 0, 0 }
  end
  function F.collect()
    count = count + 1
    if count < 20 then collectgarbage() end
    return 0.01
  end
  function F.nothing() end
  function F.number(_, _, _, f)
    if type(f) == "table" and f[3] then f[3] = f[3] + 0.001 end
    return 0.01
  end
  function F.way(t)
    t = type(t) == "number" and t or 0
    return { 0.01 * t, 0.02 * math.sin(t), 0 }
  end
  function F.predicate()
    count = count + 1
    return count % 3 == 0
  end
  function F.parabola(x)
    if type(x) == "table" then return x[1] ^ 2 + (x[2] or 1) ^ 2 end
    return type(x) == "number" and (x - 0.1) ^ 2 or 0
  end
  function F.clear()
    for key in pairs(v) do v[key] = nil end
    collectgarbage()
    return 0.01
  end
  return F
end

-- Callbacks that change an object; each does so only a few times.
local function with_objects(F, v)
  local function make(name, act)
    F[name .. "_it"] = function(object)
      local left = 3
      return function()
        left = left - 1
        if left >= 0 then
          hostile.acted = hostile.acted + 1
          act(object)
        end
        return 0.01
      end
    end
  end
  make("release", function(object)
    if core.type(object) == "obstacle" then object:remove() else object:release() end
  end)
  make("close", function(object) object:close() end)
  make("run", function(scene) scene:run{ duration = 0.01, max_steps = 3 } end)
  make("settle", function(scene) scene:settle{ max_iterations = 5 } end)
  make("snapshot", function(scene) v.snapshot = scene:snapshot() end)
  make("save", function(scene) scene:save(v.dir .. "/a.sws") end)
  make("restore", function(scene) scene:restore(v.snapshot or scene:snapshot()) end)
  make("change", function(scene)
    scene:wire{ E = 1e8, density = 1000, radius = 0.002, from = { 0, 0, 1 }, to = { 0.2, 0, 1 },
      segments = 3 }
  end)
end

--- Returns T (tables and texts) and F (callbacks) for the objects v of a case.
function hostile.make(v)
  local F = plain(v)
  with_objects(F, v)
  return tables(), F
end

return hostile
