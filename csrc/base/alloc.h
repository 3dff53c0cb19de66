/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The core's allocator. It zeroes memory, checks for overflow and counts requests. It can
 * fail the n-th request, so that specs can test every out-of-memory path. */
#ifndef SW_BASE_ALLOC_H
#define SW_BASE_ALLOC_H

#include <stddef.h>
#include <string.h>

#include "base/status.h"

/* Returns count * size zeroed bytes, 64-byte aligned. NULL if memory runs out, if the
 * product overflows, or if this request is set to fail. A request of 0 bytes returns a
 * pointer that may be freed. Free with sw_free. */
void *sw_alloc(size_t count, size_t size);

/* Allocates several zeroed lists. After SW_ENOMEM some of them are NULL; their owner must free the
 * others. SW_TRY(SW_ALLOC_ALL(SW_ROOM(a->first, n + 1), SW_ROOM(a->next, n))); */
typedef struct sw_room {
  void *list; /* address of the list's pointer; NULL: end of the rooms */
  size_t count, size;
} sw_room;
#define SW_ROOM(list, count) \
  { &(list), count, sizeof *(list) }
#define SW_ALLOC_ALL(...) sw_alloc_all((const sw_room[]){__VA_ARGS__, {NULL, 0, 0}})
sw_status sw_alloc_all(const sw_room *rooms);

/* As sw_alloc, but the bytes are not zeroed: for memory that is written at once. */
void *sw_alloc_bytes(size_t bytes);

/* Frees p, which may be NULL. SW_FREE_ALL(a->first, a->next, a) frees all of them. */
void sw_free(void *p);
#define SW_FREE_ALL(...) \
  sw_free_all((void *const[]){__VA_ARGS__}, sizeof((void *const[]){__VA_ARGS__}) / sizeof(void *))
void sw_free_all(void *const *list, size_t count);

/* Makes the compiler free the block of a local pointer at the end of the pointer's scope, also
 * after return or break. Write it before the value: double *work SW_LOCAL = sw_alloc(n, sizeof
 * *work); */
#define SW_LOCAL __attribute__((cleanup(sw_free_local)))
static inline void sw_free_local(void *pointer) {
  void *p;
  memcpy(&p, pointer, sizeof p);
  sw_free(p);
}

/* Size of the block as requested [B]. */
size_t sw_alloc_size(const void *p);

/* Grows *p (*capacity items of this size) to at least need items, by doubling the
 * capacity. The old content stays, new content is zero. SW_ENOMEM changes nothing. */
sw_status sw_grow(void **p, size_t *capacity, size_t need, size_t size);
/* SW_GROW, SW_GROW_EMPTY and SW_FILL take a list and its capacity themselves, not their places. */
#define SW_GROW(p, capacity, need) sw_grow((void **)&(p), &(capacity), need, sizeof *(p))
/* The same for an array whose content is not needed: nothing is copied. After SW_ENOMEM the
 * capacity is 0. */
sw_status sw_grow_empty(void **p, size_t *capacity, size_t need, size_t size);
#define SW_GROW_EMPTY(p, capacity, need) \
  sw_grow_empty((void **)&(p), &(capacity), need, sizeof *(p))

/* The same, and fills it with `count` items from elsewhere. */
sw_status sw_fill(void **p, size_t *capacity, const void *from, size_t count, size_t size);
#define SW_FILL(p, capacity, from, count) \
  sw_fill((void **)&(p), &(capacity), from, count, sizeof *(p))

/* Exchanges two values of one type. */
#define SW_SWAP(a, b)                \
  do {                               \
    const __typeof__(a) swap_ = (a); \
    (a) = (b), (b) = swap_;          \
  } while (0)
/* Makes the n-th request from now fail (1 = the next one); 0 switches this off. */
void sw_alloc_fail_at(long n);

size_t sw_alloc_live(void);         /* bytes in use [B] */
size_t sw_alloc_count(void);        /* requests made since start [-] */
void sw_alloc_passed(size_t count); /* adds requests that a child process made [-] */

#endif
