/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameter rows. Each kind of object has one table with the name, type, unit, default,
 * range and meaning of each of its parameters. Construction, checks, get/set, help(),
 * the reference pages and tuning bounds all read the same rows. */
#ifndef SW_BASE_PARAM_H
#define SW_BASE_PARAM_H

#include <stddef.h>

#include "base/status.h"

enum { SW_NAME_SIZE = 64 }; /* longest user-given name, with its terminating zero [B] */

/* Largest coordinate of a place that a script may give [m]: distances stay finite. */
#define SW_PLACE_FARTHEST 1e100

/* Type of the row's field in the argument struct. */
typedef enum sw_param_type {
  SW_PARAM_NUMBER,   /* double */
  SW_PARAM_INTEGER,  /* long */
  SW_PARAM_BOOLEAN,  /* int */
  SW_PARAM_CHOICE,   /* int, the index into choices */
  SW_PARAM_TEXT,     /* char[SW_NAME_SIZE] */
  SW_PARAM_VECTOR,   /* sw_vec */
  SW_PARAM_ROTATION, /* sw_quat; in Lua { axis = {x,y,z}, angle = rad } or {w,x,y,z} */
  SW_PARAM_OTHER     /* a known name that the binding itself reads; nothing is stored */
} sw_param_type;

enum {
  SW_PARAM_REQUIRED = 1,  /* must be given */
  SW_PARAM_ABOVE_MIN = 2, /* min itself is not allowed */
  SW_PARAM_BELOW_MAX = 4, /* max itself is not allowed */
  SW_PARAM_CHANGES = 8    /* may also be set later, between steps */
};

typedef struct sw_param {
  const char *name;
  sw_param_type type;
  const char *unit; /* "m", "N m2", ...; "-" if it has none; never NULL */
  double def;       /* default; NAN = none (reads as NAN, or as all-NAN vector) */
  double min, max;  /* allowed range, of each component for a vector [unit] */
  unsigned flags;
  const char *const *choices; /* NULL-terminated names of a choice, else NULL */
  size_t offset;              /* of the value in the argument struct [B] */
  const char *doc;            /* one sentence without a full stop; never NULL */
} sw_param;

/* A table of rows and the object it builds ("obstacle box"). */
typedef struct sw_params {
  const char *object;
  const sw_param *rows;
  size_t count;
} sw_params;

#define SW_PARAMS(object_name, table) \
  { object_name, table, sizeof(table) / sizeof((table)[0]) }

/* Rows whose parameter has the name of its field: a number, a vector, and the object's name. */
#define SW_NUMBER_ROW(args, field, unit, def, min, max, flags, doc) \
  { #field, SW_PARAM_NUMBER, unit, def, min, max, flags, NULL, offsetof(args, field), doc }
#define SW_VECTOR_ROW(args, field, unit, def, flags, doc)                                        \
  {                                                                                              \
#field, SW_PARAM_VECTOR, unit, def, -HUGE_VAL, HUGE_VAL, flags, NULL, offsetof(args, field), \
        doc                                                                                      \
  }
#define SW_NAME_ROW(args)                                               \
  {                                                                     \
    "name", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(args, name), \
        "name used in messages and series"                              \
  }

/* Writes the default of each row into args. */
void sw_params_default(const sw_params *params, void *args);

/* The row called name, or NULL. */
const sw_param *sw_params_find(const sw_params *params, const char *name);

/* Checks that a number is finite, whole (INTEGER rows) and in the row's range.
 * SW_EINVAL with a text that names object, parameter, value, unit and range. */
sw_status sw_param_check(const char *object, const sw_param *row, double value, sw_error *err);

/* Checks a whole argument struct that was not made by these checks, such as one from a file.
 * lenient: required numbers may be NAN (left out), as the program itself may do. */
sw_status sw_params_check(const sw_params *params, const void *args, int lenient, sw_error *err);

/* Stores a checked number (NUMBER, INTEGER, BOOLEAN, CHOICE rows). For the other types it stores
 * the default: an empty text, a vector of equal components, the identity. */
void sw_param_store(const sw_param *row, void *args, double value);

/* Returns the name that word means: a name for which it is another word (base/other_words.def),
 * else the nearest by edit distance, or NULL if none is near enough for word to be a typo. Name i
 * of count is at names + i * stride [B]. */
const char *sw_nearest_name(const char *word, const char *const *names, size_t stride,
                            size_t count);

#endif
