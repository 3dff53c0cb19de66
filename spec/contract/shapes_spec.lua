-- SPDX-License-Identifier: GPL-3.0-or-later
-- What every kind of obstacle must fulfil besides the queries of spec/shape: how it is drawn, where it
-- sticks out, that an arm notices it. A new kind is covered by its file and its line in list.def.
local sw = require "softworld"
local files = require "output.files"
local povscene = require "softworld.output.povscene"
local samples = require "contract.samples"
local solid = require "softworld.output.solid"
local tools = require "shape.tools"
local view = require "softworld.output.view"
local vec = require "softworld.vec"

local function corner(v, i) return { v[3 * i + 1], v[3 * i + 2], v[3 * i + 3] } end

for _, kind in ipairs(samples.registry.shapes) do
  describe("shape " .. kind.name, function()
    local args = samples.obstacle(kind)
    local shape = sw.core.shape(args)

    it("has a summary and samples of wrong arguments", function()
      assert.is_true(#kind.summary > 10)
      assert.is_true(#kind.wrong > 0)
    end)

    if not kind.flat then
      it("is drawn as a closed surface that lies on the shape's own and faces outwards", function()
        local drawn = solid.triangles(args, 64)
        local v = drawn.vertices
        local low, high = shape:bounds()
        for i = 0, #v // 3 - 1 do
          local p = corner(v, i)
          local gap = shape:distance(p)
          assert.is_true(math.abs(gap) < 1e-7, ("%g m off"):format(gap)) -- files hold 32-bit floats
          for k = 1, 3 do assert.is_true(p[k] > low[k] - 1e-7 and p[k] < high[k] + 1e-7) end
        end
        local volume = tools.closed_volume(drawn)
        -- the volume of the shape's inside, on a grid of 40 in each direction; the 64 chords around lose
        -- 0.3 %, the grid is right within 1 %
        local inside, n, cell = 0, 40, 1
        for k = 1, 3 do cell = cell * (high[k] - low[k]) / n end
        for i = 0, n ^ 3 - 1 do
          local at = { i % n, i // n % n, i // (n * n) }
          for k = 1, 3 do at[k] = low[k] + (at[k] + 0.5) / n * (high[k] - low[k]) end
          if shape:distance(at, 0) then inside = inside + cell end
        end
        assert.near(inside, volume, 0.02 * inside)
      end)
    end

    it("is in pictures and in ParaView's files", function()
      local scene = samples.wire{ segments = 4, more = { from = { 0, 0, 2 }, to = { 1, 0, 2 } } }
      scene:obstacle(samples.obstacle(kind))
      local run = scene:run{ duration = 0.01 }
      local drawn = run:document()
      local look = { size = 2, smallest_grip = 0.01, thickness = 1 }
      look.camera = view.camera(drawn, 1, nil, {})
      local more = #povscene.text(drawn, drawn.frames[1], look)
      drawn = setmetatable({ obstacles = {} }, { __index = drawn })
      more = more - #povscene.text(drawn, drawn.frames[1], look)
      assert.is_true(more > 100, more .. " letters")
      local folder = files.folder()
      run:vtk(folder .. "/a.pvd")
      local file = assert(io.open(folder .. "/a.vtk/obstacles_00000.vtp"))
      assert.is_true(tonumber(file:read("a"):match 'NumberOfPolys="(%d+)"') >= 2)
      file:close()
      files.remove(folder)
    end)

    -- Places of its surface are put in the way of a gripper's arm and face it.
    it("gives an event when an arm runs into it, from any side", function()
      local corners = kind.flat and { 0, 0, 0 } or (shape:triangles(8))
      for _, share in ipairs{ 0, 0.3, 0.7, 0.95 } do
        local place = corner(corners, math.floor(share * (#corners // 3)))
        local _, normal = shape:distance(place)
        local axis = vec.cross(normal, { -1, 0, 0 })
        local turn = vec.norm(axis) > 1e-9 and { axis = axis, angle = math.acos(-normal[1]) }
          or { axis = { 0, 0, 1 }, angle = normal[1] < 0 and 0 or math.pi }
        local scene = sw.scene{ gravity = { 0, 0, 0 } }
        local wire = scene:wire{ E = 2e7, density = 1200, radius = 0.003, from = { 0, 0, 0 },
          to = { 0.2, 0, 0 } }
        local g = scene:gripper{ pads = { width = 0.02, opening = 0.009 },
          arm = { radius = 0.01, length = 0.1 } }
        local obstacle = samples.obstacle(kind)
        obstacle.rotation = turn
        local made = scene:obstacle(obstacle)
        local _, q = made:pose()
        made:pose(vec.sub({ 0.25, 0, 0.06 }, vec.rotate(q, place)), q)
        scene:process(function()
          g:grasp(wire, { s = 0.15, approach = "plates", force = 2 })
          g:move{ by = { 0.11, 0, 0 }, speed = 0.5 }
        end)
        scene:run{ dt = 0.01 }
        local noticed
        for _, e in ipairs(g.events) do noticed = noticed or e.kind == "crash" and e.obstacle == made.name end
        assert.is_true(noticed, ("place %g, %g, %g"):format(table.unpack(place)))
      end
    end)
  end)
end
