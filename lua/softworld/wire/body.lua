-- SPDX-License-Identifier: GPL-3.0-or-later
--- What fills the section of a mesh. `section` = "solid" or "springs" means `body`; other sections are shapes
-- of a cubic mesh.
-- @module softworld.wire.body

local inherited = require "softworld.inherited"

--- Returns the arguments of a mesh with `body` instead of such a section. The given table stays as it is.
return function(args)
  if type(args) ~= "table" or args.section ~= "solid" and args.section ~= "springs" then return args end
  local all = inherited.copy(args)
  all.body, all.section = all.body or args.section, nil
  return all
end
