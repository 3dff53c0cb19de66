/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores the lines of earlier sessions in a file. Without a file, a folder, or the
 * permission to write there is no history, and no error message. */
#include <fcntl.h>
#include <limits.h>
#include <readline/history.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/host.h"

enum { KEPT_LINES = 2000 };

static char file[PATH_MAX]; /* empty = no history file */

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

/* Makes the file and the folders above it. */
static int make_file(void) {
  for (char *p = file + 1; *p; p++) {
    if (*p != '/') continue;
    *p = 0;
    (void)mkdir(file, 0700); /* if this fails, the folder exists or the open below fails */
    *p = '/';
  }
  const int fd = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (fd >= 0) close(fd);
  return fd >= 0;
}

void host_history_open(void) {
  using_history();
  stifle_history(KEPT_LINES);
  find_file();
  if (file[0] && read_history(file) == 0 && history_length >= KEPT_LINES)
    (void)history_truncate_file(file, KEPT_LINES);
}

void host_history_add(const char *line) {
  if (line[strspn(line, " \t\n")] == 0) return;
  const HIST_ENTRY *before = history_length ? history_get(history_base + history_length - 1) : NULL;
  if (before && strcmp(before->line, line) == 0) return;
  add_history(line);
  /* each line at once, so that nothing is lost if the program is killed */
  if (file[0] && append_history(1, file) != 0 && !(make_file() && append_history(1, file) == 0))
    file[0] = 0;
}
