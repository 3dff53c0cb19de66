/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawings and canvases for softworld.output.picture. Lists are flat: x, y, z, x, ... */
#include "bind/child.h"
#include "bind/class.h"

static const char *const DRAWING = "softworld.drawing";
static const char *const CANVAS = "softworld.canvas";
static const char *const BUFFER = "softworld.drawn";

/* Owns bytes, so that they are freed when Lua raises an error. */
typedef struct keeper {
  void *bytes;
} keeper;

static int free_keeper(lua_State *L) {
  keeper *k = lua_touserdata(L, 1);
  sw_free(k->bytes);
  k->bytes = NULL;
  return 0;
}

static keeper *keep(lua_State *L) { return lsw_keep(L, sizeof(keeper), BUFFER, NULL, free_keeper); }

static void *room(lua_State *L, keeper *k, size_t count, size_t size) {
  k->bytes = sw_alloc(count, size);
  if (!k->bytes) lsw_raise(L, SW_ENOMEM, NULL);
  return k->bytes;
}

static void must(lua_State *L, sw_status status, const char *what) {
  sw_error err;
  if (status == SW_OK) return;
  if (status == SW_EINVAL)
    (void)sw_fail(&err, status, "%s: numbers that are not finite, or out of range", what);
  else
    (void)sw_fail(&err, status, "%s: %s", what, sw_status_text(status));
  lsw_must(L, status, &err);
}

/* --- arguments ---------------------------------------------------------------------- */

static double item(lua_State *L, int index, lua_Integer i) {
  lua_rawgeti(L, index, i);
  const double x = lua_tonumber(L, -1);
  lua_pop(L, 1);
  return x;
}

/* Returns a flat list as groups of `each` numbers; pushes the userdata that owns it. */
static double *numbers(lua_State *L, int index, size_t each, size_t *groups) {
  luaL_checktype(L, index, LUA_TTABLE);
  const size_t n = lua_rawlen(L, index) / each * each;
  double *out = room(L, keep(L), n, sizeof *out);
  for (size_t i = 0; i < n; i++) out[i] = item(L, index, (lua_Integer)i + 1);
  *groups = n / each;
  return out;
}

static sw_vec vector_at(lua_State *L, int index) {
  luaL_checktype(L, index, LUA_TTABLE);
  return sw_v(item(L, index, 1), item(L, index, 2), item(L, index, 3));
}

static void colour_at(lua_State *L, int index, float out[3]) {
  luaL_checktype(L, index, LUA_TTABLE);
  for (int c = 0; c < 3; c++) out[c] = (float)item(L, index, c + 1);
}

static float gloss_at(lua_State *L, int index) {
  return lua_isnumber(L, index) ? (float)lua_tonumber(L, index) : 0;
}

/* Returns the paint at index: one colour, or three numbers for each of count points; the next
 * argument is the gloss. */
static sw_paint paint_at(lua_State *L, int index, size_t count) {
  sw_paint paint = {.gloss = gloss_at(L, index + 1)};
  luaL_checktype(L, index, LUA_TTABLE);
  colour_at(L, index, paint.colour);
  const size_t given = lua_rawlen(L, index);
  if (given <= 3 || given < 3 * count) return paint;
  float *colours = room(L, keep(L), 3 * count, sizeof *colours);
  for (size_t i = 0; i < 3 * count; i++) colours[i] = (float)item(L, index, (lua_Integer)i + 1);
  paint.colours = colours;
  return paint;
}

static sw_drawing *drawing_at(lua_State *L, int index) {
  sw_drawing *d = *(sw_drawing **)luaL_checkudata(L, index, DRAWING);
  if (!d) luaL_error(L, "the drawing is gone");
  return d;
}

static sw_camera camera_at(lua_State *L, int index) {
  sw_camera c;
  sw_vec *const to[5] = {&c.at, &c.forward, &c.right, &c.up, &c.sky};
  static const char *const names[5] = {"at", "forward", "right", "up", "sky"};
  luaL_checktype(L, index, LUA_TTABLE);
  for (int k = 0; k < 5; k++) {
    lua_getfield(L, index, names[k]);
    *to[k] = vector_at(L, lua_gettop(L));
    lua_pop(L, 1);
    if (!sw_finite(*to[k])) luaL_error(L, "camera: %s is not finite", names[k]);
  }
  lua_getfield(L, index, "tx"), lua_getfield(L, index, "ty");
  c.tx = lua_tonumber(L, -2), c.ty = lua_tonumber(L, -1);
  lua_pop(L, 2);
  if (!(c.tx > 0 && c.ty > 0 && c.tx < HUGE_VAL && c.ty < HUGE_VAL))
    luaL_error(L, "camera: its angles are wrong");
  return c;
}

