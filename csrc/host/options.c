/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the command line. */
#include <lauxlib.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "host/host.h"
#include "softworld.h"

static const char help_text[] =
    "usage: softworld [options] [script [arguments]]\n"
    "       softworld doc [topic] | new name | lint script [arguments]\n"
    "  script       run this Lua file; '-' reads it from standard input\n"
    "  doc          show a topic of the manual, or all topics (./doc is a script of that name)\n"
    "  new          write a starting script name.lua\n"
    "  lint         build the scenes of a script without running them; warn of likely mistakes\n"
    "  --check      set the exit code by the script's checks of runs (run:check), see below\n"
    "  --log file   append to this file each run, its time and how it ended\n"
    "  -e code      run this Lua code first (may be repeated)\n"
    "  -i           continue at the prompt afterwards\n"
    "  --view       show the script's scenes in a browser while they run, until Ctrl-C;\n"
    "               without a script: start with an empty scene and build it there\n"
    "  --functions  with --view: pages may type Lua functions, which can do whatever you can\n"
    "  -v           show the version (also --version)\n"
    "  -h           show this text (also --help)\n"
    "  --           end of the options\n"
    "Without script and options: the prompt on a terminal, else standard input is run.\n"
    "Exit codes: 0 done, 1 an error in the script, 2 wrong usage, 130 stopped by Ctrl-C;\n"
    "of --check: 0 all pass, 2 no check was made, 3 one fails, or a run failed or was cut short,\n"
    "4 none fails but one is open.\n"
    "SOFTWORLD_TRACEBACK=full shows every call of a traceback.\n";

void host_options_help(void) { fputs(help_text, stdout); }

static int usage(const char *what, const char *word) {
  fprintf(stderr, "softworld: %s '%s'\n", what, word);
  fputs(
      "usage: softworld [-e code] [-i] [-v] [--view [--functions]] [--check] [--log file] [script "
      "[arguments]]; "
      "softworld "
      "doc [topic]; "
      "see softworld --help\n",
      stderr);
  return HOST_USAGE;
}

static int no_option(const char *word) {
  static const char *const options[] = {"--check", "--functions", "--help",
                                        "--log",   "--version",   "--view"};
  const char *near =
      sw_nearest_name(word, options, sizeof options[0], sizeof options / sizeof options[0]);
  if (!near) return usage("there is no option", word);
  fprintf(stderr, "softworld: there is no option '%s'; did you mean '%s'?\n", word, near);
  return HOST_USAGE;
}

static int is_help(const char *word) {
  return strcmp(word, "-h") == 0 || strcmp(word, "--help") == 0;
}

/* Reads the option at argv[*at] and sets *at to its last word. */
static int read_option(host_options *o, int *at) {
  const char *word = o->argv[*at];
  if (strncmp(word, "-e", 2) == 0) {
    if (!word[2] && ++*at >= o->argc) return usage("code is missing after", "-e");
    o->codes++;
  } else if (strcmp(word, "--log") == 0) {
    if (++*at >= o->argc) return usage("a file is missing after", "--log");
    o->log = o->argv[*at];
  } else if (strcmp(word, "-i") == 0) {
    o->interactive = 1;
  } else if (strcmp(word, "--view") == 0) {
    o->view = 1;
  } else if (strcmp(word, "--functions") == 0) {
    o->functions = 1;
  } else if (strcmp(word, "--check") == 0) {
    o->check = 1;
  } else if (strcmp(word, "-v") == 0 || strcmp(word, "--version") == 0) {
    o->version = 1;
  } else if (is_help(word)) {
    o->help = 1;
  } else {
    return no_option(word);
  }
  return HOST_OK;
}

static int is_command(const char *word) {
  static const char *const commands[] = {"doc", "new", "lint"};
  for (size_t k = 0; k < sizeof commands / sizeof *commands; k++)
    if (strcmp(word, commands[k]) == 0) return 1;
  return 0;
}

int host_options_read(host_options *o, int argc, char **argv) {
  *o = (host_options){.argc = argc, .argv = argv};
  int i = 1;
  for (; i < argc && argv[i][0] == '-' && argv[i][1]; i++) {
    if (strcmp(argv[i], "--") == 0) {
      i++;
      break;
    }
    const int status = read_option(o, &i);
    if (status != HOST_OK) return status;
  }
  o->command = i == 1 && i < argc && is_command(argv[i]) ? i : 0;
  if (o->command && i + 1 < argc && is_help(argv[i + 1])) o->help = 1;
  o->script = i < argc && !o->command ? i : 0;
  if (o->view && !o->script && (o->codes || o->version || o->interactive))
    return usage("a script is missing after", "--view");
  if (o->functions && !o->view) return usage("--view is missing beside", "--functions");
  if (o->check && !o->script) return usage("a script is missing after", "--check");
  if (o->check && (o->interactive || o->view))
    return usage("neither -i nor --view goes with", "--check");
  if (!o->script && !o->command && !o->view && !o->codes && !o->version)
    o->interactive |= isatty(STDIN_FILENO);
  return HOST_OK;
}

const char *host_options_code(const host_options *o, int *at) {
  const int end = o->script ? o->script : o->argc;
  for (int i = *at; i < end; i++) {
    if (strcmp(o->argv[i], "--") == 0) break;
    if (strcmp(o->argv[i], "--log") == 0) i++; /* the log file may be called -e */
    if (i >= end || strncmp(o->argv[i], "-e", 2) != 0 || strcmp(o->argv[i - 1], "--log") == 0)
      continue;
    const char *code = o->argv[i][2] ? o->argv[i] + 2 : o->argv[++i];
    *at = i + 1;
    return code;
  }
  *at = end;
  return NULL;
}

void host_push_arg(lua_State *L, const host_options *o) {
  lua_createtable(L, o->argc, o->script + 1);
  for (int i = 0; i < o->argc; i++) {
    lua_pushstring(L, o->argv[i]);
    lua_rawseti(L, -2, i - o->script);
  }
  lua_setglobal(L, "arg");
}
