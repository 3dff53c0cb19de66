/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the lines of an OFF file: Assimp reads wrong indices and words as other points, in
 * silence. */
#ifndef SW_SHAPE_MESH_OFF_H
#define SW_SHAPE_MESH_OFF_H

#include "shape/mesh_read.h"

sw_status sw_mesh_check_off(const sw_mesh_file *file, sw_error *err);

#endif
