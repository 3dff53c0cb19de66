/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields, arrays, lists and shared objects on a tape, with checks on reading. */
#include "base/tape.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/alloc.h"

sw_tape sw_tape_writer(sw_error *err) { return (sw_tape){.mode = SW_TAPE_WRITE, .err = err}; }

sw_tape sw_tape_reader(const void *bytes, size_t size, sw_error *err) {
  return (sw_tape){.mode = SW_TAPE_READ, .from = bytes, .size = size, .err = err};
}

sw_tape sw_tape_summer(void) { return (sw_tape){.mode = SW_TAPE_SUM, .sum = SW_SUM_START}; }

sw_tape sw_tape_at_home(size_t room, sw_error *err) {
  sw_tape t = {.mode = SW_TAPE_WRITE, .home = 1, .capacity = room, .err = err};
  t.bytes = sw_alloc_bytes(room);
  if (!t.bytes) t.capacity = 0, sw_tape_fail(&t, SW_ENOMEM);
  return t;
}

sw_tape sw_tape_read_home(const sw_tape *from, sw_error *err) {
  return (sw_tape){
      .mode = SW_TAPE_READ, .home = 1, .from = from->bytes, .size = from->size, .err = err};
}

void sw_tape_free(sw_tape *t) {
  for (size_t k = 0; k < t->shared_count; k++) t->shared[k].how->release(t->shared[k].what);
  sw_free(t->shared);
  sw_free(t->bytes);
  t->shared = NULL, t->bytes = NULL;
  t->shared_count = t->shared_capacity = t->size = t->capacity = 0;
}

uint64_t sw_sum(uint64_t sum, const void *bytes, size_t size) {
  const unsigned char *p = bytes;
  for (size_t i = 0; i < size; i++) sum = (sum ^ p[i]) * 1099511628211u;
  return sum;
}

void sw_tape_fail(sw_tape *t, sw_status status) {
  if (t->status != SW_OK) return;
  t->status = status;
  if (status == SW_ENOMEM) sw_fail(t->err, status, "out of memory");
}

void sw_tape_damaged(sw_tape *t, const char *format, ...) {
  if (t->status != SW_OK) return;
  char text[200];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  t->status = sw_fail(t->err, SW_EFORMAT, "its content is damaged (%s)", text);
}

void sw_tape_expect(sw_tape *t, int good, const char *what) {
  if (sw_tape_reads(t) && !t->home && sw_tape_good(t) && !good) sw_tape_damaged(t, "%s", what);
}

void sw_tape_raw_slow(sw_tape *t, void *p, size_t bytes) {
  if (t->mode == SW_TAPE_SUM) {
    t->sum = sw_sum(t->sum, p, bytes);
  } else if (sw_tape_reads(t)) {
    if (sw_tape_good(t) && bytes > t->size - t->at) sw_tape_damaged(t, "it ends too early");
    if (!sw_tape_good(t)) {
      memset(p, 0, bytes);
      return;
    }
    if (bytes) memcpy(p, (const unsigned char *)t->from + t->at, bytes);
    t->at += bytes;
  } else if (sw_tape_good(t)) {
    if (SW_GROW(t->bytes, t->capacity, t->size + bytes) != SW_OK) {
      sw_tape_fail(t, SW_ENOMEM);
      return;
    }
    if (bytes) memcpy(t->bytes + t->size, p, bytes);
    t->size += bytes;
  }
}

int sw_tape_share(sw_tape *t, void *p_pointer, const sw_sharing *how) {
  void **p = p_pointer, *what = *p;
  if (!t->home) return 0;
  if (!sw_tape_reads(t) && what) {
    if (SW_GROW(t->shared, t->shared_capacity, t->shared_count + 1) != SW_OK) {
      sw_tape_fail(t, SW_ENOMEM);
      return 1;
    }
    how->retain(what);
    t->shared[t->shared_count++] = (sw_shared){what, how};
  }
  sw_tape_raw(t, &what, sizeof what);
  if (!sw_tape_reads(t) || !sw_tape_good(t) || what == *p) return 1;
  if (what) how->retain(what);
  if (*p) how->release(*p);
  *p = what;
  return 1;
}

void *sw_tape_object(sw_tape *t, void *p_pointer, size_t size) {
  void **p = p_pointer;
  if (!sw_tape_reads(t)) return *p;
  *p = sw_tape_good(t) ? sw_alloc(1, size) : NULL;
  if (!*p) sw_tape_fail(t, SW_ENOMEM);
  return *p;
}

