-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs that go on from a file with other settings: another window of peaks is refused, another step or method
-- is told by an event.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local fails, script, file, same = saving.fails, saving.script, saving.temporary, saving.same

after_each(saving.clean)

-- Returns the name of a file that was written after a step of a run with these arguments.
local function file_of(args, step)
  local path = file()
  args.save = path
  saving.write(path, saving.files_of(script(), args)[step])
  return path
end

local function resumed(run)
  local texts = {}
  for _, e in ipairs(run.events) do
    if e.kind == "resumed" then texts[#texts + 1] = e.text end
  end
  return texts
end

local function has(text, words)
  for _, word in ipairs(words) do
    assert(text:find(word, 1, true), ("'%s' is not in: %s"):format(word, text))
  end
end

describe("a run that goes on from a file", function()
  it("is refused with another window of peaks; nothing is changed", function()
    local path, c = file_of({ dt = 0.005, window = 0.02 }, 2), script()
    local before = saving.all(c.scene)
    fails({ "window = 0.01 s (the usual one)", path, "window = 0.02 s", "give window = 0.02" }, c.scene.run,
      c.scene, { dt = 0.005, resume = path })
    fails({ "window = 0 s, but", "give window = 0.02" }, c.scene.run, c.scene,
      { dt = 0.005, window = 0, resume = path })
    same(before, saving.all(c.scene))
    c.scene:resume(path)
    local read = saving.all(c.scene)
    fails({ "window = 0.03 s, but", "give window = 0.02" }, c.scene.run, c.scene,
      { dt = 0.005, window = 0.03 })
    same(read, saving.all(c.scene))
    assert.is_true(c.scene:run({ dt = 0.005, window = 0.02 }).ok)
  end)

  it("is refused with another record of wear; nothing is changed", function()
    for _, wear in ipairs{ true, false } do
      local path, c = file_of({ dt = 0.005, wear = wear }, 2), script()
      local before = saving.all(c.scene)
      local words = ("wear = %s, and a record of wear is of all steps of a run, or of none; give wear = %s,")
        :format(wear, wear)
      fails({ ("scene:run: wear = %s, but"):format(not wear), path, words }, c.scene.run, c.scene,
        { dt = 0.005, wear = not wear, resume = path })
      same(before, saving.all(c.scene))
      c.scene:resume(path)
      fails({ words }, c.scene.run, c.scene, { dt = 0.005, wear = not wear })
      assert.is_true(c.scene:run({ dt = 0.005, wear = wear }).ok)
    end
    local path, c = file_of({ dt = 0.005, wear = true }, 2), script()
    fails({ "wear = false (the usual one), but" }, c.scene.run, c.scene, { dt = 0.005, resume = path })
  end)

  it("makes no step if the file's run has already made the allowed number", function()
    local path, c = file_of({ dt = 0.005 }, 2), script()
    local run = c.scene:run{ dt = 0.005, resume = path, max_steps = 1 }
    has(run.reason, { "the allowed number of steps was used: max_steps = 1, and ", " were made before" })
    assert.is_true(run.ok)
    local steps = run.steps
    assert.is_true(steps > 1)
    local more = script().scene:run{ dt = 0.005, resume = path, max_steps = steps + 3 }
    assert.equal(steps + 3, more.steps)
    assert.equal("the allowed number of steps was used", more.reason)
  end)

  it("tells another step, tolerance or method by an event that names both values", function()
    local path, c = file_of({ dt = 0.005 }, 2), script()
    local texts = resumed(c.scene:run{ dt = 0.002, integrator = "sdirk2", resume = path })
    assert.are.equal(1, #texts)
    has(texts[1], { "from t = 0.3 s on", "dt = 0.002 s instead of 0.005 s",
      "integrator = 'sdirk2' instead of 'tr-bdf2'", path })
    texts = resumed(script().scene:run{ dt = 0.005, parts = false, resume = path })
    has(texts[1], { "has parts = false instead of true:" })
    texts = resumed(script().scene:run{ tolerance = 1e-4, resume = path })
    has(texts[1], { "dt = 0.01 s instead of 0.005 s, tolerance = 0.0001 m instead of none" })
  end)

  it("tells nothing with the same settings, given or usual", function()
    local path = file_of({}, 2)
    assert.are.equal(0, #resumed(script().scene:run{ resume = path }))
    assert.are.equal(0, #resumed(script().scene:run{ dt = 0.01, integrator = "tr-bdf2", window = 0.01,
      parts = true, quasistatic = false, resume = path }))
  end)

  it("keeps that event in files that it writes", function()
    local path = file_of({ dt = 0.005 }, 2)
    local written = saving.files_of(script(), { dt = 0.002, save = path, resume = path })
    saving.write(path, written[2])
    local texts = resumed(script().scene:run{ dt = 0.002, resume = path })
    assert.are.equal(1, #texts)
    has(texts[1], { "dt = 0.002 s instead of 0.005 s" })
  end)

  it("may have other settings if it is a new run of a scene that was read", function()
    local path, scene = file(), script().scene
    scene:run{ dt = 0.005 }
    scene:save(path)
    for _, again in ipairs{ sw.load(path), script().scene } do
      if again.time == 0 then again:resume(path) end
      local run = again:run{ duration = 0.02, dt = 0.002, window = 0.005 }
      assert.is_true(run.ok)
      assert.are.equal(0, #resumed(run))
    end
  end)
end)
