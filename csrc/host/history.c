/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores what was typed in earlier sessions in a file. Without a file, a folder, or the
 * permission to write there is no history, and no error message. A chunk of several lines is one
 * entry; in the file its line ends are LINE_MARK, because readline reads an entry from each line.
 */
#include <limits.h>
#include <readline/history.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "host/host.h"

enum { KEPT_LINES = 2000, LINE_MARK = '\x1e' };

static char file[PATH_MAX]; /* empty = no history file */

static int is_open; /* not without a terminal */

static void find_file(void) {
  const char *state = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
  int n = -1;
  if (state && *state == '/') {
    n = snprintf(file, sizeof file, "%s/softworld/history", state);
  } else if (home && *home == '/') {
    n = snprintf(file, sizeof file, "%s/.local/state/softworld/history", home);
  }
  if (n < 0 || n >= (int)sizeof file) file[0] = 0;
}

/* Makes the folders of the file. */
static void make_folders(void) {
  for (char *p = file + 1; *p; p++) {
    if (*p != '/') continue;
    *p = 0;
    (void)mkdir(file, 0700); /* if this fails, the folder exists or the file cannot be opened */
    *p = '/';
  }
}

static void replace(char *text, char from, char to) {
  for (; *text; text++)
    if (*text == from) *text = to;
}

/* Adds an entry to the file; 0 if that fails. */
static int append(const char *entry) {
  FILE *f = fopen(file, "ae");
  if (!f) return 0;
  char *text = strdup(entry);
  if (text) replace(text, '\n', LINE_MARK);
  const int written = text && fchmod(fileno(f), 0600) == 0 && fprintf(f, "%s\n", text) > 0;
  free(text);
  return fclose(f) == 0 && written;
}

void host_history_open(void) {
  using_history();
  stifle_history(KEPT_LINES);
  find_file();
  is_open = 1;
  if (!file[0] || read_history(file) != 0) return;
  if (history_length >= KEPT_LINES) (void)history_truncate_file(file, KEPT_LINES);
  for (int i = 0; i < history_length; i++) {
    const HIST_ENTRY *entry = history_get(history_base + i);
    if (entry) replace(entry->line, LINE_MARK, '\n');
  }
}

void host_history_add(const char *chunk) {
  if (!is_open || chunk[strspn(chunk, " \t\n")] == 0) return;
  const HIST_ENTRY *before = history_length ? history_get(history_base + history_length - 1) : NULL;
  if (before && strcmp(before->line, chunk) == 0) return;
  add_history(chunk);
  if (!file[0] || append(chunk)) return; /* at once: nothing is lost if the program is killed */
  make_folders();
  if (!append(chunk)) file[0] = 0;
}
