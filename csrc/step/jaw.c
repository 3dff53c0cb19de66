/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Jaws of tools in a step, or from one pose to the next. The opening changes evenly within a step.
 * If the jaws have to reach a force, or not to exceed it, the closing speed is searched for with
 * which the fingers have this force at the end of the step: between a speed with too little force
 * and one with too much. */
#include "step/jaw.h"

#include <math.h>

#include "grip/jaws.h"
#include "scene/gripper.h"
#include "scene/parts.h"
#include "scene/wire.h"
#include "step/obey.h"

static const double PRECISION = 1e-3; /* of the wanted force [-] */
/* The same in scene:settle, where jaws must not move when the search is repeated: with PRECISION
 * they moved by another 12 nm (spec/physics/gripper_still_spec) [-]. */
static const double EXACT = 1e-5;
static const double ROUGHLY = 0.015; /* the same in the step that first reaches the force [-] */
static const double REACHED = 0.02;  /* the force counts as reached from this share below it [-] */
enum { MOST_TRIALS = 10 };           /* the last one is taken with the force that it has [-] */
enum { MOST_FIRST = 20 };            /* the same until the first touch gives a force [-] */
enum { MOST_RESTS = 12 };            /* the same for equilibria [-] */
static const double SAME_OPENING = 1e-9; /* at a step's end [m] */
static const double TELLS = 1e-7;        /* closer openings give no stiffness [m] */
enum {
  BEFORE_JUMPS = 4
}; /* after this many trials the bracket may contain a jump of the force [-] */
static const double BEYOND = 1.3; /* a guess goes this times as far as the slope predicts [-] */
static const double WIDER = 4.0;  /* further factor after each trial that was too short [-] */

/* 1 if this step may end with a force other than that of its first guess. */
static int yields(const sw_jaw *j) {
  if (j->mode == SW_JAW_STILL || !(j->force < HUGE_VAL)) return 0;
  return j->mode == SW_JAW_FORCE || j->goal < j->opening;
}

/* Returns the speed at which this step ends with the opening, within the allowed speeds. */
static double speed_to(const sw_jaw *j, double opening) {
  return fmax(-j->most, fmin(j->most, (opening - j->opening) / j->step));
}

/* Returns the first speed to try: with a force, the one that leads to the opening predicted by the
 * last stiffness. */
static double first_guess(const sw_jaw *j) {
  if (j->mode == SW_JAW_STILL) return 0;
  if (j->mode == SW_JAW_TO) return speed_to(j, j->goal);
  if (!(j->now > 0) || !(j->stiffness > 0)) return j->now > j->force ? 0.0 : speed_to(j, 0);
  return speed_to(j, fmax(0.0, j->opening + (j->now - j->force) / j->stiffness));
}

static int works(const sw_tool *t) { return t->alive && !t->frozen; }

/* 1 if the speed in this step depends on the force. */
static int obeys(const sw_tool *t) { return works(t) && t->jaw.step > 0 && yields(&t->jaw); }

static void begin(sw_jaw *j, double since, double step) {
  j->since = since;
  j->step = step;
  j->speed = step > 0 ? first_guess(j) : 0.0;
  sw_bracket_clear(&j->found);
  j->trials = 0;
  j->guessed = j->now < j->force; /* guess: if nothing moves, the force stays too small */
  if (j->guessed) sw_bracket_add(&j->found, 0, j->now - j->force);
}

int sw_jaw_begin(sw_scene *s, double h) {
  int any = 0;
  SW_EACH(tool, t, s) {
    begin(&t->jaw, sw_scene_time(s), works(t) ? h : 0.0);
    any |= works(t) && yields(&t->jaw);
  }
  return any;
}

/* From one equilibrium to the next, jaws close by at most WIDEST_STEP of the thinnest wire's
 * radius, or of its squeezed height. After larger closings the solver does not converge [-]. */
static const double WIDEST_STEP = 0.25, LEFT = 0.25, LEAST = 0.05;

/* Pads that squeeze a section hold parts of its surface while it widens. Which parts slide and
 * which stick depends on the path of the force. So the force grows by at most GAINS of the wanted
 * one from pose to pose. In a single pose the push on a table under the wire was 1.0 to 2.1 N; with
 * GAINS of 0.2 and 0.1 it is 2.1 N within 4 %, as in slow motion
 * (spec/contact/squeezed_poses_spec). FIRST: smallest force of the first touch that counts, over
 * the wanted one [-]. */
static const double GAINS = 0.2, FIRST = 1e-3;

/* 1 if there is a mesh of solid elements, whose section deforms. */
static int has_sections(const sw_scene *s) {
  const sw_system *system = sw_scene_system(s);
  for (size_t b = 0; b < system->body_count; b++)
    if (system->bodies[b].plan->web && system->bodies[b].plan->web->per_ring &&
        system->bodies[b].plan->web->solid_rate2 > 0)
      return 1;
  return 0;
}

