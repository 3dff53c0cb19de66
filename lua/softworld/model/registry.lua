-- SPDX-License-Identifier: GPL-3.0-or-later
--- What a run with model = "auto" chooses, each by itself: one file per choice, one line here.
--
-- A choice: { name =, rungs = { { name =, as = in a sentence, leaves = what it leaves out }, ... } from
-- cheap to dear, and functions of the context { scene =, data =, args =, job =, ... }:
--   safety: of the change that the next rung makes, where it is another than usual
--   levels: coarse ones on which its rungs are compared, where it is another number than usual
--   steady: bars do not become shorter with the next rung, and the other choices stay as they are with it.
--     A rung with own = true: what the next one's own edges change counts too
--   instead: where the fine run fails, it is computed by the next rung
--   rough: fine levels of a rung may tell less than those of the next one, where coarse ones are alike
--   by_state: a comparison on coarse edges counts only if the wire is near its fine state on them
--   by_itself: what broken tells of a run so far does not depend on the share
--   begin(context): reads the scene as it begins, if need be
--   given(context): where the script has decided: a sentence, and the rung
--   apply(context, rung, changes, rungs): sets the scene, or options of its run, before a computation;
--     changes.shape(k) makes other models of wires on level k. rungs: of all choices, by their names
--   expected(context, rung, k): time of a run on level k, where it may cost much [s]
--   shows(facts): the share of what the next rung adds that its computation shows [-], where not all
--   blurred(facts, above, share): the coarsest level tells too little of the next rung, whose facts are
--     above, to stay
--   look(context, run): what a computation tells about the choice, read at its end; or while it is watched
--     (context.watching), where only what would speak against a free check matters
--   idle(facts): there was nothing to choose
--   free(context, rung, facts, share): a sentence with number and threshold where the rung is known to
--     suffice without another computation, and where it counts what share of a value is left out; else
--     nil, and perhaps why not. share: the tightest of the tolerances over its value
--   broken(facts, share, rung): a sentence where what a run told so far speaks against what the free check of
--     the rung said; onward(context, options): the next rung from here on, in the run that goes on with
--     options; raises where that is not possible. Without it the run begins again
--   left(rung, facts): what share of a value it leaves out by a rule, where the next rung is not known
--   skip(context, rung, facts, share): a sentence where the next rung is not tried, as it would tell nothing
--   mends(context, rung, result): a sentence where a computation failed by this rung, or tells nothing
--   toils(rung, run): may the rung cost more than the next one, by what a run of it needed? Then costly is
--     asked
--   costly(rung, here, above, k, in_doubt): a sentence where the rung costs no less than the next one, which
--     is in doubt or not; here and above: computations by both on level k, with iterations =
--   short(context, facts, share, state): a sentence where the rung leaves out too much all the same
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
