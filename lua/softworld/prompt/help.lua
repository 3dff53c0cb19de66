-- SPDX-License-Identifier: GPL-3.0-or-later
--- Help at the prompt.
--
--     help()            -- what there is
--     help "grip"       -- a page of the manual
--     help "wire"       -- parameters of scene:wire; of an obstacle, a force, a clamp, ...
--     help(scene)       -- methods of an object
--     help "press"      -- a method with all that it takes
-- @module softworld.prompt.help
local checks = require "softworld.checks"
local topics = require "softworld.prompt.topics"

local function show_object(object)
  local known = topics.object(checks.kind(object))
  if known then
    print(checks.shown(object) .. "\n" .. known)
    return
  end
  local meta = debug.getmetatable(object)
  local list = type(meta) == "table" and rawget(meta, "__names")
  local names = list and list(object) or {}
  if #names == 0 then
    for name, value in pairs(type(object) == "table" and object or {}) do
      if type(name) == "string" and type(value) == "function" then names[#names + 1] = name end
    end
  end
  table.sort(names)
  print(checks.shown(object))
  if #names > 0 then print("  " .. table.concat(names, " ")) end
end

return function(topic)
  if topic == nil then print(topics.overview())
  elseif type(topic) ~= "string" then show_object(topic)
  else print(topics.text(topic) or topics.unknown(topic)) end
end
