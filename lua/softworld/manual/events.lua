-- SPDX-License-Identifier: GPL-3.0-or-later
return [[
run.events            what happened in a run: a list, also told at the end of run:summary()
  { time =, kind =, object =, s =, value =, text =, count =, first =, last = }
  time [s], s [m] (arc length) and value belong to the largest of what was repeated; text tells
  the value's unit. count is how often it happened soon after one another, from first to last [s].
scene:events()        the same while a run is under way; a second result counts events beyond 512
scene:tell{ kind =, text =, object =, s =, value = }   books one of your own]]
