-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rows of grippers are judged by the rating on their data sheet. Without one they are open and say how to
-- give it; a script can say that none is needed.
local sw = require "softworld"
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/check"
local program = dofile(here .. "/../host/program.lua")

-- Returns a run in which a gripper with this rating lifts the end of a cable, and the gripper.
local function lift(rating, pads)
  local scene = sw.scene{ name = "rated" }
  scene:obstacle{ shape = "plane", friction = 0.3 }
  local cable = scene:wire{ name = "cable", cable = "GXL 1.5", from = { 0, 0, 0.0015 },
    to = { 0.3, 0, 0.0015 }, segments = 60 }
  scene:force{ kind = "damping", mass = 20 }
  local hand = scene:gripper{ name = "hand", rating = rating, pads = pads, slip_tolerance = 1e-3 }
  scene:process(function(p)
    hand:grasp(cable, pads and { s = 0.03, approach = "plates", force = 5 } or { s = 0.03 })
    hand:move{ by = { 0, 0, 0.05 }, speed = 0.2 }
    p:wait(0.1)
  end)
  return scene:run{ dt = 2e-3 }, hand
end

describe("a gripper's rating", function()
  teardown(program.clean)

  it("makes a check with default limits pass or fail", function()
    local run, hand = lift{ force = 20, moment = 1, source = "data sheet 7" }
    local check = run:check{ limits = { max_sidewall = false } }
    assert.equal("PASS", check.verdict, tostring(check))
    local force = check:row "hand.peak_force"
    assert.same({ 20, "max", "rating", "data sheet 7" }, { force.limit, force.side, force.from,
      force.source })
    assert.equal(20 - hand.peak_force, force.margin)
    local weak = lift({ force = hand.peak_force / 2, moment = 1 }):check{}
    assert.equal("FAIL", weak:row "hand.peak_force".verdict)
    assert.equal("PASS", weak:row "hand.peak_moment".verdict)
    assert.equal("FAIL", weak.verdict)
  end)

  it("gives way to a limit of the script, and says if that is less strict", function()
    local run = lift{ force = 20, moment = 1 }
    local row = run:check{ limits = { peak_force = 30 } }:row "hand.peak_force"
    assert.same({ 30, "user" }, { row.limit, row.from })
    assert.truthy(row.note:find("less strict than the rating's 20.00 N", 1, true), row.note)
  end)

  it("is open without, and says how to give one or that none is needed", function()
    local run, hand = lift()
    assert.is_nil(hand.rating)
    local check = run:check{}
    local row = check:row "hand.peak_moment"
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("the gripper has no rating; give scene:gripper { rating = { moment = } } or "
      .. "limits = { ['hand.peak_moment'] = } [N m], or false if none is needed", 1, true), row.note)
    local text = tostring(check)
    local block = text:match "give numbers, or false where none is needed:\n(.-})"
    assert.equal([[
    limits = { ["cable.max_sidewall"] = [N/m], ["hand.peak_force"] = [N],
      ["hand.peak_moment"] = [N m] }]], block)
    -- what the text proposes is what the check takes
    local limits = assert(load("return {" .. block:match "{(.*)":gsub("%[[%w/ ]+%]([, ])", "false%1")))()
    local fine = run:check{ limits = limits }
    assert.equal("PASS", fine.verdict, tostring(fine))
    assert.same({ "cable.max_sidewall", "hand.peak_force", "hand.peak_moment" }, fine.skipped)
  end)

  it("names the part that it lacks", function()
    local row = lift{ force = 20 }:check{}:row "hand.peak_moment"
    assert.equal("OPEN", row.verdict)
    assert.truthy(row.note:find("the gripper's rating has no moment; give", 1, true), row.note)
  end)

  it("may be false: no rows, and the report names them", function()
    local limits = { max_sidewall = false }
    local check = lift(false):check{ limits = limits }
    assert.equal("PASS", check.verdict, tostring(check))
    assert.truthy(tostring(check):find("left out by the script: cable.max_sidewall, hand.peak_force, "
      .. "hand.peak_moment", 1, true))
    local part, hand = lift{ force = 20, moment = false }
    check = part:check{ limits = limits }
    assert.equal("PASS", check.verdict, tostring(check))
    assert.equal("PASS", check:row "hand.peak_force".verdict)
    assert.same({ force = 20, moment = false }, hand.rating)
    local row = part:check{ limits = { peak_moment = 2, max_sidewall = false } }:row "hand.peak_moment"
    assert.same({ 2, "user" }, { row.limit, row.from }) -- a limit is a limit
  end)

  it("limits the opening of the pads by their stroke", function()
    local pads = { friction = 0.8, opening = 0.006 }
    local check = lift({ force = 20, moment = 1, stroke = 0.005 }, pads):check{}
    assert.equal("FAIL", check:row "hand.opening".verdict)
    assert.equal("PASS", lift({ stroke = 0.008 }, pads):check{}:row "hand.opening".verdict)
    assert.has_error(function() lift({ force = 20 }, pads):check{}:row "hand.opening" end)
  end)

  -- Jaws of 30 mm begin to close with the first step, at 0.2 m/s: at its end, 20 ms later, they are 26 mm
  -- wide. The pads were made 30 mm wide. A later run begins with what they are then.
  it("counts the opening with which the pads were made, in steps of any size", function()
    for _, options in ipairs{ { dt = 0.02 }, { dt = 0.002 }, { dt = 0.1, quasistatic = true } } do
      local scene = sw.scene{ gravity = { 0, 0, 0 } }
      local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.12, 0, 0 },
        segments = 24 }
      scene:clamp(wire, { s = 0 })
      scene:force{ kind = "damping", mass = 20, stiffness = 0.003, on = wire }
      local hand = scene:gripper{ name = "hand", at = { 0.06, 0, 0 }, rating = { stroke = 0.029 },
        pads = { width = 0.02, friction = 0.4, opening = 0.03 } }
      scene:process(function()
        hand:grasp(wire, { s = 0.06, approach = "plates", force = 2, speed = 0.2 })
      end)
      local row = scene:run(options):check{}:row "hand.opening"
      assert.same({ 0.03, "FAIL" }, { row.value, row.verdict })
      options.duration = 0.1
      row = scene:run(options):check{}:row "hand.opening"
      assert.is_true(row.value < 2 * wire.radius + 1e-9)
    end
  end)

  it("is kept by files, scripts and descriptions", function()
    local run, hand = lift{ force = 20, moment = false, source = "sheet" }
    local folder = program.folder()
    local scene = sw.load(run.scene:save(folder .. "/a.sws") or folder .. "/a.sws")
    assert.same(hand.rating, scene:find "hand".rating)
    assert.same({ force = 20, moment = false, source = "sheet" }, hand:get().rating)
    run.scene:script(folder .. "/a.lua")
    assert.same(hand.rating, dofile(folder .. "/a.lua"):find "hand".rating)
    assert.is_false((select(2, lift(false))):get().rating)
  end)

  it("may be replaced by gripper:set, for later checks; snapshots undo it", function()
    local run, hand = lift()
    local limits = { max_sidewall = false }
    assert.equal("OPEN", run:check{ limits = limits }.verdict)
    hand:set{ rating = { force = 20, moment = 1, source = "sheet 8" } }
    local check = run:check{ limits = limits }
    assert.equal("PASS", check.verdict, tostring(check))
    local row = check:row "hand.peak_force"
    assert.same({ 20, "rating", "sheet 8" }, { row.limit, row.from, row.source })
    local before = run.scene:snapshot()
    hand:set{ rating = { force = hand.peak_force / 2 } } -- the whole of it: the moment is open again
    check = run:check{ limits = limits }
    assert.equal("FAIL", check:row "hand.peak_force".verdict)
    assert.equal("OPEN", check:row "hand.peak_moment".verdict)
    hand:set{ slip_tolerance = 1e-3 } -- leaves it
    assert.same({ force = hand.peak_force / 2 }, hand.rating)
    local folder = program.folder()
    run.scene:script(folder .. "/a.lua")
    local text = program.read(folder .. "/a.lua")
    assert.truthy(text:find(":set { rating = { force = 20", 1, true), text)
    run.scene:restore(before)
    assert.same({ force = 20, moment = 1, source = "sheet 8" }, hand.rating)
    hand:set{ rating = false }
    assert.is_false(hand:get().rating)
    for _, wrong in ipairs{ { force = 0 }, { torque = 1 }, 20 } do
      assert.error_matches(function() hand:set{ slip_tolerance = 2e-3, rating = wrong } end,
        "gripper:set: rating")
      assert.same({ false, 1e-3 }, { hand.rating, hand.slip_tolerance })
    end
  end)

  it("is checked again where a script has written into it", function()
    local run, hand = lift{ force = 20 }
    for value, text in pairs{ ["20"] = "= '20' is not allowed; it must be a number above 0 N",
      [-1] = "= -1 N is not allowed; it must be above 0 N" } do
      hand.rating.force = value
      local fine, why = pcall(run.check, run, {})
      assert.is_false(fine)
      assert.truthy(why:find("gripper 'hand': rating.force " .. text, 1, true), why)
    end
    hand.rating.force = 30
    assert.equal(30, run:check{}:row "hand.peak_force".limit)
  end)

  it("is refused if it is none", function()
    for _, case in ipairs{
      { { force = -1 }, "rating.force = -1 N is not allowed; it must be above 0 N" },
      { { force = 0 / 0 }, "rating.force" }, { { torque = 1 }, "there is no parameter 'torque'" },
      { 20, "rating takes one table of parameters, got number" },
      { { force = true }, "rating.force = a boolean" } } do
      local fine, why = pcall(lift, case[1])
      assert.is_false(fine)
      assert.truthy(tostring(why):find(case[2], 1, true), tostring(why))
    end
  end)
end)
