/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tape on which structs are put field by field and from which they come back: one function
 * for each struct says what is on it and serves both ways, so that writing and reading cannot
 * drift apart. A third way only takes a checksum of the fields, to tell two things apart.
 *
 * A tape that stays at home, in the scene whose state it has, says no more than it must: what is
 * shared goes by reference, of records that only grow it has the length, and nothing is checked.
 *
 * Reading fills an empty slot, or one that has something: blocks of the size that is wanted stay
 * where they are, others are freed.
 *
 * After the first failure everything is a no-op and reading gives zeros, so that functions need
 * not look at the status after each field; they must before they trust what they read. Reading
 * never goes beyond the tape, and what it allocates is bounded by what is left of it. */
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

/* How something is shared; neither is called with NULL. */
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
  int home;          /* 1: it stays at home */
  sw_shared *shared; /* what a tape at home holds */
  size_t shared_count, shared_capacity;
  unsigned char *bytes;  /* written: the tape's own */
  const void *from;      /* to be read: the caller's */
  size_t size, capacity; /* [B] */
  size_t at;             /* read so far [B] */
  uint64_t sum;          /* of what went by, when that is all that is wanted */
  sw_status status;
  sw_error *err;
} sw_tape;

sw_tape sw_tape_writer(sw_error *err);
sw_tape sw_tape_reader(const void *bytes, size_t size, sw_error *err);
sw_tape sw_tape_summer(void);
/* A tape that stays at home, with so much room to begin with [B]; and one that reads it. */
sw_tape sw_tape_at_home(size_t room, sw_error *err);
sw_tape sw_tape_read_home(const sw_tape *from, sw_error *err);
void sw_tape_free(sw_tape *tape);

static inline int sw_tape_reads(const sw_tape *tape) { return tape->mode == SW_TAPE_READ; }
static inline int sw_tape_good(const sw_tape *tape) { return tape->status == SW_OK; }

/* Checksum of bytes (FNV-1a), going on from sum; begin with SW_SUM_START. */
#define SW_SUM_START 14695981039346656037u
uint64_t sw_sum(uint64_t sum, const void *bytes, size_t size);

/* The tape makes no sense: SW_EFORMAT and the text. */
__attribute__((format(printf, 2, 3))) void sw_tape_damaged(sw_tape *tape, const char *format, ...);
void sw_tape_fail(sw_tape *tape, sw_status status);

/* The bytes of something plain. */
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

/* On a tape at home: the address at p, of what lives as long as the program, and 1. On others
 * nothing, and 0. */
static inline int sw_tape_address(sw_tape *t, void *p) {
  if (t->home) sw_tape_raw(t, p, sizeof(void *));
  return t->home;
}
/* On a tape at home: a reference to *p, which may be NULL, and 1. On others nothing, and 0. */
int sw_tape_share(sw_tape *tape, void *p_pointer, const sw_sharing *how);
/* Bytes that are not copied when they are read: *p is then within the tape, on any address. */
void sw_tape_view(sw_tape *tape, const void **p, size_t bytes);

/* One function for each type of field, all alike, so that a macro can name them. */
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

/* A name of the program's own, such as that of a class: the given one, or the one read, which
 * stays in buffer (SW_NAME_SIZE); NULL is "". */
const char *sw_tape_word(sw_tape *tape, const char *word, char *buffer);

/* How many things follow, each of at least so many bytes: reading refuses more than there is
 * room for. */
void sw_tape_count(sw_tape *tape, size_t *count, size_t least);

/* count items, in a block of that size when they were read. optional: *items may be NULL. */
void sw_tape_array(sw_tape *tape, void *items_pointer, size_t count, size_t item);
void sw_tape_optional(sw_tape *tape, void *items_pointer, size_t count, size_t item);
/* The count, then the items; the count stays that of the items also when memory runs out. */
void sw_tape_list(sw_tape *tape, void *items_pointer, size_t *count, size_t item);
#define SW_TAPE_ARRAY(tape, p, count) sw_tape_array(tape, &(p), count, sizeof *(p))
#define SW_TAPE_OPTIONAL(tape, p, count) sw_tape_optional(tape, &(p), count, sizeof *(p))

/* Having read: are all of them finite? what: for the message. */
void sw_tape_finite(sw_tape *tape, const double *x, size_t count, const char *what);
/* Having read: damaged unless good. */
void sw_tape_expect(sw_tape *tape, int good, const char *what);

/* Begins the function of a struct. A field that is added to the struct changes its size, so that
 * this does not compile until somebody has put the field on the tape too and stated the new size;
 * files written with another struct are told by the size that they have. */
#define SW_TAPE_STRUCT(tape, type, bytes)                                          \
  _Static_assert(sizeof(void *) != 8 || sizeof(type) == (bytes),                   \
                 #type " has other fields: put them on the tape, state its size"); \
  if (!(tape)->home) sw_tape_mark(tape, #type, sizeof(type))
void sw_tape_mark(sw_tape *tape, const char *what, size_t size);

#endif
