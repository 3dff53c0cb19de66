-- SPDX-License-Identifier: GPL-3.0-or-later
--- The command `softworld doc [TOPIC]`: prints the same text as help "TOPIC" at the prompt.
-- @module softworld.program.doc
local topics = require "softworld.prompt.topics"

--- Returns the exit status: 0; 1 if there is no such topic; 2 for more than one word.
return function(topic, more)
  if more then
    io.stderr:write("softworld: doc takes one topic; usage: softworld doc [topic]\n")
    return 2
  end
  local text = topic == nil and topics.overview() or topics.text(topic)
  if text then
    print(text)
    return 0
  end
  io.stderr:write("softworld: ", (topics.unknown(topic):gsub("help%(%)", "softworld doc")), "\n")
  return 1
end
