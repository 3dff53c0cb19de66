-- SPDX-License-Identifier: GPL-3.0-or-later
--- gripper:press: a move that ends where the wire pushes back with a force.
--
-- The move starts slowly enough that the wire's inertia does not count as a push. The push is looked at after
-- each step. On something hard it rises by kilonewtons within one step; then the tool is set back, as a
-- controller of force does it, to where the push is the wanted one, and an event `coarse` tells the first.
-- @module softworld.grip.press
local number = require "softworld.output.number"
local vec = require "softworld.vec"

local press = {}

local START = 0.05   -- push by the wire's inertia as the move starts, as a share of the wanted one [-]
local BEYOND = 1.08   -- a push above this share of the wanted one is set back [-]
local MOST = 60      -- tries to set it back
local SAME = 5       -- tries with too small, or too large a push, after which the other end is measured anew
local FINEST = 1.01e-9 -- least way to set it by: motions take ways below 1e-9 as none [m]
local REACHED = 1.1  -- largest push that counts as the wanted one, as a share of it [-]
local AIM = 1.05     -- push that it is set to, as a share of the wanted one [-]
local STILL = 4      -- steps after which a push is taken as that of rest, ...
local REST = 0.01    -- ... and the least time [s]
local SURE = 0.1     -- time for which the wanted push must stay: a cable that a blow bent swings, ... [s]
local LOST = 0.1     -- ... and loses more than this share of the wanted push [-]

-- Returns the acceleration of the move's start [m/s2], or nil for an empty gripper. The speed is reached
-- within an eighth of the distance at the latest.
local function acceleration_of(self, args)
  local mass = 0
  for _, wire in ipairs(self.wires) do mass = mass + wire.beam.mass_per_length * wire.length end
  if mass == 0 then return nil end
  return math.max(START * args.force / mass, 4 * args.speed ^ 2 / args.distance)
end

-- Waits in the process of a press. Returns false if another process moved or stopped the gripper meanwhile.
local function rest(self, p, seconds)
  local mine = self.scene.time + seconds
  self.busy_until = mine
  p:wait(seconds)
  return self.busy_until == mine
end

-- Goes to the way x [m] and waits until the push is that of rest; h: a step [s]. Returns the push, or nil if
-- another process moved the gripper.
local function go_to(self, p, held, way, x, now, speed, h, push)
  local time = math.max(math.abs(x - now) / speed, h)
  held:follow{ points = { { 0, 0, 0 }, vec.scale(way, x - now) }, relative = true, duration = time }
  return rest(self, p, time + math.max(STILL * h, REST)) and push() or nil
end

-- Returns the next way between low, where the push is too small, and high, where it is too large: on the line
-- through the last two that were too large, for a touch is linear beyond its start; else in the middle.
local function between(low, high, higher, force)
  if higher and higher.f > high.f then
    local x = high.x - (high.f - AIM * force) * (higher.x - high.x) / (higher.f - high.f)
    if x > low.x and x < high.x then return x end
  end
  return 0.5 * (low.x + high.x)
end

-- Returns the way to try after the push f at the way `now`. ends: .low, .high, .higher, places with too small
-- and too large a push, the last two of the latter; .short, .same: what the last pushes were, and how many;
-- .stride [m], .grow: how far to go where an end is missing. A cable that was drawn taut, or that a blow has
-- bent, may lie otherwise than it lay when an end was measured: then no place between the ends has the push.
-- The end is measured anew, and from there on it is looked for in strides that grow.
local function next_way(ends, now, f, args)
  local short = f < args.force
  ends.same, ends.short = short == ends.short and ends.same + 1 or 1, short
  if short then
    ends.low = { x = now, f = f }
  else
    ends.high, ends.higher = { x = now, f = f }, ends.high
  end
  local other = ends[short and "high" or "low"]
  if other and ends.same < SAME then
    local x = between(ends.low, ends.high, ends.higher, args.force)
    if math.abs(x - now) >= FINEST then return x end
  end
  if short then ends.high, ends.higher = nil, nil else ends.low = nil end
  if other and math.abs(other.x - now) >= FINEST then
    ends.same, ends.stride, ends.grow = 0, math.abs(other.x - now), 2
    return other.x
  end
  ends.stride = ends.grow * math.max(ends.stride, FINEST)
  return short and math.min(args.distance, now + ends.stride) or math.max(0, now - ends.stride)
