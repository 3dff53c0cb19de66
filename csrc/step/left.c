/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watches the friction that wires keep after a drive has stopped at once, and reports a loss. */
#include <math.h>

#include "body/touching.h"
#include "contact/halt.h"
#include "mutual/halt.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/stop.h"

/* Waves run through a stiff cable in less than a part. On a table they reverse the friction of all
 * touches, and the cable keeps all of its friction within 0.03. Cables on a few posts or wires keep
 * less; how much depends on the travel before friction slides and on the swing: of 1.07 mu m g 0.63
 * in steps of 10 ms, 0.78 in 0.5 ms, 0.43 in 0.1 ms. Cables on a table that were settled keep 0.88
 * of 0.98 in any step. A smaller share than this is reported (spec/contact/stop_left_spec) [-]. */
static const double ALL = 0.9;

static sw_along along_of(const sw_scene *s, size_t body) {
  sw_along sum = {0, 0};
  if (sw_scene_contact(s)) sw_contact_along(sw_scene_contact(s), sw_scene_system(s), body, &sum);
  if (sw_scene_pairs(s)) sw_mutual_along(sw_scene_pairs(s), sw_scene_system(s), body, &sum);
  return sum;
}

/* Waves have died out FROM after the stop; a swinging cable may lose friction until TO [s]. */
static const double FROM = 0.01, TO = 0.06;

void sw_stop_note(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  for (size_t b = 0; b < system->body_count; b++) {
    sw_body *body = &system->bodies[b];
    const sw_along sum =
        sw_body_is_stiff(body, SW_STIFF_TRAVEL) ? along_of(s, b) : (sw_along){0, 0};
    const int slides = sum.most > 0 && fabs(sum.along) > ALL * sum.most;
    body->watched = slides ? sw_scene_time(s) + TO : 0.0;
  }
}

void sw_stop_tell(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  const double now = sw_scene_time(s);
  double most = 0;
  for (size_t b = 0; b < system->body_count; b++) {
    sw_body *body = &system->bodies[b];
    if (now < body->watched - TO) body->watched = 0; /* the scene was restored */
    if (!(body->watched > 0) || now < body->watched - TO + FROM) continue;
    const sw_along sum = along_of(s, b);
    const int less = sum.most > 0 && fabs(sum.along) < ALL * sum.most;
    if (less) most = fmax(most, sum.most);
    if (less || now > body->watched) body->watched = 0;
  }
  if (most > 0)
    sw_scene_tell(s, "coarse", "", NAN, most,
                  "a drive stopped at once, and a wire lost part of its friction of %.3g N: "
                  "dt decides how much remains. Let the drive slow down, or run again with "
                  "dt = 0.0005 s and compare the forces at rest",
                  most);
}
