-- SPDX-License-Identifier: GPL-3.0-or-later
-- Temporary folders, and a system with fewer programs and modules, for the specs.

local files = {}

local count = 0

local function quote(text) return "'" .. text:gsub("'", "'\\''") .. "'" end

--- Makes a fresh, empty folder.
function files.folder()
  local name = os.tmpname()
  os.remove(name)
  count = count + 1
  name = name .. ".spec" .. count
  assert(os.execute("mkdir " .. quote(name)))
  return name
end

function files.remove(folder)
  assert(folder:find("%.spec%d+$"))
  os.execute("rm -rf " .. quote(folder))
end

--- Returns the names in a folder, also hidden ones, sorted.
function files.list(folder)
  local names = {}
  local pipe = io.popen("ls -A " .. quote(folder))
  for name in pipe:lines() do names[#names + 1] = name end
  pipe:close()
  table.sort(names)
  return names
end

local function replacing(owner, key, value, body)
  local old = owner[key]
  owner[key] = value
  local ok, why = pcall(body)
  owner[key] = old
  if not ok then error(why, 0) end
end

--- Runs a function while no program is on the search path.
function files.without_programs(body)
  local popen = io.popen
  replacing(io, "popen", function(command, mode)
    return popen("PATH=/nonexistent; " .. command, mode)
  end, body)
end

--- Runs a function while LuaFileSystem cannot be loaded.
function files.without_lfs(body)
  local loaded = package.loaded.lfs
  package.loaded.lfs = nil
  replacing(package.preload, "lfs", function() error "not here" end, function()
    replacing(package.loaded, "lfs", nil, body)
  end)
  package.loaded.lfs = loaded
end

--- Returns width and height of a PNG file, from its header.
function files.png_size(path)
  local file = assert(io.open(path, "rb"))
  local head = file:read(24)
  file:close()
  assert(head:sub(1, 8) == "\137PNG\r\n\26\n", "not a PNG file")
  local width, height = string.unpack(">I4I4", head, 17)
  return width, height
end

--- Returns the elements of an XML text as { tag=, at = attributes, text= } in order; raises an error if tags
-- do not pair up.
function files.xml(text)
  local list, open = {}, {}
  text = text:gsub("<%?.-%?>", ""):gsub("<!%-%-.-%-%->", ""):gsub("<!DOCTYPE.->", "")
  for slash, tag, rest, body in text:gmatch("<(/?)([%w:]+)(.-)>([^<]*)") do
    if slash == "/" then
      local last = table.remove(open)
      assert(last and last.tag == tag, "unpaired </" .. tag .. ">")
    else
      local element = { tag = tag, at = {}, text = body }
      for key, value in rest:gmatch('([%w:_-]+)="([^"]*)"') do element.at[key] = value end
      list[#list + 1] = element
      if rest:sub(-1) ~= "/" then open[#open + 1] = element end
    end
  end
  assert(#open == 0, "unclosed element")
  return list
end

--- Returns the numbers in a text.
function files.numbers(text)
  local list = {}
  for word in text:gmatch("%S+") do list[#list + 1] = assert(tonumber(word), word) end
  return list
end

return files
