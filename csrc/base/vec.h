/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vectors, unit quaternions and poses, passed by value. All functions are inline, and
 * branch-free where possible. Arrays of vectors are flat doubles (n x 3): load with sw_load,
 * store with sw_store. */
#ifndef SW_BASE_VEC_H
#define SW_BASE_VEC_H

#include <math.h>

typedef struct sw_vec {
  double x, y, z;
} sw_vec;

/* Unit quaternion, scalar first: rotates the body frame into the world. */
typedef struct sw_quat {
  double w, x, y, z;
} sw_quat;

/* A pose: world point = q * body point + p. */
typedef struct sw_pose {
  sw_vec p;  /* [m] */
  sw_quat q; /* [-] */
} sw_pose;

static inline double sw_limit(double x, double low, double high) {
  return x < low ? low : x > high ? high : x;
}
/* fmax and fmin without a call, with the same bits; of a NaN and a number they return the number.
 */
static inline double sw_larger(double a, double b) { return a > b || isnan(b) ? a : b; }
static inline double sw_smaller(double a, double b) { return a < b || isnan(b) ? a : b; }
static inline sw_vec sw_v(double x, double y, double z) { return (sw_vec){x, y, z}; }
static inline sw_vec sw_load(const double *p) { return (sw_vec){p[0], p[1], p[2]}; }
/* Vector i of a flat array. */
static inline sw_vec sw_vec_at(const double *p, unsigned long i) { return sw_load(p + 3 * i); }
/* Vector i from three lists, one for each component. */
static inline sw_vec sw_vec_across(double *const *c, unsigned long i) {
  return sw_v(c[0][i], c[1][i], c[2][i]);
}
/* Conversion from and to floats. */
static inline sw_vec sw_vec_of(const float *p) {
  return sw_v((double)p[0], (double)p[1], (double)p[2]);
}
static inline void sw_vec_to(float *p, sw_vec a) {
  p[0] = (float)a.x, p[1] = (float)a.y, p[2] = (float)a.z;
}
static inline void sw_store(double *p, sw_vec a) { p[0] = a.x, p[1] = a.y, p[2] = a.z; }
static inline void sw_accumulate(double *p, sw_vec a) { p[0] += a.x, p[1] += a.y, p[2] += a.z; }
static inline sw_vec sw_add(sw_vec a, sw_vec b) { return sw_v(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline sw_vec sw_sub(sw_vec a, sw_vec b) { return sw_v(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline sw_vec sw_neg(sw_vec a) { return sw_v(-a.x, -a.y, -a.z); }
static inline sw_vec sw_scale(sw_vec a, double s) { return sw_v(a.x * s, a.y * s, a.z * s); }
static inline sw_vec sw_madd(sw_vec a, sw_vec b, double s) { /* a + s b */
  return sw_v(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
static inline double sw_dot(sw_vec a, sw_vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline sw_vec sw_cross(sw_vec a, sw_vec b) {
  return sw_v(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double sw_norm2(sw_vec a) { return sw_dot(a, a); }
static inline double sw_norm(sw_vec a) { return sqrt(sw_dot(a, a)); }
static inline double sw_dist(sw_vec a, sw_vec b) { return sw_norm(sw_sub(a, b)); }
static inline sw_vec sw_lerp(sw_vec a, sw_vec b, double t) { return sw_madd(a, sw_sub(b, a), t); }

/* a / |a|; the fallback (a unit vector) if |a| is 0 or not finite. */
static inline sw_vec sw_unit_or(sw_vec a, sw_vec fallback) {
  const double n = sw_norm(a);
  return (n > 0 && n < HUGE_VAL) ? sw_scale(a, 1.0 / n) : fallback;
}
static inline int sw_finite(sw_vec a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

/* A unit vector perpendicular to the unit vector t. */
static inline sw_vec sw_perpendicular(sw_vec t) {
  const sw_vec axis = fabs(t.x) < 0.6 ? sw_v(1, 0, 0) : sw_v(0, 1, 0);
  return sw_unit_or(sw_madd(axis, t, -sw_dot(axis, t)), sw_v(0, 0, 1));
}

/* A vector u perpendicular to the unit vector t, turned about t by an angle [rad]. */
static inline sw_vec sw_turned(sw_vec u, sw_vec t, double angle) {
  return sw_madd(sw_scale(u, cos(angle)), sw_cross(t, u), sin(angle));
}

static inline sw_quat sw_quat_identity(void) { return (sw_quat){1, 0, 0, 0}; }
static inline sw_quat sw_quat_conj(sw_quat q) { return (sw_quat){q.w, -q.x, -q.y, -q.z}; }
static inline sw_quat sw_quat_mul(sw_quat a, sw_quat b) {
  return (sw_quat){
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
/* q / |q|; the identity if |q| is 0 or not finite. */
static inline sw_quat sw_quat_unit(sw_quat q) {
  const double n = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!(n > 0 && n < HUGE_VAL)) return sw_quat_identity();
  return (sw_quat){q.w / n, q.x / n, q.y / n, q.z / n};
}
static inline sw_vec sw_rotate(sw_quat q, sw_vec a) {
  const sw_vec u = sw_v(q.x, q.y, q.z);
  const sw_vec t = sw_scale(sw_cross(u, a), 2.0);
  return sw_add(sw_madd(a, t, q.w), sw_cross(u, t));
}
static inline sw_vec sw_unrotate(sw_quat q, sw_vec a) { return sw_rotate(sw_quat_conj(q), a); }
/* Rotation by the vector w: axis times angle [rad]. */
static inline sw_quat sw_quat_exp(sw_vec w) {
  const double angle = sw_norm(w);
  const double s = angle > 1e-8 ? sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
  return sw_quat_unit((sw_quat){cos(0.5 * angle), s * w.x, s * w.y, s * w.z});
}
/* The rotation vector of q [rad], angle in [0, pi]. */
static inline sw_vec sw_quat_log(sw_quat q) {
  if (q.w < 0) q = (sw_quat){-q.w, -q.x, -q.y, -q.z};
  const double s = sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
  const double k = s > 1e-8 ? 2.0 * atan2(s, q.w) / s : 2.0 + s * s / 3.0;
  return sw_v(k * q.x, k * q.y, k * q.z);
}

static inline sw_pose sw_pose_identity(void) { return (sw_pose){{0, 0, 0}, {1, 0, 0, 0}}; }
static inline sw_vec sw_pose_point(sw_pose f, sw_vec a) { return sw_add(sw_rotate(f.q, a), f.p); }
/* The world pose of b, which is given in the axes of a. */
static inline sw_pose sw_pose_within(sw_pose a, sw_pose b) {
  return (sw_pose){sw_pose_point(a, b.p), sw_quat_unit(sw_quat_mul(a.q, b.q))};
}
static inline sw_vec sw_pose_local(sw_pose f, sw_vec a) { return sw_unrotate(f.q, sw_sub(a, f.p)); }
/* Pose b, expressed in the axes of a. */
static inline sw_pose sw_pose_from(sw_pose a, sw_pose b) {
  return (sw_pose){sw_pose_local(a, b.p), sw_quat_mul(sw_quat_conj(a.q), b.q)};
}

/* The shortest rotation that takes one unit vector to another. */
static inline sw_quat sw_quat_between(sw_vec from, sw_vec to) {
  const double c = 1.0 + sw_dot(from, to);
  const sw_vec axis = c > 1e-12 ? sw_cross(from, to) : sw_perpendicular(from);
  return sw_quat_unit((sw_quat){c > 1e-12 ? c : 0.0, axis.x, axis.y, axis.z});
}

/* out += f a b', row by row. */
static inline void sw_add_outer(double out[9], sw_vec a, sw_vec b, double f) {
  const double x[3] = {f * a.x, f * a.y, f * a.z}, y[3] = {b.x, b.y, b.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out[3 * i + j] += x[i] * y[j];
}

#endif
