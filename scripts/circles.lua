-- SPDX-License-Identifier: GPL-3.0-or-later
-- Finds circles of files in csrc: files that need each other's functions, directly or through other files.
-- Such a file cannot be read alone.
local circles = {}

-- Returns code without comments and strings; line starts stay.
local function bare(code)
  return (code:gsub("/%*.-%*/", " "):gsub("//[^\n]*", ""):gsub('\\"', ""):gsub('"[^"\n]*"', '""'))
end

-- Returns the public functions (lsw_..., sw_...) that the code defines: { [name] = true }.
local function defined(code)
  local names = {}
  for head, name in ("\n" .. code):gmatch "\n(%a[%w_ %*]-)%f[%w_](l?sw_[%w_]+)%b()%s*{" do
    if not head:find "^static%f[%W]" then names[name] = true end
  end
  return names
end

-- Returns { [file] = { [file that it needs] = a function of that file } } for { [file] = code }.
local function needs_of(codes)
  local home, needs = {}, {}
  for file, code in pairs(codes) do
    for name in pairs(defined(code)) do home[name] = file end
  end
  for file, code in pairs(codes) do
    needs[file] = {}
    for word in code:gmatch "%f[%w_]l?sw_[%w_]+" do
      if home[word] and home[word] ~= file then needs[file][home[word]] = word end
    end
  end
  return needs
end

local function sorted_keys(set)
  local keys = {}
  for key in pairs(set) do keys[#keys + 1] = key end
  table.sort(keys)
  return keys
end

--- Returns the circles among files, { { file, ... }, ... }, by Tarjan's algorithm (SIAM J. Comput. 1, 1972),
-- and what each file needs, { [file] = { [other file] = a function of it } }. codes: { [file] = its text }.
function circles.find(codes)
  local clean = {}
  for file, code in pairs(codes) do clean[file] = bare(code) end
  local needs = needs_of(clean)
  local order, low, stack, waiting, count, found = {}, {}, {}, {}, 0, {}
  local function visit(file)
    count = count + 1
    order[file], low[file] = count, count
    stack[#stack + 1], waiting[file] = file, true
    for _, other in ipairs(sorted_keys(needs[file])) do
      if not order[other] then
        visit(other)
        low[file] = math.min(low[file], low[other])
      elseif waiting[other] then
        low[file] = math.min(low[file], order[other])
      end
    end
    if low[file] ~= order[file] then return end
    local circle = {}
    repeat
      local member = table.remove(stack)
      waiting[member] = nil
      circle[#circle + 1] = member
    until member == file
    table.sort(circle)
    if #circle > 1 then found[#found + 1] = circle end
  end
  for _, file in ipairs(sorted_keys(needs)) do
    if not order[file] then visit(file) end
  end
  return found, needs
end

return circles
