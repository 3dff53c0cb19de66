/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keeps the decimal point in numbers, whatever os.setlocale says. */
#ifndef LSW_LOCALE_H
#define LSW_LOCALE_H

#include <lua.h>

/* Gives this thread its own locale and makes os.setlocale renew it. */
void lsw_locale_open(lua_State *L);
/* Sets this thread's locale to the program's, except for numbers. Call it after setlocale. */
void lsw_locale_renew(void);

#endif
