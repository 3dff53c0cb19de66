-- SPDX-License-Identifier: GPL-3.0-or-later
-- The journal: its results are not computed again; torn or strange lines are reported and never used.
local sw = require "softworld"
local program = require "host.program"
local bytecode = require "softworld.study.bytecode"
local journal = require "softworld.study.journal"

local function evaluate(p) return { y = p.x ^ 2, third = p.x / 3 } end

local function study(path, changes)
  local args = { name = "s", file = path, parameters = { x = { 0, 1 } }, evaluate = evaluate, workers = 0 }
  for key, value in pairs(changes or {}) do args[key] = value end
  return sw.study(args)
end

-- Returns what f writes to stderr.
local function told(f)
  local real, lines = io.stderr, {}
  io.stderr = { write = function(_, ...) lines[#lines + 1] = table.concat { ... } end } -- luacheck: ignore
  local fine, why = pcall(f)
  io.stderr = real -- luacheck: ignore
  assert(fine, why)
  return table.concat(lines)
end

local function new_path() return program.folder() .. "/s.study" end

local function swept(path, changes)
  local s = study(path, changes)
  local rows = s:sweep { count = 20 }
  return s, rows
end

describe("a journal", function()
  teardown(program.clean)

  it("keeps all bits, and nothing is computed twice", function()
    local path = new_path()
    local first, rows = swept(path)
    assert.equal(20, first.computed)
    local second, again = swept(path)
    assert.equal(0, second.computed)
    assert.same(rows, again)
    local more = study(path)
    more:sweep { count = 30 } -- of a sequence with the same beginning
    assert.equal(10, more.computed)
    assert.same(more:table(), study(path):table()) -- without asking for any evaluation
  end)

  it("is shown with parts that the script does not ask for", function()
    local path = new_path()
    local s = study(path)
    s:minimise "y"
    s:sweep { count = 20 }
    s = study(path)
    s:minimise("y", { evaluations = 8 })
    assert.truthy(tostring(s):find("1. minimise y: 8 evaluations, 0 failed", 1, true), tostring(s))
    assert.truthy(tostring(s):find("2. in the journal: 20 evaluations, 0 failed", 1, true))
    assert.truthy(tostring(s):find("best y, evaluation %d"))
    assert.equal(28, #s:table())
  end)

  it("continues after a line that was torn anywhere", function()
    local path = new_path()
    local _, rows = swept(path)
    local text = program.read(path)
    local last = text:match ".*\n()[^\n]+\n$"
    for cut = #text - 1, last - 1, -1 do
      program.write(path, text:sub(1, cut))
      local s
      assert.equal("", told(function() s = study(path); s:sweep { count = 20 } end))
      assert.equal(1, s.computed)
      assert.same(rows, s:table())
      assert.equal("", told(function() s = study(path); s:sweep { count = 20 } end))
      assert.equal(0, s.computed)
    end
  end)

  it("continues after its first lines were torn", function()
    local path = new_path()
    local _, rows = swept(path)
    local text = program.read(path)
    local third = text:match "^[^\n]+\n[^\n]+\n()"
    for cut = 0, third - 1 do
      program.write(path, text:sub(1, cut))
      local s, again = swept(path)
      assert.equal(20, s.computed)
      assert.same(rows, again)
      assert.equal(0, (swept(path)).computed)
    end
  end)

  it("with a damaged line reports it, and the evaluation is repeated", function()
    local path = new_path()
    local _, rows = swept(path)
    local text = program.read(path)
    local place = text:find "\ne 1 5 "
    for offset = 1, 60, 7 do
      local byte = text:byte(place + offset)
      program.write(path, text:sub(1, place + offset - 1) .. string.char(byte ~ 1)
        .. text:sub(place + offset + 1))
      local s, again
      local said = told(function() s, again = swept(path) end)
      assert.truthy(said:find("s.study: 1 damaged line (the first is line 8) contributes nothing", 1, true),
        said)
      assert.equal(1, s.computed)
      assert.same(rows, again)
    end
  end)

  it("of arbitrary bytes is refused and left alone, or read without harm", function()
    local path = new_path()
    swept(path)
    local first = program.read(path):match "^[^\n]*\n"
    for _, text in ipairs { "hello\n", "\n\n", ("x"):rep(1000), "softworld study 2 0000000000000000\n",
      "\0\0\n" } do
      program.write(path, text)
      assert.error_matches(function() study(path) end, "is not a journal of a study; the file is left as it "
        .. "is")
      assert.equal(text, program.read(path))
    end
    local function line(body) return ("%s %016x\n"):format(body, sw.core.checksum(body)) end
    for _, body in ipairs { "e", "e 1", "e 1 2", "e 0 0 0.5 ok y=1", "t",
      "e 99999999999999999999 1 0.5 ok y=1", "e 1 1 0.5 ok y=zz", "e 1 1 0.5 ok", "e -1 1 0.5 ok y=1",
      "e 1 1 nan ok y=1", "z 1", "\0", "e 1 1  " } do
      program.write(path, first .. line(body) .. program.read(path):gsub("^[^\n]*\n", ""))
      told(function() study(path):table() end)
    end
    program.write(path, first .. line 's "s" 0 "x')
    assert.error_matches(function() study(path) end, "s.study:2 is not a line of a journal")
  end)

  it("with nonsense behind correct checksums is not used", function()
    local path = new_path()
    local _, rows = swept(path)
    local text = program.read(path)
    local function line(body) return ("%s %016x\n"):format(body, sw.core.checksum(body)) end
    for _, body in ipairs { "e 1 3 0.5 ok y=zz", "e 1 3 0.25,1 ok y=1", "e 1 3 text ok y=1",
      "e 1 3 0.25 maybe y=1", "e 1 3 0.25 ok", "e 1 3 0.25 ok y=nan third=1", "e 1 3" } do
      program.write(path, text .. line(body))
      local s, again
      told(function() s, again = swept(path) end)
      assert.same(rows, again)
      told(function() study(path):table() end)
      assert.is_true(s.computed <= 1)
    end
  end)

  it("of another study is refused", function()
    local path = new_path()
    swept(path)
    assert.error_matches(function() study(path, { name = "t" }) end,
      "file = '.*s.study' is the journal of another study, 's'; give this one a file of its own")
  end)

  it("of another definition is reported with the difference, and its lines are kept apart", function()
    local path = new_path()
    local _, rows = swept(path)
    local cases = {
      { { seed = 3 }, "before: seed 1\n", "now:    seed 3\n" },
      { { parameters = { x = { 0, 2, unit = "N" } } }, "before: parameter x: 0.0 to 1.0\n",
        "now:    parameter x: 0.0 to 2.0 N\n" },
      { { evaluate = function(p) return { y = p.x ^ 3 } end }, "before: functions of the script" },
    }
    for _, case in ipairs(cases) do
      local s
      local said = told(function() s = swept(path, case[1]) end)
      assert.truthy(said:find("20 evaluations of another definition, which are kept apart", 1, true)
        or said:find("%d0 evaluations of another definition, which are kept apart"), said)
      assert.truthy(said:find(case[2], 1, true), said)
      assert.truthy(said:find(case[3] or "now:", 1, true), said)
      assert.equal(20, s.computed)
    end
    local s, again -- the first definition's results are still there
    told(function() s, again = swept(path) end)
    assert.equal(0, s.computed)
    assert.same(rows, again)
  end)

  it("that cannot be written is an error before anything is computed", function()
    local folder = program.folder()
    local cases = { ["/nowhere/s.study"] = "cannot write /nowhere/s.study: No such file or directory",
      [folder] = "is a folder, not a file", ["/dev/full"] = "is a device, not a file" }
    for path, text in pairs(cases) do
      local calls = 0
      local fine, why = pcall(function()
        swept(path, { evaluate = function() calls = calls + 1 return { y = 1 } end })
      end)
      assert.is_false(fine)
      assert.truthy(why:find(text, 1, true), why)
      assert.equal(0, calls)
    end
  end)

  -- A limit on the file size stands for a full disk: with both, a write ends short or fails.
  it("on a full disk says so, and continues when there is room", function()
    local folder = program.folder()
    local script = program.write(folder .. "/full.lua", [[
local sw = require "softworld"
local study = sw.study { name = "full", file = arg[1], parameters = { x = { 0, 1 } }, workers = 2,
  evaluate = function(p) return { y = p.x } end }
study:sweep { count = 100 }
print(study.computed)
]])
    local command = ("%s %s %s/full.study"):format(program.quote(program.path), script, folder)
    local _, err, code = program.shell("trap '' XFSZ; ulimit -f 4; " .. command)
    assert.equal(1, code)
    assert.truthy(err:find("full.lua:4: study 'full': cannot write to .*full.study: File too large"), err)
    local out, problem = program.shell(command)
    local computed = tonumber(out)
    assert.is_true(computed > 0 and computed < 100, problem)
    assert.equal("0\n", (program.shell(command)))
  end)

  it("belongs to one process at a time", function()
    local path = new_path()
    local held = study(path, { evaluate = function(p)
      if p.number == 1 then
        local other = study(path)
        local fine, why = pcall(other.sweep, other, { count = 3 })
        assert(not fine)
        error("told: " .. why, 0)
      end
      return { y = 1 }
    end })
    local rows = held:sweep { count = 2, workers = 0 }
    assert.truthy(rows[1].failed:find("another process, or another study of this one, works with", 1, true),
      rows[1].failed)
    told(function() swept(path) end) -- and it is free afterwards
  end)

  it("is optional", function()
    local s = swept(nil)
    assert.is_nil(s.file)
    assert.equal(20, #s:table())
  end)
end)

describe("the code of a function", function()
  it("is the same anywhere in a file, and differs with another number", function()
    local function made(text) return assert(load(text, "=x"))() end
    local text = "return function(x) local t = { 1, 2.5, 'abc', nil, true } return function()"
      .. " return t[x] end end"
    local a = made(text)
    local b = made("\n\nreturn function(y) -- z\n local t = { 1, 2.5, 'abc', nil, true }\n return function()"
      .. " return t[y] end end")
    assert.equal(bytecode(a), bytecode(b))
    for _, other in ipairs { "2.5 -> 2.25", "abc -> abd", "nil, true -> nil, false", "%[x%] -> [x + 1]" } do
      local from, to = other:match "^(.*) %-> (.*)$"
      local c = made((text:gsub(from, to)))
      assert.is_false(bytecode(a) == bytecode(c))
    end
  end)

  it("can be read of every function of the journal module", function()
    local count = 0
    for _, f in pairs(journal) do
      if type(f) == "function" then
        assert.is_true(#bytecode(f) < #string.dump(f, true) - 30)
        count = count + 1
      end
    end
    assert.is_true(count > 5)
  end)

  it("does not write to another file where its name has a zero byte", function()
    local path = new_path()
    local fine, why = pcall(swept, path .. "\0more")
    assert.is_false(fine)
    assert.matches("study 's': cannot read .*zero byte in the path", why)
    assert.is_nil(sw.core.kind(path))
  end)

  it("includes the numbers that a function takes from outside", function()
    local path, friction = new_path(), 0.3
    local function of() return function(p) return { y = p.x * friction } end end
    assert.equal(20, swept(path, { evaluate = of() }).computed)
    assert.equal(0, swept(path, { evaluate = of() }).computed)
    friction = 0.4
    local s
    told(function() s = swept(path, { evaluate = of() }) end)
    assert.equal(20, s.computed)
  end)
end)
