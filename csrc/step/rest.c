/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria at the scene's time. Holds move in parts (substeps) from their poses in the wires'
 * last state to those at the scene's time. The wires come to rest after each part. */
#include "step/rest.h"

#include <math.h>
#include <string.h>

#include "base/alloc.h"
#include "body/hold.h"
#include "body/live.h"
#include "body/touching.h"
#include "mutual/mutual.h"
#include "scene/course.h"
#include "scene/drive.h"
#include "scene/gripper.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "step/statics.h"
#include "system/system.h"

/* Continuation starts after this many Newton updates that would move wires far. Wires with friction
 * follow their holds to the next pose without moving far, or they jump; continuation finds a jump
 * sooner than many more updates [-]. */
enum { FAR_IN_POSES = 6 };
/* Largest parts of a hold's path from its old place to its new one. */
static const double LONGEST_PART = 0.4; /* of the shortest edge [-] */
static const double LONG_PART = 0.1;    /* of the longest wire, where there is no friction [-] */
static const double WIDEST_PART = 0.5;  /* [rad] */
static const double MOST_PARTS = 2000;
/* Where lines have slid on obstacles, a part without a direct equilibrium is divided, down to
 * 1/MOST_DIVIDED of it. Continuation lets the wires swing into place, and friction then keeps what
 * it had in the swing: a cable drawn through a channel had 12 % less pull in poses of 3.5 mm
 * (spec/contact/channel_poses_spec). Shifts below SLID of an edge are no sliding. A wire that
 * sticks must not be divided: the tip of a wire that buckles against a floor would slip while it
 * should stick (spec/physics/pushed_tip_spec). A feed goes at once, not in parts: its pose is
 * halved instead [-]. */
enum { MOST_DIVIDED = 8 };
static const double SLID = 1e-4;
/* Accuracy of the equilibria before the last part: largest shift of a node, over an edge [-]. */
static const double PASSING = 1e-4;

/* Finds the poses of the holds in the wires' last state. A place on a rail has moved along it, so
 * it does not tell where the rail was. */
static sw_status find_from_poses(sw_statics *p, sw_error *err) {
  const sw_system *s = sw_scene_system(p->s);
  for (size_t i = s->held_count; i-- > 0;) {
    const sw_held_node *h = &s->held[i];
    if (h->rail) {
      sw_motion_state at;
      SW_TRY(sw_drive_eval(p->s, &sw_scene_held_by(p->s, (size_t)h->hold)->drive, p->touched, &at,
                           err));
      p->from_poses[h->hold] = at.pose;
      continue;
    }
    const double *q = s->turn + 4 * h->hold;
    const sw_quat turn = {q[0], q[1], q[2], q[3]};
    p->from_poses[h->hold] =
        (sw_pose){sw_sub(sw_vec_at(s->x, h->node), sw_rotate(turn, h->local)), turn};
  }
  return SW_OK;
}

static double shortest_edge(const sw_system *s) {
  double shortest = HUGE_VAL;
  for (size_t b = 0; b < s->body_count; b++)
    shortest = fmin(shortest, sw_plan_spacing(s->bodies[b].plan));
  return shortest;
}

/* Returns the largest distance of a mesh's particles from the axis about which a hold turns them
 * [m]. */
static double widest_mesh(const sw_system *s) {
  double widest = 0;
  for (size_t b = 0; b < s->body_count; b++)
    widest = fmax(widest, sw_plan_lever(s->bodies[b].plan));
  return widest;
}

/* Returns the shift of hold k at this distance from its axis [m]; *turn: its turn [rad]. */
static double hold_shift(const sw_statics *p, size_t k, double lever, double *turn) {
  const sw_pose *from = &p->from_poses[k], *to = &sw_scene_system(p->s)->hold_states[k].pose;
  *turn = sw_norm(sw_quat_log(sw_quat_mul(to->q, sw_quat_conj(from->q))));
  return sw_dist(from->p, to->p) + lever * *turn;
}

/* Returns the number of parts of the holds' path, such that no part shifts a hold by more than
 * longest_shift [m] or turns it too far. Points at the distance `lever` from a hold must not shift
 * by more either [m]. */
static sw_status count_parts(sw_statics *p, double lever, double longest_shift, size_t *parts,
                             sw_error *err) {
  sw_system *s = sw_scene_system(p->s);
  double most = 0;
  SW_TRY(
      sw_system_place_holds(s, sw_scene_time(p->s), NULL, NULL, NULL, err)); /* feeds move nodes */
  for (size_t k = 0; k < s->hold_count; k++) {
    double turn;
    const double shift = hold_shift(p, k, lever, &turn) / longest_shift;
    most = fmax(most, fmax(shift, turn / WIDEST_PART));
  }
  *parts = most <= 1 ? 1 : (size_t)fmin(ceil(most), MOST_PARTS);
  return SW_OK;
}

