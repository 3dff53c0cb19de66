/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plans the rings and line particles of a wire of which only a region is meshed. Rings lie at even
 * distances in the region and a little on both sides of every hold that holds the wire's direction,
 * because a line has no section to be held by. */
#include "body/region.h"

#include <math.h>
#include <stdlib.h>

#include "base/alloc.h"
#include "link/hold.h"
#include "scene/parts.h"
#include "scene/wire.h"

enum { BESIDE = 2 };              /* slices beside a clamp [-] */
static const double NARROW = 4.0; /* parts nearer to each other are merged, in slices [-] */
static const double LEVER = 0.5;  /* first edge of a line, over a slice [-] */

typedef struct part {
  double from, to;
  double anchor; /* place of a ring; NAN = anywhere [m] */
} part;

static int before(const void *a, const void *b) {
  const part *p = a, *q = b;
  return (p->from > q->from) - (p->from < q->from);
}

/* Finds the parts with rings, the region and around clamps, in order; merges those that meet.
 * Returns their number. */
static size_t find_parts(const sw_scene *s, size_t wire, const double region[2], double h,
                         double length, part *out) {
  size_t n = 0, kept = 0;
  out[n++] = (part){region[0], region[1], (double)NAN};
  SW_EACH(hold, hold, s) {
    if (!hold->alive || hold->wire != wire || !hold->cls->hold->direction) continue;
    out[n++] = (part){hold->s1 - BESIDE * h, hold->s2 + BESIDE * h, hold->s1};
  }
  qsort(out, n, sizeof *out, before);
  SW_ITEMS(const part, p, out, n) {
    part *last = kept ? &out[kept - 1] : NULL;
    if (!last || p->from > last->to + NARROW * h) {
      out[kept++] = *p;
      continue;
    }
    last->to = fmax(last->to, p->to);
    if (isnan(last->anchor)) last->anchor = p->anchor;
  }
  for (size_t k = 0; k < kept; k++) { /* ends of the wire are rings or ends of lines */
    if (out[k].from < NARROW * h) out[k].from = out[k].anchor = 0;
    if (out[k].to <= length - NARROW * h) continue;
    out[k].to = length;
    if (out[k].from > 0) out[k].anchor = length;
  }
  return kept;
}

/* Returns the number of rings of a part; *first: the place of its first one. */
static size_t rings_of(const part *p, double h, double length, double *first) {
  const double anchor = isnan(p->anchor) ? p->from : p->anchor;
  const double back = round((anchor - p->from) / h), on = round((p->to - anchor) / h);
  *first = fmax(0.0, anchor - back * h);
  size_t count = (size_t)(fmax(0.0, back) + fmax(0.0, on)) + 1;
  while (count > 2 && *first + (double)(count - 1) * h > length * (1 + 1e-12)) count--;
  return count < 2 ? 2 : count;
}

static void put(sw_stations *o, double s, int ring) {
  if (o->s) o->s[o->n] = s, o->ring[o->n] = (unsigned char)ring;
  o->n++;
}

/* Puts particles of the line between two places; ring_before, ring_after: 1 if the place is a
 * ring. */
static void put_line(sw_stations *o, double from, int ring_before, double to, int ring_after,
                     double h, double spacing) {
  const double a = ring_before ? from + LEVER * h : from, b = ring_after ? to - LEVER * h : to;
  const size_t edges = (size_t)fmax(ring_before && ring_after ? 1.0 : 2.0, ceil((b - a) / spacing));
  for (size_t i = 0; i <= edges; i++)
    put(o, i == edges ? b : a + (b - a) * ((double)i / (double)edges), 0);
}

static void lay_out(const part *parts, size_t count, double length, double line, sw_stations *o) {
  double end = 0;
  o->n = 0;
  for (size_t k = 0; k < count; k++) {
    double first;
    const size_t rings = rings_of(&parts[k], o->spacing, length, &first);
    if (first > 0) put_line(o, end, k > 0, first, 1, o->spacing, line);
    for (size_t i = 0; i < rings; i++) {
      const double at = first + (double)i * o->spacing;
      put(o, fabs(at - length) < 1e-9 * length ? length : at, 1);
    }
    end = first + (double)(rings - 1) * o->spacing;
  }
  if (end < length * (1 - 1e-9)) put_line(o, end, 1, length, 0, o->spacing, line);
}

sw_status sw_region_plan(const sw_scene *s, size_t wire, const double region[2], double spacing,
                         double line, sw_stations *out, sw_error *err) {
  const sw_scene_wire *w = sw_scene_wire_in(s, wire);
  const double length = w->mesh.s[w->mesh.n - 1];
  part *parts SW_LOCAL = sw_alloc(sw_scene_living_holds(s) + 1, sizeof *parts);
  *out = (sw_stations){.spacing = spacing};
  if (!parts) return sw_fail(err, SW_ENOMEM, "remodel: out of memory");
  const size_t count = find_parts(s, wire, region, spacing, length, parts);
  if (parts[0].from <= 0 && parts[count - 1].to >= length && count == 1) {
    return sw_fail(err, SW_EINVAL,
                   "remodel: region = {%.6g, %.6g} m and the mesh round clamps together cover all "
                   "of wire '%s'; leave region out",
                   region[0], region[1], w->name);
  }
  lay_out(parts, count, length, line, out);
  out->s = sw_alloc(out->n, sizeof *out->s);
  out->ring = sw_alloc(out->n, sizeof *out->ring);
  if (out->s && out->ring) lay_out(parts, count, length, line, out);
  if (out->s && out->ring) return SW_OK;
  sw_region_free(out);
  return sw_fail(err, SW_ENOMEM, "remodel: out of memory");
}

void sw_region_free(sw_stations *o) {
  sw_free(o->s);
  sw_free(o->ring);
  *o = (sw_stations){0};
}
