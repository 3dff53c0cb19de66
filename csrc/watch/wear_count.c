/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds the load of a wire's place at a state to the place's cycles. */
#include <math.h>

#include "state/hinge.h"
#include "watch/wear.h"

sw_vec sw_wear_towards(sw_vec change, sw_vec t, double size) {
  const sw_vec way = sw_madd(change, t, -sw_dot(change, t));
  return sw_scale(sw_unit_or(way, sw_v(0, 0, 0)), size);
}

static double angle_from(sw_vec a, sw_vec b, sw_vec t) {
  return atan2(sw_dot(sw_cross(a, b), t), sw_dot(a, b));
}

/* Sets the place's own direction. It stays as it was in a step in which the holds changed. */
static void turn_place(sw_wear_place *x, sw_vec tangent, sw_vec across, int anew) {
  if (!x->seen) x->turn = 0;
  if (x->seen && anew) {
    const sw_vec was = sw_carry_unit(x->across, x->tangent, tangent);
    x->turn = angle_from(across, was, tangent);
  }
  x->seen = 1, x->tangent = tangent;
  x->across = sw_turned(across, tangent, x->turn);
}

static void count_bend(sw_cycles *c, const sw_wear_place *x, sw_vec bend) {
  const double one = sw_dot(bend, x->across), two = sw_dot(bend, sw_cross(x->tangent, x->across));
  for (int k = 0; k < SW_WEAR_WAYS; k++) {
    const double angle = k * 3.14159265358979323846 / SW_WEAR_WAYS;
    sw_cycles_add(&c[1 + k], one * cos(angle) + two * sin(angle));
  }
}

void sw_wear_count(sw_wear *w, size_t k, const sw_wear_load *load, int anew) {
  sw_wear_place *x = &w->places[k];
  turn_place(x, load->tangent, load->across, anew);
  sw_cycles *cycles = &w->cycles[SW_WEAR_SIGNALS * k];
  if (!load->averaged) sw_cycles_add(&cycles[0], load->tension);
  count_bend(cycles, x, load->bend);
  x->load = load->tension * sw_norm(load->bend), x->touches = 0;
}
