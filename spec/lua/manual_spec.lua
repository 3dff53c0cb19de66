-- SPDX-License-Identifier: GPL-3.0-or-later
-- Pages of the manual are listed, and what is listed is there.
local lfs = require "lfs"
local sw = require "softworld"

describe("manual", function()
  local listed = {}
  for _, name in ipairs(require "softworld.manual") do listed[name] = true end

  it("lists every page of its folder", function()
    for file in lfs.dir "lua/softworld/manual" do
      local name = file:match "^(.+)%.lua$"
      if name and name ~= "init" then assert.is_true(listed[name] or false, name .. " is not listed") end
    end
  end)

  it("shows each page, of lines that fit a terminal", function()
    for name in pairs(listed) do
      local shown, print_before = {}, print
      _G.print = function(...) shown[#shown + 1] = table.concat({ ... }, "\t") end
      local fine, reason = pcall(sw.help, name)
      _G.print = print_before
      assert.is_true(fine, tostring(reason))
      local text = table.concat(shown, "\n")
      assert.is_true(#text > 100, name)
      for line in text:gmatch "[^\n]+" do assert.is_true(#line <= 110, name .. ": " .. line) end
    end
  end)
end)
