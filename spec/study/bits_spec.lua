-- SPDX-License-Identifier: GPL-3.0-or-later
-- The same table, bit by bit, whoever computes it, in any order, however often it was interrupted.
local sw = require "softworld"
local program = require "host.program"

-- A script that sweeps, searches and spreads a small scene, and writes the table. Its arguments: the
-- journal, the table, the number of workers, and the waiting time of an evaluation [s].
local SCRIPT = [[
local sw = require "softworld"
local wire, hand
local study = sw.study { name = "bits", file = arg[1] ~= "none" and arg[1] or nil, workers = tonumber(arg[3]),
  seed = 7, parameters = { height = { 0.02, 0.2, unit = "m" }, speed = { 0.1, 1, unit = "m/s", log = true },
    segments = { choices = { "few", "many" } } },
  setup = function()
    local scene = sw.scene { name = "bits" }
    scene:obstacle { shape = "plane", friction = 0.3 }
    wire = scene:wire { E = 5e7, density = 1500, radius = 0.002, segments = 10, from = { 0, 0, 0.002 },
      to = { 0.3, 0, 0.002 } }
    hand = scene:gripper { name = "hand" }
    return scene
  end,
  evaluate = function(p, scene)
    if p.random() < 0.1 then error("lost by chance", 0) end
    local push = 0.1 * p.random()
    scene:process(function(q)
      hand:grasp(wire, { s = 0.15 })
      hand:move { by = { push, 0, p.height }, speed = p.speed }
    end)
    local run = scene:run { dt = p.segments == "few" and 0.01 or 0.005, duration = 0.1 }
    assert(run.ok, run.reason)
    if arg[4] then os.execute("sleep " .. arg[4]) end
    return { force = hand.peak_force, bend = wire:min_bend_radius(), luck = math.random() }
  end,
  constraints = { bend = { min = 0.01 } } }
study:sweep { kind = "latin", count = 40 }
study:spread { count = 60 }
study:csv(arg[2])
print(study.computed)
]]

local SEARCH = [[
local sw = require "softworld"
local study = sw.study { name = "search", file = arg[1] ~= "none" and arg[1] or nil,
  workers = tonumber(arg[3]), parameters = { a = { -2, 2 }, b = { -1, 3, start = 2 } },
  constraints = { a2 = { max = 0.8 } },
  evaluate = function(p)
    if p.random() < 0.05 then error("lost by chance", 0) end
    if arg[4] then os.execute("sleep " .. arg[4]) end
    return { y = 100 * (p.b - p.a ^ 2) ^ 2 + (1 - p.a) ^ 2, a2 = p.a }
  end }
study:minimise("y", { evaluations = 150 })
study:csv(arg[2])
print(study.computed)
]]

-- The table that a script writes, and the number of evaluations that it has computed.
local function table_of(text, journal, workers, wait)
  local csv = program.folder() .. "/table.csv"
  local out, err, code = program.script(text, { journal, csv, tostring(workers), wait })
  assert.equal(0, code, err)
  return program.read(csv), tonumber(out:match "%d+")
end

local function lines_of(path)
  return select(2, program.read(path):gsub("\ne ", ""))
end

