/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Poses: holds and obstacles go from place to place, and the wires are in equilibrium at each. */
#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/live.h"
#include "contact/contact.h"
#include "grip/jaws.h"
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/energy.h"
#include "step/jaw.h"
#include "step/let_go.h"
#include "step/outer.h"
#include "step/passing.h"
#include "step/rest.h"
#include "watch/observe.h"

enum { MOST_HALVINGS = 6 }; /* a pose step is halved at most this often [-] */

/* Most iterations of a trial. If a pose needs more, smaller steps find it sooner [-]. */
enum { FEW_ITERATIONS = 300 };

/* The scene at the start of a pose. It is kept if a tie may break, a wire may enter a clip, pads
 * may press a section, or a rigid grip may bear too much. */
typedef struct kept {
  sw_tape live;
  sw_jaw *jaws; /* (tools) */
  double *x;    /* (freedoms) places of nodes */
  int next;     /* see sw_course */
  sw_outer_start outer;
  struct kept *motion; /* NULL; or a start, maybe this one, from which wires move if no
                          equilibrium is found */
} kept;

static void drop(kept *k) {
  sw_tape_free(&k->live);
  sw_free(k->jaws);
  sw_free(k->x);
  sw_outer_drop(&k->outer);
  *k = (kept){0};
}

static sw_status keep(const sw_scene *s, kept *k, sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  k->next = sw_scene_course(s)->next;
  k->jaws = sw_alloc(sw_scene_tool_slots(s), sizeof *k->jaws);
  k->x = sw_alloc(system->freedoms, sizeof *k->x);
  const sw_status status = k->jaws && k->x ? sw_live_take(s, &k->live) : SW_ENOMEM;
  if (k->x) memcpy(k->x, system->x, system->freedoms * sizeof *k->x);
  for (size_t i = 0; status == SW_OK && i < sw_scene_tool_slots(s); i++)
    k->jaws[i] = sw_scene_tool_in(s, i)->jaw;
  if (status == SW_OK) return SW_OK;
  drop(k);
  return sw_fail(err, status, "scene '%s': out of memory", sw_scene_name(s));
}

/* The same for a grip that may be lost: the way to the pose is not followed more closely. */
static sw_status keep_loosely(const sw_scene *s, kept *k, sw_error *err) {
  SW_TRY(keep(s, k, err));
  sw_free(k->x);
  k->x = NULL;
  return SW_OK;
}

static sw_status put_back(sw_scene *s, const kept *k, double t0, sw_error *err) {
  sw_scene_set_time(s, t0);
  sw_scene_course(s)->next = k->next;
  for (size_t i = 0; k->jaws && i < sw_scene_tool_slots(s); i++)
    sw_scene_tool_in(s, i)->jaw = k->jaws[i];
  return sw_live_back(s, &k->live, err);
}

/* Call when no equilibrium was found: if wires may move then, returns to the start, at t0, with
 * what contact knew there. Returns the status. */
static sw_status give_up(sw_scene *s, const kept *start, double t0, sw_status status,
                         sw_error *err) {
  sw_contact *contact = sw_scene_contact(s);
  if (status != SW_ENOCONV || !start->motion) return status;
  SW_TRY(put_back(s, start->motion, t0, err));
  if (contact) SW_TRY(sw_contact_began(contact, t0, err));
  return status;
}

static sw_status pose(sw_scene *s, double t1, int halvings, const sw_pose_args *how,
                      sw_run_report *report, sw_error *err);

/* Returns the part of a pose of size h in which no wire moves too far past a force of short reach.
 * Without this limit the depth in a clip, and the force, would depend on the path of Newton's
 * iteration. */
static double followed_part(const sw_scene *s, const double *from, double h, int *passed) {
  const double part = sw_passing_part(h, sw_passing_between(s, from, sw_scene_system(s)->x));
  *passed = part < h;
  return part;
}

