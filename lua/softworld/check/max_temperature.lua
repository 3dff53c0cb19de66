-- SPDX-License-Identifier: GPL-3.0-or-later
--- Highest temperature of the zones that a wire enters.
-- @module softworld.check.max_temperature
return require "softworld.check.temperature" "max"
