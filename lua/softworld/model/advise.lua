-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:advise: predicts, without a run, which model, edges and step a scene needs, the cost, and what to
-- leave out.
-- @module softworld.model.advise
local build = require "softworld.scene.build"
local core = require "softworld.core"
local fixing = require "softworld.link.fixing"
local narrow = require "softworld.link.narrow"
local number = require "softworld.output.number"
local roundness = require "softworld.scene.roundness"
local quantity = require "softworld.quantity"
local rows = require "softworld.rows"

local advise = {}

local BOW = 1.25        -- relative error of a cantilever's droop with n edges: this over n^2 ("accuracy") [-]
local FEWEST = 10       -- least edges of a wire in one bow [-]
local ROUND = 3         -- edges per smallest radius that a wire is bent round [-]
local SWING = 40        -- steps per first period, for 1 % [-]
-- Times as measured in the scenes of the bench case=auto, on one core of a server.
local EACH = 1e-6       -- time of a node in a pose, or in a step with its iterations [s]
local TOUCHED = 3       -- the same in a pose in which something may touch, over one in which nothing does [-]
local STEPS = 300       -- steps per first period of a fast run with error bars, on its third level [-]
local BLOWS = 1e-3      -- longest mean step there if something may touch [s]
local LEVELS = 1.6      -- time of three levels and of the choice over that of the third level [-]
local LOOK = { free = 0.005, touched = 0.015 } -- least time of comparisons to choose a model [s]
local FINE = 0.015      -- tolerances below this one need a fourth level [-]
local FINER = { poses = 4, dynamic = 5 } -- time of a level over that of the level before [-]
local POSES = 1000      -- poses in a long run [-]
local POSE_DT = 0.04    -- least time between poses, as of the third level of a run with error bars [s]
local FRAMES = 30       -- stored frames [1/s]
local BYTES = { node = 2500, frame = 28 } -- per node while computing, and in a frame [B]
local PERIODS = 10      -- least duration of slow motion, in first periods [-]
local MOST = 1e7        -- most segments of a wire, as in the core [-]
local USUAL_DT = 0.01   -- largest step [s]
local LONGEST_DT = 1000 -- longest step that a run takes [s]
local USUAL_TIME = 10   -- duration if none is given [s]

local take = rows.call("scene:advise", "{...}", "the model and mesh that the scene probably needs; runs "
  .. "nothing", {
  gives = "{ motion =, twist =, contact =, segments = { name = n }, dt =, time =, memory =, spare =, "
    .. "auto_time = { poses =, dynamic = } }; print it",
  example = "print(scene:advise { tolerance = 0.02, duration = 5 })",
  { "tolerance", "number", "-", "allowed error, as a share of each quantity", min = 0, max = 1, above = true,
    default = 0.02 },
  { "duration", "number", "s", "duration of the run, or of its processes", min = 0, max = 1e9, above = true },
})

local Advice = { __name = "advice" }
Advice.__index = Advice

local function rubs(data)
  local names = {}
  for _, o in ipairs(data.obstacles) do
    if o.object.present and o.object:get().friction > 0 then names[#names + 1] = o.name end
  end
  return names
end

--- Returns what the scene has without effect: a list of { wire = or nil, text = }.
function advise.spare(scene)
  local data, list = build.data(scene), {}
  local rough, pads = #rubs(data) > 0, #data.grippers > 0
  for _, w in ipairs(data.wires) do
    if core.exists(w.object) and w.object:get().spin_inertia and not rough and not pads
      and not data.touching then
      list[#list + 1] = { wire = w.object, text = ("wire '%s': rolls = true costs twice as much, and "
        .. "nothing here "
        .. "has friction that could turn it"):format(w.name) }
    end
  end
  local self = #data.wires == 1 and data.wires[1]
  if data.touching and self and self.object.length < 2 * math.pi * 3 * self.object.radius then
    list[#list + 1] = { wire = self.object, text = ("scene:wire_contact: '%s' is alone and too short to meet "
      .. "itself"):format(self.name) }
  end
  return list
end

-- Returns the first period of a wire [s], with all it is joined to held fixed; nil: it has none.
local function period_of(w)
  for _, alone in ipairs { false, true } do
    local fine, list = pcall(w.frequencies, w, { modes = 1, alone = alone or nil })
    if fine and list[1] then return list.unstable == 0 and 1 / list[1] or nil end
  end
end

-- Returns the first period of a wire that hangs or stands off from one end [s]: of a beam and of a chain of
-- its length, whose stiffnesses add up. nil: neither bends nor hangs.
local function free_period(w, gravity)
  local fine, values = pcall(w.get, w)
  local EI, mass = fine and values.EI or 0, fine and values.mass_per_length
  if not mass then return nil end
  local square = 3.516 ^ 2 * EI / (mass * w.length ^ 4) + 1.2024 ^ 2 * gravity / w.length
  return square > 0 and 2 * math.pi / square ^ 0.5 or nil
