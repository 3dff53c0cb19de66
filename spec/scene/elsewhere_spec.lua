-- SPDX-License-Identifier: GPL-3.0-or-later
-- A process of one scene that uses a gripper of another one: no time passes there meanwhile.
local sw = require "softworld"

describe("a gripper of another scene than the process", function()
  it("takes no time, and says so where a call needs time", function()
    local scene, other, found = sw.scene { name = "own" }, sw.scene { name = "other" }, 0
    scene:wire { cable = "GXL 1.5", segments = 8, from = { 0, 0, 0 }, to = { 0.2, 0, 0 } }
    local g = scene:gripper { name = "hand", at = { 0.1, 0.05, 0.05 }, rotation = { 1, 0, 0, 0 } }
    other:process(function()
      for _, call in ipairs { { "wait", 0.1 }, { "approach", { 0, 0, 0.1 } }, { "press", { force = 1 } } } do
        local _, why = pcall(g[call[1]], g, call[2])
        local asked = ("gripper:%s takes time of scene 'own', but this is a process of scene 'other'; call "
          .. "it in a process of scene 'own'"):format(call[1])
        assert.truthy(tostring(why):find(asked, 1, true), why)
        found = found + 1
      end
      g:move { by = { 0, 0, 0.1 }, duration = 0.2 }
      scene:run { duration = 0.2 } -- this scene may run here
    end)
    other:run {}
    assert.equal(3, found)
    assert.is_true(math.abs(g:position()[3] - 0.15) < 1e-9)
  end)
end)
