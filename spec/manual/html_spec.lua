-- SPDX-License-Identifier: GPL-3.0-or-later
-- make manual: every page is written, and every link has its target in the folder.
local here = debug.getinfo(1, "S").source:match "^@(.*)/[^/]*$" or "spec/manual"
local program = dofile(here .. "/../host/program.lua")
local lfs = require "lfs"
local manual = require "softworld.manual"
local topics = require "softworld.prompt.topics"

describe("make manual", function()
  local folder, pages

  setup(function()
    folder, pages = program.folder() .. "/html", {}
    local _, err, code = program.run{ "scripts/manual.lua", "folder=" .. folder }
    assert(code == 0, err)
    for file in lfs.dir(folder) do
      if file:find "%.html$" then pages[file] = program.read(folder .. "/" .. file) end
    end
  end)
  teardown(program.clean)

  it("writes an index, all pages and all parameters", function()
    local index = pages["index.html"]
    for _, group in ipairs(manual.groups) do
      for _, name in ipairs(group[2]) do
        assert.is_truthy(pages[name .. ".html"], name)
        assert.is_truthy(index:find('href="' .. name .. '.html"', 1, true), name)
      end
    end
    for _, group in ipairs(topics.reference()) do
      local page = pages["ref_" .. group[1] .. ".html"]
      for _, name in ipairs(group[2]) do
        assert.is_truthy(page:find('<h2 id="' .. name .. '">', 1, true), name)
        for _, part in ipairs(topics.parts(name)) do
          for _, row in ipairs(part.rows or {}) do
            assert.is_truthy(page:find("<code>" .. row.name .. "</code>", 1, true), name .. ": " .. row.name)
          end
        end
      end
    end
  end)

  it("has no broken link and no link to the network", function()
    local count = 0
    for file, html in pairs(pages) do
      for target in html:gmatch '%f[%w]%l+="([^"]*%.%l+[^"]*)"' do
        if not target:find "^width=" then
          count = count + 1
          local name, anchor = target:match "^([^#]*)#?(.*)$"
          assert.is_nil(target:find("//", 1, true), file .. ": " .. target)
          assert.is_truthy(lfs.attributes(folder .. "/" .. name, "mode"), file .. ": " .. target)
          if anchor ~= "" then
            assert.is_truthy(pages[name]:find('id="' .. anchor .. '"', 1, true), file .. ": " .. target)
          end
        end
      end
    end
    assert.is_true(count > 1000, count)
    assert.is_nil(program.read(folder .. "/manual.css"):find("url(", 1, true))
  end)

  it("leaves no Markdown in the text", function()
    for file, html in pairs(pages) do
      local prose = html:gsub("<pre.-</pre>", ""):gsub("<code>.-</code>", "")
      for _, sign in ipairs{ "](", "**", "| ---", "```" } do
        assert.is_nil(prose:find(sign, 1, true), file .. ": " .. sign)
      end
    end
  end)

  it("reports missing tools and unknown options", function()
    local tools = program.folder()
    for _, tool in ipairs{ "mkdir", "cp", "mv", "rm" } do
      program.shell(("ln -s $(command -v %s) %s/"):format(tool, tools))
    end
    local _, err, code = program.run({ "scripts/manual.lua", "folder=" .. tools .. "/out" },
      { before = "PATH=" .. tools })
    assert.are.equal(1, code)
    assert.matches("sh scripts/setup.sh %-%-manual", err)
    _, err, code = program.run{ "scripts/manual.lua", "fodler=x" }
    assert.are.equal(2, code)
    assert.matches("^usage", err)
  end)
end)
