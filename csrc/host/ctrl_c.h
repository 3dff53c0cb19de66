/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ctrl-C: stops C code that polls sw_interrupted() and pure Lua loops alike. */
#ifndef HOST_CTRL_C_H
#define HOST_CTRL_C_H

#include <lua.h>

/* Install the handler, and put coroutine.resume and coroutine.wrap of L in
 * place that note which coroutine runs. L's libraries are open. */
void host_ctrl_c_open(lua_State *L);

/* Give Ctrl-C back to the system: before L is closed. */
void host_ctrl_c_close(void);

/* Put the handler in place (again). */
void host_ctrl_c_install(void);

/* Forget every earlier Ctrl-C: before a chunk is run. */
void host_ctrl_c_reset(void);

/* Was there one since the reset? */
int host_ctrl_c_seen(void);

/* While on, Ctrl-C only leaves a mark for host_ctrl_c_cancelled. */
void host_ctrl_c_at_prompt(int on);

/* Was the line at the prompt given up? Clears the mark. */
int host_ctrl_c_cancelled(void);

#endif
