/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Read-outs of lists of touches of any kind. */
#ifndef SW_TOUCH_TALLY_H
#define SW_TOUCH_TALLY_H

#include <stddef.h>

/* Sums over a list, kept where the list stays as it is for many steps. */
typedef struct sw_press_sums {
  size_t pressing;       /* number of touches with a force */
  double energy, rubbed; /* [J] */
  double hardest;        /* largest normal force [N] */
} sw_press_sums;

/* A list of touches, and the offsets of sw_press and let-out depth in each item. */
typedef struct sw_presses {
  const void *list;
  size_t count, size;         /* items [-]; size of an item [B] */
  size_t press, let_out;      /* offsets in an item [B] */
  const sw_press_sums *known; /* its sums, or NULL */
} sw_presses;
#define SW_PRESSES(type, list, count)                                                          \
  ((sw_presses){(list), (count), sizeof(type), offsetof(type, press), offsetof(type, let_out), \
                NULL})

size_t sw_presses_count(sw_presses list);            /* number of touches with a force */
int sw_presses_slide(sw_presses list, double least); /* 1: one slid by more than least [m] */
double sw_presses_energy(sw_presses list);           /* energy stored in the springs [J] */
double sw_presses_rubbed(sw_presses list);           /* energy lost by friction in the step [J] */
sw_press_sums sw_presses_sums(sw_presses list);      /* adds up all items */
/* Work in the step of the forces on wires that come out of what they are in [J]. */
double sw_presses_emerged(sw_presses list);

#endif
