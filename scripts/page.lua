-- SPDX-License-Identifier: GPL-3.0-or-later
-- Builds the player's page: combines template, notices, styles and scripts into one HTML file.
--   lua5.4 scripts/page.lua SOURCES BUNDLES OUT     (see the Makefile)
local sources, bundles, out = ...

local function read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read "a"
  file:close()
  return text
end

local parts = {
  NOTICES = read(sources .. "/notices.txt"),
  STYLES = read(bundles .. "/player.css"),
  -- browsers end a script at the first </script>, even inside a string
  SCRIPTS = (read(bundles .. "/player.js"):gsub("</([sS][cC][rR][iI][pP][tT])", "<\\/%1")),
}
local page = read(sources .. "/index.html"):gsub("@(%u+)@", function(name) return parts[name] end)
local file = assert(io.open(out, "wb"))
assert(file:write(page))
assert(file:close())
