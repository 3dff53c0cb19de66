-- SPDX-License-Identifier: GPL-3.0-or-later
--- The pages of the manual: each is a file of this folder, shown by help "name".
-- @module softworld.manual
return { "breaking", "crashes", "damping", "energy", "events", "files",
  "handling", "kinks", "peaks", "refused", "remarks", "results", "waiting" }
