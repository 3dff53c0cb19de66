/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The push of a clip on a wire that is bent within its edges. */
#ifndef SW_FORCE_CLIP_BENT_H
#define SW_FORCE_CLIP_BENT_H

#include "force/clip_watch.h"

/* Changes the largest friction of the places in `each` from that of straight edges to that of the
 * bent wire. Nothing changes where this push is not known (clip_bent.c). */
void sw_clip_bend_friction(const sw_clip *clip, const sw_field *field, double *each);

#endif
