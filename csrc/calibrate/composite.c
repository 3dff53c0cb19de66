/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Springs of a shell around cores. First each core is fitted alone to its targets. Then the shell,
 * whose ring has an EA near 2 EI/R^2, is fitted by its springs and its radius so that the whole has
 * EA, EI and GJ. Bonded cores bend about the wire's axis, sliding cores about their own. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "calibrate/calibrate.h"
#include "calibrate/shell_fit.h"

static const double OF_LIMIT = 0.6; /* chosen spacing over the largest allowed [-] */
static const double LONGEST = 0.55; /* largest chosen spacing over the ring's radius [-] */
static const double FADED = 0.02;   /* stiffness over first guess at which a spring is gone [-] */
static const double CARRIED = 0.1;  /* largest EA of bonds, over shell and cores in series [-] */
static const double DEFINITE = 0.2; /* least divisor that is trusted, per core [-] */

/* EA, EI, GJ of a part [N, N m2, N m2]. */
typedef struct part {
  double EA, EI, GJ;
} part;

typedef struct plan {
  const sw_calibrate_args *args;
  const sw_composite_args *given;
  sw_composite *place;
  part wire, shell, core; /* core: of each core */
  double n;               /* number of cores [-] */
  double aside, polar;    /* sums of x^2 and r^2 of bonded cores' centres, else 0 [m2] */
} plan;

/* Area and second moment of area [m2, m4]. */
static double area(double outer, double inner) { return M_PI * (outer * outer - inner * inner); }
static double moment(double outer, double inner) {
  return 0.25 * area(outer, inner) * (outer * outer + inner * inner);
}

/* --- shares of the parts ----------------------------------------------------------------- */

/* Returns the EA of each core if the shell has the rest of EI, its ring being at radius R. */
static double left_by_ring(const plan *p, double R) {
  const double by = p->n - 2 * p->aside / (R * R);
  return (p->wire.EA - 2 * (p->wire.EI - p->n * p->core.EI) / (R * R)) / by;
}

static void share_out(plan *p) {
  const sw_composite *c = p->place;
  const double Ac = area(c->core_radius, 0), Ic = moment(c->core_radius, 0);
  const double As = area(c->radius, c->bore), Is = moment(c->radius, c->bore);
  const double I = Is + p->n * Ic + Ac * p->aside, J = 2 * (Is + p->n * Ic) + Ac * p->polar;
  const double R = sqrt(0.5 * (c->radius * c->radius + c->bore * c->bore));
  const sw_composite_args *a = p->given;
  /* the lesser of the shares by EI and EA: a shell can have more than its share of EI */
  const double by_EA = p->wire.EA * Ic / (As + p->n * Ac);
  p->core.EI = isnan(a->core_EI) ? fmin(p->wire.EI * Ic / I, by_EA) : a->core_EI;
  p->core.GJ = isnan(a->core_GJ) ? p->wire.GJ * 2 * Ic / J : a->core_GJ;
  if (a->core == SW_CORE_LINE) p->core.GJ = 0;
  p->core.EA = a->core_EA;
  if (isnan(p->core.EA) && p->n - 2 * p->aside / (R * R) > DEFINITE * p->n)
    p->core.EA = left_by_ring(p, R);
  else if (isnan(p->core.EA))
    p->core.EA = p->wire.EA * Ac / (As + p->n * Ac);
  p->shell.EA = p->wire.EA - p->n * p->core.EA;
  p->shell.EI = p->wire.EI - p->n * p->core.EI - p->core.EA * p->aside;
  /* the GJ of bonded cores off the axis is found with the whole mesh */
  p->shell.GJ = p->polar > 0 ? fmin(p->wire.GJ - p->n * p->core.GJ, p->wire.GJ * 2 * Is / J)
                             : p->wire.GJ - p->n * p->core.GJ;
}

static sw_status too_much(const plan *p, const char *name, double value, const char *unit,
                          double most, sw_error *err) {
  return sw_fail(err, SW_EINVAL,
                 "calibrate: %s = %.6g %s with cores = %g must be in (0, %.6g) %s, so that the "
                 "shell has a part of the wire's %s: reduce %s",
                 name, value, unit, p->n, most, unit, name + strlen("core_"), name);
}

