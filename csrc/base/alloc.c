/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocator. Each block has its size in the 64 bytes before it; large blocks come zeroed from the
 * system. */
#include "base/alloc.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { ALIGNMENT = 64 }; /* one cache line and the widest vector [B] */
/* Blocks of at least this size come zeroed from the system, which zeroes each page at its first
 * use. So a large block does not delay the answer to Ctrl-C [B]. */
enum { LARGE = 1 << 20 };
/* Blocks of at least this size ask for pages of 2 MB: 100,000 nodes that land at once write 300 MB
 * for the first time, in small pages 70,000 interrupts. Smaller blocks would waste too much [B]. */
enum { HUGE_BLOCK = 8 << 20, PAGE = 4096 };

/* Stored in the 64 bytes before the block, so that sw_free knows its size. */
typedef struct header {
  size_t bytes; /* of the user's part [B] */
  void *raw;    /* the system's pointer, for free */
} header;

static long fail_countdown;
static size_t live_bytes;
static size_t requests;

void sw_alloc_fail_at(long n) { fail_countdown = n > 0 ? n : 0; }
size_t sw_alloc_live(void) { return live_bytes; }
size_t sw_alloc_count(void) { return requests; }

void sw_alloc_passed(size_t count) {
  requests += count;
  if (fail_countdown > 0)
    fail_countdown -= count < (size_t)fail_countdown ? (long)count : fail_countdown;
}

/* A hint: it does not matter whether the system follows it. */
static void use_large_pages(char *raw, size_t bytes) {
#ifdef MADV_HUGEPAGE
  const size_t aside = (PAGE - (uintptr_t)raw % PAGE) % PAGE;
  (void)madvise(raw + aside, (bytes - aside) / PAGE * PAGE, MADV_HUGEPAGE);
#else
  (void)raw, (void)bytes;
#endif
}

static void *make(size_t count, size_t size, int zero) {
  requests++;
  if (fail_countdown > 0 && --fail_countdown == 0) return NULL;
  if (size != 0 && count > (SIZE_MAX / 2) / size) return NULL;
  const size_t bytes = count * size;
  const size_t total = ALIGNMENT + (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
  char *raw =
      total < LARGE || !zero ? aligned_alloc(ALIGNMENT, total) : calloc(1, total + ALIGNMENT);
  if (!raw) return NULL;
  if (total >= HUGE_BLOCK) use_large_pages(raw, total);
  if (total < LARGE && zero) memset(raw, 0, total);
  char *start = raw + (ALIGNMENT - (uintptr_t)raw % ALIGNMENT) % ALIGNMENT;
  *(header *)(void *)start = (header){bytes, raw};
  live_bytes += bytes;
  return start + ALIGNMENT;
}

void *sw_alloc(size_t count, size_t size) { return make(count, size, 1); }
void *sw_alloc_bytes(size_t bytes) { return make(bytes, 1, 0); }

sw_status sw_alloc_all(const sw_room *rooms) {
  sw_status status = SW_OK;
  for (; rooms->list; rooms++) {
    void *p = sw_alloc(rooms->count, rooms->size);
    memcpy(rooms->list, &p, sizeof p);
    if (!p) status = SW_ENOMEM;
  }
  return status;
}

static const header *header_of(const void *p) {
  return (const header *)(const void *)((const char *)p - ALIGNMENT);
}

size_t sw_alloc_size(const void *p) { return header_of(p)->bytes; }

void sw_free(void *p) {
  if (!p) return;
  const header *h = header_of(p);
  live_bytes -= h->bytes;
  free(h->raw);
}

void sw_free_all(void *const *list, size_t count) {
  for (size_t i = 0; i < count; i++) sw_free(list[i]);
}

/* Returns the capacity, doubled until it holds need; 0 if that is too large. */
static size_t doubled(size_t capacity, size_t need) {
  size_t wanted = capacity ? capacity : 8;
  while (wanted < need) {
    if (wanted > SIZE_MAX / 4) return 0;
    wanted *= 2;
  }
  return wanted;
}

sw_status sw_grow(void **p, size_t *capacity, size_t need, size_t size) {
  if (need <= *capacity) return SW_OK;
  const size_t wanted = doubled(*capacity, need);
  if (!wanted) return SW_ENOMEM;
  void *bigger = sw_alloc(wanted, size);
  if (!bigger) return SW_ENOMEM;
  if (*p) memcpy(bigger, *p, *capacity * size);
  sw_free(*p);
  *p = bigger;
  *capacity = wanted;
  return SW_OK;
}

sw_status sw_grow_empty(void **p, size_t *capacity, size_t need, size_t size) {
  if (need <= *capacity) return SW_OK;
  const size_t wanted = doubled(*capacity, need);
  sw_free(*p);
  *p = wanted ? sw_alloc(wanted, size) : NULL;
  *capacity = *p ? wanted : 0;
  return *p ? SW_OK : SW_ENOMEM;
}

sw_status sw_fill(void **p, size_t *capacity, const void *from, size_t count, size_t size) {
  SW_TRY(sw_grow(p, capacity, count, size));
  if (count) memcpy(*p, from, count * size);
  return SW_OK;
}
