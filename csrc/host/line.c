/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The line editor: GNU readline on a terminal, plain reading elsewhere.
 * readline's own loop cannot cancel a line at a signal, so this loop passes it key
 * by key. SIGINT is unblocked only while waiting for a key; so no Ctrl-C is missed. */
#include <lauxlib.h>
#include <locale.h>
#include <poll.h>
#include <readline/readline.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bind/locale.h"
#include "host/ctrl_c.h"
#include "host/host.h"

static lua_State *state; /* for the completer; readline has no user pointer */
static const char completer_key;
static sigset_t open_mask; /* the signal mask outside the editor */
static char *typed;        /* the line, once done is 1 */
static int done;

/* --- completion ----------------------------------------------------------- */

/* 1 if the cursor is inside a string. */
static int in_string(void) {
  char quote = 0;
  for (int i = 0; i < rl_point; i++) {
    const char c = rl_line_buffer[i];
    if (quote && c == '\\')
      i++;
    else if (quote && c == quote)
      quote = 0;
    else if (!quote && (c == '"' || c == '\''))
      quote = c;
    else if (!quote && c == '-' && rl_line_buffer[i + 1] == '-')
      return 0;
  }
  return quote != 0;
}

/* Returns the characters that end a word: inside strings words are file names, elsewhere Lua
 * names. */
static char *word_breaks(void) {
  static char string[] = "\"'", code[] = " \t\n\"'`@$><=;|&{([+-*/%^~#)]},.:!?";
  return in_string() ? string : code;
}

/* Returns a copy of the next candidate of the table on top of the stack; NULL at its end. */
static char *next_candidate(const char *word, int first) {
  static int i;
  (void)word;
  if (first == 0) i = 0;
  lua_rawgeti(state, -1, ++i);
  const char *name = lua_type(state, -1) == LUA_TSTRING ? lua_tostring(state, -1) : NULL;
  char *copy = name ? strdup(name) : NULL;
  lua_pop(state, 1);
  return copy;
}

/* Calls the completer and leaves its answer or an error value on the stack; 1 if it is a table. */
static int ask_completer(const char *word, int start) {
  sigset_t kept;
  lua_rawgetp(state, LUA_REGISTRYINDEX, &completer_key);
  lua_pushlstring(state, rl_line_buffer, (size_t)start);
  lua_pushstring(state, word);
  host_ctrl_c_reset();
  /* The completer may run the user's metamethods. Ctrl-C must stop them, and closing the
   * window must end the program; readline's handlers would only record the signals. */
  rl_clear_signals();
  host_ctrl_c_at_prompt(0);
  sigprocmask(SIG_SETMASK, &open_mask, &kept);
  const int status = lua_pcall(state, 2, 1, 0);
  sigprocmask(SIG_SETMASK, &kept, NULL);
  host_ctrl_c_at_prompt(1);
  rl_set_signals();
  host_ctrl_c_install();
  host_ctrl_c_reset();
  return status == LUA_OK && lua_istable(state, -1);
}

static char **complete(const char *word, int start, int end) {
  char **matches = NULL;
  (void)end;
  rl_completion_append_character = 0;
  const int quoted =
      in_string(); /* choices of a parameter; without any, readline completes file names */
  rl_attempted_completion_over = !quoted;
  if (!lua_checkstack(state, 8)) return NULL;
  if (ask_completer(word, start)) matches = rl_completion_matches(word, next_candidate);
  if (quoted && matches) rl_attempted_completion_over = rl_completion_suppress_append = 1;
  lua_pop(state, 1);
  return matches;
}

/* --- reading -------------------------------------------------------------- */

static void take_line(char *line) {
  typed = line;
  done = 1;
  rl_callback_handler_remove(); /* restores the terminal */
}

static void give_up_line(void) {
  fputs("^C\n", rl_outstream);
  rl_free_line_state();
  rl_callback_sigcleanup();
  rl_callback_handler_remove();
}

/* Lets readline handle a new window size, a stop (Ctrl-Z) or an end. After a stop the line must be
 * redrawn here. */
static void handle_signal(void) {
  const int number = rl_pending_signal();
  if (!number) return;
  rl_check_signals();
  if (number != SIGTSTP) return;
  rl_on_new_line();
  rl_redisplay();
}

/* Passes keys to readline until the line is done; 0 if the user cancelled it. */
static int feed(void) {
  struct pollfd input = {STDIN_FILENO, POLLIN, 0};
  while (!done) {
    if (ppoll(&input, 1, NULL, &open_mask) >= 0) {
      rl_callback_read_char();
    } else if (host_ctrl_c_cancelled()) {
      give_up_line();
      return 0;
    } else {
      handle_signal();
    }
  }
  return 1;
}

static int edit_line(lua_State *L, const char *prompt) {
  sigset_t blocked;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGINT);
  sigprocmask(SIG_BLOCK, &blocked, &open_mask);
  host_ctrl_c_at_prompt(1);
  typed = NULL;
  done = 0;
  rl_callback_handler_install(prompt, take_line);
  host_ctrl_c_install(); /* replaces readline's handler, which would not cancel the line */
  const int whole = feed();
  host_ctrl_c_at_prompt(0);
  sigprocmask(SIG_SETMASK, &open_mask, NULL);
  if (!whole) return LINE_CANCELLED;
  if (!typed) {
    fputc('\n', rl_outstream); /* the shell's prompt begins on a new line */
    return LINE_END;
  }
  lua_pushstring(L, typed);
  free(typed);
  return LINE_READ;
}

/* Reads a line without editor and prompt. It may contain any bytes and have any length. */
static int read_line(lua_State *L) {
  char *line = NULL;
  size_t size = 0;
  ssize_t n = getline(&line, &size, stdin);
  if (n > 0 && line[n - 1] == '\n') n--;
  const int got = n >= 0;
  if (got) lua_pushlstring(L, line, (size_t)n);
  free(line);
  return got ? LINE_READ : LINE_END;
}

int host_line(lua_State *L, const char *prompt) {
  clearerr(stdin); /* a Ctrl-C during io.read sets the error flag of stdin */
  return isatty(STDIN_FILENO) ? edit_line(L, prompt) : read_line(L);
}

void host_line_open(lua_State *L) {
  const int completes = lua_isfunction(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &completer_key);
  if (!isatty(STDIN_FILENO)) return;
  setlocale(LC_CTYPE, ""); /* for wide characters in the editor; numbers do not change */
  lsw_locale_renew();
  state = L;
  rl_readline_name = "softworld";    /* for $if softworld in ~/.inputrc */
  rl_persistent_signal_handlers = 1; /* else readline removes them while it waits for a key */
  rl_outstream = isatty(STDOUT_FILENO) ? stdout : stderr;
  rl_completion_word_break_hook = word_breaks;
  if (completes) rl_attempted_completion_function = complete;
  host_history_open();
}