void sw_tape_view(sw_tape *t, const void **p, size_t bytes) {
  if (!sw_tape_reads(t)) {
    sw_tape_raw(t, (void *)(uintptr_t)*p, bytes);
    return;
  }
  if (sw_tape_good(t) && bytes > t->size - t->at) sw_tape_damaged(t, "it ends too early");
  *p = sw_tape_good(t) ? (const unsigned char *)t->from + t->at : NULL;
  if (sw_tape_good(t)) t->at += bytes;
}

/* Bytes after a name's end are written as zeros, so that equal names give equal files. */
void sw_tape_name(sw_tape *t, char *x) {
  char clean[SW_NAME_SIZE] = {0};
  if (t->home) {
    sw_tape_raw(t, x, SW_NAME_SIZE);
    return;
  }
  if (!sw_tape_reads(t)) memcpy(clean, x, strnlen(x, SW_NAME_SIZE - 1));
  sw_tape_raw(t, clean, sizeof clean);
  clean[SW_NAME_SIZE - 1] = '\0';
  if (sw_tape_reads(t)) memcpy(x, clean, sizeof clean);
}

const char *sw_tape_word(sw_tape *t, const char *word, char *buffer) {
  if (!sw_tape_reads(t)) snprintf(buffer, SW_NAME_SIZE, "%s", word ? word : "");
  sw_tape_name(t, buffer);
  return buffer;
}

void sw_tape_mark(sw_tape *t, const char *what, size_t size) {
  uint32_t here = (uint32_t)size;
  sw_tape_uint32(t, &here);
  if (sw_tape_reads(t) && sw_tape_good(t) && here != size)
    t->status = sw_fail(t->err, SW_EFORMAT,
                        "it was written by another version of SoftWorld (%s has %lu bytes there, "
                        "%zu here)",
                        what, (unsigned long)here, size);
}

void sw_tape_count(sw_tape *t, size_t *count, size_t least) {
  sw_tape_size(t, count);
  if (sw_tape_reads(t) && !t->home && *count > (t->size - t->at) / least) {
    sw_tape_damaged(t, "a list of %zu things does not fit into it", *count);
    *count = 0;
  }
}

void sw_tape_array(sw_tape *t, void *items_pointer, size_t count, size_t item) {
  void **items = items_pointer;
  if (!t->home) sw_tape_mark(t, "an item", item);
  if (!sw_tape_reads(t)) {
    if (count) sw_tape_raw(t, *items, count * item);
    return;
  }
  if (sw_tape_good(t) && count > (t->size - t->at) / item)
    sw_tape_damaged(t, "a list of %zu items does not fit into it", count);
  if (!sw_tape_good(t)) return;
  if (!*items || sw_alloc_size(*items) != count * item) {
    void *block = sw_alloc_bytes(count * item);
    if (!block) {
      sw_tape_fail(t, SW_ENOMEM);
      return;
    }
    sw_free(*items);
    *items = block;
  }
  sw_tape_raw(t, *items, count * item);
}

void sw_tape_list(sw_tape *t, void *items_pointer, size_t *count, size_t item) {
  size_t n = *count;
  sw_tape_count(t, &n, item);
  sw_tape_array(t, items_pointer, n, item);
  if (sw_tape_good(t)) *count = n;
}

void sw_tape_optional(sw_tape *t, void *items_pointer, size_t count, size_t item) {
  void **items = items_pointer;
  int there = !sw_tape_reads(t) && *items != NULL;
  sw_tape_int(t, &there);
  if (there)
    sw_tape_array(t, items_pointer, count, item);
  else if (sw_tape_reads(t) && sw_tape_good(t))
    sw_free(*items), *items = NULL;
}

void sw_tape_finite(sw_tape *t, const double *x, size_t count, const char *what) {
  if (!sw_tape_reads(t) || t->home || !sw_tape_good(t)) return;
  for (size_t i = 0; i < count; i++)
    if (!isfinite(x[i])) {
      sw_tape_damaged(t, "%s: number %zu is not finite", what, i + 1);
      return;
    }
}

void sw_tape_bracket(sw_tape *t, sw_bracket *x, const char *what) {
  for (int k = 0; k < 2; k++) sw_tape_double(t, &x->tried[k]);
  for (int k = 0; k < 2; k++) sw_tape_double(t, &x->off[k]);
  sw_tape_int(t, &x->last_side);
  sw_tape_expect(t, x->last_side >= -1 && x->last_side <= 1, what);
}
