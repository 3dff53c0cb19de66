-- SPDX-License-Identifier: GPL-3.0-or-later
-- Only one process at a time works on a study whose tasks are on a cluster, on whatever machine it runs.
local core = require("softworld").core
local owner = require "softworld.study.owner"
local program = require "host.program"
local sends = require "softworld.study.sends"

-- Returns what f writes to stderr, and its results.
local function told(f)
  local real, lines = io.stderr, {}
  io.stderr = { write = function(_, ...) lines[#lines + 1] = table.concat { ... } end } -- luacheck: ignore
  local found = table.pack(pcall(f))
  io.stderr = real -- luacheck: ignore
  return table.concat(lines), table.unpack(found, 1, found.n)
end

describe("the owner of a study", function()
  local patience = owner.PATIENCE
  teardown(function()
    owner.PATIENCE = patience
    program.clean()
  end)

  it("is one process, until it releases the study", function()
    local folder = program.folder()
    local first = owner.claim("s", folder)
    assert.error_matches(function() owner.claim("s", folder) end, "already works with its journal")
    first:release()
    assert.is_nil(core.kind(folder .. "/owner"))
    owner.claim("s", folder):release()
  end)

  it("is replaced when its process on this machine is gone, or its process id belongs to another "
    .. "process", function()
    local folder = program.folder()
    local host = sends.who():match "^(.*)%.%d+$"
    for _, text in ipairs { host .. ".999999999 12345 3\n", host .. ".1 999999999999 3\n" } do
      program.write(folder .. "/owner", text)
      local said, fine, held = told(function() return owner.claim("s", folder) end)
      assert.is_true(fine, held)
      assert.equal("", said)
      held:release()
    end
  end)

  it("on another machine is waited for: replaced when it is silent, kept when it gives a sign", function()
    local folder = program.folder()
    owner.PATIENCE = 1
    program.write(folder .. "/owner", "elsewhere.77 12345 3\n")
    local said, fine, held = told(function() return owner.claim("s", folder) end)
    assert.is_true(fine, held)
    assert.truthy(said:find("study 's': .* says that process elsewhere.77 works on it; looking for"), said)
    held:release()
    owner.PATIENCE = 20
    program.write(folder .. "/owner", "elsewhere.77 12345 3\n")
    os.execute(("(sleep 0.3; echo elsewhere.77 12345 4 >%s/owner) &"):format(folder))
    local _, good, why = told(function() return owner.claim("s", folder) end)
    assert.is_false(good)
    assert.truthy(why:find("process elsewhere.77 already works with its journal", 1, true), why)
  end)

  it("stops when it finds that another process has taken over", function()
    local folder = program.folder()
    local held = owner.claim("s", folder)
    held.at = held.at - 100
    held:beat()
    assert.truthy(program.read(folder .. "/owner"):find " 1\n$")
    program.write(folder .. "/owner", "elsewhere.77 12345 3\n")
    held.at = held.at - 100
    assert.error_matches(function() held:beat() end, "another process has taken over its journal")
    held:release()
    assert.equal("elsewhere.77 12345 3\n", program.read(folder .. "/owner")) -- not ours to remove
  end)

  it("needs a folder that can be written", function()
    assert.error_matches(function() owner.claim("s", "/nowhere") end,
      "study 's': cannot write /nowhere/owner: No such file or directory")
  end)
end)

describe("core.create", function()
  it("makes a file only where there is none", function()
    local path = program.folder() .. "/a"
    assert.is_true(core.create(path, "one"))
    assert.same({ nil, "busy" }, { core.create(path, "two") })
    assert.equal("one", program.read(path))
    assert.is_nil((core.create("/dev/full/x", "")))
  end)
end)
