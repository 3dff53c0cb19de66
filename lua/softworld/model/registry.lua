-- SPDX-License-Identifier: GPL-3.0-or-later
--- What a run with model = "auto" chooses, each by itself: one file per choice, one line here.
--
-- A choice: { name =, rungs = { { name =, as = in a sentence, leaves = what it leaves out }, ... } from
-- cheap to dear, and functions of the context { scene =, data =, args =, job =, ... }:
--   safety: of the change that the next rung makes, where it is another than usual
--   begin(context): reads the scene as it begins, if need be
--   given(context): where the script has decided: a sentence, and the rung
--   apply(context, rung, changes): sets the scene, or options of its run, before a computation
--   look(context, run): what a computation tells about the choice, read at its end
--   idle(facts): there was nothing to choose
--   free(context, rung, facts, share): a sentence with number and threshold where the rung is known to
--     suffice without another computation; else nil, and perhaps why not. share: the tightest of the
--     tolerances over its value
--   costly(rung, here, above): a sentence where the rung costs no less than the next one; here and above:
--     coarse computations by both, with iterations =
--   short(context, facts, share): a sentence where even the dearest rung leaves out too much
-- @module softworld.model.registry
local registry = {}

local SAFETY = 1.5 -- of a change from one rung to the next, on coarse edges and steps [-]

local files = { "motion", "twist", "contact", "grip", "section" }

registry.list = {}
for i, file in ipairs(files) do
  local choice = require("softworld.model." .. file)
  choice.safety = choice.safety or SAFETY
  registry.list[i] = choice
end

return registry
