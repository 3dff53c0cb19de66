-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of the functions of sw, and of cables, that have no rows of their own.
-- @module softworld.calls.sw
local rows = require "softworld.rows"

rows.calls{
  { "sw.scene", "{...}", "makes an empty scene, see help 'scene'", "a scene" },
  { "sw.load", "file", "reads a scene that scene:save, or a run with save =, has written", "a scene" },
  { "sw.shape", "{...}", "makes a shape without a scene, of the parameters of an obstacle", "a shape" },
  { "sw.trajectory", "{...}", "makes a motion, see help 'trajectory'", "a trajectory" },
  { "sw.trajectory.new", "{...}", "the same", "a trajectory" },
  { "sw.trajectory.read", "file, scale", "way-points of a CSV file; scale: unit of columns without one [m]",
    "a table of way-points" },
  { "sw.trajectory.save", "trajectory, file, n", "writes n samples, 201 by default, as CSV" },
  { "sw.cables", "", "names of all cables of the catalogue", "a list" },
  { "sw.cable", "name", "finds a cable of the catalogue, see help 'cable'", "an entry" },
  { "sw.cable.get", "name", "the same; an entry is returned as it is", "an entry" },
  { "sw.cable.list", "", "names of all cables of the catalogue", "a list" },
  { "sw.cable.define", "{...}", "adds a cable to the catalogue, see help 'cable'", "an entry" },
  { "sw.material", "name", "finds a material of cables", "a material" },
  { "sw.material.find", "name", "the same; without an error for a wrong name",
    "a material, or nil and a message" },
  { "sw.calibrate", "{...}", "springs of a mesh, see help 'calibrate'", "a calibration of springs" },
  { "sw.calibrate.cell", "{...}", "the beam that an endless mesh of springs is, see help 'calibrate'",
    "a table of stiffnesses" },
  { "sw.tune.minimise", "{ f =, ... }", "finds where f is smallest, see help 'tuning'",
    "{ x, value, ok, reason, ... }" },
  { "sw.help", "name or object", "prints a page, the parameters of a call, or the methods of an object" },

  { "cable:section", "stiffness", "parameters of scene:wire; stiffness: 'default', 'slip' or 'stick'",
    "EA [N], EI, GJ [N m2], mass_per_length [kg/m], radius [m]" },
  { "cable:bend_limit", "use, diameter", "smallest radius that a use allows",
    "inside of the bend [m], centre line [m], use" },
}