/* 1 if these fingers shift a wire to their centre. Those that touch it first push it there with
 * little force, then all press it. In a pose that contains both, friction of the last ones would
 * hold it off the centre, by up to the depth of touches: four round fingers of 5 N pressed with 2.6
 * to 7.6 N. So their force at most doubles from pose to pose, from FIRST on. Two pads that face
 * each other press with the same force wherever the wire is (spec/physics/fingers_poses_spec). */
static int shift_wires(const sw_tool *t) { return t->fingers > 2; }

/* 1 if the result depends on the path on which these jaws reach their force. */
static int way_matters(const sw_scene *s, const sw_tool *t) {
  return t->pads && t->jaw.force < HUGE_VAL && t->jaw.status != SW_JAW_HOLDS &&
         (shift_wires(t) || has_sections(s));
}

/* Returns the force that jaws may gain in a pose that they begin with the force `now` [N]. */
static double allowed_gain(const sw_tool *t, double now) {
  const double force = t->jaw.force;
  if (!(now > 0)) return FIRST * force;
  return shift_wires(t) ? fmax(FIRST * force, fmin(GAINS * force, now)) : GAINS * force;
}

/* Returns the time of the longest allowed closing at the highest speed [s]. */
static double longest_step(const sw_scene *s, const sw_tool *t) {
  const sw_jaw *j = &t->jaw;
  double radius = HUGE_VAL;
  SW_EACH(wire, wire, s) radius = fmin(radius, wire->beam.radius);
  const double width = fmax(LEAST * radius, fmin(radius, LEFT * j->opening));
  double way = WIDEST_STEP * width;
  if (way_matters(s, t) && has_sections(s) && j->now > 0 && j->stiffness > 0)
    way = fmin(way, fmax(TELLS, GAINS * j->force / j->stiffness));
  return way / j->most;
}

double sw_jaw_step(const sw_scene *s, double h) {
  SW_EACH(tool, t, s) {
    const sw_jaw *j = &t->jaw;
    if (works(t) && yields(j) && j->status != SW_JAW_HOLDS && j->most > 0)
      h = fmin(h, longest_step(s, t));
  }
  return h;
}

int sw_jaw_ways_matter(const sw_scene *s) {
  SW_EACH(tool, t, s)
    if (works(t) && yields(&t->jaw) && way_matters(s, t)) return 1;
  return 0;
}

double sw_jaw_part(sw_scene *s, const sw_jaw *before, double h) {
  const double t1 = sw_scene_time(s);
  double part = h;
  for (size_t k = 0; k < sw_scene_tool_slots(s); k++) {
    const sw_tool *t = sw_scene_tool_in(s, k);
    const double way = before[k].opening - sw_jaw_at(&t->jaw, t1);
    if (!obeys(t) || !way_matters(s, t) || !(way > TELLS)) continue;
    if (sw_tool_squeeze(s, t, t1) - before[k].now > allowed_gain(t, before[k].now))
      part = fmin(part, fmax(TELLS, 0.5 * way) / t->jaw.most);
  }
  return part;
}

int sw_jaw_begin_rest(sw_scene *s) {
  int any = 0;
  SW_EACH(tool, t, s) {
    sw_jaw *j = &t->jaw;
    const int obeys = works(t) && yields(j) && j->status == SW_JAW_HOLDS && j->most > 0;
    const double step = obeys ? longest_step(s, t) : 0.0;
    begin(j, sw_scene_time(s) - step, step);
    any |= obeys;
  }
  return any;
}

int sw_jaw_end_rest(sw_scene *s, int went_well) {
  int more = 0;
  SW_EACH(tool, t, s) {
    sw_jaw *j = &t->jaw;
    if (!(j->step > 0)) continue;
    more |= fabs(j->speed) >= j->most && went_well;
    if (!went_well) j->since = sw_scene_time(s);
  }
  return more;
}

/* Returns a speed beyond the last one, in the direction that corrects its deviation `off`. */
static double guess_beyond(const sw_jaw *j, double off) {
  if (!(j->stiffness > 0)) return off > 0 ? j->most : speed_to(j, 0);
  const double way = BEYOND * pow(WIDER, j->trials - 1) * off / j->stiffness;
  return speed_to(j, fmax(0.0, j->opening + j->speed * j->step + way));
}

/* 1 if the jaws can go no further in the direction that corrects the force. */
static int go_beyond(sw_jaw *j, double off) {
  const double before = j->speed;
  j->speed = guess_beyond(j, off);
  return j->speed == before;
}

