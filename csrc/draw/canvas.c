/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A picture's pixels, and its file as PNG (ISO/IEC 15948). */
#include <string.h>

#include "base/alloc.h"
#include "draw/show.h"
#include "film/pack.h"

static const double MOST = 25e6; /* most pixels of a canvas; shading takes 40 bytes a pixel [px] */

sw_status sw_canvas_new(size_t width, size_t height, sw_canvas *out) {
  if (!width || !height || width > SW_CANVAS_MOST || height > SW_CANVAS_MOST ||
      (double)width * (double)height > MOST)
    return SW_EINVAL;
  *out = (sw_canvas){width, height, sw_alloc_bytes(3 * width * height)};
  if (!out->rgb) return SW_ENOMEM;
  memset(out->rgb, 255, 3 * width * height);
  return SW_OK;
}

void sw_canvas_free(sw_canvas *canvas) {
  sw_free(canvas->rgb);
  canvas->rgb = NULL;
}

sw_status sw_canvas_show(sw_canvas *canvas, sw_canvas_part w, const sw_drawing *d,
                         const sw_camera *camera, sw_technique technique,
                         int (*interrupted)(void)) {
  if (!w.width || !w.height || w.x > canvas->width || w.y > canvas->height ||
      w.width > canvas->width - w.x || w.height > canvas->height - w.y)
    return SW_EINVAL;
  return technique == SW_DRAW_WIREFRAME ? sw_show_wireframe(canvas, w, d, camera, interrupted)
                                        : sw_show_shaded(canvas, w, d, camera, interrupted);
}

void sw_canvas_fill(sw_canvas *canvas, sw_canvas_part w, const float colour[3]) {
  const size_t right = w.x + w.width < canvas->width ? w.x + w.width : canvas->width;
  const size_t below = w.y + w.height < canvas->height ? w.y + w.height : canvas->height;
  for (size_t y = w.y; y < below; y++)
    for (size_t x = w.x; x < right; x++)
      for (size_t c = 0; c < 3; c++)
        canvas->rgb[3 * (canvas->width * y + x) + c] =
            (uint8_t)(255 * fminf(1, fmaxf(0, colour[c])) + 0.5f);
}

/* --- PNG (ISO/IEC 15948): a header, the compressed rows, an end --------------------------- */

static uint8_t *put32(uint8_t *to, size_t x) {
  for (int k = 0; k < 4; k++) *to++ = (uint8_t)(x >> (24 - 8 * k));
  return to;
}

static uint8_t *put_chunk(uint8_t *to, const char *kind, const uint8_t *data, size_t size) {
  uint8_t *const from = put32(to, size);
  memcpy(from, kind, 4);
  if (size) memcpy(from + 4, data, size);
  return put32(from + 4 + size, sw_crc32(from, size + 4));
}

/* Writes a row as differences from the pixels to the left (kind 1) or above (2). Returns the sum of
 * their magnitudes. */
static size_t filter(const uint8_t *row, const uint8_t *above, size_t size, uint8_t kind,
                     uint8_t *out) {
  size_t sum = 0;
  *out++ = kind;
  for (size_t i = 0; i < size; i++) {
    const uint8_t guess = kind == 1 ? (i < 3 ? 0 : row[i - 3]) : above ? above[i] : 0;
    out[i] = (uint8_t)(row[i] - guess);
    sum += out[i] < 128 ? out[i] : 256u - out[i];
  }
  return sum;
}

static sw_status put_rows(const sw_canvas *canvas, sw_pack *pack) {
  const size_t size = 3 * canvas->width;
  uint8_t *left = sw_alloc_bytes(2 * (size + 1)), *up = left ? left + size + 1 : NULL;
  if (!left) return SW_ENOMEM;
  for (size_t y = 0; y < canvas->height; y++) {
    const uint8_t *row = canvas->rgb + size * y;
    const size_t a = filter(row, NULL, size, 1, left);
    const size_t b = filter(row, y ? row - size : NULL, size, 2, up);
    sw_pack_put(pack, a < b ? left : up, size + 1);
  }
  sw_free(left);
  return SW_OK;
}

sw_status sw_canvas_png(const sw_canvas *canvas, uint8_t **bytes, size_t *size) {
  static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  uint8_t head[13] = {0}, *to;
  const unsigned char *rows;
  size_t count;
  sw_pack *pack;
  SW_TRY(sw_pack_new_fast(&pack));
  sw_status status = put_rows(canvas, pack);
  if (status == SW_OK) status = sw_pack_end(pack, &rows, &count);
  if (status == SW_OK && !(*bytes = sw_alloc_bytes(count + 8 + 3 * 12 + sizeof head)))
    status = SW_ENOMEM;
  if (status == SW_OK) {
    put32(put32(head, canvas->width), canvas->height);
    head[8] = 8, head[9] = 2; /* bits of a number; colour type red, green, blue */
    memcpy(*bytes, signature, 8);
    to = put_chunk(*bytes + 8, "IHDR", head, sizeof head);
    to = put_chunk(to, "IDAT", rows, count);
    *size = (size_t)(put_chunk(to, "IEND", NULL, 0) - *bytes);
  }
  sw_pack_free(pack);
  return status;
}
