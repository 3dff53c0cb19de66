/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Collects a scene's tracks, rounds them to codes and packs the codes. */
#include "film/film.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/alloc.h"
#include "film/pack.h"

enum { LEVELS = 4095, ARC_LEVELS = 1 << 20, FAR = 1 << 29 };
static const double PLACE = 1e-3;           /* rounding step of positions over the radius [-] */
static const double EXTENT = 1e-6;          /* the same over their extent, without a radius [-] */
static const double SMALLEST = 1e-12;       /* smallest rounding step [m] */
static const double TURN = 1.0 / (1 << 20); /* rounding step of a quaternion's numbers [-] */

typedef struct track {
  uint8_t kind, channel;
  uint16_t width;
  uint32_t object, line;
  double scale, offset;
  int values;  /* 1: code 0 means no number */
  size_t slot; /* of the object in the scene [-] */
} track;

typedef struct maker {
  const sw_scene *s;
  int (*interrupted)(void);
  size_t *frame; /* (frames) numbers of the film's frames */
  size_t frames, broken;
  sw_pack *pack;
  track *tracks;
  size_t track_count, track_capacity;
  uint32_t *codes[2]; /* of this frame, of the previous frame */
  size_t room[2];
} maker;

/* --- the items of a track in a frame ------------------------------------------ */

typedef struct items {
  const float *p;     /* numbers of the first item */
  size_t count, step; /* number of items; floats from one item to the next */
} items;

static items look_at_wire(const sw_scene *s, const track *t, size_t frame, size_t *around) {
  items it = {NULL, 0, 3};
  size_t count = 0;
  switch (t->kind) {
    case SW_FILM_VALUE:
      it.step = SW_FRAME_VALUES;
      it.p = sw_scene_frame_values(s, frame, t->slot, &count);
      if (it.p) it.p += t->channel;
      break;
    case SW_FILM_SURFACE:
    case SW_FILM_PRESSED:
      it.step = SW_FRAME_SURFACE;
      it.p = sw_scene_frame_surface(s, frame, t->slot, &count, around);
      if (it.p && t->kind == SW_FILM_PRESSED) it.p += 3;
      break;
    default: it.p = sw_scene_frame_wire(s, frame, t->slot, &count);
  }
  it.count = it.p ? count : 0;
  return it;
}

/* Obstacles, holds and tools are in the same order in films and frames. */
static sw_frame_kind frame_kind(int kind) { return (sw_frame_kind)(kind - SW_FILM_OBSTACLE); }

static items look(const sw_scene *s, const track *t, size_t frame) {
  static const size_t first[3] = {0, 3, SW_FRAME_POSE};
  size_t around;
  int there = 1;
  items it = {NULL, 1, 1};
  if (t->kind < SW_FILM_OBSTACLE) return look_at_wire(s, t, frame, &around);
  it.p = sw_scene_frame_body(s, frame, frame_kind(t->kind), t->slot, &there);
  if (!it.p || !there) return (items){NULL, 0, 1};
  it.p += first[t->channel];
  return it;
}

/* --- the tracks ---------------------------------------------------------------- */

static sw_status add_track(maker *m, track t) {
  SW_TRY(SW_GROW(m->tracks, m->track_capacity, m->track_count + 1));
  m->tracks[m->track_count++] = t;
  return SW_OK;
}

/* Finds the bounds of the track's numbers over all frames; 0 if it has no numbers. */
static int range_of(const maker *m, const track *t, double *low, double *high) {
  *low = HUGE_VAL, *high = -HUGE_VAL;
  for (size_t f = 0; f < m->frames; f++) {
    const items it = look(m->s, t, m->frame[f]);
    for (size_t i = 0; i < it.count; i++)
      for (size_t k = 0; k < t->width; k++) {
        const double x = (double)it.p[it.step * i + k];
        if (!isfinite(x)) continue;
        *low = x < *low ? x : *low, *high = x > *high ? x : *high;
      }
  }
  return *low <= *high;
}

static sw_status add_places(maker *m, track t, double step) {
  double low, high;
  t.width = 3, t.line = t.line ? t.line : 1;
  if (!range_of(m, &t, &low, &high)) return SW_OK;
  const double reach = fmax(fabs(low), fabs(high));
  t.scale = fmax(fmax(step > 0 ? step : EXTENT * reach, reach / FAR), SMALLEST);
  return add_track(m, t);
}

static sw_status add_values(maker *m, track t, double levels) {
  double low, high;
  t.width = t.width ? t.width : 1, t.line = t.line ? t.line : 1, t.values = 1;
  if (!range_of(m, &t, &low, &high)) return SW_OK;
  t.scale = high > low ? (high - low) / levels : 1.0;
  t.offset = low - t.scale; /* the smallest code is 1 */
  return add_track(m, t);
}

