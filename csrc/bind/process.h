/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions for processes forked from this one: they end with their parent, have default signal
 * handlers, and limits on memory and time. */
#ifndef LSW_PROCESS_H
#define LSW_PROCESS_H

#include <lua.h>
#include <sys/types.h>

/* Pushes nil and the text of errno; returns 2. */
int lsw_failed(lua_State *L);

/* Forks as fork(2), errno included. Signals are blocked in the child, so that none of this
 * process's handlers runs there. */
pid_t lsw_process_fork(void);

/* In the child: makes the system kill it when the parent ends for any reason. Exits at once if the
 * parent has already ended. */
void lsw_process_follow(pid_t parent);

/* In the child: replaces the parent's signal handlers by the default ones and unblocks all signals.
 * Ignored signals stay ignored, but for SIGXCPU. */
void lsw_process_reset_signals(void);

/* In the child: lowers a limit of setrlimit(2). A limit that is lower already stays. */
void lsw_process_limit(int what, double soft, double hard);

/* In the child: limits memory to the present use plus most [B]. */
void lsw_process_limit_memory(double most);

/* In the child: opens /dev/null as the files from first to last (0 standard input, 2 standard
 * error), except the file kept. */
void lsw_process_silence(int first, int last, int kept);

#endif
