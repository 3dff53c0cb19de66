-- SPDX-License-Identifier: GPL-3.0-or-later
--- The mixed grasp. @module softworld.mixed
local mixed = {}
return mixed
