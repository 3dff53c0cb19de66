-- SPDX-License-Identifier: GPL-3.0-or-later
--- gripper:clip: presses the wire that a gripper holds through the mouth of a clip.
-- @module softworld.link.clipping
local build = require "softworld.scene.build"
local process = require "softworld.run.process"
local rows = require "softworld.rows"
local checks = require "softworld.checks"
local number = require "softworld.output.number"
local vec = require "softworld.vec"
local Clip = require "softworld.link.clip"
local Gripper = require "softworld.grip.gripper"

local into = rows.call("gripper:clip", "{...}", "presses its wire into a clip; in a process only", {
  gives = "force of the gripper, peak_force of the lips [N], s [m], duration [s]",
  example = "hand:clip { into = clip, speed = 0.1, max_force = 40 }",
  { "into", "clip", "-", "clip to press the wire into", required = true },
  { "speed", "number", "m/s", "into the mouth", min = 0, above = true, default = 0.02 },
  { "approach_speed", "number", "m/s", "speed before, over the mouth", min = 0, above = true, default = 0.1 },
  { "align", "boolean", "-", "first line up over the mouth", usual = "true" },
  { "max_force", "number", "N", "above this force it stops with an error", min = 0, above = true,
    usual = "5 times insertion" },
  { "overtravel", "number", "m", "beyond the seat", min = 0, usual = "the wire's radius" },
  { "fail", "boolean", "-", "false: returns nil and why where it does not go in", usual = "true" },
})
local STEPS = 20 -- checks of the force on the way over the lips
-- Where the wire is within such a step of the lips' top, there are FINE times as many: where the tool stops
-- decides the pull on the wire from then on (spec/scene/clip_stops_spec).
local FINE = 32
local HOME = 0.5 -- way that the tool goes on once the wire is seated, over the way between two checks [-]
local USUAL_LIMIT = 5 -- default of max_force over the insertion force

local function checked(self, args)
  if getmetatable(self) ~= Gripper then error("gripper:clip is a method: call it with a colon", 0) end
  checks.keys(into.name, args, into.known, 0)
  local what = ("gripper '%s': clip"):format(self.name)
  if getmetatable(args.into) ~= Clip or args.into.scene ~= self.scene or not args.into:exists() then
    error(what .. ": into is required, a clip of the gripper's scene that is still there", 0)
  end
  if not (self.hold or self.wire) then -- imposed, or between pads
    error(what .. ": it holds nothing; grasp a wire before", 0)
  end
  process.within(self.scene, "gripper:clip",
    what .. ": works inside a process only, because it watches the force during the move")
  args = into:read(args, what)
  args.max_force = args.max_force or USUAL_LIMIT * args.into.insertion
  return args, what
end

-- Returns the height of the tool over the seat, towards the mouth [m].
local function place(self, clip)
  return vec.dot(vec.add(self:position(), clip.at, -1), clip.direction)
end

-- Returns where the wire nearest to the seat passes the clip: height, offset across [m], its
-- radius and the height of the lips for this wire [m]; its tilt against the clip's axis [rad]; the wire. nil
-- if no wire passes.
local function passing(clip)
  local best, across = nil, vec.cross(clip.direction, clip.axis)
  local function look(wire, a, b, along_a, along_b)
    local d = vec.add(a, vec.add(b, a, -1), along_a / (along_a - along_b))
    local u, v = vec.dot(d, clip.direction), vec.dot(d, across)
    if best and u * u + v * v >= best.u ^ 2 + best.v ^ 2 then return end
    local edge = vec.add(b, a, -1)
    local tilt = math.acos(math.min(1, math.abs(along_b - along_a) / vec.norm(edge)))
    best = { u = u, v = v, wire = wire, tilt = tilt }
  end
  for _, entry in ipairs(build.data(clip.scene).wires) do
    local x = (clip.on == nil or clip.on == entry.object) and entry.object:positions() or {}
    local last, before
    for i = 1, #x, 3 do
      local d = vec.add({ x[i], x[i + 1], x[i + 2] }, clip.at, -1)
      local along = vec.dot(d, clip.axis)
      if last and (along > 0) ~= (before > 0) then look(entry.object, last, d, before, along) end
      last, before = d, along
    end
  end
  if not best then return nil end
  return best.u, best.v, best.wire.radius, clip.object:read(best.wire).way, best.tilt, best.wire
end

local function length(x) return number.text(math.abs(x) < 1e-9 and 0 or math.abs(x), "m") end

-- Returns the end of a sentence: how far away the wire is that no clip reaches.
local function nearest(clip)
  local least, text = math.huge, ""
  for _, entry in ipairs(build.data(clip.scene).wires) do
    local x, s = entry.object:positions()
    for i = 1, (clip.on == nil or clip.on == entry.object) and #s or 0 do
      local d = vec.add({ x[3 * i - 2], x[3 * i - 1], x[3 * i] }, clip.at, -1)
      if vec.norm(d) < least then
        least = vec.norm(d)
        text = ("; the nearest place of wire '%s', s = %.4g m, is %s off along its axis and %s across")
          :format(entry.name, s[i], length(vec.dot(d, clip.axis)),
            length(vec.dot(d, vec.cross(clip.direction, clip.axis))))
      end
    end
  end
  return text
end

local TILTED = math.rad(5) -- smaller tilts are not named: lips take them

