-- SPDX-License-Identifier: GPL-3.0-or-later
--- scene:advise: predicts, without a run, which model, edges and step a scene needs, the cost, and what to
-- leave out.
-- @module softworld.model.advise
local build = require "softworld.scene.build"
local core = require "softworld.core"
local number = require "softworld.output.number"
local rows = require "softworld.rows"

local advise = {}

local BOW = 1.25        -- relative error of a cantilever's droop with n edges: this over n^2 ("accuracy") [-]
local FEWEST = 10       -- least edges of a wire in one bow [-]
local ROUND = 3         -- edges per smallest radius that a wire is bent round [-]
local SWING = 40        -- steps per first period, for 1 % [-]
local COST = 3e-6       -- time per node and step, with its iterations ("speed", case=scale) [s]
local POSE = 10       -- iterations of a pose over those of a step [-]
local FRAMES = 30       -- stored frames [1/s]
local BYTES = { node = 2500, frame = 28 } -- per node while computing, and in a frame [B]
local PERIODS = 10      -- least duration of slow motion, in first periods [-]
local MOST = 1e7        -- most segments of a wire, as in the core [-]
local USUAL_DT = 0.01   -- largest step [s]
local LONGEST_DT = 1000 -- longest step that a run takes [s]
local USUAL_TIME = 10   -- duration if none is given [s]

local take = rows.call("scene:advise", "{...}", "the model and mesh that the scene probably needs; runs "
  .. "nothing", {
  gives = "{ motion =, twist =, contact =, segments = { name = n }, dt =, time =, memory =, spare = }; "
    .. "print it",
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

local function motion_of(scene, duration, a)
  local longest
  for _, w in ipairs(build.data(scene).wires) do
    local fine, list = pcall(w.object.frequencies, w.object, { modes = 1 })
    if not fine or not list[1] or list.unstable > 0 then
      a.motion, a.motion_why = "dynamic", "its periods are known only at rest: call scene:settle() before"
      return
    end
    longest = math.max(longest or 0, 1 / list[1])
  end
  a.period = longest
  if not longest then return end
  if not duration then
    a.motion, a.motion_why = "dynamic", ("poses suffice from a duration of %s on, %d first periods; give "
      .. "duration"):format(
      number.text(PERIODS * longest, "s"), PERIODS)
    return
  end
  local slow = duration >= PERIODS * longest
  a.motion = slow and "poses" or "dynamic"
  a.motion_why = ("%s is %.3g first periods of %s (slow from %d on)"):format(number.text(duration, "s"),
    duration / longest, number.text(longest, "s"), PERIODS)
end

-- Returns the smallest radius of a round obstacle [m], and the obstacle's name.
local function sharpest(data)
  local least, name = math.huge, nil
  for _, o in ipairs(data.obstacles) do
    local radius = o.radius
    if type(radius) == "number" and radius > 0 and radius < least then least, name = radius, o.name end
  end
  return least, name
end

-- Returns the number of edges for a wire, and why; never more than a wire can have.
local function edges_of(bow, round, share, name)
  local wanted = math.max(FEWEST, bow, round)
  local why = round > math.max(FEWEST, bow) and ("edges of a third of the radius of '%s'"):format(name)
    or ("for one bow with an error of %.3g %%"):format(100 * share)
  if wanted <= MOST then return math.ceil(wanted), why end
  return math.ceil(MOST), ("the most there can be; %.3g would be needed %s%s"):format(wanted,
    round > bow and "for " or "", why)
end

local function mesh_of(scene, share, a)
  local data, nodes = build.data(scene), 0
  local radius, name = sharpest(data)
  a.segments, a.segments_why = {}, {}
  for _, w in ipairs(data.wires) do
    local round = name and ROUND * w.object.length / (radius + w.object.radius) or 0
    a.segments[w.name], a.segments_why[w.name] = edges_of((BOW / share) ^ 0.5, round, share, name)
    nodes = nodes + a.segments[w.name] + 1
  end
  return nodes
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
  lines[#lines + 1] = ("  about %s of computing and %s for %s; with error bars 1.3 to 5 times as "
    .. "much"):format(
    number.duration(self.time), number.text(self.memory / 1e6, "") .. " MB", number.text(self.duration, "s"))
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
    motion = "dynamic", motion_why = "nothing here can swing" }, Advice)
  motion_of(scene, args.duration, a)
  local names = rubs(data)
  a.twist = #names > 0 and "rolling" or "held"
  a.twist_why = #names > 0 and ("'%s' has friction; a run with model = 'auto' tells how much it matters")
    :format(names[1]) or "nothing here has friction"
  a.contact = #data.wires > 1 and "wires" or "none"
  a.contact_why = #data.wires > 1 and "there are several wires; a run with model = 'auto' tells whether they "
    .. "meet"
    or "there is one wire; if it may touch itself, add scene:wire_contact{}"
  local nodes = mesh_of(scene, share, a)
  local steps = (share / 0.01) ^ 0.5
  a.dt = math.min(USUAL_DT, a.period and a.period / SWING * steps or USUAL_DT)
  if a.motion == "poses" then a.dt = math.min(LONGEST_DT, math.max(a.dt, a.duration / 100)) end
  a.time = COST * nodes * a.duration / a.dt * (a.twist == "rolling" and 2 or 1)
    * (a.motion == "poses" and POSE or 1)
  a.memory = BYTES.node * nodes + BYTES.frame * nodes * FRAMES * a.duration
  for i, item in ipairs(advise.spare(scene)) do a.spare[i] = item.text end
  return a
end

--- scene:advise{ tolerance =, duration = }: see help "auto".
advise.advise = build.placed(advice_of)

return advise
