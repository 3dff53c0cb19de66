-- SPDX-License-Identifier: GPL-3.0-or-later
--- Writes a run as a film: ffmpeg turns pictures of softworld.output.picture into a .webm or .gif file.
-- @module softworld.output.film
local core = require "softworld.core"
local looks = require "softworld.output.looks"
local picture = require "softworld.output.picture"
local progress = require "softworld.output.progress"
local sheet = require "softworld.output.sheet"
local sink = require "softworld.output.sink"
local solid = require "softworld.output.solid"
local whole = require "softworld.output.whole"

local film = {}

local most = 100000 -- most pictures of a film

-- ffmpeg options per kind of file; a .gif gets its own palette in one pass.
local codecs = {
  webm = "-c:v libvpx-vp9 -b:v 0 -crf 31 -deadline realtime -cpu-used 7 -row-mt 1 -pix_fmt yuv420p -f webm",
  gif = "-filter_complex '[0:v]split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=bayer'"
    .. " -f gif",
}
local rates, widths = { webm = 30, gif = 15 }, { webm = 1280, gif = 720 }

-- Returns the number of the frame of each picture.
local function numbers_of(run, o, rate)
  local frames, list = run.frames, {}
  local first, last = frames[1].t, frames[#frames].t
  local count = math.floor((last - first) / o.speed * rate + 1e-6) + 1
  if count > most then
    sink.fail("a film: %d pictures are too many; speed = %.3g takes %d", count,
      (last - first) * rate / most, most)
  end
  local k = 1
  for i = 1, count do
    local t = first + (i - 1) * o.speed / rate
    while k < #frames and math.abs(frames[k + 1].t - t) <= math.abs(frames[k].t - t) do k = k + 1 end
    list[i] = k
  end
  return list
end

-- Makes the sides even numbers, as films require.
local function even(layout)
  layout.width, layout.height = layout.width + layout.width % 2, layout.height + layout.height % 2
  return layout
end

-- Returns a progress bar in the film's time.
local function bar_of(run, o, total)
  local host = package.loaded["softworld.host"]
  local wanted = o.progress
  if wanted == nil then wanted = host and host.terminal and os.getenv "TERM" ~= "dumb" end
  return progress.new{ word = "pictures", total = total, name = (run.name or "run") .. ", film",
    quiet = not wanted,
    after = o.progress == nil and 1 or nil, terminal = host and host.terminal or nil, clock = core.clock,
    width = host and host.columns or nil }
end

-- Draws all pictures and writes them to a pipe.
local function feed(pipe, run, o, rate, layout, look, numbers)
  local bar <close> = bar_of(run, o, #numbers / rate)
  local bytes, last
  for i, k in ipairs(numbers) do
    if k ~= last then
      local paper = sheet.dots(layout.width, layout.height)
      picture.fill(paper, layout, run, { run.frames[k] }, look, { looks.caption(run, run.frames[k], 1, o) })
      bytes, last = paper.canvas:rgb(), k
    end
    if not pipe:write(bytes) then return end -- ffmpeg has ended: its output says why
    bar:update(i / rate, i)
  end
  bar:finish()
end

local function complaint(text)
  local last = text:match "([^\n]*[^\n%s][^\n]*)\n*$" or "it says nothing"
  return last:gsub("%c", " ")
end

local function command(kind, layout, rate, output, log)
  -- in its own process group, so that on Ctrl-C this program ends it
  return ("exec setsid ffmpeg -hide_banner -loglevel error -nostdin -y -f rawvideo -pix_fmt rgb24 "
    .. "-s %dx%d -r %g -i - -an %s %s >%s 2>&1"):format(layout.width, layout.height, rate, codecs[kind],
    sink.quote("file:" .. output), sink.quote(log))
end

local function make(run, o, kind, rate, layout, look, numbers)
  local output, log = sink.temporary(o.path), sink.scratch()
  local pipe = io.popen(command(kind, layout, rate, output, log), "w")
  local fine, why = pcall(feed, pipe, run, o, rate, layout, look, numbers)
  local ended = pipe:close()
  local said = sink.read_file(log)
  sink.discard(log)
  if fine and ended then return whole.commit(output, o.path) end
  sink.discard(output)
  if not fine then error(why, 0) end
  sink.fail("cannot write %s: ffmpeg failed: %s", o.path, complaint(said))
end

--- Writes a run as a film.
-- @tparam table run as picture.write
-- @tparam table o path ending in .webm or .gif, speed, rate, width, height, and what picture.plan takes
-- @treturn table path, width, height [px], frames
-- @raise if ffmpeg is missing (its package is named) or fails, or the file cannot be written
function film.write(run, o)
  if #run.frames == 0 then
    sink.fail("a film: the run of '%s' has no frames, %s", run.name, run.none)
  end
  sink.need("ffmpeg", "ffmpeg", "a film")
  local kind = sink.extension(o.path)
  run = solid.finite_run(run)
  o.width, o.count = o.width or widths[kind], 1
  local rate = o.rate or rates[kind]
  local numbers = numbers_of(run, o, rate)
  local layout, look = picture.plan(run, 1, o)
  make(run, o, kind, rate, even(layout), look, numbers)
  return { path = o.path, width = layout.width, height = layout.height, frames = #numbers }
end

return film
