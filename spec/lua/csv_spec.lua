-- SPDX-License-Identifier: GPL-3.0-or-later
-- CSV files: reading, writing, and trajectories from them.
local csv = require "softworld.csv"
local trajectory = require "softworld.trajectory"

local function file_with(text)
  local path = os.tmpname()
  local file = assert(io.open(path, "wb"))
  file:write(text)
  file:close()
  finally(function() os.remove(path) end)
  return path
end

local function message(f, ...)
  local fine, text = pcall(f, ...)
  assert.is_false(fine)
  return text
end

describe("csv.read", function()
  it("takes commas, semicolons, tabs, comments, quotes, BOM and CRLF", function()
    for _, text in ipairs { "a,b\n1,2\n3,4\n", "\239\187\191a;b\r\n1;2\r\n\r\n3;4",
      "# note\na\tb\n 1 \t2\n#x\n3\t4e0\n",
      '"a","b"\n1,2\n"3",+4.\n' } do
      local data = csv.parse(text)
      assert.are.same({ "a", "b" }, data.names)
      assert.are.same({ a = { 1, 3 }, b = { 2, 4 } }, data.columns)
    end
  end)

  it("names the place and the fault", function()
    local path = file_with "t,x\n0,1\n1, abc\n"
    assert.are.equal(path
      .. ":3:4: 'abc' in column 'x' is not a number; expected a number with a decimal point",
      message(csv.read, path))
    assert.matches("^text:2:1: 'nan' in column 'a'", message(csv.read, "a,b\nnan,2\n"))
    assert.matches("^text:2:3: the cell of column 'b' is empty", message(csv.read, "a,b\n1,\n"))
    assert.matches("^text:2:3: '0,5' in column 'b' has a decimal comma.*: 0%.5$", message(csv.read,
      "a;b\n1;0,5\n"))
    assert.matches("^text:3:5: 3 cells in this row, but 2 columns", message(csv.read, "a,b\n1,2\n1,2,3\n"))
    assert.matches("^text:3:1: 1 cell in this row, but 2 columns", message(csv.read, "a,b\n1,2\n7\n"))
    assert.matches("^text:1:3: there are two columns named 'a'", message(csv.read, "a,a\n1,2\n"))
    assert.matches("^text:2:1: '1e999' in column 'a' is too large", message(csv.read, "a\n1e999\n"))
    assert.matches("^text:1:1: the first row must name the columns", message(csv.read, "1,2\n"))
    assert.matches("quoted cell does not end", message(csv.read, 'a,b\n"1,2\n'))
    assert.matches("0x10", message(csv.read, "a\n0x10\n"))
    assert.matches("cannot read /nowhere/lay.csv: No such file", message(csv.read, "/nowhere/lay.csv"))
    assert.matches("cannot read /: ", message(csv.read, "/"))
  end)
end)

describe("csv.write", function()
  it("keeps every digit and text", function()
    local path = file_with ""
    local columns = { a = { 0.1, 1 / 3, 5e-324, -1.7976931348623157e308 }, b = { 1, 2, 3, 4 },
      ["c, d"] = { "x", 'say "y"', "z;", "" } }
    csv.write(path, { "b", "a", "c, d" }, columns)
    local data = csv.read(path, { text = { ["c, d"] = true } })
    assert.are.same({ "b", "a", "c, d" }, data.names)
    assert.are.same(columns, data.columns)
  end)

  it("names the reason of a failure, and leaves no file", function()
    assert.matches("cannot write /nowhere/a.csv", message(csv.write, "/nowhere/a.csv", { "a" }, { a = {
      1 } }))
    assert.matches("no column 'b'", message(csv.write, "/tmp/never.csv", { "b" }, { a = { 1 } }))
    assert.is_nil(io.open "/tmp/never.csv")
  end)
end)

