/* SPDX-License-Identifier: GPL-3.0-or-later */
/* NLopt's derivative-free minimisers (S. G. Johnson, The NLopt nonlinear-optimization package). */
#include <nlopt.h>
#include <string.h>

#include "calibrate/search_inner.h"

static const struct {
  const char *name;
  nlopt_algorithm algorithm;
} METHODS[] = {
    {"bobyqa", NLOPT_LN_BOBYQA},   /* Powell 2009 */
    {"cobyla", NLOPT_LN_COBYLA},   /* Powell 1994 */
    {"direct", NLOPT_GN_DIRECT_L}, /* Gablonsky, Kelley 2001 */
    {"crs2", NLOPT_GN_CRS2_LM},    /* Kaelo, Ali 2006 */
};

static const double CONSTRAINT_TOLERANCE = 0; /* no violation is allowed [-] */

static int index_of(const char *method) {
  for (int k = 0; k < (int)(sizeof METHODS / sizeof *METHODS); k++)
    if (strcmp(METHODS[k].name, method) == 0) return k;
  return -1;
}

int sw_search_is_nlopt(const char *method) { return index_of(method) >= 0; }

typedef struct bridge {
  sw_search *s;
  nlopt_opt opt;
} bridge;

static double objective(unsigned n SW_UNUSED, const double *x, double *gradient SW_UNUSED,
                        void *user) {
  bridge *b = user;
  b->s->known = 0;
  if (sw_search_evaluate(b->s, x)) return b->s->value;
  nlopt_force_stop(b->opt);
  return 0;
}

static void constraints(unsigned m, double *result, unsigned n SW_UNUSED, const double *x,
                        double *gradient SW_UNUSED, void *user) {
  bridge *b = user;
  const int known = sw_search_evaluate(b->s, x);
  if (!known) nlopt_force_stop(b->opt);
  for (unsigned k = 0; k < m; k++) result[k] = known ? b->s->broken[k] : 0;
}

static void tell(sw_search *s, nlopt_result code) {
  s->ok = code > 0 || code == NLOPT_ROUNDOFF_LIMITED;
  if (s->ok)
    sw_fail(&s->reason, SW_ENOCONV, "the wanted accuracy was reached");
  else
    sw_fail(&s->reason, SW_ENOCONV, "NLopt: %s", nlopt_result_to_string(code));
}

/* 1 for crs2. Its xtol compares successive best points, which are soon close; the caller decides
 * when it is done. */
static int is_crs2(const sw_search_args *a) { return a->method[0] == 'c' && a->method[1] == 'r'; }

static nlopt_result prepare(bridge *b) {
  const sw_search_args *a = &b->s->args;
  nlopt_result code = nlopt_set_min_objective(b->opt, objective, b);
  if (code > 0) code = nlopt_set_lower_bounds1(b->opt, 0);
  if (code > 0) code = nlopt_set_upper_bounds1(b->opt, 1);
  if (code > 0) code = nlopt_set_initial_step1(b->opt, a->step);
  if (code > 0) code = nlopt_set_xtol_abs1(b->opt, is_crs2(a) ? 0 : a->tolerance);
  if (code > 0 && a->constraints > 0) {
    double tolerance[SW_SEARCH_MOST];
    for (size_t k = 0; k < a->constraints; k++) tolerance[k] = CONSTRAINT_TOLERANCE;
    code = nlopt_add_inequality_mconstraint(b->opt, (unsigned)a->constraints, constraints, b,
                                            tolerance);
  }
  return code;
}

void sw_search_nlopt(sw_search *s) {
  const size_t n = s->args.n;
  double x[SW_SEARCH_MOST], least = 0;
  bridge b = {s, nlopt_create(METHODS[index_of(s->args.method)].algorithm, (unsigned)n)};
  memcpy(x, s->start, n * sizeof *x);
  nlopt_result code = b.opt ? prepare(&b) : NLOPT_OUT_OF_MEMORY;
  if (is_crs2(&s->args)) nlopt_srand(s->args.seed);
  if (code > 0) code = nlopt_optimize(b.opt, x, &least);
  tell(s, code);
  nlopt_destroy(b.opt);
}
