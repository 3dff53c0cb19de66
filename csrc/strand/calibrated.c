/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "strand/calibrated.h"

#include <string.h>

#include "base/alloc.h"

enum { KEPT = 4 }; /* calibrations: of two meshes on two levels of edges and steps [-] */

struct sw_strand_recent {
  sw_strand_need need[KEPT];
  sw_strand_calibrated *made[KEPT]; /* or NULL */
  size_t next;                      /* place of the next one [-] */
};

void sw_strand_calibrated_retain(void *calibrated) {
  ((sw_strand_calibrated *)calibrated)->references++;
}

void sw_strand_calibrated_release(void *calibrated) {
  sw_strand_calibrated *k = calibrated;
  if (!k || --k->references > 0) return;
  sw_calibration_free(&k->calibration);
  sw_free(k);
}

sw_strand_calibrated *sw_strand_recent_find(const sw_strand_recent *r, const sw_strand_need *need) {
  for (size_t i = 0; r && i < KEPT; i++) {
    /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): see sw_strand_need */
    if (!r->made[i] || memcmp(&r->need[i], need, sizeof *need) != 0) continue;
    sw_strand_calibrated_retain(r->made[i]);
    return r->made[i];
  }
  return NULL;
}

void sw_strand_recent_keep(sw_strand_recent *r, const sw_strand_need *need,
                           sw_strand_calibrated *made) {
  if (!r) return;
  const size_t i = r->next;
  sw_strand_calibrated_release(r->made[i]);
  memcpy(&r->need[i], need, sizeof *need);
  sw_strand_calibrated_retain(made);
  r->made[i] = made, r->next = (i + 1) % KEPT;
}

sw_strand_recent *sw_strand_recent_new(void) { return sw_alloc(1, sizeof(sw_strand_recent)); }

void sw_strand_recent_free(sw_strand_recent *r) {
  for (size_t i = 0; r && i < KEPT; i++) sw_strand_calibrated_release(r->made[i]);
  sw_free(r);
}