-- Returns the end of a sentence: how the wire lay over the mouth, if that may be why it does not go in.
local function lay(clip)
  local _, v, radius, _, tilt, wire = passing(clip)
  local list = {}
  if v and math.abs(v) > radius then
    list[1] = ("wire '%s' lay %s beside the clip's middle: move the gripper across, by gripper:move or with "
      .. "align = true"):format(wire.name, length(v))
  end
  if v and tilt > TILTED then
    list[#list + 1] = ("wire '%s' lay over the mouth tilted by %.0f deg to the clip's axis: turn the "
      .. "gripper, by gripper:move{ turn = }"):format(wire.name, math.deg(tilt))
  end
  return #list > 0 and "; " .. table.concat(list, "; ") or ""
end

local LINED_UP = 0.02 -- sufficient alignment: offset of the wire over the mouth, over its radius
local ROUNDS = 3

-- Brings the wire over the mouth: first upwards, then across.
local function line_up(self, clip, args, what)
  local tool = place(self, clip)
  local u, _, radius, way = passing(clip)
  if not u then
    error(("%s: no wire passes '%s'%s; first move the wire that it holds over the clip's mouth"):format(what,
      clip.name, nearest(clip)), 0)
  end
  if math.min(u, tool) < 0.5 * way then
    error(("%s: the wire is %.4g m and the tool %.4g m over the seat of '%s', whose lips are at %.4g m; "
      .. "first move both over the lips, by gripper:move"):format(what, u, tool, clip.name, way), 0)
  end
  if args.align == false then return way, radius end
  local function go(direction, by)
    self:move{ by = vec.add({ 0, 0, 0 }, direction, by), speed = args.approach_speed }
  end
  if u < way + radius then go(clip.direction, way + radius - u) end
  for _ = 1, ROUNDS do
    local _, v = passing(clip)
    if not v or math.abs(v) < LINED_UP * radius then break end
    go(vec.cross(clip.axis, clip.direction), v)
  end
  return way, radius
end

local TAUT = 0.5 -- share of the force on a gripper from which on a pull, or the lips, explain it [-]

-- Returns the end of a sentence if the wire's pull may be what resists the gripper.
local function taut(wire, clip, force)
  local pull, s = wire:max_tension{ now = true }
  if pull < TAUT * force or clip.peak_insertion_force > TAUT * force then return "" end
  return ("; wire '%s' is taut, with a pull of %.3g N near s = %.3g m: give it slack"):format(wire.name, pull,
    s)
end

-- Returns the way to the next check [m].
local function stride(clip, way)
  local u = clip:height()
  local top = way * clip.insertion / (clip.insertion + clip.retention) -- of the lips, over the seat
  return u and u < top + way / STEPS and way / (FINE * STEPS) or way / STEPS
end

local function push_on(self, clip, way, speed)
  self:move{ by = vec.scale(clip.direction, -way), speed = speed, law = "linear" }
end

-- Returns the largest force of the gripper towards the seat, and the reason if the wire did not go in.
local function press(self, clip, args, way, radius)
  local goal = -(args.overtravel or radius)
  local most, u, lies = 0, place(self, clip), lay(clip)
  while not clip:seated() do
    local step = math.min(stride(clip, way), u - goal)
    if step < 1e-9 then
      return most, ("the tool went %.4g m beyond the seat with at most %.4g N, and the wire beside it did "
        .. "not go in%s"):format(-goal, most, lies ~= "" and lies
        or "; grasp the wire nearer to the clip, or give more overtravel")
    end
    push_on(self, clip, step, args.speed)
    local before = u
    u = place(self, clip)
    if before - u <= 0.5 * step then -- the move was too short for a step
      error(("gripper:clip: speed = %g m/s is too fast: the move takes too little time for a step")
        :format(args.speed), 0)
    end
    most = math.max(most, -vec.dot(self:force(), clip.direction))
    if most > args.max_force and not clip:seated() then
      return most, ("the force reached %.4g N, above max_force = %.4g N, with the tool %.4g m over the seat; "
        .. "the lips had resisted with %.4g N%s%s"):format(most, args.max_force, u, clip.peak_insertion_force,
        lies, taut(self.wire, clip, most))
    end
  end
  local home = math.min(HOME * way / STEPS, u - goal)
  if home > 1e-9 then push_on(self, clip, home, args.speed) end
  return most
end

local function run(self, given)
  local args, what = checked(self, given)
  local clip = args.into
  if clip:seated() then
    error(("%s: '%s' already has wire '%s'"):format(what, clip.name, clip.wire.name), 0)
  end
  local way, radius = line_up(self, clip, args, what)
  local begun = self.scene.time
  local most, why = press(self, clip, args, way, radius)
  if why and args.fail == false then
    self.scene:tell{ kind = "unreached", object = clip.name, value = most,
      text = ("%s: wire not in '%s': %s"):format(what, clip.name, why) }
    return nil, why
  end
  if why then error(("%s: wire not in '%s': %s"):format(what, clip.name, why), 0) end
  return { clip = clip, force = most, duration = self.scene.time - begun,
    peak_force = clip.peak_insertion_force, s = clip.inserted and clip.inserted.s }
end

--- Presses the wire into a clip: { into = clip, speed = [m/s], max_force = [N], overtravel = [m] }.
-- The tool lines up over the mouth (unless align = false), goes towards the seat until the wire
-- snaps in, 1/40 of the lips' way further, and stays there. Returns { force = largest of the gripper [N],
-- peak_force = largest of the lips [N], s = [m], duration = [s] }. If the wire does not go in, the tool stops
-- and an error says which force was reached; with fail = false an event says so, and the call returns nil and
-- this text.
function Gripper.clip(self, args)
  -- not by build.call: the process yields on the way
  local result = table.pack(pcall(run, self, args))
  if result[1] then return table.unpack(result, 2, result.n) end
  local message = result[2]
  if type(message) ~= "string" or message:find "^[^\n]-:%d+: " then error(message, 0) end
  error(message, 2)
end

return Gripper
