/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes and reads the objects of a scene, field by field. */
#include <string.h>

#include "body/obstacle_log.h"
#include "body/touching.h"
#include "edit/edit.h"
#include "link/joint.h"
#include "read/frames.h"
#include "read/kept_frames.h"
#include "record/spun.h"
#include "record/wear.h"
#include "record/zone.h"
#include "save/save.h"
#include "scene/drive.h"
#include "scene/forces.h"
#include "scene/obstacle.h"
#include "scene/parts.h"
#include "scene/values.h"
#include "scene/wire.h"
#include "state/state_tape.h"

#define DOUBLE(field) sw_tape_double(t, &x->field)
#define INT(field) sw_tape_int(t, &x->field)
#define SIZE(field) sw_tape_size(t, &x->field)
#define UINT32(field) sw_tape_uint32(t, &x->field)
#define VEC(field) sw_tape_vec(t, &x->field)
#define QUAT(field) sw_tape_quat(t, &x->field)
#define POSE(field) sw_tape_pose(t, &x->field)
#define NAME(field) sw_tape_name(t, x->field)

void sw_tape_extreme(sw_tape *t, sw_extreme *x) {
  SW_TAPE_STRUCT(t, sw_extreme, 24);
  DOUBLE(value), DOUBLE(s), DOUBLE(time);
}

/* --- wires ------------------------------------------------------------------------- */

static void tape_sharpness(sw_tape *t, sw_sharpness *x) {
  SW_TAPE_STRUCT(t, sw_sharpness, 40);
  DOUBLE(uneven), DOUBLE(swings), DOUBLE(more), DOUBLE(less), DOUBLE(round);
  const double all[] = {x->uneven, x->swings, x->more, x->less, x->round};
  for (int k = 0; k < 5; k++)
    sw_tape_expect(t, all[k] >= 0 && isfinite(all[k]), "how sharp a bend is");
}

static void tape_extremes(sw_tape *t, sw_wire_extremes *x) {
  SW_TAPE_STRUCT(t, sw_wire_extremes, 216);
  sw_tape_extreme(t, &x->curvature), sw_tape_extreme(t, &x->tension);
  sw_tape_extreme(t, &x->strain), sw_tape_extreme(t, &x->folding);
  sw_tape_extreme(t, &x->ovalisation), sw_tape_extreme(t, &x->raw), DOUBLE(raw_span);
  sw_tape_extreme(t, &x->torsion), tape_sharpness(t, &x->sharp);
  sw_tape_expect(t, x->raw_span >= 0 && x->raw_span <= 1e9, "the length of a step");
}

static void tape_drawing(sw_tape *t, sw_drawing *x) {
  SW_TAPE_STRUCT(t, sw_drawing, 88);
  sw_tape_count(t, &x->count, 3 * sizeof *x->points);
  SW_TAPE_OPTIONAL(t, x->points, 3 * x->count);
  DOUBLE(length), SIZE(segments), VEC(normal), INT(rest), INT(rolls), DOUBLE(rest_twist);
  DOUBLE(breaking_load), INT(breaking_flag);
  sw_tape_expect(t, x->breaking_flag >= 0 && x->breaking_flag < SW_BREAKING_FLAGS,
                 "a wire's strength");
  sw_tape_expect(t, x->segments <= 10000000, "a wire's segments");
  sw_tape_expect(t, x->points || !x->count, "a wire without its drawing");
  if (x->points) sw_tape_finite(t, x->points, 3 * x->count, "a wire's drawing");
}

void sw_tape_beam_of(sw_tape *t, sw_scene_wire *x) {
  sw_tape_beam(t, &x->beam);
  tape_drawing(t, &x->drawing);
}

static void tape_poke(sw_tape *t, sw_poke *x) {
  SW_TAPE_STRUCT(t, sw_poke, 56);
  INT(count), INT(slid), INT(hard), DOUBLE(struck), DOUBLE(time), DOUBLE(share), DOUBLE(rate),
      DOUBLE(bend);
}

void sw_tape_wire(sw_tape *t, sw_scene_wire *x, int placed) {
  SW_TAPE_STRUCT(t, sw_scene_wire, 1440);
  SW_TAPE_STRUCT(t, sw_twisted, 24);
  UINT32(generation), SIZE(number), NAME(name);
  SW_TAPE_CLASS(t, x->cls, sw_scene_body_class);
  sw_tape_expect(t, x->cls != NULL, "a wire of an unknown model");
  sw_tape_beam_of(t, x);
  sw_tape_mesh(t, &x->mesh, placed);
  sw_tape_strand(t, &x->strand, placed);
  tape_extremes(t, &x->extremes);
  sw_tape_window(t, &x->window);
  sw_tape_wear(t, &x->wear);
  sw_tape_spun(t, &x->spun);
  sw_tape_zone_watch(t, &x->zones);
  for (int end = 0; end < 2; end++) tape_poke(t, &x->pokes[end]);
  DOUBLE(blow), DOUBLE(grown), INT(untwisted), INT(remade);
  if (sw_tape_reads(t)) x->sunk = (sw_sunk){0};
  sw_tape_expect(t, x->blow >= 0 && isfinite(x->blow), "the hardest blow of a wire");
  sw_tape_expect(t, x->grown >= 0 && isfinite(x->grown), "how far a pushed wire has bent");
  sw_tape_list(t, &x->twisted, &x->twisted_count, sizeof *x->twisted);
}

