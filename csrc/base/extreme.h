/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The largest of some values, with its place and time. */
#ifndef SW_BASE_EXTREME_H
#define SW_BASE_EXTREME_H

typedef struct sw_extreme {
  double value; /* [its unit] */
  double s;     /* where [m] */
  double time;  /* when [s] */
} sw_extreme;

#endif
