-- SPDX-License-Identifier: GPL-3.0-or-later
-- The house rules that scripts/lint.lua checks.
local rules = {}

-- Rooms ----------------------------------------------------------------------
-- A room is a folder of csrc. A file in csrc/<room> may include the headers of its own room and of the rooms
-- in its row, and call their functions; nothing else from csrc. Rows are complete: nothing is inherited.
rules.ROOMS = {
  base = {},
  motion = { "base" },
  shape = { "base" },
  state = { "base" },
  wire = { "base", "state" },
  force = { "base", "state" },
  solve = { "base" }, -- matrices only
  system = { "base", "state", "solve", "force" }, -- evaluates the wires' forces
  modal = { "base", "system" },
  integrate = { "base", "system" }, -- knows a system, but no force or wire
  touch = { "base", "solve", "system" }, -- the law of one touch, and its place in the equations
  -- wires and obstacles: a coupling of the system
  contact = { "base", "state", "shape", "motion", "solve", "system", "touch" },
  -- wires and particles with each other: a coupling of the system, by the same law
  mutual = { "base", "state", "solve", "system", "touch", "contact" },
  link = { "base", "motion", "state", "system" }, -- knows a wire of the system, but not the scene
  calibrate = { "base", "wire", "force" },
  record = { "base" }, -- recorded data of a run; other rooms, which know the scene, fill it
  strand = { "base", "state", "force", "calibrate" }, -- meshes of particles along a wire; not the scene
  -- The rooms of a scene. Its lists and their items:
  scene = { "base", "motion", "shape", "state", "wire", "force", "system", "integrate", "contact", "link",
    "record", "strand" },
  -- conversion of the scene to one system of bodies, lines and webs, and back
  body = { "base", "state", "solve", "force", "system", "integrate", "touch", "contact", "mutual", "link",
    "strand", "scene" },
  -- grippers
  grip = { "base", "motion", "shape", "state", "wire", "solve", "system", "contact", "link", "strand",
    "scene", "body" },
  -- adding, changing and removing wires, holds, obstacles and forces
  edit = { "base", "motion", "shape", "state", "wire", "force", "system", "contact", "calibrate", "link",
    "record", "strand", "scene", "body", "grip" },
  -- read-outs of the state
  read = { "base", "state", "force", "system", "modal", "touch", "contact", "mutual", "link", "record",
    "strand", "scene", "body", "grip" },
  -- recording and reporting of every accepted state
  watch = { "base", "shape", "state", "system", "modal", "contact", "mutual", "link", "record", "strand",
    "scene", "body", "grip", "edit", "read" },
  -- the scene as a whole: its life, snapshots, files
  save = { "base", "motion", "shape", "state", "wire", "force", "system", "integrate", "contact", "mutual",
    "link", "record", "strand", "scene", "body", "grip", "edit", "read", "watch" },
  -- changing the model of a wire; returns to a snapshot if that fails
  remodel = { "base", "state", "wire", "solve", "system", "contact", "link", "strand", "scene", "body",
    "grip", "edit", "read", "save" },
  -- time steps, runs and equilibria; a search for equilibrium that leads nowhere returns to a snapshot
  step = { "base", "motion", "state", "force", "system", "integrate", "touch", "contact", "mutual", "link",
    "scene", "body", "grip", "edit", "read", "watch", "save" },
  film = { "base", "read" },
  view = { "base" }, -- bytes for pages; knows no scene
  draw = { "base", "film" }, -- uses only the compression of film
  bind = {}, -- includes the core through softworld.h
  probe = { "bind", "solve", "link", "scene", "body", "watch" }, -- for specs and benches; not installed
  host = { "bind" },
}

-- Headers that other rooms may include: <room>/<room>.h, unless listed here (true = all headers).
-- state and solve have no single header, because their parts have different users.
rules.OPEN = { base = true, bind = true,
  contact = { "behind.h", "contact.h", "halt.h", "jolt.h", "resample.h", "trough.h" },
  mutual = { "crowd.h", "halt.h", "jolt.h", "mutual.h", "relief.h", "resample.h",
    "through.h" },
  touch = true,
  film = { "film.h", "pack.h", "skin.h" }, view = { "server.h" },
  read = { "frames.h" },
  force = { "force.h", "solid.h" }, link = { "hold.h", "joint.h", "spool.h" }, shape = { "tree.h" },
  state = { "angle.h", "clamp.h", "crease.h", "field.h", "first_stage.h", "hinge.h", "mesh.h", "plan.h",
    "slide.h", "state_tape.h", "tie.h", "web.h" },
  solve = { "band3.h", "band4.h", "blocks.h", "dense.h", "rotation.h", "sparse.h" },
  system = { "axial.h", "axis.h", "energy.h", "inner.h", "join.h", "linear.h", "outer.h", "part.h",
    "pushed.h", "rail.h", "system.h", "wait.h" } }

