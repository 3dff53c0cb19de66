/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Defaults and checks of parameters, and the known name that a wrong one means: by another word for
 * it, or by edit distance. */
#include "base/param.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/each.h"
#include "base/vec.h"

void sw_param_store(const sw_param *row, void *args, double value) {
  char *place = (char *)args + row->offset;
  switch (row->type) {
    case SW_PARAM_NUMBER: memcpy(place, &value, sizeof value); break;
    case SW_PARAM_INTEGER: {
      const long whole = isfinite(value) ? (long)value : 0;
      memcpy(place, &whole, sizeof whole);
      break;
    }
    case SW_PARAM_BOOLEAN:
    case SW_PARAM_CHOICE: {
      const int whole = isfinite(value) ? (int)value : 0;
      memcpy(place, &whole, sizeof whole);
      break;
    }
    case SW_PARAM_TEXT: place[0] = '\0'; break;
    case SW_PARAM_VECTOR: {
      const sw_vec all = {value, value, value};
      memcpy(place, &all, sizeof all);
      break;
    }
    case SW_PARAM_ROTATION: {
      const sw_quat none = sw_quat_identity();
      memcpy(place, &none, sizeof none);
      break;
    }
    case SW_PARAM_OTHER: break;
  }
}

void sw_params_default(const sw_params *params, void *args) {
  for (size_t i = 0; i < params->count; i++)
    sw_param_store(&params->rows[i], args, params->rows[i].def);
}

const sw_param *sw_params_find(const sw_params *params, const char *name) {
  for (size_t i = 0; i < params->count; i++)
    if (strcmp(params->rows[i].name, name) == 0) return &params->rows[i];
  return NULL;
}

static void range_text(const sw_param *row, char *buffer, size_t n) {
  const char *unit = strcmp(row->unit, "-") == 0 ? "" : row->unit;
  const char *space = *unit ? " " : "";
  const int low = isfinite(row->min), high = isfinite(row->max);
  const char *open = (row->flags & SW_PARAM_ABOVE_MIN) ? "(" : "[";
  const char *close = (row->flags & SW_PARAM_BELOW_MAX) ? ")" : "]";
  if (low && high)
    snprintf(buffer, n, "in %s%g, %g%s%s%s", open, row->min, row->max, close, space, unit);
  else if (low)
    snprintf(buffer, n, "%s %g%s%s", *open == '(' ? "above" : "at least", row->min, space, unit);
  else if (high)
    snprintf(buffer, n, "%s %g%s%s", *close == ')' ? "below" : "at most", row->max, space, unit);
  else
    snprintf(buffer, n, "a finite number%s%s", *unit ? " of " : "", unit);
}

sw_status sw_param_check(const char *object, const sw_param *row, double value, sw_error *err) {
  char range[96];
  const char *unit = strcmp(row->unit, "-") == 0 ? "" : row->unit;
  int fine = isfinite(value) && value >= row->min && value <= row->max;
  if ((row->flags & SW_PARAM_ABOVE_MIN) && !(value > row->min)) fine = 0;
  if ((row->flags & SW_PARAM_BELOW_MAX) && !(value < row->max)) fine = 0;
  if (fine && row->type == SW_PARAM_INTEGER && value != floor(value))
    return sw_fail(err, SW_EINVAL, "%s: %s = %.6g must be a whole number", object, row->name,
                   value);
  if (fine) return SW_OK;
  if (isnan(value)) value = fabs(value); /* 0/0 is -nan on some processors */
  range_text(row, range, sizeof range);
  return sw_fail(err, SW_EINVAL, "%s: %s = %.6g%s%s is not allowed; it must be %s", object,
                 row->name, value, *unit ? " " : "", unit, range);
}

/* Checks a number; NAN is allowed if the parameter may be left out. */
static sw_status check_given(const char *object, const sw_param *row, double value, int lenient,
                             sw_error *err) {
  const int may_miss = isnan(row->def) && !(row->flags & SW_PARAM_REQUIRED);
  if (isnan(value) && (lenient || may_miss)) return SW_OK;
  return sw_param_check(object, row, value, err);
}

static sw_status check_choice(const char *object, const sw_param *row, int value, sw_error *err) {
  for (int k = 0; row->choices[k]; k++)
    if (k == value) return SW_OK;
  return sw_fail(err, SW_EINVAL, "%s: %s has a value that is not one of its choices", object,
                 row->name);
}