static sw_status check_parts(const plan *p, sw_error *err) {
  const double EI = p->wire.EI - p->n * p->core.EI;
  if (p->given->core == SW_CORE_LINE && !isnan(p->given->core_GJ))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_GJ = %g N m2: core = 'line' does not resist twist; leave "
                   "core_GJ out, or use core = 'radial' or 'cubic'",
                   p->given->core_GJ);
  if (!(EI > 0)) return too_much(p, "core_EI", p->core.EI, "N m2", p->wire.EI / p->n, err);
  if (isnan(p->given->core_EA) && p->aside > 0 && !(p->shell.EA > 0 && p->shell.EI > 0))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: cores = %g bonded off the axis add their whole EA to bending, so EA "
                   "= %.6g N and EI = %.6g N m2 are not possible together; give bonded = false, "
                   "cores = 1 or a larger EI",
                   p->n, p->wire.EA, p->wire.EI);
  if (!(p->shell.EA > 0)) return too_much(p, "core_EA", p->core.EA, "N", p->wire.EA / p->n, err);
  if (!(p->core.EA > 0))
    return sw_fail(
        err, SW_EINVAL,
        "calibrate: a shell from %.4g m to %.4g m with the rest of EI = %.6g N m2 would have more "
        "than the wire's EA = %.6g N: give a core_EI above %.6g N m2, or a larger radius",
        p->place->bore, p->place->radius, p->wire.EI, p->wire.EA, p->core.EI);
  if (!(p->shell.EI > 0))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: %g bonded cores with core_EA = %.6g N off the axis alone have more "
                   "than EI = %.6g N m2: give a core_EA below %.6g N, or bonded = false",
                   p->n, p->core.EA, p->wire.EI, EI / p->aside);
  if (!(p->shell.GJ > 0)) return too_much(p, "core_GJ", p->core.GJ, "N m2", p->wire.GJ / p->n, err);
  return SW_OK;
}

/* 1 if the ring lies in the shell's wall. */
static int is_in_wall(const plan *p, double R) {
  const double room = 1e-9 * p->place->radius;
  return R >= p->place->bore - room && R <= p->place->radius + room;
}

static sw_status check_wall(const plan *p, double R, sw_error *err) {
  const sw_composite *c = p->place;
  if (is_in_wall(p, R)) return SW_OK;
  const double a = left_by_ring(p, c->bore), b = left_by_ring(p, c->radius);
  return sw_fail(err, SW_EINVAL,
                 "calibrate: with core_EA = %.6g N and core_EI = %.6g N m2 the shell's particles "
                 "would be at %.4g m, outside of its wall from %.4g m to %.4g m: give a "
                 "core_EA between about %.5g N and %.5g N, another wall, or more particles",
                 p->core.EA, p->core.EI, R, c->bore, c->radius, fmax(0, fmin(a, b)), fmax(a, b));
}

/* --- spacing --------------------------------------------------------------------------- */

/* As for the tube: above this spacing the diagonals alone have more than EI. */
static double limit(double R, part of, double reach, double particles) {
  return R * sqrt(2 * of.EI / of.GJ) * fabs(sin(2 * M_PI * reach / particles));
}

static double shell_limit(const plan *p) {
  sw_tube_args tube;
  sw_params_default(&sw_tube_params, &tube);
  tube.particles = (long)p->place->ring;
  tube.reach = p->given->reach;
  return limit(p->place->ring_radius, p->shell, (double)sw_tube_reach(&tube),
               (double)p->place->ring);
}

static double core_limit(const plan *p) {
  const double M = (double)sw_core_particles(p->given, p->place);
  return p->given->core == SW_CORE_RADIAL ? limit(p->place->core_radius, p->core, 1, M) : HUGE_VAL;
}

