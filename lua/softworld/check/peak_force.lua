-- SPDX-License-Identifier: GPL-3.0-or-later
--- Peak force of a gripper on its wires, as a mean over the moving window (see help
-- "peaks"). A blow of few steps may be up to twice as large.
-- @module softworld.check.peak_force
return require("softworld.check.peak")("force", "N")
