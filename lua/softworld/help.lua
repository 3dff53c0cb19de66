-- SPDX-License-Identifier: GPL-3.0-or-later
--- Help at the prompt, made from the same parameter rows that check arguments.
--
--     help()            -- what there is
--     help "wire"       -- parameters of scene:wire
--     help "box"        -- parameters of an obstacle, a force, a clamp, ...
--     help(scene)       -- methods of an object
-- @module softworld.help
local core = require "softworld.core"
local checks = require "softworld.checks"

local notes = {
  scene = "sw.scene{...}",
  wire = "scene:wire{...} (and a section, see help 'section', or a cable, see help 'cable')",
  section = "scene:wire{...}: what the wire is made of", obstacle = "scene:obstacle{ shape =, ... }",
  run = "scene:run{...}", settle = "scene:settle{...}",
  frequencies = "wire:frequencies{...}: natural frequencies [Hz] about the present equilibrium",
  wire_mesh = "scene:wire{ model = 'tube' | 'radial' | 'cubic' | 'composite' }: what meshes take besides",
  remodel = "wire:remodel{ model =, ... }: another model for a wire in mid-run",
  wire_contact = "scene:wire_contact{...}: wires and objects of particles that touch each other and themselves",
  particles = "scene:particles{...}: any object of particles: fabric, foam, nets, chains",
  repel = "repel = {...} of scene:particles",
  join = "scene:join{...}: wires fixed to each other at a point, as in a harness",
  calibrate = "sw.calibrate{ mesh =, ... }: springs of a mesh of particles that is the given wire",
  calibrate_tube = "sw.calibrate{ mesh = 'tube', ... }: rings, with or without a central line",
  calibrate_radial = "sw.calibrate{ mesh = 'radial', ... }: layers and sectors around a line",
  calibrate_cubic = "sw.calibrate{ mesh = 'cubic', ... }: voxels of a section",
  calibrate_composite = "sw.calibrate{ mesh = 'composite', ... }: a shell around cores, bonded or not",
  trajectory = "sw.trajectory{...}; clamps, obstacles and grippers take the table itself",
}

