-- SPDX-License-Identifier: GPL-3.0-or-later
-- Where a study is computed; mistakes are reported before anything is computed. With a cluster:
-- cluster_spec.
local sw = require "softworld"
local program = require "host.program"
local sealed = require "softworld.sealed"
local sends = require "softworld.study.sends"

local function study(changes)
  local args = { name = "s", workers = 0, parameters = { x = { 0, 1 } },
    evaluate = function(p) return { y = p.x } end }
  for key, value in pairs(changes or {}) do args[key] = value end
  return sw.study(args)
end

describe("study:run", function()
  teardown(program.clean)

  it("returns the study, and on = 'here' computes it locally", function()
    local s = study()
    assert.equal(s, s:run { on = "here", detach = false })
    assert.equal(3, #s:run():sweep { count = 3 })
  end)

  it("reports wrong arguments", function()
    local s = study()
    local cases = {
      { { on = "slurn" }, "study:run: on = 'slurn' is not one of: here slurm; did you mean 'slurm'?" },
      { { tasks = 0 }, "study:run: tasks = 0 is not allowed; it must be an integer from 1 to" },
      { { seconds = 0 }, "study:run: seconds = 0 s is not allowed" },
      { { detached = true }, "did you mean 'detach'?" },
      { { options = { array = "1-3" } }, "study:run: options: array is set by the study itself" },
      { { options = { job_name = "x" } }, "job_name is set by the study itself" },
      { { options = { "short" } }, "study:run: options: 1 is not the name of an option of sbatch" },
      { { options = { partition = {} } }, "options: partition = a table must be a text on one line" },
      { { options = { partition = "a\nb" } }, "must be a text on one line" },
      { { options = { ["a b"] = 1 } }, "options: 'a b' is not the name of an option" },
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

  it("is overridden by the environment", function()
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

describe("the files sent to a cluster", function()
  local about = { name = "s\n\"", key = "0123456789abcdef", text = "seed 1\nx", part = "sweep",
    job = "softworld-s" }
  local tasks = { { { number = 1, word = "0.5", tries = 1 }, { number = 2, word = "0.25,3", tries = 2 } },
    { { number = 7, word = "1.0", tries = 1 } } }

  it("are read exactly as written, or not at all", function()
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

  it("give a result only when all of a task is there, with correct checksums", function()
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

describe("a task of a cluster", function()
  teardown(program.clean)

  -- It has two parts; the second one needs the result of the first.
  local SCRIPT = [[
local sw = require "softworld"
local study = sw.study { name = "node", file = FILE, seed = 4, workers = 0, parameters = { x = { 0, 1 } },
  evaluate = function(p) return { y = p.x, luck = p.random() } end, constraints = { y = { max = 0.5 } } }
if not RUN then return study end
study:sweep { count = 3 }
study:spread { count = 5 }
study:csv(FILE .. ".csv")
print "the end"
]]

  -- The study of the script, its file with a number of its parts, and its task, usually of the second part.
  local function made(changes, count)
    local file = program.folder() .. "/node.study"
    local text = SCRIPT:gsub("FILE", ("%q"):format(file))
    local study_of = assert(load((text:gsub("RUN", "false"))))()
    if count > 0 then study_of:sweep { count = 3 } end
    if count > 1 then study_of:spread { count = 5 } end
    local own = sealed.fields(study_of)
    local d = own.journal.definition
    local about_it = { name = d.name, key = d.key, text = d.text, part = "spread", job = "x" }
    for key, value in pairs(changes or {}) do about_it[key] = value end
    sends.write(file .. ".tasks/1", about_it, { { { number = 2, word = "0.25", tries = 1 },
      { number = 4, word = "0.75", tries = 1 } } })
    return file, (text:gsub("RUN", "true")), study_of
  end

  local function run(text, file, before)
    return program.script(text, {}, { before = (before or "") .. "SOFTWORLD_TASK=" .. file .. ".tasks/1" })
  end

  it("computes its list with the bits of the study, and ends there", function()
    local file, text = made(nil, 1)
    local before = program.read(file)
    local out, err, code = run(text, file)
    assert.equal(0, code, err)
    assert.equal("", out .. err)
    assert.equal(before, program.read(file)) -- the journal is only read
    local list = sends.read(file .. ".tasks/1").tasks[1]
    local found = sends.result(file .. ".tasks/1", 1, list)
    assert.equal(2, #found)
    local rows = select(3, made(nil, 2)):table()
    for i, r in ipairs(found) do
      -- the values come from the list, the random numbers from part and number
      local luck = rows[3 + r.number].luck
      assert.equal(("luck=%.17g y=%.17g"):format(luck, i == 1 and 0.25 or 0.75), r.rest)
    end
    assert.is_nil(io.open(file .. ".csv"))
    -- run again, as after a requeue: its earlier results stay
    before = program.read(file .. ".tasks/1/out.0")
    assert.equal(0, select(3, run(text, file)))
    assert.equal(before, program.read(file .. ".tasks/1/out.0"))
  end)

  it("says that the script differs, and where", function()
    local file, text = made(nil, 0)
    local _, err, code = run(text:gsub("seed = 4", "seed = 5"), file)
    assert.equal(1, code)
    assert.truthy(err:find("script.lua:2: study 'node' is another one on this node than where it was sent "
      .. "from:\n  before: seed 4\n  now:    seed 5", 1, true), err)
  end)

  it("does not compute evaluations of another part", function()
    local file, text = made(nil, 0)
    local _, err, code = run(text, file) -- the first part is not in the journal
    assert.equal(1, code)
    assert.truthy(err:find("study 'node': evaluation 1.1 is not in ", 1, true), err)
    file, text = made({ part = "spread #7" }, 2) -- a part that is never reached
    local out
    out, err, code = run(text, file)
    assert.equal("the end\n0", out .. code, err)
    assert.is_nil(io.open(file .. ".csv"))
  end)

  it("reports a missing list, or a task missing from it", function()
    local file, text = made(nil, 1)
    local _, err = run(text, file, "SLURM_ARRAY_TASK_ID=3 ")
    assert.truthy(err:find("study 'node': there is no task 3 in ", 1, true), err)
    _, err = run(text, "/nowhere")
    assert.truthy(err:find("SOFTWORLD_TASK=/nowhere.tasks/1: there is no whole list", 1, true), err)
  end)
end)
