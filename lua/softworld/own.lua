-- SPDX-License-Identifier: GPL-3.0-or-later
--- Globals of the library's own files: the standard ones as they were when the library was loaded, else those
-- of the script. So a script may name its obstacle `table`, or its cable `string`.
-- @module softworld.own
local own = {}

-- Not print: what replaces it also gets the library's texts.
for name in ([[_G assert coroutine debug error getmetatable io ipairs load loadfile math next os package pairs
  pcall rawequal rawget rawlen rawset require select setmetatable string table tonumber tostring type utf8
  xpcall]]):gmatch "%S+" do
  own[name] = _G[name]
end
setmetatable(own, { __index = _G, __newindex = _G })

local searchpath, load_file, path_of = package.searchpath, loadfile, package

-- Finds files of the library and loads them with these globals.
table.insert(package.searchers, 2, function(name)
  if not name:find "^softworld%." then return nil end
  local path = searchpath(name, path_of.path)
  if not path then return nil end
  return load_file(path, nil, own) or nil, path -- a syntax error is told by the usual searcher
end)

return own
