-- SPDX-License-Identifier: GPL-3.0-or-later
--- Scenes with twist, snap-through, self-contact and high speed, in which methods are known to fail. Each run
-- succeeds or reports why not. The note of a row has the values by which it is judged.
-- @module bench.twists
local core = require "softworld.core"

local twists = {}

-- Runs the scene for a duration in steps of dt; returns a row with the results.
local function drive(scene, o, duration)
  local began = core.clock()
  local r = scene:advance({ dt = o.dt, integrator = o.integrator }, scene.time + duration)
  return { rejected = r.rejected, steps = r.steps, wall = core.clock() - began,
    status = r.ok and "ok" or "failed", reason = not r.ok and r.reason or nil }
end

-- A taut wire is twisted, then given slack: it forms a loop, which coils up. Judged by its tension relative
-- to that of a plectoneme with the same torque.
local function hockle(o)
  local sw = require "softworld"
  local B, r, path = 4e-4, 1.5e-3, {}
  for i = 0, 100 do path[#path + 1] = { i / 100, 2e-4 * math.sin(math.pi * i / 100), 0 } end
  local scene = sw.scene{ name = "hockle", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ EA = 700, EI = B, GJ = 0.75 * B, mass_per_length = 0.01, radius = r,
    path = path, segments = o.segments }
  scene:wire_contact{ friction = o.friction }
  scene:force{ kind = "damping", mass = 3 }
  scene:clamp(wire, { s = 0 })
  local hand = scene:clamp(wire, { s = wire.length })
  hand:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, duration = 2, relative = true,
    turn = { axis = { 1, 0, 0 }, angle = 2 * math.pi * o.turns } }
  local row = drive(scene, o, 2)
  if row.status == "ok" then
    hand:follow{ points = { { 0, 0, 0 }, { -0.3, 0, 0 } }, duration = 4, relative = true }
    row = drive(scene, o, 8)
  end
  if row.status == "ok" then
    local M, low, high = math.abs(hand:moment()[1]), 1e-6, math.pi / 4 - 1e-6
    for _ = 1, 60 do
      local a = (low + high) / 2
      if 2 * B * math.sin(a) ^ 3 * math.cos(a) / (r * math.cos(2 * a)) < M then low = a else high = a end
    end
    local T = B / r ^ 2 * math.sin(low) ^ 4 * (0.5 + 1 / math.cos(2 * low))
    row.note = ("%d places touch, tension %.2f times a plectoneme's"):format(#scene:touches(),
      hand:force()[1] / T)
  end
  scene:close()
  return row
end

