/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions that the files of the host program share. */
#ifndef HOST_HOST_H
#define HOST_HOST_H

#include <lua.h>

enum {
  HOST_OK = 0,
  HOST_FAILED = 1,
  HOST_USAGE = 2, /* with --check also: no check was made */
  HOST_CHECK_FAILS = 3,
  HOST_CHECK_OPEN = 4,
  HOST_INTERRUPTED = 130
};

/* --- options.c: the command line ------------------------------------------ */

typedef struct host_options {
  int argc;
  char **argv;
  int script;      /* index in argv of the script's name, or 0 */
  int command;     /* index in argv of a word such as `doc`, or 0 */
  int codes;       /* number of -e options */
  int interactive; /* -i, or a terminal and no script or option */
  int view;        /* --view: scenes are shown in a browser while they run */
  int functions;   /* --functions: pages of the view may type Lua functions */
  int check;       /* --check: the exit code is the result of the script's checks */
  int version, help;
  const char *log; /* file of --log, or NULL */
} host_options;

/* Reads the command line. HOST_USAGE after a message about the mistake. */
int host_options_read(host_options *o, int argc, char **argv);

/* Returns the code of the first -e option at or after argv index *at, and moves *at
 * past it; NULL if there are no more. */
const char *host_options_code(const host_options *o, int *at);

void host_options_help(void);

/* Sets the global `arg` as the stock interpreter does. */
void host_push_arg(lua_State *L, const host_options *o);

/* --- paths.c: the places of the Lua files ----------------------------------- */

/* Adds the library's and the script's folders to package.path and fills
 * package.loaded["softworld.host"]. */
void host_paths_open(lua_State *L, const host_options *o);

/* 1 if this chunk source ("@/usr/share/...") is a file of the library. */
int host_is_library(lua_State *L, const char *source);

/* --- run.c: --log ------------------------------------------------------------- */

/* Opens the log file. HOST_FAILED after a message why it cannot be written. */
int host_log_open(lua_State *L, const host_options *o);

/* --- traceback.c ----------------------------------------------------------- */

/* A message handler for lua_pcall. Returns the error value as text with the position of
 * the user's line, then the user's calls that led there. */
int host_traceback(lua_State *L);

/* If the text on top of L has a position in a library file that is among the calls of
 * co from level on, replaces it by the position of the user's line that called the
 * library. */
void host_move_position(lua_State *L, lua_State *co, int level);

/* --- run.c ----------------------------------------------------------------- */

/* Calls the function below count arguments with host_traceback; results: how many to
 * keep, or LUA_MULTRET. Returns a Lua status; after a failure the text is on top. */
int host_call(lua_State *L, int count, int results);

/* Prints the text on top of the stack to stderr and pops it. Returns the exit code
 * (HOST_FAILED or HOST_INTERRUPTED). */
int host_report(lua_State *L);

int host_run_code(lua_State *L, const char *code);
int host_run_script(lua_State *L, const host_options *o);

/* `softworld doc ...`: calls the library's module of the command's name with the
 * words that follow. */
int host_run_command(lua_State *L, const host_options *o);

/* --- repl.c, line.c, history.c --------------------------------------------- */

/* Reads, runs and prints until the end of input. Returns the exit code. */
int host_repl(lua_State *L);

enum { LINE_READ, LINE_CANCELLED, LINE_END };

/* Prepares the line editor. The completer (a function of the line
 * before the word and the word) is on top of the stack and is popped. */
void host_line_open(lua_State *L);

/* Reads one line and pushes it without its end (LINE_READ only). */
int host_line(lua_State *L, const char *prompt);

/* Reads what was typed in earlier sessions; stores a chunk, of one or more lines, for later ones. */
void host_history_open(void);
void host_history_add(const char *chunk);

#endif
