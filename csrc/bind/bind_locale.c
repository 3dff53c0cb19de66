/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives this thread a locale whose numbers have a decimal point. In some locales numbers have a
 * comma: Lua then writes 1,5 and cannot read "1.5" in some places. Files, scripts for other
 * programs and the names of cables need the point, and too many places write or read numbers to
 * guard each of them. The thread's locale is the program's except for its numbers; os.setlocale
 * still works for everything else. */
#include <lauxlib.h>
#include <locale.h>

#include "bind/locale.h"

static _Thread_local locale_t own;

void lsw_locale_renew(void) {
  const locale_t base = duplocale(LC_GLOBAL_LOCALE);
  if (!base) return;
  const locale_t next = newlocale(LC_NUMERIC_MASK, "C", base);
  if (!next) {
    freelocale(base);
    return;
  }
  const locale_t before = own;
  own = next;
  uselocale(own);
  if (before) freelocale(before);
}

/* The new os.setlocale: calls the original one (upvalue 1), then renews this thread's locale. */
static int setlocale_and_renew(lua_State *L) {
  const int count = lua_gettop(L);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, count, LUA_MULTRET);
  lsw_locale_renew();
  return lua_gettop(L);
}

void lsw_locale_open(lua_State *L) {
  lsw_locale_renew();
  if (lua_getglobal(L, "os") == LUA_TTABLE) {
    lua_getfield(L, -1, "setlocale");
    if (lua_tocfunction(L, -1) != setlocale_and_renew && lua_isfunction(L, -1)) {
      lua_pushcclosure(L, setlocale_and_renew, 1);
      lua_setfield(L, -2, "setlocale");
    } else {
      lua_pop(L, 1);
    }
  }
  lua_pop(L, 1);
}
