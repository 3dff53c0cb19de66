-- SPDX-License-Identifier: GPL-3.0-or-later
--- Chooses how a gripper takes hold, and checks which parameters go with each way.
-- @module softworld.grip.approach
local build = require "softworld.scene.build"

local approach = {}

local pad_words = { "force", "distance", "speed" }
local mesh_words = { "region", "model", "section", "spacing", "particles", "layers", "across",
  "margin", "freeze" }

--- Raises an error if parameters are given that do not go with an approach.
function approach.check(self, way, args)
  local function refuse(words, wanted)
    for _, word in ipairs(words) do
      if args[word] ~= nil then
        error(("gripper '%s': %s goes with approach = %s"):format(self.name, word, wanted), 0)
      end
    end
  end
  if way == "imposed" then refuse(pad_words, "'plates' or 'mixed'") end
  if way ~= "mixed" then refuse(mesh_words, "'mixed'") end
end

--- Returns the approach. If the script leaves it open, a run that chooses its model chooses the approach too.
function approach.of(self, wires, args)
  local auto = build.data(self.scene).auto
  local open = args.approach == "auto" or args.approach == nil and auto and args.force
  if not open then return args.approach or "imposed" end
  if not auto then
    error(("gripper '%s': approach = 'auto' needs a run that chooses: scene:run{ model = 'auto' }"):format(
      self.name), 0)
  end
  auto.asked[#auto.asked + 1] = { gripper = self, wire = wires[1], force = args.force, s = args.s }
  if auto.approach == "imposed" then
    for _, word in ipairs(pad_words) do args[word] = nil end
  end
  if auto.approach ~= "mixed" then
    for _, word in ipairs(mesh_words) do args[word] = nil end
  end
  return auto.approach
end

return approach