-- What has no parameter rows.
local texts = {
  gripper = [[
scene:gripper{ name =, pads = {...}, at = {x, y, z} [m], rotation =, arm = { radius =, length = [m] },
  slip_tolerance = [m], on_crash = "record" | "warn" | "stop" | function }
  pads: shape = "flat" | "v" | "round" | "mesh", width, height, thickness, below, opening, radius [m],
    angle [rad], file, scale, restitution, fingers, friction, kinetic_friction (or a list: per finger)
  :grasp(wire, { s = [m], approach = "imposed" })     the wire is one with the gripper
  :grasp(wire, { s =, approach = "plates", force = [N] | distance = [m], speed = [m/s], on_slip = })
  :grasp(wire, { s =, approach = "mixed", force =, ... })   see help 'mixed'
  :close_jaws{ force = | distance = | speed = } :open_jaws{ distance =, speed = }
  :move{ by =, to =, points =, path =, turn =, speed = [m/s], duration = [s], law =, on_slip = }
  :move_to(point, {...}) :rotate{ axis =, angle = [rad], duration = [s] }
  :press{ force = [N], direction =, speed =, distance = }   in a process -> force, way, done
  :wait(seconds) :approach(wire, {...}) :retreat{...}; several wires at once: see help 'handling'
  :handover(other, {...}) :release{ wire = }
  :force{ axes = "gripper", finger = } :moment{ at =, axes =, finger = } :position()   [N], [N m], [m]
  :state()           .jaws .opening .squeeze .normal .margin .sliding .slip .place
  :squeeze()         .height .width [m] .share   :pressure_map{ cell = {x, z} } [Pa]
  .events            { kind = "slip" | "lost" | "crash" | "missed" | "crushed" | "frozen" | ..., time = }
  .peak_force .mean_force .impulse              over all grasps [N], [N s]
  .peak_moment .mean_moment                     [N m]
  :over(t1, t2, { at =, window = [s] }) :series()   see help 'peaks']],
  mixed = [[
gripper:grasp(wire, { s = [m], approach = "mixed", force = [N] })     in a process
  the wire becomes a mesh near the pads; these squeeze it for real; once force and slip are steady it
  is carried on as a rod in a rigid grip (frozen) at the cost of one; released through the mesh again
  model = "radial", section = "solid", spacing, particles, layers, across   of the mesh; see help 'remodel'
  region = [m]      length of the mesh (default: the pads and 6 radii on both sides)
  margin = 0.9      force and moment over what the pads could bear at which they take over again
  freeze = false    stay with the plates; gripper:freeze() and :thaw() switch by hand]],
  process = [[
scene:process(function(p) ... end)
  p:wait(seconds)     p.time is the scene's [s]
  p:feed(feed, { length = [m], speed = [m/s] })
  p:wait_until(function() return ... end, { timeout = [s] })   true, or false after the timeout
  p:wait_until({ force = [N], on = gripper } | { slip = [m], on = gripper } | { contact = obstacle } |
    { distance = [m], between = { a, b } })   a place: a point, gripper, obstacle, { wire, s = }
  p:step("name", function() ... end)   a step that a saved run begins again after; see help 'save'
  grippers' move and rotate return when they are done]],
  save = [[
scene:save "file.sws"              everything that the scene is; not while processes are under way
local scene = sw.load "file.sws"   it again; scene:find "name" gives what is in it, scene:names() all
scene:run{ save = "file.sws" }     writes it after every step (p:step) of the processes
scene:run{ resume = "file.sws" }   goes on from the file, if it is there, and leaves out the steps that
                                   are done; with the same bits, on the same kind of machine
scene:resume "file.sws"            the same before the run: true, or false when there is no such file
A script that goes on must build the same scene and processes again; between steps a process may
compute and print, not let time pass or change the scene. p:step returns what its function returned,
also when it was left out. Lua functions as forces, and trajectories by a Lua function that is under
way, cannot be saved.]],
  snapshot = [[
local before = scene:snapshot()   the scene as it is
scene:restore(before)             back to it, bit by bit, as often as wanted]],
  cable = [[
print(sw.cables())              names of the catalogue, with size, mass, EI
print(sw.cable "GXL 1.5")       its sheet: values, units, spread, how known, source
scene:wire{ cable = "GXL 1.5", from =, to =, ... }
  EA, EI, GJ, mass_per_length, radius     of the entry where not given
  stiffness                               "default", or bounds: "slip", "stick"
  use             what bends are judged by: fixed termination movement load reeling pulleys
wire:bend_limit{ use =, now = true }      .ok .radius .limit [m] .s [m] .t [s]
wire:cable()                              the entry
sw.cable.define{ name =, outer_diameter = [m], mass_per_length = [kg/m], EA = [N], EI =, GJ = [N m2],
  friction =, temperature = { low =, high = } [degC], bend = { rule = "IEC 62440", use = "fixed" },
  construction = { strands =, strand_diameter = [m], conductor = "copper", insulation = "PVC" },
  flag = "measured" | "computed" | "guessed", source = "...", spread = [share] }
  a value may have its own: { value =, low =, high =, flag =, source = }
  what is missing is computed from the construction
sw.material "copper"            .E .G [Pa] .density [kg/m3]; materials of constructions]],
  tolerance = [[
scene:run{ tolerance = 1e-5, ... }         a number: error of one step [m], which chooses the steps
scene:run{ tolerance = { ... }, ... }      quantities: how far off each may be, in its unit
scene:settle{ tolerance = { ... } }
  tip = 1e-3, position = 1e-3              end, or whole shape, of the wire [m]
  max_tension, max_stress, max_strain      of the run [N], [Pa]
  min_bend_radius                          [m]
  force, moment                            of a clamp, pin, gripper; force on an obstacle [N], [N m]
  peak_force, mean_force, impulse          of a gripper [N], [N s]; ["table.peak_force"]: of an obstacle
  peak_moment, mean_moment                 [N m]
  energy, penetration                      of the scene [J]; deepest into an obstacle [m]
  ["left.force"] = 0.05                    the object's name in front where several have it
  { name = "sag", value = 1e-4, unit = "m", of = function() return -wire:position(0.5)[3] end }
                                           your own, a number or a list; at = [s] after the start
  beside it: levels = 5                    at most so many computations, 3 to 12 (settle: 7)
The scene is computed several times from where it is, with edges (and in a run steps) halved each
time, until no quantity changes by more than asked for. A process's function runs each time anew.
  result.quantities.tip                    .value .error .unit .met, .where [m] and .when [s]
  print(result:error_bars())
  result.met                               all as asked for? if not, result.advice
  result.ok = false                        no level could be computed: .reason .where .advice, no numbers
Afterwards the scene is at the end of the finest computation; after an error as it was before.]],
  touches = [[
scene:wire_contact{ between = {a, b}, friction = 0.3 }   help "wire_contact"
for _, t in ipairs(scene:touches()) do ... end
  t.wires = {"a", "b"}  t.s = {s1, s2} [m]  t.point [m]
  t.normal, t.force, t.friction   towards and on the first wire [-], [N], [N]
  t.normal_force                  [N]
]],
  sections = [[
of wires that are meshes of particles (model = "tube", "radial", "cubic", ...), as they are now
wire:section(s)                 print it, or
  .least_width .largest_width   between parallel plates [m]; .least_direction .largest_direction
  :width(direction) .height     across a direction; upwards [m]
  .ovalisation                  (largest - least)/(largest + least) of widths, as in API RP 1111
  .area                         within the surface [m2]
  .torsion .twist_rate          turn since the wire's start [rad], [rad/m]
  .axial_strain .hoop_strain    of each of .particles [m]; .stress = E times the axial one [Pa]
  .outline .middle .tangent     points of the surface, which is .skin outside of the particles [m]
wire:width(s, direction)        [m]
wire:contact_pressure(s)        of the section nearest to s, or without s of all: a list of
  .particle .s .at .force .normal_force .area .pressure   [m], [N], [m2], [Pa]; .largest [Pa]
wire:von_mises(s)               of solid elements: a list of .stress .s .at; .largest [Pa]
wire:folded()                   where [m] and when [s] a section of springs folded through itself;
                                nothing when none has. Solid elements do not
wire:max_ovalisation()          of the run, where [m], when [s]; { now = true }
wire:calibration()              its springs, see help "calibrate"]],
  clip = [[
scene:clip{ at = {x, y, z}, width = [m], insertion = [N], retention = [N], ... }   a snap-in clip
  at               the wire's centre line in the seat [m]
  direction, axis  from the seat to the mouth {0, 0, 1}; along the wire {1, 0, 0}
  width            along the axis [m]
  insertion        largest force of the lips on the way in [N]
  retention        and on the way out [N]
  friction         against sliding along the axis, = 0
  radius           of the seat [m], = that of each wire; way over the lips [m], = 1.5 of the radius
  stiffness        of floor and side walls [N/m], = 50 times the larger force over the radius
  strength         of these [N], = 20 times the larger force; pressed harder, from within or outside,
                   they break, and the wire is free: an event, as is a wire that crosses steeply
  snap             time that the lips take to pull a wire in [s], = 0.002
  on               the wire that it is for, = all of the scene; name
  :seated(wire) :state(wire)     is there one in it; "empty", "inserting", "seated", "broken"
  :force(wire) :height(wire)     on the wire [N]; over the seat [m]. Without wire: of all
  :ratio(wire)                   largest pull so far over retention
  .wire .peak_insertion_force    the one in the seat; [N]
  .inserted .pulled_out          nil, or .time [s] .peak_force [N] .wire .count, .s [m]
  .overloaded                    nil, or .time [s] .force [N] .by .wire .strength [N] where it broke
  :release()
gripper:clip{ into = clip, speed = [m/s], max_force = [N] }   in a process: presses its wire in
  approach_speed = 0.1, align = true   over the mouth before; speed = 0.02
  overtravel       beyond the seat [m], = the wire's radius
  max_force        = 5 times insertion; beyond it an error says what was reached, with fail = false
                   nil and that are returned
  returns { force = of the gripper, peak_force = of the lips [N], s = [m], duration = [s] }]],
  tie = [[
scene:tie(wire, { s = [m], to = {x, y, z} or { other, s = [m] }, ... })   from now on
  to               a point (= where the wire is now) or a place of another rod or string
  slack            distance up to which it does not pull [m], = the present one
  stiffness        beyond it, = 1e5 N/m
  strength         pull at which it breaks [N], = never; name
  :tension() :distance() :force()   now [N], [m]; on wire [N]
  .peak_force .broken               [N]; nil, or .time [s] .force [N]
  :release()]],
  channel = [[
scene:channel{ points = {{x, y, z}, ...}, width = [m], depth = [m], ... }   a trough along the points
  points           of the middle of its floor [m]; corners are mitred
  width, depth     inside [m]; thickness = 0.002 of floor and walls [m]
  up               where it is open, = {0, 0, 1}; friction = 0, restitution = 0; name
  lid              = false
  :force() :moment{ at = }       of all wires on it [N], [N m]
  :contains(wire)                share of the wire's length inside
  :close() :open() .closed       lid on, refused while a wire stands out; off
  .parts                         its obstacles
  :release()]],
  units = "sw.units.mm(5), sw.units.deg(30), ...: into SI units",
}

-- What comes after the parameters of a topic or member.
local more = {
  particles = [[
  particles are numbered from 1 on; a group of links is read faster than single ones
  returns an object: .name .count .mass [kg] .radius [m] and
  :positions() :velocities()     flat lists [m], [m/s]
  :particle(i)                   position, velocity [m], [m/s]
  :set_velocity(v, omega, about) as a rigid body; with a flat list each particle [m/s]
  :links()                       flat lists: force [N], strain [-], plastic strain [-]
  :energy()                      its own, by kind [J]
  scene:hold(object, { particles = {i, ...}, at =, name = })   a clamp: :force() :moment() :follow()
  scene:force{ kind = "push", on = object, particles = {...}, force = {x, y, z} }
  gravity, drag, line, damping and functions act on it too; its length, by which drag and line
  count, is the diagonal of a box around it as it was made, shared out by mass
  yield = 0.02, hardening = 0.1  links that stay longer or shorter beyond that strain
  only edges and particles touch obstacles, not the inside of a mesh; the same touch wires, other
  objects and their own after scene:wire_contact{...}, but not what a particle or two join]],
  join = [[
  scene:join{ ends = { { trunk, s = 0.5 }, { branch, s = 0 } } }   2 to 8, which must meet there
  returns a join: .name .held and
  :force(k) :moment(k)           on end number k [N], about the point [N m]
  :release()                     apart from now on
  rigid carries bending on from wire to wire, not twist: a wire still turns about its own axis]],
  calibrate = [[
  and a section (help "section") or cable = "name", and the mesh's own:
  help "calibrate_tube", help "calibrate_radial", help "calibrate_cubic",
  help "calibrate_composite"
  returns what print shows, and
  .springs[group] [N/m]          stiffness, times the weight of each link
  .links, .particles, .spacing   of one slice; the next is .spacing [m] further along z
  .mass, .shares                 of each particle of a slice [kg], [-]
  .shell, .core, .part, .centres of a composite: EA, EI, GJ of the parts; part of each particle
  .modulus, .nu, .scale          of elements [Pa], [-]; .core_modulus, .core_nu of a composite's core
  .EA .EI .EI2 .GJ .squeeze      reached [N], [N m2], [Pa]; .residuals: share of each that is off
  sw.calibrate.cell{ spacing =, particles =, links =, stiffness = }   the beam that any mesh is]],
  wire_mesh = [[
  and what the mesh itself takes: help "calibrate_tube", help "calibrate_radial",
  help "calibrate_cubic", help "calibrate_composite"
  section = "solid" is body = "solid"; wire:section(s) tells how a section is deformed
  a composite of elements: E, nu, density are the shell's; core_E, core_nu, core_density the core's ]],
  remodel = [[
  and what help "wire_mesh" lists. Shape, stretch, twist, velocity, momentum go over; holds stay
  returns { energy_before, energy_after, energy_change [J], before, after = { linear [N s],
  angular [N m s] about the place `about` [m] } }
  region = {s1, s2} [m]: rings there and beside clamps, elsewhere a line without twist ]],
  feed = [[
  returns a clamp (:force() :moment() :pose() :follow() :release()) and
  :fed()                         length paid out so far, unstressed [m]
  :speed() :speed(v)             now; from now on [m/s]
  :feed{ length = [m], speed = [m/s] or duration = [s], acceleration =, law = }   returns seconds
  :push(force)                   a force instead of a speed [N]
  :force_limit(force)            slip where more is needed; nil: never [N]
  :drive_force()                 what moves the wire [N]; the guide's walls bear the rest
  p:feed(feed, { length =, speed = })   inside a process: feeds and waits
  arc lengths are measured from the wire's present start; holds and forces stay where
  they are on the wire]],
}

-- Pages of the manual are read when they are asked for.
local PAGE = {}
for _, name in ipairs(require "softworld.manual") do texts[name] = PAGE end

local function text_of(topic)
  if texts[topic] == PAGE then texts[topic] = require("softworld.manual." .. topic) end
  return texts[topic]
end

local function range_of(row)
  if row.choices then return "one of " .. table.concat(row.choices, ", ") end
  if row.min and row.max then
    return ("%s%g, %g%s"):format(row.above and "(" or "[", row.min, row.max, row.below and ")" or "]")
  end
  if row.min then return (row.above and "> %g" or ">= %g"):format(row.min) end
  if row.max then return (row.below and "< %g" or "<= %g"):format(row.max) end
  return ""
end

local function default_of(row)
  if row.required then return "required" end
  if row.type == "choice" and row.choices then
    local name = row.choices[(row.default or -1) + 1]
    return name and "= " .. name or ""
  end
  if row.default and (row.type == "number" or row.type == "integer") then
    return ("= %.6g"):format(row.default)
  end
  return ""
end

local function show_rows(title, rows)
  print(title)
  for _, row in ipairs(rows) do
    print(("  %-16s %-9s %-12s %s%s"):format(row.name, row.unit == "-" and "" or "[" .. row.unit .. "]",
      default_of(row), row.doc, range_of(row) ~= "" and "; " .. range_of(row) or ""))
  end
  if #rows == 0 then print "  takes no parameters" end
end

local function outer(forces)
  local list = {}
  for _, f in ipairs(forces) do
    if not f.inner then list[#list + 1] = f end
  end
  return list
end

local function with_names(names)
  local list = {}
  for name in pairs(names) do list[#list + 1] = { name = name } end
  table.sort(list, function(a, b) return a.name < b.name end)
  return list
end

-- Families in the order in which they are shown: what one is called, its list,
-- and how it is used.
local function families(r)
  return {
    { "model", r.models, "scene:wire{ model = '%s', ... }" },
    { "hold", r.holds, "scene:%s(wire, {...})" },
    { "obstacle", r.shapes, "scene:obstacle{ shape = '%s', ... }" },
    { "force", r.forces, "scene:force{ kind = '%s', on = wire, ... }" },
    { "integrator", r.integrators, "scene:run{ integrator = '%s', ... }" },
  }
end

local function names_of(list)
  local names = {}
  for _, e in ipairs(list) do names[#names + 1] = e.name end
  return table.concat(names, " ")
end

local function overview(r)
  print "SoftWorld: help 'name' shows parameters, help(object) its methods."
  local function line(title, list) print(("  %-12s %s"):format(title, names_of(list))) end
  line("make", with_names(r.params))
  line("use", with_names(texts))
  line("models", r.models)
  line("holds", r.holds)
  line("obstacles", r.shapes)
  line("forces", outer(r.forces))
  line("integrators", r.integrators)
end

local function show_object(object)
  local meta = debug.getmetatable(object)
  local list = type(meta) == "table" and rawget(meta, "__names")
  local names = list and list(object) or {}
  if #names == 0 then
    for name, value in pairs(type(object) == "table" and object or {}) do
      if type(name) == "string" and type(value) == "function" then names[#names + 1] = name end
    end
  end
  table.sort(names)
  print(checks.shown(object))
  if #names > 0 then print("  " .. table.concat(names, " ")) end
end

local function show_integrator(entry)
  print(("  order %d, %s%s"):format(entry.order, entry.implicit and "implicit" or "explicit",
    entry.adaptive and ", steps by tolerance" or ""))
  if not entry.implicit and entry.leapfrog_limit > 0 then
    print(("  stable up to %.3g times scene:stable_dt()"):format(entry.leapfrog_limit / 2))
  end
end

-- Every family that has the name; a name may stand in more than one.
local function show_members(r, topic)
  local found = false
  for _, family in ipairs(families(r)) do
    for _, entry in ipairs(family[2]) do
      if entry.name == topic then
        found = true
        local title = ("%s %s%s"):format(family[1], topic, entry.summary and ": " .. entry.summary or "")
        if entry.inner then
          print(title .. "\n  part of the wire models that need it")
        elseif family[1] == "integrator" then
          print(title .. "\n  " .. family[3]:format(topic))
          show_integrator(entry)
        elseif family[1] == "model" then
          print(title .. "\n  " .. family[3]:format(topic))
        else
          show_rows(title .. "\n  " .. family[3]:format(topic), entry.params or {})
          if more[topic] then print(more[topic]) end
        end
      end
    end
  end
  return found
end

local plural = { models = "model", holds = "hold", obstacles = "obstacle", forces = "force",
  integrators = "integrator", shapes = "obstacle", shape = "obstacle" }

-- "force", "models", ...: every member with its summary.
local function show_family(r, topic)
  for _, family in ipairs(families(r)) do
    if family[1] == (plural[topic] or topic) then
      print(family[3]:format("..."))
      for _, entry in ipairs(family[1] == "force" and outer(family[2]) or family[2]) do
        print(("  %-18s %s"):format(entry.name, entry.summary or ""))
      end
      return true
    end
  end
  return false
end

local function unknown(r, topic)
  local names = {}
  for _, list in ipairs{ with_names(r.params), with_names(texts), r.models, r.holds, r.shapes,
    r.forces, r.integrators } do
    for _, entry in ipairs(list) do names[#names + 1] = entry.name end
  end
  local near = core.nearest(topic, names)
  print(("no help on '%s'; %s"):format(topic,
    near and ("did you mean '%s'?"):format(near) or "help() lists the topics"))
end

return function(topic)
  local r = core.registry()
  r.params.trajectory = core.trajectory_parameters()
  if topic == nil then return overview(r) end
  if type(topic) ~= "string" then return show_object(topic) end
  if r.params[topic] then show_rows(notes[topic] or topic, r.params[topic])
  elseif texts[topic] then print(text_of(topic)) end
  if r.params[topic] or texts[topic] then
    if more[topic] then print(more[topic]) end
    if topic == "obstacle" then print("  shapes: " .. names_of(r.shapes)) end
    return
  end
  local member = show_members(r, topic)
  if not member and not show_family(r, topic) then unknown(r, topic) end
end