/* Sets the next speed to try. Returns 1 if the bracket has shrunk to one place: the force jumps
 * there. */
static int improve(sw_jaw *j, double off, int rests) {
  sw_bracket *b = &j->found;
  sw_bracket_mend(b, 1, j->speed, off);
  if (j->guessed && off > 0 && j->trials > 2) b->off[0] = NAN; /* the guess was wrong */
  if (!(off > 0) || j->trials > 2) j->guessed = 0;
  const int side = sw_bracket_add(b, j->speed, off);
  if (!sw_bracket_closed(b)) return go_beyond(j, off);
  const double gap = -sw_bracket_width(b);
  if (j->guessed && gap * j->step < TELLS) {
    b->off[0] = NAN, j->guessed = 0; /* the bracket is wrong, because a wire moves */
    return go_beyond(j, off);
  }
  if (gap * j->step < (rests == SW_JAW_POSES ? TELLS : SAME_OPENING)) return 1;
  const int tells = gap * j->step > TELLS && (!rests || j->trials <= BEFORE_JUMPS);
  if (j->trials > 1 && tells) j->stiffness = (b->off[1] - b->off[0]) / (gap * j->step);
  sw_bracket_weigh(b, side);
  j->speed = sw_bracket_root(b);
  return 0;
}

/* Takes the last trial. Where the force jumps past the wanted one, takes the side with too much
 * force: from there the jaws can come back. */
static int give_up(sw_jaw *j, double off, int rests) {
  if (!rests || off > 0 || !isfinite(j->found.off[1]) || j->trials > MOST_RESTS) return 1;
  j->speed = j->found.tried[1];
  j->trials = MOST_RESTS;
  return 0;
}

/* Returns the largest number of trials. The first force takes longer to find, because openings
 * without a touch do not show the distance to it. */
static int most_trials(const sw_jaw *j, int rests) {
  if (rests) return MOST_RESTS;
  return j->status == SW_JAW_HOLDS ? MOST_TRIALS : MOST_FIRST;
}

/* 1 if the trial's force is as wanted, or cannot be corrected in this step. */
static int correct(sw_scene *s, sw_tool *t, int rests) {
  sw_jaw *j = &t->jaw;
  const double off = sw_tool_squeeze(s, t, j->since + j->step) - j->force;
  const double usual = rests || j->status == SW_JAW_HOLDS ? PRECISION : ROUGHLY;
  const double allowed = rests == SW_JAW_SETTLES ? EXACT : usual;
  if (fabs(off) <= allowed * j->force) return 1;
  if (++j->trials >= most_trials(j, rests)) return give_up(j, off, rests);
  const int approaches = j->status != SW_JAW_HOLDS && j->trials == 1;
  if (off < 0 && (approaches || j->speed <= speed_to(j, 0))) return 1;
  if (off > 0 && j->speed >= j->most) return 1;
  return improve(j, off, rests) && give_up(j, off, rests);
}

int sw_jaw_correct(sw_scene *s, int rests) {
  int good = 1;
  SW_EACH(tool, t, s)
    if (obeys(t)) good &= correct(s, t, rests);
  return good;
}

double sw_jaw_off(sw_scene *s) {
  double most = 0;
  SW_EACH(tool, t, s) {
    const sw_jaw *j = &t->jaw;
    if (!obeys(t)) continue;
    const double force = sw_tool_squeeze(s, t, j->since + j->step);
    most = fmax(most, fabs(force / j->force - 1.0));
  }
  return most;
}

/* Returns for how long the jaws could still move in this step [s]. */
static double time_left(const sw_jaw *j) {
  const double left = j->step * (1.0 - fabs(j->speed) / j->most);
  return left * j->most > SAME_OPENING ? left : 0.0;
}

static int looks_on(sw_scene *s, const sw_tool *t) {
  const sw_jaw *j = &t->jaw;
  if (!obeys(t) || j->mode != SW_JAW_FORCE || !(time_left(j) > 0)) return 0;
  const double off = sw_tool_squeeze(s, t, sw_scene_time(s)) - j->force;
  return fabs(off) > PRECISION * j->force && (off > 0 || sw_jaw_at(j, sw_scene_time(s)) > 0);
}

int sw_jaw_again(sw_scene *s) {
  int again = 0;
  SW_EACH(tool, t, s) again |= looks_on(s, t);
  for (size_t k = 0; again && k < sw_scene_tool_slots(s); k++) {
    sw_tool *t = sw_scene_tool_in(s, k);
    sw_jaw *j = &t->jaw;
    const double left = obeys(t) && j->mode == SW_JAW_FORCE ? time_left(j) : 0.0;
    if (!works(t)) continue;
    j->now = sw_tool_squeeze(s, t, sw_scene_time(s));
    j->opening = fmax(0.0, sw_jaw_at(j, sw_scene_time(s)));
    begin(j, sw_scene_time(s) - left, left);
  }
  return again;
}