end

-- Sets the tool to where the push at rest is the wanted one. Returns the push [N], or nil if another process
-- moved the gripper.
local function set_back(self, p, held, way, args, seen, push)
  local now = seen.last.x
  local ends = { low = seen.before, stride = now - seen.before.x, grow = 1 }
  local f = rest(self, p, math.max(STILL * seen.step, REST)) and push() or nil
  if f and f > BEYOND * args.force then -- the blow bends a cable and turns its end aside: it comes free first
    ends.high, now = { x = now, f = f }, ends.low.x
    f = go_to(self, p, held, way, now, ends.high.x, args.speed, seen.step, push)
  end
  local function is_set() return f >= args.force and f <= BEYOND * args.force end
  for _ = 1, MOST do
    if not f then return nil end
    if is_set() then
      if not rest(self, p, SURE) then return nil end
      local later = push()
      if math.abs(later - f) <= LOST * args.force then break end
      f = later
    end
    local x = next_way(ends, now, f, args)
    if math.abs(x - now) < FINEST then break end
    f = go_to(self, p, held, way, x, now, args.speed, seen.step, push)
    now = x
  end
  return f
end

-- Tells that the push rose far beyond the wanted one in a step. f: to what it was set then, or nil.
local function tell(self, args, seen, f)
  local first = seen.last.f
  self.scene:tell{ kind = "coarse", object = self.name, value = first, text = ("gripper '%s': the press "
    .. "was to end at %s. Its force rose to %s within a step of %s, over %s, %s. This peak depends on dt and "
    .. "on the speed of the press"):format(self.name, number.text(args.force, "N"),
      number.text(first, "N"), number.text(seen.step, "s"), number.text(seen.last.x - seen.before.x, "m"),
      f and "and was then set to " .. number.text(f, "N")
        or "and another process moved the gripper before it was set back") }
end

-- Tells that nothing stopped the wire, or that its push was lost as the tool was set back.
local function tell_unreached(self, args, f, way, lost)
  local text = ("gripper '%s': the press was to end at %s, "):format(self.name, number.text(args.force, "N"))
  if lost then
    text = text .. ("but after its force had jumped no place with this push was found: %s at %s of %s")
      :format(number.text(f, "N"), number.text(way, "m"), number.text(args.distance, "m"))
  else
    text = text .. ("and went all of its %s with a push of %s at its end"):format(number.text(way, "m"),
      number.text(f, "N"))
  end
  self.scene:tell{ kind = "unreached", object = self.name, value = f, text = text }
end

--- Presses by the held object in the process p; way: a unit vector. Returns the push [N], the way [m], and
-- whether the push was reached.
function press.run(self, p, held, way, args)
  local from = held:pose()
  local function pushed() return vec.dot(self:force(), way) end
  local function gone() return vec.dot(vec.sub((held:pose()), from), way) end
  local start, a = pushed(), acceleration_of(self, args)
  local function push() return pushed() - start end
  held:follow{ points = { { 0, 0, 0 }, vec.scale(way, args.distance) }, relative = true, speed = args.speed,
    law = a and "trapezoidal" or "linear", acceleration = a }
  local seen = { last = { x = 0, f = 0 }, time = self.scene.time }
  local longest = args.distance / args.speed + (a and args.speed / a or 0)
  local mine = self.scene.time + longest
  self.busy_until = mine
  local done = p:wait_until(function()
    if self.busy_until ~= mine then return true end
    if self.scene.time > seen.time then
      seen.step, seen.time = self.scene.time - seen.time, self.scene.time
      seen.before, seen.last = seen.last, { x = gone(), f = push() }
    end
    return seen.last.f >= args.force
  end, { timeout = longest })
  if self.busy_until ~= mine then return push(), gone(), false end -- another process moved or stopped it
  held:follow(nil)
  self.busy_until = self.scene.time
  local f, lost = push(), false
  if done and f > BEYOND * args.force and seen.last.x > seen.before.x then
    f = set_back(self, p, held, way, args, seen, push)
    tell(self, args, seen, f)
    if not f then return push(), gone(), false end
    held:follow(nil)
    self.busy_until = self.scene.time
    done = f >= args.force and f <= REACHED * args.force
    lost = args.distance - gone() > FINEST
  end
  if not done then tell_unreached(self, args, f, gone(), lost) end
  return f, gone(), done
end

return press
