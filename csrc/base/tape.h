/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes structs to a tape (a block of bytes) field by field and reads them back. One function for
 * each struct serves both directions, so that writing and reading stay consistent. In a third mode
 * it only computes a checksum of the fields, to tell two objects apart.
 *
 * A tape "at home" (a snapshot) stays with the scene whose state it has. It stores as little as
 * possible: shared objects by reference, for records that only grow just the length. Nothing is
 * checked.
 *
 * Reading fills an empty object, or one that has content. Then blocks that have the right size
 * stay where they are; others are freed.
 *
 * After the first failure all functions do nothing and reading gives zeros. So functions need not
 * check the status after each field, but before they use what they have read. Reading never goes
 * beyond the tape; what it allocates is bounded by the rest of the tape. */
#ifndef SW_BASE_TAPE_H
#define SW_BASE_TAPE_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/param.h"
#include "base/root.h"
#include "base/status.h"
#include "base/vec.h"

typedef enum sw_tape_mode { SW_TAPE_WRITE, SW_TAPE_READ, SW_TAPE_SUM } sw_tape_mode;

/* How references to a shared object are counted. Neither function is called with NULL. */
typedef struct sw_sharing {
  void (*retain)(void *);
  void (*release)(void *);
} sw_sharing;

typedef struct sw_shared {
  void *what;
  const sw_sharing *how;
} sw_shared;

typedef struct sw_tape {
  sw_tape_mode mode;
  int home;          /* 1: a tape at home, see above */
  sw_shared *shared; /* shared objects that a tape at home retains */
  size_t shared_count, shared_capacity;
  unsigned char *bytes;  /* written bytes; the tape owns them */
  const void *from;      /* bytes to read; the caller owns them */
  size_t size, capacity; /* [B] */
  size_t at;             /* read so far [B] */
  uint64_t sum;          /* checksum so far, in mode SW_TAPE_SUM */
  sw_status status;
  sw_error *err;
} sw_tape;

sw_tape sw_tape_writer(sw_error *err);
sw_tape sw_tape_reader(const void *bytes, size_t size, sw_error *err);
sw_tape sw_tape_summer(void);
/* A tape at home for writing, with this initial room [B]; a tape that reads it. */
sw_tape sw_tape_at_home(size_t room, sw_error *err);
sw_tape sw_tape_read_home(const sw_tape *from, sw_error *err);
void sw_tape_free(sw_tape *tape);

static inline int sw_tape_reads(const sw_tape *tape) { return tape->mode == SW_TAPE_READ; }
static inline int sw_tape_good(const sw_tape *tape) { return tape->status == SW_OK; }

/* Returns the checksum (FNV-1a) of bytes, continued from sum; start with SW_SUM_START. */
#define SW_SUM_START 14695981039346656037u
uint64_t sw_sum(uint64_t sum, const void *bytes, size_t size);

/* Sets SW_EFORMAT and a text: the tape's content makes no sense. */
__attribute__((format(printf, 2, 3))) void sw_tape_damaged(sw_tape *tape, const char *format, ...);
void sw_tape_fail(sw_tape *tape, sw_status status);

/* Writes or reads plain bytes. */
void sw_tape_raw_slow(sw_tape *tape, void *p, size_t bytes);
static inline void sw_tape_raw(sw_tape *t, void *p, size_t bytes) {
  if (t->mode == SW_TAPE_WRITE && t->status == SW_OK && bytes <= t->capacity - t->size) {
    if (bytes) memcpy(t->bytes + t->size, p, bytes);
    t->size += bytes;
  } else if (t->mode == SW_TAPE_READ && t->status == SW_OK && bytes <= t->size - t->at) {
    if (bytes) memcpy(p, (const unsigned char *)t->from + t->at, bytes);
    t->at += bytes;
  } else {
    sw_tape_raw_slow(t, p, bytes);
  }
}

/* On a tape at home: writes or reads the address at p, of an object that lives as long as the
 * program, and returns 1. On other tapes does nothing and returns 0. */
static inline int sw_tape_address(sw_tape *t, void *p) {
  if (t->home) sw_tape_raw(t, p, sizeof(void *));
  return t->home;
}
/* On a tape at home: writes or reads a reference to *p, which may be NULL, and returns 1. On other
 * tapes does nothing and returns 0. */
