/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Switches stacks with swapcontext (POSIX.1-2001). */
#include "calibrate/fiber.h"

#include <ucontext.h>

#include "base/alloc.h"

enum { STACK = 1 << 18 }; /* minimisers need a few kB; their tables are on the heap [B] */

struct sw_fiber {
  ucontext_t inside, outside;
  void (*run)(void *user);
  void *user;
  int ended;
  const void *outer; /* the resumer's stack, as reported by the sanitizer */
  size_t outer_size; /* [B] */
  char *stack;
};

static _Thread_local sw_fiber *beginning; /* makecontext only passes integers */

/* The address sanitizer must be told which stack is in use. */
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/common_interface_defs.h>
#define LEAVE(save, bottom, size) __sanitizer_start_switch_fiber(save, bottom, size)
#define ARRIVE(saved, bottom, size) __sanitizer_finish_switch_fiber(saved, bottom, size)
#else
#define LEAVE(save, bottom, size) ((void)(save))
#define ARRIVE(saved, bottom, size) ((void)(saved))
#endif

static void enter(void) {
  sw_fiber *f = beginning;
  ARRIVE(NULL, &f->outer, &f->outer_size);
  f->run(f->user);
  f->ended = 1;
  LEAVE(NULL, f->outer, f->outer_size);
  setcontext(&f->outside);
}

sw_fiber *sw_fiber_new(void (*run)(void *user), void *user) {
  sw_fiber *f = sw_alloc(1, sizeof *f);
  char *stack = sw_alloc_bytes(STACK);
  if (!f || !stack || getcontext(&f->inside) != 0) {
    sw_free(f);
    sw_free(stack);
    return NULL;
  }
  f->stack = stack;
  f->run = run;
  f->user = user;
  f->inside.uc_stack.ss_sp = stack;
  f->inside.uc_stack.ss_size = STACK;
  f->inside.uc_link = NULL;
  makecontext(&f->inside, enter, 0);
  return f;
}

int sw_fiber_resume(sw_fiber *f) {
  void *ours = NULL;
  if (f->ended) return 0;
  beginning = f;
  LEAVE(&ours, f->stack, STACK);
  swapcontext(&f->outside, &f->inside);
  ARRIVE(ours, NULL, NULL);
  return !f->ended;
}

void sw_fiber_yield(sw_fiber *f) {
  void *ours = NULL;
  LEAVE(&ours, f->outer, f->outer_size);
  swapcontext(&f->inside, &f->outside);
  ARRIVE(ours, &f->outer, &f->outer_size);
}

void sw_fiber_free(sw_fiber *f) {
  if (!f) return;
  sw_free(f->stack);
  sw_free(f);
}