/* Call if no equilibrium was found at t1: goes to the middle of the path, then to its end. */
static sw_status by_the_middle(sw_scene *s, double t1, int halvings, const sw_pose_args *how,
                               sw_run_report *report, const kept *start, sw_error *err) {
  SW_TRY(pose(s, 0.5 * (sw_scene_time(s) + t1), halvings - 1, how, report, err));
  if (start->jaws) return SW_OK; /* a tie may break: the caller shortens the pose */
  sw_jaw_follow(s);
  return pose(s, t1, halvings - 1, how, report, err);
}

/* Returns to the start, at t0, then goes only to t. */
static sw_status again(sw_scene *s, double t0, double t, int halvings, const sw_pose_args *how,
                       sw_run_report *report, kept *start, sw_error *err) {
  SW_TRY(put_back(s, start, t0, err));
  drop(start);
  return pose(s, t, halvings, how, report, err);
}

static sw_status book(sw_scene *s, double t0, double t1, const sw_settle_report *rest, int passed,
                      const sw_outer_start *outer, sw_run_report *report, sw_error *err) {
  double work;
  int jumped = rest->jumped || passed;
  SW_TRY(sw_outer_work(s, outer, &work, err));
  SW_TRY(sw_ledger_pose(s, t0, rest->far, &jumped, rest->rubbed, work, err));
  if (!jumped) return SW_OK;
  report->jumps++;
  report->last_jump = t1;
  return SW_OK;
}

enum { MOST_ROUNDS = 100 };

/* Friction of clips follows from the push in the pose before. If that had none, the wires come to
 * rest again until friction and push agree. */
static sw_status rest_again(sw_scene *s, const sw_settle_args *args, int (*interrupted)(void),
                            sw_settle_report *rest, sw_error *err) {
  int more = sw_rest_catch_up(s, 1);
  const int jumped = rest->jumped, far = rest->far;
  for (int round = 1; more; round++) {
    SW_TRY(sw_scene_rest(s, sw_scene_time(s), NULL, args, interrupted, rest, err));
    more = sw_rest_catch_up(s, 0) && round < MOST_ROUNDS;
  }
  rest->jumped |= jumped, rest->far |= far;
  return SW_OK;
}

/* Finds the equilibrium. If none is found with little depth between wires drawn taut, they first
 * come to rest with more; if they do not from there either, that depth stays, and is reported. */
static sw_status find_rest(sw_scene *s, double t0, int *too_far, const sw_settle_args *args,
                           int (*interrupted)(void), sw_settle_report *rest, sw_error *err) {
  const sw_status first = sw_scene_rest(s, t0, too_far, args, interrupted, rest, err);
  if (first != SW_ENOCONV || (too_far && *too_far) || !sw_scene_pairs(s)) return first;
  sw_settle_args loose = *args;
  sw_settle_report more = {0};
  sw_error why;
  loose.tight = 0;
  sw_status status = sw_scene_rest(s, t0, too_far, &loose, interrupted, &more, &why);
  rest->iterations += more.iterations;
  if (status == SW_ENOCONV) return first;
  if (status != SW_OK) return sw_fail(err, status, "%s", why.text);
  more.iterations = rest->iterations, *rest = more;
  sw_tape before = {0};
  sw_settle_report tight = {0};
  status = sw_live_take(s, &before);
  if (status == SW_OK)
    status = sw_scene_rest(s, sw_scene_time(s), NULL, args, interrupted, &tight, &why);
  rest->iterations += tight.iterations, rest->jumped |= tight.jumped, rest->far |= tight.far;
  rest->rubbed += tight.rubbed;
  if (status == SW_ENOCONV) status = sw_live_back(s, &before, &why);
  sw_tape_free(&before);
  return status == SW_OK ? SW_OK : sw_fail(err, status, "%s", why.text);
}

static sw_status search(sw_scene *s, double t0, int *too_far, int squeezes,
                        const sw_settle_args *args, int (*interrupted)(void),
                        sw_settle_report *rest, sw_error *err) {
  return squeezes ? sw_scene_squeezed_rest(s, t0, too_far, args, interrupted, rest, err)
                  : find_rest(s, t0, too_far, args, interrupted, rest, err);
}

