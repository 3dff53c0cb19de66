/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tape on which structs are put field by field and from which they come back: one function
 * for each struct says what is on it and serves both ways, so that writing and reading cannot
 * drift apart. A third way only takes a checksum of the fields, to tell two things apart.
 *
 * After the first failure everything is a no-op and reading gives zeros, so that functions need
 * not look at the status after each field; they must before they trust what they read. Reading
 * never goes beyond the tape, and what it allocates is bounded by what is left of it. */
#ifndef SW_BASE_TAPE_H
#define SW_BASE_TAPE_H

#include <stddef.h>
#include <stdint.h>

#include "base/param.h"
#include "base/status.h"
#include "base/vec.h"

typedef enum sw_tape_mode { SW_TAPE_WRITE, SW_TAPE_READ, SW_TAPE_SUM } sw_tape_mode;

typedef struct sw_tape {
  sw_tape_mode mode;
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
void sw_tape_raw(sw_tape *tape, void *p, size_t bytes);

/* One function for each type of field, all alike, so that a macro can name them. */
void sw_tape_double(sw_tape *tape, double *x);
void sw_tape_int(sw_tape *tape, int *x);
void sw_tape_size(sw_tape *tape, size_t *x);
void sw_tape_long(sw_tape *tape, long *x);
void sw_tape_uint32(sw_tape *tape, uint32_t *x);
void sw_tape_vec(sw_tape *tape, sw_vec *x);
void sw_tape_quat(sw_tape *tape, sw_quat *x);
void sw_tape_pose(sw_tape *tape, sw_pose *x);
/* char[SW_NAME_SIZE] */
void sw_tape_name(sw_tape *tape, char *x);

/* A name of the program's own, such as that of a class: the given one, or the one read, which
 * stays in buffer (SW_NAME_SIZE); NULL is "". */
const char *sw_tape_word(sw_tape *tape, const char *word, char *buffer);

/* How many things follow, each of at least so many bytes: reading refuses more than there is
 * room for. */
void sw_tape_count(sw_tape *tape, size_t *count, size_t least);

/* count items, allocated when reading. optional: *items may be NULL. */
void sw_tape_array(sw_tape *tape, void *items_pointer, size_t count, size_t item);
void sw_tape_optional(sw_tape *tape, void *items_pointer, size_t count, size_t item);
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
  sw_tape_mark(tape, #type, sizeof(type))
void sw_tape_mark(sw_tape *tape, const char *what, size_t size);

#endif
