-- SPDX-License-Identifier: GPL-3.0-or-later
-- What the forms of a live view do with the messages of pages, without a browser: a scene is put together
-- line by line, its script gives the same bits, and wrong or harmful messages change nothing.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local draft = require "softworld.view.draft"
local fill = require "softworld.view.fill"
local json = require "softworld.output.json"
local jsonread = require "softworld.output.jsonread"
local kinds = require "softworld.view.kinds"
local saving = require "spec.scene.saving"

local core = sw.core

local PLAIN = { number = true, integer = true, boolean = true, text = true, file = true, choice = true,
  vector = true, rotation = true, points = true, numbers = true, object = true, table = true }

local function add(d, class, kind, values, process)
  return d:change { what = "add", class = class, kind = kind, values = values, process = process }
end

local WIRE = { name = "cord", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { 0.5, 0, 0.1 } }

-- Messages of a page.
local function a_change(class, kind, values, more)
  local m = { what = "add", class = class, kind = kind, values = values }
  for key, value in pairs(more or {}) do m[key] = value end
  return m
end

local function hanging()
  local d = draft.new()
  add(d, "wire", "rod", WIRE)
  add(d, "hold", "clamp", { _on = "cord", s = 0 })
  add(d, "obstacle", "box", { name = "block", size = { 0.05, 0.2, 0.05 }, at = { 0.25, 0, 0.025 } })
  return d
end

-- A value that fits a field, as a page would send it.
local function example(field)
  if field.choices then return field.choices[1] end
  if field.default ~= nil then return field.default end
  if field.type == "vector" then return { 0.1, 0.2, 0.3 } end
  if field.type == "rotation" then return { axis = { 0, 0, 1 }, angle = 1 } end
  if field.type == "points" then return { { 0, 0, 0 }, { 1, 0, 0 } } end
  if field.type == "numbers" then return { 1, 2 } end
  if field.type == "object" then return "cord" end
  if field.type == "text" or field.type == "file" then return "a name" end
  if field.type == "boolean" then return true end
  if field.type == "table" then
    local inner = {}
    for _, f in ipairs(field.rows) do inner[f.name] = example(f) end
    return inner
  end
  return math.max(field.min or 1, math.min(field.max or 1, 1))
end