sw_status sw_params_check(const sw_params *params, const void *args, int lenient, sw_error *err) {
  SW_ITEMS(const sw_param, row, params->rows, params->count) {
    const char *place = (const char *)args + row->offset;
    double x[4] = {0};
    long whole = 0;
    int flag = 0, numbers = 0;
    switch (row->type) {
      case SW_PARAM_NUMBER: memcpy(x, place, sizeof *x), numbers = 1; break;
      case SW_PARAM_VECTOR: memcpy(x, place, sizeof(sw_vec)), numbers = 3; break;
      case SW_PARAM_ROTATION: break;
      case SW_PARAM_INTEGER:
        memcpy(&whole, place, sizeof whole);
        x[0] = (double)whole, numbers = 1;
        break;
      case SW_PARAM_CHOICE:
        memcpy(&flag, place, sizeof flag);
        SW_TRY(check_choice(params->object, row, flag, err));
        break;
      case SW_PARAM_BOOLEAN:
      case SW_PARAM_TEXT:
      case SW_PARAM_OTHER: break;
    }
    for (int k = 0; k < numbers; k++) SW_TRY(check_given(params->object, row, x[k], lenient, err));
  }
  return SW_OK;
}

enum { LONGEST_WORD = 32 }; /* longer names are not compared [B] */

/* Optimal string alignment distance (insert, delete, replace, swap), without
 * regard to case. */
static int edit_distance(const char *a, const char *b) {
  const int n = (int)strlen(a), m = (int)strlen(b);
  int d[LONGEST_WORD + 1][LONGEST_WORD + 1];
  if (n > LONGEST_WORD || m > LONGEST_WORD) return LONGEST_WORD;
  for (int i = 0; i <= n; i++) d[i][0] = i;
  for (int j = 0; j <= m; j++) d[0][j] = j;
  for (int i = 1; i <= n; i++)
    for (int j = 1; j <= m; j++) {
      const int x = tolower((unsigned char)a[i - 1]), y = tolower((unsigned char)b[j - 1]);
      int best = d[i - 1][j - 1] + (x != y);
      if (d[i - 1][j] + 1 < best) best = d[i - 1][j] + 1;
      if (d[i][j - 1] + 1 < best) best = d[i][j - 1] + 1;
      if (i > 1 && j > 1 && x == tolower((unsigned char)b[j - 2]) &&
          tolower((unsigned char)a[i - 2]) == y && d[i - 2][j - 2] + 1 < best)
        best = d[i - 2][j - 2] + 1;
      d[i][j] = best;
    }
  return d[n][m];
}

static const struct {
  const char *word, *name;
} other_words[] = {
#define SW_OTHER(word, name) {word, name},
#include "base/other_words.def"
#undef SW_OTHER
};

enum { SW_SHORTEST_BEGIN = 4 }; /* shortest word that is taken for the beginning of a name [B] */

static int is_gap(char c) { return c == '_' || c == '-' || c == ' '; }

/* 1 if the words are the same without regard to case and gaps. */
static int are_same_words(const char *a, const char *b) {
  for (;; a++, b++) {
    while (is_gap(*a)) a++;
    while (is_gap(*b)) b++;
    if (tolower((unsigned char)*a) != tolower((unsigned char)*b)) return 0;
    if (!*a) return 1;
  }
}

static const char *name_at(const char *const *names, size_t stride, size_t i) {
  return *(const char *const *)(const void *)((const char *)names + i * stride);
}

/* Returns the name that others call by this word, or NULL. */
static const char *name_of_other(const char *word, const char *const *names, size_t stride,
                                 size_t count) {
  for (size_t w = 0; w < sizeof other_words / sizeof *other_words; w++) {
    if (!are_same_words(word, other_words[w].word)) continue;
    for (size_t i = 0; i < count; i++)
      if (!strcmp(name_at(names, stride, i), other_words[w].name)) return name_at(names, stride, i);
  }
  return NULL;
}

/* Returns the shortest name that begins with this word, without regard to case and gaps, or NULL.
 */
static const char *name_begun(const char *word, const char *const *names, size_t stride,
                              size_t count) {
  const char *found = NULL;
  if (strlen(word) < SW_SHORTEST_BEGIN) return NULL;
  for (size_t i = 0; i < count; i++) {
    const char *name = name_at(names, stride, i), *b = name, *a = word;
    for (; *a; b += *b != 0) {
      while (is_gap(*a)) a++;
      while (is_gap(*b)) b++;
      if (!*a || tolower((unsigned char)*a) != tolower((unsigned char)*b)) break;
      a++;
    }
    if (!*a && (!found || strlen(name) < strlen(found))) found = name;
  }
  return found;
}

const char *sw_nearest_name(const char *word, const char *const *names, size_t stride,
                            size_t count) {
  const char *nearest = name_of_other(word, names, stride, count);
  if (nearest) return nearest;
  const char *begun = name_begun(word, names, stride, count);
  const int length = (int)strlen(word);
  int limit = length <= 3 ? 1 : length <= 6 ? 2 : length / 3; /* largest distance of a typo [-] */
  for (size_t i = 0; i < count; i++) {
    const char *name = name_at(names, stride, i);
    const int distance = edit_distance(word, name);
    if (distance <= limit) nearest = name, limit = distance - 1;
  }
  return begun && limit > 0 ? begun : nearest; /* unless one letter is wrong */
}
