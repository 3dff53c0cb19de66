/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The server of live views for Lua.
 *
 *   core.serve(port) -> server, port, token
 *   server:page(html, policy); server:put(slot, bytes); server:wait(s); server:stop()
 *   server:take() -> text, page; nothing if there is no message
 *   server:pages() -> number of open pages, number of these that wait for a frame
 *   core.film_now(scene, values) -> bytes of a film of the present state, number of frames */

#include "bind/child.h"

static const char SERVER[] = "softworld.server";
static const char FILM[] = "softworld.film_now";

static int running; /* number of servers; each has its own threads */

int lsw_servers(void) { return running; }

typedef struct holder {
  sw_server *server;
} holder;

static sw_server *check(lua_State *L) {
  sw_server *server = ((holder *)luaL_checkudata(L, 1, SERVER))->server;
  if (!server) luaL_error(L, "the view has been closed");
  return server;
}

static int meth_stop(lua_State *L) {
  holder *h = luaL_checkudata(L, 1, SERVER);
  sw_server *server = h->server;
  h->server = NULL;
  if (server) running--;
  sw_server_stop(server);
  return 0;
}

static int meth_page(lua_State *L) {
  size_t size;
  sw_error err = {"out of memory for the page"};
  sw_server *server = check(L);
  const char *html = luaL_checklstring(L, 2, &size);
  lsw_must(L, sw_server_set_page(server, html, size, luaL_checkstring(L, 3)), &err);
  return 0;
}

static int meth_put(lua_State *L) {
  size_t size;
  sw_error err = {"out of memory for what pages show"};
  sw_server *server = check(L);
  const lua_Integer slot = luaL_checkinteger(L, 2);
  luaL_argcheck(L, slot >= 0 && slot < SW_SERVER_SLOTS, 2, "no such slot");
  const char *bytes = luaL_checklstring(L, 3, &size);
  lsw_must(L, sw_server_put(server, (int)slot, bytes, size), &err);
  return 0;
}

static int meth_take(lua_State *L) {
  luaL_Buffer b;
  int page;
  sw_server *server = check(L);
  char *out = luaL_buffinitsize(L, &b, SW_SERVER_MESSAGE);
  const size_t size = sw_server_take(server, out, SW_SERVER_MESSAGE, &page);
  if (!page) return 0;
  luaL_pushresultsize(&b, size);
  lua_pushinteger(L, page);
  return 2;
}

static int meth_pages(lua_State *L) {
  size_t waiting;
  lua_pushinteger(L, (lua_Integer)sw_server_pages(check(L), &waiting));
  lua_pushinteger(L, (lua_Integer)waiting);
  return 2;
}

/* Waits until something happens, at most this long [s]; Ctrl-C ends it with an error. */
static int meth_wait(lua_State *L) {
  sw_server *server = check(L);
  sw_server_wait(server, luaL_checknumber(L, 2));
  lsw_poll(L);
  return 0;
}

static const luaL_Reg methods[] = {{"page", meth_page},   {"put", meth_put},   {"take", meth_take},
                                   {"pages", meth_pages}, {"wait", meth_wait}, {"stop", meth_stop},
                                   {NULL, NULL}};

static int mod_serve(lua_State *L) {
  const lua_Integer port = lsw_integer(L, 1, "view: port");
  holder *h = lsw_keep(L, sizeof *h, SERVER, methods, meth_stop);
  LSW_DO(L, sw_server_start, (int)port, &h->server);
  running++;
  lua_pushinteger(L, sw_server_port(h->server));
  lua_pushstring(L, sw_server_token(h->server));
  return 3;
}

static int free_film(lua_State *L) {
  sw_film_free(lua_touserdata(L, 1));
  return 0;
}

static int mod_film_now(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  sw_film *film = lsw_keep(L, sizeof *film, FILM, NULL, free_film);
  LSW_DO(L, sw_film_now, scene, lua_toboolean(L, 2), film);
  lua_pushlstring(L, (const char *)film->bytes, film->size);
  lua_pushinteger(L, (lua_Integer)film->frames);
  sw_film_free(film);
  return 2;
}

const luaL_Reg lsw_module_view[] = {{"serve", mod_serve}, {"film_now", mod_film_now}, {NULL, NULL}};
