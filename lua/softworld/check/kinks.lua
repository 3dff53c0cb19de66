-- SPDX-License-Identifier: GPL-3.0-or-later
--- Kinks: events of bends sharper than the wire bears.
-- @module softworld.check.kinks
local count = require "softworld.check.events"

return { name = "kinks", unit = "-", side = "max", on = "run", label = "kinks", missing = "allowed kinks",
  value = count "kink",
  limit = function() return { value = 0, from = "definition", source = "a kink damages a wire" } end }