-- The rooms of a scene. Each of them may also include the private headers of those in its row.
rules.INSIDE = { "record", "strand", "scene", "body", "grip", "edit", "read", "watch", "save",
  "remodel", "step", "probe" }

-- Headers that show all fields of a large object, and how many files may include each at most. Other files
-- use narrow headers (scene/parts.h, scene/lookup.h).
rules.MOST_INCLUDERS = { ["scene/world.h"] = 11 }

-- Rooms that may include softworld.h.
rules.USES_CORE = { bind = true, host = true }

-- Rooms with one file for each member (X(name) in the room's list.def). Members do not include one another.
rules.FAMILIES = { wire = true, force = true, shape = true, integrate = true, link = true }

-- Headers of other libraries, and the only files that may include them (patterns of paths in csrc).
rules.OUTSIDE = {
  { "^lua%.h$", "^bind/", "^host/", "^probe/" },
  { "^lauxlib%.h$", "^bind/", "^host/", "^probe/" },
  { "^lualib%.h$", "^host/" },
  { "^gsl/", "_gsl%.c$" },
  { "^nlopt%.h$", "^calibrate/search_nlopt%.c$" },
  { "^ccd/", "^shape/ccd_adapter%.c$" },
  { "^assimp/", "^shape/mesh_assimp%.c$" },
  { "^libqhull", "^shape/hull_qhull%.c$" },
  { "^suitesparse/amd", "^solve/order_amd%.c$" },
  { "^suitesparse/", "^solve/cholmod_adapter%.c$" },
  { "^cholmod", "^solve/cholmod_adapter%.c$" },
  { "^readline/", "^host/" },
  { "^zlib%.h$", "^film/pack_zlib%.c$" },
  { "^civetweb%.h$", "^view/%w+_civetweb%.c$" },
}

-- Functions that files outside csrc/host must not call, and what to do instead.
rules.CALLS = {}
for word in ([[fopen freopen fdopen tmpfile popen open openat creat printf vprintf fprintf
    vfprintf dprintf puts fputs putchar fputc putc fwrite perror unlink remove rename]]):gmatch "%S+" do
  rules.CALLS[word] = "the core opens no file and prints nothing; write through a sink or return a status"
end
for word in ("exit _exit abort system"):gmatch "%S+" do
  rules.CALLS[word] = "the core never ends or leaves the process; return an sw_status"
end
for word in ("malloc calloc realloc aligned_alloc strdup"):gmatch "%S+" do
  rules.CALLS[word] = "use sw_alloc (base/alloc.h), so that specs can make it fail"
end
for word in ("fork vfork execv execve execvp execl execlp posix_spawn kill waitpid"):gmatch "%S+" do
  rules.CALLS[word] = "only bind/process.c starts a process, for mesh_child.c and bind_worker.c; see there"
end
rules.CALLS_ALLOWED = { ["base/alloc.c"] = { aligned_alloc = true, calloc = true },
  -- a child process reads mesh files; it has its own standard files and ends with _exit
  ["bind/mesh_child.c"] = { kill = true, waitpid = true, _exit = true, malloc = true },
  ["bind/process.c"] = { fork = true, open = true, _exit = true },
  -- workers of a study
  ["bind/bind_worker.c"] = { kill = true, waitpid = true, _exit = true },
  -- temporary files of the Lua library, as Lua has no locks and no fsync
  ["bind/bind_files.c"] = { open = true, openat = true } }

-- Largest allowed number of files in a circle of files that need each other (scripts/circles.lua).
rules.MOST_IN_CIRCLE = 3

-- Allowed entries of the top folder, besides dot-files and the outputs of make and the examples.
rules.TOP = "Makefile csrc lua scripts spec examples README.md"

rules.LICENCE = "SPDX-License-Identifier: GPL-3.0-or-later"
rules.LONGEST = 400 -- longest file [lines]; longer files are hard to navigate
rules.LONGEST_HEADER = 250 -- longest header [lines]; a longer one shows more than its users need

return rules
