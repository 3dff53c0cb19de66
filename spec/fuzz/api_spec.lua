-- SPDX-License-Identifier: GPL-3.0-or-later
-- A few cases of random calls of the kind that `make fuzz` does by the thousand; and that findings are
-- reported.
local program = require "host.program"
local quote = program.quote

local function fuzz(options)
  local out, _, code = program.shell(("%s %s/scripts/fuzz.lua %s 2>&1"):format(quote(program.path),
    program.root, options))
  return out, code
end

describe("random calls", function()
  after_each(program.clean)

  for _, seed in ipairs{ 1, 11, 21, 51 } do
    it(("of all that there is find nothing (from seed %d)"):format(seed), function()
      local out, code = fuzz(("seed=%d calls=300 per=100 shrink=0 cpu=120 slow=60 out=%s"):format(seed,
        quote(program.folder())))
      assert.is_truthy(out:find "\n?3%d%d calls, 0 findings\n$", out)
      assert.equal(0, code)
    end)
  end

  for _, seed in ipairs{ 400000, 720010, 800006 } do -- seeds that once found something
    it(("find nothing any more: seed %d"):format(seed), function()
      local out, code = fuzz(("seed=%d calls=150 shrink=0 cpu=120 slow=60 out=%s"):format(seed,
        quote(program.folder())))
      assert.is_truthy(out:find "\n?1%d%d calls, 0 findings\n$", out)
      assert.equal(0, code)
    end)
  end

  it("report how often each method was reached", function()
    local out = fuzz(("seed=1 calls=100 per=100 shrink=0 cpu=120 slow=60 reach=1 out=%s"):format(
      quote(program.folder())))
    local fine, called = out:match "(%d+) of +(%d+)  scene%.run\n"
    assert.is_truthy(tonumber(fine) and tonumber(fine) <= tonumber(called) and tonumber(called) > 0, out)
  end)

  local function replayed(text, options)
    local folder = program.folder()
    program.write(folder .. "/case.lua", text)
    return fuzz(("replay=%s %s"):format(quote(folder .. "/case.lua"), options or ""))
  end

  it("are the same every time for one seed", function()
    local folder = program.folder()
    local function log()
      local command = "mkdir -p %s/tmp && cd %s/tmp && %s %s/scripts/fuzz.lua child=%s seed=3 per=60"
      os.execute((command .. " >/dev/null 2>&1"):format(
        folder, folder, quote(program.shell("realpath " .. quote(program.path)):match "[^\n]+"),
        quote(program.shell("realpath " .. quote(program.root)):match "[^\n]+"), folder))
      return program.read(folder .. "/log")
    end
    local first = log()
    assert.is_true(#first > 1000)
    assert.equal(first, log())
  end)

  it("report bad errors", function()
    local wire = "v[1]:wire{ cable = 'GXL 1.5', from = { 0, 0, 0 }, to = { 1, 0, 0 } }"
    local good = "v[1] = sw.scene{}\n\nreturn v[1].name\n\n"
    for _, case in ipairs{ { "return 1", "0 findings" },
      { "error{}", "an error that is a table" }, { "error 'no'", "an error that tells nothing" },
      { "load('return nil + 1', '=softworld/x.lua')()", "a raw error" },
      { wire .. " error 'and yet there is a wire'",
        "and yet changed: v[1] (scene) parts" },
      { "while true do end", "hang", "cpu=1" }, { "os.execute 'kill -USR1 $PPID'", "crash signal 10" },
      { "os.exit(7)", "crash exit 7" },
      { "local t = os.clock() while os.clock() < t + 0.3 do end", "slow 0.", "slow=0.2" },
    } do
      local out, code = replayed(good .. case[1] .. "\n", case[3])
      assert.is_truthy(out:find(case[2], 1, true), case[1] .. ": " .. out)
      assert.equal(case[2] == "0 findings" and 0 or 1, code)
    end
  end)

  it("report invalid numbers after a run that says ok", function()
    local out = replayed [=[
v[1] = sw.scene{}

v[2] = v[1]:wire{ cable = 'GXL 1.5', from = { 0, 0, 0 }, to = { 1, 0, 0 } }

core.class.wire.max_tension = function() return 0 / 0 end

v[3] = v[1]:run{ duration = 0.01 }
]=]
    assert.is_truthy(out:find("max_tension", 1, true), out)
  end)
end)
