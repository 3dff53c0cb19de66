-- SPDX-License-Identifier: GPL-3.0-or-later
-- Temporary folders and commands for the specs of the scripts.
local tree = {}

tree.root = os.getenv "SOFTWORLD_ROOT"
tree.host = os.getenv "SOFTWORLD_BIN"

function tree.quote(text) return "'" .. text:gsub("'", "'\\''") .. "'" end

-- Makes a new folder with files = { ["path/in/it"] = text }. Its name has a blank on purpose.
function tree.make(files)
  local pipe = io.popen "mktemp -d '/tmp/soft world.XXXXXX'"
  local folder = pipe:read "l"
  pipe:close()
  for path, text in pairs(files) do tree.write(folder .. "/" .. path, text) end
  return folder
end

function tree.write(path, text)
  os.execute("mkdir -p " .. tree.quote(path:match "^(.*)/"))
  local f = assert(io.open(path, "w"))
  f:write(text)
  f:close()
end

function tree.remove(folder) os.execute("rm -rf " .. tree.quote(folder)) end

-- Returns everything that the command prints, and its exit status.
function tree.run(command)
  local pipe = io.popen("(" .. command .. ") 2>&1")
  local text = pipe:read "a"
  local _, _, status = pipe:close()
  return text, status
end

return tree
