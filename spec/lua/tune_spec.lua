-- SPDX-License-Identifier: GPL-3.0-or-later
-- sw.tune.minimise: minima of functions of one and of several numbers.
local core = require "softworld.core"
local sw = require "softworld"
local program = require "host.program"
local minimise = sw.tune.minimise

describe("tune.minimise", function()
  it("finds known minima of functions of one number", function()
    -- (x - 1/3)^2 + 2: Brent knows x to about sqrt(epsilon).
    local r = minimise { f = function(x) return (x - 1 / 3) ^ 2 + 2 end, from = -1, to = 4 }
    assert.is_true(r.ok, r.reason)
    assert.is_true(math.abs(r.x - 1 / 3) < 5e-6)
    assert.are.equal(2, r.value)
    -- cos is smallest at pi
    r = minimise { f = math.cos, from = 2, to = 5, tolerance = 1e-8 }
    assert.is_true(math.abs(r.x - math.pi) < 1e-7)
    -- a kink: the tolerance is a share of the interval
    r = minimise { f = function(x) return math.abs(x - 0.7) end, from = 0, to = 1, tolerance = 1e-5 }
    assert.is_true(math.abs(r.x - 0.7) < 1e-5)
  end)

  it("takes the lower of two valleys when the first look tells them apart", function()
    -- minima near -1 and 1; the tilt of x / 10 makes that near -1 the lower
    local r = minimise { f = function(x) return (x * x - 1) ^ 2 + x / 10 end, from = -2, to = 2 }
    -- root of 4 x^3 - 4 x + 1/10 near -1: x = -1.01223...
    assert.is_true(math.abs(4 * r.x ^ 3 - 4 * r.x + 0.1) < 1e-4)
    assert.is_true(r.x < 0)
  end)

  it("finds known minima of functions of several numbers", function()
    local r = minimise { start = { -1.2, 1 }, max_iterations = 500,
      f = function(x) return 100 * (x[2] - x[1] ^ 2) ^ 2 + (1 - x[1]) ^ 2 end }
    assert.is_true(r.ok, r.reason)
    assert.is_true(math.abs(r.x[1] - 1) < 1e-5 and math.abs(r.x[2] - 1) < 1e-5)
    r = minimise { start = 5, step = 2, f = function(x) return (x + 2) ^ 4 end }
    assert.is_true(math.abs(r.x + 2) < 1e-2) -- a flat bottom: x to value^(1/4)
    r = minimise { start = { 1, 2, 3 }, step = { 0.5, 0.5, 1 }, tolerance = 1e-8, max_iterations = 1000,
      f = function(x) return (x[1] - 1) ^ 2 + (x[2] + 1) ^ 2 + 10 * (x[3] - 2) ^ 2 end }
    for i, expected in ipairs { 1, -1, 2 } do assert.is_true(math.abs(r.x[i] - expected) < 1e-6) end
  end)

  it("counts iterations and evaluations", function()
    local calls = 0
    local r = minimise { from = 0, to = 1, f = function(x)
      calls = calls + 1
      return (x - 0.4) ^ 2
    end }
    assert.are.equal(calls, r.evaluations)
    assert.is_true(r.iterations >= 1 and r.evaluations <= 60)
    r = minimise { start = { 0, 0 }, max_iterations = 3,
      f = function(x) return x[1] ^ 2 + x[2] ^ 2 + x[1] end }
    assert.are.equal(3, r.iterations)
    assert.is_false(r.ok)
    assert.are.equal("iterations used up", r.reason)
  end)

  it("reports a minimum at an end of the interval", function()
    local r = minimise { f = function(x) return x end, from = -1, to = 4 }
    assert.is_false(r.ok)
    assert.are.equal(-1, r.x)
    assert.truthy(r.reason:find("at the end -1", 1, true))
    assert.is_false(minimise { f = function() return 1 end, from = 0, to = 1 }.ok) -- constant
    r = minimise { f = function(x) return x end, from = 0, to = 1, max_iterations = 3 }
    assert.same({ false, 0.0, 3 }, { r.ok, r.x, r.iterations })
    assert.equal("iterations used up near the end 0 of the interval", r.reason)
  end)

  it("finds minima near an end of the interval", function()
    local function inf_beyond(x) return x > 0.01 and math.huge or (x - 0.005) ^ 2 end
    for place, f in pairs { [0.001] = "square", [0.999] = "square", [1e-4] = "kink", [1 - 1e-4] = "kink",
      [5e-6] = "kink", [0.0625] = "square", [0.9375] = "square", [0.005] = inf_beyond } do
      local functions = { square = function(x) return (x - place) ^ 2 end,
        kink = function(x) return math.abs(x - place) end }
      local r = minimise { from = 0, to = 1, f = functions[f] or f }
      assert.is_true(r.ok, r.reason)
      assert.near(place, r.x, 1e-6)
    end
  end)

  it("says where the smallest values are the same", function()
    for reason, f in pairs {
      ["the smallest value, 0.5, is the same from 0.5 to 0, the lower end of the interval"] =
        function(x) return math.max(0.5, x) end,
      ["the smallest value, 0.5, is the same from 0.5 to 1, the upper end of the interval"] =
        function(x) return math.max(0.5, 1 - x) end,
      ["the smallest value, 0.01, is the same from 0.992188 to 1, the upper end of the interval"] =
        function(x) return math.max(0.01, 1 - x) end,
      ["f has the same value, 3, at all places between 0 and 1 that were tried"] =
        function() return 3 end } do
      local r = minimise { from = 0, to = 1, f = f }
      assert.same({ false, reason, f(r.x) }, { r.ok, r.reason, r.value })
    end
  end)

  it("keeps the search away from values that are not finite", function()
    local r = minimise { from = -2, to = 5, f = function(x)
      if x < 0 then return 0 / 0 end
      return (x - 1) ^ 2
    end }
    assert.is_true(math.abs(r.x - 1) < 1e-5)
    assert.is_true(r.nonfinite >= 2)
    r = minimise { start = { 3, 1 }, f = function(x)
      if x[1] < 0.5 then return math.huge end
      return (x[1] - 1) ^ 2 + x[2] ^ 2
    end }
    assert.is_true(math.abs(r.x[1] - 1) < 1e-4)
    assert.error_matches(function() minimise { from = 0, to = 1, f = function() return 0 / 0 end } end,
      "no finite number anywhere between 0 and 1")
    assert.error_matches(function() minimise { start = 1, f = function() return 0 / 0 end } end,
      "no finite number near start")
  end)

  it("raises errors of the function unchanged, at the first one", function()
    local mine = setmetatable({}, {})
    for _, args in ipairs { { from = 0, to = 1 }, { start = { 1, 2 } } } do
      local calls = 0
      args.f = function()
        calls = calls + 1
        if calls == 3 then error(mine) end
        return calls
      end
      local ok, err = pcall(minimise, args)
      assert.is_false(ok)
      assert.are.equal(mine, err)
      assert.are.equal(3, calls)
    end
  end)

  it("can be used inside itself", function()
    local r = minimise { from = 0, to = 2, f = function(a)
      return (a - 1) ^ 2 + minimise { from = -1, to = 1, f = function(b) return (b - a / 4) ^ 2 end }.value
    end }
    assert.is_true(math.abs(r.x - 1) < 1e-5)
  end)

  it("refuses wrong arguments, naming them", function()
    local function f(x) return x end
    for pattern, args in pairs {
      ["f is required"] = { from = 0, to = 1 },
      ["f must be a function, got number"] = { f = 3, from = 0, to = 1 },
      ["did you mean 'tolerance'"] = { f = f, from = 0, to = 1, tolerence = 1e-3 },
      ["from = 2 and to = 1 are not an interval"] = { f = f, from = 2, to = 1 },
      ["give either from and to, or start"] = { f = f },
      ["give either from and to, or start "] = { f = f, from = 1, to = 2, start = 3 },
      ["give either from and to, or start  "] = { f = f, from = 1 },
      ["start, number 2 must be a number, got string"] = { f = f, start = { 1, "x" } },
      ["start has 0 numbers"] = { f = f, start = {} },
      ["step must have as many numbers as start, 2, got 1"] = { f = f, start = { 1, 2 }, step = { 1 } },
      ["with a step of 0"] = { f = f, start = 1, step = 0 },
      ["tolerance = 0"] = { f = f, from = 0, to = 1, tolerance = 0 },
      ["f must return a number, got nil"] = { f = function() end, from = 0, to = 1 },
      ["f must return a number, got string"] = { f = function() return "1" end, start = 1 },
    } do
      local ok, err = pcall(minimise, args)
      assert.is_false(ok)
      assert.truthy(tostring(err):find(pattern:gsub("%s+$", ""), 1, true), tostring(err))
    end
    assert.error_matches(function() minimise() end, "f is required")
    assert.error_matches(function() minimise(3) end, "number")
  end)

  it("survives every failed allocation without a leak", function()
    local function f(x) return x[1] ^ 2 + x[2] ^ 2 end
    minimise { f = f, start = { 1, 2 } }
    local live, before = core.allocated()
    minimise { f = f, start = { 1, 2 } }
    local _, after = core.allocated()
    assert.is_true(after > before)
    for n = 1, after - before do
      core.fail_allocation(n)
      local ok, err = pcall(minimise, { f = f, start = { 1, 2 } })
      core.fail_allocation(0)
      assert.is_false(ok)
      assert.truthy(err:find "out of memory")
      assert.are.equal(live, (core.allocated()))
    end
    assert.is_true(minimise { f = f, start = { 1, 2 } }.ok)
  end)

  it("tells a script that does not look whether it ended", function()
    local ask = [[
      local found = require("softworld").tune.minimise { start = 1, max_iterations = 2, f = function(x)
        return (x - 5) ^ 2
      end }
      print(found.x > 1) ]]
    local out, err, code = program.script(ask)
    assert.equal("true\n", out)
    assert.truthy(err:find("note: the search of tune.minimise at script.lua:1 is not at its end", 1, true),
      err)
    assert.equal(0, code)
    for _, look in ipairs{ "assert(not found.ok)", "print(found.reason)", "print(found)" } do
      out, err, code = program.script(ask .. look)
      assert.equal("", err)
      assert.equal(0, code, out)
    end
    assert.truthy(out:find("at 1.%d+ %(iterations used up, %d+ evaluations%)"), out)
    program.clean()
    assert.has_error(function() return minimise { f = math.abs, start = 1 }.valeu end)
  end)

  it("stops at one Ctrl-C", function()
    local _, err, code = program.script([[
      require("softworld").tune.minimise { start = 1, f = function(x)
        for i = 1, 1e6 do x = x + math.sin(i) end
        return math.random() * x
      end, max_iterations = 100000, tolerance = 1e-300 }]], nil,
      { before = "env --default-signal=INT", signals = { 0.3 } })
    program.clean()
    assert.are.equal(130, code)
    assert.truthy(err:find("interrupted", 1, true), err)
  end)
end)
