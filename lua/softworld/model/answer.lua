-- SPDX-License-Identifier: GPL-3.0-or-later
--- Tells what was chosen and why: run.model, run:why().
-- @module softworld.model.answer
local number = require "softworld.output.number"
local rows = require "softworld.rows"

local answer = {}

local COARSE = 1 / 8 -- least error over the tolerance: levels that stop there show no smaller one [-]

rows.calls{
  { "run:why", "", "which model was chosen and why, of a run with model = 'auto'; print it", "run.model",
    example = "print(run:why())" },
}

local Model = { __name = "model" }
Model.__index = Model

local function quantity_line(q)
  return ("  %s = %s: edges and steps +- %s, model +- %s, %s"):format(q.name, q:text(),
    number.text(q.discretisation, q.unit), number.text(q.model_error, q.unit), q:asked())
end

--- Returns the reasons as lines of text.
function Model:__tostring()
  local words, lines = {}, {}
  for _, c in ipairs(self.choices) do words[#words + 1] = ("%s %s"):format(c.name, c.rung) end
  lines[1] = "model: " .. table.concat(words, ", ")
  if self.spread then lines[#lines + 1] = "  first: " .. self.spread end
  for _, c in ipairs(self.choices) do
    lines[#lines + 1] = ("  %s %s: %s"):format(c.name, c.rung, c.why)
    if c.leaves ~= "nothing" then lines[#lines + 1] = "      leaves out " .. c.leaves end
  end
  for _, q in ipairs(self.quantities or {}) do lines[#lines + 1] = quantity_line(q) end
  for _, text in ipairs(self.short) do lines[#lines + 1] = "  NOT enough: " .. text end
  if self.blind then lines[#lines + 1] = "  NOT known: whether this model suffices, "
    .. "because " .. self.blind end
  if self.dear then lines[#lines + 1] = "  NOT finer: " .. self.dear end
  for _, text in ipairs(self.unchecked) do lines[#lines + 1] = "  not checked: " .. text end
  lines[#lines + 1] = ("  %d coarse computation%s to choose took %.3g s; the run took %.3g s"):format(
    self.probes, self.probes == 1 and "" or "s", self.cost, self.run_cost)
  return table.concat(lines, "\n")
end

local function choice_of(state)
  local rung, on = state.choice.rungs[state.rung], state.went_on
  if on then
    rung = state.choice.rungs[state.rung + 1]
    return { name = state.choice.name, rung = rung.name, leaves = rung.leaves, by = "switched",
      why = ("%s; %s: %s"):format(on.text, on.whole and "on coarse edges" or "until then", state.why),
      error = state.change }
  end
  return { name = state.choice.name, rung = rung.name, leaves = rung.leaves, by = state.by,
    why = state.why or state.doubt or "there is no more expensive one", error = state.change }
end

-- Returns why bars are too long if nothing else explains it.
local function together(model)
  if model.spread then return "the cable's spread changes more than the tolerance allows, so the error bars "
    .. "were not made shorter" end
  for _, q in ipairs(model.quantities) do
    if not q.met then
      return ("%s: the error of the model, %s, and that of edges and steps, %s, are together above the "
        .. "tolerance, %s"):format(q.name, number.text(q.model_error, q.unit),
        number.text(q.discretisation, q.unit), number.text(q.tolerance, q.unit))
    end
  end
end

-- Adds what the rungs leave out to the bars.
local function widen(context, result, model)
  model.quantities = result:error_bars()
  local met = #model.short == 0 and not model.blind
  for _, q in ipairs(model.quantities) do
    local sum = 0
    for _, c in ipairs(model.choices) do sum = sum + (c.error and c.error[q.name] or 0) end
    q.discretisation, q.model_error = q.row and q.error or math.max(q.error, COARSE * q.tolerance), sum
    q.error = q.discretisation + sum
    q.met = q.error <= q.tolerance
    met = met and q.met
  end
  model.dear = not met and context.dear or nil
  if not met and (model.dear or not result.advice) then
    result.advice = model.short[1] or model.blind or model.dear or together(model)
  end
  result.met = met
end

-- Adds what no choice covers, though the run tells of it: joints that pass no twist.
local function add_joints(result, model)
  for _, e in ipairs(result.events or {}) do
    if e.kind == "joint" then model.unchecked[#model.unchecked + 1] = "joints: " .. e.text end
  end
end

-- Returns the time of the run's levels, including those taken over from choosing [s].
local function cost_of(result)
  local sum = 0
  for _, level in ipairs(result.levels or {}) do sum = sum + level.cpu end
  return sum
end

--- Adds the model to the result.
function answer.add(context, result)
  local run_cost = cost_of(result)
  local model = setmetatable({ choices = {}, short = {}, unchecked = {}, probes = context.probe_count,
    cost = math.max(0, context.spent - run_cost), run_cost = run_cost,
    spread = context.spread:text() }, Model)
  for _, state in ipairs(context.states) do
    if state.by ~= "idle" then
      local c = choice_of(state)
      model.choices[#model.choices + 1], model[c.name] = c, c.rung
      if state.went_on then
        result.events[#result.events + 1] = { kind = "model", time = state.went_on.time, count = 1,
          text = ("%s: %s"):format(c.name, state.went_on.text) }
      end
      if state.short then model.short[#model.short + 1] = state.short end
      if state.by == "failed" then model.blind = ("%s was not checked: %s"):format(c.name, c.why) end
      if not state.short and state.doubt and state.by == "skipped" then
        model.unchecked[#model.unchecked + 1] = ("%s: %s"):format(c.name, state.doubt)
      end
    end
  end
  if context.spread.failed then model.unchecked[#model.unchecked + 1] = context.spread.failed end
  add_joints(result, model)
  for _, e in ipairs(context.given_up) do result.events[#result.events + 1] = e end
  if not result.refused then widen(context, result, model) end
  result.model = model
  return result
end

--- run:why(): see help "auto".
function answer.why(run)
  if not run.model then
    error("the model of this run was given, not chosen: run with model = 'auto' and tolerance = { quantity = "
      .. "value }", 0)
  end
  return run.model
end

return answer