static sw_status add_wire(maker *m, size_t slot, uint32_t object, int values) {
  const double step = PLACE * sw_scene_frame_radius(m->s, slot);
  const track t = {.object = object, .slot = slot};
  track own = t;
  if (sw_scene_frame_is_loose(m->s, slot)) {
    own.kind = SW_FILM_PARTICLES;
    return add_places(m, own, step);
  }
  SW_TRY(add_places(m, own, step));
  own.kind = SW_FILM_VALUE, own.channel = SW_FRAME_ARC;
  SW_TRY(add_values(m, own, ARC_LEVELS));
  for (int k = 0; values && k <= SW_FRAME_FORCE; k++) {
    own.channel = (uint8_t)k, own.width = k == SW_FRAME_FORCE ? 3 : 1;
    SW_TRY(add_values(m, own, LEVELS));
  }
  size_t count, around = 0;
  for (size_t f = 0; f < m->frames && !around; f++)
    if (!sw_scene_frame_surface(m->s, m->frame[f], slot, &count, &around)) around = 0;
  if (!around) return SW_OK;
  own = t, own.kind = SW_FILM_SURFACE, own.line = (uint32_t)around;
  SW_TRY(add_places(m, own, step));
  own.kind = SW_FILM_PRESSED;
  return values ? add_values(m, own, LEVELS) : SW_OK;
}

static sw_status add_bodies(maker *m, int kind, double step, int values) {
  for (size_t k = 0;; k++) {
    track t = {.kind = (uint8_t)kind, .object = (uint32_t)k, .slot = k, .line = 1, .width = 4};
    int known = 0, there;
    for (size_t f = 0; f < m->frames && !known; f++)
      known = sw_scene_frame_body(m->s, m->frame[f], frame_kind(kind), k, &there) != NULL;
    if (!known) return SW_OK;
    SW_TRY(add_places(m, t, step));
    t.channel = 1, t.scale = TURN;
    SW_TRY(add_track(m, t));
    t.channel = 2, t.width = 3;
    if (values) SW_TRY(add_values(m, t, LEVELS));
  }
}

static sw_status add_all(maker *m, int values) {
  uint32_t number[2] = {0, 0};
  double finest = HUGE_VAL;
  for (size_t w = 0; w < sw_scene_frame_wires(m->s); w++) {
    const double radius = sw_scene_frame_radius(m->s, w);
    const int loose = sw_scene_frame_is_loose(m->s, w);
    SW_TRY(add_wire(m, w, number[loose]++, values));
    if (radius > 0) finest = fmin(finest, PLACE * radius);
  }
  if (!isfinite(finest)) finest = 0;
  for (int kind = SW_FILM_OBSTACLE; kind < SW_FILM_KINDS; kind++)
    SW_TRY(add_bodies(m, kind, finest, values));
  return SW_OK;
}

/* --- writing -------------------------------------------------------------------- */

static void put_varint(sw_pack *p, uint32_t x) {
  unsigned char bytes[5];
  size_t n = 0;
  for (; x > 127; x >>= 7) bytes[n++] = (unsigned char)(x & 127) | 128;
  bytes[n++] = (unsigned char)x;
  sw_pack_put(p, bytes, n);
}

static void put_code(sw_pack *p, uint32_t difference) {
  const uint32_t sign = difference >> 31;
  put_varint(p, (difference << 1) ^ (sign ? UINT32_MAX : 0));
}

static uint32_t code_of(const track *t, double x) {
  if (!isfinite(x)) return 0;
  return (uint32_t)(int32_t)lrint((x - t->offset) / t->scale);
}

static void put_items(maker *m, const track *t, const items *it, const uint32_t *before) {
  uint32_t *now = m->codes[0];
  const size_t width = t->width, line = t->line;
  for (size_t i = 0; i < it->count; i++)
    for (size_t k = 0; k < width; k++) {
      const size_t at = width * i + k, side = at - width * line;
      uint32_t guess = before ? before[at] : 0;
      now[at] = code_of(t, (double)it->p[it->step * i + k]);
      if (i >= line) guess += now[side] - (before ? before[side] : 0);
      put_code(m->pack, now[at] - guess);
    }
}

