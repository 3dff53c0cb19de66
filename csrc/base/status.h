/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Status codes and error texts. Core functions return a status and, if they can
 * say more, fill the caller's sw_error. Only the Lua binding raises errors. */
#ifndef SW_BASE_STATUS_H
#define SW_BASE_STATUS_H

typedef enum sw_status {
  SW_OK = 0,
  SW_EINVAL,    /* an argument is outside its range */
  SW_ENOMEM,    /* memory ran out */
  SW_EDIVERGED, /* a run or a static solve has values that are not finite */
  SW_ENOCONV,   /* not converged within the allowed iterations */
  SW_ESINGULAR, /* a matrix could not be factorised */
  SW_ECALLBACK, /* a user callback failed; the caller keeps its error value */
  SW_EINTR,     /* stopped by the user between two steps */
  SW_EDEAD,     /* a handle whose object is gone */
  SW_EFORMAT,   /* a file's content could not be understood */
  SW_ELIMIT,    /* beyond a limit: of this build, of memory or time, or of steps */
  SW_EBUSY,     /* refused during a run */
  SW_EEMPTY     /* a feed has no wire left to draw in */
} sw_status;

/* Marks a parameter that others of the same kind of function use. */
#define SW_UNUSED __attribute__((unused))

enum { SW_ERROR_TEXT = 512 };

/* The text always ends with a zero. A function that returns SW_OK does not change it. */
typedef struct sw_error {
  char text[SW_ERROR_TEXT];
} sw_error;

/* Returns a short text for a status ("diverged", "out of memory", ...). Never NULL. */
const char *sw_status_text(sw_status status);

/* Fills err (may be NULL) by a printf format and returns status, so that a
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
