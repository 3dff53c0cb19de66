-- SPDX-License-Identifier: GPL-3.0-or-later
-- The manual: its pages are listed and shown the same way everywhere, and everything that they and the
-- README name exists.
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/manual"
local program = dofile(here .. "/../host/program.lua")
local lfs = require "lfs"
local sw = require "softworld"
local manual = require "softworld.manual"
local text_of = require "softworld.manual.text"
local topics = require "softworld.prompt.topics"

local FOLDER = "lua/softworld/manual/"
local read = program.read

local pages = {}
for _, group in ipairs(manual.groups) do
  for _, name in ipairs(group[2]) do pages[#pages + 1] = name end
end

-- Calls f with the name and the text of the README and of each page.
local function each_text(f)
  f("README.md", read "README.md")
  for _, name in ipairs(pages) do f(name .. ".md", manual.read(name)) end
end

local function shown(topic)
  local lines, print_before = {}, print
  _G.print = function(...) lines[#lines + 1] = table.concat({ ... }, "\t") end
  local fine, reason = pcall(sw.help, topic)
  _G.print = print_before
  assert.is_true(fine, tostring(reason))
  return table.concat(lines, "\n")
end

describe("manual", function()
  it("lists every page of its folder once, and no others", function()
    local listed = {}
    for _, name in ipairs(pages) do
      assert.is_nil(listed[name], name .. " is listed twice")
      listed[name] = true
      assert.is_truthy(manual.title(name), name .. " has no title")
    end
    for file in lfs.dir(FOLDER) do
      local name = file:match "^(.+)%.md$"
      assert.is_true(not name or listed[name] or false, file .. " is not listed")
    end
    for word, name in pairs(manual.also) do
      assert.is_true(manual.has(name), word .. " leads to no page")
      assert.is_false(manual.has(word), word .. " is a page itself")
    end
  end)

  it("shows each page, in lines that fit a terminal", function()
    for _, name in ipairs(pages) do
      local text = text_of(manual.page(name))
      assert.is_truthy(shown(name):find(text, 1, true), name)
      for line in text:gmatch "[^\n]+" do assert.is_true(utf8.len(line) <= 110, name .. ": " .. line) end
    end
  end)

  it("says where an example goes on that makes no scene", function()
    for name, goes_on in pairs{ handling = true, peaks = true, start = false, grip = false, files = false } do
      local at = shown(name):find('The example goes on from the first block of help "start".', 1, true)
      assert.equal(goes_on, at ~= nil, name)
    end
    assert.matches("first block of %[start%]%(start.md%)", manual.page "handling")
  end)

  it("shows the same text by help and by softworld doc", function()
    for _, topic in ipairs{ "grip", "feed", "wire", "box", "forces", "winding" } do
      local out, err, code = program.run{ "doc", topic }
      assert.are.equal(0, code, err)
      assert.are.equal(shown(topic) .. "\n", out)
    end
    local out = program.run{ "doc" }
    assert.are.equal(shown() .. "\n", out)
    for _, name in ipairs(pages) do
      assert.is_truthy(out:find("\n  " .. name .. " +" .. manual.title(name):sub(1, 5)), name)
    end
  end)

  it("suggests the nearest topic, and gives exit statuses", function()
    local out, err, code = program.run{ "doc", "gripp" }
    assert.are.same({ "", "softworld: no help on 'gripp'; did you mean 'grip'?\n", 1 }, { out, err, code })
    for typo, name in pairs{ ["scene:wir"] = "scene:wire", ["gripper:grsp"] = "gripper:grasp",
      handovr = "handover" } do
      local _, says = program.run{ "doc", typo }
      assert.are.equal(("softworld: no help on '%s'; did you mean '%s'?\n"):format(typo, name), says)
    end
    out, err, code = program.run{ "doc", "qqqqqqqqqq" }
    assert.are.same({ "", "softworld: no help on 'qqqqqqqqqq'; softworld doc lists the topics\n", 1 },
      { out, err, code })
    out, err, code = program.run{ "doc", "grip", "clip" }
    assert.are.same({ "", 2 }, { out, code })
    assert.matches("doc takes one topic", err)
    out, err, code = program.run{ "doc", "../../init" }
    assert.are.same({ "", 1 }, { out, code })
    assert.matches("no help on", err)
  end)

  it("leaves a script named doc to ./doc", function()
    local folder = program.folder()
    program.write(folder .. "/doc", "print('mine', ...)")
    local path = program.path:find "^/" and program.path or lfs.currentdir() .. "/" .. program.path
    local out = program.shell(("cd %s && %s ./doc a"):format(folder, program.quote(path)))
    program.clean()
    assert.are.equal("mine\ta\n", out)
  end)
end)

describe("names in the manual and the README:", function()
  it("files exist", function()
    local count = 0
    each_text(function(name, text)
      for path in text:gmatch "`([%l]+/[%w_%-/%.]+)" do
        local top = path:match "^(%l+)/"
        if ("csrc lua spec examples scripts"):find(top, 1, true) and not path:find "magnet"
          and path ~= "examples/" then
          count = count + 1
          assert.is_truthy(lfs.attributes(path, "mode"), name .. ": " .. path)
        end
      end
    end)
    assert.is_true(count > 80, count) -- day.md alone has fifty
  end)

  it("link targets and pictures exist", function()
    each_text(function(name, text)
      local base = name == "README.md" and "" or FOLDER
      for target in text:gmatch "%]%(([^)]*)%)" do
        if not target:find "^https?:" then
          local place = base .. target:gsub("#.*", "")
          assert.is_truthy(lfs.attributes(place, "mode"), name .. ": " .. target)
        end
      end
    end)
  end)

  it("help topics exist, also those named in sources", function()
    local function check(name, text)
      for _, pattern in ipairs{ 'help "([%w_%-]+)"', "help '([%w_%-]+)'", 'help \\"([%w_%-]+)\\"' } do
        for topic in text:gmatch(pattern) do
          if topic ~= "name" and topic ~= "TOPIC" then
            assert.is_truthy(topics.text(topic), name .. ": help " .. topic)
          end
        end
      end
      for topic in text:gmatch "softworld doc ([%l_]+)" do
        if topic ~= "name" and topic ~= "shows" then
          assert.is_truthy(topics.text(topic), name .. ": " .. topic)
        end
      end
    end
    each_text(check)
    local pipe = io.popen "find lua csrc -name '*.lua' -o -name '*.c'"
    for path in pipe:lines() do check(path, read(path)) end
    pipe:close()
  end)

  it("make targets and benchmark cases exist", function()
    local makefile, bench = read "Makefile", read "scripts/bench.lua" .. read "scripts/bench/choice.lua"
    each_text(function(name, text)
      for target in text:gmatch "`make ([%l]+)" do
        assert.is_truthy(makefile:find("\n" .. target .. ":", 1, true), name .. ": make " .. target)
      end
      for list in text:gmatch 'ARGS="case=([%w_,]+)"' do
        for case in list:gmatch "[^,]+" do
          assert.is_truthy(bench:find("%f[%w_]" .. case .. "%f[^%w_]"), name .. ": case=" .. case)
        end
      end
    end)
  end)
end)

-- One object of each kind, under the names that the pages use.
local function objects()
  local scene = sw.scene{ name = "named" }
  local wire = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 8, from = { 0, 0, 0.1 },
    to = { 0.5, 0, 0.1 } }
  local tube = scene:wire{ model = "tube", core = false, particles = 8, segments = 12, E = 5e6,
    density = 1200, radius = 0.01, from = { 0, 0.3, 0.3 }, to = { 0.12, 0.3, 0.3 } }
  local other = scene:wire{ E = 50e6, density = 1500, radius = 0.0025, segments = 8, from = { 0, 0, 0.2 },
    to = { 0.5, 0, 0.2 } }
  local hand, clamp = scene:gripper{ name = "hand", at = { 0, 0, 0.3 } }, scene:clamp(wire, { s = 0.5 })
  local feed = scene:feed(other, { s = 0 })
  local floor = scene:obstacle{ shape = "plane" }
  local tie = scene:tie(wire, { s = 0.2 })
  local clip = scene:clip{ at = { 0, 1, 0.1 }, width = 0.01, insertion = 1, retention = 2 }
  local channel = scene:channel{ points = { { 0, 2, 0 }, { 1, 2, 0 } }, width = 0.02, depth = 0.02 }
  local net = scene:particles{ positions = { { 0, 3, 1 }, { 0.1, 3, 1 } }, masses = 0.01,
    links = { { 1, 2, k = 100 } } }
  local process
  scene:process(function(p) process = p end)
  local run = scene:run{ dt = 0.01 }
  return { scene = scene, wire = wire, hand = hand, gripper = hand, clamp = clamp, feed = feed, feeder = feed,
    obstacle = floor, floor = floor, tie = tie, clip = clip, channel = channel, net = net, p = process,
    run = run, section = tube:section(0.06), sw = sw }
end

describe("names of methods and parameters", function()
  it("of objects in the manual and the README exist", function()
    local known, count = objects(), 0
    each_text(function(name, text)
      for object, method in text:gmatch "%f[%w_.\"](%l+):(%l[%w_]*)" do
        if known[object] then
          count = count + 1
          local fine, value = pcall(function() return known[object][method] end)
          assert.is_true(fine and value ~= nil, ("%s: %s:%s"):format(name, object, method))
        end
      end
    end)
    assert.is_true(count > 150, count)
  end)

  -- A parameter is a word before "=" within braces of code. Most of them have rows. Parameters of objects
  -- made in Lua only have to occur in the library's sources; their own specs check them.
  it("before an equals sign occur in rows or in the library", function()
    local words = {}
    local function add(text) for word in text:gmatch "[%a_][%w_]*" do words[word] = true end end
    local pipe = io.popen "find lua/softworld csrc/bind -name '*.lua' -o -name '*.c' | grep -v /bench"
    for path in pipe:lines() do add(read(path)) end
    pipe:close()
    for _, rows in pairs(sw.core.registry().params) do
      for _, row in ipairs(rows) do words[row.name] = true end
    end
    for _, family in ipairs{ "models", "holds", "shapes", "forces" } do
      for _, entry in ipairs(sw.core.registry()[family]) do
        for _, row in ipairs(entry.params or {}) do words[row.name] = true end
      end
    end
    for _, row in ipairs(sw.core.trajectory_parameters()) do words[row.name] = true end
    for word in pairs{ inner = true, core_layers = true } do words[word] = true end
    local count = 0
    each_text(function(name, text)
      for code in text:gmatch "`[^`\n]+`" do
        for word in (code:find "^`const" and "" or code):gmatch "([%a_][%w_]*) =%f[ `]" do
          count = count + 1
          assert.is_true(words[word] or false, name .. ": " .. word .. " = in " .. code)
        end
      end
    end)
    assert.is_true(count > 60, count)
  end)
end)

describe("README", function()
  it("has less than 9000 bytes", function() assert.is_true(#read "README.md" < 9000) end)
end)

describe("the glossary", function()
  it("has thirty terms or more, in order", function()
    local last, count = "", 0
    for word in manual.read("glossary"):gmatch "\n| ([^|]-) |" do
      if not word:find "^%-" and word ~= "word" then
        assert.is_true(word:lower() > last, word .. " after " .. last)
        last, count = word:lower(), count + 1
      end
    end
    assert.is_true(count >= 30, count)
  end)
end)

describe("one day in the life of", function()
  it("has four stories, each under one screen", function()
    local stories, lines = 0, 0
    for line in (manual.read "day" .. "\n## end\n"):gmatch "([^\n]*)\n" do
      if line:find "^## " then
        assert.is_true(lines <= 24, lines .. " lines before " .. line)
        stories, lines = stories + 1, 0
      end
      lines = lines + 1
    end
    assert.are.equal(5, stories) -- the end mark counts too
  end)
end)

describe("errors of an engineer's day", function()
  -- Each message that the page quotes, raised by the mistake that the page names.
  it("have the wording of the page", function()
    local page = manual.read "mistakes"
    local function quoted(text)
      assert.is_truthy(page:find("`" .. text, 1, true) or page:find(text .. "`", 1, true), text)
    end
    local function told(text, f)
      quoted(text)
      local scene = sw.scene{}
      local wire = scene:wire{ name = "wire", E = 50e6, density = 1500, radius = 0.0025, segments = 8,
        from = { 0, 0, 0.1 }, to = { 1, 0, 0.1 } }
      local fine, why = pcall(f, scene, wire)
      assert.is_false(fine)
      assert.is_truthy(why:find(text, 1, true), why)
    end
    told("obstacle box: there is no parameter 'sise'; did you mean 'size'?", function(scene)
      scene:obstacle{ shape = "box", sise = { 1, 1, 1 } }
    end)
    told("there is no cable 'GXL 1.6'; did you mean 'GXL 1.5'?", function(scene)
      scene:wire{ cable = "GXL 1.6", from = { 0, 0, 0 }, to = { 1, 0, 0 } }
    end)
    told("s = 3 m is not on the wire; it must be in [0, 1] m", function(_, wire) wire:position(3) end)
    told("gripper 'hand' holds nothing; grasp a wire before you move", function(scene)
      scene:gripper{ name = "hand" }:move{ by = { 0, 0, 1 }, speed = 1 }
    end)
    local remark = "radius = 2.5 m is above 0.1 m; did you mean sw.units.mm(2.5)?"
    quoted(remark)
    local _, err = program.script("require 'softworld'.scene{}:wire{ E = 50e6, density = 1500, radius = 2.5, "
      .. "from = { 0, 0, 0 }, to = { 50, 0, 0 } }")
    program.clean()
    assert.is_truthy(err:find(remark, 1, true), err)
  end)

  it("give the exit statuses of the page", function()
    local failing = [[ -- explicit steps somewhat too long: the wire is torn apart
      local s = require "softworld".scene{}
      local w = s:wire{ E = 5e6, density = 1500, radius = 0.0025, segments = 20, from = { 0, 0, 0.1 },
        to = { 0.5, 0, 0.1 } }
      s:clamp(w, { s = 0 })
      s:run{ duration = 1, dt = 1.2 * s:stable_dt(), integrator = "velocity-verlet", unstable = true } ]]
    for text, status in pairs{ [""] = 0, ["error 'no'"] = 1, [failing] = 1 } do
      local _, err, code = program.script(text)
      assert.are.equal(status, code, text .. err)
    end
    assert.are.equal(2, select(3, program.run{ "--nonsense" }))
    program.clean()
  end)
end)
