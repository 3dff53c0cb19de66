-- SPDX-License-Identifier: GPL-3.0-or-later
-- Checks the house rules (scripts/house_rules.lua), and runs luacheck and clang-tidy.
--   lua5.4 scripts/lint.lua [--only CHECK,CHECK] [tree]
-- Checks: layout spdx includes circles calls headers length luacheck tidy. A finding is "file:line: what is
-- wrong; what to do". The exit status is 0 if there is none. Long files that are not headers give a warning
-- only.

local here = arg[0]:match "^(.*)/" or "."
local rules = dofile(here .. "/house_rules.lua")

-- Tools ----------------------------------------------------------------------

local findings = 0
local function finding(file, line, text, ...)
  findings = findings + 1
  print(("%s:%d: %s"):format(file, line, text:format(...)))
end

local function quote(text) return "'" .. text:gsub("'", "'\\''") .. "'" end

local function output_of(command)
  local pipe = assert(io.popen(command))
  local text = pipe:read "a"
  return text, pipe:close()
end

local function lines_of(path)
  local lines = {}
  for line in io.lines(path) do lines[#lines + 1] = line end
  return lines
end

-- Returns the files below the given places that exist, by name patterns of find, sorted.
local function files(places, ...)
  local names = {}
  for _, name in ipairs { ... } do names[#names + 1] = "-name " .. quote(name) end
  local text = output_of(("find %s -type f \\( %s \\) 2>/dev/null | LC_ALL=C sort"):format(places,
    table.concat(names, " -o ")))
  local list = {}
  for file in text:gmatch "[^\n]+" do list[#list + 1] = file end
  return list
end

-- Runs a checker that prints its own findings; prints its output only if it fails.
local function checker(name, command)
  if not os.execute("command -v " .. name .. " >/dev/null 2>&1") then
    finding("scripts/lint.lua", 1, "%s is not installed; sh scripts/setup.sh --lint", name)
    return
  end
  local text, ok = output_of(command .. " 2>&1")
  if ok then return end
  findings = findings + 1
  print(text)
end

-- Returns code without comments and without the contents of strings; line ends stay.
local function bare_code(text)
  local out, i = {}, 1
  local function blank(part) out[#out + 1] = part:gsub("[^\n]", " ") end
  while i <= #text do
    local two, one = text:sub(i, i + 1), text:sub(i, i)
    local stop
    if two == "/*" then
      stop = select(2, text:find("*/", i + 2, true)) or #text
      blank(text:sub(i, stop))
    elseif two == "//" then
      stop = (text:find("\n", i, true) or #text + 1) - 1
      blank(text:sub(i, stop))
    elseif one == '"' or one == "'" then
      stop = i + 1
      while stop <= #text and text:sub(stop, stop) ~= one and text:sub(stop, stop) ~= "\n" do
        stop = stop + (text:sub(stop, stop) == "\\" and 2 or 1)
      end
      blank(text:sub(i, stop))
    else
      stop = (text:find("[/\"']", i + 1) or #text + 1) - 1
      out[#out + 1] = text:sub(i, stop)
    end
    i = stop + 1
  end
  return table.concat(out)
end

-- Checks ---------------------------------------------------------------------

local check = {}

function check.layout()
  for entry in output_of("ls"):gmatch "[^\n]+" do
    if not (" " .. rules.TOP .. " build out "):find(" " .. entry .. " ", 1, true)
      and not entry:find "^build%-" then
      finding(entry, 1, "does not belong on the top level (%s)", rules.TOP)
    end
  end
end

function check.spdx()
  local all = files("Makefile csrc lua scripts spec examples .ci", "*.c", "*.h", "*.def", "*.lua",
    "*.sh", "Makefile", "run", "*.supp")
  for _, file in ipairs(all) do
    local first, second = table.unpack(lines_of(file))
    local line = first and first:sub(1, 2) == "#!" and second or first
    if not (line or ""):find(rules.LICENCE, 1, true) then
      finding(file, 1, "no licence line; begin the file with a comment \"%s\"", rules.LICENCE)
    end
  end
end

local function set_of(list)
  local set = {}
  for _, item in ipairs(list) do set[item] = true end
  return set
end

local function members_of(room)
  local set = {}
  for _, list in ipairs(files("csrc/" .. room, "*.def")) do
    for _, line in ipairs(lines_of(list)) do
      local name = line:match "^%s*X%(%s*([%w_]+)"
      if name then set[name] = true end
    end
  end
  return set
end

local inside = set_of(rules.INSIDE)

-- Checks an include of a header of csrc in file (csrc/room/stem.ext).
local function check_own_include(file, number, room, stem, included, members)
  local other, name = included:match "^([%w_]+)/(.+)$"
  local say = function(...) finding(file, number, ...) end
  if included:find "%.c$" then
    say("%s is included; share code through a header", included)
  elseif included == "softworld.h" then
    if not rules.USES_CORE[room] then
      say("%s includes softworld.h; include the headers of the rooms it needs", room)
    end
  elseif not other then
    say("\"%s\" names no room; write \"room/%s\"", included, included)
  elseif other == room then
    local base = name:match "^(.*)%.h$"
    if rules.FAMILIES[room] and base and members[room][base] and base ~= stem then
      say("member %s includes member %s of %s; what both need belongs into %s/%s.h or a helper file",
        stem, base, room, room, room)
    end
  elseif not rules.ROOMS[other] then
    say("%s is no room of csrc (rooms are listed in scripts/house_rules.lua)", other)
  elseif rules.USES_CORE[room] and other ~= "bind" then
    say("%s includes %s; it sees the core through softworld.h only", room, included)
  elseif not set_of(rules.ROOMS[room])[other] then
    say("%s may not include %s (it may: %s); move the code or pass the data in", room, included,
      #rules.ROOMS[room] > 0 and table.concat(rules.ROOMS[room], " ") or "nothing else")
  elseif not (rules.OPEN[other] == true or name == other .. ".h" or set_of(rules.OPEN[other] or {})[name]
      or inside[room] and inside[other]) then
    say("%s is private to %s; use %s/%s.h", included, other, other, other)
  end
end

-- Returns a chain of rooms that leads back to its first one by their rows, or nothing.
local function circle_of_rooms(rooms)
  local state = {}
  local function visit(room, path)
    path = path .. " -> " .. room
    if state[room] == "open" then return path:match("-> (" .. room .. " .*)$") end
    if state[room] then return end
    state[room] = "open"
    for _, other in ipairs(rooms[room]) do
      local found = visit(other, path)
      if found then return found end
    end
    state[room] = "done"
  end
  for room in pairs(rooms) do
    local found = visit(room, "")
    if found then return found end
  end
end

local function outside_rule(included)
  for _, rule in ipairs(rules.OUTSIDE) do
    if included:find(rule[1]) then return rule end
  end
end

local function check_outside_include(file, number, path, included)
  local rule = outside_rule(included)
  if not rule then return end
  for i = 2, #rule do
    if path:find(rule[i]) then return end
  end
  local where = table.concat(rule, " ", 2):gsub("[%%^$]", "")
  finding(file, number, "<%s> may be included only in: %s; call that adapter", included, where)
end

function check.includes()
  local members, includers = {}, {}
  local circle = circle_of_rooms(rules.ROOMS)
  if circle then
    finding("scripts/house_rules.lua", 1, "rooms include one another in a circle: %s", circle)
  end
  for room in pairs(rules.FAMILIES) do members[room] = members_of(room) end
  for _, file in ipairs(files("csrc", "*.c", "*.h", "*.def")) do
    local path = file:match "^csrc/(.*)$"
    local room, stem = path:match "^([%w_]+)/(.*)%.%w+$"
    if room and not rules.ROOMS[room] then
      finding(file, 1, "csrc/%s is no room; add it to ROOMS in scripts/house_rules.lua", room)
      room = nil
    end
    for number, line in ipairs(lines_of(file)) do
      local bracket, included = line:match "^%s*#%s*include%s*([<\"])([^>\"]+)[>\"]"
      if included then
        includers[included] = (includers[included] or 0) + 1
        if includers[included] - 1 == rules.MOST_INCLUDERS[included] then
          finding(file, number, "%s has more than %d includers; take what is needed from a narrow header",
            included, rules.MOST_INCLUDERS[included])
        end
        local own = bracket == '"' and not outside_rule(included)
        if not own then check_outside_include(file, number, path, included)
        elseif room then check_own_include(file, number, room, stem, included, members)
        elseif path == "softworld.h" and (included:find "^bind/" or included:find "^host/") then
          finding(file, number, "softworld.h knows neither bind nor host")
        end
      end
    end
  end
end

-- Finds calls of functions in rooms that are not in the file's row, however the function is declared.
local function check_room_calls(needs)
  local list = {}
  for file, others in pairs(needs) do
    local own = file:match "^csrc/([%w_]+)/"
    for other, name in pairs(others) do
      local room = other:match "^csrc/([%w_]+)/"
      local known = rules.ROOMS[own] and not rules.USES_CORE[own] and room ~= own
      if known and not set_of(rules.ROOMS[own])[room] then
        list[#list + 1] = { file, name, other }
      end
    end
  end
  table.sort(list, function(a, b) return a[1] .. a[2] < b[1] .. b[2] end)
  for _, it in ipairs(list) do
    finding(it[1], 1, "calls %s of %s, whose room it may not include; move the code or pass the data in",
      it[2], it[3])
  end
end

function check.circles()
  local codes = {}
  for _, file in ipairs(files("csrc", "*.c")) do
    codes[file] = "\n" .. table.concat(lines_of(file), "\n")
  end
  local found, needs = dofile(here .. "/circles.lua").find(codes)
  check_room_calls(needs)
  for _, circle in ipairs(found) do
    if #circle > rules.MOST_IN_CIRCLE then
      finding(circle[1], 1, "is in a circle of %d files (%d at most) that need one another: %s; "
        .. "move what all of them need into a file that needs none", #circle, rules.MOST_IN_CIRCLE,
        table.concat(circle, " "))
    end
  end
end

function check.calls()
  for _, file in ipairs(files("csrc", "*.c", "*.h")) do
    local path = file:match "^csrc/(.*)$"
    if not path:find "^host/" then
      local allowed, number = rules.CALLS_ALLOWED[path] or {}, 0
      for line in (bare_code(table.concat(lines_of(file), "\n")) .. "\n"):gmatch "([^\n]*)\n" do
        number = number + 1
        for before, word in line:gmatch "(.?)%f[%w_]([%a_][%w_]*)%s*%(" do
          -- x->open(...) and x.open(...) are members of structs.
          if rules.CALLS[word] and not allowed[word] and not before:find "[.>]" then
            finding(file, number, "calls %s; %s", word, rules.CALLS[word])
          end
        end
        for word in line:gmatch "%f[%w_](std[oe][ur][tr])%f[^%w_]" do
          finding(file, number, "uses %s; %s", word, rules.CALLS.printf)
        end
      end
    end
  end
end

function check.headers()
  local list = {}
  for _, file in ipairs(files("csrc", "*.h")) do list[#list + 1] = quote(file) end
  if #list == 0 then return end
  local text, ok = output_of(
    "gcc -std=c11 -D_GNU_SOURCE -Wall -Wextra -Werror -fsyntax-only -Icsrc $(pkg-config --cflags lua5.4) "
      .. "-x c " .. table.concat(list, " ") .. " 2>&1")
  if ok then return end
  findings = findings + 1
  print(text .. "a header must compile alone: let it include what it uses")
end

function check.length()
  for _, file in ipairs(files("csrc lua scripts spec examples", "*.c", "*.h", "*.lua", "*.sh")) do
    local count = #lines_of(file)
    if count > rules.LONGEST then
      print(("%s:%d: warning: %d lines; look for a part that can stand alone"):format(file,
        rules.LONGEST, count))
    end
    if file:find "%.h$" and count > rules.LONGEST_HEADER then
      finding(file, rules.LONGEST_HEADER, "has %d lines, %d at most; split it by what one includes it for",
        count, rules.LONGEST_HEADER)
    end
  end
end

function check.luacheck()
  local places = {}
  for _, place in ipairs { "lua", "scripts", "spec", "examples" } do
    if #files(place, "*.lua") > 0 then places[#places + 1] = place end
  end
  if #places == 0 then return end
  checker("luacheck", "luacheck --no-color -q " .. table.concat(places, " "))
end

-- Runs clang-tidy with the checks of .clang-tidy: one process for each file, as many at a time as processors.
function check.tidy()
  if #files("csrc", "*.c") == 0 then return end
  checker("clang-tidy", [[
    flags="-std=c11 -D_GNU_SOURCE -Icsrc $(pkg-config --cflags lua5.4 gsl ccd assimp)"
    find csrc -name '*.c' -print0 | LC_ALL=C sort -z | xargs -0 -n 1 -P "$(nproc)" sh -c '
      out=$(clang-tidy --quiet --warnings-as-errors="*" "$1" -- $0 2>&1) && exit 0
      printf "%s\n" "$out" | grep -v -e "warnings\{0,1\} generated" -e "warnings treated as errors"
      exit 1' "$flags"]])
end

-- Main -----------------------------------------------------------------------

local ORDER = { "layout", "spdx", "includes", "circles", "calls", "headers", "length", "luacheck", "tidy" }
local wanted, tree = nil, nil
local i = 1
while arg[i] do
  if arg[i] == "--only" then
    wanted = set_of {}
    for name in (arg[i + 1] or ""):gmatch "[^,]+" do wanted[name] = true end
    i = i + 1
  else
    tree = arg[i]
  end
  i = i + 1
end
for name in pairs(wanted or {}) do
  if not check[name] then
    io.stderr:write("no check named ", name, "; there are: ", table.concat(ORDER, " "), "\n")
    os.exit(2)
  end
end

-- Plain Lua cannot change the directory, so the script starts itself again in the tree.
if tree then
  local script = arg[0]:sub(1, 1) == "/" and quote(arg[0]) or '"$OLDPWD"/' .. quote(arg[0])
  local only = {}
  for name in pairs(wanted or {}) do only[#only + 1] = name end
  local _, _, status = os.execute(("cd %s && lua5.4 %s %s"):format(quote(tree), script,
    wanted and "--only " .. table.concat(only, ",") or ""))
  os.exit(status)
end
for _, name in ipairs(ORDER) do
  if not wanted or wanted[name] then check[name]() end
end
if findings > 0 then
  print(("lint: %d finding%s"):format(findings, findings == 1 and "" or "s"))
  os.exit(1)
end
