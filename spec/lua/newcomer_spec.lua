-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a first script gets wrong, and whether the answer says what to do.
local sw = require "softworld"

local function laid(height, options)
  local scene = sw.scene { name = "first" }
  scene:obstacle { name = "table", shape = "plane", friction = 0.3 }
  scene:force { kind = "damping", mass = 8 }
  local wire = scene:wire { name = "wire", E = 1e7, density = 1200, radius = 3e-3, segments = 20,
    from = { 0, 0, height }, to = { 0.2, 0, height } }
  local hand = scene:gripper { name = "hand", pads = options }
  return scene, wire, hand
end

local function refused(text, f, ...)
  local fine, why = pcall(f, ...)
  assert.is_false(fine)
  assert.is_truthy(tostring(why):find(text, 1, true), tostring(why))
end

describe("a first script", function()
  it("is asked about millimetres where a place lies beyond the wire", function()
    local scene, wire, hand = laid(0.1)
    refused("s = 20 m is not on wire 'wire'; it must be in [0, 0.2] m; is this in mm?", scene.clamp, scene,
      wire, { s = 20 })
    refused("grip 'hand': s = 20 m is not on wire 'wire'; it must be in [0, 0.2] m; is this in mm?",
      hand.grasp, hand, wire, { s = 20 })
    local _, why = pcall(scene.clamp, scene, wire, { s = 300 }) -- not on the wire in millimetres either
    assert.matches("it must be in %[0, 0%.2%] m$", why)
    _, why = pcall(scene.clamp, scene, wire, { s = 0.25 }) -- a little beyond the end: no millimetres
    assert.matches("it must be in %[0, 0%.2%] m$", why)
  end)

  it("is told which way a feed could go", function()
    local scene, wire = laid(0.1)
    local feed = scene:feed(wire, { s = 0.05, name = "feed" })
    refused("feed 'feed': length = 0.15 m is not allowed; 0.05 m of wire 'wire' are left on the side that it "
      .. "comes from; length = -0.15 m goes the other way", feed.feed, feed, { length = 0.15, speed = 0.1 })
    assert.is_true(feed:feed { length = -0.1, speed = 0.1 } > 0)
  end)

  it("is told how high wire and gripper are where they do not reach over a clip", function()
    local scene, wire, hand = laid(0.1)
    local clip = scene:clip { name = "clip", at = { 0.1, 0, 0.098 }, width = 0.01, insertion = 8,
      retention = 25 }
    scene:process(function()
      hand:grasp(wire, { s = 0.11 })
      hand:clip { into = clip, speed = 0.1 }
    end)
    refused("gripper 'hand': clip: the wire is 0.002 m and the tool 0.002 m over the seat of 'clip', whose "
      .. "lips are at 0.0045 m; first move both over the lips, by gripper:move", scene.run, scene,
      { dt = 0.01 })
  end)

  it("is told all the names that gripper:move takes", function()
    local _, wire, hand = laid(0.1)
    hand:grasp(wire, { s = 0.1 })
    local _, why = pcall(hand.move, hand, { by = { 0, 0, 0.1 }, velocity = 0.2 })
    assert.matches("gripper:move: there is no parameter 'velocity'; known are: ", why)
    for _, name in ipairs { "by", "to", "points", "turn", "speed", "duration", "on_slip" } do
      assert.matches(" " .. name .. "%f[ \0]", why)
    end
    refused("gripper:move: there is no parameter 'speeed'; did you mean 'speed'?", hand.move, hand,
      { by = { 0, 0, 0.1 }, speeed = 0.2 })
    refused("gripper:move: there is no parameter 'bye'; did you mean 'by'?", hand.move, hand,
      { bye = { 0, 0, 0.1 }, speed = 0.2 })
  end)

  it("reads once when a run diverged", function()
    local scene, wire, hand = laid(0.1)
    scene:obstacle { name = "wall", shape = "box", size = { 0.01, 0.4, 0.6 }, at = { 0.25, 0, 0.3 } }
    scene:process(function()
      hand:grasp(wire, { s = 0.19 })
      hand:move { by = { 0.2, 0, 0 }, speed = 0.5 }
    end)
    local run, lines = scene:run { dt = 0.01 }, {}
    assert.is_false(run.ok)
    assert.matches("^at t = ", run.reason)
    local file = io.tmpfile()
    run:summary(file)
    file:seek "set"
    for line in file:lines() do lines[#lines + 1] = line end
    file:close()
    local _, times = lines[1]:gsub("at t = ", "")
    assert.equal(1, times, lines[1])
    assert.matches("^first: DIVERGED at t = [^:]*: %a", lines[1])
  end)

  it("reads the margin of its grip where it reads the force", function()
    local scene, wire, hand = laid(3e-3, { width = 0.02, friction = 0.6, opening = 9e-3 })
    assert.is_nil(hand.peak_margin)
    scene:process(function(p)
      hand:grasp(wire, { s = 0.1, approach = "plates", force = 20 })
      hand:move { by = { 0, 0, 0.05 }, speed = 0.2 }
      p:wait(0.1)
    end)
    local run = scene:run { dt = 0.01 }
    local weight = math.pi * 9e-6 * 1200 * 0.2 * 9.81
    assert.equal(hand:over().peak_margin, hand.peak_margin)
    -- at rest the pads bear the weight: weight / (mu N of two fingers); on the way more
    assert.is_true(hand.peak_margin >= weight / (0.6 * 2 * 20) * (1 - 1e-3), hand.peak_margin)
    assert.is_true(hand.peak_margin < 1)
    local shown = {}
    for _, row in ipairs(run:document().summary) do shown[row.label] = row.value end
    assert.equal(hand.peak_margin, shown["hand: largest share of the pads' friction (1: slips)"])
  end)

  it("is told that its wire fell while the jaws closed", function()
    local scene = sw.scene { name = "falls" }
    local hose = scene:wire { name = "hose", E = 5e6, density = 1100, radius = 6e-3, segments = 10,
      from = { 0, 0, 0 }, to = { 0.08, 0, 0 } }
    local hand = scene:gripper { name = "hand", pads = { width = 0.02, opening = 0.014 } }
    local why
    scene:process(function()
      why = select(2, pcall(hand.grasp, hand, hose, { s = 0.04, approach = "plates", force = 5 }))
    end)
    assert.is_true(scene:run { dt = 0.01 }.ok)
    assert.matches("closed on nothing: wire 'hose' is %d%.%d+ m from the tool centre and moves at "
      .. "%d%.%d+ m/s: it went away while the jaws closed; hold it, or lay it on something$", why)
  end)

  -- A wire that falls straight down has a radius of 1e10 m, which is rounding.
  it("reads that a wire is straight, and not a radius of rounding errors", function()
    for bent, value in pairs { [true] = "number", [false] = "straight" } do
      local scene = sw.scene { name = "falls" }
      local wire = scene:wire { name = "wire", cable = "GXL 1.5", from = { 0, 0, 0 }, to = { 0.3, 0, 0 } }
      if bent then scene:clamp(wire, { s = 0 }) end
      local run, seen = scene:run { duration = 0.1, dt = 0.01 }, nil
      for _, row in ipairs(run:document().summary) do
        if row.label:find "bend radius" then seen = type(row.value) == "number" and "number" or row.value end
      end
      assert.equal(value, seen)
    end
  end)

  it("finds the parameters of a mesh under its name", function()
    local topics = require "softworld.prompt.topics"
    for model, words in pairs { tube = "ring_radius", radial = "layers", cubic = "across",
      composite = "cores" } do
      assert.is_truthy(topics.text(model):find(words, 1, true))
      assert.is_truthy(topics.text(model):find("help 'wire_mesh', 'wire' and 'section'", 1, true))
    end
    assert.is_truthy(topics.text "rod":find("its parameters: help 'wire' and 'section'", 1, true))
    assert.matches("\n  segments +number of segments", topics.text "wire")
  end)
end)