end

-- Finds the periods: a.period at rest, nil if a wire has none; a.swing: the same or, if wires lie on
-- something, that of a lifted wire if it is longer.
local function periods_of(scene, a)
  local gravity = quantity.size(scene:gravity())
  a.lies = scene:contacts() > 0
  local known, free = 0, 0
  for _, w in ipairs(build.data(scene).wires) do
    local own = period_of(w.object)
    known = own and known and math.max(known, own)
    free = math.max(free, a.lies and gravity > 0 and free_period(w.object, gravity) or 0)
  end
  a.period = known and known > 0 and known or nil
  local swing = math.max(a.period or 0, free)
  a.swing = swing > 0 and swing or nil
end

-- Returns the first clip, or nil: a wire that snaps into it swings, however slowly it is pressed.
local function clip_of(scene)
  for _, it in ipairs(fixing.all(scene)) do
    if getmetatable(it).__name == "clip" then return it end
  end
end

-- Returns a number of periods as text.
local function periods(count) return (count < 1000 and "%.3g" or "%.0f"):format(count) end

local function motion_of(scene, a)
  periods_of(scene, a)
  if not a.swing then
    a.motion, a.motion_why = "dynamic", "periods are known only at rest: call scene:settle() before"
    return
  end
  local counts = a.period or a.swing
  local slow = a.duration >= PERIODS * counts
  a.motion = slow and "poses" or "dynamic"
  a.motion_why = ("%s%s is %s first periods of %s%s; %s"):format(number.text(a.duration, "s"),
    a.given and "" or " (assumed, as no duration is given)", periods(a.duration / counts),
    number.text(counts, "s"),
    a.period and "" or ", of a lifted wire",
    slow and ("that is slow: %d or more"):format(PERIODS)
      or ("below %d, model = 'auto' compares poses with dynamics"):format(PERIODS))
  if slow and a.duration < PERIODS * a.swing then
    a.motion_why = ("%s; a wire lifted off what it lies on swings with up to %s: then model = 'auto' "
      .. "compares poses with dynamics"):format(a.motion_why, number.text(a.swing, "s"))
  end
  local clip = slow and clip_of(scene)
  if clip then
    a.snaps = true
    a.motion_why = ("%s; but a wire that snaps into '%s', or out of it, swings: then model = 'auto' compares "
      .. "poses with dynamics"):format(a.motion_why, clip.name)
  end
end

-- Returns the smallest radius of a round obstacle [m], and the obstacle's name.
local function sharpest(data)
  local least, name = math.huge, nil
  for _, o in ipairs(data.obstacles) do
    local radius = roundness.of(o)
    if type(radius) == "number" and radius > 0 and radius < least then least, name = radius, o.name end
  end
  return least, name
end

-- Returns the least number of edges for the obstacles and channels that a wire may be bent by, and why.
local function bent_by(scene, w, radius, name)
  local length, thick = w.object.length, w.object.radius
  local round = name and ROUND * length / (radius + thick) or 0
  local edge, channel = narrow.edge(scene, thick)
  if length / edge > round then
    return length / edge, ("edges that pass the corners of '%s' without jamming"):format(channel)
  end
  return round, name and ("edges of a third of the radius of '%s'"):format(name)
end

-- Returns the number of edges for a wire, and why; never more than a wire can have.
local function edges_of(bow, round, share, bent)
  local wanted = math.max(FEWEST, bow, round)
  local why = round > math.max(FEWEST, bow) and bent
    or ("for one bow with an error of %.3g %%"):format(100 * share)
  if wanted <= MOST then return math.ceil(wanted), why end
  return math.ceil(MOST), ("the most there can be; %.3g would be needed %s%s"):format(wanted,
    round > bow and "for " or "", why)
end

local function mesh_of(scene, share, a)
  local data, nodes, given = build.data(scene), 0, 0
  local radius, name = sharpest(data)
  a.segments, a.segments_why = {}, {}
  for _, w in ipairs(data.wires) do
    local round, bent = bent_by(scene, w, radius, name)
    local n, why = edges_of((BOW / share) ^ 0.5, round, share, bent)
    a.segments[w.name], a.segments_why[w.name] = n, why
    nodes, given = nodes + n + 1, given + core.segments(w.object) + 1
  end
  return nodes, given
end

-- True if a wire may touch or jump over something.
local function may_touch(data, a)
  return a.lies or #data.obstacles > 0 or #(data.joins or {}) > 0 or #(data.forces or {}) > #data.wires
end

