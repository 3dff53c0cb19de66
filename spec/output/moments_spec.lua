-- SPDX-License-Identifier: GPL-3.0-or-later
-- Frames at the end of a run, and at times between frames: a wire flies at 2 m/s without weight, so that its
-- place at each time is known.
local sw = require "softworld"
local core = require "softworld.core"
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/output"
local program = dofile(here .. "/../host/program.lua")
local vec = require "softworld.vec"

local SPEED, LENGTH, END = 2, 0.3, 0.499 -- [m/s], [m], [s]

local function flying()
  local scene = sw.scene{ name = "flying", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ name = "w", cable = "GXL 1.5", from = { 0, 0, 0.1 }, to = { LENGTH, 0, 0.1 },
    segments = 8 }
  wire:set_velocity{ SPEED, 0, 0 }
  return scene, wire
end

local function fly(options)
  local scene = flying()
  options.dt = 0.001
  return scene:run(options), scene
end

local function times_of(scene) return core.frame_times(scene) end

describe("the end of a run", function()
  local folder
  setup(function() folder = program.folder() end)
  teardown(program.clean)

  -- Returns the least and largest x of an .obj file, and the time that it tells.
  local function reach(path)
    local low, high = math.huge, -math.huge
    local text = program.read(path)
    for word in text:gmatch "\nv (%S+)" do
      local x = tonumber(word)
      low, high = math.min(low, x), math.max(high, x)
    end
    return low, high, tonumber(text:match "at t = (%S+) s")
  end

  local function at(run, t)
    local low, high, told = reach(run:obj(folder .. "/at.obj", { t = t }))
    assert.near(SPEED * (t or run.time), low, 1e-6)
    assert.near(SPEED * (t or run.time) + LENGTH, high, 1e-6)
    assert.near(t or run.time, told, 1e-9)
  end

  it("is the last frame, in all files", function()
    local run, scene = fly{ duration = END }
    local frames = run:frames()
    assert.near(END, frames[#frames].t, 1e-12)
    assert.near(SPEED * END, frames[#frames].wires[1][1], 1e-6)
    at(run)
    at(run, END)
    local last
    for t in program.read(run:vtk(folder .. "/end.pvd")):gmatch 'timestep="([^"]*)"' do last = tonumber(t) end
    assert.near(END, last, 1e-6)
    local film, count = core.film(scene, -1, 1, true)
    assert.equal(#frames, count)
    assert.is_true(#film > 0)
    run:picture{ path = folder .. "/end.svg" }
    assert.truthy(program.read(folder .. "/end.svg"):find("t = 0.50 s", 1, true))
  end)

  it("is there once, and also in runs shorter than the time between frames", function()
    assert.equal(16, #fly{ duration = 0.5 }:frames())
    for duration, count in pairs{ [0.034] = 2, [0.02] = 2, [0.001] = 2 } do
      local frames = fly{ duration = duration }:frames()
      assert.same({ count, duration }, { #frames, frames[#frames].t })
    end
  end)

  it("is not stored with frames = false", function()
    local _, scene = fly{ duration = END, frames = false }
    assert.equal(0, scene:frame_count())
  end)

  it("makes way for the frames of the next run, which are those of one run", function()
    local _, one = fly{ duration = 0.7 }
    local _, two = fly{ duration = END }
    local ended = #times_of(two)
    two:run{ duration = 0.7 - END, dt = 0.001 }
    local a, b = times_of(one), times_of(two)
    assert.equal(#a, #b)
    assert.is_true(#b > ended)
    for i, t in ipairs(a) do assert.near(t, b[i], 1e-9) end
  end)

  it("stays with a run without frames, and comes back with a snapshot", function()
    local _, scene = fly{ duration = END }
    local count = scene:frame_count()
    scene:run{ duration = 0.01, dt = 0.001, frames = false }
    assert.equal(count, scene:frame_count())
    local snapshot = scene:snapshot()
    scene:run{ duration = 0.2, dt = 0.001 }
    assert.is_true(scene:frame_count() > count)
    scene:restore(snapshot)
    local times = times_of(scene)
    assert.same({ count, END }, { #times, times[#times] })
  end)

  -- A file has the frames that an uninterrupted run has at its time; the end's is made anew from the state.
  it("comes back from files, until the run goes on", function()
    local _, scene = fly{ duration = END }
    scene:save(folder .. "/end.sws")
    assert.near(END, times_of(scene)[#times_of(scene)], 1e-12)
    local loaded = sw.load(folder .. "/end.sws")
    assert.same(times_of(scene), times_of(loaded))
    for k = 1, scene:frame_count() do assert.same(scene:frame(k), loaded:frame(k)) end
    loaded:run{ duration = 0.7 - END, dt = 0.001 }
    scene:run{ duration = 0.7 - END, dt = 0.001 }
    assert.same(times_of(scene), times_of(loaded))
  end)

  it("leaves the bits of the next run as they are", function()
    local function go(frames)
      local scene, wire = flying()
      scene:clamp(wire, { s = 0 }):follow{ points = { { 0, 0, 0.1 }, { 1, 0, 0.1 } }, duration = 0.5 }
      scene:obstacle{ shape = "sphere", radius = 0.05, at = { 0.5, 0.01, 0.12 } }
      for _ = 1, 3 do scene:run{ duration = 0.0333, dt = 0.001, frames = frames } end
      return wire:positions()
    end
    assert.same(go(false), go(true))
  end)

  describe("and a time between two frames", function()
    it("has its own shape in .obj and .stl files", function()
      local run, scene = fly{ duration = END, frame = 0.2 }
      local count = scene:frame_count()
      for _, t in ipairs{ 0.05, 0.1, 0.25, 0.3, 0.45 } do at(run, t) end
      local path = run:stl(folder .. "/at.stl", { t = 0.3 })
      local bytes, low = program.read(path), math.huge
      for k = 0, ("<I4"):unpack(bytes, 81) - 1 do
        for corner = 0, 2 do low = math.min(low, (("<f"):unpack(bytes, 85 + 50 * k + 12 + 12 * corner))) end
      end
      assert.near(SPEED * 0.3, low, 1e-6)
      assert.equal(count, scene:frame_count())
    end)

    it("has its own picture, with its time below it", function()
      local run, scene = fly{ duration = END, frame = 0.2 }
      local count, path = scene:frame_count(), folder .. "/at.svg"
      run:picture{ path = path, times = { 0.05, 0.2, 0.31 } }
      for _, t in ipairs{ "0.05", "0.20", "0.31" } do
        assert.truthy(program.read(path):find(("t = %s s"):format(t), 1, true), t)
      end
      assert.equal(count, scene:frame_count())
    end)

    it("is on the way of obstacles that move and turn", function()
      local scene = flying()
      local bar = scene:obstacle{ name = "bar", shape = "box", size = { 0.2, 0.02, 0.02 }, at = { 0, 1, 0 } }
      bar:follow{ func = function(t)
        return { 0, 1, 0.1 * t }, { math.cos(t), 0, 0, math.sin(t) }
      end }
      scene:run{ duration = 0.3, dt = 0.001, frame = 0.1 }
      local before, after = scene:frame(2).obstacles[1], scene:frame(3).obstacles[1]
      local count = scene:frame_count()
      local number = core.add_between(scene, 0.15)
      local frame = scene:frame(number)
      core.drop_frames(scene, count)
      local pose = frame.obstacles[1]
      assert.near(0.15, frame.t, 1e-12)
      assert.near((before.position[3] + after.position[3]) / 2, pose.position[3], 1e-6)
      local turn = vec.multiply(vec.conjugate(before.rotation), pose.rotation)
      local rest = vec.multiply(vec.conjugate(pose.rotation), after.rotation)
      for k = 1, 4 do assert.near(turn[k], rest[k], 1e-4) end
      assert.near(1, pose.rotation[1] ^ 2 + pose.rotation[4] ^ 2, 1e-6)
    end)

    it("has the nearest frame, with its time, where the wire has another mesh in the next one", function()
      local scene, wire = flying()
      scene:process(function(p)
        p:wait(0.25)
        wire:remodel{ model = "rod", segments = 16 }
        p:wait(0.249)
      end)
      local run = scene:run{ dt = 0.001, frame = 0.2 }
      local _, _, told = reach(run:obj(folder .. "/mesh.obj", { t = 0.29 }))
      assert.near(0.2, told, 0.001)
      assert.is_nil(core.add_between(scene, 0.29))
    end)
  end)
end)