-- An overhand knot is pulled tight until its loop is as small as the wire allows.
local function knot(o)
  local sw = require "softworld"
  local path = {}
  for i = 0, 400 do
    local t = -2.1 + 4.2 * i / 400
    path[#path + 1] = { 0.02 * (t ^ 3 - 3 * t), 0.012 * (t ^ 4 - 4 * t ^ 2), 0.0072 * (t ^ 5 / 5 - 2 * t) }
  end
  for _, sign in ipairs{ -1, 1 } do -- the tails lead towards the line of the pull
    local at, before = path[sign < 0 and 1 or #path], path[sign < 0 and 2 or #path - 1]
    local d = { at[1] - before[1], at[2] - before[2], at[3] - before[3] }
    for _ = 1, 60 do
      local n = (d[1] ^ 2 + d[2] ^ 2 + d[3] ^ 2) ^ 0.5
      for k = 1, 3 do d[k] = 0.94 * d[k] / n + (k == 1 and 0.06 * sign or 0) end
      at = { at[1] + 0.003 * d[1], at[2] + 0.003 * d[2], at[3] + 0.003 * d[3] }
      table.insert(path, sign < 0 and 1 or #path + 1, at)
    end
  end
  local r, E = 0.002, 1e8
  local scene = sw.scene{ name = "knot", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ EA = 0.1 * E * math.pi * r ^ 2, EI = E * math.pi * r ^ 4 / 4, GJ = 8e-4,
    mass_per_length = 0.015, radius = r, path = path, segments = o.segments }
  scene:wire_contact{ friction = o.friction }
  scene:force{ kind = "damping", mass = 5 }
  scene:pin(wire, { s = 0 })
  local pin = scene:pin(wire, { s = wire.length })
  local row = drive(scene, o, 0.5)
  if row.status == "ok" then
    pin:follow{ points = { { 0, 0, 0 }, { o.pull, 0, 0 } }, duration = 4, relative = true }
    row = drive(scene, o, 4)
  end
  if row.status == "ok" then
    row.note = ("%d places touch, pull %.3g N, bend radius %.2f times the wire's, %.2f mm deep"):format(
      #scene:touches(), pin:force()[1], wire:min_bend_radius{ now = true } / r, 1e3 * scene:penetration())
  end
  scene:close()
  return row
end

-- An arch between two clamps snaps through when the clamps are turned.
local function snap(o)
  local sw = require "softworld"
  local scene, path = sw.scene{ name = "snap", gravity = { 0, 0, 0 } }, {}
  for i = 0, 100 do -- slightly asymmetric, else the arch would stay in its unstable symmetric state
    local a = math.pi * i / 100
    path[#path + 1] = { 0.8 * i / 100, 0, 0.3 * math.sin(a) + 0.003 * math.sin(2 * a) }
  end
  local wire = scene:wire{ EA = 1e4, EI = 1e-3, mass_per_length = 0.02, radius = 1e-3, path = path,
    segments = o.segments }
  scene:force{ kind = "damping", mass = 1 }
  local left, right = scene:clamp(wire, { s = 0 }), scene:clamp(wire, { s = wire.length })
  for sign, hold in pairs{ [1] = left, [-1] = right } do
    hold:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, duration = 2, relative = true,
      turn = { axis = { 0, 1, 0 }, angle = sign * 1.8 } }
  end
  local row = drive(scene, o, 4)
  if row.status == "ok" then
    row.note = ("middle at %.3f m"):format(wire:position(wire.length / 2)[3])
    if wire:position(wire.length / 2)[3] > 0 then row.status = "stays" end
  end
  scene:close()
  return row
end

-- The upper end of a hanging wire is jerked to and fro; the free end cracks like a whip.
local function whip(o)
  local sw = require "softworld"
  local scene = sw.scene{ name = "whip" }
  local wire = scene:wire{ EA = 1e4, EI = 1e-5, mass_per_length = 0.01, radius = 1e-3,
    from = { 0, 0, 0 }, to = { 0, 0, -1 }, segments = o.segments }
  local hand = scene:clamp(wire, { s = 0 })
  hand:follow{ points = { { 0, 0, 0 }, { 0.3, 0, 0 }, { 0, 0, 0 } }, times = { 0, 0.06, 0.12 },
    relative = true }
  local fastest = 0
  local row = { status = "ok", rejected = 0, steps = 0, wall = 0 }
  for _ = 1, 60 do
    local part = drive(scene, o, 0.01)
    row.rejected, row.steps = row.rejected + part.rejected, row.steps + part.steps
    row.wall, row.status, row.reason = row.wall + part.wall, part.status, part.reason
    if part.status ~= "ok" then break end
    local v = wire:velocity(wire.length)
    fastest = math.max(fastest, (v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2) ^ 0.5)
  end
  if row.status == "ok" then row.note = ("the end reaches %.0f m/s"):format(fastest) end
  scene:close()
  return row
end

-- The end of a lying wire is spun; the twist runs along the wire and comes back.
local function spin(o)
  local sw = require "softworld"
  local scene = sw.scene{ name = "spin", gravity = { 0, 0, 0 } }
  local wire = scene:wire{ EA = 1e4, EI = 1e-3, GJ = 7e-4, mass_per_length = 0.02, radius = 1e-3,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = o.segments, rest = o.rest }
  scene:clamp(wire, { s = 0 })
  local hand = scene:clamp(wire, { s = 1 })
  hand:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, duration = 0.2, relative = true, law = "linear",
    turn = { axis = { 1, 0, 0 }, angle = 20 * math.pi } }
  local row = drive(scene, o, 0.2)
  if row.status == "ok" then
    row.note = ("torque %.3f of GJ angle/L"):format(math.abs(hand:moment()[1]) / (7e-4 * 20 * math.pi))
  end
  scene:close()
  return row
end

-- A wire that rolls is twisted at its end and released: a wave of twist runs to and fro. With c^2 = GJ/I
-- the end spins at c angle/L, in one direction for 2 L/c, then in the other.
local function wave(o)
  local sw = require "softworld"
  local scene = sw.scene{ name = "twist wave", gravity = { 0, 0, 0 } }
  local GJ, inertia = 1e-6, 1e-8 -- [N m2], [kg m]
  local wire = scene:wire{ EA = 1e4, EI = 1e-3, GJ = GJ, mass_per_length = 0.02, radius = 1e-3,
    from = { 0, 0, 0 }, to = { 1, 0, 0 }, segments = o.segments, rolls = true, spin_inertia = inertia }
  scene:clamp(wire, { s = 0 })
  local hand = scene:clamp(wire, { s = 1 })
  hand:follow{ points = { { 0, 0, 0 }, { 0, 0, 0 } }, duration = 4, relative = true,
    turn = { axis = { 1, 0, 0 }, angle = 1 } }
  local row = drive(scene, o, 4)
  hand:release()
  local c, turns, before, time, most = (GJ / inertia) ^ 0.5, 0, 0, 0, 0
  for k = 1, row.status == "ok" and 120 or 0 do
    local part = drive(scene, o, 0.01)
    row.rejected, row.steps = row.rejected + part.rejected, row.steps + part.steps
    row.wall, row.status, row.reason = row.wall + part.wall, part.status, part.reason
    if part.status ~= "ok" then break end
    local now = wire:spin(1)
    if before * now < 0 then turns, time = turns + 1, 0.01 * (k - now / (now - before)) end
    before, most = now, math.max(math.abs(now), most)
  end
  if row.status == "ok" then
    row.note = ("turns back %d times, the last after %.3f of its time, spin up to %.2f c angle/L")
      :format(turns, time / (turns * 2 / c), most / c)
  end
  scene:close()
  return row
end

--- Calls add(item, run, options) for every row.
function twists.add_all(add)
  for _, dt in ipairs{ 0.01, 0.005, 0.002 } do
    for _, friction in ipairs{ 0, 0.3 } do
      add(("hockles, friction %g"):format(friction), hockle,
        { dt = dt, friction = friction, turns = 8, segments = 150 })
      add(("knot drawn tight, friction %g"):format(friction), knot,
        { dt = dt, friction = friction, pull = 0.24, segments = 200 })
    end
    add("arch snaps through", snap, { dt = dt, segments = 60 })
    add("whip", whip, { dt = dt, segments = 100 })
    add("twist wave", wave, { dt = dt, segments = 50 })
    add("spun at 50 turns/s", spin, { dt = dt, segments = 50 })
    add("spun at 50 turns/s, frames", spin, { dt = dt, segments = 50, rest = "path" })
  end
end

return twists
