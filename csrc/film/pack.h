/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compresses a stream of bytes (deflate, zlib format, RFC 1950); CRC-32 and base64. */
#ifndef SW_FILM_PACK_H
#define SW_FILM_PACK_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

typedef struct sw_pack sw_pack;

/* Makes a packer. SW_ENOMEM. */
sw_status sw_pack_new(sw_pack **out);
/* The same with less compression, in less time. */
sw_status sw_pack_new_fast(sw_pack **out);
void sw_pack_free(sw_pack *pack); /* NULL is allowed */
/* Adds bytes. After a failure it does nothing; sw_pack_end returns the failure. */
void sw_pack_put(sw_pack *pack, const void *bytes, size_t size);
/* Ends the stream and returns all compressed bytes, which the pack owns. SW_ENOMEM. */
sw_status sw_pack_end(sw_pack *pack, const unsigned char **bytes, size_t *size);

/* CRC-32 of bytes, as in PNG (ISO 3309). */
uint32_t sw_crc32(const void *bytes, size_t size);

/* Writes bytes as base64 text, 4 characters for 3 bytes (RFC 4648). out: room for
 * sw_base64_size(size) characters; no terminating zero is written. */
size_t sw_base64_size(size_t bytes);
void sw_base64(const unsigned char *bytes, size_t size, char *out);

#endif