/* --- holds ------------------------------------------------------------------------- */

void sw_tape_hold_args(sw_tape *t, sw_hold_args *x) {
  SW_TAPE_STRUCT(t, sw_hold_args, 200); /* a slider's are part of its own state */
  DOUBLE(s), DOUBLE(width), VEC(direction), NAME(name);
  DOUBLE(speed), DOUBLE(force), DOUBLE(force_limit);
}

static void tape_give(sw_tape *t, sw_clamp_give *x) {
  SW_TAPE_STRUCT(t, sw_clamp_give, 48);
  DOUBLE(shorter), DOUBLE(softer), DOUBLE(twist), VEC(axis);
  const int fine = isfinite(x->shorter + x->twist) && x->softer >= 0 && isfinite(x->softer);
  sw_tape_expect(t, fine, "how a clamp gives way");
}

static void tape_sums(sw_tape *t, sw_hold_sums *x) {
  SW_TAPE_STRUCT(t, sw_hold_sums, 104);
  INT(known);
  if (sw_tape_reads(t) && !x->known) *x = (sw_hold_sums){.known = 0};
  if (!x->known) return;
  INT(last), sw_tape_raw(t, x->force, sizeof x->force), sw_tape_raw(t, x->moment, sizeof x->moment);
  sw_tape_expect(t, x->last >= 0 && x->last < SW_BOOK_STAGES, "what a clamp bears");
}

void sw_tape_hold(sw_tape *t, sw_scene *s, sw_hold *x) {
  SW_TAPE_STRUCT(t, sw_hold, 1656); /* node, number and rail are set when it is built */
  UINT32(generation), INT(alive), NAME(name);
  SW_TAPE_CLASS(t, x->cls, sw_link_find);
  sw_tape_expect(t, x->cls && x->cls->hold, "a clamp of an unknown kind");
  SIZE(wire), DOUBLE(scale), UINT32(shape), INT(formed), DOUBLE(s1), DOUBLE(s2);
  sw_tape_hold_args(t, &x->args);
  sw_tape_drive(t, s, &x->drive);
  sw_tape_count(t, &x->count, sizeof *x->s);
  SW_TAPE_ARRAY(t, x->s, x->count), SW_TAPE_ARRAY(t, x->local, 3 * x->count);
  SW_TAPE_OPTIONAL(t, x->particle, x->count);
  VEC(director[0]), VEC(director[1]);
  sw_tape_mesh_frame(t, &x->frame[0]), sw_tape_mesh_frame(t, &x->frame[1]);
  tape_give(t, &x->give[0]), tape_give(t, &x->give[1]);
  QUAT(turn), VEC(force), VEC(moment), VEC(end_force), VEC(end_moment), POSE(last_pose);
  SW_TAPE_STRUCT(t, sw_hold_watch, 64); /* over begins anew */
  INT(watch.looking), INT(watch.crashing), DOUBLE(watch.looked), DOUBLE(watch.given);
  DOUBLE(watch.crash.time), DOUBLE(watch.crash.depth), SIZE(watch.crash.obstacle);
  tape_sums(t, &x->sums);
  sw_tape_feed(t, &x->feed);
  if (sw_tape_good(t) && x->cls->hold->tape) x->cls->hold->tape(t, x);
  sw_tape_log(t, &x->log);
}

/* --- all else ---------------------------------------------------------------------- */

static void tape_load(sw_tape *t, sw_contact_load *x) {
  VEC(force), VEC(moment);
  sw_tape_expect(t, sw_finite(x->force) && sw_finite(x->moment), "force on an obstacle");
}

void sw_tape_obstacle(sw_tape *t, sw_scene *s, sw_scene_obstacle *x) {
  SW_TAPE_STRUCT(t, sw_contact_past, 152);
  SW_TAPE_STRUCT(t, sw_scene_obstacle, 400);
  UINT32(generation), INT(alive), NAME(name);
  sw_tape_shape(t, &x->shape);
  sw_tape_drive(t, s, &x->drive);
  DOUBLE(friction), DOUBLE(kinetic), DOUBLE(restitution), INT(off);
  if (!sw_tape_reads(t) && sw_obstacle_log_fill(s, x) != SW_OK) sw_tape_fail(t, SW_ENOMEM);
  if (sw_tape_reads(t)) sw_obstacle_log_begin(s, x);
  tape_load(t, &x->past.mean), tape_load(t, &x->past.end), tape_load(t, &x->past.gained);
  sw_tape_double(t, &x->past.hardest);
  sw_tape_log(t, &x->log);
  sw_tape_expect(t, x->kinetic >= 0 && x->kinetic <= 100, "friction of an obstacle");
  sw_tape_expect(t, x->friction >= 0 && x->friction <= 100, "friction of an obstacle");
  sw_tape_expect(t, x->restitution >= 0 && x->restitution <= 1, "restitution of an obstacle");
}

