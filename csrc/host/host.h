/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the parts of the host program offer each other. */
#ifndef HOST_HOST_H
#define HOST_HOST_H

#include <lua.h>

enum {
  HOST_OK = 0,
  HOST_FAILED = 1,
  HOST_USAGE = 2, /* of --check also: no check was made */
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
  int interactive; /* -i, or nothing to do and a terminal to do it on */
  int view;        /* --view: scenes are shown in a browser while they run */
  int functions;   /* --functions: its pages may type Lua functions */
  int check;       /* --check: the exit code tells what the script's checks found */
  int version, help;
  const char *log; /* file of --log, or NULL */
} host_options;

/* Read the command line; HOST_USAGE after telling the user what is wrong. */
int host_options_read(host_options *o, int argc, char **argv);

/* The code of the first -e option at or after argv index *at, which moves
 * past it; NULL when there are no more. */
const char *host_options_code(const host_options *o, int *at);

void host_options_help(void);

/* Set the global `arg` as the stock interpreter does. */
void host_push_arg(lua_State *L, const host_options *o);

/* --- paths.c: where the Lua files are -------------------------------------- */

/* Put the library and the script's directory on package.path and fill
 * package.loaded["softworld.host"]. */
void host_paths_open(lua_State *L, const host_options *o);

/* Is this chunk source ("@/usr/share/...") a file of the library? */
int host_is_library(lua_State *L, const char *source);

/* --- run.c, of --log --------------------------------------------------------- */

/* Begin the file; HOST_FAILED after telling why it cannot be written. */
int host_log_open(lua_State *L, const host_options *o);

/* --- traceback.c ----------------------------------------------------------- */

/* A message handler for lua_pcall: the error value as text, positioned at the
 * user's line, then the calls of the user's that led there. */
int host_traceback(lua_State *L);

/* When the text on top of L is positioned in a library file that is among the
 * calls of co from level on, move it to the line of the user's that called the
 * library. */
void host_move_position(lua_State *L, lua_State *co, int level);

/* --- run.c ----------------------------------------------------------------- */

/* Call the function below count arguments with host_traceback, keep results
 * (or LUA_MULTRET). After a failure the text is on top. Gives a Lua status. */
int host_call(lua_State *L, int count, int results);

/* Print the text on top of the stack to stderr, drop it, give the exit code
 * (HOST_FAILED or HOST_INTERRUPTED). */
int host_report(lua_State *L);

int host_run_code(lua_State *L, const char *code);
int host_run_script(lua_State *L, const host_options *o);

/* `softworld doc ...`: call the library's module of the command's name with the
 * words that follow. */
int host_run_command(lua_State *L, const host_options *o);

/* --- repl.c, line.c, history.c --------------------------------------------- */

/* Read, run, print until the end of input. Gives the exit code. */
int host_repl(lua_State *L);

enum { LINE_READ, LINE_CANCELLED, LINE_END };

/* Prepare the line editor. The completer (a function of the line
 * before the word and the word) is on top of the stack and is popped. */
void host_line_open(lua_State *L);

/* Read one line without its end and push it (LINE_READ only). */
int host_line(lua_State *L, const char *prompt);

/* Read the lines of earlier sessions; keep a line for later ones. */
void host_history_open(void);
void host_history_add(const char *line);

#endif
