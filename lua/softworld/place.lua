-- SPDX-License-Identifier: GPL-3.0-or-later
--- Tells the library's own code from scripts, and finds the line of a script that called the library.
-- @module softworld.place
local place = {}

local library = debug.getinfo(1, "S").source:match "^(@.*)place%.lua$" or "@softworld/"

local DEEPEST = 60 -- deepest stack searched [calls]

--- True if a chunk with this source (of debug.getinfo) is a file of the library.
function place.is_ours(source) return source:sub(1, #library) == library end

--- Returns "file.lua:12" of the innermost caller outside the library, or nil.
function place.of_caller()
  for level = 2, DEEPEST do
    local info = debug.getinfo(level, "Sl")
    if not info then return nil end
    if info.currentline > 0 and not place.is_ours(info.source) then
      return ("%s:%d"):format(info.short_src, info.currentline)
    end
  end
end

return place
