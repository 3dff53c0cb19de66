-- SPDX-License-Identifier: GPL-3.0-or-later
--- Ray-traced pictures of a run through POV-Ray in a separate process.
-- Each frame is traced by itself; a last, flat scene sets the pictures side
-- by side and writes the captions, so that no other program is needed.
-- @module softworld.output.povray

local checks = require "softworld.checks"
local looks = require "softworld.output.looks"
local povscene = require "softworld.output.povscene"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"
local whole = require "softworld.output.whole"

local povray = {}

local gap, caption_height, foot_height = 10, 34, 24 -- [px]

local function complaint(text)
  local lines = {}
  for line in text:gmatch("[^\n]+") do
    if line:find("Error", 1, true) or line:find("Cannot", 1, true) then lines[#lines + 1] = line end
  end
  return #lines > 0 and table.concat(lines, "; ", 1, math.min(#lines, 3)) or text:sub(-200)
end

-- Runs POV-Ray in its working folder; it may be configured to touch no other.
local function trace(folder, name, width, height, extra)
  local command = string.format(
    "cd -- %s && exec povray +I%s.pov +O%s.png +FN8 +W%d +H%d -D -GD -GR -GS -P +WT%d %s",
    sink.quote(folder), name, name, width, height, extra.threads, extra.aa)
  local ok, text, code = sink.run(command)
  if not ok then sink.fail("povray failed (exit code %d): %s", code, complaint(text)) end
end

-- Returns a caption in which question marks replace characters that the internal font lacks.
local function caption_text(text)
  return (text:gsub("[\194-\244][\128-\191]*", "?"):gsub("[^\32-\126]", "?"):gsub('[\\"]', "\\%0"))
end

local function caption(text, x, y, size, shade, right)
  return string.format(
    '#declare T = text { internal 2 "%s" 0.01, 0 scale <%g,%g,1> }\nobject { T pigment { srgb %g } '
    .. "finish { Flat } translate <%g,%g,-2>%s }\n", caption_text(text), size, size, shade, x, y,
    right and " translate -x*(max_extent(T).x)" or "")
end

local function flat_scene(sheet)
  local parts = { string.format("#version 3.7;\nglobal_settings { assumed_gamma 1.0 charset utf8 }\n"
    .. "background { srgb 1 }\n#declare Flat = finish { ambient 0 diffuse 0 emission 1 }\n"
    .. "camera { orthographic location <%g,%g,-10> direction z right %d*x up %d*y }\n",
    sheet.width / 2, sheet.height / 2, sheet.width, sheet.height) }
  for i, panel in ipairs(sheet.panels) do
    local x = gap + (i - 1) % sheet.columns * (sheet.panel_width + gap)
    local row = (i - 1) // sheet.columns
    local y = sheet.height - gap - sheet.panel_height - row * (sheet.panel_height + caption_height + gap)
    parts[#parts + 1] = string.format(
      'box { 0, <1,1,0.01> pigment { image_map { png "%s.png" once } } finish { Flat }', panel.name)
    parts[#parts + 1] = string.format(" scale <%d,%d,1> translate <%d,%d,0> }\n",
      sheet.panel_width, sheet.panel_height, x, y)
    parts[#parts + 1] = caption(panel.caption, x + 2, y - 24, 22, 0.12)
  end
  if sheet.foot ~= "" then
    parts[#parts + 1] = caption(sheet.foot, sheet.width - gap, 10, 15, 0.38, true)
  end
  return table.concat(parts)
end

local function check(options, purpose)
  local run = type(options) == "table" and options.run
  if type(run) ~= "table" or not run.frames or #run.frames == 0 then
    sink.fail("%s: run = a run with at least one frame is expected", purpose)
  end
  if sink.extension(options.path or "") ~= "png" then
    sink.fail("%s: path %s does not end in .png", purpose, checks.shown(options.path))
  end
  sink.need("povray", "povray", purpose)
  return solid.finite_run(run)
end

local function render(sheet, run, frames, look, options)
  local path = options.path
  local folder, names = sink.temporary(path, true), { "sheet.pov", "sheet.png", "sheet.pov-state" }
  local settings = { threads = options.threads or 2, aa = options.draft and "-A" or "+A0.15 +AM2 +R3 -J" }
  local ok, why = pcall(function()
    for i, frame in ipairs(frames) do
      local name = "f" .. i
      for _, kind in ipairs{ ".pov", ".png", ".pov-state" } do names[#names + 1] = name .. kind end
      sink.write_file(folder .. "/" .. name .. ".pov", povscene.text(run, frame, look))
      trace(folder, name, sheet.panel_width, sheet.panel_height, settings)
      sheet.panels[i] = { name = name, caption = looks.caption(run, frame, i, options) }
    end
    sink.write_file(folder .. "/sheet.pov", flat_scene(sheet))
    settings.aa = "+A0.1 +AM1 +R4 -J"
    trace(folder, "sheet", sheet.width, sheet.height, settings)
    whole.commit(folder .. "/sheet.png", path)
  end)
  sink.remove_folder(folder, names)
  if not ok then error(why, 0) end
  return {
    path = path, width = sheet.width, height = sheet.height,
    thickness = look.thickness, note = sheet.foot,
  }
end

local function sheet_of(columns, rows, panel_width, panel_height)
  return {
    columns = columns, panel_width = panel_width, panel_height = panel_height, panels = {},
    width = columns * (panel_width + gap) + gap,
    height = gap + rows * (panel_height + caption_height) + (rows - 1) * gap + foot_height,
  }
end

-- Returns the height of a panel, smaller where the view would leave it empty above and below.
local function trimmed(look, width, height)
  local used = look.camera.filled or 1
  return math.floor(math.max(0.32 * width, math.min(height, height * used / 0.8)) + 0.5)
end

--- Draws several moments of a run in one picture, by default six in two rows.
-- The camera is the same in all; captions give the time.
-- @tparam table options `run`; `path` ending in .png; `count` (6) moments from
-- the first to the last frame, or `times = { ... }` [s]; `captions` (words after
-- the times, in the same order); `columns` (3, of four 2); `width` (1500) [px], roughly
-- kept; `height` (as the view needs, at most 380 a row) [px]; `camera` "auto" or options of view.camera;
-- `thickness` factor on the wires' radius (default: 1, more if the wire would
-- be too thin to be seen, and the picture says so); `draft = true` for speed;
-- `threads` (2)
-- @treturn table `path, width, height [px], thickness, note`
-- @raise if povray is missing or fails, or the file cannot be written
function povray.strip(options)
  local run = check(options, "a strip of pictures")
  local frames = looks.frames(run, options.count or 6, options.times)
  local columns = looks.columns(options.columns, #frames)
  local rows = (#frames + columns - 1) // columns
  local width, height = options.width or 1500, options.height or 380 * rows
  local panel_width = (width - gap) // columns - gap
  local panel_height = (height - gap - foot_height - (rows - 1) * gap) // rows - caption_height
  if panel_width < 40 or panel_height < 40 then
    sink.fail("a strip of pictures: %d x %d px is too small", width, height)
  end
  local look = looks.of(run, panel_width, panel_height, options)
  if not options.height then
    panel_height = trimmed(look, panel_width, panel_height)
    look = looks.of(run, panel_width, panel_height, options)
  end
  local sheet = sheet_of(columns, rows, panel_width, panel_height)
  sheet.foot = looks.foot(run, look, sheet.width)
  return render(sheet, run, frames, look, options)
end

--- Draws one moment of a run.
-- @tparam table options as for povray.strip, with `frame` (number of the
-- frame, default the last), `size = {width, height}` [px] and `caption`
-- @treturn table as povray.strip
function povray.picture(options)
  local run = check(options, "a picture")
  local frame = run.frames[options.frame or #run.frames]
  if not frame then sink.fail("a picture: no frame %s of %d", checks.shown(options.frame), #run.frames) end
  local size = options.size or { 1200, 800 }
  local sheet = sheet_of(1, 1, size[1] - 2 * gap, size[2] - gap - foot_height - caption_height)
  local look = looks.of(run, sheet.panel_width, sheet.panel_height, options)
  sheet.foot = looks.foot(run, look, sheet.width)
  return render(sheet, run, { frame }, look, options)
end

return povray
