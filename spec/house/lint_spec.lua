-- SPDX-License-Identifier: GPL-3.0-or-later
-- Each rule of scripts/lint.lua finds the mistake it is for, and only that.
local tree = require "house.tree"

local C = "/* SPDX-License-Identifier: GPL-3.0-or-later */\n"
local LUA = "-- SPDX-License-Identifier: GPL-3.0-or-later\n"

local function lint(only, files)
  local folder = tree.make(files)
  local text, status = tree.run(("lua5.4 %s --only %s %s"):format(
    tree.quote(tree.root .. "/scripts/lint.lua"), only, tree.quote(folder)))
  tree.remove(folder)
  return text, status
end

local function finds(only, files, where, words)
  local text, status = lint(only, files)
  assert.truthy(text:find(where, 1, true), "no finding at " .. where .. " in:\n" .. text)
  assert.truthy(text:find(words, 1, true), "no '" .. words .. "' in:\n" .. text)
  assert.equal(1, status)
end

local function clean(only, files)
  local text, status = lint(only, files)
  assert.equal("", text)
  assert.equal(0, status)
end

describe("lint: layout", function()
  it("keeps the top level short", function()
    finds("layout", { ["notes.txt"] = "" }, "notes.txt:1:", "top level")
    clean("layout", { ["README.md"] = "", ["csrc/a/b.c"] = "", [".ci/run"] = "", ["out/a"] = "",
      ["build-asan/a"] = "" })
  end)
end)

describe("lint: licence line", function()
  it("is required in C, Lua, shell and Makefile", function()
    finds("spdx", { ["csrc/base/a.c"] = "int a;\n" }, "csrc/base/a.c:1:", "no licence line")
    finds("spdx", { ["csrc/base/a.def"] = "X(a)\n" }, "csrc/base/a.def:1:", "no licence line")
    finds("spdx", { ["scripts/a.lua"] = "print(1)\n" }, "scripts/a.lua:1:", "no licence line")
    finds("spdx", { ["scripts/a.sh"] = "#!/bin/sh\nls\n" }, "scripts/a.sh:1:", "no licence line")
    finds("spdx", { Makefile = "" }, "Makefile:1:", "no licence line")
  end)
  it("may follow a #! line", function()
    clean("spdx", { [".ci/run"] = "#!/bin/sh\n# SPDX-License-Identifier: GPL-3.0-or-later\n" })
  end)
end)

describe("lint: rooms", function()
  local function includes(path, line, words)
    finds("includes", { [path] = C .. "\n" .. line .. "\n" }, path .. ":3:", words)
  end
  it("rejects a room that includes a room it may not know", function()
    includes("csrc/integrate/newmark.c", '#include "force/force.h"', "integrate may not include")
    includes("csrc/solve/band.c", '#include "state/state.h"', "solve may not include")
    includes("csrc/base/vec.h", '#include "state/state.h"', "nothing else")
  end)
  it("rejects another room's private header", function()
    includes("csrc/force/bend.c", '#include "state/slots.h"', "private to state")
    includes("csrc/film/a.c", '#include "read/kept_frames.h"', "private to read")
  end)
  it("lets only steps include both scene and step headers", function()
    clean("includes", { ["csrc/step/a.c"] = C .. '#include "scene/world.h"\n' })
    includes("csrc/scene/a.c", '#include "step/step.h"', "scene may not include")
  end)
  it("counts the files that include the scene's internals", function()
    local files = {}
    for k = 1, 11 do files[("csrc/step/a%02d.c"):format(k)] = C .. '#include "scene/world.h"\n' end
    clean("includes", files)
    files["csrc/step/b.c"] = files["csrc/step/a01.c"]
    finds("includes", files, "csrc/step/b.c:2:", "scene/world.h has more than 11 includers")
  end)
  it("rejects a member that includes another member", function()
    finds("includes", { ["csrc/force/list.def"] = C .. "X(bend)\nX(twist)\n",
      ["csrc/force/twist.c"] = C .. '#include "force/bend.h"\n' }, "csrc/force/twist.c:2:",
      "member twist includes member bend")
  end)
  it("rejects the core's internals in the binding", function()
    includes("csrc/bind/scene.c", '#include "scene/scene.h"', "through softworld.h only")
    includes("csrc/scene/scene.c", '#include "softworld.h"', "headers of the rooms")
  end)
  it("rejects included C files, unknown rooms and includes without a room", function()
    includes("csrc/base/a.c", '#include "base/b.c"', "is included")
    finds("includes", { ["csrc/kitchen/a.c"] = C }, "csrc/kitchen/a.c:1:", "csrc/kitchen is no room")
    includes("csrc/base/a.c", '#include "vec.h"', "names no room")
  end)
  it("accepts valid includes", function()
    clean("includes", { ["csrc/force/list.def"] = C .. "X(bend)\n",
      ["csrc/force/bend.c"] = C .. '#include "force/bend.h"\n#include "force/force.h"\n'
        .. '#include "base/vec.h"\n#include "state/state.h"\n#include <math.h>\n'
        .. '#include "force/list.def"\n#include "force/helper.h"\n',
      ["csrc/bind/a.c"] = C .. '#include <lua.h>\n#include "softworld.h"\n#include "bind/class.h"\n',
      ["csrc/softworld.h"] = C .. '#include "force/force.h"\n' })
  end)
end)

