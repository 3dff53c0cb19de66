-- SPDX-License-Identifier: GPL-3.0-or-later
--- Turns a run, or the present scene, into plain tables for charts, pictures, players and files.
-- @module softworld.run.document
local core = require "softworld.core"
local build = require "softworld.scene.build"
local drawn = require "softworld.scene.drawn"
local fixing = require "softworld.link.fixing"
local kept = require "softworld.run.kept"
local leave = require "softworld.scene.leave"
local runfiles = require "softworld.run.files"
local summary = require "softworld.run.summary"
local trust = require "softworld.run.trust"

local document = {}
local readable = runfiles.readable

--- Returns the present wires, for pictures.
function document.wires(scene) return leave.all(scene, "wire") end

-- Returns the entries of obstacles without the objects.
local function obstacles_of(data)
  local list = {}
  for i, o in ipairs(data.obstacles) do
    list[i] = {}
    for k, v in pairs(o) do list[i][k] = v end
    list[i].object = nil
  end
  return list
end

-- Adds clips as obstacles that stand still.
local function add_fixings(scene, doc)
  for _, f in ipairs(fixing.all(scene)) do
    for _, solid in ipairs(f:solids()) do
      doc.obstacles[#doc.obstacles + 1] = solid
      for _, frame in ipairs(doc.frames) do
        frame.obstacles[#doc.obstacles] = { position = { 0, 0, 0 }, rotation = { 1, 0, 0, 0 } }
      end
    end
  end
end

-- Adds what pictures show, in the frames with these numbers; nil: in all.
local function draw(self, doc, wires, numbers)
  doc.wires = wires
  doc.obstacles, doc.zones = obstacles_of(build.data(self.scene)), build.data(self.scene).zones
  for i = 1, numbers and #numbers or self.scene:frame_count() do
    doc.frames[i] = self.scene:frame(numbers and numbers[i] or i)
    doc.frames[i].number = numbers and numbers[i] or i
  end
  table.sort(doc.frames, function(a, b) return a.t < b.t end) -- those between others have the last numbers
  drawn.add(self.scene, doc)
  add_fixings(self.scene, doc)
end

-- Returns why a run has no frames, if it has none.
local function why_none(self)
  if self.steps == 0 then return "because it has no step: 0 s have passed" end
  return "because it was made with frames = false, or its scene has forgotten them"
end

-- Returns a run's data except its frames.
local function outline(self)
  local doc = { name = self.name, ok = self.ok, reason = self.reason, time = self.time,
    events = self.events,
    steps = self.steps, wall = self.wall, cpu = self.cpu, gravity = self.scene:gravity(),
    wires = {}, obstacles = {}, grips = {}, clamps = {}, frames = {}, none = why_none(self) }
  if not self.ok then return doc end
  doc.series, doc.summary = self:series(), kept.rows(self) or summary.of(self)
  local unmet = trust.unmet(self)
  doc.model = self.model and tostring(self.model)
  doc.met, doc.unmet = self.met, unmet and ("%s (%s)"):format(unmet, self.advice)
  for i, q in ipairs(self.quantities and self:error_bars() or {}) do
    doc.quantities = doc.quantities or {}
    doc.quantities[i] = { name = q:label(), value = q.value, error = q.error, unit = q.unit,
      asked = q.tolerance, met = q.met, where = q.where, when = q.when }
  end
  return doc
end

--- Returns plain tables of everything that charts, pictures and files need.
function document.of(self)
  if self.ok then readable(self, "results") end
  local doc = outline(self)
  if self.ok then draw(self, doc, document.wires(self.scene)) end
  return doc
end

-- Adds what a player draws of a scene.
local function describe(scene, doc, wires)
  local data = build.data(scene)
  doc.scene, doc.wires, doc.obstacles = scene, wires or document.wires(scene), obstacles_of(data)
  doc.zones = data.zones
  drawn.describe(scene, doc)
  for _, f in ipairs(fixing.all(scene)) do
    for _, one in ipairs(f:solids()) do
      one.name, one.part = one.name or f.name, f.name
      doc.obstacles[#doc.obstacles + 1] = one
    end
  end
  return doc
end

-- For a player: without frames, which it reads from the core.
function runfiles.described(self)
  readable(self, "frames", true)
  local doc = outline(self)
  doc.start, doc.from, doc.to = self.start, self.start - 1e-9, self.time + 1e-9
  return describe(self.scene, doc, not self.ok and self.drawn or nil)
end

-- Same for the present scene, with or without a run under way.
function runfiles.scene_described(scene)
  return describe(scene, { name = scene.name, ok = true, start = scene.time, time = scene.time,
    gravity = scene:gravity(), events = {} })
end

-- Returns what pictures of some frames need, without series and numbers.
function runfiles.moments(self, numbers)
  readable(self, "frames", true)
  local doc = { name = self.name, ok = self.ok, reason = self.reason, time = self.time,
    gravity = self.scene:gravity(), frames = {}, seen = {}, none = why_none(self) }
  draw(self, doc, self.ok and document.wires(self.scene) or self.drawn, numbers)
  drawn.add_particles(self.scene, doc)
  return doc
end

-- Same for the present scene.
function runfiles.present(scene)
  local doc = { name = scene.name, ok = true, time = scene.time, gravity = scene:gravity(),
    wires = document.wires(scene), obstacles = obstacles_of(build.data(scene)),
    zones = build.data(scene).zones,
    frames = { core.frame_now(scene) }, seen = {} }
  drawn.add(scene, doc)
  drawn.add_particles(scene, doc)
  add_fixings(scene, doc)
  return doc
end

-- Returns the document, also with the frames of a run that failed.
function runfiles.pictured(self)
  local doc = document.of(self)
  if not self.ok then
    readable(self, "frames", true)
    draw(self, doc, self.drawn)
  end
  return doc
end

return document