int sw_tape_share(sw_tape *tape, void *p_pointer, const sw_sharing *how);
/* Reading: makes a zeroed object of this size and sets *p to it; NULL if it cannot. Returns *p. */
void *sw_tape_object(sw_tape *tape, void *p_pointer, size_t size);
/* Writes bytes; reading does not copy them: *p then points into the tape and may be unaligned. */
void sw_tape_view(sw_tape *tape, const void **p, size_t bytes);

/* One function for each type of field. All have the same form, so that a macro can name them. */
static inline void sw_tape_double(sw_tape *t, double *x) { sw_tape_raw(t, x, sizeof *x); }
static inline void sw_tape_int(sw_tape *t, int *x) { sw_tape_raw(t, x, sizeof *x); }
static inline void sw_tape_size(sw_tape *t, size_t *x) { sw_tape_raw(t, x, sizeof *x); }
static inline void sw_tape_long(sw_tape *t, long *x) { sw_tape_raw(t, x, sizeof *x); }
static inline void sw_tape_uint32(sw_tape *t, uint32_t *x) { sw_tape_raw(t, x, sizeof *x); }
static inline void sw_tape_vec(sw_tape *t, sw_vec *x) { sw_tape_raw(t, x, sizeof *x); }
static inline void sw_tape_quat(sw_tape *t, sw_quat *x) { sw_tape_raw(t, x, sizeof *x); }
void sw_tape_bracket(sw_tape *tape, sw_bracket *bracket, const char *what); /* what: for messages */
static inline void sw_tape_pose(sw_tape *t, sw_pose *x) { sw_tape_raw(t, x, sizeof *x); }
/* char[SW_NAME_SIZE] */
void sw_tape_name(sw_tape *tape, char *x);

/* Writes or reads a name that the program defines, such as a class name. Returns the name, which
 * is in buffer (SW_NAME_SIZE bytes). NULL is written as "". */
const char *sw_tape_word(sw_tape *tape, const char *word, char *buffer);

/* Writes or reads which class an object has: the address at home, else the class's name, for which
 * find returns the class or NULL. */
#define SW_TAPE_CLASS(tape, class, find)                                                       \
  do {                                                                                         \
    char word_[SW_NAME_SIZE];                                                                  \
    if (sw_tape_address(tape, &(class))) break;                                                \
    const char *name_ = sw_tape_word(tape, sw_tape_reads(tape) ? NULL : (class)->name, word_); \
    if (sw_tape_reads(tape)) (class) = find(name_);                                            \
  } while (0)

/* Writes or reads the number of items that follow, each of at least `least` bytes. Reading refuses
 * more than the rest of the tape can hold. */
void sw_tape_count(sw_tape *tape, size_t *count, size_t least);

/* Write or read count items; reading makes *items a block of exactly this size. optional: *items
 * may be NULL. */
void sw_tape_array(sw_tape *tape, void *items_pointer, size_t count, size_t item);
void sw_tape_optional(sw_tape *tape, void *items_pointer, size_t count, size_t item);
/* Writes or reads the count, then the items. If memory runs out, *count stays that of the old
 * items. */
void sw_tape_list(sw_tape *tape, void *items_pointer, size_t *count, size_t item);
#define SW_TAPE_ARRAY(tape, p, count) sw_tape_array(tape, &(p), count, sizeof *(p))
#define SW_TAPE_OPTIONAL(tape, p, count) sw_tape_optional(tape, &(p), count, sizeof *(p))

/* After reading from a file: marks the tape as damaged unless all numbers are finite. what: for the
 * message. */
void sw_tape_finite(sw_tape *tape, const double *x, size_t count, const char *what);
/* After reading from a file: marks the tape as damaged unless good. */
void sw_tape_expect(sw_tape *tape, int good, const char *what);

/* Begins the function of a struct. A new field changes the struct's size: then this does not
 * compile until the programmer puts the field on the tape too and states the new size. Files with
 * another version of the struct are recognised by the size that they contain. */
#define SW_TAPE_STRUCT(tape, type, bytes)                                          \
  _Static_assert(sizeof(void *) != 8 || sizeof(type) == (bytes),                   \
                 #type " has other fields: put them on the tape, state its size"); \
  if (!(tape)->home) sw_tape_mark(tape, #type, sizeof(type))
void sw_tape_mark(sw_tape *tape, const char *what, size_t size);

#endif
