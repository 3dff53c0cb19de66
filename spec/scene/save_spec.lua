-- SPDX-License-Identifier: GPL-3.0-or-later
-- Scenes in files: a run that goes on from a file gives the same bits as one that was not interrupted.
package.path = "./?.lua;" .. package.path
local sw = require "softworld"
local saving = require "spec.scene.saving"
local file, same = saving.temporary, saving.same

after_each(saving.clean)

describe("a saved scene goes on with the same bits:", function()
  for _, case in ipairs(saving.cases) do
    it(case.name, function()
      local path, plain = file(), case.build()
      case.before(plain)
      case.after(plain)
      local wanted = saving.all(plain)
      assert.is_true(#wanted > 50)

      local saved = case.build()
      case.before(saved)
      local here = saving.all(saved) -- reading builds an edited scene's system: the file is of another one
      saved = case.build()
      case.before(saved)
      saved:save(path)
      local loaded = sw.load(path)
      same(here, saving.all(loaded))
      case.after(saved) -- saving changes nothing
      same(wanted, saving.all(saved))
      loaded = sw.load(path)
      case.after(loaded)
      same(wanted, saving.all(loaded))

      local resumed = case.build()
      assert.is_true(resumed:resume(path))
      case.after(resumed)
      same(wanted, saving.all(resumed))
      assert.are.equal(table.concat(plain:names(), " "), table.concat(resumed:names(), " "))
    end)

    it(case.name .. ", edited just before", function()
      -- the file also holds what a scene remembers of its last system; building the system again would not
      -- do
      local function edited()
        local scene = case.build()
        case.before(scene)
        scene:obstacle{ name = "distant", shape = "sphere", radius = 0.1, at = { 0, 0, -50 } }
        return scene
      end
      local path, plain, saved = file(), edited(), edited()
      saved:save(path)
      local ran = saved.time > 0 -- before the first run, the resuming script makes everything
      case.after(plain)
      case.after(saved)
      local wanted = saving.all(plain)
      same(wanted, saving.all(saved))
      local loaded, resumed = sw.load(path), (ran and case.build or edited)()
      case.after(loaded)
      same(wanted, saving.all(loaded))
      resumed:resume(path)
      case.after(resumed)
      same(wanted, saving.all(resumed))
    end)
  end
end)
