-- SPDX-License-Identifier: GPL-3.0-or-later
--- Pictures of a run that need neither a display nor another program: shaded, as particles, or as edges and
-- lines; PNG or SVG; one moment or several side by side.
-- @module softworld.output.picture
local checks = require "softworld.checks"
local core = require "softworld.core"
local looks = require "softworld.output.looks"
local povscene = require "softworld.output.povscene"
local props = require "softworld.output.props"
local scale = require "softworld.output.scale"
local sheet = require "softworld.output.sheet"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"
local vec = require "softworld.vec"
local view = require "softworld.output.view"

local picture = {}

local gap, caption_height, foot_height = 10, 30, 26 -- [px]
local most_dots = 25e6
local smallest = 32                                 -- least side of a panel [px]
local ink, soft = { 0.12, 0.13, 0.15 }, { 0.36, 0.38, 0.42 }
local nowhere, upright = { 0, 0, 0 }, { 1, 0, 0, 0 }
local line_colour = { 0.25, 0.28, 0.33 }

-- --- what is drawn ----------------------------------------------------------------------

-- Returns the triangles of a shape; each shape is triangulated once.
local function triangles(look, shape)
  local known = look.shapes[shape]
  if not known then
    known = solid.triangles(shape, 64)
    look.shapes[shape] = known
  end
  return known
end

local function add_solid(drawing, look, shape, pose, colour, gloss)
  local mesh, p, q = triangles(look, shape), solid.pose(pose)
  drawing:mesh(mesh.vertices, mesh.indices, p, q, colour, gloss)
end

local function add_floor(drawing, look, obstacle, pose)
  local n, p = solid.normal(obstacle, pose), solid.pose(pose)
  local down = vec.dot(n, vec.sub(look.bounds.centre, p))
  local middle = vec.sub(look.bounds.centre, vec.scale(n, down)) -- below the centre of the scene
  local square = povscene.square(look.size)
  drawing:floor(middle, n, square, 0.62 * look.size, obstacle.color or povscene.colours.plane)
end

local function add_obstacles(drawing, run, frame, look)
  for i, o in ipairs(run.obstacles or {}) do
    local pose = (frame.obstacles or {})[i]
    if pose ~= false and solid.flat(o) then
      if look.technique ~= "wireframe" then add_floor(drawing, look, o, pose) end
    elseif pose ~= false then
      add_solid(drawing, look, o, pose, o.color or povscene.colours.obstacle, 0.06)
    end
  end
  for _, prop in ipairs(props.of(run, frame, look)) do
    local p, q = solid.pose(prop.pose)
    for _, part in ipairs(prop.parts) do
      local x, y, z = solid.rotate(q, part.at[1], part.at[2], part.at[3])
      local mesh = solid.triangles(part.shape, 32)
      drawing:mesh(mesh.vertices, mesh.indices, { p[1] + x, p[2] + y, p[3] + z },
        part.rotation and vec.multiply(q, part.rotation) or q, part.colour, 0.08)
    end
  end
end

local EDGE = 8e-4 -- radius of drawn edges of zones, over the size of the scene [-]

-- Draws zones by their edges, because one must see through them. The edges are found once.
local function add_zones(drawing, run, frame, look)
  for _, z in ipairs(run.zones or {}) do
    local pose, colour = solid.carried(z, frame), povscene.colours[z.temperature and "heat" or "zone"]
    look.shapes[z] = look.shapes[z] or solid.edges(z)
    local ends = pose and solid.place(look.shapes[z], pose) or {}
    if look.technique == "wireframe" then
      drawing:lines(ends, colour)
    else
      for i = 1, #ends, 6 do
        drawing:tube(table.move(ends, i, i + 5, 1, {}), EDGE * look.size, colour, 0)
      end
    end
  end
end

-- Returns the flat list of the ends of straight lines from point to point.
local function chain(points)
  local out = {}
  for i = 1, #points - 5, 3 do table.move(points, i, i + 5, #out + 1, out) end
  return out
end

local function doubled(colours)
  if #colours == 3 then return colours end
  local out = {}
  for i = 1, #colours - 5, 3 do table.move(colours, i, i + 5, #out + 1, out) end
  return out
end