describe("kinds that forms can make", function()
  local all = kinds.all().kinds

  it("have fields of known types, with a description and a unit, and pass through JSON", function()
    for _, kind in ipairs(all) do
      assert.truthy(kind.doc, kind.kind)
      for _, field in ipairs(kind.fields) do
        local what = kind.kind .. "." .. field.name
        assert.is_true(PLAIN[field.type], what)
        assert.equal("string", type(field.doc), what)
        assert.equal("string", type(field.unit), what)
      end
    end
    assert.equal(#all, #jsonread.decode(json.encode(kinds.all())).kinds)
  end)

  -- The registries decide: a new entry of a registry appears in a form without further code.
  it("cover all shapes, holds, models and forces of scripts", function()
    local registry = core.registry()
    for _, shape in ipairs(registry.shapes) do assert.truthy(kinds.of("obstacle", shape.name), shape.name) end
    for _, hold in ipairs(registry.holds) do assert.truthy(kinds.of("hold", hold.name), hold.name) end
    for _, model in ipairs(registry.models) do assert.truthy(kinds.of("wire", model.name), model.name) end
    local made_by_methods = { clip = true, snap = true, tether = true }
    for _, force in ipairs(registry.forces) do
      assert.equal(not force.inner and not made_by_methods[force.name], kinds.of("force", force.name) ~= nil,
        force.name)
    end
  end)

  it("give a line of Lua that compiles, with any values", function()
    for _, kind in ipairs(all) do
      local values = {}
      for _, field in ipairs(kind.fields) do values[field.name] = example(field) end
      if kind.kind == "tie" then values.to = nil end -- there is to_wire instead
      if kind.kind == "wait_for_distance" then values.point = nil end -- there is to instead
      if kind.on then values._on = 'a "cord"\n' end
      if kind.self == "gripper" then values._by = "hand" end
      local it, read = fill.read(kind.class, kind.kind, values)
      local line = fill.line(it, read, function(name) return ("scene:find(%s)"):format(fill.source(name)) end)
      assert.truthy(load("local scene, p = ...\n" .. line), line)
    end
  end)

  it("give the values and sources of each cable", function()
    for _, cable in ipairs(kinds.all().cables) do
      for _, q in ipairs(cable.rows) do
        assert.equal(sw.cable(cable.name)[q.name].value, q.value)
        assert.is_true(#q.source > 0 and #q.flag > 0)
      end
    end
  end)
end)

describe("a scene put together by forms", function()
  it("joins and ties wires, makes and holds particles, and waits for sensor readings", function()
    local d = hanging()
    add(d, "wire", "rod", { name = "branch", cable = "GXL 1.5", from = { 0.25, 0, 0.1 },
      to = { 0.25, 0.2, 0.1 } })
    add(d, "fixing", "join", { one = "cord", s = 0.25, other = "branch", other_s = 0 })
    add(d, "fixing", "tie", { _on = "branch", s = 0.2, to_wire = "cord", to_s = 0.5, slack = 0.4 })
    add(d, "particles", "sheet", { name = "net", at = { 0, 1, 0.2 }, along = { 0.1, 0, 0 },
      across = { 0, 0.1, 0 }, columns = 3, rows = 2, masses = 1e-3, k = 50, shear = 10 })
    add(d, "hold", "hold", { _on = "net", particles = { 1, 3 } })
    add(d, "gripper", "gripper", { name = "hand", at = { 0.5, 0, 0.1 } })
    add(d, "step", "grasp", { _by = "hand", _on = "cord", s = 0.45 })
    add(d, "step", "wait_for_force", { on = "hand", force = 1e-4, timeout = 0.1 })
    add(d, "step", "wait_for_contact", { contact = "block", timeout = 0.05 })
    local scene = add(d, "step", "wait_for_distance",
      { from = "hand", point = { 0.45, 0, 0.1 }, distance = 0.5 })
    for _, line in ipairs {
      'scene:join { name = "join1", ends = { { cord, s = 0.25 }, { branch, s = 0 } } }',
      'scene:tie(branch, { name = "tie1", s = 0.2, to = { cord, s = 0.5 }, slack = 0.4 })',
      'scene:hold(net, { name = "hold1", particles = { 1, 3 } })',
      "p:wait_until({ on = hand, force = 0.0001 }, { timeout = 0.1 })",
      "p:wait_until({ contact = block }, { timeout = 0.05 })",
      "p:wait_until({ between = { hand, { 0.45, 0, 0.1 } }, distance = 0.5 })" } do
      assert.truthy(d:script():find(line, 1, true), line .. "\n" .. d:script())
    end
    assert.equal(6, scene:find("net").count)
    -- 7 links along the sides, 4 across the cells; links along the sides are as long as the cells
    local _, strains = scene:find("net"):links()
    assert.equal(11, #strains)
    local run = scene:run { dt = 0.002 }
    assert.is_true(run.ok, run.reason)
    assert.near(0, select(3, table.unpack((scene:find("net"):particle(1)))) - 0.2, 1e-9)
    for _, case in ipairs {
      { a_change("fixing", "join", { one = "cord", s = 0.25 }), "join: other is required: the wire" },
      { a_change("fixing", "join", { one = "cord", s = 0.1, other = "branch", other_s = 0 }),
        "ends must meet" },
      { a_change("fixing", "tie", { _on = "cord", s = 0, to = { 0, 0, 0 }, to_wire = "branch", to_s = 0 }),
        "give to or to_wire, not both" },
      { a_change("particles", "sheet", { at = { 0, 0, 0 }, along = { 1, 0, 0 }, across = { 0, 1, 0 },
        masses = 1, k = 1, columns = 100, rows = 100 }), "100 x 100 particles are not allowed" },
      { a_change("particles", "particles", { positions = { { 0, 0, 0 }, { 1, 0, 0 } }, masses = 1,
        pairs = { 1, 5 }, k = 1 }), "5" },
      { a_change("step", "wait_for_force", { force = 1 }), "on is required" },
      { a_change("step", "wait_for_distance", { from = "hand", distance = 1 }),
        "to or point is required" } } do
      local before = d:script()
      local fine, message = pcall(d.change, d, case[1])
      assert.is_false(fine, case[2])
      assert.truthy(tostring(message):find(case[2], 1, true), message)
      assert.equal(before, d:script())
    end
  end)

  it("equals the scene of its script, bit for bit, after any number of changes", function()
    local d = hanging()
    add(d, "gripper", "gripper", { name = "hand", at = { 0.5, 0, 0.2 } })
    add(d, "force", "drag", { on = "cord", linear = 0.01 })
    add(d, "step", "grasp", { _by = "hand", _on = "cord", s = 0.45 })
    add(d, "step", "move", { _by = "hand", by = { -0.1, 0, 0.05 }, speed = 0.4 })
    add(d, "step", "wait", { seconds = 0.05 })
    add(d, "step", "release", { _by = "hand" })
    local scene = d:change { what = "put", id = 3, values = { at = { 0.2, 0, 0.02 } } }
    local again = assert(load(d:script() .. "return scene"))()
    for _, one in ipairs { scene, again } do assert(one:run { dt = 0.004 }.ok) end
    assert.is_nil(saving.difference(saving.all(scene), saving.all(again)))
    assert.truthy(d:script():find("hand:grasp(cord, { s = 0.45 })", 1, true), d:script())
  end)

  it("stays unchanged when a change is refused, with the core's message", function()
    local d = hanging()
    local before, shown = d:script(), json.encode(d:shown())
    for _, case in ipairs {
      { a_change("hold", "clamp", { _on = "cord", s = 3 }),
        "clamp 'clamp2': s = 3 m is not on wire 'cord'; it must be in %[0, 0%.5%] m; is this in mm%?" },
      { a_change("obstacle", "sphere", { radius = -1 }), "radius = %-1 m is not" },
      { a_change("obstacle", "sphere", {}), "radius is required" },
      { a_change("wire", "rod", WIRE), "already something named 'cord'" },
      { a_change("wire", "rod", { from = { 0, 0, 0 }, to = { 1, 0, 0 } }, { what = "change", id = 1 }),
        "radius is required" },
      { { what = "change", id = 1, class = "obstacle", kind = "plane", values = {} }, "cannot become" },
      { { what = "add", class = "wire", kind = "rod", values = { cable = "GXL 1,5", from = { 0, 0, 0 } } },
        "cable = 'GXL 1,5' is not one of.*did you mean 'GXL 1.5'" },
      { a_change("step", "wait", { seconds = -1 }), "seconds = %-1 s is not" },
      { a_change("step", "wait", {}), "seconds is required" },
      { a_change("step", "wait", { seconds = 1 }, { process = 99 }), "from 1 to 6" },
      { { what = "remove", id = 99 }, "this item no longer exists" },
      { { what = "scene", values = { gravity = { 0, 0, 0 / 0 } } }, "gravity%[3%] must be a finite number" },
    } do
      local fine, message = pcall(d.change, d, case[1])
      assert.is_false(fine)
      assert.truthy(message:find(case[2]), message)
      assert.is_nil(message:find("%.lua:%d"), message)
    end
    assert.equal(before, d:script())
    assert.equal(shown, json.encode(d:shown()))
  end)

  it("removes with an object everything that refers to it; undo brings all back, redo removes it "
    .. "again", function()
    local d = hanging()
    local full = d:script()
    local _, words = d:change { what = "remove", id = 1 }
    assert.equal("with cord these were removed too: clamp1", words)
    local less = d:script()
    assert.is_nil(less:find "clamp")
    d:change { what = "undo" }
    assert.equal(full, d:script())
    d:change { what = "redo" }
    assert.equal(less, d:script())
    for _ = 1, 4 do d:change { what = "undo" } end
    assert.equal(draft.new():script(), d:script())
    assert.error_matches(function() d:change { what = "undo" } end, "nothing to undo")
  end)

  it("renames an object everywhere", function()
    local d = hanging()
    d:change { what = "change", id = 1, class = "wire", kind = "rod", values = { name = "my \"cord\"\\",
      cable = "GXL 1", from = { 0, 0, 0.1 }, to = { 0.5, 0, 0.1 } } }
    local line = [[scene:clamp(scene:find("my \"cord\"\\"), { name = "clamp1", s = 0 })]]
    assert.truthy(d:script():find(line, 1, true), d:script())
    assert.equal('my "cord"\\', d:build():find('my "cord"\\').name)
  end)

  it("has steps in the chosen order, in several parallel processes", function()
    local d = hanging()
    add(d, "step", "wait", { seconds = 1 })
    add(d, "step", "wait", { seconds = 2 })
    add(d, "step", "wait", { seconds = 3 }, 2)
    d:change { what = "shift", id = 5, by = -1 }
    local second = "p:wait(2)\n  p:wait(1)\nend)\n\nscene:process(function(p)\n  p:wait(3)"
    assert.truthy(d:script():find(second, 1, true), d:script())
    assert.error_matches(function() d:change { what = "shift", id = 6, by = 1 } end, "the last one")
  end)

  it("gives its remarks again with each change", function()
    local d = draft.new()
    add(d, "wire", "rod", { radius = 2.5, E = 1e6, density = 1000, from = { 0, 0, 0 }, to = { 100, 0, 0 } })
    local first = d:shown().remarks
    assert.equal(1, #first)
    assert.truthy(first[1]:find("radius = 2.5 m is above 0.1 m", 1, true), first[1])
    d:change { what = "scene", values = { gravity = { 0, 0, -1 } } }
    assert.same(first, d:shown().remarks)
  end)
end)

-- Names and texts that would do harm if they were run as Lua.
local EVIL = { [["]], [[" .. os.exit(3) .. "]], [[") os.exit(3) --]], "a\nos.exit(3)\n", "]] os.exit(3) --[[",
  "\\", "\\\"", "\0", "${x}", "%s%d", ("x"):rep(190), "end end", "os", "_ENV" }

describe("hostile messages", function()
  -- Any message gives an error with a text, or a change after which the script is still valid Lua.
  local function told(d, m)
    local fine, message = pcall(d.change, d, m)
    if not fine then assert.equal("string", type(message)) end
    assert.truthy(load(d:script()))
    return fine, message
  end

  it("never become Lua when they are names with quotes", function()
    local exit, called = os.exit, false
    os.exit = function() called = true end -- luacheck: ignore
    for _, name in ipairs(EVIL) do
      local d = draft.new()
      told(d, { what = "add", class = "wire", kind = "rod", values = { name = name, cable = "GXL 1.5",
        from = { 0, 0, 0.1 }, to = { 0.5, 0, 0.1 } } })
      told(d, a_change("hold", "pin", { _on = name, s = 0.1, name = name .. "2" }))
      told(d, a_change("gripper", "gripper", { name = name .. "3" }))
      told(d, a_change("step", "grasp", { _by = name .. "3", _on = name, s = 0 }))
      told(d, a_change("obstacle", "mesh", { file = name }))
      told(d, { what = name, class = name, kind = name, values = { [name] = name } })
      told(d, a_change("wire", "rod", { cable = name, [name] = 1 }))
      local chunk = load(d:script() .. "return scene", "=x", "t", { require = require, math = math, os = os })
      assert.truthy(chunk)
      assert.equal("scene", core.type(chunk()))
    end
    os.exit = exit -- luacheck: ignore
    assert.is_false(called)
  end)

  it("of wrong types, NaN, huge lists and unknown words are refused", function()
    local d = hanging()
    local before = d:script()
    local huge, deep = {}, {}
    for k = 1, 60000 do huge[k] = k end
    local points = {}
    for k = 1, 3000 do points[k] = { k, 0, 0 } end
    deep[1] = deep
    local values = { 0 / 0, math.huge, -math.huge, "1", true, {}, { 1, 2 }, { 1, 2, 0 / 0 }, { 1, 2, "3" },
      { x = 1, y = 2, z = 3 }, huge, points, deep, setmetatable({}, { __index = function() return 1 end }),
      { 1, 2, 3, n = 4 }, print }
    for _, value in ipairs(values) do
      for _, name in ipairs { "from", "radius", "segments", "path", "name", "cable", "rolls", "nonsense",
        "model" } do
        local given = { from = { 0, 0, 0 }, to = { 1, 0, 0 }, cable = "GXL 1" }
        given[name] = value
        if not (name == "rolls" and value == true or name == "name" and value == "1") then -- valid
          local fine, message = pcall(d.change, d, a_change("wire", "rod", given))
          assert.is_false(fine, name .. " = " .. tostring(value))
          assert.equal("string", type(message))
          assert.is_true(#message < 2000, "a message that can be read")
        end
      end
      for _, m in ipairs { { what = value }, { what = "add", class = value, kind = "rod", values = {} },
        { what = "add", class = "wire", kind = value, values = {} },
        { what = "add", class = "wire", kind = "rod", values = value },
        { what = "change", id = value, class = "wire", kind = "rod", values = {} },
        { what = "remove", id = value }, { what = "put", id = 1, values = { from = value } },
        { what = "shift", id = 1, by = value } } do
        assert.is_false((pcall(d.change, d, m)))
      end
    end
    assert.error_matches(function()
      add(d, "wire", "rod", { cable = "GXL 1", from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = 10000000 })
    end, "too large for a form")
    for _, file in ipairs { "/etc/passwd", "../x.stl", ".hidden", "a/b.stl", "", "a\nb" } do
      assert.error_matches(function() add(d, "obstacle", "mesh", { file = file }) end, "without a folder")
    end
    assert.equal(before, d:script())
  end)

  it("cannot fill the memory with objects", function()
    local d = draft.new()
    for _ = 1, 400 do add(d, "step", "wait", { seconds = 1 }) end
    local function more() add(d, "step", "wait", { seconds = 1 }) end
    assert.error_matches(more, "there are 400 things already")
  end)
end)
