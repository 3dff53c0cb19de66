/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pads of grippers (pads.h): samples of a wire under them, and the stiffness of touches there. */
#include "contact/pads.h"

#include <math.h>

#include "touch/same.h"

/* If particles lie close enough, a pad touches only particles, not the edges between them. These
 * would enter and leave the pad's edges one by one, and the pad's force would jump. */
static const double CLOSE = 3.0; /* least number of rings along the pad's face, its x and z [-] */

/* The same for a line. A node at the edge of a pad comes and goes, and the force of a whole segment
 * with it. So a pad with faces has evenly spaced samples, this many along its width, which fade out
 * at its edges [-]. */
static const double SAMPLES = 12.0;

/* Least number across a pad of small height, for wires that cross it askew. With SAMPLES there, a
 * pad 20 mm wide and 2 mm high had 120 along the wire, and was ten times too stiff: poses found no
 * rest, or threw the wire out of four fingers (spec/physics/low_pads_spec) [-]. */
static const double SAMPLES_ACROSS = 2.0;

/* Edges of a whole number of samples, within rounding, all have one sample more [-]. */
static const double ROUNDING = 1e-9;

/* A round pad presses along a short length, shorter across the wire than along it. There too the
 * line has samples: this many along the pressing length where wire and pad cross at a right angle.
 * With nearest places instead, two places of a turning wire press at once where they meet, and up
 * to half of the energy came from nowhere. Twice as many samples shift the place of rest by up to 5
 * mm of 200, half as many by 30 (spec/contact/round_pad_spec) [-]. */
static const double IN_CONTACT = 4.5;

/* Line stiffness of one side of a round section between plates, over its mean modulus: a solid
 * cylinder has F/(E R) = 0.084 at an approach of a tenth of its diameter (plane strain, finite
 * elements) [-]. */
static const double SECTION = 2.0 * 0.084 / 0.2;

/* Depth of the samples on a pad with faces, at the wanted force [m]. */
static const double PRESSED_IN = 5e-6;

/* Stiffness of a pad's touch on a particle of a mesh, over that of the section. With 1 the touch
 * would be stiffened during a squeeze, and its force would jump [-]. */
static const double STIFFER = 3.0;
/* The same for obstacles below a mesh in scenes where something moves and may squeeze it. A
 * squeezed section widens by some 0.01 mm and must not sink in by as much. With 3 the push of a
 * table on a wire between two pads is 13 % too small; with 30 it is right within 1 %
 * (spec/contact/squeezed_mesh_spec) [-]. */
static const double STANDS = 10.0;
/* In statics only places this near to a pad, in radii of the wire, have such stiff touches. The
 * rest of the wire only lies there: its depth would be below the tolerance of an equilibrium, and
 * searches would never end. The pads must be this near before they press. Twice as much gives the
 * same push within 1 %, but a wire of 100 MPa takes five times as long [-]. */
static const double NEAR = 2.0;

/* Radius of the rims of a pad that touches only particles, over the wire's radius. At a sharp rim
 * the next slice, which is not squeezed, stands before the pad's end face: it held a wire that was
 * drawn through with 11 times its friction. With 0.3 springs that are squeezed by 15 to 25 % were
 * still held with 1.3 to 1.5 times it, with 0.5 with 1.1 to 1.2; with more, sections are squeezed
 * less (spec/contact/pads_drawn_spec) [-]. */
static const double RIM = 0.5;

/* Line stiffness of a wire's section [N/m2]. */
static double section_of(const sw_plan *p) {
  const double r = p->beam.radius;
  return SECTION * p->beam.EA / (M_PI * r * r);
}

/* Contact of a line with a round pad. */
typedef struct round_pad {
  double line; /* stiffness per length of the line [N/m2] */
  double half; /* half of the pressing length where wire and pad cross at a right angle [m] */
} round_pad;

/* At depth d a line presses along the length 2 z, with z^2 = 2 R d and R the sum of both radii; its
 * depth falls as a parabola, so F = 4/3 line d z. The depth at the wanted force is
 * SW_ALLOWED_DEPTH, or that of the section if it is softer. Returns 0 if the obstacle is not a
 * round pad. */
static int find_round(const sw_contact *c, const sw_plan *p, size_t o, round_pad *out) {
  const double grips = c->obstacles[o].grips;
  sw_vec q, along;
  if (p->web || !(grips > 0)) return 0;
  const double pad = sw_shape_middle(c->obstacles[o].shape, sw_v(0, 0, 0), &q, &along);
  if (!(pad > 0)) return 0;
  const double twice = 2.0 * (pad + p->beam.radius), section = section_of(p);
  if (!(grips < HUGE_VAL)) { /* the pad closes to a distance: only the section limits the force */
    *out = (round_pad){.line = section, .half = sqrt(twice * SW_ALLOWED_DEPTH)};
    return 1;
  }
  const double soft = cbrt(pow(0.75 * grips / section, 2) / twice);
  const double depth = fmax(soft, SW_ALLOWED_DEPTH);
  out->half = sqrt(twice * depth);
  out->line = 0.75 * grips / (depth * out->half);
  return 1;
}

