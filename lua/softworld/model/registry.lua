-- SPDX-License-Identifier: GPL-3.0-or-later
--- The choices of a run with model = "auto": one file per choice, one line here.
--
-- A choice: { name =, rungs = { { name =, as = in a sentence, leaves = what it leaves out }, ... } from
-- cheap to dear. A rung with own = true: changes by the next rung's own edges count too. Further fields:
--   safety: factor on the change that the next rung makes, if not the default
--   levels: number of coarse levels on which its rungs are compared, if not the default
--   steady: the next rung does not shorten bars, and it leaves the other choices as they are
--   instead: if the fine run fails, the next rung computes it
--   rough: fine levels of a rung may tell less than those of the next rung, even if coarse ones agree
--   by_state: a comparison on coarse edges counts only if the wire is near its fine state there
--   by_itself: what `broken` tells of a run so far does not depend on the share
-- and functions of the context { scene =, data =, args =, job =, ... }:
--   begin(context): reads the scene at its start, if needed
--   given(context): if the script has decided: a sentence, and the rung
--   apply(context, rung, changes, rungs): sets the scene, or options of its run, before a computation;
--     changes.shape(k) makes other models of wires on level k. rungs: of all choices, by their names
--   expected(context, rung, k): time of a run on level k, if it may be long [s]
--   shows(facts, snaps): share of the next rung's effect that its computation shows [-], if not all; snaps:
--     of the effect of a jump
--   blurred(facts, above, share): true if the coarsest level tells too little of the next rung, whose facts
--     are `above`, for the rung to stay
--   look(context, run): returns facts about the choice at the end of a computation; while a run is watched
--     (context.watching) only facts that can contradict a free check matter
--   idle(facts): true if there was nothing to choose
--   free(context, rung, facts, share): if the rung is known to suffice without another computation: a
--     sentence with number and threshold, and the share of a value that it leaves out, if that counts, or a
--     function of a quantity that returns it. Else nil, and perhaps why not. share: the smallest of the
--     tolerances over its value
--   lacks(context, rung, facts, values): a sentence if the rung is known to leave out too much
--   first(facts): true if the rung may be so far off that no other choice can be compared with it
--   broken(facts, share, rung): a sentence if the run so far contradicts the rung's free check
--   onward(context, options): switches to the next rung from here on, in the run that goes on with options;
--     raises an error if that is impossible. Without this function the run starts again
--   left(rung, facts): share of a value left out according to a rule, if the next rung is not known
--   skip(context, rung, facts, share): a sentence if the next rung is not tried, as it would tell nothing
--   mends(context, rung, result): a sentence if a computation failed because of this rung, or tells nothing
--   alike(before, now): true if, by facts, the rung acts as it did before with other rungs of other choices;
--     then a change that was found to be next to nothing is not computed again
--   toils(rung, run): true if, judged by a run, the rung may cost more than the next; then costly is asked
--   costly(rung, here, above, k, in_doubt): a sentence if the rung costs no less than the next one, which
--     is in doubt or not; here and above: computations by both on level k, with iterations =
--   short(context, facts, share, state): a sentence if the rung leaves out too much all the same
-- @module softworld.model.registry
local registry = {}

local SAFETY = 1.5 -- default for safety [-]

local files = { "motion", "twist", "contact", "grip", "section" }

registry.list = {}
for i, file in ipairs(files) do
  local choice = require("softworld.model." .. file)
  choice.safety = choice.safety or SAFETY
  registry.list[i] = choice
end

return registry
