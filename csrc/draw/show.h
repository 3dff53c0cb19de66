/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ways to show a drawing on a canvas. */
#ifndef SW_DRAW_SHOW_H
#define SW_DRAW_SHOW_H

#include "draw/drawing.h"

sw_status sw_show_shaded(sw_canvas *canvas, sw_canvas_part window, const sw_drawing *drawing,
                         const sw_camera *camera, int (*interrupted)(void));
sw_status sw_show_wireframe(sw_canvas *canvas, sw_canvas_part window, const sw_drawing *drawing,
                            const sw_camera *camera, int (*interrupted)(void));

#endif
