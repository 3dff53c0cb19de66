-- SPDX-License-Identifier: GPL-3.0-or-later
--- A view that starts with an empty scene, run as a separate program and used in a real browser.
local browser = require "spec.page.browser"
local program = dofile "spec/host/program.lua"
local socket = require "socket"

local begun = {} -- page, and the folder in which the program runs, from open to close

--- Opens the page and makes the folder.
function begun.open()
  begun.folder = program.folder()
  begun.page = browser.open(1280, 720)
  return begun.page, begun.folder
end

function begun.close()
  begun.stop "TERM"
  if begun.page then begun.page:close() end
  os.execute("rm -rf " .. program.quote(begun.folder))
end

-- Runs the program with these arguments in its own process; returns the address of its page.
function begun.begin(words)
  local path = program.path:find "^/" and program.path or require "lfs".currentdir() .. "/" .. program.path
  os.execute(("cd '%s' && rm -f err && { env --default-signal=INT '%s' %s >out 2>err & echo $! >pid; }")
    :format(begun.folder, path, words))
  for _ = 1, 200 do
    local file = io.open(begun.folder .. "/err")
    local said = file and file:read "a" or ""
    if file then file:close() end
    if said:find "http://%S+/" then return said:match "http://%S+" end
    socket.sleep(0.05)
  end
  error "the view does not begin"
end

function begun.stop(signal)
  local file = io.open(begun.folder .. "/pid")
  if not file then return end
  os.execute(("kill -%s %d 2>/dev/null"):format(signal or "INT", file:read "n"))
  file:close()
  os.remove(begun.folder .. "/pid")
end

function begun.text(selector)
  return begun.page:run("return document.querySelector(arguments[0])?.innerText", selector)
end

function begun.click(selector)
  begun.page:run("document.querySelector(arguments[0]).click()", selector)
end

-- The field of the open form with this label, or one of its parts.
begun.FIELD = [[
  const label = [...document.querySelectorAll(".form-box label")]
    .find((l) => l.innerText.replace(" *", "") === arguments[0]);
  const first = document.getElementById(label.htmlFor);
  const all = first.parentElement.className.startsWith("vector")
    ? [...first.parentElement.children] : [first];
]]
function begun.fill(name, ...)
  for k, value in ipairs { ... } do
    begun.page:run(begun.FIELD .. [[
      const [, value, k] = arguments;
      all[k].value = value;
      all[k].dispatchEvent(new Event("change"));]], name, value, k - 1)
  end
end

function begun.submit() begun.page:run [[document.querySelector(".form-box form").requestSubmit()]] end
function begun.closed() begun.page:wait [[return !document.querySelector(".form-box")]] end
function begun.set_duration(value)
  begun.page:run([[
    const f = [...document.querySelectorAll("#panel-build label")].find((l) => l.innerText === "duration");
    document.getElementById(f.htmlFor).value = arguments[0];]], value)
end

function begun.add(class) begun.click(("[data-class=%s]"):format(class)) end

function begun.wait_for(words)
  begun.page:wait(("return document.querySelector('ul.things').innerText.includes(%q)"):format(words))
end

return begun
