/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fork, signals and limits of child processes (POSIX; memory in use from /proc). */
#include "bind/process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
/* The sanitizer's shadow memory exceeds any limit on address space, so only RLIMIT_DATA is set. */
enum { LIMIT_AS = 0 };
#else
enum { LIMIT_AS = 1 };
#endif

int lsw_failed(lua_State *L) {
  const int why = errno;
  lua_pushnil(L);
  lua_pushstring(L, strerror(why));
  return 2;
}

pid_t lsw_process_fork(void) {
  sigset_t all, before;
  sigfillset(&all);
  sigprocmask(SIG_SETMASK, &all, &before);
  const pid_t pid = fork();
  const int why = errno;
  if (pid != 0) sigprocmask(SIG_SETMASK, &before, NULL);
  errno = why;
  return pid;
}

void lsw_process_follow(pid_t parent) {
#ifdef PR_SET_PDEATHSIG
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_DUMPABLE, 0); /* no core dump or crash report */
#endif
  if (getppid() != parent) _exit(1);
}

void lsw_process_reset_signals(void) {
  struct sigaction action;
  sigset_t none;
  for (int number = 1; number < NSIG; number++) {
    if (sigaction(number, NULL, &action) != 0) continue;
    if (action.sa_handler == SIG_DFL) continue;
    if (action.sa_handler == SIG_IGN && number != SIGXCPU) continue;
    signal(number, SIG_DFL);
  }
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, NULL);
}

/* Address space and data memory in use [B]; 0 if the system does not tell. */
static void memory_now(double *space, double *data) {
  char text[256] = "";
  unsigned long pages[6] = {0};
  *space = *data = 0;
  const int fd = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (fd < 0) return;
  const ssize_t n = read(fd, text, sizeof text - 1);
  close(fd);
  char *at = text;
  for (int k = 0; k < 6 && n > 0; k++) pages[k] = strtoul(at, &at, 10);
  *space = (double)pages[0] * (double)sysconf(_SC_PAGESIZE);
  *data = (double)pages[5] * (double)sysconf(_SC_PAGESIZE);
}

void lsw_process_limit(int what, double soft, double hard) {
  struct rlimit now;
  if (getrlimit(what, &now) != 0) return;
  if (now.rlim_cur == RLIM_INFINITY || (double)now.rlim_cur > soft) now.rlim_cur = (rlim_t)soft;
  if (now.rlim_max == RLIM_INFINITY || (double)now.rlim_max > hard) now.rlim_max = (rlim_t)hard;
  setrlimit(what, &now);
}

void lsw_process_limit_memory(double most) {
  double space, data;
  memory_now(&space, &data);
  if (LIMIT_AS && space > 0) lsw_process_limit(RLIMIT_AS, space + most, space + most);
  if (data > 0) lsw_process_limit(RLIMIT_DATA, data + most, data + most);
}

void lsw_process_silence(int first, int last, int kept) {
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (int fd = first; fd <= last; fd++) {
    if (fd == kept) continue;
    if (nothing >= 0)
      dup2(nothing, fd);
    else
      close(fd);
  }
}
