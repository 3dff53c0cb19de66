-- SPDX-License-Identifier: GPL-3.0-or-later
-- Reads mesh files into memory; the core turns their content into triangles:
--   local file = meshfile.read("clip.stl")
--   scene:obstacle{ shape = "mesh", data = file.data, format = file.format, scale = 0.001 }
local blame = require "softworld.scene.blame"
local checks = require "softworld.checks"
local core = require "softworld.core"
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

-- Reports a wrong or misspelt `file`. The core takes a mesh's content and does not know this Lua word.
local function check_words(args)
  if args.file ~= nil and (type(args.file) ~= "string" or args.file == "") then
    error("obstacle mesh: file must be the name of a mesh file, got " .. checks.got(args.file), 0)
  end
  if args.shape ~= "mesh" or args.file then return end
  for key in pairs(args) do
    if core.nearest(checks.shown(key), { "file" }) then
      error(("obstacle mesh: there is no parameter '%s'; did you mean 'file'?"):format(checks.shown(key)), 0)
    end
  end
  if args.data == nil then
    error(("obstacle mesh: file is required, the name of a mesh file (%s), or data, its content")
      :format(table.concat(meshfile.formats, " ")), 0)
  end
end

local function make_from(args, make)
  check_words(args)
  local path = args.file
  if not path then return table.pack(make(args)) end
  local read, mesh = pcall(meshfile.read, path)
  if not read then error("obstacle mesh: " .. blame.plain(mesh), 0) end
  args.data, args.format, args.file = mesh.data, args.format or mesh.format, nil
  local made = table.pack(pcall(make, args))
  if not made[1] then error(type(made[2]) == "string" and meshfile.named(made[2], path) or made[2], 0) end
  return table.pack(table.unpack(made, 2, made.n))
end

--- Returns what make(args) returns for the parameters of a shape; before that the mesh file that args.file
-- names is read into args. Errors of parameters begin with `kind`, the shape and the object's name, if it
-- was given one: "obstacle box 'wall': ...".
function meshfile.make(kind, name, args, make)
  local fine, made = pcall(make_from, args, make)
  if fine then return table.unpack(made, 1, made.n) end
  if type(made) ~= "string" then error(made, 0) end
  error((blame.plain(made):gsub("^obstacle( ?%w*): ", function(shape)
    return ("%s%s%s: "):format(kind, shape, type(name) == "string" and (" '%s'"):format(name) or "")
  end, 1)), 0)
end

return meshfile
