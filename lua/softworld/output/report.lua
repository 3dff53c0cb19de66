-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes the player: one HTML file that shows runs moving, with charts and numbers. Its sources are in
-- lua/softworld/page. Frames go from the core into the page as bytes, see csrc/film/film.h.
-- @module softworld.output.report
local core = require "softworld.core"
local build = require "softworld.scene.build"
local json = require "softworld.output.json"
local letters = require "softworld.output.letters"
local number = require "softworld.output.number"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"

local report = {}

local most_rows = 3000    -- most rows of a series in a page
local longest = 400000    -- longest script that is shown [B]

-- --- bytes ------------------------------------------------------------------------------

-- Adds bytes to the page beside its data; returns their number, from 0.
local function add_blob(page, bytes)
  page.blobs[#page.blobs + 1] = core.base64(bytes)
  return #page.blobs - 1
end

-- --- series -----------------------------------------------------------------------------

-- Returns the least and the largest number of a column in rows from .. to, in the order of time.
local function ends_of(values, from, to)
  local low, high
  for i = from, to do
    local x = values[i]
    if x == x then
      if not low or x < values[low] then low = i end
      if not high or x > values[high] then high = i end
    end
  end
  if not low then return 0 / 0, 0 / 0 end
  if low > high then low, high = high, low end
  return values[low], values[high]
end

-- Returns a series of at most most_rows rows: two for each bucket, with its least and largest value.
local function thinned(series)
  local count = #series.time
  if count <= most_rows then return series, 1 end
  local buckets = most_rows // 2
  local few = { time = {}, columns = {} }
  local function bucket(k) return 1 + (k - 1) * count // buckets, k * count // buckets end
  for k = 1, buckets do
    local from, to = bucket(k)
    few.time[2 * k - 1], few.time[2 * k] = series.time[from], series.time[(from + to + 1) // 2]
  end
  for c, column in ipairs(series.columns) do
    local values = {}
    for k = 1, buckets do values[2 * k - 1], values[2 * k] = ends_of(column.values, bucket(k)) end
    few.columns[c] = { name = column.name, unit = column.unit, values = values }
  end
  return few, count / #few.time
end

local function series_of(page, run)
  if not run.series or #run.series.time == 0 then return nil end
  local series, every = thinned(run.series)
  local bytes, columns = { sink.packed("d", series.time) }, {}
  for c, column in ipairs(series.columns) do
    columns[c] = { name = column.name, unit = column.unit or "" }
    bytes[#bytes + 1] = sink.packed("f", column.values)
  end
  return { rows = #series.time, of = #run.series.time, thinned = every > 1, columns = columns,
    blob = add_blob(page, core.deflate(table.concat(bytes))) }
end

-- --- what is in the scene ------------------------------------------------------------------

local function shape_of(page, entry)
  if solid.flat(entry) then return { normal = solid.normal(entry) } end
  local shape = solid.triangles(entry, 48)
  local bytes = sink.packed("f", shape.vertices) .. sink.packed("I4", shape.indices)
  return { vertices = #shape.vertices // 3, indices = #shape.indices,
    blob = add_blob(page, core.deflate(bytes)) }
end

-- True for a list of up to four numbers: a size, a direction, a turn; points are lists of lists.
local function is_short(value)
  if type(value) ~= "table" or #value > 4 then return false end
  for _, x in ipairs(value) do
    if type(x) ~= "number" then return false end
  end
  return true
end

-- Adds a shape to the page; equal shapes are added once.
local function add_shape(page, entry)
  local key = {}
  for name, value in pairs(entry) do
    if is_short(value) then value = table.concat(value, " ") end
    if name ~= "name" and name ~= "at" and name ~= "rotation" then
      key[#key + 1] = ("%s=%s"):format(name, tostring(value))
    end
  end
  table.sort(key)
  key = table.concat(key, ";")
  page.shapes[key] = page.shapes[key] or shape_of(page, entry)
  return page.shapes[key]
end

local function obstacles_of(page, run)
  local list = {}
  for i, o in ipairs(run.obstacles) do
    list[i] = json.object{ name = o.name, kind = o.shape, slot = o.slot, part = o.part,
      friction = o.friction, shape = add_shape(page, o) }
  end
  return list
end

local function zones_of(page, run)
  local list = {}
  for i, z in ipairs(run.zones or {}) do
    list[i] = json.object{ name = z.name, kind = z.kind, temperature = z.temperature, at = z.position,
      rotation = z.rotation, on = z.on and json.object{ slot = z.on.slot, at = z.on.position,
        rotation = z.on.rotation }, shape = add_shape(page, z) }
  end
  return list
end

local function summary_of(run)
  local list = {}
  for i, row in ipairs(run.summary or {}) do
    local value, unit = row.value, ""
    if type(value) == "number" then value, unit = number.engineering(value, row.unit) end
    list[i] = json.object{ label = row.label, value = tostring(value), unit = (unit:gsub("^u", "µ")),
      raw = row.value, raw_unit = row.unit, where = row.where, when = row.when,
      wrong = row.label:find "EXCEEDED" ~= nil or row.label:find "FOLDED" ~= nil
        or row.label:find "SLIPPED" ~= nil or row.label:find "LOST" ~= nil or nil }
  end
  return list
end

local function particles_of(page, run)
  local list = {}
  for i, p in ipairs(run.particles) do
    list[i] = json.object{ name = p.name, radius = p.radius, edges = #p.edges // 8,
      blob = #p.edges > 0 and add_blob(page, core.deflate(p.edges)) or nil }
  end
  return list
end

local function film_of(page, run)
  local bytes, frames, broken = core.film(run.scene, run.from, run.to, run.ok)
  return { frames = frames, broken = broken, thinned = core.frames_thinned(run.scene),
    blob = frames > 0 and add_blob(page, bytes) or nil }
end

local words = {
  slip = function(g, e) return ("the wire slips in gripper '%s' at s = %.4g m"):format(g.name, e.s) end,
  lost = function(g) return ("gripper '%s' loses the wire"):format(g.name) end,
  crash = function(_, e) return ("%s runs into %s"):format(e.part, e.obstacle) end,
  crushed = function(g) return ("gripper '%s' crushes the wire"):format(g.name) end,
  missed = function(g) return ("gripper '%s' closes on nothing"):format(g.name) end,
  unreached = function(g) return ("gripper '%s' does not reach its force"):format(g.name) end,
  frozen = function(g) return ("gripper '%s' carries the wire as one with it"):format(g.name) end,
  thawed = function(g) return ("gripper '%s' holds the wire by its pads again"):format(g.name) end,
}

-- Returns the events of the run and of its grippers, in the order of time. A crash and a lost wire are in
-- both lists; they are kept once.
local function events_of(run)
  local list, told = {}, {}
  for _, e in ipairs(run.events) do
    list[#list + 1], told[e.kind .. e.time] = e, true
  end
  for _, g in ipairs(build.data(run.scene).grippers) do
    for _, e in ipairs(g.events) do
      if words[e.kind] and e.time >= run.start and e.time <= run.time and not told[e.kind .. e.time] then
        list[#list + 1] = { kind = e.kind, time = e.time, object = g.name, s = e.s,
          text = words[e.kind](g, e) }
      end
    end
  end
  table.sort(list, function(a, b) return a.time < b.time end)
  return list
end

-- Returns a run's description without what depends on time: film, events, numbers.
local function outline_of(page, run)
  return json.object{ name = run.name, ok = run.ok, reason = run.reason, time = run.time,
    start = run.start, steps = run.steps, cpu = run.cpu, unmet = run.unmet, model = run.model,
    gravity = run.gravity,
    wires = run.wires, particles = particles_of(page, run), grips = run.grips, holds = run.holds,
    obstacles = obstacles_of(page, run), zones = zones_of(page, run) }
end

local function add_run(page, run)
  local one = outline_of(page, run)
  one.events, one.film = events_of(run), film_of(page, run)
  if run.ok then
    one.summary, one.series, one.quantities = summary_of(run), series_of(page, run), run.quantities
  end
  page.data.runs[#page.data.runs + 1] = one
end

-- Returns the running script, or nil.
local function script()
  local path = type(rawget(_G, "arg")) == "table" and rawget(_G, "arg")[0]
  if type(path) ~= "string" or core.kind(path) ~= "file" then return nil end
  local fine, text = pcall(sink.read_file, path)
  if not fine or #text > longest or text:find "\0" then return nil end
  return { name = sink.base(path), text = text }
end

-- --- the page ------------------------------------------------------------------------------

local function write_page(page, write)
  local template = core.page()
  local title_from, title_to = template:find("@title@", 1, true)
  local data_from, data_to = template:find("@data@", 1, true)
  write(template:sub(1, title_from - 1))
  write(letters.xml(page.data.title))
  write(template:sub(title_to + 1, data_from - 1))
  for i, text in ipairs(page.blobs) do
    write(('<script type="text/plain" id="blob-%d">'):format(i - 1))
    write(text)
    write "</script>\n"
  end
  write '<script type="application/json" id="data">'
  -- escaped, so that no text can end the script element or open a comment in it
  write((json.encode(page.data):gsub("[<>&]", { ["<"] = "\\u003c", [">"] = "\\u003e", ["&"] = "\\u0026" })))
  write "</script>"
  write(template:sub(data_to + 1))
end

--- Returns what a live page draws of a scene that runfiles describes: JSON of { run =, blobs = base64 }. The
-- run's shapes are numbers in the list of blobs, from 0.
function report.outline(run)
  local page = { blobs = {}, shapes = {} }
  local one = outline_of(page, run)
  one.events, one.film = {}, { frames = 0, broken = 0, thinned = 1 }
  return one, page.blobs
end

--- Returns the HTML of a page without runs, which gets its content through a socket. data: further data for
-- it.
function report.live(title, data)
  local parts = {}
  write_page({ blobs = {}, data = json.object{ version = core.version, runs = {}, title = title,
    made = os.date "%Y-%m-%d %H:%M", live = data } }, function(text) parts[#parts + 1] = text end)
  return table.concat(parts)
end

--- Writes runs into one page.
-- @tparam {table,...} runs as softworld.run.files describes them for it
-- @tparam string path ending in .html
-- @tparam[opt] table options title; check, of softworld.check.page
-- @treturn string the path
function report.write(runs, path, options)
  local kind = sink.extension(path)
  if kind ~= "html" and kind ~= "htm" and (core.kind(path) or "file") == "file" then
    sink.fail("report: %s does not end in .html", path)
  end
  local names = {}
  for i, run in ipairs(runs) do names[i] = run.name end
  local page = { blobs = {}, shapes = {}, data = json.object{ version = core.version, runs = {},
    title = options and options.title or table.concat(names, ", "), made = os.date "%Y-%m-%d %H:%M",
    check = options and options.check, script = script() } }
  for _, run in ipairs(runs) do add_run(page, run) end
  return sink.write_file(path, function(write) write_page(page, write) end)
end

return report
