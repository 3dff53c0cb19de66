-- SPDX-License-Identifier: GPL-3.0-or-later
-- run.sh and test.sh on a simulated machine, with fake commands: id, dpkg-query, apt-get.
local tree = require "house.tree"

-- Commands that the scripts may use: a bare Debian has all of them.
local BASE = "sh dirname date cat sort tail mktemp awk sed env rm mkdir nproc"

describe("set-up", function()
  local folder

  -- options: uid, installed ("all" or a list of names), sudo ("works" or "refuses"),
  -- update and install (exit statuses of apt-get)
  local function machine(options)
    folder = tree.make {
      ["bin/id"] = "#!/bin/sh\necho " .. options.uid .. "\n",
      ["bin/dpkg-query"] = [[#!/bin/sh
shift 2
here=$(dirname "$0")/..
for name in "$@"; do
  if grep -q -x -e "$name" -e all "$here/installed"; then printf '%s=installed ' "$name"; fi
done
]],
      ["bin/apt-get"] = ([[#!/bin/sh
here=$(dirname "$0")/..
echo "$DEBIAN_FRONTEND $*" >>"$here/calls"
case "$*" in
  *update*) echo "E: no server"; exit %d ;;
  *install*) echo "Setting up things"; for name in "$@"; do echo "$name" >>"$here/installed"; done
    exit %d ;;
esac
]]):format(options.update or 0, options.install or 0),
      installed = (options.installed or "") .. "\n",
      calls = "",
    }
    if options.sudo == "works" then
      tree.write(folder .. "/bin/sudo", '#!/bin/sh\n[ "$1" = -n ] && exit 0\nexec "$@"\n')
    elseif options.sudo == "refuses" then
      tree.write(folder .. "/bin/sudo", "#!/bin/sh\nexit 1\n")
    end
    tree.run(([[cd %s && cp -r %s/scripts . && chmod +x bin/*
      for tool in %s grep; do ln -s "$(command -v $tool)" bin/; done]]):format(tree.quote(folder),
      tree.quote(tree.root), BASE))
  end
  local function run(script)
    return tree.run(("cd / && PATH=%s sh %s </dev/null"):format(tree.quote(folder .. "/bin"),
      tree.quote(folder) .. "/scripts/" .. script))
  end
  local function calls()
    local f = io.open(folder .. "/calls")
    local text = f:read "a"
    f:close()
    return text
  end
  after_each(function() tree.remove(folder) end)

  for _, script in ipairs { "run.sh", "test.sh" } do
    it(script .. " without root and sudo names what to install, once, and stops", function()
      machine { uid = 1000, installed = "gcc\nmake" }
      local text, status = run(script)
      assert.equal(1, status)
      local command = text:match "\n  (apt%-get update && apt%-get install [^\n]*)\n"
      assert.truthy(command, text)
      for _, name in ipairs { "lua5.4", "libgsl-dev", "povray" } do
        assert.truthy((command .. " "):find(" " .. name .. " ", 1, true), command)
      end
      assert.falsy(command:find(" gcc ", 1, true), "gcc is there already")
      assert.equal(script == "test.sh", command:find("lua-busted", 1, true) ~= nil)
      assert.equal("", calls())
    end)
  end
  it("uses sudo when it is allowed to", function()
    machine { uid = 1000, sudo = "works" }
    local text, status = run "setup.sh"
    assert.equal(0, status, text)
    assert.truthy(calls():find("noninteractive .* install"), calls())
  end)
  it("gives the command with sudo when sudo wants a password and nobody can type it", function()
    machine { uid = 1000, sudo = "refuses" }
    local text, status = run "setup.sh"
    assert.equal(1, status)
    assert.truthy(text:find("\n  sudo apt-get update && sudo apt-get install", 1, true), text)
    assert.equal("", calls())
  end)
  it("calls nothing when nothing is missing", function()
    machine { uid = 1000, installed = "all" }
    local text, status = run "setup.sh --lint"
    assert.equal(0, status, text)
    assert.equal("", calls())
  end)
  it("installs exactly the missing packages, in one call and without questions", function()
    machine { uid = 0, installed = "gcc\nmake\nlibc6-dev\npkg-config\nliblua5.4-dev\nlibgsl-dev\n"
      .. "libccd-dev\nlibassimp-dev\nlibqhull-dev\nlibsuitesparse-dev\nlibreadline-dev\n"
      .. "libnlopt-dev\n"
      .. "zlib1g-dev\nlibcivetweb-dev\nesbuild\nlibjs-three\nlibjs-dygraphs\nfonts-dejavu-core\n"
      .. "gnuplot-nox\npovray\nffmpeg\nlua5.4" }
    local text, status = run "setup.sh --test"
    assert.equal(0, status, text)
    local update, install, rest = calls():match "^([^\n]*)\n([^\n]*)\n(.*)$"
    assert.equal("", rest)
    assert.truthy(update:find "^noninteractive .* update$", update)
    -- lua5.4 is named again: lua-busted alone would accept another Lua
    assert.truthy(install:find(" install --no-install-recommends cmark-gfm lua-busted lua-check "
      .. "lua-filesystem chromium chromium-driver lua-socket lua-dkjson slurmctld slurmd "
      .. "slurm-client munge lua5.4", 1, true), install)
    assert.truthy(install:find(" -y ", 1, true), install)
  end)
  it("says that the package lists could not be refreshed, and still tries", function()
    machine { uid = 0, update = 100 }
    local text, status = run "setup.sh"
    assert.equal(0, status, text)
    assert.truthy(text:find("apt-get update failed", 1, true), text)
    assert.truthy(text:find("E: no server", 1, true), text)
  end)
  it("stops with the command when apt-get cannot install", function()
    machine { uid = 0, install = 100 }
    local text, status = run "setup.sh"
    assert.equal(1, status)
    assert.truthy(text:find("apt-get could not install what is missing", 1, true), text)
    assert.truthy(text:find("\n  apt-get update && apt-get install", 1, true), text)
  end)
end)