/* Writes and reads the arguments without the addresses in them, which are invalid elsewhere. */
static void tape_force_args(sw_tape *t, sw_scene_force *x) {
  double args[SW_FORCE_ARGS_MAX / sizeof(double)];
  const int some = x->cls->flags & SW_FORCE_ON_SOME;
  const int function = !x->cls->params.count;
  sw_force_some list = {NULL, 0};
  memcpy(args, x->args, sizeof args);
  if (some) memcpy(&list, args, sizeof list);
  if (some) memcpy(args, &(sw_force_some){NULL, 0}, sizeof list);
  if (function && !t->home) memset(args, 0, sizeof args);
  sw_tape_raw(t, args, sizeof args);
  sw_tape_count(t, &list.count, sizeof *x->particle);
  if (some) SW_TAPE_ARRAY(t, x->particle, list.count);
  if (!sw_tape_reads(t)) return;
  memcpy(x->args, args, sizeof args);
  if (!sw_tape_good(t)) return;
  if (!t->home) t->status = sw_params_check(&x->cls->params, x->args, 1, t->err);
  list.particle = x->particle;
  if (some) memcpy(x->args, &list, sizeof list);
}

void sw_tape_force(sw_tape *t, sw_scene_force *x) {
  SW_TAPE_STRUCT(t, sw_scene_force, 248);
  UINT32(generation), INT(alive), NAME(name), sw_tape_long(t, &x->wire), DOUBLE(scale);
  SW_TAPE_CLASS(t, x->cls, sw_force_find);
  sw_tape_expect(t, x->cls != NULL, "a force of an unknown kind");
  sw_tape_expect(t, isfinite(x->scale) && x->scale > 0, "a force without scale");
  if (x->cls) tape_force_args(t, x);
  sw_tape_expect(t, x->cls && (!x->alive || x->cls->params.count), "a force that is a function");
}

void sw_tape_join(sw_tape *t, sw_joint *x) {
  int broken = x->fate[SW_TIE_BROKEN] > 0;
  SW_TAPE_STRUCT(t, sw_joint, 1256); /* stops are set when it is built */
  UINT32(generation), INT(alive), INT(rigid), NAME(name), SIZE(count);
  DOUBLE(slack), DOUBLE(stiffness), DOUBLE(strength); /* its spring is set when it is built */
  if (sw_tape_reads(t)) x->cls = sw_joint_class(x->slack);
  sw_tape_int(t, &broken);
  x->fate[SW_TIE_BROKEN] = broken;
  INT(evened);
  DOUBLE(fate[SW_TIE_BROKEN_TIME]), DOUBLE(fate[SW_TIE_BROKEN_FORCE]), DOUBLE(fate[SW_TIE_PEAK]);
  sw_tape_expect(t, x->count >= 2 && x->count <= SW_JOIN_ENDS, "a join");
  for (size_t k = 0; k < x->count && sw_tape_good(t); k++) {
    sw_joint_end *e = &x->ends[k];
    sw_tape_size(t, &e->wire);
    sw_tape_double(t, &e->s), sw_tape_double(t, &e->asked), sw_tape_double(t, &e->scale);
    sw_tape_vec(t, &e->offset), sw_tape_vec(t, &e->rest);
    sw_tape_vec(t, &x->bears[k]);
    if (!t->home && sw_tape_reads(t)) e->kept_by = 0; /* noted anew when the run begins */
    if (t->home) sw_tape_size(t, &e->kept_by), sw_tape_uint32(t, &e->kept_of);
    if (t->home) sw_tape_double(t, &e->roll);
  }
}

void sw_tape_rule(sw_tape *t, sw_scene_rule *x) {
  SW_TAPE_STRUCT(t, sw_scene_rule, 40);
  sw_tape_count(t, &x->count, sizeof *x->wires);
  SW_TAPE_ARRAY(t, x->wires, x->count);
  INT(self), INT(rule.on), DOUBLE(rule.friction);
  sw_tape_expect(t, x->rule.friction >= 0 && x->rule.friction <= 100, "friction of wires");
}

void sw_tape_frame(sw_tape *t, const sw_scene *s, sw_frame *x) {
  SW_TAPE_STRUCT(t, sw_frame, 88); /* a frame on a tape is no closing one */
  size_t size = 0;
  DOUBLE(time), SIZE(wires), SIZE(obstacles), SIZE(holds), SIZE(tools);
  for (int k = 0; k < SW_FRAME_ENERGIES; k++) DOUBLE(energy[k]);
  sw_tape_count(t, &x->size, sizeof *x->data);
  SW_TAPE_ARRAY(t, x->data, x->size);
  if (!sw_tape_reads(t) || !sw_tape_good(t)) return;
  sw_tape_expect(t,
                 x->wires <= sw_scene_bodies_made(s) &&
                     x->obstacles <= sw_scene_obstacle_slots(s) &&
                     x->holds <= sw_scene_hold_slots(s) && x->tools <= sw_scene_tool_slots(s) &&
                     sw_scene_frame_walk(x, x->size, &size) && size == x->size,
                 "a frame");
}
