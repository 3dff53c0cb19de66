-- SPDX-License-Identifier: GPL-3.0-or-later
local csv = require "softworld.csv"
local files = require "spec.output.files"
local program = require "host.program"
local series = require "softworld.output.series"
local sink = require "softworld.output.sink"

describe("sink", function()
  local folder

  before_each(function() folder = files.folder() end)
  after_each(function() files.remove(folder) end)

  it("writes text and leaves no other files", function()
    local path = folder .. "/a b'c\"%d µ.txt"
    assert.equal(path, sink.write_file(path, "one\0two\n"))
    assert.equal("one\0two\n", sink.read_file(path))
    assert.same({ "a b'c\"%d µ.txt" }, files.list(folder))
  end)

  it("writes through a function, and replaces the old content", function()
    local path = folder .. "/x.txt"
    sink.write_file(path, "old")
    sink.write_file(path, function(write) write("n", "e"); write "w" end)
    assert.equal("new", sink.read_file(path))
  end)

  it("keeps the old file and passes the error on when the function fails", function()
    local path = folder .. "/x.txt"
    sink.write_file(path, "old")
    local thrown = { "mine" }
    local ok, why = pcall(sink.write_file, path, function(write) write "half"; error(thrown) end)
    assert.is_false(ok)
    assert.equal(thrown, why)
    assert.equal("old", sink.read_file(path))
    assert.same({ "x.txt" }, files.list(folder))
  end)

  it("gives path and reason when a file cannot be written", function()
    assert.has_error(function() sink.write_file(folder .. "/no/x.txt", "") end,
      "cannot write " .. folder .. "/no/x.txt: No such file or directory")
    sink.make_folder(folder .. "/taken")
    local ok, why = pcall(sink.write_file, folder .. "/taken", "text")
    assert.is_false(ok)
    assert.truthy(why:find("cannot write " .. folder .. "/taken: ", 1, true))
    assert.same({ "taken" }, files.list(folder))
    assert.error_matches(function() sink.write_file(folder .. "/", "") end, "names a folder")
    assert.error_matches(function() sink.write_file("", "") end, "a file path")
    assert.error_matches(function() sink.write_file(folder .. "/a\0b", "") end, "zero byte")
    assert.error_matches(function() sink.write_file(folder .. "/a", 3) end, "function%(write%) expected")
  end)

  it("reports a full disk", function()
    assert(io.open("/dev/full", "wb")):close()
    local open = io.open
    io.open = function(path, mode) -- luacheck: ignore
      return open(mode == "wb" and "/dev/full" or path, mode)
    end
    local ok, why = pcall(sink.write_file, folder .. "/x", string.rep("x", 100000))
    io.open = open -- luacheck: ignore
    assert.is_false(ok)
    assert.truthy(why:find("No space left", 1, true), why)
  end)

  -- Ctrl-C is an error that a hook raises; here it comes after each number of instructions in turn.
  it("leaves no temporary file wherever an error of a hook comes", function()
    local script = folder .. "/script.lua"
    local file <close> = assert(io.open(script, "w"))
    file:write([[
      local sink = require "softworld.output.sink"
      local path = arg[1] .. "/x.txt"
      local function text(write) for i = 1, 5 do write(("a"):rep(i)) end end
      local n, cut, seen = 0, 0, 0
      for _, f in ipairs{ function() sink.write_file(path, text) end,
          function() sink.discard(sink.temporary(path)) end,
          function()
            local kept = sink.temporary(path, true)
            sink.write_file(kept .. "/part", "x")
            sink.remove_folder(kept, { "part" })
          end } do
        n = 0
        repeat
          n = n + 1
          local ok, why = pcall(function()
            debug.sethook(function()
              debug.sethook()
              error("interrupted", 0)
            end, "", n)
            f()
            debug.sethook()
          end)
          assert(ok or why == "interrupted", why)
          if not ok then cut = cut + 1 end
        until ok
      end
      print(cut > 200)
    ]])
    file:close()
    local out, err = program.run{ script, folder }
    assert.same({ "true\n", "" }, { out, err })
    assert.same({ "script.lua", "x.txt" }, files.list(folder))
  end)

  it("makes folders, with or without LuaFileSystem", function()
    sink.make_folder(folder .. "/a/b c/d")
    sink.make_folder(folder .. "/a/b c/d")
    assert.same({ "b c" }, files.list(folder .. "/a"))
    files.without_lfs(function()
      sink.make_folder(folder .. "/e/it's $HOME/f")
      sink.write_file(folder .. "/file", "")
      assert.error_matches(function() sink.make_folder(folder .. "/file/g") end,
        "cannot make folder .*/file/g: Not a directory")
    end)
    assert.same({ "it's $HOME" }, files.list(folder .. "/e"))
    assert.error_matches(function() sink.make_folder(folder .. "/file/g") end,
      "cannot make folder .*/file/g: ")
  end)

  it("writes numbers that read back to the same bits", function()
    math.randomseed(7)
    for _ = 1, 2000 do
      local x = string.unpack("d", string.pack("i8", math.random(0)))
      if x == x and math.abs(x) < math.huge then
        assert.equal(string.pack("d", x), string.pack("d", tonumber(sink.number(x)) + 0.0))
      end
    end
    assert.equal("0.10000000000000001", sink.number(0.1))
    assert.equal("9007199254740993", sink.number(9007199254740993))
    assert.same({ "nan", "nan", "inf", "-inf" },
      { sink.number(0 / 0), sink.number(-(0 / 0)), sink.number(1 / 0), sink.number(-1 / 0) })
  end)

  it("has one way to write a cell of a CSV file, in which no text is a formula", function()
    for text, cell in pairs { ["=1+2"] = "'=1+2", ["+x"] = "'+x", ["-x [m]"] = "'-x [m]", ["@a"] = "'@a",
      ["\t=a"] = "' =a", ["=a,b"] = [["'=a,b"]], ["-"] = "-", ["a-b=c"] = "a-b=c", [" a"] = '" a"',
      ['a"b'] = '"a""b"', ["a\nb"] = "a b", ["gr\252n"] = "gr\195\188n", ["gr\195\188n"] = "gr\195\188n" } do
      assert.equal(cell, sink.cell(text))
    end
    assert.same({ "", "-1", "-0.5", "nan" },
      { sink.cell(nil), sink.cell(-1), sink.cell(-0.5), sink.cell(0 / 0) })
    local data = { time = { 0 }, columns = { { name = "=cmd()", unit = "N", values = { -1 } } } }
    assert.equal("t [s],'=cmd() [N]\n0,-1\n", sink.read_file(series.csv(data, folder .. "/s.csv")))
    csv.write(folder .. "/c.csv", { "@a", "t" }, { ["@a"] = { -1 }, t = { "=b;c" } })
    assert.equal("'@a,t\n-1,\"'=b;c\"\n", sink.read_file(folder .. "/c.csv"))
    local back = csv.read(folder .. "/c.csv", { text = { t = true } })
    assert.same({ ["@a"] = { -1 }, t = { "=b;c" } }, back.columns)
  end)

  it("quotes words for the shell", function()
    for _, word in ipairs { "it's", "$HOME `id`", "a\nb", "-n", "%s", '"', "\\" } do
      local ok, text = sink.run("printf '%s.' " .. sink.quote(word))
      assert.is_true(ok)
      assert.equal(word .. ".", text)
    end
  end)

  it("splits paths into folder and extension", function()
    assert.same({ ".", "/", "a/b", "/a" },
      { sink.folder "x", sink.folder "/x", sink.folder "a/b/x", sink.folder "/a/x" })
    assert.same({ "gz", "", "", "svg" }, { sink.extension "a.tar.gz", sink.extension "a.b/c",
      sink.extension ".hidden", sink.extension "A.SVG" })
  end)

  it("names the Debian package of a missing program", function()
    files.without_programs(function()
      assert.has_error(function() sink.need("gnuplot", "gnuplot-nox", "a chart") end,
        "a chart needs the program gnuplot, which is not installed: apt-get install gnuplot-nox")
    end)
  end)

  it("returns exit codes and output", function()
    assert.same({ false, "", 3 }, { sink.run "exit 3" })
    assert.same({ true, "out\nerr\n", 0 }, { sink.run "echo out; echo err >&2" })
    assert.equal(127, (select(3, sink.run "no-such-program-at-all")))
  end)
end)
