-- SPDX-License-Identifier: GPL-3.0-or-later
--- Converts names and texts of scripts, which may be written in Latin-1, for files.
-- @module softworld.output.letters
local letters = {}

--- Returns a text as UTF-8. A text that is not UTF-8 is read as Latin-1.
-- @tparam string text
-- @treturn string UTF-8
function letters.utf8(text)
  if utf8.len(text) then return text end
  return (text:gsub("[\128-\255]", function(char) return utf8.char(char:byte()) end))
end

local entities = { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;" }

--- Returns a text for XML or HTML, on one line; control characters, which XML 1.0 forbids, become spaces.
-- @tparam string text
-- @treturn string
function letters.xml(text)
  return (letters.utf8(text):gsub("[%c\127]", " "):gsub('[&<>"]', entities))
end

return letters