/* Sets the status: whether the jaws have reached their target. */
static void judge(sw_jaw *j) {
  const int reached = j->now >= (1.0 - REACHED) * j->force;
  if (j->mode == SW_JAW_FORCE) {
    if (reached)
      j->status = SW_JAW_HOLDS;
    else if (j->opening <= 0)
      j->status = SW_JAW_EMPTY;
    else if (!(j->now > 0))
      j->status = SW_JAW_MOVES; /* the held wire is gone */
  }
  if (j->mode != SW_JAW_TO) return;
  if (reached && j->goal < j->opening)
    j->status = SW_JAW_STOPPED;
  else if (j->opening == j->goal)
    j->status = SW_JAW_RESTS;
  if (j->status != SW_JAW_MOVES) j->mode = SW_JAW_STILL;
}

/* Smaller changes of the force, over the wanted one, give no stiffness [-]. */
static const double TELLING = 0.05;

/* While jaws approach, a stiffness of a blow, or of wires that lay askew, may be far too large:
 * each guess then goes too short a way, which tells nothing about the stiffness. If a way gives
 * less than this share of the force that it promised, the stiffness is lowered by the same share
 * [-]. */
static const double SHORT = 0.25;

/* 1 if the last way gave far less force than the stiffness promised. */
static int fell_short(const sw_jaw *j, double way, double gain) {
  const double promised = j->stiffness * way;
  return j->status == SW_JAW_MOVES && way > SAME_OPENING && promised > TELLING * j->force &&
         gain < SHORT * promised;
}

static void follow(sw_scene *s, sw_tool *t) {
  sw_jaw *j = &t->jaw;
  const double before = j->opening, force = j->now;
  const double end = sw_jaw_at(j, sw_scene_time(s));
  const int there = j->mode == SW_JAW_TO && fabs(end - j->goal) < SAME_OPENING;
  j->opening = there ? j->goal : fmax(0.0, end);
  j->since = sw_scene_time(s);
  j->now = sw_tool_squeeze(s, t, sw_scene_time(s));
  const double k = (j->now - force) / (before - j->opening);
  const int tells =
      force > 0 && fabs(j->now - force) > TELLING * j->force && fabs(before - j->opening) > TELLS;
  if (tells && k > 0 && k < HUGE_VAL)
    j->stiffness = k;
  else if (force > 0 && fell_short(j, before - j->opening, j->now - force))
    j->stiffness *= SHORT;
  if (j->mode == SW_JAW_STILL) j->speed = 0;
  judge(j);
}

void sw_jaw_follow(sw_scene *s) {
  SW_EACH(tool, t, s)
    if (t->alive && t->frozen)
      t->jaw.since = sw_scene_time(s);
    else if (t->alive)
      follow(s, t);
}

size_t sw_jaw_moving(const sw_scene *s) {
  size_t moving = 0;
  SW_EACH(tool, t, s) moving += works(t) && t->pads && t->jaw.status == SW_JAW_MOVES;
  return moving;
}

/* Pads that are turned against a wire bend it while they close, and it slides between them until
 * friction locks. The distance it slid decides which force along the wire is locked in: 1 um of a
 * stiff cable is 0.1 N. In a step in which the pads' force grows from little to the wanted one
 * nothing slides. So above the share TOUCHED of the wanted force, jaws close by at most CLOSES per
 * part; this is the depth of a line's samples at the wanted force [-], [m]. Of 192 random peaks at
 * 2 to 20 ms, 43 are off by more than 15 % without this limit, 14 with it
 * (spec/physics/pads_turned_spec). */
static const double TOUCHED = 0.02, CLOSES = 5e-6;

double sw_jaw_closes(sw_scene *s, double h) {
  double most = 0;
  SW_EACH(tool, t, s) {
    const sw_jaw *j = &t->jaw;
    if (!obeys(t) || !t->pads || j->status == SW_JAW_HOLDS || !(j->speed < 0)) continue;
    if (sw_tool_squeeze(s, t, j->since + h) > TOUCHED * j->force)
      most = fmax(most, -j->speed * h / CLOSES);
  }
  return most;
}

/* --- the rung --------------------------------------------------------------------- */

static int correct_step(sw_scene *s, double h, int first) {
  (void)h, (void)first;
  return sw_jaw_correct(s, 0);
}

static const sw_obeyer JAWS = {.begin = sw_jaw_begin, .correct = correct_step};

sw_status sw_rung_squeeze(sw_ladder *p, const sw_rung *below, double h, sw_error *err) {
  return sw_obey(p, below, h, &JAWS, err);
}