describe("lint: circles of files", function()
  local function file(name, calls)
    local code = C .. "void sw_" .. name .. "(void);\n/* sw_a() */\nvoid sw_" .. name .. "(void) {\n"
    for _, other in ipairs(calls) do code = code .. "  sw_" .. other .. "();\n" end
    return code .. "}\n"
  end
  it("may have three files, but not four", function()
    local three = { ["csrc/base/b.c"] = file("b", { "c" }), ["csrc/base/c.c"] = file("c", { "d" }),
      ["csrc/base/d.c"] = file("d", { "b" }), ["csrc/base/e.c"] = file("e", { "b", "d" }) }
    clean("circles", three)
    three["csrc/base/d.c"] = file("d", { "e" })
    finds("circles", three, "csrc/base/b.c:1:", "circle of 4 files (3 at most)")
  end)
  it("reject a call into a room that may not be included, whichever header declares it", function()
    local calls = { ["csrc/base/b.c"] = file("b", {}), ["csrc/solve/c.c"] = file("c", { "b" }) }
    clean("circles", calls)
    calls["csrc/base/b.c"], calls["csrc/solve/c.c"] = file("b", { "c" }), file("c", {})
    finds("circles", calls, "csrc/base/b.c:1:", "calls sw_c of csrc/solve/c.c, whose room it may not include")
  end)
  it("ignore functions of the same name that are static in their files", function()
    local four = {}
    for _, name in ipairs { "b", "c", "d", "e" } do
      four["csrc/base/" .. name .. ".c"] = file(name, {}) .. "static void go(void) {\n}\n"
    end
    clean("circles", four)
  end)
end)

describe("lint: outside libraries", function()
  local function outside(path, line)
    finds("includes", { [path] = C .. line .. "\n" }, path .. ":2:", "may be included only in")
  end
  it("may be included only in their adapters", function()
    outside("csrc/force/bend.c", "#include <lua.h>")
    outside("csrc/scene/scene.c", '#include "lauxlib.h"')
    outside("csrc/solve/band.c", "#include <gsl/gsl_linalg.h>")
    outside("csrc/shape/hull.c", "#include <ccd/ccd.h>")
    outside("csrc/shape/mesh.c", "#include <assimp/cimport.h>")
    outside("csrc/shape/mesh_assimp.c", "#include <libqhull_r/qhull_ra.h>")
    outside("csrc/solve/sparse.c", "#include <suitesparse/cholmod.h>")
    outside("csrc/bind/a.c", "#include <readline/readline.h>")
  end)
  it("are accepted in their adapters", function()
    clean("includes", { ["csrc/shape/ccd_adapter.c"] = C .. "#include <ccd/ccd.h>\n",
      ["csrc/calibrate/fit_gsl.c"] = C .. "#include <gsl/gsl_vector.h>\n",
      ["csrc/shape/hull_qhull.c"] = C .. "#include <libqhull_r/qhull_ra.h>\n" })
  end)
end)

