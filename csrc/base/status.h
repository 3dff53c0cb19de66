/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Status codes and error text. Core functions return a status and, when they
 * can say more, fill the caller's sw_error; only the Lua binding raises. */
#ifndef SW_BASE_STATUS_H
#define SW_BASE_STATUS_H

typedef enum sw_status {
  SW_OK = 0,
  SW_EINVAL,    /* an argument is outside its range */
  SW_ENOMEM,    /* memory ran out */
  SW_EDIVERGED, /* a run or a static solve left the finite numbers */
  SW_ENOCONV,   /* iterations used up */
  SW_ESINGULAR, /* a matrix could not be factorised */
  SW_ECALLBACK, /* a user callback failed; its error value is kept by the caller */
  SW_EINTR,     /* stopped by the user between two steps */
  SW_EDEAD,     /* a handle whose object is gone */
  SW_EFORMAT,   /* a file's content could not be understood */
  SW_ELIMIT,    /* a count is beyond what this build supports */
  SW_EBUSY,     /* refused while a run is under way */
  SW_EEMPTY     /* no wire is left where it was to be drawn in */
} sw_status;

enum { SW_ERROR_TEXT = 512 };

/* Text is always terminated. A function that returns SW_OK leaves it alone. */
typedef struct sw_error {
  char text[SW_ERROR_TEXT];
} sw_error;

/* A short name for a status ("diverged", "out of memory", ...). Never NULL. */
const char *sw_status_text(sw_status status);

/* Fill err (may be NULL) by a printf format and return status, so that a
 * failing function can end with `return sw_fail(err, SW_EINVAL, ...)`. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
sw_status
sw_fail(sw_error *err, sw_status status, const char *format, ...);

#define SW_TRY(call)                      \
  do {                                    \
    const sw_status sw_try_ = (call);     \
    if (sw_try_ != SW_OK) return sw_try_; \
  } while (0)

#endif
