/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and checks lines of a study's journal.
 *
 *   core.checksum(text) -> integer
 *   core.journal_line(text, at) -> where the next line begins, first letter of the line at `at`;
 * for lines "e <part> <number> ..." also part and number. Nothing if the text ends within the line.
 * The letter is false if the line's checksum is wrong. */
#include <lauxlib.h>
#include <string.h>

enum { DIGITS = 16 }; /* of the checksum at a line's end, after a space */

/* FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo). It finds damaged lines; it is no protection
 * against forged ones. */
static uint64_t checksum(const char *text, size_t size) {
  uint64_t sum = 0xcbf29ce484222325u;
  for (size_t k = 0; k < size; k++) sum = (sum ^ (unsigned char)text[k]) * 0x100000001b3u;
  return sum;
}

static int mod_checksum(lua_State *L) {
  size_t size;
  const char *text = luaL_checklstring(L, 1, &size);
  lua_pushinteger(L, (lua_Integer)checksum(text, size));
  return 1;
}

static int is_whole(const char *line, size_t size) {
  if (size < DIGITS + 2 || line[size - DIGITS - 1] != ' ') return 0;
  uint64_t sum = checksum(line, size - DIGITS - 1);
  for (const char *at = line + size - 1; at >= line + size - DIGITS; at--, sum >>= 4)
    if (*at != "0123456789abcdef"[sum & 15]) return 0;
  return 1;
}

/* Returns the integer at *at and moves *at past it and the space behind it. 0 if there are no
 * digits or more than 18, or no space. */
static lua_Integer integer(const char **at) {
  lua_Integer value = 0;
  int digits = 0;
  for (; **at >= '0' && **at <= '9' && digits < 18; (*at)++, digits++)
    value = 10 * value + (**at - '0');
  return digits > 0 && *(*at)++ == ' ' ? value : 0;
}

static int mod_line(lua_State *L) {
  size_t size;
  const char *text = luaL_checklstring(L, 1, &size);
  const lua_Integer from = luaL_checkinteger(L, 2);
  if (from < 1 || (size_t)from > size) return 0;
  const char *line = text + from - 1, *end = memchr(line, '\n', size - (size_t)from + 1);
  if (!end) return 0;
  lua_pushinteger(L, end - text + 2);
  if (!is_whole(line, (size_t)(end - line))) {
    lua_pushboolean(L, 0);
    return 2;
  }
  lua_pushlstring(L, line, 1);
  if (strncmp(line, "e ", 2) != 0) return 2;
  line += 2;
  lua_pushinteger(L, integer(&line));
  lua_pushinteger(L, integer(&line));
  return 4;
}

const luaL_Reg lsw_module_journal[] = {
    {"checksum", mod_checksum}, {"journal_line", mod_line}, {NULL, NULL}};
