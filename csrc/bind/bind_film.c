/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a player's page: the film of a scene, surfaces of wires, compression (zlib), base64, and
 * the page itself, which is stored in this program. */

#include "bind/child.h"

/* Films, packers and skins live in userdata, so that they are freed when Lua raises an error. */
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

/* core.film(scene, from, to, values) -> bytes, number of frames, number of frames left out because
 * they have positions that are not finite; from, to [s] */
static int mod_film(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  const sw_film_args args = {luaL_checknumber(L, 2), luaL_checknumber(L, 3), lua_toboolean(L, 4),
                             0};
  sw_film *film = lsw_keep(L, sizeof *film, "softworld.film", NULL, free_film);
  LSW_DO(L, sw_film_make, scene, &args, sw_interrupted, film);
  lua_pushlstring(L, (const char *)film->bytes, film->size);
  lua_pushinteger(L, (lua_Integer)film->frames);
  lua_pushinteger(L, (lua_Integer)film->broken);
  sw_film_free(film);
  return 3;
}

static int free_skin(lua_State *L) {
  sw_skin_free(lua_touserdata(L, 1));
  return 0;
}

/* Returns the list of frame numbers at index (from 1 in Lua), from 0; pushes its memory. */
static size_t *frames_at(lua_State *L, int index, const sw_scene *scene, size_t *count) {
  luaL_checktype(L, index, LUA_TTABLE);
  *count = lua_rawlen(L, index);
  size_t *list = lua_newuserdatauv(L, *count * sizeof *list + 1, 0);
  lsw_still_open(L);
  for (size_t i = 0; i < *count; i++) {
    lua_rawgeti(L, index, (lua_Integer)i + 1);
    const lua_Integer number = lua_tointeger(L, -1);
    if (number < 1 || (size_t)number > sw_scene_frames(scene))
      luaL_error(L, "core.skin: there is no frame %d", (int)number);
    list[i] = (size_t)number - 1;
    lua_pop(L, 1);
  }
  return list;
}

static void push_skin(lua_State *L, const sw_skin *skin, size_t frames) {
  lua_createtable(L, 0, 6);
  lua_pushlstring(L, (const char *)skin->data,
                  3 * skin->corners * (skin->normals ? 2 : 1) * frames * sizeof *skin->data);
  lua_setfield(L, -2, "data");
  lua_pushlstring(L, (const char *)skin->triangle, 3 * skin->triangles * sizeof *skin->triangle);
  lua_setfield(L, -2, "triangles");
  lsw_set_integer(L, "corners", skin->corners);
  lsw_set_integer(L, "count", skin->triangles);
  lsw_set_flag(L, "normals", skin->normals);
  lua_createtable(L, 6 * (int)frames, 0);
  for (size_t i = 0; i < 6 * frames; i++) lsw_put_number(L, i, (double)skin->bounds[i]);
  lua_setfield(L, -2, "bounds");
}

/* core.skin(scene, wire from 0, frames, sides, thickness, differences) -> { data =, triangles =,
 * corners =, count =, normals =, bounds = }: see film/skin.h; data and triangles are little-endian
 * bytes. Nothing if no frame has the wire. */
static int mod_skin(lua_State *L) {
  const sw_scene *scene = lsw_check_scene(L);
  sw_error err = {""};
  sw_skin_args args = {.wire = (size_t)luaL_checkinteger(L, 2),
                       .sides = (size_t)luaL_checkinteger(L, 4),
                       .thickness = luaL_checknumber(L, 5),
                       .differences = lua_toboolean(L, 6)};
  if (args.sides < 3 || args.sides > 64) return luaL_error(L, "core.skin: 3 to 64 sides");
  sw_skin *skin = lsw_keep(L, sizeof *skin, "softworld.skin", NULL, free_skin);
  args.frames = frames_at(L, 3, scene, &args.count); /* last: a finaliser may clear frames */
  const sw_status status = sw_skin_make(scene, &args, sw_interrupted, skin, &err);
  if (status == SW_EINVAL) return 0;
  lsw_must(L, status, &err);
  push_skin(L, skin, args.count);
  sw_skin_free(skin);
  return 1;
}

/* core.edges(particles) -> bytes: edges of the surface, pairs of numbers from 0 (32 bits each) */
static int mod_edges(lua_State *L) {
  luaL_Buffer b;
  const lsw_self p = lsw_check_self(L, &lsw_class_particles);
  lsw_quiet(L);
  const size_t count = sw_scene_particles_edges(p.scene, p.id, NULL), size = 2 * sizeof(uint32_t);
  char *out = luaL_buffinitsize(L, &b, count * size);
  sw_scene_particles_edges(p.scene, p.id, (uint32_t *)(void *)out);
  luaL_pushresultsize(&b, count * size);
  return 1;
}

/* core.deflate(bytes) -> compressed bytes (zlib) */
static int mod_deflate(lua_State *L) {
  size_t size;
  sw_error err = {"out of memory for deflated data"};
  const char *bytes = luaL_checklstring(L, 1, &size);
  packer *p = lsw_keep(L, sizeof *p, "softworld.pack", NULL, free_pack);
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

/* The page's bytes; linked in by the Makefile, see PAGE. */
extern const char lsw_page_start[], lsw_page_end[];

/* core.page() -> the player's page, without data */
static int mod_page(lua_State *L) {
  lua_pushlstring(L, lsw_page_start, (size_t)(lsw_page_end - lsw_page_start));
  return 1;
}

const luaL_Reg lsw_module_film[] = {
    {"film", mod_film},     {"edges", mod_edges}, {"skin", mod_skin}, {"deflate", mod_deflate},
    {"base64", mod_base64}, {"page", mod_page},   {NULL, NULL}};
