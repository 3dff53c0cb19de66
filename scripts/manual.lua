-- SPDX-License-Identifier: GPL-3.0-or-later
-- Writes the manual as HTML that needs no network: an index, the pages, and the parameters.
--   build/softworld scripts/manual.lua [folder=build/manual]
local manual = require "softworld.manual"
local sink = require "softworld.output.sink"
local topics = require "softworld.prompt.topics"
local core = require "softworld.core"

local folder = (arg[1] or "folder=build/manual"):match "^folder=(.+)$"
if not folder or arg[2] then
  io.stderr:write("usage: build/softworld scripts/manual.lua [folder=build/manual]\n")
  os.exit(2)
end

local STYLE = [[
:root { color-scheme: light dark; --text: #1c2226; --back: #fff; --soft: #f3f5f6; --line: #d5dade;
  --dim: #55616a; --link: #0a5aa5; }
@media (prefers-color-scheme: dark) { :root { --text: #dfe5e9; --back: #14181b; --soft: #1e2428;
  --line: #38424a; --dim: #a2aeb7; --link: #7fbcf5; } }
* { box-sizing: border-box; }
body { margin: 0; font: 1rem/1.6 system-ui, "DejaVu Sans", sans-serif; color: var(--text);
  background: var(--back); display: grid; grid-template-columns: 15rem minmax(0, 1fr); }
nav { background: var(--soft); border-right: 1px solid var(--line); padding: 1.5rem 1.2rem; height: 100vh;
  position: sticky; top: 0; overflow-y: auto; font-size: .92rem; }
nav h2 { font-size: .8rem; margin: 1.2rem 0 .3rem; color: var(--dim); font-weight: 600; }
nav ul { list-style: none; margin: 0; padding: 0; }
nav a { display: block; padding: .08rem .4rem; border-radius: .25rem; text-decoration: none; }
nav a:hover { text-decoration: underline; }
nav a[aria-current] { background: var(--link); color: var(--back); }
main { padding: 2rem 2.5rem 4rem; max-width: 66rem; }
main > p, li { max-width: 52rem; }
a { color: var(--link); }
h1 { font-size: 1.7rem; line-height: 1.25; margin: 0 0 1rem; }
h2 { font-size: 1.25rem; margin: 2.2rem 0 .6rem; }
h3 { font-size: 1.05rem; margin: 1.8rem 0 .4rem; }
code { font: .9em/1.5 ui-monospace, "DejaVu Sans Mono", monospace; }
:not(pre) > code { background: var(--soft); padding: .05em .15em; border-radius: .2em; }
pre { background: var(--soft); border: 1px solid var(--line); border-radius: .4rem; padding: .8rem .9rem;
  overflow-x: auto; }
pre > code { font-size: .81rem; } /* 110 letters fit into the page's width */
.wide { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: .94rem; }
th, td { text-align: left; vertical-align: top; padding: .35rem .8rem .35rem 0;
  border-bottom: 1px solid var(--line); }
tr:last-child > td { border-bottom: 0; }
th { color: var(--dim); font-weight: 600; }
thead:not(:has(th:not(:empty))) { display: none; }
img { max-width: 100%; height: auto; background: #fff; border-radius: .4rem; }
footer { margin-top: 3rem; padding-top: 1rem; border-top: 1px solid var(--line); display: flex;
  justify-content: space-between; gap: 1rem; }
@media (max-width: 50rem) { body { display: block; } main { padding: 1.2rem; }
  nav { position: static; height: auto; max-height: 11rem; border-right: 0;
    border-bottom: 1px solid var(--line); } }
@media print { nav, footer { display: none; } body { display: block; } pre { white-space: pre-wrap; } }
]]

-- Markdown -----------------------------------------------------------------------------

-- Converts Markdown to HTML with cmark-gfm of Debian. No other place uses this program.
local function html_of(markdown)
  local name = os.tmpname()
  sink.write_file(name, markdown)
  local pipe = assert(io.popen("cmark-gfm --extension table --unsafe " .. sink.quote(name)))
  local html = pipe:read "a"
  local fine = pipe:close()
  os.remove(name)
  if not fine then error("cmark-gfm failed; is it installed? sh scripts/setup.sh --manual", 0) end
  return html
end

local function escaped(text) return (text:gsub("[\\`*_<>%[%]|#]", "\\%0")) end
local function html_text(text)
  return (text:gsub("[&<>\"]", { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;" }))
end

-- Parameters ---------------------------------------------------------------------------

local reference = topics.reference()
local place_of = {} -- page and anchor of each registered name

for _, group in ipairs(reference) do
  for _, name in ipairs(group[2]) do
    place_of[name] = place_of[name] or "ref_" .. group[1] .. ".html#" .. name
  end
end

local function rows_table(rows)
  if #rows == 0 then return "Takes no parameters.\n" end
  local lines = { "| name | unit | default | | range |", "| --- | --- | --- | --- | --- |" }
  for _, row in ipairs(rows) do
    lines[#lines + 1] = ("| `%s` | %s | %s | %s | %s |"):format(row.name, row.unit == "-" and ""
      or escaped(row.unit), escaped((topics.default(row):gsub("^= ", ""))), escaped(row.doc),
      escaped(topics.range(row)))
  end
  return table.concat(lines, "\n") .. "\n"
end

local function part_markdown(part)
  local lines = { escaped(part.title), "" }
  for _, line in ipairs(part.lines) do lines[#lines + 1] = "    " .. line end
  if part.rows then lines[#lines + 1] = "\n" .. rows_table(part.rows) end
  if part.after then lines[#lines + 1] = part.after end
  return table.concat(lines, "\n")
end

local function reference_page(group)
  local lines = { "# Parameters: " .. group[1], "" }
  for _, name in ipairs(group[2]) do
    lines[#lines + 1] = ('<h2 id="%s">%s</h2>\n'):format(name, name)
    if manual.has(name) then
      lines[#lines + 1] = ("See also [%s](%s.md).\n"):format(manual.title(name), name)
    end
    for _, part in ipairs(topics.parts(name)) do lines[#lines + 1] = part_markdown(part) .. "\n" end
  end
  return table.concat(lines, "\n")
end

-- Pages --------------------------------------------------------------------------------

local order = {} -- all pages in order: { file, title, name }
for _, group in ipairs(manual.groups) do
  for _, name in ipairs(group[2]) do order[#order + 1] = { name .. ".html", manual.title(name), name } end
end
for _, group in ipairs(reference) do
  order[#order + 1] = { "ref_" .. group[1] .. ".html", "Parameters: " .. group[1], group[1] }
end

local function navigation(current)
  local lines = { "<nav><a href=\"index.html\"><strong>SoftWorld</strong></a>" }
  local function entry(file, text)
    lines[#lines + 1] = ('<li><a href="%s"%s>%s</a></li>'):format(file,
      file == current and ' aria-current="page"' or "", html_text(text))
  end
  for _, group in ipairs(manual.groups) do
    lines[#lines + 1] = "<h2>" .. html_text(group[1]) .. "</h2><ul>"
    for _, name in ipairs(group[2]) do entry(name .. ".html", name) end
    lines[#lines + 1] = "</ul>"
  end
  lines[#lines + 1] = "<h2>Parameters</h2><ul>"
  for _, group in ipairs(reference) do entry("ref_" .. group[1] .. ".html", group[1]) end
  lines[#lines + 1] = "</ul></nav>"
  return table.concat(lines, "\n")
end

local function footer(number)
  local function link(entry, format)
    if not entry then return "<span></span>" end
    return ('<a href="%s">' .. format .. "</a>"):format(entry[1], html_text(entry[2]))
  end
  local before, after = link(order[number - 1], "&larr; %s"), link(order[number + 1], "%s &rarr;")
  return "<footer>" .. before .. after .. "</footer>"
end

-- Makes links to pages and pictures point to files of the folder; turns help "name" into a link.
local function linked(html)
  html = html:gsub('href="([%w_]+)%.md', 'href="%1.html')
  html = html:gsub('src="[%./]*/%.readme/', 'src="')
  html = html:gsub("<table>", '<div class="wide"><table>'):gsub("</table>", "</table></div>")
  return (html:gsub("help &quot;([%w_%-]+)&quot;", function(name)
    local place = manual.has(name) and name .. ".html" or place_of[name]
    return place and ('help <a href="%s">&quot;%s&quot;</a>'):format(place, name)
  end))
end

local function write_page(file, title, body, number)
  local where = manual.has(file:match "^(.*)%.html$") and place_of[file:match "^(.*)%.html$"]
  sink.write_file(folder .. "/" .. file, table.concat({ '<!DOCTYPE html>\n<html lang="en"><head>',
    '<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">',
    "<title>" .. html_text(title) .. " - SoftWorld</title>",
    '<link rel="stylesheet" href="manual.css"></head><body>', navigation(file), "<main>", linked(body),
    where and ('<p><a href="%s">Parameters</a></p>'):format(where) or "", footer(number),
    "</main></body></html>\n" }, "\n"))
end

local function index()
  local lines = { "# SoftWorld " .. core.version, "",
    "Simulation of the handling of wires, cables and flexible tubes.", "" }
  for _, group in ipairs(manual.groups) do
    lines[#lines + 1] = "## " .. group[1] .. "\n\n| | |\n| --- | --- |"
    for _, name in ipairs(group[2]) do
      lines[#lines + 1] = ("| [%s](%s.md) | %s |"):format(name, name, escaped(manual.title(name)))
    end
    lines[#lines + 1] = ""
  end
  lines[#lines + 1] = "## Parameters\n\n| | |\n| --- | --- |"
  for _, group in ipairs(reference) do
    local names = {}
    for i, name in ipairs(group[2]) do names[i] = ("[%s](%s)"):format(name, place_of[name]) end
    lines[#lines + 1] = ("| [%s](ref_%s.html) | %s |"):format(group[1], group[1], table.concat(names, " "))
  end
  return table.concat(lines, "\n")
end

sink.run("mkdir -p " .. sink.quote(folder))
sink.write_file(folder .. "/manual.css", STYLE)
for picture in pairs{ ["grips.svg"] = 1, ["meshes.svg"] = 1, ["speed-accuracy.svg"] = 1 } do
  sink.run("cp .readme/" .. picture .. " " .. sink.quote(folder))
end
write_page("index.html", "Manual", html_of(index()), 0)
for number, entry in ipairs(order) do
  local file, title, name = table.unpack(entry)
  local group = file:find "^ref_" and reference[number - #order + #reference]
  write_page(file, title, html_of(group and reference_page(group) or manual.page(name)), number)
end
print(("%d pages: %s/index.html"):format(#order + 1, folder))
