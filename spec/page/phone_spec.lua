-- SPDX-License-Identifier: GPL-3.0-or-later
-- The player in the narrow window of a phone: nothing covers anything else.
local browser = require "spec.page.browser"
local files = require "spec.output.files"
local runs = require "spec.page.runs"
local sw = require "softworld"

describe("the player in a narrow window", function()
  local folder = files.folder()
  teardown(function() files.remove(folder) end)
  local run = runs.laying { name = "phone", wall = "wall", wire = "wire", note = "note" }
  sw.report { run, path = folder .. "/phone.html" }

  for _, width in ipairs{ 420, 640, 900 } do
    it(("of %d pixels shows its clock, its slider and its buttons"):format(width), function()
      local page <close> = setmetatable({ browser = browser.open(width, 800) },
        { __close = function(self) self.browser:close() end })
      page.browser:go("file://" .. folder .. "/phone.html")
      local covered = page.browser:run [[
        const wrong = [];
        const parts = ".clock, .track, #transport select, .buttons, #views, #tools";
        const list = [...document.querySelectorAll(parts)];
        const box = (e) => e.getBoundingClientRect();
        for (const a of list) for (const b of list) if (a !== b) {
          const p = box(a), q = box(b);
          if (Math.min(p.right, q.right) - Math.max(p.left, q.left) > 0.5 &&
            Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 0.5) wrong.push(a.className + a.id);
        }
        for (const e of list) if (e.scrollWidth > e.clientWidth + 1) wrong.push("cut: " + e.className + e.id);
        if (list.length < 6) wrong.push("missing");
        if (box(document.querySelector(".track")).width < 100) wrong.push("short slider");
        return wrong.join(" ");]]
      assert.equal("", covered)
    end)
  end
end)
