/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers with a decimal point, whatever os.setlocale says. */
#ifndef LSW_LOCALE_H
#define LSW_LOCALE_H

#include <lua.h>

/* This thread has a locale of its own from now on, and os.setlocale sees to it. */
void lsw_locale_open(lua_State *L);
/* Take over the program's present locale, its numbers aside. To be called after setlocale. */
void lsw_locale_renew(void);

#endif
