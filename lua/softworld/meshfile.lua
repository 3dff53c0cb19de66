-- SPDX-License-Identifier: GPL-3.0-or-later
-- Reads mesh files into memory; the core turns their content into triangles:
--   local file = meshfile.read("clip.stl")
--   scene:obstacle{ shape = "mesh", data = file.data, format = file.format, scale = 0.001 }
local sink = require "softworld.output.sink"

local meshfile = {}

-- Extensions that the core's `format` parameter of the mesh shape accepts.
meshfile.formats = { "stl", "obj", "ply", "off", "glb", "gltf" }

local function fail(path, reason)
  error(("mesh file '%s': %s"):format(path, reason), 3)
end

local function format_of(path)
  local extension = path:match("%.([^./\\]+)$")
  local known = table.concat(meshfile.formats, ", ")
  if not extension then
    return nil, "has no extension; known are " .. known
  end
  for _, format in ipairs(meshfile.formats) do
    if extension:lower() == format then return format end
  end
  return nil, ("extension '%s' is not known; known are %s"):format(extension, known)
end

--- Returns the content of the file at path as { data = string, format = extension }.
-- Raises an error that names the path and the reason.
function meshfile.read(path)
  if type(path) ~= "string" or path == "" then
    error("meshfile.read: path must be a non-empty string, got " .. type(path), 2)
  end
  local format, unknown = format_of(path)
  if not format then fail(path, unknown) end
  local fine, data = pcall(sink.read_file, path)
  if not fine then fail(path, (data:gsub("^cannot read .-: ", "", 1))) end
  if data == "" then fail(path, "is empty") end
  return { data = data, format = format }
end

--- Returns the core's error about the content with the path in it: "obstacle mesh: file 'clip.ply': ...".
function meshfile.named(message, path)
  return (tostring(message):gsub("obstacle mesh: ", function(who)
    return ("%sfile '%s': "):format(who, path)
  end, 1))
end

return meshfile
