-- SPDX-License-Identifier: GPL-3.0-or-later
--- What pages of a live view can remove from a scene: the line that removes it, and the line that makes it
-- again if the state before cannot be restored. The script's own forces have numbers: scene:forces().
-- @module softworld.view.leaving
local core = require "softworld.core"
local build = require "softworld.scene.build"
local fixing = require "softworld.link.fixing"
local literal = require "softworld.scene.literal"
local record = require "softworld.scene.record"
local sealed = require "softworld.sealed"

local leaving = {}

local function fail(text, ...) error(text:format(...), 0) end

local function source(value, refer)
  return literal.of(value, refer or function() fail "this cannot be written" end, "value")
end

-- Methods that remove objects; all others are removed by scene:remove.
local verbs = { obstacle = "remove", clamp = "release", join = "release", tie = "release", clip = "release",
  channel = "release" }

local function class_of(object)
  return core.type(object) or (getmetatable(object) or {}).__name or type(object)
end

local function text_of(value)
  if type(value) ~= "string" or #value > 200 then fail "object is not a name" end
  return value
end

-- Returns a force of the script by its number, or raises an error.
local function force_of(scene, number)
  local force = math.type(number) == "integer" and scene:forces()[number]
  if not force or not force.held then fail "there is no such force" end
  return force
end

--- Returns the line that removes { object = name }, { made = serial of a force } or { force = number }.
function leaving.line(scene, m)
  if m.made ~= nil then
    if math.type(m.made) ~= "integer" then fail "made is not a number" end
    return ("made[%d]:release()"):format(m.made)
  end
  if m.force ~= nil then
    force_of(scene, m.force)
    return ("scene:remove(scene:forces()[%d])"):format(m.force)
  end
  local name, data = text_of(m.object), build.data(scene)
  local object = name ~= "" and scene:find(name) or fail "the scene itself cannot be taken away"
  local class = class_of(object)
  if class == "gripper" and object.left then fail("gripper '%s' was taken away already", name) end
  if class == "obstacle" then
    for _, g in ipairs(data.grippers) do
      for _, part in ipairs(not g.left and g.obstacles or {}) do
        if part == object then fail("'%s' is a part of gripper '%s'; remove the gripper", name, g.name) end
      end
    end
  end
  if verbs[class] then return ("scene:find(%s):%s()"):format(source(name), verbs[class]) end
  return ("scene:remove %s"):format(source(name))
end

--- Returns the name of what an order removes, for people.
function leaving.name(scene, m)
  if m.made ~= nil then return "a force" end
  if m.force ~= nil then return ("the force '%s'"):format(force_of(scene, m.force).kind) end
  return ("'%s'"):format(m.object)
end

-- --- making it anew ------------------------------------------------------------------------------------

-- Returns the call of the script that made an object, or nil.
local function call_of(scene, object)
  for _, call in ipairs(record.of(scene)) do
    if call.results[1] == object and core.type(call.self) == "scene" then return call end
  end
end

-- Returns an unused name.
local function free_name(scene, name)
  local taken, count = {}, 2
  for _, one in ipairs(scene:names()) do taken[one] = true end
  name = name:gsub(" %(%d+%)$", "")
  while taken[("%s (%d)"):format(name, count)] do count = count + 1 end
  return ("%s (%d)"):format(name, count)
end

local function refer(object)
  local fine, name = pcall(function() return object.name end)
  if not fine or type(name) ~= "string" then fail "this cannot be written" end
  return ("scene:find(%s)"):format(source(name))
end

-- Returns the line that makes an obstacle as it is now. Its old name stays taken, because its series has it.
local function obstacle_line(scene, object, call)
  local args = {}
  for key, value in pairs(call.args[1]) do args[key] = value end
  for key, value in pairs(object:get()) do
    if args[key] ~= nil or key == "at" or key == "rotation" then args[key] = value end
  end
  args.name = free_name(scene, object.name)
  return ("scene:obstacle %s"):format(source(args, refer))
end

--- Called before a removal. Returns the line that makes the object again as it is, for the case that a
-- process under way prevents going back; nil if only the state before can bring it back. serial: of a new
-- force.
function leaving.again(scene, m, serial)
  if m.made ~= nil then return nil end -- its own line makes it again
  local object = m.force and force_of(scene, m.force) or m.object and scene:find(m.object)
  local call = object and call_of(scene, object)
  local fine, line = pcall(function()
    if m.force and call then
      return ("made[%d] = scene:force %s"):format(serial, source(call.args[1], refer))
    end
    return call and class_of(object) == "obstacle" and obstacle_line(scene, object, call) or nil
  end)
  return fine and line or nil
end

-- --- what there is -------------------------------------------------------------------------------------

local function add_forces(scene, list, hidden)
  for number, force in ipairs(scene:forces()) do
    if not hidden[force] and core.exists(force) and force.held then
      list[#list + 1] = { name = force.kind, kind = "force", class = "force", force = number, leaves = true }
    end
  end
end

--- Returns what is in a scene by name: { { name, class, kind, leaves = it can be removed, force = its number
-- } }. made: forces added by hand, which are listed separately; hand: the force that pulls.
function leaving.objects(scene, made, hand)
  local data, list, grips, hidden = build.data(scene), {}, {}, { [hand or false] = true }
  local function add(name, kind, class)
    list[#list + 1] = { name = name, kind = kind, class = class, leaves = true }
  end
  for _, w in ipairs(data.wires) do add(w.name, w.object.model, "wire") end
  for _, p in ipairs(data.particles) do add(p.name, "particles", "particles") end
  for _, g in ipairs(data.grippers) do
    grips[g.name] = true
    for _, part in ipairs(g.obstacles or {}) do hidden[part] = true end
    for _, past in ipairs(g.past or {}) do hidden[past] = true end
    if not g.gone and not g.left then add(g.name, "gripper", "gripper") end
  end
  for _, o in ipairs(data.obstacles) do
    if core.exists(o.object) and o.object.present and o.name and not hidden[o.object] then
      add(o.name, o.shape, "obstacle")
    end
  end
  for _, hold in ipairs(data.holds) do
    local own = grips[hold.name:gsub("#%d+$", "")]
    if core.exists(hold.object) and hold.object.held and not own and not hidden[hold.object] then
      add(hold.name, hold.kind, "clamp")
    end
  end
  for _, it in ipairs(fixing.all(scene)) do
    hidden[it.object or false] = true
    hidden[rawget(sealed.fields(it), "damper") or false] = true
    add(it.name, class_of(it), class_of(it))
  end
  for _, join in ipairs(data.joins) do
    if core.exists(join.object) and join.object.held and not hidden[join.object] then
      add(join.name, "join", "join")
    end
  end
  for _, force in pairs(made or {}) do hidden[force] = true end
  add_forces(scene, list, hidden)
  return list
end

return leaving
