/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A frame at a time between two stored ones: all places, turns and values on a straight way from
 * one to the other, as the player shows them. */
#include "base/alloc.h"
#include "read/kept_frames.h"
#include "scene/lists.h"
#include "scene/parts.h"

/* Two frames, the share of the way from the first to the second, and the place in all blocks. */
typedef struct blend {
  const float *a, *b;
  float *out;
  float part; /* [-] */
  size_t at;
} blend;

static void mix(blend *m, size_t count) {
  for (size_t end = m->at + count; m->at < end; m->at++)
    m->out[m->at] = m->a[m->at] + m->part * (m->b[m->at] - m->a[m->at]);
}

static void keep(blend *m, size_t count) {
  for (size_t end = m->at + count; m->at < end; m->at++) m->out[m->at] = m->a[m->at];
}

/* Mixes a rotation; of one and the same rotation's two signs that of the first frame counts. */
static void turn(blend *m) {
  const float *a = m->a + m->at, *b = m->b + m->at;
  const float sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
  double mixed[4];
  for (int k = 0; k < 4; k++) mixed[k] = (double)(a[k] + m->part * (sign * b[k] - a[k]));
  const sw_quat q = sw_quat_unit((sw_quat){mixed[0], mixed[1], mixed[2], mixed[3]});
  float *out = m->out + m->at;
  out[0] = (float)q.w, out[1] = (float)q.x, out[2] = (float)q.y, out[3] = (float)q.z;
  m->at += 4;
}

/* Mixes what is there in both frames; else it stays that of the first one. */
static void mix_body(blend *m, size_t size) {
  if (size > SW_FRAME_BODY && m->a[m->at + SW_FRAME_BODY] != m->b[m->at + SW_FRAME_BODY]) {
    keep(m, size);
    return;
  }
  mix(m, 3), turn(m), mix(m, SW_FRAME_BODY - SW_FRAME_POSE);
  keep(m, size - SW_FRAME_BODY);
}

/* Mixes the wires; 0 if one of them has another mesh in the second frame. */
static int mix_wires(blend *m, size_t wires) {
  for (size_t w = 0; w < wires; w++) {
    size_t count = 0; /* of nodes */
    for (int part = 0; part < 3; part++) {
      const size_t given = (size_t)m->a[m->at];
      if (m->a[m->at] != m->b[m->at]) return 0;
      keep(m, 1);
      if (part == 0) count = given;
      mix(m, part == 0 ? 3 * count : part == 1 ? count * given : SW_FRAME_SURFACE * count * given);
    }
  }
  return 1;
}

static int fits(const sw_frame *a, const sw_frame *b) {
  return a->size == b->size && a->wires == b->wires && a->obstacles == b->obstacles &&
         a->holds == b->holds && a->tools == b->tools;
}

sw_status sw_scene_add_between(sw_scene *s, double t, int *added, sw_error *err) {
  sw_frames *all = sw_scene_frames_of(s);
  size_t k = 1;
  *added = 0;
  while (k < all->count && all->list[k].time <= t) k++;
  if (k >= all->count || !(t > all->list[k - 1].time)) return SW_OK;
  const sw_frame *a = &all->list[k - 1], *b = &all->list[k];
  sw_frame f = *a;
  if (!fits(a, b)) return SW_OK;
  if (!(f.data = sw_alloc(f.size + 1, sizeof *f.data)))
    return sw_fail(err, SW_ENOMEM, "out of memory for frames");
  blend m = {.a = a->data, .b = b->data, .out = f.data};
  m.part = (float)((t - a->time) / (b->time - a->time));
  for (size_t i = 0; i < a->obstacles + a->holds; i++) mix_body(&m, SW_FRAME_HOLD);
  for (size_t i = 0; i < a->tools; i++) mix_body(&m, SW_FRAME_TOOL);
  f.time = t, f.closing = 0;
  for (int i = 0; i < SW_FRAME_ENERGIES; i++)
    f.energy[i] += (double)m.part * (b->energy[i] - a->energy[i]);
  *added = mix_wires(&m, a->wires);
  if (!*added || SW_GROW(all->list, all->capacity, all->count + 1) != SW_OK) {
    sw_free(f.data);
    return *added ? sw_fail(err, SW_ENOMEM, "out of memory for frames") : SW_OK;
  }
  all->list[all->count++] = f;
  all->bytes += sw_frame_bytes(&f);
  return SW_OK;
}
