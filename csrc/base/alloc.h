/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The core's allocator: zeroed, overflow-checked, counted, and able to fail
 * the n-th request so that specs can walk every out-of-memory path. */
#ifndef SW_BASE_ALLOC_H
#define SW_BASE_ALLOC_H

#include <stddef.h>
#include <string.h>

#include "base/status.h"

/* count * size zeroed bytes, 64-byte aligned; NULL when memory runs out, when
 * the product overflows or when this is the request chosen to fail. A request
 * of 0 bytes gives a pointer that may be freed. Free with sw_free. */
void *sw_alloc(size_t count, size_t size);

/* Zeroed room for lists that are made together. SW_ENOMEM: some of them are NULL; the others stay
 * their owner's. SW_TRY(SW_ALLOC_ALL(SW_ROOM(a->first, n + 1), SW_ROOM(a->next, n))); */
typedef struct sw_room {
  void *list; /* where the pointer is; NULL ends them */
  size_t count, size;
} sw_room;
#define SW_ROOM(list, count) \
  { &(list), count, sizeof *(list) }
#define SW_ALLOC_ALL(...) sw_alloc_all((const sw_room[]){__VA_ARGS__, {NULL, 0, 0}})
sw_status sw_alloc_all(const sw_room *rooms);

/* As sw_alloc, of bytes that are not zero, for what is written at once. */
void *sw_alloc_bytes(size_t bytes);

/* NULL is allowed. SW_FREE_ALL(a->first, a->next, a): all of them. */
void sw_free(void *p);
#define SW_FREE_ALL(...) \
  sw_free_all((void *const[]){__VA_ARGS__}, sizeof((void *const[]){__VA_ARGS__}) / sizeof(void *))
void sw_free_all(void *const *list, size_t count);

/* Of a local pointer, before its value: what it points to then is freed when its block ends,
 * however it ends. double *work SW_LOCAL = sw_alloc(n, sizeof *work); */
#define SW_LOCAL __attribute__((cleanup(sw_free_local)))
static inline void sw_free_local(void *pointer) {
  void *p;
  memcpy(&p, pointer, sizeof p);
  sw_free(p);
}

/* Bytes that were asked for [B]. */
size_t sw_alloc_size(const void *p);

/* Grow *p (count *capacity of size) so that it holds at least need items,
 * doubling; old content is kept, new content is zero. SW_ENOMEM leaves both
 * untouched. */
sw_status sw_grow(void **p, size_t *capacity, size_t need, size_t size);
/* The same for an empty array: nothing is copied. After SW_ENOMEM it has no capacity. */
sw_status sw_grow_empty(void **p, size_t *capacity, size_t need, size_t size);

/* Exchange two values of one type. */
#define SW_SWAP(a, b)                \
  do {                               \
    const __typeof__(a) swap_ = (a); \
    (a) = (b), (b) = swap_;          \
  } while (0)
/* Fail the n-th request from now (1 = the next one); 0 switches this off. */
void sw_alloc_fail_at(long n);

size_t sw_alloc_live(void);         /* bytes in use [B] */
size_t sw_alloc_count(void);        /* requests made since start [-] */
void sw_alloc_passed(size_t count); /* that many were made for this process by another one */

#endif
