/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts of status codes, and formatted error texts. */
#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

const char *sw_status_text(sw_status status) {
  switch (status) {
    case SW_OK: return "ok";
    case SW_EINVAL: return "invalid argument";
    case SW_ENOMEM: return "out of memory";
    case SW_EDIVERGED: return "diverged";
    case SW_ENOCONV: return "not converged";
    case SW_ESINGULAR: return "singular matrix";
    case SW_ECALLBACK: return "error in a callback";
    case SW_EINTR: return "interrupted";
    case SW_EDEAD: return "object is gone";
    case SW_EFORMAT: return "bad format";
    case SW_ELIMIT: return "beyond a limit";
    case SW_EBUSY: return "busy";
    case SW_EEMPTY: return "no wire left";
  }
  return "unknown status";
}

sw_status sw_fail(sw_error *err, sw_status status, const char *format, ...) {
  if (err) {
    va_list args;
    va_start(args, format);
    vsnprintf(err->text, sizeof err->text, format, args);
    va_end(args);
  }
  return status;
}
