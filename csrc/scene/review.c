/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Refuses changes while a run that has ended is read. */
#include "scene/review.h"

#include <stdio.h>

#include "base/alloc.h"

struct sw_review {
  char what[128], instead[160]; /* shortened if need be */
  int refused;                  /* 1: a change has been refused */
  int unlike;                   /* 1: only another model of a wire has what was asked for */
  sw_review *outer;             /* the review inside which it began, or NULL */
};

static sw_status refuse(const sw_scene *s, const sw_review *r, sw_error *err) {
  return sw_fail(err, SW_EBUSY,
                 "scene '%.100s' cannot be changed inside the function `of` of %s: that function "
                 "reads a run that has ended; %s",
                 sw_scene_name(s), r->what, r->instead);
}

sw_status sw_scene_begin_review(sw_scene *s, const char *what, const char *instead, sw_error *err) {
  sw_review **now = sw_scene_review(s), *r = sw_alloc(1, sizeof *r);
  if (!r) return sw_fail(err, SW_ENOMEM, "out of memory");
  snprintf(r->what, sizeof r->what, "%s", what);
  snprintf(r->instead, sizeof r->instead, "%s", instead);
  r->outer = *now;
  *now = r;
  return SW_OK;
}

sw_status sw_scene_end_review(sw_scene *s, int *unlike, sw_error *err) {
  sw_review **now = sw_scene_review(s), *r = *now;
  *unlike = r && r->unlike;
  if (!r) return SW_OK;
  const sw_status status = r->refused ? refuse(s, r, err) : SW_OK;
  *now = r->outer;
  sw_free(r);
  return status;
}

void sw_scene_asks_other_model(const sw_scene *s) {
  sw_review *r = *sw_scene_review(s);
  if (r) r->unlike = 1;
}

sw_status sw_scene_not_reviewed(const sw_scene *s, sw_error *err) {
  sw_review *r = *sw_scene_review(s);
  if (!r) return SW_OK;
  r->refused = 1;
  return refuse(s, r, err);
}
