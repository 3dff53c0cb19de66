/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The core as the binding and other C programs see it. */
#ifndef SOFTWORLD_H
#define SOFTWORLD_H

#define SW_VERSION "0.1.0"

#include "base/alloc.h"
#include "base/interrupt.h"
#include "base/param.h"
#include "base/quota.h"
#include "base/status.h"
#include "base/vec.h"
#include "calibrate/calibrate.h"
#include "calibrate/least_squares.h"
#include "calibrate/minimise.h"
#include "calibrate/quasi.h"
#include "calibrate/search.h"
#include "calibrate/symmetric.h"
#include "calibrate/statistics.h"
#include "draw/draw.h"
#include "film/film.h"
#include "film/pack.h"
#include "film/skin.h"
#include "force/solid.h"
#include "motion/motion.h"
#include "scene/file.h"
#include "scene/frames.h"
#include "scene/objects.h"
#include "scene/readout.h"
#include "scene/scene.h"
#include "scene/section.h"
#include "scene/tool.h"
#include "scene/worn.h"
#include "scene/zone.h"
#include "shape/mesh_read.h"
#include "shape/shape.h"
#include "step/step.h"
#include "view/server.h"

#endif
