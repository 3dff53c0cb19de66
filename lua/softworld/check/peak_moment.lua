-- SPDX-License-Identifier: GPL-3.0-or-later
--- Peak moment of a gripper about its centre, as a mean over the moving window (see help
-- "peaks"). A blow of few steps may be up to twice as large.
-- @module softworld.check.peak_moment
return require("softworld.check.peak")("moment", "N m")
