-- SPDX-License-Identifier: GPL-3.0-or-later
--- The pages of the manual: Markdown files beside this one, in the order of the index.
-- help "name" and `softworld doc name` show them as text, `make manual` as HTML.
-- @module softworld.manual
local _, here = ...
local folder = here:match "^(.*)init%.lua$"

local manual = {}

--- Groups of pages: a title and the names of the group's pages.
manual.groups = {
  { "How to", { "start", "lay", "grip", "pads", "handling", "mixed", "clip", "insert", "tie", "channel",
    "slider", "feed", "winding", "join", "touches", "particles", "process", "waiting", "observe", "view",
    "tuning", "study", "search", "fit", "calibration", "cluster", "player", "plotting", "save", "snapshot",
    "remove", "mistakes" } },
  { "Choose", { "models", "auto", "choosing", "wire_mesh", "sections", "cable", "springback", "damping",
    "integrators", "vibration", "calibrate", "remodel", "units" } },
  { "Trust", { "accuracy", "tolerance", "limits", "limits_holds", "limits_friction", "limits_meshes",
    "speed", "peaks", "peak_steps", "energy", "events", "changes", "changed_contact", "changed_forces",
    "changed_holds", "changed_grips", "changed_runs", "changed_calls" } },
  { "What runs tell", { "results", "check", "doubts", "wear", "zones", "change", "compare", "refused",
    "remarks", "crashes", "breaking", "kinks", "files" } },
  { "Grippers' methods", { "gripper" } },
  { "Inside", { "glossary", "day", "parts" } },
}

--- Other words under which a page is found.
manual.also = { manual = "start", contact = "touches", meshes = "wire_mesh", harness = "join",
  plastic = "springback", exact = "accuracy", errors = "mistakes",
  advise = "auto", why = "auto", cheapest = "auto",
  bore = "insert", hole = "insert",
  rail = "slider", plot = "plotting", charts = "plotting",
  pictures = "plotting", paraview = "plotting", resume = "save", load = "save", ledger = "energy",
  observer = "observe", live = "view",
  sweep = "study", optimise = "study", workers = "study", journal = "study",
  minimise = "search", bobyqa = "search", cobyla = "search", simplex = "search", pareto = "search",
  slurm = "cluster", nodes = "cluster",
  verdict = "check", margin = "check", fatigue = "wear", abrasion = "wear", sensitivity = "change",
  identify = "fit", intervals = "fit", sag = "calibration", measure = "calibration",
  report = "player", page = "player", html = "player", film = "player", frames = "player",
  changed = "changes", modes = "vibration", stress = "vibration" }

local group_of = {}
for _, group in ipairs(manual.groups) do
  for _, name in ipairs(group[2]) do group_of[name] = group[1] end
end

--- Is there a page of that name?
function manual.has(name) return group_of[name] ~= nil end

--- The Markdown text of a page.
function manual.read(name)
  local file = assert(io.open(folder .. name .. ".md", "rb"))
  local text = file:read "a"
  file:close()
  return text
end

-- True if an example of the page is no script by itself.
local function goes_on(text)
  for block in text:gmatch "```lua\n(.-)```" do
    if not block:find('require "softworld"', 1, true) then return true end
  end
  return false
end

--- The Markdown text of a page as readers see it: it says where examples go on that make no scene.
function manual.page(name)
  local text = manual.read(name)
  if name == "start" or not goes_on(text) then return text end
  return (text:gsub("\n\n", "\n\nThe example goes on from the first block of [start](start.md).\n\n", 1))
end

--- The title of a page: its first heading.
function manual.title(name) return manual.read(name):match "^# ([^\n]+)" end

return manual