void sw_pads_look(sw_contact *c, const sw_plan *p) {
  double widest = 0;
  const int rings = p->web && p->web->per_ring && c->pad_count;
  for (size_t i = 0; rings && i < p->nodes; i++) widest = fmax(widest, p->web->along[i]);
  for (size_t k = 0; k < c->pad_count; k++) {
    const int o = c->pads[k];
    const sw_bounds b = sw_shape_bounds(c->obstacles[o].shape);
    const sw_vec size = sw_sub(b.max, b.min);
    round_pad pad;
    c->dense[o] = rings && fmin(size.x, size.z) > CLOSE * widest;
    c->spaced[o] = 0;
    if (!p->web && sw_shape_is(c->obstacles[o].shape, SW_SHAPE_FACED))
      c->spaced[o] = fmin(size.x / SAMPLES, size.z / SAMPLES_ACROSS);
    else if (find_round(c, p, (size_t)o, &pad))
      c->spaced[o] = 2.0 * pad.half / IN_CONTACT;
  }
}

/* Without friction a slice would slide on a rim at once, and steps would make energy. */
int sw_pad_has_rims(const sw_contact *c, int o) {
  return c->dense[o] && c->obstacles[o].friction > 0 &&
         sw_shape_is(c->obstacles[o].shape, SW_SHAPE_SQUARE);
}

/* Pads close along y. The box has its faces there, but its rims bulge outward by r: the same as a
 * box that is thinner by r on both sides, widened by r. */
int sw_pad_point(const sw_contact *c, const sw_candidate *k, sw_vec p, double reach,
                 sw_closest *out) {
  const sw_shape *shape = c->obstacles[k->obstacle].shape;
  const sw_vec half = sw_shape_bounds(shape).max;
  const double r = fmin(RIM * k->radius, half.y);
  if ((fabs(p.x) <= half.x && fabs(p.z) <= half.z) || fabs(p.y) < half.y - r)
    return sw_shape_point(shape, p, reach, out);
  const sw_vec lifted = sw_v(p.x, p.y + copysign(r, p.y), p.z);
  if (!sw_shape_point(shape, lifted, reach + r, out)) return 0;
  out->gap -= r;
  out->point = sw_madd(p, out->normal, -out->gap);
  return 1;
}

int sw_pad_samples(const sw_contact *c, const sw_plan *p, size_t i, size_t o) {
  if (!(c->spaced[o] > 0)) return 0;
  const double samples = ceil(p->rest[i] / c->spaced[o] * (1.0 + ROUNDING));
  return (int)fmin(SW_SAMPLES_MOST, fmax(SW_LEAST_SAMPLES, samples));
}

double sw_pad_stiffness(const sw_contact *c, const sw_plan *p, const sw_candidate *k, size_t edge) {
  const double grips = c->obstacles[k->obstacle].grips, section = section_of(p);
  round_pad pad;
  if (!k->samples) return fmin(section * p->length / (double)p->edges, grips / SW_ALLOWED_DEPTH);
  const double length = p->rest[edge] / k->samples;
  if (find_round(c, p, (size_t)k->obstacle, &pad)) return pad.line * length;
  return fmin(section * length, grips / (SAMPLES * PRESSED_IN));
}

/* 1 if a place is within reach of a pad's box along each of the world's axes. */
static int is_near_pad(const sw_contact *c, sw_vec x, double reach) {
  for (size_t k = 0; k < c->pad_count; k++) {
    const sw_bounds *b = &c->bounds[c->pads[k]];
    const sw_vec off = sw_sub(x, sw_lerp(b->min, b->max, 0.5)), size = sw_sub(b->max, b->min);
    if (fabs(off.x) < 0.5 * size.x + reach && fabs(off.y) < 0.5 * size.y + reach &&
        fabs(off.z) < 0.5 * size.z + reach && !c->obstacles[c->pads[k]].off)
      return 1;
  }
  return 0;
}

/* Returns the length along the wire that a particle of a ring stands for; 0: it is in no ring [m].
 * The web has the lengths to the next ring. */
static double length_of(const sw_web *web, size_t particle) {
  if (web->along[particle] > 0 || particle < web->per_ring) return web->along[particle];
  return web->along[particle - web->per_ring];
}

double sw_pad_mesh_stiffness(const sw_contact *c, const sw_plan *p, size_t particle, sw_vec x,
                             size_t o) {
  const int pad = c->obstacles[o].grips > 0, still = c->regime == SW_CONTACT_STATIC;
  if (!p->web->per_ring || !(c->broad.mover_count > 0)) return 0;
  if (!pad && still && !(p->web->solid_rate2 > 0 && is_near_pad(c, x, NEAR * p->beam.radius)))
    return 0;
  const double times = pad ? STIFFER : STANDS;
  return times * section_of(p) * length_of(p->web, particle);
}
