-- SPDX-License-Identifier: GPL-3.0-or-later
--- Forms whose line is not simply their fields: joins and ties of wires, objects of particles, and waiting
-- for a read-out. Each has rows for its fields, and write(values, refer, source), which returns its line;
-- refer(name): the object with this name, for source.
-- @module softworld.view.special
local special = {}

local function fail(text, ...) error(text:format(...), 0) end

local function need(values, kind, name, what)
  if values[name] == nil then fail("%s: %s is required%s", kind, name, what and ": " .. what or "") end
  return values[name]
end

-- Returns some of the values, by their names.
local function some(values, names)
  local args = {}
  for name in names:gmatch "%S+" do args[name] = values[name] end
  return args
end

-- --- joins and ties ------------------------------------------------------------------------------

local ends = { { "one", "s" }, { "other", "other_s" }, { "third", "third_s" } }

local function write_join(values, refer, source)
  local args = some(values, "name rigid")
  args.ends = {}
  for i, pair in ipairs(ends) do
    local wire, s = values[pair[1]], values[pair[2]]
    if wire == nil and s ~= nil then fail("join: %s is given, but not %s", pair[2], pair[1]) end
    if wire == nil and i < 3 then need(values, "join", pair[1], "the wire") end
    if wire ~= nil then
      args.ends[i] = { refer(wire), s = need(values, "join", pair[2], "where on the wire [m]") }
    end
  end
  return "scene:join " .. source(args)
end

local function write_tie(values, refer, source)
  local args = some(values, "s to slack stiffness strength name")
  if values.to_wire ~= nil then
    if args.to then fail "tie: give to or to_wire, not both" end
    args.to = { refer(values.to_wire), s = need(values, "tie", "to_s", "where on the other wire [m]") }
  elseif values.to_s ~= nil then
    fail "tie: to_s is given, but not to_wire"
  end
  return ("scene:tie(%s, %s)"):format(refer(need(values, "tie", "_on", "the wire")).text, source(args))
end

-- --- objects of particles ------------------------------------------------------------------------

