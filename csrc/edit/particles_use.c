/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads, changes and holds objects of particles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alloc.h"
#include "body/build.h"
#include "edit/objects.h"
#include "link/hold.h"
#include "scene/course.h"
#include "scene/lookup.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "system/system.h"

static sw_scene_wire *find(const sw_scene *s, sw_handle h, sw_error *err) {
  sw_scene_wire *w = sw_scene_find_body(s, h, err);
  if (!w || sw_scene_is_loose(w)) return w;
  sw_fail(err, SW_EINVAL, "'%s' is a wire, not an object of particles", w->name);
  return NULL;
}

static sw_status open_particles(sw_scene *s, sw_handle h, sw_scene_wire **out, sw_error *err) {
  if (!find(s, h, err)) return SW_EDEAD;
  return sw_scene_open_body(s, h, out, err);
}

sw_status sw_scene_particles_info(sw_scene *s, sw_handle h, sw_particles_info *out, sw_error *err) {
  SW_FIND(const sw_scene_wire, w, find(s, h, err));
  const sw_web *web = w->strand.web;
  *out = (sw_particles_info){.particles = web->particles,
                             .links = web->links,
                             .folds = web->folds,
                             .elements = web->solids,
                             .radius = w->beam.radius};
  for (size_t i = 0; i < web->particles; i++) out->mass += web->mass[i];
  return SW_OK;
}

sw_status sw_scene_particle(sw_scene *s, sw_handle h, size_t particle, sw_vec *position,
                            sw_vec *velocity, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w;
  SW_TRY(open_particles(s, h, &w, err));
  const sw_body *b = &system->bodies[h.slot];
  if (particle >= b->plan->nodes)
    return sw_fail(err, SW_EINVAL,
                   "particles '%s': there is no particle %zu; there are %zu, from 1 on", w->name,
                   particle + 1, b->plan->nodes);
  *position = sw_vec_at(system->x, b->first_node + particle);
  *velocity = sw_vec_at(system->v, b->first_node + particle);
  return SW_OK;
}

sw_status sw_scene_particles_set_velocities(sw_scene *s, sw_handle h, const double *velocities,
                                            sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w;
  SW_TRY(sw_scene_editable(s, err));
  SW_TRY(open_particles(s, h, &w, err));
  const sw_body *b = &system->bodies[h.slot];
  for (size_t i = 0; i < b->plan->nodes; i++)
    SW_TRY(sw_scene_check_speed(s, w, sw_norm(sw_vec_at(velocities, i)), err));
  for (size_t i = 0; i < b->plan->nodes; i++)
    if (b->plan->held[i] == SW_FREE)
      sw_store(system->v + 3 * (b->first_node + i), sw_vec_at(velocities, i));
  sw_course_jump(sw_scene_course(s));
  return SW_OK;
}

size_t sw_scene_particles_edges(const sw_scene *s, sw_handle h, uint32_t *pairs) {
  sw_error unknown;
  const sw_scene_wire *w = sw_scene_find_body(s, h, &unknown);
  const sw_web *web = w ? w->strand.web : NULL;
  size_t n = 0;
  for (size_t p = 0; web && web->side_first && p < web->particles; p++)
    for (size_t k = web->side_first[p]; k < web->side_first[p + 1]; k++, n++)
      if (pairs) pairs[2 * n] = (uint32_t)p, pairs[2 * n + 1] = (uint32_t)web->side[k];
  return n;
}

/* Returns the links' plastic elongations, or NULL: none can yield. */
static const double *plastic_of(const sw_body *b) {
  for (size_t k = 0; k < b->term_count; k++)
    if (strcmp(b->terms[k].cls->name, "plastic_springs") == 0) return b->terms[k].history + 1;
  return NULL;
}

sw_status sw_scene_particles_links(sw_scene *s, sw_handle h, double *force, double *strain,
                                   double *plastic, sw_error *err) {
  sw_system *system = sw_scene_system(s);
  sw_scene_wire *w;
  SW_TRY(open_particles(s, h, &w, err));
  const sw_body *b = &system->bodies[h.slot];
  const double *x = system->x + 3 * b->first_node, *flown = plastic_of(b);
  for (size_t e = 0; e < w->strand.web->links; e++) {
    const sw_web_link *l = &w->strand.web->link[e];
    const double longer = sw_dist(sw_vec_at(x, l->a), sw_vec_at(x, l->b)) - l->rest;
    const double stays = flown ? flown[e] : 0.0;
    if (force) force[e] = l->k * (longer - stays);
    if (strain) strain[e] = longer / l->rest;
    if (plastic) plastic[e] = stays / l->rest;
  }
  return SW_OK;
}

