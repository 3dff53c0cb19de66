-- SPDX-License-Identifier: GPL-3.0-or-later
--- Rows of the methods and fields that the core gives trajectories and shapes.
-- @module softworld.calls.trajectory
local rows = require "softworld.rows"

rows.calls{
  { "trajectory:position", "t", "at that time", "{x, y, z} [m]" },
  { "trajectory:rotation", "t", "at that time", "{w, x, y, z}" },
  { "trajectory:velocity", "t", "at that time", "{x, y, z} [m/s]" },
  { "trajectory:acceleration", "t", "at that time", "{x, y, z} [m/s2]" },
  { "trajectory:angular_velocity", "t", "at that time", "{x, y, z} [rad/s]" },
  { "trajectory:angular_acceleration", "t", "at that time", "{x, y, z} [rad/s2]" },
  { "trajectory:starts", "", "when it begins to move", "s" },
  { "trajectory:ends", "", "when it has arrived", "s" },
  { "trajectory:duration", "", "of its motion", "s" },
  { "trajectory:length", "", "of its path", "m" },
  { "trajectory:law", "", "how progress grows", "text" },
  { "trajectory:relative", "", "true if its points are displacements", "true or false" },
  { "trajectory:placed", "position, rotation", "the same trajectory, as a displacement of this pose",
    "a trajectory" },
  { "trajectory:delayed", "seconds", "the same, later", "a trajectory" },
  { "trajectory:sample", "n, from, to", "states at n evenly spaced times",
    "flat lists by name: t [s], position [m], ..." },
  { "trajectory:save", "file, n", "writes n samples, 201 by default, as CSV" },
  { "trajectory:close", "", "frees its memory" },

  { "shape:kind", "", "name of its kind", "text" },
  { "shape:distance", "point, reach", "distance of a point from the surface, below 0 inside",
    "gap [m], normal, nearest place [m], feature; or nothing" },
  { "shape:segment", "a, b, reach", "places where a segment is near the shape, nearest first", "a list" },
  { "shape:sweep", "a0, b0, a1, b1, margin", "where a moving segment first meets the shape",
    "share of the motion, touch; or nil" },
  { "shape:roundness", "", "radius of the round surface that facets of a mesh approximate; 0: there is none",
    "m" },
  { "shape:bounds", "", "corners of the box around the shape", "lowest, highest corner [m]" },
  { "shape:triangles", "around", "triangles of its surface, for pictures",
    "flat vertices [m], indices from 1" },
  { "shape:close", "", "frees its memory" },
}
