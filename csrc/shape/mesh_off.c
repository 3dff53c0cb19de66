/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks an OFF file: the word OFF, a line with the numbers of points, faces and edges, a line for
 * each point, a line for each face: its number of corners, then their points, counted from 0. */
#include "shape/mesh_read.h"
#include "shape/mesh_words.h"

typedef struct head {
  size_t points, faces; /* declared [-] */
  int axes;             /* numbers that each point needs [-] */
} head;

/* Gets the next line that is not a comment. */
static int line_of(sw_words *from, sw_words *line) {
  while (sw_words_line(from, line))
    if (*line->at != '#') return 1;
  return 0;
}

static sw_status read_head(const sw_mesh_file *file, sw_words *from, head *h, sw_error *err) {
  sw_words line, word = {0};
  size_t edges;
  if (!line_of(from, &line) || !sw_words_next(&line, &word) || word.end - word.at < 3 ||
      memcmp(word.end - 3, "OFF", 3) != 0)
    return sw_mesh_unreadable(file, err, "it does not begin with the word OFF");
  h->axes = *word.at == '4' ? 4 : 3;
  sw_words rest = line;
  if (!sw_words_next(&rest, &word) || *word.at == '#') line_of(from, &line);
  if (sw_words_count(&line, &h->points) && sw_words_count(&line, &h->faces) &&
      sw_words_count(&line, &edges))
    return SW_OK;
  return sw_mesh_unreadable(file, err, "its head has no numbers of points, faces and edges");
}

static sw_status cut_off(const sw_mesh_file *file, const head *h, const char *what, size_t number,
                         sw_error *err) {
  return sw_mesh_unreadable(file, err,
                            "it is cut off or damaged: it declares %zu points and %zu faces, and "
                            "%s number %zu is not whole",
                            h->points, h->faces, what, number);
}

static sw_status check_point(const sw_mesh_file *file, const head *h, sw_words line, size_t number,
                             sw_error *err) {
  sw_words word;
  char shown[SW_WORDS_SHOWN];
  for (int k = 0; k < h->axes; k++) {
    if (!sw_words_next(&line, &word)) return cut_off(file, h, "point", number, err);
    if (!sw_words_number(word))
      return sw_mesh_unreadable(file, err, "point number %zu has '%s' where a number should be",
                                number, sw_words_show(word, shown));
  }
  return SW_OK;
}

static sw_status check_face(const sw_mesh_file *file, const head *h, sw_words line, size_t number,
                            sw_error *err) {
  size_t corners, at;
  if (!sw_words_count(&line, &corners)) return cut_off(file, h, "face", number, err);
  for (; corners > 0; corners--) {
    sw_words from = line, word;
    char shown[SW_WORDS_SHOWN];
    if (!sw_words_next(&line, &word)) return cut_off(file, h, "face", number, err);
    if (sw_words_count(&from, &at) && at < h->points) continue;
    return sw_mesh_unreadable(
        file, err, "face %zu names point %s; the file has %zu points (0 to %lld)", number,
        sw_words_show(word, shown), h->points, (long long)h->points - 1);
  }
  return SW_OK;
}

sw_status sw_mesh_check_off(const sw_mesh_file *file, sw_error *err) {
  sw_words all = {file->bytes, file->bytes + file->byte_count}, line;
  head h = {0};
  SW_TRY(read_head(file, &all, &h, err));
  for (size_t k = 1; k <= h.points; k++) {
    if (!line_of(&all, &line)) return cut_off(file, &h, "point", k, err);
    SW_TRY(check_point(file, &h, line, k, err));
  }
  for (size_t k = 1; k <= h.faces; k++) {
    if (!line_of(&all, &line)) return cut_off(file, &h, "face", k, err);
    SW_TRY(check_face(file, &h, line, k, err));
  }
  if (!line_of(&all, &line)) return SW_OK;
  return sw_mesh_unreadable(file, err,
                            "it declares %zu points and %zu faces, and more lines follow them",
                            h.points, h.faces);
}
