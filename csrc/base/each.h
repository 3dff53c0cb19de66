/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef SW_BASE_EACH_H
#define SW_BASE_EACH_H

/* Loops over the count items of an array: item is a pointer to each. For loops without an index. */
/* NOLINTBEGIN(bugprone-macro-parentheses): a type and a declared name take none */
#define SW_ITEMS(type, item, array, count) \
  for (type *item = (array), *item##_end = item + (count); item < item##_end; item++)
/* NOLINTEND(bugprone-macro-parentheses) */

#endif
