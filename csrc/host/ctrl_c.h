/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ctrl-C: stops both C code that polls sw_interrupted() and pure Lua loops. */
#ifndef HOST_CTRL_C_H
#define HOST_CTRL_C_H

#include <lua.h>

/* Installs the signal handler and replaces coroutine.resume and coroutine.wrap of L by
 * versions that note the running coroutine. L's libraries must be open. */
void host_ctrl_c_open(lua_State *L);

/* Restores the system's handling of Ctrl-C. Call it before L is closed. */
void host_ctrl_c_close(void);

/* Installs the signal handler (again). */
void host_ctrl_c_install(void);

/* Forgets every earlier Ctrl-C. Call it before a chunk is run. */
void host_ctrl_c_reset(void);

/* 1 if there was a Ctrl-C since the reset. */
int host_ctrl_c_seen(void);

/* While on, Ctrl-C only sets a mark for host_ctrl_c_cancelled. */
void host_ctrl_c_at_prompt(int on);

/* 1 if the user cancelled the line at the prompt; clears the mark. */
int host_ctrl_c_cancelled(void);

#endif