/* Finds the equilibrium. In a pose that cannot be divided any more wires leave pads that hold them
 * by short steps, as they would in motion. If none is found so, or with other forces of the jaws
 * only, they may jump out of them. */
static sw_status hold_on(sw_scene *s, double t0, int *too_far, int squeezes, sw_settle_args *args,
                         int (*interrupted)(void), sw_settle_report *rest, sw_error *err) {
  if (!squeezes || sw_jaws_strained(s))
    return search(s, t0, too_far, squeezes, args, interrupted, rest, err);
  kept start = {0};
  sw_status status = keep_loosely(s, &start, err);
  args->holds = 1;
  if (status == SW_OK) status = search(s, t0, too_far, 1, args, interrupted, rest, err);
  args->holds = 0;
  if ((status == SW_ENOCONV && !too_far) || (status == SW_OK && sw_jaws_strained(s))) {
    const size_t before = rest->iterations;
    *rest = (sw_settle_report){0};
    status = put_back(s, &start, sw_scene_time(s), err);
    if (status == SW_OK) status = search(s, t0, too_far, 1, args, interrupted, rest, err);
    rest->iterations += before;
  }
  drop(&start);
  return status;
}

/* Moves holds and obstacles to t1 and the wires to their equilibrium there. Without friction the
 * size of the pose step does not matter; with friction, halve it to see how much it does. */
static sw_status one_pose(sw_scene *s, double t1, int halvings, const sw_pose_args *how,
                          sw_run_report *report, kept *start, sw_error *err) {
  sw_settle_args args = {
      .tolerance = 1e-9, .max_iterations = 4000, .poses = 1, .tight = 1, .passing = how->between};
  sw_settle_report rest = {0};
  sw_error why;
  const double t0 = sw_scene_time(s);
  const int still = sw_course_is_still(sw_scene_course(s));
  int (*const interrupted)(void) = how->interrupted;
  int too_far = 0;
  int *const tells = halvings ? &too_far : NULL;
  const int squeezes = sw_jaw_begin(s, t1 - t0);
  const int shortest = t1 - t0 <= 1.5 * how->passing; /* equal except for rounding */
  args.stays = start->x && !shortest && halvings;
  if (squeezes && halvings) args.max_iterations = FEW_ITERATIONS;
  sw_scene_set_time(s, t1);
  sw_status status = hold_on(s, t0, tells, squeezes, &args, interrupted, &rest, err);
  if (status == SW_OK && !squeezes) status = rest_again(s, &args, interrupted, &rest, err);
  report->iterations += rest.iterations;
  *how->falls = status != SW_OK && rest.falls;
  if (status != SW_OK) {
    sw_scene_set_time(s, t0);
    const int helps = too_far || (squeezes && status == SW_ENOCONV); /* jaws then go less far */
    if (!helps || !halvings) return give_up(s, start, t0, status, err);
    return by_the_middle(s, t1, halvings, how, report, start, err);
  }
  const double part_of_jaws =
      start->jaws && squeezes ? sw_jaw_part(s, start->jaws, t1 - t0) : t1 - t0;
  if (start->jaws && part_of_jaws < (t1 - t0) * (1 - 1e-9))
    return again(s, t0, t0 + part_of_jaws, halvings, how, report, start, err);
  if (start->jaws && t1 - t0 > how->shortest &&
      sw_scene_check_ties(s, sw_scene_system(s)->x, &why) != SW_OK)
    return again(s, t0, 0.5 * (t0 + t1), halvings, how, report, start, err);
  if (start->jaws) SW_TRY(sw_grips_overloaded(s, t0, t1, how->lost, err));
  if (*how->lost) return put_back(s, start, t0, err);
  int passed = 0;
  const double part = start->x ? followed_part(s, start->x, t1 - t0, &passed) : t1 - t0;
  if (passed && !shortest)
    return again(s, t0, t0 + fmax(part, how->passing), halvings, how, report, start, err);
  report->smallest_dt = fmin(report->smallest_dt, t1 - t0);
  rest.far &= still; /* wires that were drawn elsewhere fall first */
  return book(s, t0, t1, &rest, passed, &start->outer, report, err);
}