describe("lint: calls", function()
  local function calls(body, words)
    finds("calls", { ["csrc/scene/a.c"] = C .. "void a(void) {\n  " .. body .. "\n}\n" },
      "csrc/scene/a.c:3:", words)
  end
  it("of file, print, exit and plain allocation functions are rejected", function()
    calls('FILE *f = fopen("a", "r");', "calls fopen")
    calls('printf("%d", 1);', "calls printf")
    calls("puts (text);", "calls puts")
    calls("f(g, stderr);", "uses stderr")
    calls("exit(1);", "calls exit")
    calls("double *x = malloc(8);", "calls malloc")
  end)
  it("in comments, strings, longer names and members are ignored", function()
    clean("calls", { ["csrc/scene/a.c"] = C .. [[
/* printf("x") and fopen(
   malloc(3) */
// puts("x")
const char *a = "exit(1) \" puts(2)"; char c = '"';
int b = snprintf(buffer, n, "printf(") + sink->open(1) + my_malloc(2) + sink.rename(3);
]], ["csrc/host/main.c"] = C .. 'int main(void) { puts("x"); return 0; }\n' })
  end)
end)

describe("lint: headers", function()
  it("must compile alone", function()
    finds("headers", { ["csrc/base/a.h"] = C .. "size_t a(void);\n" }, "csrc/base/a.h:2:",
      "must compile alone")
    clean("headers", { ["csrc/base/a.h"] = C .. "#include <stddef.h>\nsize_t a(void);\n" })
  end)
end)

describe("lint: checkers", function()
  it("warn of long files without failing", function()
    local text, status = lint("length", { ["lua/a.lua"] = LUA .. ("\n"):rep(400) })
    assert.truthy(text:find("lua/a.lua:400: warning: 401 lines", 1, true), text)
    assert.equal(0, status)
  end)
  it("reject a header at fewer lines", function()
    clean("length", { ["csrc/a/b.h"] = C .. ("\n"):rep(249) })
    finds("length", { ["csrc/a/b.h"] = C .. ("\n"):rep(250) }, "csrc/a/b.h:250:", "251 lines, 250 at most")
    clean("length", { ["csrc/a/b.c"] = C .. ("\n"):rep(250) })
  end)
  it("pass on the warnings of luacheck", function()
    finds("luacheck", { ["lua/a.lua"] = LUA .. "undefined_thing()\n" }, "lua/a.lua:2", "undefined_thing")
    clean("luacheck", { ["lua/a.lua"] = LUA .. "print(1)\n" })
  end)
  it("say what to install when a checker is missing", function()
    local folder = tree.make { ["csrc/base/a.c"] = C, ["bin/none"] = "" }
    local text, status = tree.run(([[
      cd %s && for tool in sh find sort lua5.4; do ln -s "$(command -v $tool)" bin/; done
      PATH=bin lua5.4 %s --only tidy]]):format(tree.quote(folder),
      tree.quote(tree.root .. "/scripts/lint.lua")))
    tree.remove(folder)
    assert.truthy(text:find("clang-tidy is not installed; sh scripts/setup.sh --lint", 1, true), text)
    assert.equal(1, status)
  end)
  it("refuse an unknown check", function()
    local text, status = lint("nonsense", {})
    assert.truthy(text:find("no check named nonsense", 1, true), text)
    assert.equal(2, status)
  end)
end)
