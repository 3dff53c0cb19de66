/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mean tensions over the run's window, as loads of the places of a wire's recorded wear. A single
 * step of a blow has a tension that grows as steps and edges get shorter. */
#include <math.h>

#include "read/extremes.h"
#include "scene/course.h"
#include "scene/parts.h"
#include "scene/wire.h"

/* Returns the mean at a node of a line, as of its two edges. */
static double at_node(const sw_window_last *p, size_t edges, size_t k) {
  if (k == 0) return sw_window_mean(p, 0);
  if (k >= edges) return sw_window_mean(p, edges - 1);
  return 0.5 * (sw_window_mean(p, k - 1) + sw_window_mean(p, k));
}

/* Returns the mean at a ring of a mesh: linear between the middles of slices, and extrapolated to
 * the ends. */
static double at_ring(const sw_window_last *p, size_t slices, size_t r) {
  if (slices < 2) return sw_window_mean(p, 0);
  const size_t a = r < 2 ? 0 : r > slices - 1 ? slices - 2 : r - 1;
  const double f = r == 0 ? -0.5 : r == slices ? 1.5 : 0.5, near = sw_window_mean(p, a);
  return near + f * (sw_window_mean(p, a + 1) - near);
}

static int fits(const sw_wear *wear, const sw_window *window) {
  return wear->count && window->marks && window->edges && wear->nodes == window->edges + 1;
}

void sw_scene_wear_means(sw_scene *s, size_t w) {
  sw_scene_wire *wire = sw_scene_wire_in(s, w);
  sw_wear *wear = &wire->wear;
  if (!sw_scene_wears(s) || !fits(wear, &wire->window)) return;
  const sw_system *system = sw_scene_system(s);
  const sw_body *b = &system->bodies[w];
  const sw_window_last p = sw_window_present(&wire->window, sw_scene_course(s)->window);
  const size_t edges = wire->window.edges;
  sw_bent_side side;
  for (size_t k = 0; k < wear->nodes; k++)
    sw_cycles_add(&wear->cycles[SW_WEAR_SIGNALS * k],
                  b->plan->web ? at_ring(&p, edges, k) : at_node(&p, edges, k));
  size_t next = 0;
  for (size_t k = wear->nodes; k < wear->count && sw_scene_next_side(system, b, &next, &side); k++)
    if (side.edge < edges)
      sw_cycles_add(&wear->cycles[SW_WEAR_SIGNALS * k], sw_window_mean(&p, side.edge));
}

void sw_scene_end_wear(sw_scene *s) {
  const double width = sw_scene_course(s)->window;
  if (!sw_scene_wears(s) || !sw_scene_is_built(s) || !sw_scene_is_averaged(s)) return;
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) {
    const sw_scene_wire *wire = sw_scene_wire_in(s, w);
    const int missing = !isfinite(wire->extremes.tension.value); /* shorter than the window */
    if (missing || (sw_window_waits(&wire->window) && sw_window_full(&wire->window, width)))
      sw_scene_wear_means(s, w);
  }
}