static sw_technique technique_at(lua_State *L, int index) {
  static const char *const names[] = {"shaded", "particles", "wireframe", NULL};
  return (sw_technique)luaL_checkoption(L, index, "shaded", names);
}

/* --- drawings ------------------------------------------------------------------------- */

static int free_drawing(lua_State *L) {
  sw_drawing **d = lua_touserdata(L, 1);
  sw_drawing_free(*d);
  *d = NULL;
  return 0;
}

/* drawing:mesh(points, corners from 0, position, rotation, colour, gloss) */
static int meth_mesh(lua_State *L) {
  sw_drawing *d = drawing_at(L, 1);
  size_t points, triangles;
  sw_pose pose = {vector_at(L, 4), sw_quat_identity()};
  luaL_checktype(L, 5, LUA_TTABLE);
  pose.q = sw_quat_unit((sw_quat){item(L, 5, 1), item(L, 5, 2), item(L, 5, 3), item(L, 5, 4)});
  const double *p = numbers(L, 2, 3, &points);
  luaL_checktype(L, 3, LUA_TTABLE);
  triangles = lua_rawlen(L, 3) / 3;
  uint32_t *corners = room(L, keep(L), 3 * triangles, sizeof *corners);
  for (size_t i = 0; i < 3 * triangles; i++) {
    const double corner = item(L, 3, (lua_Integer)i + 1);
    corners[i] = corner >= 0 && corner < 4e9 ? (uint32_t)corner : UINT32_MAX;
  }
  const sw_paint paint = paint_at(L, 6, points);
  must(L, sw_drawing_mesh(d, p, points, corners, triangles, pose, &paint), "drawing: mesh");
  return 0;
}

static int draw_round(lua_State *L, const char *what, __typeof__(sw_drawing_tube) *draw) {
  sw_drawing *d = drawing_at(L, 1);
  size_t count;
  const double *p = numbers(L, 2, 3, &count), radius = luaL_checknumber(L, 3);
  const sw_paint paint = paint_at(L, 4, count);
  must(L, draw(d, p, count, radius, &paint), what);
  return 0;
}

/* drawing:tube, drawing:balls(points, radius, colour or colours, gloss) */
static int meth_tube(lua_State *L) { return draw_round(L, "drawing: tube", sw_drawing_tube); }
static int meth_balls(lua_State *L) { return draw_round(L, "drawing: balls", sw_drawing_balls); }

/* drawing:lines(points, colour or colours of the points): two points for each line */
static int meth_lines(lua_State *L) {
  sw_drawing *d = drawing_at(L, 1);
  size_t count;
  const double *p = numbers(L, 2, 6, &count);
  const sw_paint paint = paint_at(L, 3, 2 * count);
  must(L, sw_drawing_lines(d, p, count, &paint), "drawing: lines");
  return 0;
}

/* drawing:floor(point, normal, side of its squares [m], reach [m], colour) */
static int meth_floor(lua_State *L) {
  sw_drawing *d = drawing_at(L, 1);
  const sw_vec point = vector_at(L, 2), normal = vector_at(L, 3);
  const double square = luaL_checknumber(L, 4), reach = luaL_checknumber(L, 5);
  const sw_paint paint = paint_at(L, 6, 0);
  must(L, sw_drawing_floor(d, point, normal, square, reach, &paint), "drawing: floor");
  return 0;
}

/* drawing:svg(camera, technique, width, height) -> text */
static int meth_svg(lua_State *L) {
  const sw_drawing *d = drawing_at(L, 1);
  const sw_camera camera = camera_at(L, 2);
  const sw_technique technique = technique_at(L, 3);
  const double width = luaL_checknumber(L, 4), height = luaL_checknumber(L, 5);
  keeper *k = keep(L);
  char *text = NULL;
  size_t size = 0;
  const sw_status status =
      sw_drawing_svg(d, &camera, technique, width, height, sw_interrupted, &text, &size);
  k->bytes = text;
  must(L, status, "picture");
  lua_pushlstring(L, text, size);
  return 1;
}

/* --- canvases ------------------------------------------------------------------------- */

static int free_canvas(lua_State *L) {
  sw_canvas_free(lua_touserdata(L, 1));
  return 0;
}

