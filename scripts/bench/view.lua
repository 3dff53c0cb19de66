-- SPDX-License-Identifier: GPL-3.0-or-later
--- Cost of a live view for a run: CPU time of the whole program, with its server's threads, without a view,
-- with a view that no page opens, and with one page that takes 30 frames a second.
-- @module bench.view
local report = require "bench.report"
local sw = require "softworld"

local view = {}

view.aim = 0.03 -- extra CPU time with one page over the run's [-]

-- Returns a scene in which a wire is drawn over three walls, for some seconds of CPU time.
local function scene_of()
  local scene, wire, hand = report.scene "view"
  scene:process(function()
    hand:grasp(wire, { s = 0.03 })
    hand:move{ by = { 0.1, 0, 0.15 }, speed = 0.25 }
    hand:move{ by = { 0.85, 0, 0 }, speed = 0.25 }
  end)
  return scene
end

-- A separate program that takes each frame, acknowledges it, and waits for the next, until the server ends.
local READER = [[
package.path = "./?.lua;" .. package.path
local page = assert(require("spec.page.websocket").open(%d, "%s" .. "s"))
local frames = 0
while true do
  local text, opcode = page:receive(60)
  if not text then break end
  if opcode == 2 then frames = frames + 1 page:send "a" end
end
print(frames)]]

local function reader_of(shown)
  local port, path = shown.address:match "^http://127%.0%.0%.1:(%d+)(/%x+/)$"
  local reader = io.popen(("%s -e '%s'"):format(arg[-1], READER:format(port, path)), "r")
  local due = sw.core.clock() + 10
  while shown.pages == 0 and sw.core.clock() < due do sw.core.sleep(0.02) end
  return reader
end

--- Returns the CPU time and the wall time of a run [s], and the number of frames that the page got. pages:
-- nil (no view), 0, 1.
function view.cost(pages)
  local scene = scene_of()
  local shown = pages and scene:view{ open = false }
  local reader = pages == 1 and reader_of(shown)
  local wall, cpu = sw.core.clock(), os.clock()
  assert(scene:run{ dt = 0.001 }.ok)
  wall, cpu = sw.core.clock() - wall, os.clock() - cpu
  if shown then shown:close() end
  local frames = reader and tonumber(reader:read "a")
  if reader then reader:close() end
  scene:close()
  return cpu, wall, frames
end

--- Returns the shortest CPU times of so many runs of each kind, measured alternately: without a view, without
-- a page, with one page [s]; and the frames per second that the page got.
function view.costs(times)
  local plain, alone, page, rate = math.huge, math.huge, math.huge, 0
  for _ = 1, times do
    plain, alone = math.min(plain, (view.cost())), math.min(alone, (view.cost(0)))
    local cpu, wall, frames = view.cost(1)
    page, rate = math.min(page, cpu), math.max(rate, frames / wall)
  end
  return plain, alone, page, rate
end

return view
