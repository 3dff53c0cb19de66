-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choice of section: round under any load; or, where it is pressed, a mesh of springs with the wire's
-- stiffness between two plates, or a mesh of elements.
-- @module softworld.model.section
local core = require "softworld.core"
local facts = require "softworld.model.facts"
local flat = require "softworld.model.flat"
local mesh = require "softworld.model.mesh"
local number = require "softworld.output.number"
local pressed = require "softworld.model.pressed"
local vec = require "softworld.vec"

local CRUSHED = 0.2 -- flattening above which no line is valid, whatever the tolerance [-]
local SQUEEZED = 0.1 -- flattening from both sides that may be left out, over the tolerance [-]
local LEFT = 0.75   -- largest error of springs over the tolerance [-]
local WALL = 1.7    -- error of springs in a tube's force, over flattening times wall over radius [-]

-- steady: the next rung does not shorten bars, and it leaves the other choices as they are. own: changes by
-- the next rung's own edges count too.
local section = { name = "section", steady = true, levels = 2, rungs = {
  { name = "round", as = "round sections", leaves = "flattening of the section" },
  { name = "springs", as = "a mesh of springs", own = true,
    leaves = "how the section's stiffness changes as it flattens; twist beside the mesh" },
  { name = "elements", as = "a mesh of elements", leaves = "twist beside the mesh" } } }

--- Returns the approach of two faces that press on a wire with q [N/m], over its width, and whose modulus was
-- taken. nil: not known.
function section.flattening(wire, q)
  local body = flat.body(wire)
  if not body.known then return nil end
  return flat.share(body, q), body.of
end

local function is_line(wire) return wire.model == "rod" or wire.model == "string" end

-- --- setting the scene --------------------------------------------------------------------

-- Notes the load on a wire in runs with round sections; the notes are fixed once a wire is a mesh.
local function note(context, w, body, q, from, to)
  if context.pressed_fixed or not from then return end
  local list = context.pressed
  local known = list[w.name] or { object = w.object, name = w.name, body = body, q = 0, from = from, to = to }
  list[w.name] = known
  known.q, known.from, known.to = math.max(known.q, q), math.min(known.from, from), math.max(known.to, to)
end

