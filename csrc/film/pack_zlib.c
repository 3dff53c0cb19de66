/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compression (zlib), CRC-32 and base64. */
#include <stdint.h>
#include <string.h>
#include <zlib.h>

#include "base/alloc.h"
#include "film/pack.h"

enum { LEVEL = 6, FAST = 3, ROOM = 1 << 16 };

struct sw_pack {
  z_stream z;
  unsigned char in[ROOM];
  size_t waiting; /* bytes in `in` */
  unsigned char *out;
  size_t size, capacity;
  sw_status status;
};

static void *take(void *unused SW_UNUSED, unsigned count, unsigned size) {
  return sw_alloc(count, size);
}

static void give(void *unused SW_UNUSED, void *p) { sw_free(p); }

static sw_status pack_new(sw_pack **out, int level) {
  sw_pack *p = sw_alloc(1, sizeof *p);
  if (!p) return SW_ENOMEM;
  p->z.zalloc = take, p->z.zfree = give;
  if (deflateInit(&p->z, level) != Z_OK) {
    sw_free(p);
    return SW_ENOMEM;
  }
  *out = p;
  return SW_OK;
}

sw_status sw_pack_new(sw_pack **out) { return pack_new(out, LEVEL); }
sw_status sw_pack_new_fast(sw_pack **out) { return pack_new(out, FAST); }

void sw_pack_free(sw_pack *p) {
  if (!p) return;
  deflateEnd(&p->z);
  sw_free(p->out);
  sw_free(p);
}

static void squeeze(sw_pack *p, int flush) {
  p->z.next_in = p->in, p->z.avail_in = (unsigned)p->waiting;
  p->waiting = 0;
  do {
    if (p->status == SW_OK) p->status = SW_GROW(p->out, p->capacity, p->size + ROOM);
    if (p->status != SW_OK) return;
    p->z.next_out = p->out + p->size, p->z.avail_out = ROOM;
    (void)deflate(&p->z, flush); /* Z_BUF_ERROR only means that nothing was left to do */
    p->size += ROOM - p->z.avail_out;
  } while (p->z.avail_out == 0);
}

void sw_pack_put(sw_pack *p, const void *bytes, size_t size) {
  const unsigned char *from = bytes;
  while (size && p->status == SW_OK) {
    const size_t part = size < ROOM - p->waiting ? size : ROOM - p->waiting;
    memcpy(p->in + p->waiting, from, part);
    p->waiting += part, from += part, size -= part;
    if (p->waiting == ROOM) squeeze(p, Z_NO_FLUSH);
  }
}

sw_status sw_pack_end(sw_pack *p, const unsigned char **bytes, size_t *size) {
  squeeze(p, Z_FINISH);
  *bytes = p->out, *size = p->size;
  return p->status;
}

uint32_t sw_crc32(const void *bytes, size_t size) { return (uint32_t)crc32_z(0, bytes, size); }

size_t sw_base64_size(size_t bytes) { return (bytes + 2) / 3 * 4; }

void sw_base64(const unsigned char *b, size_t size, char *out) {
  static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < size; i += 3) {
    const size_t left = size - i;
    const uint32_t three = (uint32_t)b[i] << 16 | (left > 1 ? (uint32_t)b[i + 1] << 8 : 0) |
                           (left > 2 ? (uint32_t)b[i + 2] : 0);
    *out++ = digit[three >> 18], *out++ = digit[three >> 12 & 63];
    *out++ = left > 1 ? digit[three >> 6 & 63] : '=', *out++ = left > 2 ? digit[three & 63] : '=';
  }
}