static double choose_spacing(const plan *p) {
  const sw_composite *c = p->place;
  const sw_composite_args *a = p->given;
  double h = fmin(2 * sin(M_PI / (double)c->ring), LONGEST) * c->ring_radius;
  const double most = OF_LIMIT * shell_limit(p);
  if (!isnan(p->args->spacing)) return p->args->spacing;
  if (most > 1e-6 * h) h = fmin(h, most); /* 0: the tube refuses this reach */
  if (a->core == SW_CORE_RADIAL) {
    const double M = (double)sw_core_particles(a, c), L = (double)sw_core_layers(a, c);
    h = fmin(h, fmin(2 * c->core_radius * sin(M_PI / M), c->core_radius / L));
    h = fmin(h, OF_LIMIT * core_limit(p));
  }
  if (a->core == SW_CORE_CUBIC) h = fmin(h, 2 * c->core_radius / (double)sw_core_across(a, c));
  return h;
}

/* --- one core --------------------------------------------------------------------------- */

static sw_status check_core(const plan *p, const sw_calibration *core, sw_error *err) {
  int worst = 0;
  for (int t = 1; t < SW_TARGETS; t++)
    if (fabs(core->residual[t]) > fabs(core->residual[worst])) worst = t;
  const double off = core->residual[worst], h = core->lattice.spacing;
  const int near = fabs(off) <= p->args->tolerance;
  char text[160];
  if (p->args->tolerance == 1 || (near && core->fading >= FADED)) return SW_OK;
  if (h > 0.85 * core_limit(p))
    snprintf(text, sizeof text, "spacing = %.4g m must be less than about %.4g m", h,
             0.8 * core_limit(p));
  else if (p->given->core == SW_CORE_CUBIC && sw_core_across(p->given, p->place) < 2)
    snprintf(text, sizeof text, "increase core_across = 1");
  else
    snprintf(text, sizeof text,
             "core_EI/core_EA is %.3g m2, and that of a solid core of this radius is %.3g m2: "
             "change one of them, or take another core",
             p->core.EI / p->core.EA, 0.25 * p->place->core_radius * p->place->core_radius);
  if (near)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: core_EA, core_EI and core_GJ are reached together only with %s "
                   "springs of the core close to zero (%.2g of the usual stiffness); %s",
                   sw_group_names[core->faded], core->fading, text);
  return sw_fail(err, SW_EINVAL,
                 "calibrate: no springs of the core give core_%s = %.6g %s; the nearest differ "
                 "by %+.2g %%; %s",
                 sw_target_names[worst], core->target[worst], sw_target_units[worst], 100 * off,
                 text);
}

/* Fits the springs of one core alone, core->lattice, into the core groups of k. */
static sw_status fit_core(const plan *p, sw_calibration *core, double *k, sw_error *err) {
  const double h = core->lattice.spacing;
  if (p->given->core == SW_CORE_LINE) {
    memset(&core->reached, 0, sizeof core->reached);
    core->reached.S[SW_CELL_STRETCH * (SW_CELL_STRAINS + 1)] = p->core.EA;
    core->reached.S[SW_CELL_ABOUT_X * (SW_CELL_STRAINS + 1)] = p->core.EI;
    core->reached.S[SW_CELL_ABOUT_Y * (SW_CELL_STRAINS + 1)] = p->core.EI;
    k[SW_GROUP_OF_CORE + SW_GROUP_CORE] = p->core.EA / h;
    k[SW_GROUP_OF_CORE + SW_GROUP_BEND] = p->core.EI / h;
    return SW_OK;
  }
  for (int t = 0; t < SW_TARGETS; t++) core->target[t] = (double)NAN;
  core->target[SW_TARGET_EA] = p->core.EA;
  core->target[SW_TARGET_EI] = p->core.EI;
  core->target[SW_TARGET_GJ] = p->core.GJ;
  SW_TRY(sw_calibrate_fit(core, err));
  SW_TRY(check_core(p, core, err));
  for (size_t g = 0; g < SW_GROUP_BOND; g++) k[SW_GROUP_OF_CORE + g] = core->k[g];
  return SW_OK;
}

