-- SPDX-License-Identifier: GPL-3.0-or-later
-- Files that gnuplot, ffmpeg and POV-Ray write: on a full disk they end early, and some of these programs
-- report no error. A file that is cut short is no result.
local sw = require "softworld"
local sink = require "softworld.output.sink"
local whole = require "softworld.output.whole"

local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/output"
local program = dofile(here .. "/../host/program.lua")

describe("a file of another program", function()
  after_each(program.clean)

  local function written()
    local scene = sw.scene{ name = "whole" }
    local wire = scene:wire{ cable = "GXL 1.5", segments = 8, from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
    scene:clamp(wire, { s = 0 })
    local run = scene:run{ duration = 0.1 }
    local folder = program.folder()
    for _, kind in ipairs{ "svg", "png", "pdf" } do run:chart{ path = folder .. "/a." .. kind } end
    for _, kind in ipairs{ "gif", "webm" } do run:film(folder .. "/a." .. kind, { width = 100 }) end
    return folder
  end

  -- Stands for gnuplot and ffmpeg on a full disk: they write a part and report no error.
  it("is refused by run:chart and run:film if it is cut short", function()
    local folder = program.folder()
    for _, name in ipairs{ "gnuplot", "ffmpeg" } do
      program.write(folder .. "/" .. name, "#!/bin/sh\ncat >/dev/null </dev/stdin\nprintf '<svg>'\n")
    end
    program.write(folder .. "/a.lua", [[
local sw = require "softworld"
local scene = sw.scene{}
scene:clamp(scene:wire{ cable = "GXL 1.5", segments = 8, from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }, { s = 0 })
local run = scene:run{ duration = 0.1 }
print(select(2, pcall(run.chart, run, { path = arg[1] .. "/a.svg" })))
print(select(2, pcall(run.film, run, arg[1] .. "/a.gif", { width = 100 })))
]])
    os.execute("chmod +x " .. program.quote(folder) .. "/gnuplot " .. program.quote(folder) .. "/ffmpeg")
    local command = "PATH=%s:$PATH %s %s/a.lua %s 2>&1 </dev/null"
    local pipe = assert(io.popen(command:format(folder, program.path, folder, folder)))
    local out = pipe:read "a"
    pipe:close()
    for _, kind in ipairs{ "svg", "gif" } do
      assert.truthy(out:find(("a.%s: the file was cut short"):format(kind), 1, true), out)
      assert.is_nil(io.open(folder .. "/a." .. kind))
    end
  end)

  it("is kept if it is whole, and refused if it is cut short", function()
    local folder = written()
    for _, kind in ipairs{ "svg", "png", "pdf", "gif", "webm" } do
      local content, path = program.read(folder .. "/a." .. kind), folder .. "/b." .. kind
      for _, size in ipairs{ #content, #content - 20, #content // 2, 4, 0 } do
        local temporary = sink.temporary(path)
        program.write(temporary, content:sub(1, size))
        local fine, why = pcall(whole.commit, temporary, path)
        assert.equal(size == #content, fine, kind .. " " .. size)
        if fine then
          assert.equal(content, program.read(path))
          os.remove(path)
        else
          assert.truthy(why:find("cannot write " .. path .. ": the file was cut short", 1, true), why)
          assert.is_nil(io.open(path))
        end
        assert.is_nil(io.open(temporary))
      end
    end
  end)
end)
