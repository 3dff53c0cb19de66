-- SPDX-License-Identifier: GPL-3.0-or-later
--- The mixed grasp. Near the pads the wire becomes a mesh, which the pads squeeze. Once nothing moves there
-- any more, the grip is frozen: the gripper carries the wire rigidly as a rod, at the cost of a rod. When the
-- load comes near the most that the pads could bear, or the gripper opens, the mesh takes over again in the
-- state it was frozen in.
-- @module softworld.grip.mixed
local build = require "softworld.scene.build"
local number = require "softworld.output.number"
local process = require "softworld.run.process"
local untwisted = require "softworld.grip.untwisted"
local vec = require "softworld.vec"

local mixed = {}

local mesh_words = { "section", "spacing", "particles", "layers", "across", "model" }
-- Particles round a section in poses, unless the script says else. Pads that close from both sides press on
-- corners. With eight of them a section that lies on a table then stands on a corner, which is no state of
-- rest: a pose rolls it towards its side, and the pads hold it askew, like a nut. With ten it lies on a side
-- between the pads' corners [-].
local AROUND = { radial = 10, tube = 10 }
local BESIDE = 6 -- length of the mesh beyond the pads, in radii of the wire, unless region says else [-]
local LIMIT = 0.9 -- margin (forces and moments together) at which the pads take over again [-]
local STEADY = 0.005 -- relative change of force, and change of margin, within TIME that counts as none [-]
local TIME = 0.02 -- interval between looks at the force [s]
local WHOLE = TIME * (1 - 1e-6) -- the same, less rounding: else steps of 20 ms look every 40 ms [s]
local PATIENCE = 2 -- a grasp is frozen after this time at the latest, steady or not [s]

local function note(self, kind, report)
  self.events[#self.events + 1] = { kind = kind, time = self.scene.time, s = self.s,
    energy = report.energy_after - report.energy_before, before = report.before,
    after = report.after, force = report.force, moment = report.moment }
end

-- Raises the error of a remodel again, in the words of a grasp: its script gave no region, or another one.
local function explain(self, how, why)
  local wire, region = self.wire, how.region
  if type(why) ~= "string" then error(why, 0) end
  local plain = build.plain(why)
  local short, twist = plain:find("cover all of wire", 1, true), plain:match "twisted by (%S+ rad)"
  if not (short or twist) then error(plain, 0) end
  local what = twist and ("is twisted by %s, which the wire beside the mesh of a mixed grasp, from s = %s to "
      .. "%s, would lose"):format(twist, number.text(region[1], "m"), number.text(region[2], "m"))
    or ("is %s long, and the mesh of a mixed grasp, from s = %s to %s, with those round clamps, takes all of "
      .. "it"):format(number.text(wire.length, "m"), number.text(region[1], "m"), number.text(region[2], "m"))
  error(("gripper '%s': wire '%s' %s. Make all of it a mesh before: wire:remodel{ model = '%s' }; or %s")
    :format(self.name, wire.name, what, how.model, twist and "grasp it imposed"
      or "give a smaller region [m], or narrower pads, or grasp it by 'plates'"), 0)
end

--- Turns the wire into a mesh around the pads.
function mixed.prepare(self, args)
  local wire, how = self.wire, {}
  for _, word in ipairs(mesh_words) do how[word] = args[word] end
  how.model = how.model or "radial"
  how.body, how.section = how.section or "solid", nil
  if how.model == "tube" or how.model == "composite" then how.body = args.section end
  self.mesh_model, self.rod_model = how.model, wire.model
  if wire.model ~= "rod" and wire.model ~= "string" then return end -- it is a mesh already
  local half = self.width / 2 + BESIDE * wire.radius
  if args.region ~= nil then
    half = args.region / 2
  end
  how.region = { math.max(0, self.s - half), math.min(wire.length, self.s + half) }
  how.segments = wire.segments
  if build.data(self.scene).slow then how.particles = how.particles or AROUND[how.model] end
  local _, q = self.tool:pose()
  how.normal = vec.rotate(q, { 0, 1, 0 }) -- the pads close along it: they must not turn sections like a nut
  self.segments = wire.segments
  local fine, why = pcall(wire.remodel, wire, how)
  if not fine then explain(self, how, why) end
