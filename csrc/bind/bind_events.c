/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene:events() and scene:tell{...}: the events of a run. */
#include <math.h>

#include "bind/child.h"

typedef struct tell_args {
  char kind[SW_NAME_SIZE], object[SW_NAME_SIZE];
  double s, value, time;
} tell_args;

static const sw_param tell_rows[] = {
    {"kind", SW_PARAM_TEXT, "-", 0, 0, 0, SW_PARAM_REQUIRED, NULL, offsetof(tell_args, kind),
     "one word, such as crash"},
    {"object", SW_PARAM_TEXT, "-", 0, 0, 0, 0, NULL, offsetof(tell_args, object),
     "name of the object of the event"},
    {"s", SW_PARAM_NUMBER, "m", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(tell_args, s),
     "arc length"},
    {"value", SW_PARAM_NUMBER, "-", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(tell_args, value),
     "size of the event, in the unit of the text; of repeated events the largest is kept"},
    {"time", SW_PARAM_NUMBER, "s", NAN, -HUGE_VAL, HUGE_VAL, 0, NULL, offsetof(tell_args, time),
     "when it happened; default: now"},
    {"text", SW_PARAM_OTHER, "-", 0, 0, 0, SW_PARAM_REQUIRED, NULL, 0, "one sentence"},
};
static const sw_params tell_params = SW_PARAMS("scene:tell", tell_rows);

/* scene:tell{ kind =, object =, s =, value =, time =, text = } */
int lsw_scene_tell(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  tell_args args;
  lsw_arguments(L, 2, "scene:tell", &tell_params, &args);
  if (lua_getfield(L, 2, "text") != LUA_TSTRING)
    return luaL_error(L, "scene:tell: text must be a string, got %s", luaL_typename(L, -1));
  LSW_DO(L, sw_scene_book_event, scene, args.kind, args.object, args.s, args.value, args.time,
         lua_tostring(L, -1));
  return 0;
}

static void push_event(lua_State *L, const sw_event *e) {
  lua_createtable(L, 0, 9);
  lsw_set_text(L, "kind", e->kind);
  lsw_set_text(L, "object", e->object);
  lsw_set_text(L, "text", e->text);
  lsw_set_number(L, "time", e->time);
  lsw_set_number(L, "first", e->first);
  lsw_set_number(L, "last", e->last);
  lsw_set_integer(L, "count", e->count);
  lsw_set_known(L, "s", e->s);
  lsw_set_known(L, "value", e->value);
}

/* scene:events() -> list, number of events dropped because the list was full */
int lsw_scene_events(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const sw_event *e;
  lsw_quiet(L);
  lua_newtable(L);
  for (size_t k = 0; (e = sw_scene_event(scene, k)) != NULL; k++) {
    push_event(L, e);
    lua_rawseti(L, -2, (lua_Integer)k + 1);
  }
  lua_pushinteger(L, (lua_Integer)sw_scene_events_dropped(scene));
  return 2;
}