/* --- bonds ------------------------------------------------------------------------------ */

/* Sets the bonds. Within a slice they are like bars of the shell's modulus. Bonds to the next slice
 * resist sliding, but also stretch; they are limited so that they carry at most the share CARRIED
 * of the EA of shell and cores in series. */
static void set_bonds(const plan *p, sw_calibration *out) {
  const sw_lattice *l = &out->lattice;
  const sw_cell cell = sw_lattice_cell(l);
  const double h = l->spacing, cores = p->n * p->core.EA;
  const double both = cores * p->shell.EA / (cores + p->shell.EA);
  double length = 0, count = 0, carried = 0;
  for (size_t m = 0; m < l->links; m++) {
    if (l->link[m].group != SW_GROUP_BOND) continue;
    const double own = sw_cell_length(&cell, l->link + m);
    if (l->link[m].slices)
      carried += h * h * h / (own * own);
    else
      length += own, count++;
  }
  const double base = p->shell.EA / (h * (double)p->place->ring), mean = length / count;
  const double usual = base * h / mean;
  const double inclined = fmin(1, CARRIED * both / (carried * usual));
  for (size_t m = 0; m < l->links; m++)
    if (l->link[m].group == SW_GROUP_BOND && l->link[m].slices) l->link[m].weight = inclined;
  out->k[SW_GROUP_BOND] = p->given->bond * usual;
}

/* --- the whole --------------------------------------------------------------------------- */

/* Returns the shell alone: the slice's first particles and links. */
static sw_cell shell_cell(const sw_calibration *c) {
  sw_cell cell = sw_lattice_cell(&c->lattice);
  cell.particles = c->composite.ring;
  cell.links = c->composite.shell_links;
  return cell;
}

static void add(sw_cell_result *sum, const sw_cell_result *more, double times) {
  for (int i = 0; i < SW_CELL_SIZE; i++) sum->S[i] += times * more->S[i];
}

/* Computes the stiffness of the parts alone, and of the whole. */
static sw_status read_back(const plan *p, sw_calibration *out, sw_error *err) {
  const sw_cell alone = shell_cell(out), whole = sw_lattice_cell(&out->lattice);
  SW_TRY(sw_cell_stiffness(&alone, out->k, &out->composite.shell, NULL, err));
  if (p->given->bonded) {
    SW_TRY(sw_cell_stiffness(&whole, out->k, &out->reached, NULL, err));
  } else {
    out->reached = out->composite.shell;
    add(&out->reached, &out->composite.core, p->n);
  }
  for (int t = 0; t < SW_TARGETS; t++)
    out->residual[t] = sw_reached(&out->reached, t) / out->target[t] - 1;
  return SW_OK;
}

static sw_status check_whole(const plan *p, const sw_calibration *out, sw_error *err) {
  static const int targets[] = {SW_TARGET_EA, SW_TARGET_EI, SW_TARGET_GJ};
  int worst = SW_TARGET_EA;
  for (int t = 0; t < 3; t++)
    if (!(fabs(out->residual[targets[t]]) <= fabs(out->residual[worst]))) worst = targets[t];
  if (p->args->tolerance == 1) return SW_OK;
  const double h = out->lattice.spacing, most = shell_limit(p), R = p->place->ring_radius;
  const int near = fabs(out->residual[worst]) <= p->args->tolerance;
  if (near && (h < OF_LIMIT * most || is_in_wall(p, R))) return check_wall(p, R, err);
  char text[200];
  if (near)
    return sw_fail(err, SW_EINVAL,
                   "calibrate: with spacing = %.4g m the shell's particles would be at %.4g m, "
                   "outside of its wall from %.4g m to %.4g m: make spacing less than about %.4g m",
                   h, R, p->place->bore, p->place->radius, OF_LIMIT * most);
  if (h > 0.85 * most)
    snprintf(text, sizeof text,
             "the diagonals that GJ needs are too stiff in bending: spacing = %.4g m must be "
             "less than about %.4g m",
             h, 0.8 * most);
  else if (p->given->bonded && out->residual[worst] > 0)
    snprintf(text, sizeof text,
             "bonds and cores alone have more than that: reduce bond = %g or core_%s, or "
             "give bonded = false",
             p->given->bond, sw_target_names[worst]);
  else
    snprintf(text, sizeof text,
             "try another wall, a spacing other than %.4g m, or a core_EA other than %.4g N", h,
             p->core.EA);
  return sw_fail(err, SW_EINVAL,
                 "calibrate: no springs of the shell give the whole %s = %.6g %s; the nearest have "
                 "%.6g %s (%+.2g %%); %s",
                 sw_target_names[worst], out->target[worst], sw_target_units[worst],
                 sw_reached(&out->reached, worst), sw_target_units[worst],
                 100 * out->residual[worst], text);
}