end

--- Waits until the squeeze is steady, then freezes the grip.
function mixed.settle(self, args)
  local p = process.current()
  self.margin = args.margin or LIMIT
  local last, since, quiet = self.tool:state(), self.scene.time, 0
  -- Jaws that arrive have up to 2 % less than their force, at some steps. This is no unrest.
  if args.force and not args.distance then last.squeeze = args.force end
  local late, wire = since + PATIENCE, self.wire
  p:wait_until(function()
    if not self.tool or not self.wire then -- another process let go, or a snapshot was restored
      if wire then build.present(wire) end
      error(("gripper '%s': it let go before its grasp came to rest"):format(self.name), 0)
    end
    local now, t = self.tool:state(), self.scene.time
    if t - since < WHOLE then return t >= late end
    local f = math.max(now.squeeze, 1e-12)
    local steady = math.abs(now.squeeze - last.squeeze) < STEADY * f
      and math.abs(now.margin - last.margin) < STEADY and now.slip - last.slip < 1e-6
    quiet = steady and quiet + 1 or 0
    last, since = now, t
    return quiet >= 2 or t >= late
  end)
  mixed.freeze(self)
end

--- Holds the wire rigidly in its present state between the pads; see grasp{ freeze = false }.
function mixed.freeze(self)
  if not self.tool or not self.wire or self.way ~= "mixed" then
    error(("gripper '%s': only a mixed grasp can be frozen"):format(self.name), 2)
  end
  if self.frozen then return self end
  local state, squeeze = self.tool:state(), self:squeeze()
  local report = build.call(3, self.tool.freeze, self.tool, self.wire)
  self.frozen = { squeeze = state.squeeze, normal = state.normal, most = state.most,
    opening = state.opening, section = squeeze, s1 = report.s1, s2 = report.s2 }
  self.tool:limit(self.margin or LIMIT)
  note(self, "frozen", report)
  return self
end

-- Returns to the pads and the mesh between them. next: what the jaws do then, "holds", "opens" or "leaves".
-- lets_go: the gripper is about to let go.
local function thaw(self, next, lets_go)
  if not self.frozen then return self end
  local torsion = untwisted.torsion(self.wire)
  local report = build.call(3, self.tool.thaw, self.tool, next)
  self.frozen = nil
  note(self, "thawed", report)
  untwisted.thawed(self, torsion, lets_go)
  self.events[#self.events].on = report.on
  if report.on then self.way = "plates" end -- the mesh is between another gripper's pads, or there is none
  return self
end

--- Returns to the pads and the mesh between them.
function mixed.thaw(self) return thaw(self, "holds", false) end

--- The same, of jaws that open.
function mixed.open(self) return thaw(self, "opens", false) end

--- The same, of a gripper that is about to let go.
function mixed.let_go(self) return thaw(self, "opens", true) end

--- The same, but the wire stays a rod, as it was before the grasp. A wire that was a mesh becomes one again.
function mixed.leave(self)
  local was_line = self.rod_model == "rod" or self.rod_model == "string"
  thaw(self, was_line and "leaves" or "opens", true)
  if was_line and self.wire.model == "rod" then -- with the edges of the mesh
    build.call(4, self.wire.remodel, self.wire, { model = self.rod_model, segments = self.segments })
  end
  return self
end

--- Thaws a frozen grip whose load exceeds what the pads could bear.
function mixed.lose(self, state)
  mixed.thaw(self)
  self.events[#self.events].margin = state.margin
end

--- Called when the jaws are open: turns the mesh near the pads back into a rod.
function mixed.finish(self)
  local rod = self.rod_model == "rod" or self.rod_model == "string"
  if rod and self.wire.model == self.mesh_model then
    build.call(4, self.wire.remodel, self.wire, { model = self.rod_model, segments = self.segments })
  end
end

return mixed
