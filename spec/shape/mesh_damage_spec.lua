-- SPDX-License-Identifier: GPL-3.0-or-later
-- Mesh files with wrong words in them: refused with the place, never read as another mesh.
local core = require "softworld.core"

local POINTS = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
local FACES = "3 0 2 1\n3 0 1 3\n3 0 3 2\n"
local STL = "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n%s\nvertex 0 1 0\nendloop\nendfacet\n"
  .. "endsolid x\n"

local function mesh(data, format)
  return core.shape { shape = "mesh", data = data, format = format }
end

local function refused(data, format, text)
  local fine, message = pcall(mesh, data, format)
  assert.is_false(fine, "read: " .. data)
  assert.is_truthy(message:find("obstacle mesh: data is not readable as " .. format, 1, true), message)
  assert.is_truthy(message:find(text, 1, true), message)
  assert.is_nil(message:find "%c", message)
  return message
end

describe("an OFF file", function()
  it("is refused when a face names a point that it does not have", function()
    for _, word in ipairs { "77", "4", "-1", "x", "0.5", "1\27" } do
      refused("OFF\n4 4 0\n" .. POINTS .. FACES .. "3 1 2 " .. word .. "\n", "off",
        ("face 4 names point %s; the file has 4 points (0 to 3)"):format((word:gsub("%c", "?"))))
    end
  end)

  it("is refused when its head declares too few points, faces or numbers", function()
    local rest = POINTS .. FACES .. "3 1 2 3\n"
    refused("OFF\n4 2 0\n" .. rest, "off", "declares 4 points and 2 faces, and more lines follow")
    refused("OFF\n3 4 0\n" .. rest, "off", "face 3 names point 3; the file has 3 points (0 to 2)")
    for _, counts in ipairs { "4", "4 4", "4 x 0" } do
      refused("OFF\n" .. counts .. "\n" .. rest, "off", "its head has no numbers of points, faces and edges")
    end
    refused("4 4 0\n" .. rest, "off", "does not begin with the word OFF")
  end)

  it("is refused when a point has a word that is not a number", function()
    refused("OFF\n4 3 0\n" .. POINTS:gsub("0 1 0", "0 1,5 0") .. FACES, "off",
      "point number 3 has '1,5' where a number should be")
    refused("4OFF\n4 3 0\n" .. POINTS .. FACES, "off", "point number 1 is not whole")
  end)

  it("may have comments, colours and its counts beside the first word", function()
    local faces = FACES .. "3 1 2 3\n"
    for _, data in ipairs { "OFF 4 4 0\n" .. POINTS .. faces,
      "OFF # by hand\n# more\n4 4 0 # counts\n\n" .. POINTS:gsub("\n", " # point\n") .. faces,
      "COFF\n4 4 0\n" .. POINTS:gsub("\n", " 0 0 0 1\n") .. faces,
      "OFF\r\n4 4 6\r\n" .. POINTS:gsub("0 1 0", "-0. +1.0E+0 .0e1") .. faces:gsub("\n", " 0.5 0 0\n") } do
      local points, corners = mesh(data, "off"):triangles()
      assert.same({ 12, 12 }, { #points, #corners }, data)
    end
  end)
end)

describe("a PLY file", function()
  it("is refused when its points have no z", function()
    local function head(last)
      return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n" .. last
        .. "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
    end
    refused(head "" .. "0 0\n1 0\n0 1\n1 1\n" .. FACES, "ply", "its points have no property 'z'")
    refused(head "property float w\n" .. POINTS .. FACES, "ply", "its points have no property 'z'")
    assert.equal("mesh", mesh(head "property float z\n" .. POINTS .. FACES, "ply"):kind())
  end)
end)

describe("the error about a mesh file", function()
  it("names the line of a text STL that has a wrong word", function()
    refused(STL:format "vertex abc\1\27[1m 0 0", "stl",
      "line 5, a corner, needs three numbers, and has 'abc??[1m'")
    refused(STL:format "vertex 1 0", "stl", "line 5, a corner, needs three numbers, and has ''")
    assert.equal("mesh", mesh(STL:format "vertex 1e0 0 0", "stl"):kind())
  end)

  it("says in plain words what is wrong, then the start of the library's text", function()
    refused("solid x\nendsolid x\n", "stl", "stl: it has no triangles; write the file anew (")
    refused("v 0 0 0\nv 1 0 0\n", "obj", "obj: it has no triangles; write the file anew (")
    refused("v 0 0 0\nf 1 2 3\n", "obj", "obj: a face names a point that the file does not have; ")
    refused(("\0"):rep(500), "glb", "glb: it does not begin as such a file does; ")
    local long = refused("v 0 0 0\nv 1 0 0\n", "obj", "...)")
    assert.is_true(#long:match "%(the reader says: (.+)%)$" <= 66, long)
  end)
end)