static sw_status pose(sw_scene *s, double t1, int halvings, const sw_pose_args *how,
                      sw_run_report *report, sw_error *err) {
  kept start = {0}, motion = {0};
  sw_status status = sw_outer_begin_pose(s, &start.outer, err);
  const int breaks = sw_scene_may_break(s) || sw_passing_any(s) || sw_jaw_ways_matter(s);
  if (status == SW_OK && breaks)
    status = keep(s, &start, err);
  else if (status == SW_OK && sw_grips_frozen(s))
    status = keep_loosely(s, &start, err);
  if (status == SW_OK && how->unsettled) {
    if (!start.jaws) status = keep_loosely(s, &motion, err);
    start.motion = start.jaws ? &start : &motion;
  }
  if (status == SW_OK) status = one_pose(s, t1, halvings, how, report, &start, err);
  drop(&start);
  drop(&motion);
  return status;
}

/* Largest shift of pads with a wire from one pose to the next, over the thinnest wire's radius.
 * With 16 times as much a laying costs as many iterations in all, and friction on the table follows
 * the way less well: forces differ by 0.5 % (spec/physics/poses_pads_spec) [-]. */
static const double WIDEST_SHIFT = 0.5;

/* Returns the largest distance from a tool's centre at which it presses [m]. */
static double reach_of(const sw_scene *s, const sw_tool *t) {
  sw_contact *contact = sw_scene_contact(s);
  double reach = 0;
  for (size_t i = 0; contact && i < sw_contact_touches(contact); i++) {
    sw_contact_push push;
    if (!sw_contact_push_at(contact, sw_scene_system(s), i, &push)) continue;
    for (size_t k = 0; k < t->pads; k++)
      if (t->pad[k].obstacle == (size_t)push.obstacle)
        reach = fmax(reach, sw_dist(push.point, t->now.centre));
  }
  return reach;
}

enum { MOST_CUTS = 60 }; /* cuts of a step, for motions that start slowly and end fast [-] */

/* Shortens the step h so that the tool carries the wires between its pads by at most `most` [m]. */
static sw_status carried_step(sw_scene *s, const sw_tool *t, double most, double *h,
                              sw_error *err) {
  sw_motion_state from, to;
  SW_TRY(sw_drive_eval(s, &t->drive, sw_scene_time(s), &from, err));
  const double reach = reach_of(s, t);
  for (int cut = 0; cut < MOST_CUTS; cut++) {
    SW_TRY(sw_drive_eval(s, &t->drive, sw_scene_time(s) + *h, &to, err));
    const sw_quat turned = sw_quat_mul(to.pose.q, sw_quat_conj(from.pose.q));
    const double shift = sw_dist(from.pose.p, to.pose.p) + reach * sw_norm(sw_quat_log(turned));
    if (!(shift > most)) break;
    *h *= fmax(0.5, 0.95 * most / shift);
  }
  return SW_OK;
}

sw_status sw_scene_cut_pose(sw_scene *s, double *t1, int *cut, sw_error *err) {
  const double whole = *t1 - sw_scene_time(s);
  double radius = HUGE_VAL, h = whole;
  SW_EACH(wire, wire, s) radius = fmin(radius, wire->beam.radius);
  SW_EACH(tool, t, s)
    if (t->alive && !t->frozen && t->jaw.now > 0)
      SW_TRY(carried_step(s, t, WIDEST_SHIFT * radius, &h, err));
  h = sw_jaw_step(s, h);
  *cut = h < whole * (1 - 1e-9);
  if (*cut) *t1 = sw_scene_time(s) + h;
  return SW_OK;
}

sw_status sw_scene_pose(sw_scene *s, double t1, const sw_pose_args *how, sw_run_report *report,
                        sw_error *err) {
  const sw_status status = pose(s, t1, MOST_HALVINGS, how, report, err);
  SW_EACH(tool, t, s)
    if (status != SW_OK) t->way = t->swing = sw_v(0, 0, 0), t->searched = 0;
  return status;
}
