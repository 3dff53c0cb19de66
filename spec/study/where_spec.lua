-- SPDX-License-Identifier: GPL-3.0-or-later
-- Where a study is computed: what is wrong is told before anything is computed. With a cluster: cluster_spec.
local sw = require "softworld"
local program = require "host.program"
local sends = require "softworld.study.sends"

local function study(changes)
  local args = { name = "s", workers = 0, parameters = { x = { 0, 1 } },
    evaluate = function(p) return { y = p.x } end }
  for key, value in pairs(changes or {}) do args[key] = value end
  return sw.study(args)
end

describe("study:run", function()
  teardown(program.clean)

  it("gives the study, and here is where it is computed", function()
    local s = study()
    assert.equal(s, s:run { on = "here", detach = false })
    assert.equal(3, #s:run():sweep { count = 3 })
  end)

  it("tells what is wrong", function()
    local s = study()
    local cases = {
      { { on = "slurn" }, "study:run: on = 'slurn' is not one of: here slurm; did you mean 'slurm'?" },
      { { tasks = 0 }, "study:run: tasks = 0 is not allowed; it must be an integer from 1 to" },
      { { seconds = 0 }, "study:run: seconds = 0 s is not allowed" },
      { { detached = true }, "did you mean 'detach'?" },
      { { options = { array = "1-3" } }, "study:run: options: array is set by the study itself" },
      { { options = { job_name = "x" } }, "job_name is set by the study itself" },
      { { options = { "short" } }, "study:run: options: 1 is no name of an option of sbatch" },
      { { options = { partition = {} } }, "options: partition = a table must be a text on one line" },
      { { options = { partition = "a\nb" } }, "must be a text on one line" },
      { { options = { ["a b"] = 1 } }, "options: 'a b' is no name of an option" },
      { { options = "-p short" }, "study:run: options" },
    }
    for _, case in ipairs(cases) do
      local fine, why = pcall(s.run, s, case[1])
      assert.is_false(fine)
      assert.truthy(why:find(case[2], 1, true), why)
    end
  end)

  it("needs a journal for a cluster, and a script in a file", function()
    assert.error_matches(function() study { on = "slurm" }:sweep { count = 3 } end,
      "study 's': on = 'slurm' needs a journal, file = 's.study', in a folder that the nodes see too")
  end)

  it("is told by the environment", function()
    local text = [[
local sw = require "softworld"
local function evaluate() return { y = 1 } end
local study = sw.study { name = "s", parameters = { x = { 0, 1 } }, evaluate = evaluate }
print(#study:sweep { count = 2 })]]
    local _, err = program.script(text, {}, { before = "SOFTWORLD_ON=slurm" })
    assert.truthy(err:find("script.lua:4: study 's': on = 'slurm' needs a journal", 1, true), err)
    _, err = program.script(text, {}, { before = "SOFTWORLD_ON=cloud" })
    assert.truthy(err:find("script.lua:3: SOFTWORLD_ON = 'cloud' is not one of: here slurm", 1, true), err)
    assert.equal("2\n", (program.script(text, {}, { before = "SOFTWORLD_ON=" })))
  end)

  it("has nothing to cancel where nothing was sent", function()
    assert.equal(0, study():cancel())
    assert.equal(0, study { file = program.folder() .. "/s.study" }:cancel())
  end)
end)

describe("what is sent to a cluster", function()
  local about = { name = "s\n\"", key = "0123456789abcdef", text = "seed 1\nx", part = "sweep",
    job = "softworld-s" }
  local tasks = { { { number = 1, word = "0.5", tries = 1 }, { number = 2, word = "0.25,3", tries = 2 } },
    { { number = 7, word = "1.0", tries = 1 } } }

  it("is read as it was written, or not at all", function()
    local folder = program.folder() .. "/1"
    sends.write(folder, about, tasks)
    local read = sends.read(folder)
    assert.same(tasks, read.tasks)
    for _, key in ipairs { "name", "key", "text", "part", "job" } do assert.equal(about[key], read[key]) end
    assert.same({ [2] = tasks[2] }, sends.read(folder, 2).tasks)
    local text = program.read(folder .. "/list")
    for cut = 0, #text - 1, 7 do
      program.write(folder .. "/list", text:sub(1, cut))
      assert.is_nil(sends.read(folder))
    end
    assert.is_nil(sends.read(folder .. "/nowhere"))
  end)

  it("counts as found only when all of a task is there, with right sums", function()
    local folder = program.folder()
    local found = { { number = 1, word = "0.5", status = "ok", rest = "y=1.0" },
      { number = 2, word = "0.25,3", status = "failed", rest = "lost\n\"by\" chance" } }
    local text = sends.result_text(1, found)
    assert.is_nil(sends.result(folder, 1, tasks[1]))
    program.write(folder .. "/out.0", text)
    assert.same(found, sends.result(folder, 1, tasks[1]))
    assert.is_false(sends.result(folder, 1, tasks[2]))
    for at = 1, #text do
      program.write(folder .. "/out.0", text:sub(1, at - 1))
      assert.is_false(sends.result(folder, 1, tasks[1]))
      local other = string.char(text:byte(at) ~ 1)
      program.write(folder .. "/out.0", text:sub(1, at - 1) .. other .. text:sub(at + 1))
      local read = sends.result(folder, 1, tasks[1])
      assert.is_false(read, at)
    end
  end)
end)
