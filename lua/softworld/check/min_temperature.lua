-- SPDX-License-Identifier: GPL-3.0-or-later
--- Lowest temperature of the zones that a wire enters.
-- @module softworld.check.min_temperature
return require "softworld.check.temperature" "min"