/* Fits the shell alone, then, if bonded, within the whole. */
static sw_status fit_whole(const plan *p, sw_calibration *out, sw_error *err) {
  const double alone[SW_SHELL_TARGETS] = {p->shell.EA, p->shell.EI, p->shell.GJ};
  const double all[SW_SHELL_TARGETS] = {p->wire.EA, p->wire.EI, p->wire.GJ};
  memset(out->links, 0, sizeof out->links);
  for (size_t m = 0; m < out->lattice.links; m++) out->links[out->lattice.link[m].group]++;
  sw_shell_guess(out, shell_cell(out), alone);
  SW_TRY(sw_shell_fit(out, shell_cell(out), alone, err));
  if (p->given->bonded) {
    set_bonds(p, out);
    SW_TRY(sw_shell_fit(out, sw_lattice_cell(&out->lattice), all, err));
  }
  SW_TRY(read_back(p, out, err));
  return check_whole(p, out, err);
}

static sw_status build(plan *p, sw_calibration *out, sw_error *err) {
  sw_calibration core;
  double share = 0;
  memset(&core, 0, sizeof core);
  SW_TRY(sw_composite_core_share(p->given, p->place, out->mass_per_length, &share, err));
  sw_status status = sw_lattice_core(p->given, p->place, choose_spacing(p), &core.lattice, err);
  if (status == SW_OK)
    status = sw_lattice_composite(p->given, &core.lattice, share, p->place, &out->lattice, err);
  if (status == SW_OK) status = fit_core(p, &core, out->k, err);
  out->composite.core = core.reached;
  sw_lattice_free(&core.lattice);
  return status == SW_OK ? fit_whole(p, out, err) : status;
}

static void sum_squares(plan *p) {
  for (size_t i = 0; p->given->bonded && i < p->place->cores; i++) {
    const sw_vec c = p->place->centre[i];
    p->aside += c.x * c.x;
    p->polar += sw_norm2(c);
  }
}

sw_status sw_calibrate_composite(const sw_calibrate_args *args, const sw_section *section,
                                 const sw_beam *beam, const sw_composite_args *given,
                                 sw_calibration *out, sw_error *err) {
  plan p = {.args = args, .given = given, .place = &out->composite};
  if (!isnan(args->squeeze))
    return sw_fail(err, SW_EINVAL,
                   "calibrate: squeeze = %g Pa goes with mesh = 'tube', 'radial' or 'cubic', not "
                   "with 'composite'",
                   args->squeeze);
  if (!isnan(section->spin_inertia))
    return sw_fail(
        err, SW_EINVAL,
        "calibrate: spin_inertia = %g kg m goes with mesh = 'tube'; give core_mass [kg/m] "
        "to mesh = 'composite'",
        section->spin_inertia);
  SW_TRY(sw_composite_check_springs(given, err));
  SW_TRY(sw_composite_place(given, beam->radius, p.place, err));
  p.wire = (part){beam->EA, beam->EI, beam->GJ};
  p.n = (double)p.place->cores;
  sum_squares(&p);
  share_out(&p);
  SW_TRY(check_parts(&p, err));
  const double R = sqrt(2 * p.shell.EI / p.shell.EA);
  SW_TRY(check_wall(&p, R, err));
  p.place->ring_radius = R;
  return build(&p, out, err);
}