describe("a trajectory from a CSV file", function()
  local function ends(m)
    return m:position(m:starts()), m:position(m:ends())
  end

  it("understands units, a scale and files without column names", function()
    for _, case in ipairs { { "x_mm,y_mm,z\n0,0,0\n300,0,0.1\n" }, {
      "X [mm];y [mm];z [m]\n0;0;0\n300;0;0.1\n" },
      { "x,y,z\n0,0,0\n300,0,100\n", 1e-3 }, { "0\t0\t0\n0.3\t0\t0.1\n" }, { "x_cm,y,z_m\n0,0,0\n30,0,0.1\n",
        7 } } do
      local first, last = ends(trajectory { path = file_with(case[1]), scale = case[2], speed = 0.1 })
      assert.are.same({ 0, 0, 0 }, first)
      assert.is_true(math.abs(last[1] - 0.3) + math.abs(last[2]) + math.abs(last[3] - 0.1) < 1e-15)
    end
  end)

  it("takes times and orientations", function()
    local m = trajectory {
      path = file_with "t_ms,x,y,z,rz_deg,rx,ry,_force\n500,0,0,0,0,0,0,7\n1500,1,0,0,90,0,0,9\n" }
    assert.are.equal(0.5, m:starts())
    assert.are.equal(1.5, m:ends())
    assert.is_true(math.abs(m:rotation(1)[1] - math.cos(math.pi / 8)) < 1e-15)
    m = trajectory { path = "0,0,0,0,1,0,0,0\n1,1,0,0,0,0,0,-1\n", law = "linear" }
    assert.is_true(math.abs(math.abs(m:angular_velocity(0.5)[3]) - math.pi) < 1e-12)
  end)

  it("names the place and the fault", function()
    local function wrong(text, scale)
      return message(trajectory.new, { path = text, speed = 1, scale = scale })
    end
    assert.matches("^text:3:1: t = 0.5 s does not come after 1 s in line 2",
      wrong "t,x,y,z\n1,0,0,0\n0.5,1,0,0\n")
    assert.matches("^text:3:1: way%-point %(1, 2, 3%) m repeats line 2", wrong "x,y,z\n1,2,3\n1,2,3\n")
    assert.matches("^text: a path needs at least 2 way%-points, got 1", wrong "x,y,z\n1,2,3\n")
    assert.matches("^text: no way%-points", wrong "# nothing\n")
    assert.matches("^text:1:3: column 'yy' is not known; expected t x y z", wrong "x,yy,z\n1,2,3\n")
    assert.matches("^text:1:1: there is no column 'z'", wrong "x,y\n1,2\n")
    assert.matches("^text:1:1: there is no column 'qz'", wrong "x,y,z,qw,qx,qy\n1,2,3,1,0,0\n")
    assert.matches("^text:1:1: column 'x_kg': 'kg' is not a unit for x, which is in %[m%]",
      wrong "x_kg,y,z\n1,2,3\n")
    assert.matches("^text:1:5: 'x' and 'x_mm' are the same column", wrong "x,y,x_mm,z\n1,2,3,4\n")
    assert.matches("^text:2:7: the quaternion .* has length 0.5; expected 1",
      wrong "x,y,z,qw,qx,qy,qz\n1,2,3,0.5,0,0,0\n")
    assert.matches("orientations are given twice", wrong "x,y,z,qw,qx,qy,qz,rx,ry,rz\n1,2,3,1,0,0,0,0,0,0\n")
    assert.matches("scale = %-1 is not allowed", wrong("x,y,z\n1,2,3\n2,3,4\n", -1))
    assert.matches("cannot read none.csv", wrong "none.csv")
    assert.matches("path must be a file name or an array of way%-points, got number",
      message(trajectory.new, { path = 3, speed = 1 }))
  end)

  it("comes back from the file that it was saved to", function()
    local path = file_with ""
    local m = trajectory { path = { { 0, 0, 0 }, { 1, 2, 3 } }, turn = { axis = { 1, 1, 0 }, angle = 2 },
      duration = 2 }
    m:save(path, 401)
    local again = trajectory { path = path }
    for i = 0, 20 do
      for k = 1, 3 do assert.is_true(math.abs(again:position(i / 10)[k] - m:position(i / 10)[k]) < 1e-7) end
      for k = 1, 4 do assert.is_true(math.abs(again:rotation(i / 10)[k] - m:rotation(i / 10)[k]) < 1e-7) end
    end
  end)
end)
