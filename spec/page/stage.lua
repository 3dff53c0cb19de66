-- SPDX-License-Identifier: GPL-3.0-or-later
--- A player's page in a real browser, and helpers that read it.
local browser = require "spec.page.browser"
local files = require "spec.output.files"

local stage = {} -- page, and folder for files, from open to close

--- Opens the page and makes the folder.
function stage.open()
  stage.folder = files.folder()
  stage.page = browser.open(1280, 720)
  return stage.page, stage.folder
end

function stage.close()
  if stage.page then stage.page:close() end
  files.remove(stage.folder)
end

function stage.address(name) return "file://" .. stage.folder .. "/" .. name end

-- The console has had no warning or error since the last call.
function stage.assert_calm()
  for _, line in ipairs(stage.page:console()) do
    assert.is_true(line.level ~= "SEVERE" and line.level ~= "WARNING", line.level .. ": " .. line.message)
  end
end

-- JavaScript that reads the pixels of a picture of the stage into data.
local colours = [[
  const view = player.view, from = view.stage.canvas, to = document.createElement("canvas");
  to.width = from.width; to.height = from.height;
  view.stage.draw();
  const c = to.getContext("2d");
  c.drawImage(from, 0, 0);
  const data = new Uint32Array(c.getImageData(0, 0, to.width, to.height).data.buffer);
]]

function stage.colour_count() return stage.page:run(colours .. "return new Set(data).size;") end

-- A checksum of the picture, which shows whether it has changed.
function stage.fingerprint()
  return stage.page:run(colours
    .. "let h = 0; for (const x of data) h = (Math.imul(h, 31) + x) | 0; return h;")
end

function stage.time() return stage.page:run "return player.state.get('time')" end
function stage.text(selector)
  return stage.page:run("return document.querySelector(arguments[0]).innerText", selector)
end

return stage
