-- SPDX-License-Identifier: GPL-3.0-or-later
-- Every example of the manual and of the README runs as a user would run it: complete ones as they are,
-- shorter ones after the first block of the page "start", each in its own folder and process.
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/manual"
local program = dofile(here .. "/../host/program.lua")
local lfs = require "lfs"
local manual = require "softworld.manual"
require "softworld"

local path = program.path:find "^/" and program.path or lfs.currentdir() .. "/" .. program.path

local function blocks_of(text)
  local list = {}
  for block in text:gmatch "```lua\n(.-)```" do list[#list + 1] = block end
  return list
end

local scene = blocks_of(manual.read "start")[1]

local function run(block)
  local folder = program.folder()
  local complete = block:find('require "softworld"', 1, true)
  program.write(folder .. "/script.lua", complete and block or scene .. block)
  local out, err, code = program.shell(("cd %s && %s script.lua"):format(program.quote(folder),
    program.quote(path)))
  assert.are.equal(0, code, err)
  assert.are.equal("", err) -- no remark, and no unread failure
  return out, folder
end

describe("examples of the manual:", function()
  teardown(program.clean)

  local count = 0
  for _, group in ipairs(manual.groups) do
    for _, name in ipairs(group[2]) do
      for i, block in ipairs(blocks_of(manual.read(name))) do
        count = count + 1
        it(("%s, %d"):format(name, i), function() run(block) end)
      end
    end
  end

  it("number at least 40", function() assert.is_true(count >= 40, count) end)

  it("saved runs continue with all their steps done", function()
    local block = blocks_of(manual.read "save")[1] .. "\nprint(sw.load 'laying.sws'.time == scene.time)"
    local out, folder = run(block)
    assert.are.equal("true\n", out)
    out = program.shell(("cd %s && %s script.lua"):format(program.quote(folder), program.quote(path)))
    assert.are.equal("true\n", out)
  end)

  it("a mixed grasp freezes", function()
    local out = run(blocks_of(manual.read "mixed")[1])
    assert.matches("true\tfrozen\n$", out)
  end)

  -- The capstan without weight: with friction 0.2 over half a turn the hand pulls less than the pin when it
  -- stops. Both are in tension, and the peg bears the sum of both.
  it("a wire wound half round a peg presses on it with the pull of both ends", function()
    local out = run(blocks_of(manual.read "winding")[1])
    local peg, radius, hand = out:match "^true\t(%S+)\t(%S+)\t[^\n]-(%S+)\n$"
    assert.is_truthy(peg, out)
    assert.is_true(tonumber(peg) < 0 and tonumber(hand) < 0, out)
    assert.is_true(math.abs(tonumber(radius) / 0.0215 - 1) < 0.1, out) -- 60 segments of 4 mm
  end)
end)

describe("the README's script", function()
  teardown(program.clean)

  -- The wire ends hanging over the wall, held by its own friction: its pull is below its weight, 0.289 N.
  it("runs as it stands", function()
    local blocks = blocks_of(program.read "README.md")
    assert.are.equal(1, #blocks)
    local force = tonumber(run(blocks[1]):match "\n(%S+)%s+%S+%s+%S+%s+%S+%s+%S+\n$")
    assert.is_true(force > 0.05 and force < 0.289, force)
  end)
end)
