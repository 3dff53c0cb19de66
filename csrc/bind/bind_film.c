/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a player's page is made of: the film of a scene, bytes made few, bytes as text, and the page
 * itself, which is part of this program. */
#include <string.h>

#include "bind/child.h"
#include "bind/module.h"

/* Bytes on their way to Lua, freed whatever happens there. */
static int free_film(lua_State *L) {
  sw_film_free(lua_touserdata(L, 1));
  return 0;
}

typedef struct packer {
  sw_pack *pack;
} packer;

static int free_pack(lua_State *L) {
  packer *p = lua_touserdata(L, 1);
  sw_pack_free(p->pack);
  p->pack = NULL;
  return 0;
}

static void *keeper(lua_State *L, size_t size, const char *name, lua_CFunction end) {
  void *p = lua_newuserdatauv(L, size, 0);
  memset(p, 0, size);
  if (luaL_newmetatable(L, name)) lua_pushcfunction(L, end), lua_setfield(L, -2, "__gc");
  lua_setmetatable(L, -2);
  return p;
}

/* core.film(scene, from, to, values) -> bytes, frames, those left out as broken */
static int mod_film(lua_State *L) {
  const sw_scene *scene = ((lsw_handle *)lsw_check(L, 1, &lsw_class_scene))->object;
  const sw_film_args args = {luaL_checknumber(L, 2), luaL_checknumber(L, 3), lua_toboolean(L, 4), 0};
  sw_error err = {""};
  sw_film *film = keeper(L, sizeof *film, "softworld.film", free_film);
  lsw_must(L, sw_film_make(scene, &args, sw_interrupted, film, &err), &err);
  lua_pushlstring(L, (const char *)film->bytes, film->size);
  lua_pushinteger(L, (lua_Integer)film->frames);
  lua_pushinteger(L, (lua_Integer)film->broken);
  sw_film_free(film);
  return 3;
}

/* core.edges(particles) -> edges of the surface: pairs of numbers from 0, 32 bits each */
static int mod_edges(lua_State *L) {
  sw_scene *scene;
  luaL_Buffer b;
  const lsw_child *p = lsw_check_child(L, 1, &lsw_class_particles, &scene);
  const size_t count = sw_scene_particles_edges(scene, p->id, NULL), size = 2 * sizeof(uint32_t);
  char *out = luaL_buffinitsize(L, &b, count * size);
  sw_scene_particles_edges(scene, p->id, (uint32_t *)(void *)out);
  luaL_pushresultsize(&b, count * size);
  return 1;
}

/* core.deflate(bytes) -> fewer bytes (zlib) */
static int mod_deflate(lua_State *L) {
  size_t size;
  sw_error err = {"out of memory for deflated data"};
  const char *bytes = luaL_checklstring(L, 1, &size);
  packer *p = keeper(L, sizeof *p, "softworld.pack", free_pack);
  const unsigned char *out;
  lsw_must(L, sw_pack_new(&p->pack), &err);
  sw_pack_put(p->pack, bytes, size);
  lsw_must(L, sw_pack_end(p->pack, &out, &size), &err);
  lua_pushlstring(L, (const char *)out, size);
  sw_pack_free(p->pack);
  p->pack = NULL;
  return 1;
}

/* core.base64(bytes) -> text */
static int mod_base64(lua_State *L) {
  size_t size;
  luaL_Buffer b;
  const char *bytes = luaL_checklstring(L, 1, &size);
  const size_t length = sw_base64_size(size);
  char *out = luaL_buffinitsize(L, &b, length);
  sw_base64((const unsigned char *)bytes, size, out);
  luaL_pushresultsize(&b, length);
  return 1;
}

/* Put there by the Makefile, see PAGE. */
extern const char lsw_page_start[], lsw_page_end[];

/* core.page() -> the player's page without data */
static int mod_page(lua_State *L) {
  lua_pushlstring(L, lsw_page_start, (size_t)(lsw_page_end - lsw_page_start));
  return 1;
}

static const luaL_Reg functions[] = {{"film", mod_film},       {"edges", mod_edges},
                                     {"deflate", mod_deflate}, {"base64", mod_base64},
                                     {"page", mod_page},       {NULL, NULL}};

void lsw_open_film(lua_State *L) { luaL_setfuncs(L, functions, 0); }
