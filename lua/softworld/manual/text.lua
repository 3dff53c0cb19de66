-- SPDX-License-Identifier: GPL-3.0-or-later
--- Markdown as a terminal shows it: headings underlined, columns of tables in line, code indented, links as
-- topics of help.
-- @module softworld.manual.text

local WIDEST = 104 -- of a table, whose cells are wrapped to fit [characters]
local GAP = 2      -- between columns [characters]

local function cells_of(line)
  local cells = {}
  for cell in line:gsub("^%s*|", ""):gmatch "%s*([^|]-)%s*|" do cells[#cells + 1] = cell end
  return cells
end

local function width_of(text) return utf8.len(text) or #text end

-- The widest columns give way until the table fits; none becomes narrower than its longest word.
local function widths_of(rows)
  local widths, least, sum = {}, {}, 0
  for _, row in ipairs(rows) do
    for k, cell in ipairs(row) do
      widths[k] = math.max(widths[k] or 0, width_of(cell))
      for word in cell:gmatch "%S+" do least[k] = math.max(least[k] or 0, width_of(word)) end
    end
  end
  for k = 1, #widths do sum = sum + widths[k] + GAP end
  while sum > WIDEST do
    local widest
    for k, width in ipairs(widths) do
      if width > (least[k] or 0) and width > (widest and widths[widest] or 0) then widest = k end
    end
    if not widest then break end
    widths[widest], sum = widths[widest] - 1, sum - 1
  end
  return widths
end

-- The cell's words in lines of the width, where words are no longer than that.
local function wrapped(cell, width)
  local lines = { "" }
  for word in cell:gmatch "%S+" do
    local last = lines[#lines]
    if last == "" then lines[#lines] = word
    elseif width_of(last) + 1 + width_of(word) <= width then lines[#lines] = last .. " " .. word
    else lines[#lines + 1] = word end
  end
  return lines
end

local function put_table(put, rows)
  local widths = widths_of(rows)
  for _, row in ipairs(rows) do
    local cells, most = {}, 1
    for k, cell in ipairs(row) do
      cells[k] = wrapped(cell, widths[k])
      most = math.max(most, #cells[k])
    end
    for i = 1, most do
      local line = ""
      for k, lines in ipairs(cells) do
        local part = lines[i] or ""
        line = line .. (" "):rep(GAP) .. part .. (" "):rep(widths[k] - width_of(part))
      end
      put((line:gsub("%s+$", "")))
    end
  end
end

local function plain(line)
  line = line:gsub("!%[([^%]]*)%]%([^)]*%)", "(picture: %1)")
  line = line:gsub("%[([^%]]*)%]%(([%w_]+)%.md[^)]*%)", function(text, page)
    return text == page and ('help "%s"'):format(page) or ('%s (help "%s")'):format(text, page)
  end)
  return (line:gsub("%[([^%]]*)%]%(([^)]*)%)", "%1 (%2)"):gsub("%*%*([^*]+)%*%*", "%1"))
end

--- The text of a Markdown page.
return function(markdown)
  local lines, rows, code = {}, nil, false
  local function put(line) lines[#lines + 1] = line end
  local function end_table()
    if rows then put_table(put, rows) end
    rows = nil
  end
  for line in (markdown:gsub("\n*$", "\n")):gmatch "([^\n]*)\n" do
    local level, heading = line:match "^(#+) (.*)$"
    if not line:find "^|" then end_table() end
    if line:find "^```" then code = not code
    elseif code then put(line == "" and "" or "    " .. line)
    elseif line:find "^|" then
      rows = rows or {}
      -- without the rule under a table's head, and heads without words
      if not line:find "^|[%s|:-]*$" then rows[#rows + 1] = cells_of(plain(line)) end
    elseif heading then
      put(plain(heading))
      put((level == "#" and "=" or "-"):rep(width_of(heading)))
    else put(line:find "^    " and line or plain(line)) end
  end
  end_table()
  return table.concat(lines, "\n")
end
