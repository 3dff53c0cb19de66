-- SPDX-License-Identifier: GPL-3.0-or-later
-- A tape (sequence of bytes) holds the state of a scene. A snapshot, a file and a scene that went on
-- without either have the same bits, for scenes of every kind of object in every state. The spec finds a
-- field that the tape leaves out: the restored scene is written to a file again, which must equal the first
-- file byte for byte.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local states = require "spec.scene.states"
local samples = require "contract.samples"
local core = sw.core
local probe = require "softworld.probe" -- of the program that runs specs

local cases = {}
for _, list in ipairs{ saving.cases, states.cases } do table.move(list, 1, #list, #cases + 1, cases) end

local function same(a, b, what)
  local where = saving.difference(a, b)
  assert(not where, where and ("%s: %s"):format(what, where))
end

local path = saving.file()
teardown(function() os.remove(path) end)

-- Returns the tape of a file without its serial. A file has, after the head with its checksum: the size of
-- the Lua side's part, that part, whether the scene is built, its name, its serial, the rest. The serial is
-- the number of the object made last. It never goes back: the number of an object that was taken back is
-- not used again.
local HEAD = 40
local function tape_of(scene)
  scene:save(path)
  local bytes = saving.read(path)
  local serial = HEAD + 8 + ("<I8"):unpack(bytes, HEAD + 1) + 4 + 4 + 64
  return bytes:sub(HEAD + 1, serial) .. bytes:sub(serial + 5)
end

local function same_bytes(a, b, what)
  if a == b then return end
  local at = 1
  while a:byte(at) == b:byte(at) do at = at + 1 end
  error(("%s: the tape is another one from byte %d of %d and %d on"):format(what, at, #a, #b), 2)
end

-- True if the words of a and b at this place are both addresses of blocks.
local function are_addresses(a, b, at)
  local x, y = ("<I8"):unpack(a, at), ("<I8"):unpack(b, at)
  return x > 1 << 40 and x < 1 << 47 and y > 1 << 40 and y < 1 << 47
end

-- Checks that every field has its value again, whether a tape contains it or not.
local function same_fields(a, b)
  assert.are.equal(#a, #b)
  for at = 1, a ~= b and #a - 7 or 0, 8 do
    if a:sub(at, at + 7) ~= b:sub(at, at + 7) and not are_addresses(a, b, at) then
      error(("restored: fields in memory differ from byte %d of %d on"):format(at, #a), 2)
    end
  end
end

-- Adds an object that makes a new system and that nothing touches; the next restore removes it.
local function disturb(scene)
  scene:obstacle{ name = "distant", shape = "sphere", radius = 0.1, at = { 0, 0, -50 } }
end

-- Kinds of objects that the cases contain, to be compared with the registries.
local met = {}
local function meet(scene)
  local items = core.items(scene)
  for i = 1, #items, 2 do
    local kind, name = items[i]:match "^(%S+) '(.*)'$"
    met[kind] = true
    if kind == "force" then met[name:match "%((.+)%)"] = true end
  end
  for _, name in ipairs(scene:names()) do
    local object = scene:find(name)
    if core.type(object) == "wire" then met[object.model] = true end
    local there = core.type(object) == "obstacle" and object.present
    if there then met[tostring(object.shape):match "%S+$"] = true end
  end
end

describe("one tape:", function()
  for _, case in ipairs(cases) do
    it(case.name, function()
      local plain = case.build()
      case.before(plain)
      case.after(plain)
      local wanted = saving.all(plain)

      local scene = case.build()
      case.before(scene)
      local snapshot = scene:snapshot()
      local here, tape = saving.all(scene), not case.functions and tape_of(scene)
      meet(scene)
      scene:restore(snapshot)
      local fields = probe.fields(scene)
      case.after(scene)
      same(wanted, saving.all(scene), "a snapshot disturbs")

      scene:restore(snapshot)
      same_fields(fields, probe.fields(scene))
      same(here, saving.all(scene), "restored")
      if tape then same_bytes(tape, tape_of(scene), "restored") end
      local later
      case.after(scene)
      same(wanted, saving.all(scene), "run on")
      later = scene:snapshot()

      disturb(scene)
      pcall(case.after, scene)
      scene:restore(snapshot)
      if tape then same_bytes(tape, tape_of(scene), "restored in a scene made anew") end
      case.after(scene)
      same(wanted, saving.all(scene), "run on in a scene made anew")

      disturb(scene)
      scene:restore(snapshot)
      scene:restore(later)
      local times = scene:frame_count()
      assert(times <= plain:frame_count())
      if times == plain:frame_count() then same(wanted, saving.all(scene), "a later snapshot") end

      if not tape then return end
      scene:restore(snapshot)
      scene:save(path)
      local resumed = case.build()
      resumed:resume(path)
      same_bytes(tape, tape_of(resumed), "read from a file")
    end)
  end

  it("was tested with every kind of object in the registries", function()
    local missing = {}
    for _, list in ipairs{ "forces", "shapes", "holds", "models" } do
      for _, kind in ipairs(samples.registry[list]) do
        if not kind.inner and not met[kind.name] then missing[#missing + 1] = kind.name end
      end
    end
    for _, kind in ipairs{ "particles", "tool", "join", "wire_contact" } do
      if not met[kind] then missing[#missing + 1] = kind end
    end
    assert.are.equal("", table.concat(missing, " "))
  end)
end)
