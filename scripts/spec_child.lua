-- SPDX-License-Identifier: GPL-3.0-or-later
-- Runs one spec file in a separate process, for scripts/spec.lua, and reports its results as records.
local child = {}

-- Records --------------------------------------------------------------------
-- A child reports through a file: one line for each event, fields separated by tabs. Lines are written at
-- once, so that they survive a crash. If the last line "end" is missing, the spec file did not finish.

local escapes = { ["\\"] = "\\\\", ["\n"] = "\\n", ["\t"] = "\\t", ["\r"] = "\\r" }
local function escape(text) return (tostring(text):gsub("[\\\n\t\r]", escapes)) end
function child.unescape(text)
  return (text:gsub("\\(.)", function(c) return ({ n = "\n", t = "\t", r = "\r" })[c] or c end))
end

local function recorder(sink)
  local write, flush = sink.write, sink.flush -- a spec may replace io's functions
  return function(...)
    local fields = table.pack(...)
    for i = 1, fields.n do fields[i] = escape(fields[i]) end
    write(sink, table.concat(fields, "\t"), "\n")
    flush(sink)
  end
end

-- Names of tests ----------------------------------------------------------------

local function line_of(trace)
  return trace and trace.currentline and trace.currentline > 0 and trace.currentline or "?"
end

local function full_name(busted, element)
  local names = {}
  while element and element.descriptor and element.descriptor ~= "file" do
    table.insert(names, 1, tostring(element.name or element.descriptor))
    element = busted.context.parent(element)
  end
  return table.concat(names, " ")
end

-- Returns the message; adds the line of the test if the message names only a line of other code.
local function message_of(file, message, trace)
  message = type(message) == "string" and message or "no message"
  local outermost
  for at in (trace and trace.traceback or ""):gmatch("\n%s*(" .. file:gsub("%p", "%%%0") .. ":%d+): in ") do
    outermost = at
  end
  if not outermost or message:find(outermost .. ":", 1, true) then return message end
  return message .. "\n(called from " .. outermost .. ")"
end

-- A file ------------------------------------------------------------------------

-- Selects the tests when they register themselves.
local function choose(busted, file, record, name, list)
  local first = { priority = 1 }
  for _, descriptor in ipairs { "it", "pending" } do
    busted.subscribe({ "register", descriptor }, function(test_name, _, trace)
      local parents = full_name(busted, busted.context.get())
      local whole = (parents == "" and "" or parents .. " ") .. tostring(test_name or descriptor)
      local wanted = not name or whole:find(name, 1, true) ~= nil
      if list and wanted then record("test", file .. ":" .. line_of(trace), whole) end
      return nil, wanted and not list
    end, first)
  end
  for _, descriptor in ipairs(list and { "setup", "teardown", "strict_setup", "strict_teardown",
    "lazy_setup", "lazy_teardown", "before_each", "after_each" } or {}) do
    busted.subscribe({ "register", descriptor }, function() return nil, false end, first)
  end
end

local function watch(busted, file, record)
  local messages = {} -- messages of the running test
  local function place(element) return file .. ":" .. line_of(element.trace) end
  busted.subscribe({ "test", "start" }, function(element)
    messages = {}
    record("start", place(element), full_name(busted, element))
    return nil, true
  end)
  busted.subscribe({ "test", "end" }, function(element, _, status)
    local seconds, whole = ("%.6f"):format(element.duration or 0), full_name(busted, element)
    if status == "success" then
      record("pass", place(element), whole, seconds)
    else
      local why = table.concat(messages, "\n")
      if status == "pending" then why = "pending: not run, so not passed. " .. why end
      record("fail", place(element), whole, why, seconds)
    end
    messages = {}
    return nil, true
  end)
  local function problem(element, _, message, trace)
    local why = message_of(file, message, trace)
    if element.descriptor == "it" then
      messages[#messages + 1] = why -- recorded when the test ends
    else
      record("fail", place(element), full_name(busted, element),
        ("error in %s: %s"):format(element.descriptor or "?", why), 0)
    end
    return nil, true
  end
  for _, event in ipairs { "failure", "error", "pending" } do busted.subscribe({ event }, problem) end
end

local function execute(busted, file, record)
  local chunk, err = loadfile(file)
  if not chunk then return record("fail", file, "(loading)", err, 0) end
  local function trace_of(_, info)
    info.traceback = info.traceback:match "^(.-)\n%s*%[C%]" or info.traceback
    return info
  end
  busted.executors.file(file, setmetatable({ getTrace = trace_of }, { __call = chunk }))
  require "busted.execute"(busted)(1, {})
end

--- Runs the file's tests whose names contain name, or lists them; writes records to sink. root: folder of
-- the tree; host: path of the program, beside which its libraries are.
function child.run(file, sink, name, list, root, host)
  local record = recorder(sink)
  local places = "%s/lua/?.lua;%s/lua/?/init.lua;%s/spec/?.lua;%s/scripts/?.lua;"
  package.path = places:gsub("%%s", (root:gsub("%%", "%%%%"))) .. package.path
  -- beside the host: softworld.probe, and the core for stock Lua
  package.cpath = host:match "^(.*)/" .. "/lib/?.so;" .. package.cpath
  rawset(_G, "arg", { [0] = file })

  local busted = require "busted.core"()
  require "busted"(busted)
  choose(busted, file, record, name, list)
  watch(busted, file, record)
  execute(busted, file, record)
  record "end"
  -- Specs check their runs themselves, so failed runs that no script has read are not reported.
  local unread = package.loaded["softworld.unread"]
  if unread then unread.finish() end
end

return child