/* --- holds ------------------------------------------------------------------------------ */

static sw_status check_hold(const sw_scene *s, const sw_scene_wire *w, size_t slot,
                            const uint32_t *particles, size_t count, sw_error *err) {
  const size_t n = w->strand.web->particles;
  if (!count)
    return sw_fail(err, SW_EINVAL, "clamp: the list of particles of '%s' is empty", w->name);
  unsigned char *taken SW_LOCAL = sw_alloc(n, 1);
  if (!taken) return sw_fail(err, SW_ENOMEM, "clamp: out of memory");
  for (size_t i = 0; i < count; i++) {
    if (particles[i] >= n)
      return sw_fail(err, SW_EINVAL, "clamp: '%s' has no particle %lu; it has %zu, from 1 on",
                     w->name, (unsigned long)particles[i] + 1, n);
    if (taken[particles[i]]++)
      return sw_fail(err, SW_EINVAL, "clamp: particle %lu of '%s' is in the list twice",
                     (unsigned long)particles[i] + 1, w->name);
  }
  SW_EACH(hold, by, s) {
    if (!by->alive || by->wire != slot) continue;
    for (size_t i = 0; i < by->count; i++)
      if (taken[by->particle[i]])
        return sw_fail(err, SW_EINVAL, "clamp: particle %lu of '%s' is already held by '%s'",
                       (unsigned long)by->particle[i] + 1, w->name, by->name);
  }
  return SW_OK;
}

static int by_number(const void *a, const void *b) {
  const uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
  return p < q ? -1 : p > q;
}

/* Finds the particles' places in the hold's frame. */
static sw_status take(const sw_scene_wire *w, sw_hold *h, const uint32_t *particles, size_t count,
                      sw_vec at) {
  const sw_strand *p = &w->strand;
  SW_TRY(SW_ALLOC_ALL(SW_ROOM(h->s, count), SW_ROOM(h->local, 3 * count),
                      SW_ROOM(h->particle, count)));
  memcpy(h->particle, particles, count * sizeof *particles);
  qsort(h->particle, count, sizeof *h->particle, by_number); /* the same order, whatever order was
                                                                given */
  sw_vec middle = sw_v(0, 0, 0);
  for (size_t i = 0; i < count; i++)
    middle = sw_madd(middle, sw_vec_at(p->x, h->particle[i]), 1.0 / (double)count);
  if (sw_finite(at)) middle = at;
  for (size_t i = 0; i < count; i++) {
    h->s[i] = p->web->s[h->particle[i]];
    sw_store(h->local + 3 * i, sw_sub(sw_vec_at(p->x, h->particle[i]), middle));
  }
  h->count = count;
  h->drive.pose = (sw_pose){middle, sw_quat_identity()};
  h->last_pose = h->drive.pose;
  h->turn = sw_quat_identity();
  return SW_OK;
}

sw_status sw_scene_hold_particles(sw_scene *s, sw_handle object, const char *name,
                                  const uint32_t *particles, size_t count, sw_vec at,
                                  sw_handle *out, sw_error *err) {
  SW_TRY(sw_scene_ready(s, err));
  SW_FIND(const sw_scene_wire, w, find(s, object, err));
  SW_TRY(check_hold(s, w, object.slot, particles, count, err));
  sw_hold h = {.alive = 1,
               .cls = sw_link_find("clamp"),
               .wire = object.slot,
               .args = {.direction = {NAN, NAN, NAN}},
               .scale = 1};
  sw_scene_give_name(h.name, name, "clamp", sw_scene_hold_slots(s));
  sw_status status = sw_scene_unbuild(s);
  if (status == SW_OK) status = take(w, &h, particles, count, at);
  if (status == SW_OK) status = sw_scene_add(s, SW_OF_HOLD, &h, out);
  if (status != SW_OK) {
    sw_hold_clear(&h);
    return sw_fail(err, status, "clamp: out of memory");
  }
  sw_scene_hold_in(s, out->slot)->shape = out->generation;
  return SW_OK;
}