static sw_status put_track(maker *m, const track *t) {
  const unsigned char kinds[2] = {t->kind, t->channel};
  const uint32_t heads[2] = {t->object, t->line};
  const double law[2] = {t->scale, t->offset};
  sw_pack_put(m->pack, kinds, sizeof kinds);
  sw_pack_put(m->pack, &t->width, sizeof t->width);
  sw_pack_put(m->pack, heads, sizeof heads);
  sw_pack_put(m->pack, law, sizeof law);
  for (size_t f = 0; f < m->frames; f++)
    put_varint(m->pack, (uint32_t)look(m->s, t, m->frame[f]).count);
  size_t last = 0;
  for (size_t f = 0; f < m->frames; f++) {
    const items it = look(m->s, t, m->frame[f]);
    if (m->interrupted && m->interrupted()) return SW_EINTR;
    SW_TRY(SW_GROW(m->codes[0], m->room[0], t->width * it.count));
    put_items(m, t, &it, f && last == it.count ? m->codes[1] : NULL);
    uint32_t *const swap = m->codes[0];
    const size_t room = m->room[0];
    m->codes[0] = m->codes[1], m->room[0] = m->room[1];
    m->codes[1] = swap, m->room[1] = room;
    last = it.count;
  }
  return SW_OK;
}

static sw_status put_all(maker *m) {
  const uint32_t counts[2] = {(uint32_t)m->frames, (uint32_t)m->track_count};
  SW_TRY(sw_pack_new(&m->pack));
  sw_pack_put(m->pack, "SWFILM1\n", 8);
  sw_pack_put(m->pack, counts, sizeof counts);
  for (size_t f = 0; f < m->frames; f++) {
    const double t = sw_scene_frame_time(m->s, m->frame[f]);
    sw_pack_put(m->pack, &t, sizeof t);
  }
  for (size_t k = 0; k < m->track_count; k++) SW_TRY(put_track(m, &m->tracks[k]));
  return SW_OK;
}

/* --- choice of frames ------------------------------------------------------------- */

static int all_finite(const float *p, size_t count) {
  for (size_t i = 0; i < count; i++)
    if (!isfinite(p[i])) return 0;
  return 1;
}

static int is_whole(const sw_scene *s, size_t frame) {
  const float *p;
  size_t count, around;
  int there;
  for (size_t w = 0; (p = sw_scene_frame_wire(s, frame, w, &count)) != NULL; w++) {
    if (!all_finite(p, 3 * count)) return 0;
    p = sw_scene_frame_surface(s, frame, w, &count, &around);
    for (size_t i = 0; p && i < count; i++)
      if (!all_finite(p + SW_FRAME_SURFACE * i, 3)) return 0;
  }
  for (sw_frame_kind of = SW_FRAME_OBSTACLES; of <= SW_FRAME_TOOLS; of++)
    for (size_t k = 0; (p = sw_scene_frame_body(s, frame, of, k, &there)) != NULL; k++)
      if (!all_finite(p, SW_FRAME_POSE)) return 0;
  return 1;
}

static sw_status choose(maker *m, const sw_film_args *args) {
  const size_t count = sw_scene_frames(m->s);
  m->frame = sw_alloc(count, sizeof *m->frame);
  if (!m->frame) return SW_ENOMEM;
  for (size_t f = args->first; f < count; f++) {
    const double t = sw_scene_frame_time(m->s, f);
    if (!(t >= args->from && t <= args->to)) continue;
    if (is_whole(m->s, f))
      m->frame[m->frames++] = f;
    else
      m->broken++;
  }
  return SW_OK;
}

sw_status sw_film_make(const sw_scene *s, const sw_film_args *args, int (*interrupted)(void),
                       sw_film *out, sw_error *err) {
  maker m = {.s = s, .interrupted = interrupted};
  const unsigned char *bytes = NULL;
  size_t size = 0;
  sw_status status = choose(&m, args);
  if (status == SW_OK) status = add_all(&m, args->values);
  if (status == SW_OK) status = put_all(&m);
  if (status == SW_OK) status = sw_pack_end(m.pack, &bytes, &size);
  *out = (sw_film){.size = size, .frames = m.frames, .broken = m.broken};
  if (status == SW_OK && !(out->bytes = sw_alloc(size, 1))) status = SW_ENOMEM;
  if (status == SW_OK) memcpy(out->bytes, bytes, size);
  sw_pack_free(m.pack);
  sw_free(m.frame), sw_free(m.tracks), sw_free(m.codes[0]), sw_free(m.codes[1]);
  if (status == SW_ENOMEM) return sw_fail(err, status, "out of memory for the film");
  return status;
}

sw_status sw_film_now(sw_scene *s, int values, sw_film *out, sw_error *err) {
  SW_TRY(sw_scene_frame_now(s, err));
  const sw_film_args args = {-HUGE_VAL, HUGE_VAL, values, sw_scene_frames(s) - 1};
  const sw_status status = sw_film_make(s, &args, NULL, out, err);
  sw_scene_drop_last_frame(s);
  return status;
}

void sw_film_free(sw_film *film) {
  sw_free(film->bytes);
  film->bytes = NULL;
}
