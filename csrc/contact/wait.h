/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Touches of bodies that wait (system/wait.h). They are put aside as they were at the last accepted
 * state, with their loads on obstacles. They are not evaluated until the body is solved again; its
 * memory then finds them anew. Only for the files of this folder. */
#ifndef SW_CONTACT_WAIT_H
#define SW_CONTACT_WAIT_H

#include "contact/record.h"
#include "touch/tally.h"

typedef struct sw_still {
  sw_touch *list; /* (count) in the order of nodes */
  size_t count, capacity;
  sw_press_sums sums;  /* of the list, which stays as it is for many steps */
  double deepest;      /* largest penetration, or 0 [m] */
  size_t deepest_node; /* its node */
  unsigned char *kept; /* (bodies) 1: the body's touches are in the list */
  size_t bodies;
  int any;      /* 1: some body waits */
  int accepted; /* 1: the other touches are those of the accepted state */
} sw_still;

/* Call when a step begins: decides which bodies wait, and puts their touches aside. SW_ENOMEM. */
sw_status sw_contact_wait(sw_contact *c, sw_system *s);
/* 1 if all bodies wait in this step. */
int sw_contact_all_wait(const sw_contact *c, const sw_system *s);
/* Puts those touches back among the others. SW_ENOMEM: nothing is changed. */
sw_status sw_contact_put_back(sw_contact *c);
void sw_contact_forget_still(sw_contact *c); /* drops them */
void sw_still_free(sw_still *still);

#endif
