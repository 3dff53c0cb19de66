/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What processes forked from this one have in common: they end with it, have signals of their own
 * and limits on what they take. */
#ifndef LSW_PROCESS_H
#define LSW_PROCESS_H

#include <lua.h>
#include <sys/types.h>

/* Push nil and what errno says; return 2. */
int lsw_failed(lua_State *L);

/* Fork without a chance for this process's signal handlers to run in the child. As fork(2); errno.
 */
pid_t lsw_process_fork(void);

/* In the child: it is killed when the parent ends, however that ends; leaves at once where it has
 * ended already. */
void lsw_process_follow(pid_t parent);

/* In the child: the parent's handlers are not for this process; what it ignores stays ignored. */
void lsw_process_reset_signals(void);

/* In the child: lower a limit of setrlimit(2); the one that is there stays where it is lower. */
void lsw_process_limit(int what, double soft, double hard);

/* In the child: so much more memory than now [B]. */
void lsw_process_limit_memory(double most);

/* In the child: /dev/null as the files from first to last (0 standard input, 2 standard error), but
 * for the file kept. */
void lsw_process_silence(int first, int last, int kept);

#endif
