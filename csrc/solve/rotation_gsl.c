/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Davenport's q method: R's quaternion is the eigenvector of K's largest eigenvalue. */
#include <gsl/gsl_eigen.h>
#include <math.h>

#include "solve/rotation.h"

sw_quat sw_rotation_fit(const double B[9]) {
  const double trace = B[0] + B[4] + B[8];
  const double z[3] = {B[7] - B[5], B[2] - B[6], B[3] - B[1]};
  double K[16], work[4][4], value[4], vector[16];
  if (!isfinite(trace + z[0] + z[1] + z[2])) return sw_quat_identity();
  K[0] = trace;
  for (int i = 0; i < 3; i++) {
    K[1 + i] = K[4 * (1 + i)] = z[i];
    for (int j = 0; j < 3; j++)
      K[4 * (1 + i) + 1 + j] = B[3 * i + j] + B[3 * j + i] - (i == j ? trace : 0.0);
  }
  /* GSL's work space for four unknowns, without an allocation */
  gsl_eigen_symmv_workspace space = {
      .size = 4, .d = work[0], .sd = work[1], .gc = work[2], .gs = work[3]};
  gsl_matrix_view k = gsl_matrix_view_array(K, 4, 4), v = gsl_matrix_view_array(vector, 4, 4);
  gsl_vector_view e = gsl_vector_view_array(value, 4);
  gsl_eigen_symmv(&k.matrix, &e.vector, &v.matrix, &space);
  size_t best = 0;
  for (size_t i = 1; i < 4; i++)
    if (value[i] > value[best]) best = i;
  return sw_quat_unit(
      (sw_quat){vector[best], vector[4 + best], vector[8 + best], vector[12 + best]});
}
