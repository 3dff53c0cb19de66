-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rows of calls made in Lua: every public method and field has a row, and every row has its method or
-- field. Wrong arguments of every row are refused by name; help and completion show the rows.
local sw = require "softworld"
local core = require "softworld.core"
local repl = require "softworld.prompt.repl"
local rows = require "softworld.rows"
local topics = require "softworld.prompt.topics"

-- Returns one object of each class, by its name in scripts.
local function objects()
  local scene = sw.scene{}
  local wire = scene:wire{ E = 1e7, density = 1200, radius = 0.003, from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
  local other = scene:wire{ cable = "GXL 1.5", from = { 0.2, 0, 0 }, to = { 0.4, 0, 0 } }
  local join = scene:join{ ends = { { wire, s = 0.2 }, { other, s = 0 } } }
  local hand = scene:gripper{ name = "hand", at = { 0.1, 0, 0 } }
  local process = scene:process(function(p) p:wait(0.01) end)
  local clip = scene:clip{ at = { 0, 1, 0.1 }, width = 0.01, insertion = 1, retention = 2 }
  local channel = scene:channel{ points = { { 0, 2, 0 }, { 1, 2, 0 } }, width = 0.02, depth = 0.02 }
  local tie = scene:tie(wire, { s = 0.1 })
  local run = scene:run{ dt = 0.01 }
  local evaluation
  local study = sw.study{ name = "study", parameters = { x = { 0, 1 } }, workers = 0, evaluate = function(p)
    evaluation = p
    return { y = p.x }
  end }
  study:sweep{ count = 1 }
  local calibration = sw.calibration{ mass_per_length = 0.02, outer_diameter = 0.004, EI = 1e-3,
    twist = { length = 1, angle = 9, sigma = 0.1 } }
  local fit = study:fit{ data = { y = { 0.5, sigma = 0.1 } } }
  local check = run:check{}
  return { check = check, comparison = sw.compare(check, check),
    calibration = calibration, fit = fit, study = study, evaluation = evaluation,
    scene = scene, wire = wire, hand = hand, gripper = hand, process = process, clip = clip,
    channel = channel, tie = tie, run = run, sw = sw, observer = scene:observe{ call = print },
    view = scene:view{ open = false }, cable = sw.cable "GXL 1.5",
    force = scene:force{ kind = "damping", on = wire }, clamp = scene:clamp(wire, { s = 0 }),
    join = join, snapshot = scene:snapshot(),
    particles = scene:particles{ name = "ball", positions = { { 0, 0, 2 } }, masses = 0.01, radius = 0.01 },
    trajectory = sw.trajectory{ points = { { 0, 0, 0 }, { 1, 0, 0 } }, duration = 1 },
    shape = sw.shape{ shape = "sphere", radius = 1 },
    obstacle = scene:obstacle{ shape = "plane", at = { 0, 0, -1 } } }
end

-- Methods of the library, not of scripts: runs, grippers and pictures use them.
local inner = { leave = true, report = true, solids = true, ["scene.advance"] = true, ["scene.tool"] = true }
-- The fields of a run are in help "results".
local results = "run"

-- Returns the value of a call's or field's name, and the object that has it.
local function value_of(made, class, name)
  local owner, value = nil, made[class]
  for word in name:match("[:.](.*)$"):gmatch "[^.]+" do owner, value = value, value[word] end
  return value, owner
end

describe("rows of calls", function()
  it("cover every method and field, and no other", function()
    local made, count = objects(), 0
    for class, list in pairs(rows.classes) do
      local known = {}
      for _, call in ipairs(list) do
        local name = call.name:match "[:.](.*)$"
        known[name], count = true, count + 1
        local fine, why = pcall(value_of, made, class, call.name)
        assert.is_true(fine, ("%s: %s"):format(call.name, why))
      end
      local meta = debug.getmetatable(made[class])
      for _, name in ipairs(meta.__names and meta.__names(made[class]) or {}) do
        local plain = class == results and type(made[class][name]) ~= "function"
        assert.is_true(known[name] or inner[name] or inner[class .. "." .. name] or plain or false,
          class .. " has no row " .. name)
      end
    end
    for class in pairs(core.class) do
      assert.is_truthy(rows.classes[class] or class == "tool", class .. " has no rows") -- of grippers
    end
    assert.is_true(count > 200, count)
  end)

  it("tell how many arguments a call takes: one more is refused with its number", function()
    local made, count = objects(), 0
    for class, list in pairs(rows.classes) do
      for _, call in ipairs(list) do
        local most = call.arguments and 0
        if most and call.arguments ~= "" then
          most = 1 + select(2, call.arguments:gsub("function%b()", "f"):gsub("%b{}", "t"):gsub(",", ""))
        end
        local value = value_of(made, class, call.name)
        local first = call.name:find ":" and 1 or 0 -- a method gets its object first
        if most and call.name ~= "scene:tie" and (first == 1 or type(value) == "function") then
          local given = { [first + most + 1] = "too much" }
          if first == 1 then given[1] = made[class] end
          local fine, why = pcall(value, table.unpack(given, 1, first + most + 1))
          assert.is_false(fine, call.name .. " took one more")
          assert.is_truthy(why:find("'too much'", 1, true) or class == "channel", why)
          assert.is_truthy(why:find(call.name, 1, true), why)
          assert.is_truthy(why:find(("argument %d"):format(most + 1), 1, true) or class == "channel", why)
          count = count + 1
        end
      end
    end
    assert.is_true(count > 200, count)
  end)

  it("have a unit, and a text of one line", function()
    for name, call in pairs(rows.all) do
      assert.is_true(#call.doc > 4 and not call.doc:find "[.\n]$", name)
      for _, row in ipairs(call.rows) do
        assert.is_true(type(row.unit) == "string" and #row.unit > 0, name .. ": " .. row.name)
        assert.is_true(type(row.doc) == "string" and #row.doc > 2, name .. ": " .. row.name)
        assert.is_true(row.min == nil or row.type ~= "integer" or row.max ~= nil, name .. ": " .. row.name)
      end
    end
  end)

  -- Values that no row of the type accepts.
  local wrong = { number = { "1", 0 / 0, {} }, integer = { 1.5, "1" }, boolean = { 1, "yes" },
    text = { 1, {} }, name = { 1, {}, "a\nb" },
    choice = { "no such word", 1 }, vector = { 1, { 1, 2 }, { 0, 0, 0 / 0 } },
    rotation = { 1, { 0, 0, 0, 0 } }, ["function"] = { 1 }, list = { 1, "x" }, reaction = { "halt", 1 },
    numbers = { "x", { "x" } } }

  it("refuse wrong values by name, and unknown names with the nearest one", function()
    local count = 0
    for name, call in pairs(rows.all) do
      for _, row in ipairs(call.rows) do
        local values = table.move(wrong[row.type] or {}, 1, 3, 1, {})
        if row.min and row.type == "number" then values[#values + 1] = row.min - 1 end
        if row.min and row.above then values[#values + 1] = row.min end
        if row.max then values[#values + 1] = row.max + 1 end
        for _, value in ipairs(values) do
          local fine, why = pcall(call.read, call, { [row.name] = value }, name)
          assert.is_false(fine, ("%s: %s = %s was taken"):format(name, row.name, tostring(value)))
          assert.is_truthy(why:find(name .. ": " .. row.name, 1, true) or why:find "is required", why)
          count = count + 1
        end
      end
      local first = call.rows[1] and call.rows[1].name
      if first and #first > 3 and not call.also then
        local _, why = pcall(call.read, call, { [first .. "x"] = 1 })
        assert.is_truthy(why:find("there is no parameter '" .. first .. "x'; did you mean", 1, true), why)
      end
    end
    assert.is_true(count > 150, count)
  end)

  it("fill in defaults and leave the caller's table alone", function()
    local given = { force = 3 }
    local t = rows.all["gripper:press"]:read(given)
    assert.same({ force = 3, speed = 0.02, distance = 0.1, direction = { 0, 0, -1 } }, t)
    assert.same({ force = 3 }, given)
    t.direction[1] = 5
    assert.equal(0, rows.all["gripper:press"]:read(given).direction[1])
  end)
end)

describe("help", function()
  it("shows every call by its name, and every object with all its calls", function()
    for name, call in pairs(rows.all) do
      local text = topics.text(name)
      assert.is_truthy(text and text:find(call.doc, 1, true), name)
      for _, row in ipairs(call.rows) do
        assert.is_truthy(text:find(row.doc, 1, true), name .. ": " .. row.name)
      end
    end
    local text = topics.text "gripper"
    for _, call in ipairs(rows.classes.gripper) do
      assert.is_truthy(text:find(call.name:match "[:.].*$", 1, true), call.name)
    end
  end)

  it("finds a method by its bare name", function()
    assert.is_truthy(topics.text "press":find("push of the wire at which it stops", 1, true))
    assert.is_truthy(topics.text "pictures":find("camera.elevation", 1, true))
  end)
end)

describe("completion within braces", function()
  local made = objects()

  local function offers(expected, line)
    local before, word = line:match "^(.-)([%w_]*)$"
    assert.equal(expected, table.concat(repl.complete(before, word, made), " "))
  end

  it("offers the parameters of methods made in Lua", function()
    offers("direction distance", "hand:press{ d")
    offers("approach", "hand:grasp(wire, { s = 0.1, ap")
    offers("elevation", "run:pictures{ camera = { el")
    offers("file fingers friction", "scene:gripper { name = 'x', pads = { f")
    offers("retention", "x = scene:clip{ at = { 0, 0, 1 }, re")
  end)

  it("offers the parameters of core methods", function()
    offers("density", "scene:wire{ de")
    offers("gust", "scene:force{ kind = 'wind', gu")
    offers("radius", "scene:obstacle{ shape = \"torus\", ra")
    offers("quasistatic", "scene:run{ q")
    offers("direction", "scene:clamp(wire, { di")
    offers("modes", "wire:frequencies{ mo")
  end)

  it("offers the choices of a parameter within quotes", function()
    local function quoted(expected, line)
      local before, word = line:match "^(.-)([^'\"]*)$"
      assert.equal(expected, table.concat(repl.complete(before, word, made), " "))
    end
    quoted("radial rod", "scene:wire{ model = 'r")
    quoted("path straight", 'scene:wire{ model = "rod", rest = "')
    quoted("torus", "scene:obstacle{ shape = 'to")
    quoted("wind", "scene:force{ kind = 'w")
    quoted("tr-bdf2", "scene:run{ integrator = 'tr")
    quoted("", "scene:wire{ name = 'r") -- any text: no choices
    quoted("", "print('r")
    assert.is_truthy(table.concat(repl.complete("scene:wire{ cable = '", "GXL", made), ","):find "GXL 1.5")
  end)

  it("offers names of the script where a value is wanted", function()
    offers("hand", "scene:force{ on = ha")
    offers("hand", "print{ ha")
    offers("hand", "hand:press{ force = ha")
  end)
end)
