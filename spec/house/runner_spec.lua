-- SPDX-License-Identifier: GPL-3.0-or-later
-- The spec runner: no test passes by being skipped, crashing, leaving early or not existing.
local tree = require "house.tree"

local LUA = "-- SPDX-License-Identifier: GPL-3.0-or-later\n"
local GOOD = LUA .. 'it("adds", function() assert.equal(2, 1 + 1) end)\n'
  .. 'it("multiplies", function() assert.equal(6, 2 * 3) end)\n'

local function spec(files, options)
  local folder = tree.make {}
  tree.run(("cp -r %s/scripts %s"):format(tree.quote(tree.root), tree.quote(folder)))
  for name, text in pairs(files) do tree.write(folder .. "/spec/" .. name .. "_spec.lua", text) end
  local text, status = tree.run(("cd / && SOFTWORLD_BIN=%s %s %s/scripts/spec.lua %s"):format(
    tree.quote(tree.host), tree.quote(tree.host), tree.quote(folder), options or ""))
  tree.remove(folder)
  return text, status, text:match "([^\n]*)\n$"
end

-- A single file must fail with these words and this closing line.
local function fails(text, words, closing, options)
  local output, status, last = spec({ ["room/a"] = text }, options)
  assert.truthy(output:find(words, 1, true), "no '" .. words .. "' in:\n" .. output)
  assert.equal(closing, last)
  assert.equal(1, status)
end

describe("spec runner", function()
  it("passes when all tests pass", function()
    local text, status, last = spec { a = GOOD, b = GOOD }
    assert.equal("4 passed, 0 failed", last)
    assert.equal(0, status)
    assert.truthy(text:find "spec/a_spec.lua +2 passed, 0 failed +[%d.]+ s\nspec/b_spec.lua", text)
  end)
  it("shows the place and the message of a failure, and the output of the file", function()
    fails(LUA .. 'it("differs", function()\n  print "seen"\n  assert.equal(1, 2)\nend)',
      "FAIL spec/room/a_spec.lua:4: differs\n    Expected objects to be equal.", "0 passed, 1 failed")
    fails(LUA .. 'it("differs", function() print "seen" assert.equal(1, 2) end)',
      "its output:\n    seen", "0 passed, 1 failed")
  end)
  it("shows measured values on request", function()
    local file = { a = LUA
      .. 'it("x", function() print("measured: 42", os.getenv "SOFTWORLD_MEASURED") end)' }
    assert.falsy((spec(file)):find("measured", 1, true))
    assert.truthy((spec(file, "--measured")):find("\n  measured: 42\t1\n", 1, true))
  end)
  it("names the line of the test when a helper failed", function()
    fails(LUA .. 'local function same(a, b)\n  assert.equal(a, b)\nend\n'
        .. 'it("x", function()\n  same(1, 2)\nend)',
      "(called from spec/room/a_spec.lua:6)", "0 passed, 1 failed")
    local text = spec { a = LUA .. 'it("x", function()\n  assert.equal(1, 2)\nend)' }
    assert.falsy(text:find("called from", 1, true), text)
  end)
  it("counts errors inside and outside of tests", function()
    fails(GOOD .. 'it("x", function() error "oh" end)', "oh", "2 passed, 1 failed")
    fails(GOOD .. 'describe("d", function() error "oh" end)', "error in describe", "2 passed, 1 failed")
    fails(GOOD .. 'describe("d", function() setup(function() error "oh" end) it("x", function() end) end)',
      "error in strict_setup", "2 passed, 1 failed")
    fails("it(", "(loading)", "0 passed, 1 failed")
  end)
  it("counts a pending test as failed", function()
    fails(GOOD .. 'pending("later")', "not run, so not passed", "2 passed, 1 failed")
    fails(GOOD .. 'it("x", function() pending "later" end)', "later", "2 passed, 1 failed")
  end)
  it("counts a file without tests as failed, and a run without files too", function()
    fails(LUA, "holds no test", "0 passed, 1 failed")
    fails(GOOD, "no test was found", "0 passed, 1 failed", "nowhere")
    fails(GOOD, "no test was found", "0 passed, 1 failed", "--name nothing")
  end)
  it("counts os.exit as failed wherever it is called", function()
    fails(GOOD .. 'it("leaves", function() os.exit(0) end)',
      "a_spec.lua:4: leaves\n    the spec file ended with exit status 0", "2 passed, 1 failed")
    fails(GOOD .. "os.exit(true, true)", "does it call os.exit?", "0 passed, 1 failed")
  end)
  it("survives a crash and names the test", function()
    fails(GOOD .. 'it("crashes", function() os.execute "kill -ABRT $PPID" end)',
      "a_spec.lua:4: crashes\n    the spec file crashed: signal 6", "2 passed, 1 failed")
  end)
  it("stops a file that takes too long", function()
    fails(LUA .. 'it("hangs", function() while true do end end)', "took longer than 1 s",
      "0 passed, 1 failed", "--timeout 1")
  end)
  it("selects by path and by name", function()
    local files = { ["base/a"] = GOOD, ["wire/b"] = GOOD }
    assert.equal("2 passed, 0 failed", select(3, spec(files, "spec/wire")))
    assert.equal("2 passed, 0 failed", select(3, spec(files, "--name multi")))
    assert.equal("1 passed, 0 failed", select(3, spec(files, "base/ --name adds")))
  end)
  it("lists tests without running them", function()
    local text, status = spec({ a = GOOD .. 'it("no", function() error "ran" end)' }, "--list")
    assert.equal("spec/a_spec.lua:2: adds\nspec/a_spec.lua:3: multiplies\nspec/a_spec.lua:4: no\n", text)
    assert.equal(0, status)
  end)
  it("shows the slowest tests", function()
    local text = spec({ a = GOOD }, "--slow 1")
    assert.truthy(text:find "slowest tests:\n +[%d.]+ s  spec/a_spec.lua:%d: %a+\n2 passed", text)
  end)
  it("also runs under stock lua5.4, with its module", function()
    local folder = tree.make { ["spec/a_spec.lua"] = GOOD
      .. 'it("loads", function() assert.is_string(require "softworld.core".version) end)\n' }
    -- A module built with sanitizers needs their library loaded first.
    local text, status = tree.run(("cp -r %s/scripts %s && LD_PRELOAD=$SOFTWORLD_PRELOAD lua5.4 %s")
      :format(tree.quote(tree.root), tree.quote(folder), tree.quote(folder .. "/scripts/spec.lua")))
    tree.remove(folder)
    assert.truthy(text:find "\n3 passed, 0 failed\n$", text)
    assert.equal(0, status)
  end)
  it("refuses unknown options", function()
    assert.equal(2, select(2, spec({ a = GOOD }, "--nonsense")))
  end)
end)
