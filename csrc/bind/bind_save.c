/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Saves scenes to strings and loads them from strings, which the Lua side writes to files and reads
 * from files. Numbers objects, so that they are found again in a loaded scene. */
#include <stdint.h>
#include <string.h>

#include "bind/child.h"
#include "bind/mesh_child.h"

typedef struct block {
  unsigned char *bytes;
  size_t size;
} block;

static int push_block(lua_State *L) {
  const block *b = lua_touserdata(L, 1);
  lua_pushlstring(L, (const char *)b->bytes, b->size);
  return 1;
}

static int give_block(lua_State *L, block *b) {
  lua_pushcfunction(L, push_block); /* protected, so that the block is always freed */
  lua_pushlightuserdata(L, b);
  const int status = lua_pcall(L, 1, 1, 0);
  sw_free(b->bytes);
  return status == LUA_OK ? 1 : lua_error(L);
}

/* core.save(scene, note) -> string */
static int mod_save(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  block b = {NULL, 0};
  size_t note_size;
  const char *note = luaL_checklstring(L, 2, &note_size);
  LSW_DO(L, sw_scene_save, scene, note, note_size, &b.bytes, &b.size);
  return give_block(L, &b);
}

/* core.saved_note(string) -> the note */
static int mod_saved_note(lua_State *L) {
  size_t size, note_size;
  const void *note;
  const char *bytes = luaL_checklstring(L, 1, &size);
  LSW_DO(L, sw_saved_note, bytes, size, &note, &note_size);
  lua_pushlstring(L, note, note_size);
  return 1;
}

/* core.load(string) -> scene */
static int mod_load(lua_State *L) {
  size_t size;
  sw_scene *scene = NULL;
  const char *bytes = luaL_checklstring(L, 1, &size);
  lsw_handle *h = lsw_new_scene(L);
  lsw_mesh_child_for(L);
  LSW_DO(L, sw_scene_load, bytes, size, &scene);
  h->object = scene;
  return 1;
}

/* core.resume(scene, string): continues the saved run in this scene */
static int mod_resume(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  size_t size;
  const char *bytes = luaL_checklstring(L, 2, &size);
  lsw_mesh_child_for(L);
  LSW_DO(L, sw_scene_resume, scene, bytes, size);
  lsw_forget_forces(L, 1, scene);
  return 0;
}

/* core.items(scene) -> { "wire 'a'", checksum, "box 'b'", checksum, ... } */
static int mod_items(lua_State *L) {
  sw_scene *scene = lsw_check_scene(L);
  lsw_quiet(L);
  lua_newtable(L);
  for (size_t k = 0; k < sw_scene_items(scene); k++) {
    const sw_scene_item item = sw_scene_item_at(scene, k);
    lua_pushfstring(L, "%s '%s'", item.kind, item.name);
    lua_rawseti(L, -2, 2 * (lua_Integer)k + 1);
    lua_pushinteger(L, (lua_Integer)item.sum);
    lua_rawseti(L, -2, 2 * (lua_Integer)k + 2);
  }
  return 1;
}

static const lsw_class *const children[] = {
    &lsw_class_wire,  &lsw_class_particles, &lsw_class_clamp, &lsw_class_obstacle,
    &lsw_class_force, &lsw_class_join,      &lsw_class_tool};
enum { CHILDREN = sizeof children / sizeof children[0] };

/* The object's slot; for a wire or an object of particles, whose slots change, its number in
 * frames. */
static size_t slot_of(const lsw_class *c, const lsw_child *child) {
  const sw_scene *scene = ((const lsw_scene_handle *)child->h.object)->h.object;
  if (!scene || c->kind != SW_OF_BODY) return child->id.slot;
  const size_t number = sw_scene_body_number(scene, child->id);
  return number == SIZE_MAX ? UINT32_MAX : number;
}

/* core.number(object) -> class, slot, generation, scene; nothing for any other value */
static int mod_number(lua_State *L) {
  const lsw_class *c = lsw_class_of(L, 1);
  for (int k = 0; c && k < CHILDREN; k++) {
    if (children[k] != c) continue;
    const lsw_child *child = lua_touserdata(L, 1);
    lua_pushstring(L, c->name);
    lua_pushinteger(L, (lua_Integer)slot_of(c, child));
    lua_pushinteger(L, child->id.generation);
    lua_getiuservalue(L, 1, 1);
    return 4;
  }
  return 0;
}

/* core.numbered(scene, class, slot, generation) -> the object with these numbers. It is not checked
 * whether the scene has it. */
static int mod_numbered(lua_State *L) {
  lsw_check_scene(L);
  const char *name = luaL_checkstring(L, 2);
  const lua_Integer slot = lsw_integer(L, 3, "numbered: the slot"),
                    generation = lsw_integer(L, 4, "numbered: the generation");
  for (int k = 0; k < CHILDREN; k++) {
    if (strcmp(children[k]->name, name) != 0) continue;
    lsw_child *child = lsw_new_child(L, children[k]);
    child->id = (sw_handle){(uint32_t)slot, (uint32_t)generation};
    return 1;
  }
  return luaL_error(L, "a scene has no objects of class '%s'", name);
}

const luaL_Reg lsw_module_save[] = {{"save", mod_save},         {"saved_note", mod_saved_note},
                                    {"load", mod_load},         {"resume", mod_resume},
                                    {"items", mod_items},       {"number", mod_number},
                                    {"numbered", mod_numbered}, {NULL, NULL}};
