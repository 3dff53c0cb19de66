/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bytes that become fewer on their way: deflated as they come (RFC 1950), by zlib. */
#ifndef SW_FILM_PACK_H
#define SW_FILM_PACK_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

typedef struct sw_pack sw_pack;

/* SW_ENOMEM. */
sw_status sw_pack_new(sw_pack **out);
/* The same for what is wanted at once rather than small. */
sw_status sw_pack_new_fast(sw_pack **out);
void sw_pack_free(sw_pack *pack); /* NULL is allowed */
/* After a failure nothing more is taken; sw_pack_end tells. */
void sw_pack_put(sw_pack *pack, const void *bytes, size_t size);
/* The rest; then the bytes, the pack's own. SW_ENOMEM. */
sw_status sw_pack_end(sw_pack *pack, const unsigned char **bytes, size_t *size);

/* Check of bytes as PNG has it (ISO 3309). */
uint32_t sw_crc32(const void *bytes, size_t size);

/* Text of 4 characters for 3 bytes each (RFC 4648); out: room for sw_base64_size of them, without
 * an end. */
size_t sw_base64_size(size_t bytes);
void sw_base64(const unsigned char *bytes, size_t size, char *out);

#endif
