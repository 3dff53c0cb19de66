-- SPDX-License-Identifier: GPL-3.0-or-later
--- Sheets that pictures are drawn on: dots for PNG and films, lines and areas for SVG. Both have
--
--    sheet:fill(x, y, width, height, colour)                      [px], from the upper left corner
--    sheet:text(text, x, y, size, colour)      y: of its line; returns where the text ends [px]
--    sheet:show(drawing, camera, technique, x, y, width, height)
--    sheet:bytes()                             content of a file of this kind
-- @module softworld.output.sheet
local core = require "softworld.core"
local letters = require "softworld.output.letters"

local sheet = {}

--- Returns the length of a text [px].
function sheet.width(text, size) return core.text_width(text, size) end

local Dots = {}
Dots.__index = Dots

function Dots:fill(x, y, width, height, colour)
  self.canvas:fill(math.floor(x), math.floor(y), math.ceil(width), math.ceil(height), colour)
end

function Dots:text(text, x, y, size, colour) return self.canvas:text(text, x, y, size, colour) end

function Dots:show(drawing, camera, technique, x, y, width, height)
  self.canvas:show(drawing, camera, technique, x, y, width, height)
end

function Dots:bytes() return self.canvas:png() end

--- Returns a sheet of dots.
function sheet.dots(width, height) return setmetatable({ canvas = core.canvas(width, height) }, Dots) end

local Lines = {}
Lines.__index = Lines

local function number(x) return (("%.2f"):format(x):gsub(",", "."):gsub("%.?0+$", "")) end

local function hex(colour)
  local function part(x) return math.floor(255 * math.max(0, math.min(1, x)) + 0.5) end
  return ("#%02x%02x%02x"):format(part(colour[1]), part(colour[2]), part(colour[3]))
end

local function add(self, text) self.parts[#self.parts + 1] = text end

function Lines:fill(x, y, width, height, colour)
  add(self, ('<rect x="%s" y="%s" width="%s" height="%s" fill="%s"/>\n'):format(number(x), number(y),
    number(width), number(height), hex(colour)))
end

function Lines:text(text, x, y, size, colour)
  local long = core.text_width(text, size)
  if text:find "%S" then
    add(self, ('<text x="%s" y="%s" font-size="%s" textLength="%s" lengthAdjust="spacingAndGlyphs" fill="%s">'
      .. "%s</text>\n"):format(number(x), number(y), number(size), number(long), hex(colour),
        letters.xml(text)))
  end
  return long
end

function Lines:show(drawing, camera, technique, x, y, width, height)
  add(self, ('<svg x="%s" y="%s" width="%s" height="%s" viewBox="0 0 %s %s" overflow="hidden">\n')
    :format(number(x), number(y), number(width), number(height), number(width), number(height)))
  if technique ~= "wireframe" then add(self, '<rect width="100%" height="100%" fill="url(#paper)"/>\n') end
  add(self, drawing:svg(camera, technique, width, height))
  add(self, "</svg>\n")
end

function Lines:bytes()
  return table.concat(self.parts) .. "</svg>\n"
end

--- Returns a sheet of lines and areas.
function sheet.lines(width, height)
  local self = setmetatable({ parts = {} }, Lines)
  add(self, ('<svg xmlns="http://www.w3.org/2000/svg" width="%s" height="%s" viewBox="0 0 %s %s" '
    .. 'font-family="DejaVu Sans, Verdana, sans-serif">\n<defs><linearGradient id="paper" x2="0" y2="1">'
    .. '<stop stop-color="#f7f7f8"/><stop offset="1" stop-color="#e3e6ea"/></linearGradient></defs>\n')
    :format(number(width), number(height), number(width), number(height)))
  add(self, ('<rect width="%s" height="%s" fill="#ffffff"/>\n'):format(number(width), number(height)))
  return self
end

return sheet
