-- SPDX-License-Identifier: GPL-3.0-or-later
-- run:report and sw.report without a browser: refused arguments, a full disk, the size of the page.
local core = require "softworld.core"
local files = require "spec.output.files"
local film = require "spec.film.film"
local runs = require "spec.page.runs"
local sw = require "softworld"

local function read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read "a"
  file:close()
  return text
end

describe("run:report", function()
  local folder, run

  setup(function() run = runs.laying() end)
  before_each(function() folder = files.folder() end)
  after_each(function() files.remove(folder) end)

  it("writes one file and no others", function()
    assert.equal(folder .. "/x.html", run:report(folder .. "/x.html"))
    assert.same({ "x.html" }, files.list(folder))
    local html = read(folder .. "/x.html")
    assert.truthy(html:find("^<!doctype html>"))
    for _, place in ipairs { "NOTICES", "STYLES", "SCRIPTS", "title", "data" } do
      assert.is_nil(html:find("@" .. place .. "@", 1, true), place)
    end
  end)

  -- A list of four points is as long as a rotation.
  it("takes hulls of any number of points", function()
    for _, more in ipairs{ {}, { { 0.1, 0.1, 0.1 } } } do
      local scene = sw.scene{ name = "hull" }
      local points = { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0, 0.1, 0 }, { 0, 0, 0.1 } }
      table.move(more, 1, #more, #points + 1, points)
      scene:obstacle{ name = "hull", shape = "hull", points = points }
      scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.2 }, to = { 0.3, 0, 0.2 } }
      local path = folder .. "/hull.html"
      assert.equal(path, scene:run{ dt = 0.005, duration = 0.05 }:report(path))
    end
  end)

  it("marks slips and other events of grippers", function()
    local scene = sw.scene{ gravity = { 0, 0, 0 } }
    local wire = scene:wire{ cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.3, 0, 0.1 }, segments = 12 }
    scene:clamp(wire, { s = 0 })
    local hand = scene:gripper{ name = "hand", pads = { width = 0.01, friction = 0.05 } }
    scene:process(function(p)
      hand:grasp(wire, { s = 0.25, approach = "plates", force = 2 })
      hand:move{ by = { 0.03, 0, 0 }, speed = 0.1 }
      p:wait(0.05)
    end)
    local slid = scene:run{ dt = 0.005 }
    assert.is_true(slid.ok, slid.reason)
    local html = read(slid:report(folder .. "/x.html"))
    local events = html:match '"events":(%b[])'
    local slip
    for _, event in ipairs(hand.events) do slip = event.kind == "slip" and event or slip end
    local text = ("the wire slips in gripper 'hand' at s = %.4g m"):format(slip.s)
    assert.truthy(events:find(text, 1, true), events)
    -- the middle of the pads, which have slid along the wire by as much as it slipped
    assert.is_true(slip.s >= 0.25 - 1e-9 and slip.s <= 0.25 + slip.distance, slip.s)
    assert.truthy(events:find '"kind":"slip"', events)
    local last = -1
    for time in events:gmatch '"time":([%d.e+-]+)' do
      assert.is_true(tonumber(time) >= last)
      last = tonumber(time)
    end
  end)

  it("names a file that cannot be written, and gives the reason", function()
    local told = { [folder .. "/no/x.html"] = "No such file or directory",
      [folder .. "/x.txt"] = "does not end in .html" }
    for path, why in pairs(told) do
      local ok, text = pcall(run.report, run, path)
      assert.is_false(ok)
      assert.truthy(text:find(path, 1, true) and text:find(why, 1, true), text)
    end
    for given, why in pairs { [""] = "''", [7] = "number", [true] = "boolean" } do
      local ok, text = pcall(run.report, run, given)
      assert.is_false(ok)
      assert.truthy(text:find("run:report expects the name of an .html file, got " .. why, 1, true), text)
    end
    assert.same({}, files.list(folder))
  end)

  it("keeps the old file when the disk is full", function()
    local open = io.open
    local path = folder .. "/x.html"
    local file = assert(open(path, "wb"))
    file:write "old"
    file:close()
    rawset(io, "open", function(name, mode) return open(mode == "wb" and "/dev/full" or name, mode) end)
    local ok, text = pcall(run.report, run, path)
    rawset(io, "open", open)
    assert.is_false(ok)
    assert.truthy(text:find("No space left on device", 1, true), text)
    assert.equal("old", read(path))
    assert.same({ "x.html" }, files.list(folder))
  end)

  it("writes through a device, and reports when it is full", function()
    local ok, text = pcall(run.report, run, "/dev/full")
    assert.is_false(ok)
    assert.truthy(text:find("/dev/full: No space left on device", 1, true), text)
  end)

  it("keeps a million frames within their memory, and the page small", function()
    local scene = sw.scene {}
    scene:wire { E = 1e8, density = 1500, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 20 }
    local long = scene:run { duration = 0.5, dt = 1e-5, frame = 5e-7, frames = { memory = 1e6 } }
    assert.is_true(long.ok)
    -- a frame: 21 nodes of 12 numbers of 4 bytes, and its other data; a million frames were requested
    local count = scene:frame_count()
    assert.is_true(count * 21 * 12 * 4 < 1e6 and count > 200, count)
    assert.is_true(core.frames_thinned(scene) >= 32)
    long:report(folder .. "/x.html")
    assert.is_true(#read(folder .. "/x.html") < 2.5e6)
  end)

  it("leaves out frames with positions that are not numbers", function()
    local scene = sw.scene {}
    scene:wire { E = 1e8, density = 1500, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 20 }
    local far = scene:obstacle { name = "far", shape = "sphere", radius = 0.1, at = { 0, 5, 0 } }
    scene:run { duration = 0.1, dt = 0.01, frame = 0.02 }
    far:pose { 0, 1e39, 0 } -- larger than 32 bits can hold
    local rest = scene:run { duration = 0.1, dt = 0.01, frame = 0.02 }
    local packed, whole, broken = core.film(scene, -math.huge, math.huge, true)
    assert.is_true(whole >= 5 and broken >= 5, whole .. " " .. broken)
    for _, t in ipairs(film.read(packed).tracks) do
      for _, flat in ipairs(t.frames) do
        for _, x in ipairs(flat) do assert.is_true(math.abs(x) < 1e3 or x ~= x) end
      end
    end
    assert.equal(folder .. "/x.html", rest:report(folder .. "/x.html"))
    assert.truthy(read(folder .. "/x.html"):find('"broken":' .. broken, 1, true))
  end)

  it("refuses a run whose frames were dropped by a snapshot", function()
    local scene = sw.scene {}
    scene:wire { E = 1e8, density = 1500, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    local snapshot = scene:snapshot()
    local gone = scene:run { duration = 0.1 }
    scene:restore(snapshot)
    local ok, text = pcall(gone.report, gone, folder .. "/x.html")
    assert.is_false(ok)
    assert.truthy(text:find("snapshot was restored", 1, true), text)
  end)

  it("has the peaks of series that are too long to be shown in full", function()
    local scene = sw.scene {}
    local wire = scene:wire { E = 1e7, density = 1500, radius = 1e-3, from = { 0, 0, 0 }, to = { 0.5, 0, 0 },
      segments = 10 }
    scene:clamp(wire, { s = 0 })
    local long = scene:run { duration = 4, dt = 5e-4, frame = 0.1 }
    local series, most = long:series(), -math.huge
    for _, c in ipairs(series.columns) do
      if c.name == "wire1.tension" then for _, x in ipairs(c.values) do most = math.max(most, x) end end
    end
    long:report(folder .. "/x.html")
    local html = read(folder .. "/x.html")
    local blob, of, rows = html:match '"series":{"blob":(%d+),.-"of":(%d+),"rows":(%d+)'
    assert.equal(#series.time, tonumber(of))
    assert.is_true(tonumber(rows) <= 3000)
    local text = html:match('id="blob%-' .. blob .. '">([^<]*)<')
    local pipe = folder .. "/b64"
    local file = assert(io.open(pipe, "wb"))
    file:write(text)
    file:close()
    local popen = assert(io.popen("base64 -d " .. pipe, "r"))
    local bytes = film.inflate(popen:read "a")
    popen:close()
    local number
    for i, c in ipairs(series.columns) do if c.name == "wire1.tension" then number = i end end
    local kept = -math.huge
    for i = 1, tonumber(rows) do
      local x = ("<f"):unpack(bytes, 8 * rows + 4 * rows * (number - 1) + 4 * (i - 1) + 1)
      if x == x then kept = math.max(kept, x) end
    end
    assert.near(most, kept, 1e-7 * most)
  end)
end)

describe("sw.report", function()
  it("refuses arguments that are not runs, at the script's line", function()
    local run = runs.laying()
    for told, args in pairs { ["[1] must be a run, got"] = { 3, path = "x.html" },
      ["path is required"] = { run }, ["sw.report: give a run"] = { path = "x.html" },
      ["did you mean 'path'"] = { run, pat = "x.html" } } do
      local ok, text = pcall(sw.report, args)
      assert.is_false(ok)
      assert.truthy(text:find(told, 1, true), text)
      assert.truthy(text:find("report_spec.lua:", 1, true), text)
    end
    assert.is_false(pcall(sw.report, 3))
    assert.is_false(pcall(sw.report))
  end)
end)
