/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks that a mesh file has all the data it declares. Each format is checked just closely enough
 * to find a truncated file; the reader checks the rest. */
#include <stdarg.h>
#include <stdio.h>

#include "shape/mesh_read.h"
#include "shape/mesh_words.h"

static sw_mesh_reader reader = sw_mesh_read;

void sw_mesh_set_reader(sw_mesh_reader own) { reader = own ? own : sw_mesh_read; }
sw_mesh_reader sw_mesh_get_reader(void) { return reader; }

sw_status sw_mesh_unreadable(const sw_mesh_file *file, sw_error *err, const char *why, ...) {
  char text[SW_ERROR_TEXT];
  va_list list;
  va_start(list, why);
  vsnprintf(text, sizeof text, why, list);
  va_end(list);
  return sw_fail(err, SW_EFORMAT, "%s: data is not readable as %s: %s; write the file anew",
                 file->object, file->format, text);
}

/* --- STL ------------------------------------------------------------------ */

enum { STL_HEAD = 84, STL_TRIANGLE = 50 }; /* [B] */

/* Returns the last occurrence of text in the file, ignoring case; NULL if there is none. text is in
 * lower case. */
static const char *last_of(const sw_mesh_file *file, const char *text) {
  const size_t n = strlen(text);
  for (size_t at = file->byte_count >= n ? file->byte_count - n + 1 : 0; at-- > 0;) {
    size_t k = 0;
    while (k < n && (file->bytes[at + k] | 0x20) == text[k]) k++;
    if (k == n) return file->bytes + at;
  }
  return NULL;
}

/* Checks that the corners of a text STL are numbers. */
static sw_status check_corners(const sw_mesh_file *file, sw_error *err) {
  sw_words all = {file->bytes, file->bytes + file->byte_count}, line, word;
  const char *counted = file->bytes;
  size_t number = 1;
  while (sw_words_line(&all, &line)) {
    char shown[SW_WORDS_SHOWN];
    for (; counted < line.at; counted++) number += *counted == '\n';
    if (!sw_words_next(&line, &word) || !sw_words_are(word, "vertex")) continue;
    for (int k = 0; k < 3; k++)
      if (!sw_words_next(&line, &word) || !sw_words_number(word))
        return sw_mesh_unreadable(file, err,
                                  "line %zu, a corner, needs three numbers, and has '%s'", number,
                                  sw_words_show(word, shown));
  }
  return SW_OK;
}

static sw_status check_stl(const sw_mesh_file *file, sw_error *err) {
  const size_t size = file->byte_count;
  const size_t count = size >= STL_HEAD ? sw_words_u32(file->bytes + 80) : 0;
  const size_t whole = STL_HEAD + STL_TRIANGLE * count;
  sw_words all = {file->bytes, file->bytes + size}, word;
  if (size >= STL_HEAD && size == whole) return SW_OK;
  if (sw_words_next(&all, &word) && word.end - word.at >= 5 && memcmp(word.at, "solid", 5) == 0) {
    const char *facet = last_of(file, "facet"), *end = last_of(file, "endsolid");
    if (end && (!facet || end > facet)) return check_corners(file, err);
    return sw_mesh_unreadable(file, err, "it is cut off, the closing word 'endsolid' is missing");
  }
  if (size < STL_HEAD)
    return sw_mesh_unreadable(file, err, "it has %zu bytes, and the head alone takes %d", size,
                              STL_HEAD);
  if (size > whole) return SW_OK;
  return sw_mesh_unreadable(
      file, err,
      "it is cut off or damaged: it declares %zu triangles, which take %zu bytes, and has %zu",
      count, whole, size);
}

/* --- GLB ------------------------------------------------------------------ */

static sw_status check_glb(const sw_mesh_file *file, sw_error *err) {
  enum { HEAD = 12 }; /* [B] */
  const size_t size = file->byte_count, whole = size >= HEAD ? sw_words_u32(file->bytes + 8) : HEAD;
  if (size >= HEAD && memcmp(file->bytes, "glTF", 4) != 0) return SW_OK; /* the reader reports it */
  if (size >= whole && size >= HEAD) return SW_OK;
  return sw_mesh_unreadable(
      file, err, "it is cut off or damaged: it declares %zu bytes and has %zu", whole, size);
}

sw_status sw_mesh_check(const sw_mesh_file *file, sw_error *err) {
  if (strcmp(file->format, "stl") == 0) return check_stl(file, err);
  if (strcmp(file->format, "ply") == 0) return sw_mesh_check_ply(file, err);
  if (strcmp(file->format, "off") == 0) return sw_mesh_check_off(file, err);
  if (strcmp(file->format, "glb") == 0) return check_glb(file, err);
  return SW_OK; /* obj and gltf declare no counts */
}
