-- SPDX-License-Identifier: GPL-3.0-or-later
-- The house rules that scripts/lint.lua checks.
local rules = {}

-- Rooms ----------------------------------------------------------------------
-- A file in csrc/<room> may include its own room's headers and those of the rooms in its row, and call
-- their functions; nothing else from csrc. Rows are complete: nothing is inherited.
rules.ROOMS = {
  base = {},
  motion = { "base" },
  shape = { "base" },
  state = { "base" },
  wire = { "base", "state" },
  force = { "base", "state" },
  solve = { "base" }, -- matrices only
  system = { "base", "state", "solve", "force" }, -- it evaluates the wires' forces
  modal = { "base", "system" },
  integrate = { "base", "system" }, -- a system, never a force or a wire
  contact = { "base", "state", "shape", "motion", "solve", "system" }, -- a coupling of the system
  link = { "base", "motion", "state", "system" }, -- a wire of the system, never the scene
  calibrate = { "base", "wire", "force" },
  record = { "base" }, -- what is kept of a run, as data; who fills it knows the scene
  strand = { "base", "state", "force", "calibrate" }, -- meshes of particles along a wire; never the scene
  -- The rooms of a scene. Its lists, and what is in them:
  scene = { "base", "motion", "shape", "state", "wire", "force", "system", "integrate", "contact", "link",
    "record", "strand" },
  -- all as one system of bodies, lines and webs, and back
  body = { "base", "state", "force", "system", "integrate", "contact", "link", "strand", "scene" },
  -- grippers
  grip = { "base", "motion", "shape", "state", "wire", "solve", "system", "contact", "link", "strand",
    "scene", "body" },
  -- wires, holds, obstacles, forces: made, changed, taken away
  edit = { "base", "motion", "shape", "state", "wire", "force", "system", "contact", "calibrate", "link",
    "record", "strand", "scene", "body", "grip" },
  -- what may be asked of the state
  read = { "base", "state", "force", "system", "modal", "contact", "link", "record", "strand", "scene",
    "body", "grip" },
  -- what is kept and told of every accepted state
  watch = { "base", "shape", "state", "system", "modal", "contact", "link", "record", "strand", "scene",
    "body", "grip", "edit", "read" },
  -- the scene as a whole: its life, snapshots, files
  save = { "base", "motion", "shape", "state", "wire", "force", "system", "integrate", "contact", "link",
    "record", "strand", "scene", "body", "grip", "edit", "read", "watch" },
  -- another model for a wire, back to a snapshot where that fails
  remodel = { "base", "state", "wire", "solve", "system", "contact", "link", "strand", "scene", "body",
    "grip", "edit", "read", "save" },
  -- what makes it go on
  step = { "base", "motion", "state", "force", "system", "integrate", "contact", "link", "scene",
    "body", "grip", "edit", "read", "watch" },
  film = { "base", "read" },
  view = { "base" }, -- bytes for pages; never a scene
  draw = { "base", "film" }, -- of film: bytes made few
  bind = {}, -- the core through softworld.h
  probe = { "bind", "solve", "link", "scene", "body", "watch" }, -- of specs and benches; not installed
  host = { "bind" },
}

-- Headers other rooms may see: <room>/<room>.h, unless listed here (true = all of them).
-- state and solve have no single header: their parts have different users.
rules.OPEN = { base = true, bind = true,
  contact = { "contact.h", "crowd.h", "jolt.h", "mutual.h", "tally.h" },
  film = { "film.h", "pack.h", "skin.h" }, view = { "server.h" },
  read = { "frames.h" },
  force = { "force.h", "solid.h" }, link = { "hold.h", "joint.h", "spool.h" }, shape = { "tree.h" },
  state = { "angle.h", "clamp.h", "crease.h", "field.h", "first_stage.h", "hinge.h", "mesh.h", "plan.h",
    "slide.h", "state_tape.h", "tie.h", "web.h" },
  solve = { "band3.h", "band4.h", "blocks.h", "dense.h", "rotation.h", "sparse.h" },
  system = { "axial.h", "energy.h", "join.h", "linear.h", "rail.h", "system.h" } }

-- The rooms of a scene: each sees the headers of those in its row, which are private to everybody else.
rules.INSIDE = { "record", "strand", "scene", "body", "grip", "edit", "read", "watch", "save",
  "remodel", "step", "probe" }

-- Headers that show a whole object's inside, and how many files may include them at most; others take
-- what they need from narrow headers (scene/parts.h, scene/lookup.h).
rules.MOST_INCLUDERS = { ["scene/world.h"] = 11 }

-- May include softworld.h.
rules.USES_CORE = { bind = true, host = true }

-- One file per member (X(name) in the room's list.def): members do not include one another.
rules.FAMILIES = { wire = true, force = true, shape = true, integrate = true, link = true }

-- Outside headers and the only files that may include them (patterns on the path in csrc).
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

-- Words a file outside csrc/host may not use, with what to do instead.
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
  -- a child process reads mesh files: it has its own standard files, and leaves by _exit
  ["bind/mesh_child.c"] = { kill = true, waitpid = true, _exit = true, malloc = true },
  ["bind/process.c"] = { fork = true, open = true, _exit = true },
  -- workers of a study
  ["bind/bind_worker.c"] = { kill = true, waitpid = true, _exit = true },
  -- temporary files of the Lua library, which itself has no locks and no fsync
  ["bind/bind_files.c"] = { open = true, openat = true } }

-- Most files in a circle of files that need one another (scripts/circles.lua).
rules.MOST_IN_CIRCLE = 3

-- What the top level may hold, besides dot-files and what make and the examples leave there.
rules.TOP = "Makefile csrc lua scripts spec examples README.md"

rules.LICENCE = "SPDX-License-Identifier: GPL-3.0-or-later"
rules.LONGEST = 400 -- lines; longer files are hard to find one's way in
rules.LONGEST_HEADER = 250 -- lines; who includes a longer one knows more than they need

return rules
