-- SPDX-License-Identifier: GPL-3.0-or-later
--- Names and texts of scripts as files want them: scripts may be written in Latin-1.
-- @module softworld.output.letters
local letters = {}

--- Bytes that are not UTF-8 are taken as Latin-1: a text that any reader accepts.
-- @tparam string text
-- @treturn string UTF-8
function letters.utf8(text)
  if utf8.len(text) then return text end
  return (text:gsub("[\128-\255]", function(char) return utf8.char(char:byte()) end))
end

local entities = { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;" }

--- A text within XML or HTML, on one line: XML 1.0 has no control characters.
-- @tparam string text
-- @treturn string
function letters.xml(text)
  return (letters.utf8(text):gsub("[%c\127]", " "):gsub('[&<>"]', entities))
end

return letters
