/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks a PLY file. Its header lists elements (name, count, properties of each). The items follow,
 * one after another, as words or bytes. A property is a single value, or a list: a count and that
 * many values. */
#include "base/each.h"
#include "shape/mesh_read.h"
#include "shape/mesh_words.h"

enum { MOST_ELEMENTS = 16, MOST_PROPERTIES = 64 };

typedef struct property {
  int size;  /* size of a value [B] */
  int count; /* size of the list's count, 0 for a single value [B] */
} property;

typedef struct element {
  sw_words name;
  size_t count;      /* items [-] */
  int first, number; /* first and number of its properties */
  size_t fixed;      /* size of an item's single values [B] */
  int lists;         /* properties that are lists */
  int axes;          /* bits of the single values x, y and z that it has */
} element;

typedef enum ply_format { TEXT, LEAST_FIRST, LEAST_LAST } ply_format;

typedef struct header {
  ply_format format;
  element elements[MOST_ELEMENTS];
  property properties[MOST_PROPERTIES];
  int element_count, property_count;
} header;

static int size_of(sw_words word) {
  static const struct {
    const char *name;
    int size;
  } types[] = {{"char", 1},  {"int8", 1},    {"uchar", 1},  {"uint8", 1},
               {"short", 2}, {"int16", 2},   {"ushort", 2}, {"uint16", 2},
               {"int", 4},   {"int32", 4},   {"uint", 4},   {"uint32", 4},
               {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  for (size_t k = 0; k < sizeof types / sizeof types[0]; k++)
    if (sw_words_are(word, types[k].name)) return types[k].size;
  return 0;
}

static int read_property(header *h, sw_words line) {
  sw_words word;
  property p = {0, 0};
  if (h->element_count == 0 || h->property_count == MOST_PROPERTIES) return 0;
  element *e = &h->elements[h->element_count - 1];
  if (!sw_words_next(&line, &word)) return 0;
  if (sw_words_are(word, "list")) {
    if (!sw_words_next(&line, &word)) return 0;
    p.count = size_of(word);
    if (p.count != 1 && p.count != 2 && p.count != 4) return 0;
    if (!sw_words_next(&line, &word)) return 0;
    e->lists++;
  }
  p.size = size_of(word);
  if (p.size == 0) return 0;
  if (p.count == 0) e->fixed += (size_t)p.size;
  if (p.count == 0 && sw_words_next(&line, &word) && word.end - word.at == 1 && *word.at >= 'x' &&
      *word.at <= 'z')
    e->axes |= 1 << (*word.at - 'x');
  h->properties[h->property_count++] = p;
  e->number++;
  return 1;
}

static int read_element(header *h, sw_words line) {
  if (h->element_count == MOST_ELEMENTS) return 0;
  element *e = &h->elements[h->element_count++];
  *e = (element){.first = h->property_count};
  return sw_words_next(&line, &e->name) && sw_words_count(&line, &e->count);
}

static int read_format(header *h, sw_words line) {
  sw_words word;
  if (!sw_words_next(&line, &word)) return 0;
  if (sw_words_are(word, "ascii")) return h->format = TEXT, 1;
  if (sw_words_are(word, "binary_little_endian")) return h->format = LEAST_FIRST, 1;
  if (sw_words_are(word, "binary_big_endian")) return h->format = LEAST_LAST, 1;
  return 0;
}

/* Reads from the file's start to the end of the header. 0: unreadable or truncated. */
static int read_header(header *h, sw_words *from) {
  sw_words line, word;
  *h = (header){0};
  while (sw_words_line(from, &line)) {
    sw_words_next(&line, &word);
    if (sw_words_are(word, "end_header")) {
      if (from->at < from->end && *from->at == '\r') from->at++;
      if (from->at < from->end && *from->at == '\n') from->at++;
      return 1;
    }
    const int good = sw_words_are(word, "format")     ? read_format(h, line)
                     : sw_words_are(word, "element")  ? read_element(h, line)
                     : sw_words_are(word, "property") ? read_property(h, line)
                                                      : 1; /* ply, comment, obj_info */
    if (!good) return 0;
  }
  return 0;
}

/* --- items: count the complete ones of an element ------------------------------- */

static int text_item(const header *h, const element *e, sw_words *from) {
  sw_words word;
  for (int k = 0; k < e->number; k++) {
    size_t values = 1;
    if (h->properties[e->first + k].count > 0 && !sw_words_count(from, &values)) return 0;
    for (; values > 0; values--)
      if (!sw_words_next(from, &word)) return 0;
  }
  return 1;
}

static size_t number_of(const char *at, int size, ply_format format) {
  size_t value = 0;
  for (int k = 0; k < size; k++)
    value = value << 8 | (unsigned char)at[format == LEAST_LAST ? k : size - 1 - k];
  return value;
}

static int binary_item(const header *h, const element *e, sw_words *from) {
  for (int k = 0; k < e->number; k++) {
    const property p = h->properties[e->first + k];
    size_t values = 1;
    if (from->end - from->at < p.count) return 0;
    if (p.count > 0) values = number_of(from->at, p.count, h->format);
    from->at += p.count;
    if (values > (size_t)(from->end - from->at) / (size_t)p.size) return 0;
    from->at += values * (size_t)p.size;
  }
  return 1;
}

static size_t whole_items(const header *h, const element *e, sw_words *from) {
  const size_t left = (size_t)(from->end - from->at);
  size_t k = 0;
  if (e->number == 0) return e->count <= left ? e->count : left;
  if (h->format != TEXT && e->lists == 0) {
    k = e->count < left / e->fixed ? e->count : left / e->fixed;
    from->at += k * e->fixed;
    return k;
  }
  while (k < e->count && (h->format == TEXT ? text_item : binary_item)(h, e, from)) k++;
  return k;
}

/* Assimp takes 0 for a coordinate that the points do not have. */
static sw_status check_axes(const sw_mesh_file *file, const header *h, sw_error *err) {
  SW_ITEMS(const element, e, h->elements, h->element_count) {
    if (!sw_words_are(e->name, "vertex")) continue;
    for (int k = 0; k < 3; k++)
      if (!(e->axes >> k & 1))
        return sw_mesh_unreadable(file, err, "its points have no property '%c'", 'x' + k);
  }
  return SW_OK;
}

sw_status sw_mesh_check_ply(const sw_mesh_file *file, sw_error *err) {
  sw_words from = {file->bytes, file->bytes + file->byte_count};
  header h;
  if (!read_header(&h, &from))
    return sw_mesh_unreadable(file, err, "its header is cut off or damaged");
  SW_ITEMS(const element, e, h.elements, h.element_count) {
    const size_t whole = whole_items(&h, e, &from);
    if (whole < e->count)
      return sw_mesh_unreadable(
          file, err, "it is cut off or damaged: it declares %zu items of '%.*s', and %zu are there",
          e->count, (int)(e->name.end - e->name.at < 32 ? e->name.end - e->name.at : 32),
          e->name.at, whole);
  }
  return check_axes(file, &h, err);
}
