/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws letters from outlines. scripts/font.lua takes the outlines from a font when this program is
 * built. Data: number of letters; for each letter, sorted by code point: code point, advance,
 * number of outlines; for each outline: number of points, points. All numbers have 16 bits,
 * little-endian; y points upwards. */
#include <stdlib.h>

#include "draw/draw.h"

extern const unsigned char sw_font_start[];

/* Sample lines in a pixel, most crossings of outlines on a line, font units of a letter's size. */
enum { ROWS = 5, CROSSINGS = 64, EM = 2048 };

static int u16(const unsigned char *p) { return p[0] | p[1] << 8; }
static int i16(const unsigned char *p) { return (int16_t)u16(p); }

static const unsigned char *letter(unsigned code) {
  const unsigned char *p = sw_font_start + 2;
  for (int left = u16(sw_font_start); left > 0; left--) {
    if ((unsigned)u16(p) == code) return p;
    const int outlines = u16(p + 4);
    p += 6;
    for (int k = 0; k < outlines; k++) p += 2 + 4 * u16(p);
  }
  return code == '?' ? sw_font_start + 2 : letter('?');
}

/* Returns the next code point; bytes that are not UTF-8 become question marks. */
static unsigned decode(const char **text, const char *end) {
  const unsigned char first = (unsigned char)*(*text)++;
  if (first < 0x80) return first;
  const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  unsigned code = first & (0x3fu >> more);
  for (int k = 0; k < more; k++) {
    if (*text == end || ((unsigned char)**text & 0xc0) != 0x80) return '?';
    code = code << 6 | ((unsigned char)*(*text)++ & 0x3f);
  }
  return more ? code : '?';
}

typedef struct crossing {
  double x;
  int turn;
} crossing;

static int by_x(const void *a, const void *b) {
  const double x = ((const crossing *)a)->x, y = ((const crossing *)b)->x;
  return (x > y) - (x < y);
}

/* Finds where the outlines of a letter cross a line. x, y: the letter's origin [px]; s: size of a
 * font unit [px]. Returns the number of crossings, sorted by x. */
static int cross(const unsigned char *p, double line, double x, double y, double s, crossing *out) {
  const int outlines = u16(p + 4);
  int n = 0;
  p += 6;
  for (int o = 0; o < outlines; o++) {
    const int count = u16(p);
    for (int k = 0; k < count; k++) {
      const unsigned char *a = p + 2 + 4 * k, *b = p + 2 + 4 * ((k + 1) % count);
      const double ya = y - s * i16(a + 2), yb = y - s * i16(b + 2);
      if ((ya <= line) == (yb <= line) || n == CROSSINGS) continue;
      const double xa = x + s * i16(a), xb = x + s * i16(b);
      out[n++] = (crossing){xa + (line - ya) / (yb - ya) * (xb - xa), ya < yb ? 1 : -1};
    }
    p += 2 + 4 * count;
  }
  qsort(out, (size_t)n, sizeof *out, by_x);
  return n;
}

/* Mixes a share of a colour into a pixel. */
static void mix(sw_canvas *c, size_t x, size_t y, double share, const float colour[3]) {
  uint8_t *dot = c->rgb + 3 * (c->width * y + x);
  for (int k = 0; k < 3; k++)
    dot[k] = (uint8_t)(dot[k] + share * (255 * (double)colour[k] - dot[k]) + 0.5);
}

static void span(sw_canvas *c, size_t y, double from, double to, const float colour[3]) {
  from = fmax(from, 0), to = fmin(to, (double)c->width);
  for (size_t x = (size_t)from; (double)x < to; x++) {
    const double part = fmin(to, (double)x + 1) - fmax(from, (double)x);
    if (part > 0) mix(c, x, y, part / ROWS, colour);
  }
}

static void draw_letter(sw_canvas *c, const unsigned char *p, double x, double y, double s,
                        const float colour[3]) {
  crossing at[CROSSINGS];
  const double top = fmax(0, y - 1.1 * EM * s), end = fmin((double)c->height, y + 0.4 * EM * s);
  for (size_t row = (size_t)top; (double)row < end; row++)
    for (int k = 0; k < ROWS; k++) {
      const int n = cross(p, (double)row + (k + 0.5) / ROWS, x, y, s, at);
      int inside = 0;
      for (int i = 0; i + 1 < n; i++) {
        inside += at[i].turn;
        if (inside) span(c, row, at[i].x, at[i + 1].x, colour);
      }
    }
}

double sw_canvas_text(sw_canvas *canvas, const char *utf8, size_t bytes, double x, double y,
                      double size, const float colour[3]) {
  const char *end = utf8 + bytes;
  const double s = size / EM, start = x;
  while (utf8 != end) {
    const unsigned char *p = letter(decode(&utf8, end));
    if (canvas) draw_letter(canvas, p, x, y, s, colour);
    x += s * u16(p + 2);
  }
  return x - start;
}