/* 1 if a place of a wire slid along an obstacle since it began to press on it. The touches
 * themselves are unknown where a feed has just made a node. */
static int has_slid(const sw_statics *p) {
  const sw_contact *contact = sw_scene_contact(p->s);
  return contact && sw_contact_slid(contact) > SLID * p->edge;
}

/* Returns the holds' largest shift; a turn counts as the shift of half a wire by it [m]. */
double sw_rest_driven(const sw_statics *p) {
  double largest = 0, turn;
  for (size_t k = 0; k < sw_scene_system(p->s)->hold_count; k++)
    largest = fmax(largest, hold_shift(p, k, 0.5 * sw_rest_longest(p->s), &turn));
  return largest;
}

static int rubs(const sw_mutual *m) { return m && sw_mutual_rubs(m); }
static int drags(const sw_mutual *m) { return m && sw_mutual_drags(m); }

/* Returns the longest way of fed wire since the state [m]. */
static double fed(const sw_statics *p) {
  double most = 0;
  SW_EACH(hold, h, p->s) {
    if (!h->alive || !sw_hold_passes(h)) continue;
    const double before = sw_hold_way_of(p->s, h, p->touched, NULL).way;
    most = fmax(most, fabs(sw_hold_way_of(p->s, h, sw_scene_time(p->s), NULL).way - before));
  }
  return most;
}

/* 1 if a hold, feed or jaw may move a wire in this pose. */
static int is_driven(const sw_statics *p) {
  SW_EACH(hold, h, p->s)
    if (h->alive && sw_hold_passes(h)) return 1;
  SW_EACH(tool, t, p->s)
    if (t->alive && t->pads) return 1;
  return sw_rest_driven(p) > 0;
}

/* Wires that move much further than their holds and obstacles have jumped to another
 * equilibrium. */
static const double JUMP = 4.0;           /* largest shift over that of holds and obstacles [-] */
static const double SMALLEST_JUMP = 0.01; /* of the longest wire [-] */

/* Finds the equilibrium after a part of the holds' path. Continuation, if it was needed, tells
 * there whether a wire that rubs on something snapped: in a pose of several parts the holds may
 * then have moved as far as the wire. */
static sw_status find_part(sw_statics *p, sw_error *err) {
  const int transient = p->report->transient;
  p->report->transient = 0;
  const sw_status status = sw_rest_find(p, err);
  p->leapt |=
      status == SW_OK && p->report->transient && p->slides && p->rests &&
      sw_rest_shift_from(p, p->kept) > fmax(SMALLEST_JUMP * sw_rest_longest(p->s), JUMP * p->drawn);
  p->report->transient |= transient;
  return status;
}

static sw_status follow_in(sw_statics *p, size_t parts, sw_error *err) {
  sw_status status = SW_OK;
  const size_t most = MOST_DIVIDED * parts;
  const int drawn = p->rubs || p->slides;
  const double way = drawn ? sw_rest_driven(p) : 0, fed_way = drawn ? fed(p) : 0;
  p->report->rubbed = 0, p->divides = 0, p->leapt = 0;
  p->left_alone = !is_driven(p);
  for (size_t i = 1; status == SW_OK && i <= parts; i++) {
    sw_scene_go_part(p->s, i < parts ? p->from_poses : NULL, (double)i / (double)parts);
    p->passing = i < parts || p->args->passing ? PASSING : 0.0;
    p->before = p->report->iterations;
    p->drawn = fmax(way / (double)parts, fed_way);
    p->leads = p->rubs ? p->drawn : 0;
    const int slid = p->divides ? p->may_divide : has_slid(p);
    p->may_divide = p->slides && slid && parts < most && (p->too_far || !(p->fed > 0));
    p->divides = 0;
    status = find_part(p, err);
    if (p->divides) {
      status = SW_OK, i = 2 * (i - 1), parts *= 2;
      continue;
    }
    if (status == SW_OK && i < parts) p->report->rubbed += sw_scene_rubbed(p->s);
    if (status == SW_OK && p->interrupted && p->interrupted()) status = SW_EINTR;
  }
  sw_scene_go_part(p->s, NULL, 1);
  p->passing = 0;
  return status;
}

/* 1 if something may rub on the wires. */
static int has_friction(const sw_scene *s) {
  if (sw_scene_pairs(s) || sw_scene_crowd(s) || sw_scene_grains(s)) return 1;
  SW_EACH(obstacle, obstacle, s)
    if (obstacle->alive && fmax(obstacle->friction, obstacle->kinetic) > 0) return 1;
  return 0;
}

static int has_meshes(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  for (size_t b = 0; b < system->body_count; b++)
    if (system->bodies[b].plan->web) return 1;
  return 0;
}