-- Returns the expected time of a run that chooses its model, with this motion [s]. given: nodes of the
-- script's edges, which are those of the third level.
local function with_bars(a, motion, given)
  local dt, each = POSE_DT, EACH * (a.touched and TOUCHED or 1)
  if motion == "dynamic" then
    dt = math.min(a.touched and BLOWS or USUAL_DT, a.swing and a.swing / STEPS or USUAL_DT)
    each = EACH
  end
  local fourth = a.tolerance < FINE and FINER[motion] or 1
  return (a.touched and LOOK.touched or LOOK.free) + LEVELS * each * given * a.duration / dt * fourth
end

-- Sets the step, the time of one run, and the times of runs that choose their model. nodes: as advised.
local function cost_of(scene, a, nodes, given)
  a.touched = may_touch(build.data(scene), a)
  local each, rolling = EACH * (a.touched and TOUCHED or 1), a.twist == "rolling" and 2 or 1
  if a.motion == "poses" then
    a.dt = math.min(LONGEST_DT, math.max(POSE_DT, a.duration / POSES))
  else
    local steps = (a.tolerance / 0.01) ^ 0.5
    a.dt, each = math.min(USUAL_DT, a.swing and a.swing / SWING * steps or USUAL_DT), EACH * rolling
  end
  a.time = each * nodes * a.duration / a.dt
  a.auto_time = { poses = with_bars(a, "poses", given), dynamic = with_bars(a, "dynamic", given) }
  a.memory = BYTES.node * nodes + BYTES.frame * nodes * FRAMES * a.duration
end

-- Returns a time as text, to two digits or whole ms.
local function roughly(time)
  if time >= 1 then return number.duration(time) end
  return (time < 0.0995 and "%.2g ms" or "%.0f ms"):format(1e3 * time)
end

-- Returns what a run that chooses its model takes, as text: with the model that is certain, or with both.
local function text_of_auto(a)
  local poses, dynamic = roughly(a.auto_time.poses), roughly(a.auto_time.dynamic)
  local took = ("%s if it finds that poses suffice, %s if not"):format(poses, dynamic)
  if a.swing and a.duration >= PERIODS * a.swing and not a.snaps then took = poses end
  return ("  a run with model = 'auto' takes about %s; each level with finer edges than the script's takes "
    .. "%d to %d times as much"):format(took, FINER.poses, FINER.dynamic)
end

local function text_of_choices(a, lines)
  for _, word in ipairs { "motion", "twist", "contact" } do
    lines[#lines + 1] = ("  %s %s: %s"):format(word, a[word], a[word .. "_why"])
  end
end

function Advice:__tostring()
  local lines, names = { ("for %.3g %%:"):format(100 * self.tolerance) }, {}
  text_of_choices(self, lines)
  for name in pairs(self.segments) do names[#names + 1] = name end
  table.sort(names)
  for _, name in ipairs(names) do
    lines[#lines + 1] = ("  segments = %d of '%s': %s"):format(self.segments[name], name,
      self.segments_why[name])
  end
  lines[#lines + 1] = ("  dt = %s"):format(number.text(self.dt, "s"))
  lines[#lines + 1] = ("  one run of %s with these takes about %s and %.2g MB"):format(number.text(
    self.duration, "s"), roughly(self.time), self.memory / 1e6)
  lines[#lines + 1] = text_of_auto(self)
  for _, text in ipairs(self.spare) do lines[#lines + 1] = "  leave out: " .. text end
  return table.concat(lines, "\n")
end

local function advice_of(scene, args)
  build.check(scene, "scene:advise", 4)
  args = take:read(args or {})
  local data = build.data(scene)
  if #data.wires == 0 then error(("scene:advise: scene '%s' has no wire"):format(scene.name), 0) end
  local share = args.tolerance
  local a = setmetatable({ tolerance = share, duration = args.duration or USUAL_TIME, spare = {},
    given = args.duration ~= nil }, Advice)
  motion_of(scene, a)
  local names = rubs(data)
  a.twist = #names > 0 and "rolling" or "held"
  a.twist_why = #names > 0 and ("'%s' has friction; a run with model = 'auto' tells how much it matters")
    :format(names[1]) or "nothing here has friction"
  a.contact = #data.wires > 1 and "wires" or "none"
  a.contact_why = #data.wires > 1 and "there are several wires; a run with model = 'auto' tells whether they "
    .. "meet"
    or "there is one wire; if it may touch itself, add scene:wire_contact{}"
  cost_of(scene, a, mesh_of(scene, share, a))
  for i, item in ipairs(advise.spare(scene)) do a.spare[i] = item.text end
  return a
end

--- scene:advise{ tolerance =, duration = }: see help "auto".
advise.advise = build.placed(advice_of)

return advise