local function flat(points)
  local all = {}
  for _, p in ipairs(points) do table.move(p, 1, 3, #all + 1, all) end
  return all
end

local function write_particles(values, _, source)
  local args = some(values, "name masses radius")
  args.positions = flat(need(values, "particles", "positions"))
  local function all(what, group, key, words)
    return values[group] and { { [group] = values[group], [key] = need(values, what, key, words) } } or nil
  end
  args.links = all("particles", "pairs", "k", "of links")
  args.folds = all("particles", "triples", "stiffness", "of folds")
  return "scene:particles " .. source(args)
end

local MOST_IN_SHEET = 900

local function short(x) return tonumber(("%.12g"):format(x)) end

-- Writes a sheet: rows of particles, linked to their neighbours and, if wanted, diagonally.
local function write_sheet(values, _, source)
  local args, n, m = some(values, "name masses radius"), values.columns or 6, values.rows or 6
  if n < 2 or m < 2 or n * m > MOST_IN_SHEET then
    fail("sheet: %d x %d particles are not allowed in a form; 2 x 2 to %d in all", n, m, MOST_IN_SHEET)
  end
  local at, along = need(values, "sheet", "at"), need(values, "sheet", "along")
  local across = need(values, "sheet", "across")
  local positions, links, diagonals = {}, {}, {}
  local function link(list, a, b) list[#list + 1], list[#list + 2] = a, b end
  for j = 1, m do
    for i = 1, n do
      local k = (j - 1) * n + i
      for c = 1, 3 do
        local x = along[c] * (i - 1) / (n - 1) + across[c] * (j - 1) / (m - 1)
        positions[#positions + 1] = short(at[c] + x)
      end
      if i < n then link(links, k, k + 1) end
      if j < m then link(links, k, k + n) end
      if i < n and j < m then
        link(diagonals, k, k + n + 1)
        link(diagonals, k + 1, k + n)
      end
    end
  end
  args.positions, args.links = positions, { { pairs = links, k = need(values, "sheet", "k", "of links") } }
  if values.shear then args.links[2] = { pairs = diagonals, k = values.shear } end
  return "scene:particles " .. source(args)
end

-- --- waiting --------------------------------------------------------------------------------------

local function waiting(condition)
  return function(values, refer, source)
    local more = values.timeout and (", { timeout = %s }"):format(source(values.timeout)) or ""
    return ("p:wait_until(%s%s)"):format(source(condition(values, refer)), more)
  end
end

local function on(name)
  return function(values, refer)
    local what = "wait for " .. name
    return { [name] = need(values, what, name), on = refer(need(values, what, "on")) }
  end
end

local function contact(values, refer)
  return { contact = refer(need(values, "wait for contact", "contact", "the obstacle")) }
end

local function distance(values, refer)
  local other = values.point
  if values.to and other then fail "wait for distance: give to or point, not both" end
  if values.to then other = refer(values.to) end
  if not other then fail "wait for distance: to or point is required" end
  return { distance = need(values, "wait for distance", "distance"),
    between = { refer(need(values, "wait for distance", "from")), other } }
end

-- --- what they are ----------------------------------------------------------------------------------

local function row(kind, unit)
  return function(name, doc, required, more)
    local one = { name = name, type = kind, unit = unit, doc = doc, required = required }
    for key, value in pairs(more or {}) do one[key] = value end
    return one
  end
end
local thing, word, list = row("wire", "-"), row("text", "-"), row("list of numbers", "-")
local place = row("vector", "m")
local function positive(name, unit, doc, required, usual)
  return row("number", unit)(name, doc, required, { min = 0, above = true, usual = usual })
end
local function length(name, doc, required) return row("number", "m")(name, doc, required, { min = 0 }) end
local function count(name, doc)
  return row("integer", "-")(name, doc, nil, { min = 2, max = 100, default = 6 })
end

local timeout = positive("timeout", "s", "goes on after this time in any case", nil, "none")
local name = word("name", "name used in messages and series")
local radius = length("radius", "of the surface around particles and links")
local solids = { of = "gripper clamp obstacle" }

local function step(kind, condition, doc, rows, own)
  local words = {}
  for i, one in ipairs(rows) do words[i] = one.name end
  rows[#rows + 1] = timeout
  return { class = "step", kind = "wait_for_" .. kind, method = "wait_until", self = "p", own = own,
    rows = rows, write = waiting(condition), first = table.concat(words, " ") .. " timeout",
    doc = doc .. "; other conditions are Lua functions, in a script" }
end

special.kinds = {
  { class = "fixing", kind = "join", method = "join", write = write_join, first = "one s other other_s",
    doc = "wires fixed to each other where they meet, as in a harness",
    rows = { thing("one", "a wire", true), length("s", "arc length where it meets the other wire", true),
      thing("other", "another wire", true), length("other_s", "where that meets it", true),
      thing("third", "one more wire"), length("third_s", "arc length of the third wire at the join"), name,
      row("boolean", "-")("rigid", "the angles between the wires are kept") } },
  { class = "particles", kind = "sheet", method = "particles", write = write_sheet,
    first = "name at along across columns rows masses k shear",
    doc = "a net or a piece of fabric: rows of particles with links between neighbours",
    rows = { name, place("at", "its first corner", true), place("along", "its one side", true),
      place("across", "its other side", true), count("columns", "particles along"),
      count("rows", "particles across"), positive("masses", "kg", "of each particle", true),
      positive("k", "N/m", "stiffness of links", true),
      positive("shear", "N/m", "stiffness of links across cells", nil, "none"), radius } },
  { class = "particles", kind = "particles", method = "particles", write = write_particles,
    first = "name positions masses pairs k",
    doc = "any object of particles; prisms, hexahedra, yield and repelling are for scripts",
    rows = { name, row("points", "m")("positions", "of the particles", true),
      positive("masses", "kg", "of each particle", true),
      list("pairs", "links: numbers of two particles each, 1 2 2 3"),
      positive("k", "N/m", "stiffness of links"),
      list("triples", "folds: numbers of three particles in a row each"),
      positive("stiffness", "N m", "of folds"), radius } },
  { class = "hold", kind = "hold", method = "hold", on = "particles", first = "particles name",
    doc = "a clamp of some particles of an object",
    rows = { list("particles", "which ones, from 1 on", true), name } },
  step("force", on "force", "until a gripper or clamp pulls its wire, or wires press on an obstacle, with "
    .. "this force",
    { thing("on", "gripper, clamp or obstacle", true),
      row("number", "N")("force", "its size at least", true, { min = 0 }) }, { on = solids }),
  step("slip", on "slip", "until a wire has slid this far through a gripper's pads",
    { row("gripper", "-")("on", "with pads", true), length("slip", "way at least", true) }),
  step("contact", contact, "until something touches an obstacle", { thing("contact", "the obstacle", true) },
    { contact = { of = "obstacle" } }),
  step("distance", distance, "until two objects are this close to each other",
    { thing("from", "gripper, clamp or obstacle", true), thing("to", "another one"),
      place("point", "instead of another one"), length("distance", "at most", true) },
    { from = solids, to = solids }),
}

--- Further rows of the form of ties.
special.tie = { write = write_tie, rows = { thing("to_wire", "another wire, instead of a place"),
  length("to_s", "where on that wire") } }

--- Initial values of new forms.
special.starts = {
  sheet = { at = { 0, 0, 0.2 }, along = { 0.2, 0, 0 }, across = { 0, 0.2, 0 }, columns = 6, rows = 6,
    masses = 5e-4, k = 100, shear = 20 },
  particles = { positions = { { 0, 0, 0.2 }, { 0.1, 0, 0.2 }, { 0.2, 0, 0.2 } }, masses = 1e-3,
    pairs = { 1, 2, 2, 3 }, k = 100 },
  wait_for_force = { force = 1, timeout = 1 }, wait_for_contact = { timeout = 1 },
  wait_for_slip = { slip = 1e-3, timeout = 1 }, wait_for_distance = { distance = 0.01, timeout = 1 },
}

return special