/* 1 if the equilibrium does not depend on the history of the wires. */
static int forgets(const sw_scene *s) { return !has_friction(s) && !has_meshes(s); }

/* 1 if an obstacle that moves by itself may take wires along. In a part of a pose only the holds
 * are on their way, and such an obstacle is at its end: a wire that is wound on a drum slid on it,
 * and had up to 2.5 times the pull of its brake (spec/contact/wound_poses_spec). */
static int takes_along(const sw_scene *s) {
  SW_EACH(obstacle, o, s) {
    const int goes = o->alive && !o->off && !o->drive.tool && fmax(o->friction, o->kinetic) > 0;
    if (goes && !sw_drive_stands(&o->drive, sw_scene_time(s))) return 1;
  }
  return 0;
}

sw_status sw_scene_cut_rubbing(sw_scene *s, double *h, sw_error *err) {
  const sw_system *system = sw_scene_system(s);
  const double now = sw_scene_time(s), edge = LONGEST_PART * shortest_edge(system);
  size_t parts = 1;
  if (!(sw_scene_wears(s) || takes_along(s)) || !has_friction(s) || !system->hold_count)
    return SW_OK;
  sw_pose *poses SW_LOCAL = sw_alloc(system->hold_count, sizeof *poses);
  if (!poses) return sw_fail(err, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  sw_statics p = {.s = s, .from_poses = poses, .touched = now};
  SW_TRY(find_from_poses(&p, err));
  sw_scene_set_time(s, now + *h);
  const sw_status status = count_parts(&p, 0.0, edge, &parts, err);
  sw_scene_set_time(s, now);
  if (status == SW_OK) *h /= (double)parts;
  return status;
}

/* Follows the holds in parts whose number does not depend on the mesh, as long as each part leads
 * from one stable equilibrium directly to the next. *done: 1 if all did; else the state is as
 * before. */
static sw_status follow_fast(sw_statics *p, size_t parts, int *done, sw_error *err) {
  sw_tape start = {0};
  const double touched = p->touched;
  sw_error why = {"out of memory"};
  sw_status status = sw_live_take(p->s, &start);
  *done = 0;
  for (size_t i = 1; status == SW_OK && i <= parts; i++) {
    sw_scene_go_part(p->s, i < parts ? p->from_poses : NULL, (double)i / (double)parts);
    status = sw_rest_newton(p, SW_REST_ITERATIONS, &why);
    if (status == SW_OK && p->report->negative > 0) status = SW_ENOCONV;
    if (status == SW_OK && p->interrupted && p->interrupted()) status = SW_EINTR;
  }
  sw_scene_go_part(p->s, NULL, 1);
  *done = status == SW_OK;
  if (sw_rest_stops(status)) sw_fail(err, status, "%s", why.text);
  if (!*done && !sw_rest_stops(status)) {
    p->touched = touched;
    status = sw_live_back(p->s, &start, err);
  }
  sw_tape_free(&start);
  return status;
}

/* Wires that move further than this beyond their holds fall without limit. Where rounding is as
 * large as their steps they seem to rest [of the longest wire]. */
static const double FALLEN = 1e3;

/* Settles after every part of the holds' path. The parts only help convergence: the memory of
 * forces is updated after the last part only. If particles of a mesh are further from the axis than
 * its slices from each other, the usual parts may be too long. */
static sw_status follow_holds(sw_statics *p, sw_error *err) {
  size_t parts, more, fewer;
  int done = 0;
  p->edge = shortest_edge(sw_scene_system(p->s));
  const double edge = LONGEST_PART * p->edge;
  SW_TRY(count_parts(p, 0.0, edge, &parts, err));
  p->fall = FALLEN * sw_rest_longest(p->s) + sw_rest_driven(p);
  const int poses = p->touched != sw_scene_time(p->s);
  p->rubs = rubs(sw_scene_pairs(p->s)) || rubs(sw_scene_grains(p->s));
  p->fed = drags(sw_scene_pairs(p->s)) || drags(sw_scene_grains(p->s)) ? 0.0 : fed(p);
  if (poses && !forgets(p->s) && (sw_rest_driven(p) > 0 || p->fed > 0)) p->most_far = FAR_IN_POSES;
  p->slides = p->most_far > 0 && !has_meshes(p->s);
  SW_TRY(count_parts(p, 0.0, fmax(edge, LONG_PART * sw_rest_longest(p->s)), &fewer, err));
  if (fewer < parts && forgets(p->s)) SW_TRY(follow_fast(p, fewer, &done, err));
  if (done) return SW_OK;
  const sw_status status = follow_in(p, parts, err);
  if (status != SW_ENOCONV) return status;
  SW_TRY(count_parts(p, widest_mesh(sw_scene_system(p->s)), edge, &more, err));
  if (more <= parts) return status;
  sw_rest_take_back(p->s, p->begun);
  return follow_in(p, more, err);
}

sw_status sw_scene_rest(sw_scene *s, double since, int *too_far, const sw_settle_args *args,
                        int (*interrupted)(void), sw_settle_report *report, sw_error *why) {
  sw_system *system = sw_scene_system(s);
  const size_t n = system->freedoms, size = sw_rest_room(s);
  double *block SW_LOCAL = sw_alloc(5 * n + system->edges + 2 * size, sizeof *block);
  sw_pose *poses SW_LOCAL = sw_alloc(system->hold_count, sizeof *poses);
  if (!block || !poses)
    return sw_fail(why, SW_ENOMEM, "scene '%s': out of memory", sw_scene_name(s));
  sw_statics p = {.s = s,
                  .rests = sw_course_rests(sw_scene_course(s)),
                  .args = args,
                  .report = report,
                  .interrupted = interrupted,
                  .touched = since,
                  .too_far = too_far};
  p.zero = block, p.from = block + n, p.y = block + 2 * n, p.v = block + 3 * n;
  p.way = block + 4 * n, p.tension = block + 5 * n;
  p.kept = p.tension + system->edges, p.begun = p.kept + size;
  p.from_poses = poses;
  SW_TRY(find_from_poses(&p, why));
  sw_rest_put_aside(s, p.begun);
  system->still = 1;
  if (args->relaxes && sw_rest_relax(&p, why) == SW_OK) sw_rest_put_aside(s, p.begun);
  sw_status status = follow_holds(&p, why);
  system->still = 0;
  const double shift = sw_rest_shift_from(&p, p.begun);
  if (status == SW_OK && sw_rest_falls(&p)) status = sw_rest_fail_fall(&p, why);
  if (status == SW_OK && args->farthest > 0 && shift > args->farthest)
    status = sw_fail(why, SW_ENOCONV, "the next equilibrium is %.3g m away", shift);
  if (status == SW_OK) {
    report->far = shift > SMALLEST_JUMP * sw_rest_longest(s);
    report->jumped =
        p.leapt || (report->transient && report->far && shift > JUMP * sw_rest_driven(&p));
  } else if (status != SW_EINTR) {
    sw_rest_take_back(s, p.begun);
  }
  if (status == SW_OK || (p.rests && status != SW_EINTR))
    sw_course_rest(sw_scene_course(s));
  else
    sw_course_jump(sw_scene_course(s));
  return status;
}

/* A smaller change of a lagging force, over its limit, no longer counts [-]. */
static const double CAUGHT_UP = 1e-5;

int sw_rest_catch_up(sw_scene *s, int guesses) {
  sw_system *system = sw_scene_system(s);
  double most = 0;
  sw_system_refresh(system);
  SW_ITEMS(sw_body, b, system->bodies, system->body_count) {
    SW_ITEMS(const sw_term, term, b->terms, b->term_count) {
      if (term->cls->catch_up)
        most = fmax(most, term->cls->catch_up(term->args, &b->field, guesses, term->history));
    }
  }
  return most > CAUGHT_UP;
}

/* Largest shift into an equilibrium found by continuation, over the thinnest wire's radius. A soft
 * wire in narrow pads shifted by 0.2 and 0.3 radii [-]. */
static const double FARTHEST = 0.5;

/* Returns the smallest radius of a wire [m]. */
static double thinnest(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  double radius = HUGE_VAL;
  SW_ITEMS(const sw_body, b, system->bodies, system->body_count)
    radius = fmin(radius, b->plan->beam.radius);
  return radius;
}

sw_status sw_scene_balance(sw_scene *s, double tolerance, long most, sw_error *err) {
  sw_settle_args args = {.tolerance = tolerance, .max_iterations = most, .stays = 1, .relaxes = 1};
  sw_settle_report report = {0}, farther = {0};
  int too_far = 0;
  sw_error why = {""};
  const double now = sw_scene_time(s);
  const sw_status status = sw_scene_rest(s, now, &too_far, &args, NULL, &report, err);
  if (status != SW_ENOCONV) return status;
  /* The grip is softer now than when it was frozen: the wire is a few tenths of its radius from its
   * equilibrium. */
  args.stays = 0, args.farthest = FARTHEST * thinnest(s);
  sw_tape before = {0};
  sw_status again = sw_live_take(s, &before);
  if (again == SW_OK) again = sw_scene_rest(s, now, &too_far, &args, NULL, &farther, &why);
  const int over = again == SW_OK || sw_rest_stops(again);
  const sw_status back = over ? SW_OK : sw_live_back(s, &before, &why);
  sw_tape_free(&before);
  if (over || back != SW_OK) *err = why;
  if (over) return again;
  if (back != SW_OK) return back;
  return report.relaxed ? SW_OK : status;
}
