/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elimination order by approximate minimum degree (Amestoy, Davis and Duff 1996). The only file
 * that uses the AMD library. */
#include <suitesparse/amd.h>

#include "solve/order.h"

sw_status sw_sparse_order(size_t n, const int32_t *first, const int32_t *next, int32_t *order) {
  const int status = amd_order((int)n, first, next, order, NULL, NULL);
  return status == AMD_OK || status == AMD_OK_BUT_JUMBLED ? SW_OK : SW_ENOMEM;
}
