-- SPDX-License-Identifier: GPL-3.0-or-later
-- Random cases: each call is made up from the objects that exist by then. A seed always gives the same case.
local sw = require "softworld"
local calls = require "fuzz.calls"
local checked = require "fuzz.checked"
local scenes = require "fuzz.scenes"
local words = require "fuzz.words"

local case = {}
local MOST = { wire = 5, particles = 2, scene = 3, obstacle = 8, gripper = 4, clamp = 10, force = 10,
  run = 6 }

local Maker = {}
Maker.__index = Maker

local function add(self, text)
  self.log(text)
  local results = table.pack(self.case:call(text))
  self.made = self.made + 1
  local n = tonumber(text:match "^v%[(%d+)%] = [^n]")
  if n and self.case.v[n] ~= nil then
    local kind = checked.kind_of(self.case.v[n])
    if kind then
      if package.loaded["fuzz.reach"] then package.loaded["fuzz.reach"].object(self.case.v[n], kind) end
      self.kinds[n] = kind
      self.of_kind[kind] = self.of_kind[kind] or {}
      table.insert(self.of_kind[kind], n)
      self.slots[#self.slots + 1] = n
    end
  end
  if not results[1] and type(results[2]) == "string" and self.last then -- names that it would have taken
    local list = results[2]:match "known are:? ([%w_ ,]+)"
    if list and not results[2]:find "unit" then
      local names = {}
      for name in list:gmatch "[%a_][%w_]*" do names[#names + 1] = name end
      self.learned[self.last] = #names > 0 and names or nil
    end
  end
  return results[1]
end

local function slot(self)
  self.last_slot = self.last_slot + 1
  return self.last_slot
end

-- Slots of existing objects; a few slots of removed objects stay in the list.
local function live(self, list)
  local there = {}
  for _, n in ipairs(list or {}) do
    if self.case.v[n] ~= nil or n % 20 == 0 then there[#there + 1] = n end
  end
  return there
end

local function pick(self, kind)
  local r = self.r
  if kind == "any" or r.chance(0.1 * r.hostility) then
    if #self.slots == 0 then return "nil" end
    return ("v[%d]"):format(r.of(self.slots))
  end
  local list = live(self, self.of_kind[kind])
  if not list or #list == 0 then return "nil" end
  return ("v[%d]"):format(list[r.chance(0.5) and #list or r.whole(1, #list)])
end

-- A member of the object at slot n, chosen by weight: its name, and whether it is a method.
local function member_of(self, n)
  local object, kind = self.case.v[n], self.kinds[n]
  local fine, names = pcall(checked.names_of, object)
  if not fine or #names == 0 then return "close", true end
  local sum, weights = 0, {}
  for i, name in ipairs(names) do
    weights[i] = calls.weights[kind .. "." .. name] or name == "close" and 0.03 or 1
    sum = sum + weights[i]
  end
  local at = self.r.share() * sum
  for i, name in ipairs(names) do
    at = at - weights[i]
    if at <= 0 then
      local there, value = pcall(function() return object[name] end)
      return name, not there or type(value) == "function"
    end
  end
  return names[#names], true
end

local function is_thin(wire)
  local fine, thin = pcall(function() return wire.length > 60 * wire.radius end)
  return not fine or thin
end

-- One call of a method or reading of a field, and its "kind.name".
local function use(self, n)
  local name, method = member_of(self, n)
  local call = self.kinds[n] .. "." .. name
  if not method then return ("v[%d].%s"):format(n, name), call end
  if call == "scene.process" then return nil, call end
  local arguments = calls.arguments(self.r, call, self.learned[call])
  if name == "remodel" and is_thin(self.case.v[n]) then -- it has tens of thousands of particles
    arguments = self.r.of{ "{ model = 'string' }", "{ model = 'rod' }",
      "{ model = 'tube', region = { 0.1, 0.12 } }", "{ model = 'radial', region = { 0, 0.02 } }" }
  end
  if self.r.chance(0.02 * self.r.hostility) then return ("v[%d].%s(%s)"):format(n, name, arguments), call end
  return ("v[%d]:%s(%s)"):format(n, name, arguments), call
end

local handling = { "grasp", "grasp", "grasp", "move", "move", "move", "release", "rotate", "press",
  "close_jaws",
  "open_jaws", "handover", "clip", "freeze", "thaw", "move_to", "state", "squeeze" }
local waiting = { "wait", "wait", "wait_until", "feed" }

local function statement(self, depth)
  local r = self.r
  local what = r.whole(1, 12)
  if what <= 6 and self.of_kind.gripper then
    local name = r.of(handling)
    return ("%s:%s(%s)"):format(pick(self, "gripper"), name, calls.arguments(r, "gripper." .. name))
  elseif what <= 9 then
    local name = r.of(waiting)
    return ("p:%s(%s)"):format(name, calls.arguments(r, "process." .. name))
  elseif what == 10 and depth < 2 then
    return ("p:step('%s', function() %s end)"):format(r.of{ "a", "b", "c" }, statement(self, depth + 1))
  elseif what == 11 then return r.of{ "coroutine.yield()", "collectgarbage()", "error 'of the process'",
    "F.raise_table()", "p:finish()", "return" } end
  if #self.slots == 0 then return "p:wait(0.01)" end
  return use(self, r.of(self.slots)) or "coroutine.yield(1)"
end

-- The scene of a gripper and a wire of this scene, if they exist.
local function of_one_scene(self, gripper)
  local g = self.case.v[tonumber(gripper:match "%d+" or 0)]
  local fine, scene = pcall(function() return g.scene end)
  if not fine then return pick(self, "scene"), pick(self, "wire") end
  local function slot_of(list, is)
    for _, n in ipairs(list or {}) do
      if self.case.v[n] ~= nil and is(self.case.v[n]) then return ("v[%d]"):format(n) end
    end
  end
  return slot_of(self.of_kind.scene, function(s) return s == scene end) or pick(self, "scene"),
    slot_of(self.of_kind.wire, function(w) return select(4, sw.core.number(w)) == scene end)
      or pick(self, "wire")
end

-- A sequence that a process engineer would write, with one gripper and one wire.
local function sequence(self)
  local r, g = self.r, pick(self, "gripper")
  local scene, w = of_one_scene(self, g)
  self.pending = ("v[%d] = %s:run{ dt = %s, max_steps = %d }"):format(slot(self), scene, r.of{ "4e-3", "0.01",
    "1e-3" }, r.whole(10, 150))
  local lines = { ("v[%d] = %s:process(function(p)"):format(slot(self), scene) }
  local function line(text)
    lines[#lines + 1] = r.chance(0.8) and ("  try(function() %s end)"):format(text) or "  " .. text
  end
  local function does(name, first)
    line(("%s:%s(%s)"):format(g, name, first or calls.arguments(r, "gripper." .. name)))
  end
  if r.chance(0.3) then does("approach", ("%s, { s = %s }"):format(w, r.between(0, 0.2))) end
  does "grasp"
  for _ = 1, r.whole(1, 4) do
    does(r.of{ "move", "move", "rotate", "press", "wait", "close_jaws", "open_jaws", "freeze", "thaw", "clip",
      "handover", "move_to", "state", "squeeze", "pressure_map", "over" })
    if r.chance(0.2) then line(("v[%d] = %s:snapshot()"):format(slot(self), scene)) end
  end
  does("release", r.of{ "", "", "{ speed = 0.1 }" })
  if r.chance(0.5) then does "retreat" end
  lines[#lines + 1] = "end)"
  return table.concat(lines, "\n")
end

local function process(self)
  if self.of_kind.gripper and self.r.chance(0.5) then return sequence(self) end
  local lines = { ("v[%d] = %s:process(function(p)"):format(slot(self), pick(self, "scene")) }
  for _ = 1, self.r.whole(1, 7) do
    local text = statement(self, 0)
    if text == "return" then text = "do return end" end
    lines[#lines + 1] = self.r.chance(0.8) and ("  try(function() %s end)"):format(
      text == "do return end" and text or text:find "^[vp%w_.%[%]]+$" and "return " .. text or text)
      or ("  %s"):format(text:find "^v%[%d+%]%.[%w_]+$" and "local _ = " .. text or text)
  end
  lines[#lines + 1] = "end)"
  return table.concat(lines, "\n")
end

local modules = { "sw.scene", "sw.load", "sw.cable", "sw.cables", "sw.calibrate", "sw.material", "sw.help",
  "sw.study", "sw.study", "sw.study", "sw.calibration", "trajectory.new",
  "trajectory.read", "tune.minimise", "cable.define", "calibrate.cell", "units", "core" }

local core_names = {}
for name, value in pairs(sw.core) do
  if type(value) == "function" and name ~= "fail_allocation" then
    core_names[#core_names + 1] = name
  end
end
table.sort(core_names)
local unit_names = {}
for name, value in pairs(sw.units) do
  if type(value) == "function" then unit_names[#unit_names + 1] = name end
end
table.sort(unit_names)

local function of_module(self)
  local r = self.r
  local name = r.of(modules)
  if name == "sw.scene" and #(self.of_kind.scene or {}) >= MOST.scene then name = "sw.cable" end
  self.last = name
  local arguments = calls.arguments(r, name, self.learned[name])
  if name == "units" then return ("return sw.units.%s(%s)"):format(r.of(unit_names), arguments) end
  if name == "core" then return ("return core.%s(%s)"):format(r.of(core_names), arguments) end
  if not name:find "^sw" then name = "sw." .. name end
  return ("v[%d] = %s(%s)"):format(slot(self), name, arguments)
end

-- Wires of thousands of particles take long for a step, so they get few steps.
local function is_heavy(self)
  for _, n in ipairs(self.of_kind.wire or {}) do
    local fine, points = pcall(function() return self.case.v[n]:particles() end)
    if fine and #points > 3 * 400 then return true end
  end
  return false
end

local function step(self)
  if self.pending then
    local text = self.pending
    self.pending = nil
    return is_heavy(self) and text:gsub("max_steps = %d+", "max_steps = 10") or text
  end
  local r = self.r
  local what = r.whole(1, 100)
  self.last = nil
  if what <= 5 then return of_module(self) end
  if #self.slots == 0 then return ("v[%d] = sw.scene{}"):format(slot(self)) end
  if what <= 8 then return ("v[%d] = nil; collectgarbage()"):format(r.of(self.slots)) end
  if what <= 10 then
    return ("v[%d].%s = %s"):format(r.of(self.slots), r.of(words.names), words.value(r, r.of(words.names)))
  end
  local list = live(self, what <= 55 and self.of_kind.scene or self.slots) -- most objects come from scenes
  local n = #list > 0 and r.of(list) or r.of(self.slots)
  local text, call = use(self, n)
  self.last = call
  if not text then return process(self) end
  if (call == "scene.run" or call == "scene.settle") and is_heavy(self) then
    text = text:gsub("quasistatic = true", "quasistatic = false")
      :gsub("max_steps = %d+", "max_steps = 2"):gsub("max_iterations = %d+", "max_iterations = 4")
      :gsub("duration = [%d.e-]+", "duration = 1e-3")
  end
  local made = call:match "^scene%.(.*)"
  local count = made and self.of_kind[made] and #self.of_kind[made] or 0
  if made and MOST[made] and count >= MOST[made] and made ~= "run" then text = nil end
  if not text then return step(self) end
  if what == 11 then return ("core.fail_allocation(%d); local _ = %s"):format(r.whole(0, 30), text) end
  if text:find ":[%w_]+%(" then return ("v[%d] = %s"):format(slot(self), text) end
  return "return " .. text
end

-- The text of a call with one of its numbers replaced by a hostile value.
local function spoilt(r, text)
  local places = {}
  for from, to in text:gmatch "= ()%-?%d[%d%.e%-]*()" do places[#places + 1] = { from, to } end
  if #places == 0 then return text end
  local at = r.of(places)
  return text:sub(1, at[1] - 1) .. words.hostile(r) .. text:sub(at[2])
end

-- A scene with a wire, so that most calls have an object to work on.
local function begin(self)
  local r = self.r
  if r.chance(0.8) then
    r.of(scenes.list)(function(text)
      local n = slot(self)
      if r.chance(2 * r.hostility) then text = spoilt(r, text) end
      add(self, ("v[%d] = %s"):format(n, text))
      return ("v[%d]"):format(n)
    end, r)
    return
  end
  local n = slot(self)
  add(self, ("v[%d] = sw.scene(%s)"):format(n, r.chance(0.7) and "{}" or calls.arguments(r, "sw.scene")))
  for _ = 1, r.whole(1, 2) do
    add(self, ("v[%d] = v[%d]:wire(%s)"):format(slot(self), n, calls.arguments(r, "scene.wire")))
  end
  if r.chance(0.5) then add(self,
    ("v[%d] = v[%d]:obstacle{ shape = 'plane', friction = 0.3 }"):format(slot(self), n)) end
  if r.chance(0.6) then add(self, ("v[%d] = v[%d]:gripper{}"):format(slot(self), n)) end
  if r.chance(0.5) then
    add(self, ("v[%d] = v[%d]:clamp(%s, { s = 0 })"):format(slot(self), n, pick(self, "wire")))
  end
end

--- Makes up and runs `count` calls. options: files (folder), log(text) before each call, report(kind, text)
-- for each finding.
function case.run(seed, count, options)
  local self = setmetatable({ log = options.log, case = checked.new(options.files, options.report),
    kinds = {},
    of_kind = {}, slots = {}, learned = {}, made = 0, last_slot = 0 }, Maker)
  self.case.slow = options.slow or self.case.slow
  local function object(kind) return pick(self, kind) end
  local draw = words.source(seed, 0, object)
  self.r = draw
  draw.hostility = draw.of{ 0, 0.01, 0.03, 0.08, 0.25 }
  begin(self)
  while self.made < count do
    if #live(self, self.of_kind.scene) == 0 or self.r.chance(0.01) then begin(self)
    else add(self, step(self)) end
  end
  self.case:finish()
  return self.made
end

--- Runs the calls of a list of texts again.
function case.replay(list, options)
  local done = checked.new(options.files, options.report)
  done.slow = options.slow or done.slow
  for _, text in ipairs(list) do
    if options.log then options.log(text) end
    done:call(text)
  end
  done:finish()
end

return case