static sw_canvas *canvas_at(lua_State *L, int index) {
  sw_canvas *c = luaL_checkudata(L, index, CANVAS);
  if (!c->rgb) luaL_error(L, "the canvas is gone");
  return c;
}

static size_t size_at(lua_State *L, int index) {
  const double x = luaL_checknumber(L, index);
  return x >= 0 && x <= SW_CANVAS_MOST ? (size_t)x : 0;
}

static sw_canvas_part window_at(lua_State *L, int index) {
  const size_t x = size_at(L, index), y = size_at(L, index + 1);
  return (sw_canvas_part){x, y, size_at(L, index + 2), size_at(L, index + 3)};
}

/* canvas:show(drawing, camera, technique, x, y, width, height) */
static int meth_show(lua_State *L) {
  sw_canvas *canvas = canvas_at(L, 1);
  const sw_drawing *d = drawing_at(L, 2);
  const sw_camera camera = camera_at(L, 3);
  const sw_technique technique = technique_at(L, 4);
  const sw_canvas_part window = window_at(L, 5);
  must(L, sw_canvas_show(canvas, window, d, &camera, technique, sw_interrupted), "picture");
  return 0;
}

/* canvas:fill(x, y, width, height, colour) */
static int meth_fill(lua_State *L) {
  float colour[3];
  sw_canvas *canvas = canvas_at(L, 1);
  colour_at(L, 6, colour);
  sw_canvas_fill(canvas, window_at(L, 2), colour);
  return 0;
}

/* canvas:text(text, x, y, size, colour) -> width of the text [px] */
static int meth_text(lua_State *L) {
  float colour[3];
  size_t bytes;
  sw_canvas *canvas = canvas_at(L, 1);
  const char *text = luaL_checklstring(L, 2, &bytes);
  colour_at(L, 6, colour);
  lua_pushnumber(L, sw_canvas_text(canvas, text, bytes, luaL_checknumber(L, 3),
                                   luaL_checknumber(L, 4), luaL_checknumber(L, 5), colour));
  return 1;
}

/* canvas:png() -> bytes */
static int meth_png(lua_State *L) {
  const sw_canvas *canvas = canvas_at(L, 1);
  keeper *k = keep(L);
  uint8_t *bytes = NULL;
  size_t size = 0;
  const sw_status status = sw_canvas_png(canvas, &bytes, &size);
  k->bytes = bytes;
  must(L, status, "picture");
  lua_pushlstring(L, (const char *)bytes, size);
  return 1;
}

/* canvas:rgb() -> three bytes for each pixel, row by row from the top */
static int meth_rgb(lua_State *L) {
  const sw_canvas *canvas = canvas_at(L, 1);
  lua_pushlstring(L, (const char *)canvas->rgb, 3 * canvas->width * canvas->height);
  return 1;
}

/* --- the module ------------------------------------------------------------------------- */

static const luaL_Reg drawing_methods[] = {
    {"mesh", meth_mesh},   {"tube", meth_tube}, {"balls", meth_balls}, {"lines", meth_lines},
    {"floor", meth_floor}, {"svg", meth_svg},   {NULL, NULL}};
static const luaL_Reg canvas_methods[] = {{"show", meth_show}, {"fill", meth_fill},
                                          {"text", meth_text}, {"png", meth_png},
                                          {"rgb", meth_rgb},   {NULL, NULL}};

/* core.drawing() -> an empty drawing */
static int mod_drawing(lua_State *L) {
  sw_drawing **d = lsw_keep(L, sizeof(void *), DRAWING, drawing_methods, free_drawing);
  must(L, sw_drawing_new(d), "drawing");
  return 1;
}

/* core.canvas(width, height) -> a white canvas of this size [px] */
static int mod_canvas(lua_State *L) {
  const size_t width = size_at(L, 1), height = size_at(L, 2);
  sw_canvas *canvas = lsw_keep(L, sizeof *canvas, CANVAS, canvas_methods, free_canvas);
  must(L, sw_canvas_new(width, height, canvas), "canvas");
  return 1;
}

/* core.text_width(text, size) -> width [px] */
static int mod_text_width(lua_State *L) {
  size_t bytes;
  const char *text = luaL_checklstring(L, 1, &bytes);
  lua_pushnumber(L, sw_canvas_text(NULL, text, bytes, 0, 0, luaL_checknumber(L, 2), NULL));
  return 1;
}

const luaL_Reg lsw_module_draw[] = {
    {"drawing", mod_drawing}, {"canvas", mod_canvas}, {"text_width", mod_text_width}, {NULL, NULL}};
