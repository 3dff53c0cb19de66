/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Adds the friction of the last step to the places of wires that slid: nodes of a line, sections of
 * a mesh. */
#include "body/touching.h"
#include "scene/parts.h"
#include "watch/wear.h"

/* Returns the length of wire that belongs to a place [m]. */
static double share_of(const sw_wear *w, size_t i) {
  const double before = i > 0 ? w->places[i].s - w->places[i - 1].s : 0.0;
  const double after = i + 1 < w->nodes ? w->places[i + 1].s - w->places[i].s : 0.0;
  return 0.5 * (before + after);
}

static void rub(sw_wear *w, const sw_body *b, size_t node, double share, double work, double slid) {
  if (node < b->first_node || node >= b->first_node + b->plan->nodes || !(share > 0)) return;
  const size_t at = node - b->first_node;
  const size_t i = b->plan->web ? sw_web_ring_of(b->plan->web, at) : at;
  const double length = share_of(w, i);
  w->places[i].touches = 1;
  w->places[i].rubbed += share * work / length;
  w->places[i].slid += share * slid / length;
}

static void rub_obstacles(const sw_scene *s, const sw_body *b, sw_wear *w) {
  sw_contact *contact = sw_scene_contact(s);
  size_t k = 0, end = 0;
  sw_contact_push p;
  if (!contact) return;
  sw_contact_touches_of(contact, b->first_node, b->first_node + b->plan->nodes, &k, &end);
  for (; k < end; k++) {
    if (!sw_contact_push_at(contact, sw_scene_system(s), k, &p)) continue;
    const double slid = p.normal_force * sw_norm(p.slip);
    const double work = -sw_dot(sw_madd(p.force, p.normal, -p.normal_force), p.slip);
    rub(w, b, p.node, p.node == p.other ? 1 : 1 - p.at, work, slid);
    if (p.node != p.other) rub(w, b, p.other, p.at, work, slid);
  }
}

/* Places where two bodies press on each other wear both bodies. */
static void rub_bodies(const sw_scene *s, const sw_body *b, sw_wear *w) {
  const size_t body = (size_t)(b - sw_scene_system(s)->bodies);
  size_t next[2] = {0, 0};
  sw_pair_place p;
  while (sw_scene_next_place(s, body, next, &p)) {
    const double slid = p.normal_force * sw_norm(p.slip), work = -sw_dot(p.friction, p.slip);
    for (int i = 0; i < 2; i++) {
      if (p.body[i] != body) continue;
      rub(w, b, p.node[i], 1 - p.at[i], work, slid);
      if (p.at[i] > 0) rub(w, b, p.end[i], p.at[i], work, slid);
    }
  }
}

void sw_wear_rub(const sw_scene *s, const sw_body *b, sw_wear *w) {
  rub_obstacles(s, b, w);
  rub_bodies(s, b, w);
}
