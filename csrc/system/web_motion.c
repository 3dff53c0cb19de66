/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Webs about the state: forces between particles, and the motion of all for given motions of
 * some. */
#include <string.h>

#include "base/vec.h"
#include "solve/blocks.h"
#include "system/assemble.h"
#include "system/linear.h"
#include "system/web.h"

sw_status sw_system_inner_forces(sw_system *s, size_t body, double *out, sw_error *err) {
  static const double none[3] = {0, 0, 0};
  sw_body *b = &s->bodies[body];
  sw_field *f = &b->field;
  f->want = SW_WANT_FORCE;
  f->gravity = none; /* gravity is among the terms */
  f->x = s->x + 3 * b->first_node, f->v = s->v + 3 * b->first_node;
  f->strain_past = f->strain = f->strain_rate = NULL;
  sw_body_begin(b);
  for (size_t k = 0; k < b->term_count; k++)
    if ((b->terms[k].cls->flags & (SW_FORCE_INNER | SW_FORCE_EXPLICIT)) == SW_FORCE_INNER)
      SW_TRY(sw_term_eval(&b->terms[k], f, err));
  memcpy(out, f->force, 3 * b->plan->nodes * sizeof *out);
  return SW_OK;
}

sw_status sw_system_fix_particles(sw_system *s, size_t body, const unsigned char *fixed) {
  sw_body *b = &s->bodies[body];
  size_t negative;
  sw_gather_rows(&b->field, 0.0, b->field.rows);
  sw_web_gather(b);
  b->web_factored = 0;
  return sw_blocks_factor(b->blocks, fixed, &negative);
}

void sw_system_carry(const sw_system *s, size_t body, const unsigned char *fixed, double *motion,
                     double *push) {
  const sw_body *b = &s->bodies[body];
  const size_t n = b->plan->nodes;
  sw_blocks_multiply(b->blocks, motion, push);
  for (size_t i = 0; i < n; i++)
    sw_store(push + 3 * i, fixed[i] ? sw_v(0, 0, 0) : sw_neg(sw_vec_at(push, i)));
  sw_blocks_solve(b->blocks, push);
  for (size_t i = 0; i < 3 * n; i++) motion[i] += push[i];
  sw_blocks_multiply(b->blocks, motion, push);
}
