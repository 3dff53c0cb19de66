-- SPDX-License-Identifier: GPL-3.0-or-later
-- Mesh files that are cut off, damaged, or too much to read: each gives an error and nothing else.
local core = require "softworld.core"
local program = require "host.program"
local tools = require "shape.tools"

local points, triangles = tools.box_triangles(1, 2, 3)
local NORMAL = "env --default-signal=INT" -- shells start background jobs with SIGINT ignored

local function mesh(data, format)
  return core.shape { shape = "mesh", data = data, format = format }
end

local function refused(data, format, pattern)
  local fine, message = pcall(mesh, data, format)
  assert.is_false(fine, ("%s of %d bytes is read"):format(format, #data))
  assert.matches("obstacle mesh: ", message)
  assert.matches(pattern, message)
end

-- Returns the text of a file of the box, after its head.
local function lines_of(head)
  for i = 1, #points, 3 do head[#head + 1] = table.concat(points, " ", i, i + 2) end
  for _, t in ipairs(triangles) do
    head[#head + 1] = ("3 %d %d %d"):format(t[1] - 1, t[2] - 1, t[3] - 1)
  end
  return table.concat(head, "\n") .. "\n"
end

local function ply_head(format, vertices, faces)
  return { "ply", "format " .. format .. " 1.0", "comment by hand", "element vertex " .. vertices,
    "property float x", "property float y", "property float z", "element face " .. faces,
    "property list uchar int vertex_indices", "end_header" }
end

local function ply_binary(least_first)
  local mark, list = least_first and "<" or ">", {}
  local format = least_first and "binary_little_endian" or "binary_big_endian"
  for i = 1, #points, 3 do
    list[#list + 1] = string.pack(mark .. "fff", points[i], points[i + 1], points[i + 2])
  end
  for _, t in ipairs(triangles) do
    list[#list + 1] = string.pack(mark .. "Bi4i4i4", 3, t[1] - 1, t[2] - 1, t[3] - 1)
  end
  return table.concat(ply_head(format, 8, 12), "\n") .. "\n" .. table.concat(list)
end

local function glb()
  local bytes = {}
  for _, t in ipairs(triangles) do
    for _, k in ipairs(t) do
      bytes[#bytes + 1] = string.pack("<fff", points[3 * k - 2], points[3 * k - 1], points[3 * k])
    end
  end
  local bin = table.concat(bytes)
  local json = ([[{"asset":{"version":"2.0"},"buffers":[{"byteLength":%d}],"bufferViews":[{"buffer":0,
    "byteLength":%d}],"accessors":[{"bufferView":0,"componentType":5126,"count":36,"type":"VEC3"}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],
    "scenes":[{"nodes":[0]}],"scene":0}]]):format(#bin, #bin)
  json = json .. (" "):rep(-#json % 4)
  return string.pack("<c4I4I4I4c4", "glTF", 2, 12 + 8 + #json + 8 + #bin, #json, "JSON") .. json
    .. string.pack("<I4c4", #bin, "BIN\0") .. bin
end

-- A polygon takes Assimp a time that grows with the square of its corners.
local SLOW = [[
local function slow(n)
  local lines, corners = {}, {}
  for i = 1, n do
    local r, a = 1 + 0.5 * (i % 2), 2 * math.pi * i / n
    lines[i], corners[i] = ("v %.9g %.9g 0"):format(r * math.cos(a), r * math.sin(a)), i
  end
  lines[n + 1] = "f " .. table.concat(corners, " ") .. "\n"
  return { shape = "mesh", data = table.concat(lines, "\n"), format = "obj" }
end
local core = require "softworld.core"
]]

-- Returns the number of processes that have the text in their environment.
local function processes_with(mark)
  local out = program.shell(("grep -sl %s /proc/[0-9]*/environ 2>/dev/null"):format(program.quote(mark)))
  local count = 0
  for pid in out:gmatch "/proc/(%d+)/" do
    local stat = io.open("/proc/" .. pid .. "/stat")
    if stat and not (stat:read "l" or ""):find "%) Z" then count = count + 1 end
    if stat then stat:close() end
  end
  return count
end

-- Returns true once there are none; looks a limited number of times, each after a short sleep.
local function none_left(mark)
  for _ = 1, 300 do
    if processes_with(mark) == 0 then return true end
    os.execute "sleep 0.1"
  end
  return false
end

describe("a mesh file that is cut off", function()
  it("is refused wherever it was cut, in formats that tell their length", function()
    local function binary(data) return { data, #data } end
    local function text(data) return { data, data:find "%S+%s*$" } end -- a cut word is still a word
    local ascii = tools.stl_ascii(points, triangles)
    local files = { stl = { binary(tools.stl_binary(points, triangles)), { ascii, ascii:find "d made\n$" } },
      ply = { text(lines_of(ply_head("ascii", 8, 12))), binary(ply_binary(true)), binary(ply_binary(false)) },
      off = { text(lines_of { "OFF", "# eight points", "8 12 0" }) }, glb = { binary(glb()) } }
    for format, list in pairs(files) do
      for _, entry in ipairs(list) do
        assert.equal("mesh", mesh(entry[1], format):kind())
        for n = 1, entry[2] - 1 do refused(entry[1]:sub(1, n), format, "write the file anew") end
      end
    end
  end)

  it("gives an error that says what is missing", function()
    local ply = lines_of(ply_head("ascii", 8, 12))
    refused(ply:sub(1, (ply:find("3 %d %d %d\n")) - 1), "ply",
      "not readable as ply: it is cut off or damaged: it declares 12 items of 'face', and 0 are there")
    refused(table.concat(ply_head("ascii", 100000000, 1), "\n") .. "\n0 0 0\n", "ply",
      "declares 100000000 items of 'vertex', and 1 are there")
    refused("OFF\n100000000 1 0\n0 0 0\n", "off", "declares 100000000 points and 1 faces")
    refused(("x"):rep(80) .. "\255\255\255\255" .. ("\0"):rep(100), "stl", "declares 4294967295 triangles")
    refused("ply\nformat ascii 1.0\nelement vertex 3\nelement face 999999999999\nend_header\n", "ply",
      "items of 'vertex', and 0 are there")
  end)

  it("is distinguished from a file without the corners that it names", function()
    refused(lines_of(ply_head("ascii", 8, 12)):gsub("3 %d %d %d\n", "3 0 1 77\n", 1), "ply",
      "a face whose corner is not among its points")
  end)

  it("is named with its path, for obstacles and for pads", function()
    local sw = require "softworld"
    local path = program.write(program.folder() .. "/cut.ply",
      table.concat(ply_head("ascii", 8, 12), "\n") .. "\n0 0 0\n")
    local scene <close> = sw.scene{}
    for _, f in ipairs {
      function() scene:obstacle { shape = "mesh", file = path } end,
      function() scene:gripper { pads = { shape = "mesh", file = path } } end } do
      local fine, message = pcall(f)
      assert.is_false(fine)
      assert.truthy(message:find(path, 1, true), message)
      assert.matches("mesh_child_spec.lua:%d+: ", message)
      assert.matches("cut off", message)
    end
    program.clean()
  end)
end)

describe("the reader of mesh files", function()
  after_each(program.clean)

  it("leaves no process and no file open, whatever comes", function()
    local out, err, code = program.script([[
      local core = require "softworld.core"
      local function read(data, format)
        return pcall(core.shape, { shape = "mesh", data = data, format = format })
      end
      local lfs = require "lfs"
      local function left()
        local pipe, open = io.popen "grep -sl \"PPid:.*\\b$PPID$\" /proc/[0-9]*/status | wc -l", 0
        local children = pipe:read "a"
        pipe:close()
        for _ in lfs.dir "/proc/self/fd" do open = open + 1 end
        return open .. " " .. children
      end
      local good = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
      assert(read(good, "obj"))
      local before = left()
      for _ = 1, 30 do
        assert(read(good, "obj"))
        assert(not read("v 0 0 0\nf 1 2 3\n", "obj"))
        assert(not read('{"asset":{"version":"2.0"},"x":' .. ("["):rep(300000), "gltf"))
      end
      print(left() == before)
    ]])
    assert.equal("", err)
    assert.equal("true\n", out)
    assert.equal(0, code)
  end)

  it("runs no handlers of the program and writes nothing of its files twice", function()
    local name = program.folder() .. "/out"
    local out, err, code = program.script(([[
      local file = io.open(%q, "w")
      file:setvbuf("full")
      io.stdout:setvbuf("full")
      file:write "once" io.write "once"
      setmetatable({}, { __gc = function() io.write " closed" end })
      local core = require "softworld.core"
      local function read(data) return pcall(core.shape, { shape = "mesh", data = data, format = "obj" }) end
      read "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" read "rubbish"
    ]]):format(name))
    assert.equal("once closed", out)
    assert.equal("", err)
    assert.equal(0, code)
    assert.equal("once", program.read(name))
  end)

  it("is ended by its limit on computing time", function()
    local out, err, code = program.script(SLOW .. [[
      local ok, message = pcall(core.shape, slow(60000))
      print(ok, message)
      print(core.shape(slow(50)):kind())
    ]], nil, { before = "ulimit -S -t 3;" })
    assert.equal("", err)
    assert.matches("^false\tobstacle mesh: reading data as obj takes more than %d+ s.*\nmesh\n$", out)
    assert.equal(0, code)
  end)

  it("is ended by its limit on memory", function()
    if os.getenv "SOFTWORLD_PRELOAD" then
      print "not tested here: the limit on address space, for AddressSanitizer's shadow takes more"
      return
    end
    local make = [[
      local core = require "softworld.core"
      local lines = {}
      for i = 1, 100000 do
        lines[i] = ("v %d 0 0\nv 0 1 0\nv 0 0 1\nf %d %d %d"):format(i, 3 * i - 2, 3 * i - 1, 3 * i)
      end
      local data = table.concat(lines, "\n") .. "\n"
    ]]
    local peak = tonumber((program.script(make .. [[for line in io.lines "/proc/self/status" do
      if line:find "^VmPeak" then print(line:match "%d+") end end]])))
    local out, err, code = program.script(make .. [[
      print(pcall(core.shape, { shape = "mesh", data = data, format = "obj" }))
      print(core.shape { shape = "box", size = { 1, 1, 1 } }:kind())
    ]], nil, { before = ("ulimit -v %d;"):format(peak + 40000) })
    assert.equal("", err)
    assert.matches("^false\tobstacle mesh: reading data as obj takes more than %d+ MB.*\nbox\n$", out)
    assert.equal(0, code)
  end)

  it("is ended by Ctrl-C at once, and the program goes on", function()
    local mark = ("SOFTWORLD_SPEC_MARK=%d.%d"):format(os.time(), math.random(1 << 40))
    local out, err, code = program.script(SLOW .. [[
      local args = slow(100000)
      local ok, message = pcall(core.shape, args)
      print(ok, message:match "interrupted")
      print(core.shape(slow(50)):kind())
    ]], nil, { before = mark .. " " .. NORMAL, signals = { 100 } })
    assert.equal("", err)
    assert.equal("false\tinterrupted\nmesh\n", out)
    assert.equal(0, code)
    assert.is_true(none_left(mark))
  end)

  it("ends with a program that is killed", function()
    local mark = ("SOFTWORLD_SPEC_MARK=%d.%d"):format(os.time(), math.random(1 << 40))
    local name = program.write(program.folder() .. "/s.lua", SLOW .. "core.shape(slow(100000))")
    program.shell(("%s %s %s & p=$!; n=0; "
      .. "while [ $(grep -sl %s /proc/[0-9]*/environ 2>/dev/null | wc -l) -lt 2 ] && [ $n -lt 500 ]; "
      .. "do sleep 0.05; n=$((n+1)); done; kill -KILL $p"):format(mark, program.quote(program.path), name,
      program.quote(mark)))
    assert.is_true(none_left(mark))
  end)

  it("serves the stock interpreter too, and Ctrl-C there", function()
    assert.is_true(program.has "lua5.4", "the package lua5.4 is missing")
    local folder = program.path:match "^(.*)/" or "."
    local sanitizer = os.getenv "SOFTWORLD_PRELOAD"
    local before = ("%s LUA_CPATH=%s %s %s"):format(NORMAL, program.quote(folder .. "/lib/?.so"),
      sanitizer and "LD_PRELOAD=" .. program.quote(sanitizer) or "",
      sanitizer and "ASAN_OPTIONS=detect_leaks=0" or "")
    local out, err, code = program.script(SLOW .. [[
      print(core.shape(slow(50)):kind())
      print(pcall(core.shape, { shape = "mesh", format = "obj", data = "v 0 0 0\nf 1 2 3\n" }))
    ]], nil, { before = before, path = "lua5.4" })
    assert.equal("", err)
    assert.matches("^mesh\nfalse\tobstacle mesh: ", out)
    assert.equal(0, code)
    local mark = ("SOFTWORLD_SPEC_MARK=%d.%d"):format(os.time(), math.random(1 << 40))
    out, err, code = program.script(SLOW .. "core.shape(slow(100000))", nil,
      { before = before .. " " .. mark, path = "lua5.4", signals = { 100 } })
    assert.equal("", out)
    assert.matches("interrupted", err)
    assert.equal(1, code)
    assert.is_true(none_left(mark))
  end)

  it("leaves the prompt as it was", function()
    if not program.has_terminals() then
      print "not tested here: meshes at the prompt, for there is no /dev/pts"
      return
    end
    local out, code = program.terminal { "core = require 'softworld.core'\n",
      "triangle = 'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n'\n",
      "core.shape{ shape = 'mesh', format = 'obj', data = triangle }:kind()\n",
      "core.shape{ shape = 'mesh', format = 'obj', data = 'x' }\n", "6 * 7\n", "\16\n", "\4" }
    assert.matches("\nmesh\n> ", out)
    assert.matches("obstacle mesh: data is not readable as obj", out)
    assert.matches("> 6 %* 7\n42\n> 6 %* 7\n42\n> \n$", out)
    assert.equal(0, code)
  end)
end)
