-- SPDX-License-Identifier: GPL-3.0-or-later
-- Finalisers that close or change a scene while a method reads its lists. Run it also under the
-- sanitizers (make asan): memory that was freed may still look right.
local sw = require "softworld"
local core = sw.core

-- A scene with something in each list, after a run.
local function make()
  local s = sw.scene{ name = "lists" }
  local v = { scene = s }
  v.wire = s:wire{ name = "one", E = 3e7, density = 1400, radius = 0.003, segments = 12,
    from = { 0, 0, 0.003 }, to = { 0.3, 0, 0.003 } }
  s:wire{ E = 3e7, density = 1400, radius = 0.003, segments = 12,
    from = { 0.1, -0.1, 0.0095 }, to = { 0.1, 0.1, 0.0095 } }
  s:wire_contact{}
  s:obstacle{ shape = "plane", friction = 0.3 }
  v.clamp = s:clamp(v.wire, { s = 0.3 })
  v.force = s:force{ kind = "drag", on = v.wire, linear = 0.1 }
  for k = 1, 8 do
    s:zone{ name = "zone" .. k, shape = "sphere", radius = 0.01, at = { 0, 0, k } }
  end
  s:run{ duration = 0.05, dt = 1e-3, progress = false, frames = true, wear = true }
  for k = 1, 40 do s:tell{ kind = "kind" .. k, object = "wire 'one'", text = "text " .. k } end
  return v
end

local readers = {
  events = function(v) return v.scene:events() end,
  frame = function(v) return v.scene:frame(2) end,
  ["the present frame"] = function(v) return core.frame_now(v.scene) end,
  ["times of frames"] = function(v) return core.frame_times(v.scene) end,
  ["presses in frames"] = function(v) return core.frames_press(v.scene, 1, 0, 0.5, {}) end,
  ["a sweep of frames"] = function(v) return core.frames_sweep(v.scene, 1, 0) end,
  zones = function(v) return core.zones(v.wire) end,
  touches = function(v) return v.scene:touches() end,
  ["a hold's log"] = function(v) return v.clamp:log() end,
  ["a wire's log"] = function(v) return v.wire:log() end,
  ["the log of energies"] = function(v) return core.energy_log(v.scene) end,
  wear = function(v) return core.worn(v.wire) end,
  items = function(v) return core.items(v.scene) end,
}

-- What a finaliser may do to the scene.
local acts = {
  ["closes the scene"] = function(v) v.scene:close() end,
  ["takes the wire away"] = function(v) v.scene:remove(v.wire) end,
  ["runs on"] = function(v) v.scene:run{ duration = 2e-3, dt = 1e-3, progress = false } end,
}

-- All in a value as one text, to compare values.
local function text_of(x)
  if type(x) ~= "table" then return tostring(x) end
  local keys, out = {}, {}
  for k in pairs(x) do keys[#keys + 1] = k end
  table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
  for i, k in ipairs(keys) do out[i] = tostring(k) .. "=" .. text_of(x[k]) end
  return "{" .. table.concat(out, ",") .. "}"
end

local collectors = {
  incremental = function() collectgarbage("incremental", 10, 1000, 2) end,
  generational = function() collectgarbage("generational", 1, 10) end,
}

-- Reads until a finaliser has acted; returns how often it read. A reading is that of the scene
-- before the act or after it; it never mixes both. It may fail after the act.
local function read_until_acted(v, read, act)
  local acted = false
  local function reading() return text_of(table.pack(pcall(read, v))) end
  local before = reading()
  for round = 1, 2000 do
    for _ = 1, 20 do
      setmetatable({}, { __gc = function()
        if acted then return end
        acted = true
        act(v)
      end })
    end
    local got = reading()
    assert.is_true(got == before or acted and got == reading(), "a reading that is neither")
    if acted then return round end
  end
end

describe("a finaliser that", function()
  for does, act in pairs(acts) do
    for mode, set in pairs(collectors) do
      it(does .. " while a method reads lists of the scene does no harm, " .. mode, function()
        for what, read in pairs(readers) do
          for _ = 1, 2 do
            local v = make()
            local ok, why = pcall(function()
              set()
              assert.is_truthy(read_until_acted(v, read, act), what .. ": no finaliser ran")
            end)
            collectgarbage("incremental", 200, 100, 13)
            assert.is_true(ok, why)
            v.scene:close()
          end
        end
      end)
    end
  end
end)

describe("the collector after readings", function()
  it("runs on, with bounded memory", function()
    local v = make()
    collectgarbage()
    collectgarbage()
    local before, most = collectgarbage "count", 0
    -- 40 events of 9 fields make about 20 KiB for each reading: 20 times the bound in all
    for _ = 1, 20000 do
      v.scene:events()
      most = math.max(most, collectgarbage "count")
    end
    assert.is_true(collectgarbage "isrunning")
    -- pause = 200: a cycle begins at twice the memory; it may double once more until it ends
    assert.is_true(most < 4 * before + 4096, most)
    v.scene:close()
  end)

  it("stays stopped if the script stopped it", function()
    local v = make()
    collectgarbage "stop"
    v.scene:events()
    local runs = collectgarbage "isrunning"
    collectgarbage "restart"
    assert.is_false(runs)
    v.scene:close()
  end)
end)
