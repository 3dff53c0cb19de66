/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vectors of four hinges, one hinge in each lane. All users keep these types inside one file, so
 * the calling convention of vector arguments does not matter. */
#ifndef SW_FORCE_LANE_H
#define SW_FORCE_LANE_H

#pragma GCC diagnostic ignored "-Wpsabi"
typedef double lane __attribute__((vector_size(32), aligned(8)));
enum { LANES = 4 };
#define FLAT static inline __attribute__((always_inline))

typedef struct vec {
  lane x, y, z;
} vec;

FLAT vec add(vec a, vec b) { return (vec){a.x + b.x, a.y + b.y, a.z + b.z}; }
FLAT vec scale(vec a, lane s) { return (vec){a.x * s, a.y * s, a.z * s}; }
FLAT vec madd(vec a, vec b, lane s) { return (vec){a.x + b.x * s, a.y + b.y * s, a.z + b.z * s}; }
FLAT lane dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FLAT vec cross(vec a, vec b) {
  return (vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
FLAT lane all(double x) { return (lane){x, x, x, x}; }
FLAT lane load(const double *p) { return *(const lane *)(const void *)p; }
FLAT void accumulate(double *p, lane x) { *(lane *)(void *)p += x; }

#endif