-- Returns the wires that become meshes, in order: those flattened by more than the limit, or the most
-- flattened.
local function meshed(context)
  if context.pressed_fixed then return context.pressed_fixed end
  local list, most = {}, 0
  for _, p in pairs(context.pressed) do
    p.share = flat.share(p.body, p.q)
    most = math.max(most, p.share)
  end
  for _, w in ipairs(context.data.wires) do
    local p = context.pressed[w.name]
    if p and (p.share >= math.min(most, context.section_limit or most)) then
      p.length, p.region = p.object.length, mesh.region(p.object, p.from, p.to)
      list[#list + 1] = p
    end
  end
  context.pressed_fixed = list
  return list
end

-- Returns a sentence if a wire begins inside an obstacle, deeper than its radius, or nil. A force throws it
-- out that no handling has; a mesh of all of it would take minutes, and tell nothing.
local function begins_inside(context)
  for _, o in ipairs(context.obstacles_at) do
    for i, points in ipairs(context.start) do
      local w = context.data.wires[i]
      for _, p in ipairs(points) do
        local gap = o.shape:distance(vec.rotate(o.back, { p[1] - o.at[1], p[2] - o.at[2], p[3] - o.at[3] }))
        if gap < -w.object.radius then
          return ("'%s' begins inside '%s', which throws it out: put it outside"):format(w.name, o.name)
        end
      end
    end
  end
end

function section.begin(context)
  context.pressed, context.obstacles_at = {}, {}
  for i, o in ipairs(context.data.obstacles) do
    local at, q = o.object:pose()
    context.obstacles_at[i] = { name = o.name, shape = o.object.shape, at = at, back = vec.conjugate(q) }
  end
end

--- True if the wire will be a mesh.
function section.takes(context, rung, wire)
  for _, p in ipairs(rung and rung > 1 and meshed(context) or {}) do
    if p.object == wire then return true end
  end
  return false
end

function section.apply(context, rung, changes, rungs)
  if rung == 1 then return end
  function changes.shape(k)
    for _, p in ipairs(meshed(context)) do
      local why = mesh.make(p, rung, k, rungs.twist == 2)
      if why then return why end
    end
  end
end

--- Returns the expected time of a run on level k [s]; nil: as usual.
function section.expected(context, rung, k)
  if rung == 1 then return nil end
  local sum = 0
  for _, p in ipairs(meshed(context)) do sum = sum + mesh.time(p, rung, k, context.iterations) end
  return sum
end

-- --- what runs tell -----------------------------------------------------------------------

local function look_at_line(context, worst, w, i)
  local body = flat.body(w.object)
  local q, from, to, both = pressed.line(context, w.object, i, body)
  if q <= 0 then return end
  local share = flat.share(body, q)
  if not body.known and share < CRUSHED then
    worst.unknown = w.name
    return
  end
  note(context, w, body, q, from, to)
  local squeeze = flat.share(body, both)
  if squeeze > (worst.squeeze or 0) then worst.squeeze, worst.squeezed = squeeze, w.name end
  if share > worst.share then
    worst.q, worst.share, worst.wire, worst.of = q, share, w.name, body.of
  end
end

-- Returns the run's event about walls that passed through each other, which springs do not feel, or nil.
local function passed(p, run)
  for _, e in ipairs(run.events) do
    if e.kind == "walls" and e.object == p.name then return e.text end
  end
end

local function look_at_mesh(context, worst, p, i, run)
  if is_line(p.object) then return end
  worst.passed = worst.passed or passed(p, run)
  local flattened = pressed.mesh(p.object, p.body)
  worst.flat = math.max(worst.flat or 0, flattened)
  worst.wall = math.max(worst.wall or 0, p.body.inner and p.body.wall / (p.body.radius - p.body.wall / 2)
    or math.huge)
  if not p.body.known then worst.blind = p.name end
  local q = p.region and pressed.beside(context.scene, i, p.region) or 0
  local share = flat.share(p.body, q)
  if share > (worst.beside or 0) then worst.beside, worst.load, worst.wire = share, q, p.name end
end

function section.look(context, run)
  local worst = { q = 0, share = 0 }
  for i, w in ipairs(context.data.wires) do
    if core.exists(w.object) then
      if is_line(w.object) then look_at_line(context, worst, w, i)
      elseif context.pressed[w.name] then look_at_mesh(context, worst, context.pressed[w.name], i, run) end
    end
  end
  return worst
end

-- --- deciding -----------------------------------------------------------------------------

--- Returns the error of springs in a thick wall's force; nil: not known, for a solid wire.
function section.left(rung, f)
  return rung == 2 and f.flat and f.wall < math.huge and WALL * f.flat * f.wall or nil
end

local function free_of_springs(f, share)
  local left = section.left(2, f)
  if not left or left > LEFT * share then return nil end
  return ("the walls are thin, %s of their radius, and flattened by %s: springs leave out %s (limit %s)")
    :format(facts.percent(f.wall), facts.percent(f.flat), facts.percent(left), facts.percent(LEFT * share)),
    left
end

function section.free(context, rung, f, share)
  context.section_limit = math.min(context.section_limit or share, share)
  if rung == 2 then return free_of_springs(f, share) end
  if rung > 2 or f.unknown then return nil end
  if f.q == 0 then return "nothing presses on a wire" end
  if f.share > share then return nil end
  return ("'%s' is pressed by up to %s and flattened by %s of its width (limit %s), "
    .. "reckoned with the modulus of %s"):format(
    f.wire, number.text(f.q, "N/m"), facts.percent(f.share), facts.percent(share), f.of)
end

--- Returns why the rung no longer suffices, by what the run showed so far, or nil. A section of unknown
-- stiffness is no reason: no mesh of it can be made.
function section.broken(f, share, rung)
  local left = section.left(rung, f)
  if rung == 1 and f.share > share then
    return ("'%s' was pressed by %s and flattened by %s of its width (limit %s)"):format(f.wire,
      number.text(f.q, "N/m"), facts.percent(f.share), facts.percent(share))
  elseif left and left > LEFT * share then
    return ("walls were flattened by %s, of which springs leave out %s (limit %s)"):format(
      facts.percent(f.flat), facts.percent(left), facts.percent(LEFT * share))
  end
end

--- Skips the next rung if the stiffness of the pressed wire is not known, or if it begins inside something.
function section.skip(context, rung, f, share)
  if rung == 1 and context.inside == nil then context.inside = begins_inside(context) or false end
  if rung == 1 and context.inside then return context.inside end
  if rung > 1 or not f.unknown or f.share > share then return nil end
  return ("the stiffness of the section of '%s' is not known: give E"):format(f.unknown)
end

--- Raises the rung for lines between faces that leave them no room: these fail, or their forces are wrong.
function section.mends(_, rung, result, tightest)
  local f = result.facts and result.facts.section
  if rung > 1 then return nil end
  if result.reason and result.reason:find("whose section does not change", 1, true) then
    return "a quantity that was asked for needs a section that changes"
  end
  if not f or (f.squeeze or 0) <= SQUEEZED * tightest then return nil end
  return ("'%s' is squeezed from both sides, which a line cannot compute"):format(f.squeezed)
end

function section.short(context, f, share, state)
  if state.rung == 1 and state.by ~= "compared" then
    if f.unknown or f.share <= share then return nil end
    if context.inside then return context.inside end
    local advice = state.by == "failed" and "no mesh of it can be computed"
      or "take a mesh, help 'models'"
    if (f.squeeze or 0) > share then
      return ("'%s' is squeezed from both sides, where the force on a line is arbitrary: %s"):format(
        f.squeezed,
        advice)
    end
    return ("'%s' is pressed by up to %s and flattened by %s of its width (limit %s): %s")
      :format(f.wire, number.text(f.q, "N/m"), facts.percent(f.share), facts.percent(share), advice)
  end
  if f.passed then return f.passed end
  if f.blind then
    return ("the stiffness of the section of '%s' against pressure is not known: give E"):format(
      f.blind)
  end
  if (f.beside or 0) <= share then return nil end
  return ("'%s' is pressed by up to %s where it is not a mesh, and flattened there by %s of its width (limit "
    .. "%s)"):format(f.wire, number.text(f.load, "N/m"), facts.percent(f.beside), facts.percent(share))
end

return section