-- Draws a wire that is a mesh of particles: its surface, or the particles on it.
local function add_surface(drawing, look, surface, line, radius, colours)
  local points = solid.thickened(surface, line, look.thickness)
  if look.technique == "particles" then
    return drawing:balls(points, 1.1 * radius * math.pi / surface.around, colours, 0.3)
  end
  local quads, ends = solid.tube_faces(surface)
  if look.technique == "wireframe" then
    local list = {}
    for i = 1, #quads, 4 do
      for _, c in ipairs { quads[i], quads[i + 1], quads[i], quads[i + 3] } do
        table.move(points, 3 * c + 1, 3 * c + 3, #list + 1, list)
      end
    end
    return drawing:lines(list, { colours[1], colours[2], colours[3] })
  end
  local corners = {}
  local function face(a, b, c) table.move({ a, b, c }, 1, 3, #corners + 1, corners) end
  for i = 1, #quads, 4 do
    face(quads[i], quads[i + 1], quads[i + 2])
    face(quads[i], quads[i + 2], quads[i + 3])
  end
  for _, e in ipairs(ends) do
    for k = 2, #e - 1 do face(e[1], e[k], e[k + 1]) end
  end
  drawing:mesh(points, corners, nowhere, upright, colours, 0.3)
end

local function colours_of(run, frame, look, i, count, times)
  local values = look.scale and frame.values and frame.values[i]
  values = values and values[look.colour]
  if values and #values == count then return scale.colours(look.scale, values, times) end
  local w = run.wires[i]
  return w.color or look.scale and { 0.54, 0.56, 0.60 } or
    povscene.colours.wires[(i - 1) % #povscene.colours.wires + 1]
end

local function add_wires(drawing, run, frame, look)
  for i, points in ipairs(frame.wires or {}) do
    local surface, radius = (frame.surfaces or {})[i], run.wires[i].radius * look.thickness
    local colours = colours_of(run, frame, look, i, #points // 3, surface and surface.around)
    if surface then
      add_surface(drawing, look, surface, points, radius, colours)
    elseif look.technique == "wireframe" then
      drawing:lines(chain(points), doubled(colours))
    elseif look.technique == "particles" then
      drawing:tube(points, 0.3 * radius, line_colour, 0.1)
      drawing:balls(points, radius, colours, 0.4)
    else
      drawing:tube(points, radius, colours, 0.35)
    end
  end
end

local function add_object(drawing, look, p, points, colour)
  p.corners = p.corners or solid.enclosed(p.edges)
  local radius = math.max(p.radius or 0, 0.75 / look.per_metre)
  if look.technique == "shaded" and #p.corners > 0 then
    drawing:mesh(points, p.corners, nowhere, upright, colour, 0.05)
  elseif look.technique ~= "wireframe" then
    drawing:balls(points, math.max(radius, 1.5 / look.per_metre), colour, 0.3)
  end
  if look.technique ~= "shaded" or #p.corners == 0 then
    local list = {}
    for k = 1, #p.edges, 8 do
      local a, b = ("<I4I4"):unpack(p.edges, k)
      table.move(points, 3 * a + 1, 3 * a + 3, #list + 1, list)
      table.move(points, 3 * b + 1, 3 * b + 3, #list + 1, list)
    end
    drawing:lines(list, colour)
  end
end

local function add_particles(drawing, run, frame, look)
  for i, points in ipairs(frame.particles or {}) do
    local p = run.particles and run.particles[i] or { edges = "" }
    local colours = povscene.colours.wires
    local colour = p.color or colours[(#run.wires + i - 1) % #colours + 1]
    if #points > 0 then add_object(drawing, look, p, points, colour) end -- else not in this frame
  end
end

--- Returns a drawing of one frame.
-- @tparam table run
-- @tparam table frame one of run.frames
-- @tparam table look of picture.look
-- @treturn userdata of core.drawing
function picture.drawing(run, frame, look)
  local drawing = core.drawing()
  add_obstacles(drawing, run, frame, look)
  add_zones(drawing, run, frame, look)
  add_wires(drawing, run, frame, look)
  add_particles(drawing, run, frame, look)
  return drawing
end

--- Returns what all pictures of a run share.
-- @tparam table run
-- @tparam number width of a panel [px]
-- @tparam number height [px]
-- @tparam table options technique, colour, range, camera, thickness
-- @treturn table
function picture.look(run, width, height, options)
  local look = looks.of(run, width, height, options)
  look.technique, look.colour, look.shapes = options.technique or "shaded", options.colour, {}
  look.bounds = solid.bounds(run)
  look.camera.sky = view.up(run)
  if options.colour then
    local low, high = table.unpack(options.range or { run.range(options.colour) })
    if not low then
      sink.fail("a picture: the wires of '%s' have no %s", run.name or "run", options.colour)
    end
    look.scale = scale.new(options.colour, low, high)
  end
  return look
end

-- --- sheets -----------------------------------------------------------------------------

local bar_width, bar_height, letters = 170, 12, 14 -- [px]

-- Draws the name, least value, colours and largest value; returns where it ends.
local function add_legend(paper, look, x, y)
  local s = look.scale
  x = x + paper:text(s.label, x, y, letters, ink) + 14
  x = x + paper:text(s.text(s.low), x, y, letters, soft) + 8
  x = math.floor(x) -- whole px, or gaps between the colours would show
  for k = 0, bar_width - 1 do
    paper:fill(x + k, y - bar_height + 1, 1, bar_height, s.at(s.low + k / (bar_width - 1) * (s.high - s.low)))
  end
  x = x + bar_width + 8
  return x + paper:text(s.text(s.high), x, y, letters, soft)
end

-- Returns the text, shortened to the room.
local function fitted(text, size, room)
  if sheet.width(text, size) <= room then return text end
  if not utf8.len(text) then text = text:gsub("[\128-\255]", "?") end
  for last = utf8.len(text), 1, -1 do
    local part = text:sub(1, utf8.offset(text, last + 1) - 1) .. "..."
    if sheet.width(part, size) <= room then return part end
  end
  return ""
end

local function add_foot(paper, layout, look, note)
  local y, x = layout.height - 9, gap
  if look.scale then x = add_legend(paper, look, gap, y) + 20 end
  if note == "" then return end
  note = fitted(note, letters - 1, layout.width - gap - x)
  paper:text(note, layout.width - gap - sheet.width(note, letters - 1), y, letters - 1, soft)
end

--- Draws frames of a run on a sheet.
-- @tparam table paper of softworld.output.sheet
-- @tparam table layout columns, panel_width, panel_height, width, height [px]
function picture.fill(paper, layout, run, frames, look, captions)
  for i, frame in ipairs(frames) do
    local x = gap + (i - 1) % layout.columns * (layout.panel_width + gap)
    local y = gap + (i - 1) // layout.columns * (layout.panel_height + layout.caption + gap)
    paper:show(picture.drawing(run, frame, look), look.camera, look.technique, x, y, layout.panel_width,
      layout.panel_height)
    if layout.caption > 0 then
      local text = fitted(captions[i], layout.letters, layout.panel_width)
      paper:text(text, x + 1, y + layout.panel_height + layout.letters + 5, layout.letters, ink)
    end
  end
  add_foot(paper, layout, look, looks.foot(run, look, layout.width))
end

local function layout_of(columns, rows, panel_width, panel_height, caption)
  return { columns = columns, panel_width = panel_width, panel_height = panel_height, caption = caption,
    letters = 17, width = columns * (panel_width + gap) + gap,
    height = gap + rows * (panel_height + caption) + (rows - 1) * gap + foot_height }
end

-- Returns the height of a panel, smaller where the view would leave it empty above and below.
local function trimmed(look, width, height)
  return math.floor(math.max(0.3 * width, math.min(height, height * (look.camera.filled or 1) / 0.8)) + 0.5)
end

--- Plans sizes and view for a number of moments.
-- @treturn table layout, as picture.fill takes it
-- @treturn table look
function picture.plan(run, count, options)
  local columns = looks.columns(options.columns, count)
  local rows = (count + columns - 1) // columns
  local caption = options.caption == "" and 0 or caption_height
  local width = options.width or (count == 1 and 1080 or 1500)
  local height = options.height or count == 1 and 680 or 390 * rows
  local panel_width = math.floor((width - gap) // columns - gap)
  local panel_height = math.floor((height - gap - foot_height - (rows - 1) * gap) // rows - caption)
  if panel_width < smallest or panel_height < smallest then
    sink.fail("a picture: %g x %g px is too small for %d moments in %d columns", width, height, count,
      columns)
  end
  local look = picture.look(run, panel_width, panel_height, options)
  if not options.height and not (type(options.camera) == "table" and options.camera.from) then
    panel_height = trimmed(look, panel_width, panel_height)
    look = picture.look(run, panel_width, panel_height, options)
  end
  local layout = layout_of(columns, rows, panel_width, panel_height, caption)
  if layout.width * layout.height > most_dots then
    sink.fail("a picture: %d x %d px are more than %g million", layout.width, layout.height, most_dots / 1e6)
  end
  return layout, look
end

local kinds = { png = sheet.dots, svg = sheet.lines }

local function check(run, options)
  if not run.frames or #run.frames == 0 then
    sink.fail("a picture: the run of '%s' has no frames, %s", run.name, run.none)
  end
  if not kinds[sink.extension(options.path)] then
    sink.fail("a picture: path %s ends in none of .png .svg", checks.shown(options.path))
  end
  return solid.finite_run(run)
end

--- Writes one moment, or several side by side, to a file.
-- @tparam table run as softworld.run.files makes it for pictures: `range(quantity)` gives least and largest
-- @tparam table options path, technique, colour, range, camera, thickness, times or count, columns, width,
-- height, caption, captions
-- @treturn table `path, width, height [px], thickness, note`; with a colour `low, high`
function picture.write(run, options)
  run = check(run, options)
  local frames = looks.frames(run, options.count or 1, options.times)
  local layout, look = picture.plan(run, #frames, options)
  local paper = kinds[sink.extension(options.path)](layout.width, layout.height)
  local captions = {}
  for i, frame in ipairs(frames) do captions[i] = looks.caption(run, frame, i, options) end
  picture.fill(paper, layout, run, frames, look, captions)
  sink.write_file(options.path, paper:bytes())
  return { path = options.path, width = layout.width, height = layout.height, thickness = look.thickness,
    note = looks.foot(run, look, layout.width), low = look.scale and look.scale.low,
    high = look.scale and look.scale.high }
end

return picture
