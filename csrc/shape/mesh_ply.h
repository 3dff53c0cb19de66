/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks that a PLY file has all the data that its header declares. */
#ifndef SW_SHAPE_MESH_PLY_H
#define SW_SHAPE_MESH_PLY_H

#include "shape/mesh_read.h"

sw_status sw_mesh_check_ply(const sw_mesh_file *file, sw_error *err);

#endif
