/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Observes each accepted state: extremes, wear, zones, series, forces of holds, contact, tools. */
#include "watch/observe.h"

#include "base/log.h"
#include "body/hold.h"
#include "body/obstacle_log.h"
#include "body/touching.h"
#include "edit/edit.h"
#include "grip/jaws.h"
#include "link/hold.h"
#include "read/extremes.h"
#include "scene/events.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "system/axial.h"
#include "system/system.h"
#include "watch/across.h"
#include "watch/wear.h"
#include "watch/zone.h"

static sw_status observe_wire(sw_scene *s, size_t w, sw_error *err) {
  sw_wire_extremes now;
  if (sw_scene_wears(s))
    SW_TRY(sw_wear_fit(s, w, err)); /* extremes count the mean tensions there */
  SW_TRY(sw_scene_note_extremes(s, w, &now, err));
  sw_scene_watch_kink(s, w, &now);
  sw_scene_watch_breaking(s, w, &now);
  sw_scene_watch_edges(s, w, &now);
  sw_scene_watch_between(s, w, &now);
  SW_TRY(sw_scene_watch_spun(s, w, &now, err));
  if (sw_scene_wears(s)) SW_TRY(sw_wear_note(s, w, 1, err));
  SW_TRY(sw_zones_note(s, w, err));
  return sw_watch_wire(s, w, &now, err);
}

sw_status sw_scene_begin_watching(sw_scene *s, sw_error *err) {
  sw_system_refresh(sw_scene_system(s));
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) {
    if (sw_scene_wears(s) && !sw_scene_wire_in(s, w)->wear.count)
      SW_TRY(sw_wear_note(s, w, 0, err));
    SW_TRY(sw_zones_note(s, w, err));
  }
  return SW_OK;
}

/* 1 if a drive has obeyed a force in a step that begins abruptly, as the first one of a wire that
 * has not settled. The drive has the asked force at the step's end only. Other read-outs mix both
 * stages and show 0.29 to 0.5 of it, since wire slips evenly faster within the step. */
static int obeys_at_end(const sw_hold *h) {
  const sw_slip *slip = h->cls->hold->slips ? h->cls->hold->slips((sw_hold *)h) : NULL;
  return slip && slip->anew && (isfinite(slip->push) || slip->way != 0);
}

static sw_status log_holds(sw_scene *s, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  for (size_t k = 0; k < system->hold_count; k++) {
    sw_hold *h = sw_scene_held_by(s, k);
    const sw_hold_state *at = &system->hold_states[k];
    double row[SW_LOG_SIZE];
    const sw_vec point = h->cls->hold->rail
                             ? sw_vec_at(system->x, system->bodies[h->wire].first_node + h->node)
                             : at->pose.p;
    sw_system_reaction(system, (int)k, point, &h->end_force, &h->end_moment);
    sw_system_bears(system, (int)k, system->x, point, &h->force, &h->moment);
    const int at_end = obeys_at_end(h);
    if (at_end) h->force = h->end_force, h->moment = h->end_moment;
    SW_TRY(sw_hold_look_out(s, h, err));
    if (h->cls->hold->rail) sw_hold_watch_jam(s, h);
    row[SW_LOG_TIME] = sw_scene_time(s);
    sw_vec force = h->force, moment = h->moment;
    const int mean = !at_end && sw_hold_jerked(s, h, &force, &moment);
    sw_store(row + SW_LOG_FORCE, force);
    sw_store(row + SW_LOG_MOMENT, moment);
    sw_store(row + SW_LOG_POINT, point);
    row[SW_LOG_SPAN] = sw_hold_span(s, mean);
    if (sw_hold_passes(h)) {
      const sw_hold_way way = sw_hold_way_of(s, h, sw_scene_time(s), system->x);
      h->cls->hold->guide(h)->drive = way.force, h->cls->hold->guide(h)->stage = way.stage;
    }
    if (sw_log_add(&h->log, row, SW_LOG_SIZE) != SW_OK)
      return sw_fail(err, SW_ENOMEM, "out of memory for the series of '%s'", h->name);
  }
  return SW_OK;
}

static sw_status observe_contact(sw_scene *s, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  size_t node = 0;
  const double depth = sw_scene_deepest(s, &node);
  if (depth > sw_scene_penetrated(s)->value) {
    size_t b = 0;
    while (b + 1 < system->body_count && system->bodies[b + 1].first_node <= node) b++;
    const sw_body *body = &system->bodies[b];
    const double *arc = body->plan->s;
    *sw_scene_penetrated(s) =
        (sw_extreme){depth, arc[node - body->first_node] - arc[0], sw_scene_time(s)};
  }
  if (sw_obstacle_log_state(s) == SW_OK) return SW_OK;
  return sw_fail(err, SW_ENOMEM, "out of memory for the forces on obstacles of scene '%s'",
                 sw_scene_name(s));
}

/* Reports the findings of forces on wires (sw_term_news). */
static void tell_news(sw_scene *s) {
  sw_system *system = sw_scene_system(s);
  sw_force_news news;
  for (size_t w = 0; w < system->body_count; w++) {
    const sw_body *b = &system->bodies[w];
    for (size_t k = 0; k < b->term_count; k++) {
      if (!sw_term_news(&b->terms[k], &news)) continue;
      const int id = b->terms[k].id;
      const char *name = id >= 0 ? sw_scene_force_in(s, id)->name : "";
      const char *wire = sw_scene_wire_in(s, w)->name, *kind = b->terms[k].cls->name;
      const double s0 = b->plan->s[0];
      if (*name)
        sw_scene_tell(s, news.kind, name, news.s - s0, news.value, "%s '%s', wire '%s': %s", kind,
                      name, wire, news.text);
      else
        sw_scene_tell(s, news.kind, wire, news.s - s0, news.value, "force %s, wire '%s': %s", kind,
                      wire, news.text);
    }
  }
}

static void watch_bends(sw_scene *s) {
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) {
    sw_bend bend;
    sw_scene_bend_of(s, &sw_scene_system(s)->bodies[w], &bend);
    sw_scene_watch_unbent(s, w, &bend);
    sw_scene_watch_arched(s, w, &bend);
  }
}

sw_status sw_scene_observe(sw_scene *s, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  SW_EACH(wire, wire, s) wire->untwisted = wire->remade = 0;
  SW_TRY(sw_system_place_holds(system, sw_scene_time(s), system->x, NULL, NULL, err));
  sw_system_refresh(system);
  sw_scene_watch_ties(s);
  sw_system_commit(system, sw_scene_time(s));
  tell_news(s);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) SW_TRY(observe_wire(s, w, err));
  sw_scene_watch_rolls(s, 1);
  SW_TRY(sw_watch_forces(s, err));
  SW_TRY(sw_watch_ties(s, err));
  SW_TRY(log_holds(s, err));
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) sw_scene_watch_squeezed(s, w);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) sw_scene_watch_pads_press(s, w);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) SW_TRY(sw_scene_watch_caught(s, w, err));
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) sw_scene_watch_sheets(s, w);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) sw_scene_watch_poke(s, w);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) sw_scene_watch_loose(s, w);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) sw_scene_watch_undamped(s, w);
  for (size_t w = 0; w < sw_scene_wire_slots(s); w++) sw_scene_watch_pierced(s, w);
  watch_bends(s);
  sw_scene_watch_together(s);
  sw_scene_watch_passed(s);
  SW_TRY(sw_scene_watch_through(s, err));
  if (sw_scene_has_contact(s)) SW_TRY(observe_contact(s, err));
  return sw_tool_observe(s, err);
}