describe("the table", function()
  teardown(program.clean)

  for name, text in pairs { ["of a sweep and a spread"] = SCRIPT, ["of a search"] = SEARCH } do
    it(name .. " is the same for 0, 1, 2, 4 and 7 workers", function()
      local expected = table_of(text, "none", 1)
      assert.truthy(expected:find("lost by chance", 1, true))
      for _, workers in ipairs { 0, 2, 4, 7 } do
        assert.is_true(expected == table_of(text, "none", workers), workers .. " workers")
      end
    end)
  end

  it("is the same from a journal in another order", function()
    local journal = program.folder() .. "/a.study"
    local expected, computed = table_of(SCRIPT, journal, 2)
    assert.equal(100, computed)
    local first, lines = {}, {}
    for line in program.read(journal):gmatch "[^\n]+\n" do -- other lines keep their place
      local list = line:find "^e " and lines or first
      list[#list + 1] = line
    end
    for i = #lines, 2, -1 do
      local k = 1 + (i * 7919) % i
      lines[i], lines[k] = lines[k], lines[i]
    end
    program.write(journal, table.concat(first) .. table.concat(lines))
    local again
    again, computed = table_of(SCRIPT, journal, 2)
    assert.is_true(expected == again)
    assert.equal(0, computed)
    -- with every second line missing, the missing ones are computed in another order than before
    for i = #lines, 1, -2 do table.remove(lines, i) end
    program.write(journal, table.concat(first) .. table.concat(lines))
    again, computed = table_of(SCRIPT, journal, 4)
    assert.is_true(expected == again)
    assert.equal(50, computed)
  end)

  -- The process is killed at arbitrary times, but not before the journal exists, however slow the machine
  -- is.
  local function broken_off(text, workers, times, who)
    local folder = program.folder()
    local journal, csv = folder .. "/a.study", folder .. "/a.csv"
    local script = program.write(folder .. "/script.lua", text)
    for k = 1, times do
      local wait = 0.05 + 0.1 * ((k * 0.6180339887) % 1)
      local victim = who == "parent" and "kill -KILL $p" or "pkill -KILL -n -P $p"
      program.shell(("%s %s %s %s %d 0.003 >/dev/null 2>&1 & p=$!; i=0; "
        .. "while [ ! -e %s ] && [ $i -lt 3000 ]; do sleep 0.01; i=$((i+1)); done; "
        .. "sleep %.3f; %s; %s wait $p"):format(
        program.quote(program.path), script, journal, csv, workers, journal, wait, victim,
        who == "parent" and "" or "sleep 0.05; kill -KILL $p;"))
    end
    local before = lines_of(journal)
    local again, computed = table_of(text, journal, workers, "0.003")
    return again, computed, before
  end

  it("is the same after the parent was killed again and again, and nothing is computed twice", function()
    local expected = table_of(SCRIPT, "none", 2, "0.003")
    for _, workers in ipairs { 1, 2 } do
      local again, computed, before = broken_off(SCRIPT, workers, 6, "parent")
      assert.is_true(expected == again)
      assert.equal(100, computed + before)
    end
    expected = table_of(SEARCH, "none", 2, "0.003")
    local again = broken_off(SEARCH, 2, 6, "parent")
    assert.is_true(expected == again)
  end)

  it("is the same after workers and their parent were killed", function()
    local expected = table_of(SCRIPT, "none", 2, "0.003")
    assert.is_true(expected == broken_off(SCRIPT, 2, 6, "worker"))
    expected = table_of(SEARCH, "none", 2, "0.003")
    assert.is_true(expected == broken_off(SEARCH, 2, 6, "worker"))
  end)
end)

describe("a part that was interrupted", function()
  it("continues when it is called again, also without a journal", function()
    local calls = {}
    local s = sw.study { name = "r", parameters = { x = { 0, 1 } }, workers = 0, evaluate = function(p)
      calls[p.number] = (calls[p.number] or 0) + 1
      return { y = p.random(), z = p.x }
    end }
    -- an error in the middle of it, as from a full disk or Ctrl-C
    local real, before = sw.core.checksum, nil
    sw.core.checksum = function(...)
      if calls[6] and not before then
        before = true
        error "stopped"
      end
      return real(...)
    end
    local fine = pcall(s.sweep, s, { count = 10 })
    sw.core.checksum = real
    assert.is_false(fine)
    local rows = s:sweep { count = 10 }
    assert.equal(10, #rows)
    assert.equal(1, rows[10].part)
    for k = 1, 10 do assert.equal(1, calls[k]) end -- nothing is computed twice
  end)
end)

describe("random numbers of an evaluation", function()
  local function study(seed)
    return sw.study { name = "r", seed = seed, parameters = { x = { 0, 1 } },
      evaluate = function(p)
        return { a = p.random(), b = math.random(), c = p:random(1, 1000), d = p.random(10), n = p.number }
      end }
  end

  it("depend on the seed and the number of the evaluation only", function()
    local first, other = study(1):sweep { count = 50 }, study(2):sweep { count = 50 }
    local again = study(1):sweep { count = 20, workers = 0 }
    local seen = {}
    for i, row in ipairs(first) do
      assert.equal(i, row.n)
      assert.is_true(row.a ~= row.b and row.a ~= other[i].a)
      assert.is_true(row.d >= 1 and row.d <= 10)
      assert.is_nil(seen[row.a])
      seen[row.a] = true
      if again[i] then assert.is_true(row.a == again[i].a and row.b == again[i].b and row.c == again[i].c) end
    end
    -- another part has other numbers
    local s = study(1)
    assert.is_true(s:sweep { count = 1 }[1].a ~= s:sweep { count = 1 }[1].a)
  end)

  it("leave the script's own random numbers unchanged", function()
    local function after(work)
      math.randomseed(5)
      if work then study(1):sweep { count = 3, workers = 2 } end
      return math.random()
    end
    assert.equal(after(false), after(true))
  end)
end)
