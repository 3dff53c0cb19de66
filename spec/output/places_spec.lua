-- SPDX-License-Identifier: GPL-3.0-or-later
-- Where files go: paths with any characters, remains of killed processes, devices, the disk.
local chart = require "softworld.output.chart"
local core = require "softworld.core"
local csv = require "softworld.csv"
local files = require "spec.output.files"
local povray = require "softworld.output.povray"
local program = require "host.program"
local scene_of = require "spec.output.scene"
local sink = require "softworld.output.sink"
local sw = require "softworld"
local vtk = require "softworld.output.vtk"

local ODD = { "tab\there", "line\nend", "it's \"quoted\"", "'begins with a quote", "a;b&c|d $H `id`",
  "back\\slash", "-dash", "per%cent %d", "\1\127", "µ\xff", "..two", ("x"):rep(200), ".a.1-2.tmp" }

describe("a path with odd characters", function()
  local folder

  before_each(function() folder = files.folder() end)
  after_each(function() files.remove(folder) end)

  -- The file is the only one there, and it is not empty.
  local function alone(place, name)
    local text = sink.read_file(place .. "/" .. name)
    assert.is_true(#text > 0)
    assert.truthy(text:find "%S")
    assert.equal(text, assert(io.open(place .. "/" .. name, "rb")):read "a")
    local pipe = io.popen("ls -A " .. sink.quote(place) .. " | wc -c")
    assert.equal(#name + 1, pipe:read "n")
    pipe:close()
    return text
  end

  for _, odd in ipairs(ODD) do
    it(("takes charts, tables, series and scenes: %q"):format(odd:sub(1, 20)), function()
      local place = folder .. "/" .. odd
      sink.make_folder(place)
      local run = scene_of.run { frames = 2 }
      local svg = odd .. ".svg"
      run.name = odd
      chart.series { run = run, path = place .. "/" .. svg }
      assert.truthy(alone(place, svg):find("</svg>", 1, true))
      os.remove(place .. "/" .. svg)
      csv.write(place .. "/" .. odd, { "x" }, { x = { 1.5, 2 } })
      alone(place, odd)
      if not odd:find "\n" then assert.same({ 1.5, 2 }, csv.read(place .. "/" .. odd).columns.x) end
      os.remove(place .. "/" .. odd)
      local scene <close> = sw.scene{}
      scene:wire { E = 1e7, density = 1e3, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
      scene:save(place .. "/" .. odd)
      alone(place, odd)
      local loaded <close> = sw.load(place .. "/" .. odd)
      assert.equal("table", type(loaded:names()))
    end)
  end

  it("takes pictures and VTK series", function()
    local odd = "tab\t'\"\n $H"
    local place = folder .. "/" .. odd
    sink.make_folder(place)
    local run = scene_of.run { frames = 1 }
    povray.picture { run = run, path = place .. "/" .. odd .. ".png", size = { 120, 100 }, draft = true }
    assert.equal("\137PNG", alone(place, odd .. ".png"):sub(1, 4))
    os.remove(place .. "/" .. odd .. ".png")
    vtk.write(run, place .. "/" .. odd .. ".pvd")
    local text = sink.read_file(place .. "/" .. odd .. ".pvd")
    local name = files.xml(text:gsub("&#(%d+);", function(c) return string.char(c) end))
    assert.truthy(name)
    assert.truthy(sink.read_file(place .. "/" .. odd .. ".vtk/wires_00000.vtp"):find "</VTKFile>")
  end)
end)

describe("a title that begins with a quote", function()
  it("is drawn literally, also on axes and in keys", function()
    local folder = files.folder()
    for _, title in ipairs { "'a' \\n `id` \"b\" @x $H", "'", "''", "'''x", '"', '""x', "`id`" } do
      local path = folder .. "/t.svg"
      chart.front { path = path, title = title, xlabel = title, ylabel = title, points = {
        { x = 1, y = 2, series = title, label = title }, { x = 2, y = 1, series = "other" } } }
      local shown = sink.read_file(path):gsub("&quot;", '"'):gsub("&apos;", "'")
      shown = shown:gsub("&lt;", "<"):gsub("&gt;", ">")
      local _, times = shown:gsub(title:gsub("%p", "%%%0"), "")
      assert.is_true(times >= 5, title .. ": " .. times)
    end
    files.remove(folder)
  end)
end)

describe("temporary files", function()
  local folder

  before_each(function() folder = files.folder() end)
  after_each(function() files.remove(folder) program.clean() end)

  -- A program that is killed while it works on a path.
  local function killed(body)
    program.script(([[
      local sink = require "softworld.output.sink"
      local folder = %q
      %s
      io.popen("kill -KILL $PPID"):close()
      while true do end
    ]]):format(folder, body))
  end

  it("of a killed process are removed by the next one that writes there", function()
    killed [[
      sink.write_file = sink.write_file
      local file = io.open(sink.temporary(folder .. "/x.csv"), "wb") file:write "half" file:flush()
      local own = sink.temporary(folder .. "/x.png", true)
      io.open(own .. "/f1.pov", "wb"):write("half"):flush()
    ]]
    assert.equal(2, #files.list(folder))
    sink.write_file(folder .. "/other.txt", "text")
    assert.same({ "other.txt" }, files.list(folder))
  end)

  it("of a killed save and of a killed chart are removed in the same way", function()
    local left = 0
    for _, body in ipairs {
      [[local sw = require "softworld"
        local rename = os.rename
        os.rename = function() io.popen("kill -KILL $PPID"):close() while true do end end
        local scene = sw.scene{} scene:save(folder .. "/s.sws")]],
      [[local chart = require "softworld.output.chart"
        sink.run = function() io.popen("kill -KILL $PPID"):close() while true do end end
        sink.need = function() end
        chart.front{ path = folder .. "/c.svg", points = { { x = 1, y = 1 } } }]],
    } do
      killed(body)
      left = left + #files.list(folder)
      sink.write_file(folder .. "/c.svg", "text")
      assert.same({ "c.svg" }, files.list(folder))
    end
    assert.equal(3, left) -- in the second round c.svg of the first is still there
  end)

  it("of a living process stay, and so do other people's files", function()
    local own = sink.temporary(folder .. "/a")
    local names = { ".x.tmp", ".x.1.tmp", ".x.1-.tmp", "x.1-2.tmp", ".x.1-2.tmp.gz", ".1-2.tmp", "y.tmp" }
    for _, name in ipairs(names) do program.write(folder .. "/" .. name, "mine") end
    os.execute("mkdir " .. folder .. "/sub; ln -s /etc " .. folder .. "/.link.1-2.tmp")
    local command = ("require('softworld.output.sink').write_file(%q, 'b')"):format(folder .. "/b")
    local _, err, code = program.run { "-e", command }
    assert.equal("", err)
    assert.equal(0, code)
    assert.equal("file", core.kind(own))
    for _, name in ipairs(names) do assert.equal("mine", program.read(folder .. "/" .. name)) end
    assert.equal("folder", core.kind(folder .. "/.link.1-2.tmp"))
    sink.discard(own)
    assert.is_nil(core.kind(own))
  end)

  it("are closed and removed after any failure", function()
    local function open() return #files.list "/proc/self/fd" end
    for _ = 1, 2 do collectgarbage() end -- pipes of other tests
    local before = select(2, pcall(open))
    for _ = 1, 20 do
      pcall(sink.write_file, folder .. "/x", function() error "no" end)
      pcall(sink.write_file, folder, "text")
      pcall(sink.write_file, folder .. "/no/x", "text")
      sink.write_file(folder .. "/x", "text")
      pcall(chart.front, { path = folder .. "/x.svg", points = { { x = 1, y = 1 } }, size = { -1, -1 } })
    end
    assert.equal(before, open())
    assert.same({ "x" }, files.list(folder))
  end)
end)

describe("a path that is not a regular file", function()
  it("is written in place", function()
    local folder = files.folder()
    local pipe = folder .. "/pipe"
    os.execute("mkfifo " .. pipe)
    local reader = io.popen("cat " .. pipe)
    sink.write_file(pipe, "through")
    assert.equal("through", reader:read "a")
    reader:close()
    assert.equal("pipe", core.kind(pipe))
    local kind = core.kind "/dev/null"
    sink.write_file("/dev/null", "away")
    assert.equal(kind, core.kind "/dev/null")
    os.rename(pipe, folder .. "/p.svg")
    local ok, why = pcall(chart.front, { path = folder .. "/p.svg", points = { { x = 1, y = 1 } } })
    assert.is_false(ok)
    assert.equal(("cannot write %s/p.svg: it is a pipe"):format(folder), why)
    assert.same({ "p.svg" }, files.list(folder))
    files.remove(folder)
  end)

  it("is not read, because reading might never end", function()
    local folder = files.folder()
    os.execute("mkfifo " .. folder .. "/pipe.stl")
    local scene <close> = sw.scene{}
    for _, path in ipairs { folder .. "/pipe.stl", folder, "/dev/zero" } do
      for name, f in pairs {
        csv = function() sw.trajectory { path = path, speed = 1 } end,
        load = function() sw.load(path) end,
        resume = function() sw.scene{}:resume(path) end,
        mesh = function() scene:obstacle { shape = "mesh", file = path, format = "stl" } end } do
        local ok, why = pcall(f)
        assert.is_false(ok)
        assert.truthy(why:find(path, 1, true), name .. why)
        assert.truthy(why:find "it is a %a+, not a file" or why:find "extension", name .. why)
      end
    end
    files.remove(folder)
  end)
end)

describe("a saved scene", function()
  it("is synced to the disk before it replaces the old file, and its folder after that", function()
    local folder, order = files.folder(), {}
    local sync, rename = core.sync, os.rename
    core.sync = function(path, is_folder)
      order[#order + 1] = is_folder and "folder" or "file"
      return sync(path, is_folder)
    end
    os.rename = function(...) -- luacheck: ignore
      order[#order + 1] = "rename"
      return rename(...)
    end
    local scene <close> = sw.scene{}
    scene:wire { E = 1e7, density = 1e3, radius = 1e-3, from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    local ok, why = pcall(scene.save, scene, folder .. "/s.sws")
    core.sync, os.rename = sync, rename -- luacheck: ignore
    assert.is_true(ok, why)
    assert.same({ "file", "rename", "folder" }, order)
    files.remove(folder)
  end)
end)
