/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splits the bytes of a mesh file into lines, words and counts; nothing is copied. */
#ifndef SW_SHAPE_MESH_WORDS_H
#define SW_SHAPE_MESH_WORDS_H

#include <stddef.h>
#include <string.h>

typedef struct sw_words {
  const char *at, *end;
} sw_words;

static inline int sw_words_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/* Gets the next line that is not empty, without its line end. 0: no more lines. */
static inline int sw_words_line(sw_words *from, sw_words *line) {
  while (from->at < from->end && sw_words_space(*from->at)) from->at++;
  if (from->at == from->end) return 0;
  line->at = from->at;
  while (from->at < from->end && *from->at != '\n' && *from->at != '\r') from->at++;
  line->end = from->at;
  return 1;
}

static inline int sw_words_next(sw_words *from, sw_words *word) {
  while (from->at < from->end && sw_words_space(*from->at)) from->at++;
  word->at = from->at;
  while (from->at < from->end && !sw_words_space(*from->at)) from->at++;
  word->end = from->at;
  return word->at < word->end;
}

static inline int sw_words_are(sw_words word, const char *text) {
  const size_t n = strlen(text);
  return (size_t)(word.end - word.at) == n && memcmp(word.at, text, n) == 0;
}

/* Reads a count in decimal digits. 0: the word is no count, or has more than 18 digits. */
static inline int sw_words_count(sw_words *from, size_t *count) {
  sw_words word;
  *count = 0;
  if (!sw_words_next(from, &word) || word.end - word.at > 18) return 0;
  for (const char *c = word.at; c < word.end; c++) {
    if (*c < '0' || *c > '9') return 0;
    *count = 10 * *count + (size_t)(*c - '0');
  }
  return 1;
}

enum { SW_WORDS_SHOWN = 32 }; /* room for a word in a message [B] */

/* Copies the start of a word for a message, with a question mark for each byte that is not plain
 * text: files may hold anything, and terminals obey control characters. */
static inline const char *sw_words_show(sw_words word, char out[SW_WORDS_SHOWN]) {
  size_t n = 0;
  for (const char *c = word.at; c < word.end && n < SW_WORDS_SHOWN - 1; c++)
    out[n++] = *c >= ' ' && *c <= '~' ? *c : '?';
  out[n] = '\0';
  return out;
}

/* 1 if a word is a decimal number, or nan or inf, which the checks of triangles report. */
static inline int sw_words_number(sw_words word) {
  const char *c = word.at;
  int digits = 0;
  if (c < word.end && (*c == '-' || *c == '+')) c++;
  if (word.end - c >= 3)
    if ((c[0] | 0x20) == 'n' || (c[0] | 0x20) == 'i')
      return (c[1] | 0x20) == 'a' || (c[1] | 0x20) == 'n';
  for (; c < word.end && *c >= '0' && *c <= '9'; c++) digits++;
  if (c < word.end && *c == '.') c++;
  for (; c < word.end && *c >= '0' && *c <= '9'; c++) digits++;
  if (digits == 0 || c == word.end) return digits > 0;
  if ((*c++ | 0x20) != 'e') return 0;
  if (c < word.end && (*c == '-' || *c == '+')) c++;
  for (digits = 0; c < word.end && *c >= '0' && *c <= '9'; c++) digits++;
  return digits > 0 && c == word.end;
}

/* Reads four bytes, least significant first. */
static inline size_t sw_words_u32(const char *at) {
  const unsigned char *b = (const unsigned char *)at;
  return (size_t)b[0] | (size_t)b[1] << 8 | (size_t)b[2] << 16 | (size_t)b[3] << 24;
}

#endif
