/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists that other rooms keep in the scene. */
#ifndef SW_SCENE_LISTS_H
#define SW_SCENE_LISTS_H

#include <stddef.h>

typedef struct sw_zone sw_zone;                 /* watch/zone.h */
typedef struct sw_watch sw_watch;               /* watch/series.c: the rows of one object */
typedef struct sw_frame sw_frame;               /* read/kept_frames.h */
typedef struct sw_scene_rule sw_scene_rule;     /* body/touching.h */
typedef struct sw_kept_history sw_kept_history; /* body/history.h */

typedef struct sw_zones {
  sw_zone *list;
  size_t count, capacity;
} sw_zones;

/* The series of wires and forces. */
typedef struct sw_watches {
  sw_watch *list;
  size_t count, capacity;
  size_t next; /* likely index of the object that is noted next [-] */
} sw_watches;

typedef struct sw_frames {
  sw_frame *list;
  size_t count, capacity;
  double next;   /* time of the next frame [s] */
  size_t stride; /* every stride-th frame is kept: 1, 2, 4 ... [-] */
  double bytes;  /* memory that they use [B] */
  double memory; /* memory that they may use [B] */
} sw_frames;

/* Rules of which wires touch each other. */
typedef struct sw_rules {
  sw_scene_rule *list;
  size_t count, capacity;
} sw_rules;

/* Contact memory of the last built system, for the next one. */
typedef struct sw_kept_contact {
  void *memory; /* copy, or NULL */
  size_t bytes;
  void *pairs; /* the same of contact between wires */
  size_t pair_bytes;
  void *grains; /* the same of objects of particles */
  size_t grain_bytes;
  double *s;     /* (nodes) arc lengths in the last system [m] */
  size_t *first; /* (wires + 1) first node of each wire in the last system */
  size_t *now;   /* (wires) present slot; SIZE_MAX: the wire is gone */
  size_t wires;
  int fresh;
  int fed;        /* 1: nodes changed by feeding only; used at once, so it is not on tape */
  size_t changed; /* number + 1 of a wire whose nodes have changed since; 0: none */
} sw_kept_contact;

/* Histories of forces of the last built system, for the next one. */
typedef struct sw_histories {
  sw_kept_history *list;
  size_t count;
} sw_histories;

#endif
