/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a mesh file in a child process. Assimp can end the process on a damaged file, corrupt its
 * heap when memory runs out, and take any time, and it never polls for Ctrl-C. So a fork of this
 * process reads, with limits on memory and time, and sends the triangles through a pipe. It must be
 * a fork: the program that has loaded the core may be a stock Lua, so no other program is there to
 * start. Processes are started only here and for the workers of a study, never in the core.
 *
 * The child does not use Lua. It reads, writes to the pipe and ends with _exit, which runs none of
 * the parent's exit handlers and does not flush its files. Its standard files are /dev/null, to
 * drop the messages of the C++ runtime at an abort. */
#include "bind/mesh_child.h"

#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bind/process.h"
#include "softworld.h"

#if defined(__SANITIZE_ADDRESS__)
enum { SLOWER = 5 };
#else
enum { SLOWER = 1 };
#endif

#define MEMORY_LEAST (256e6)           /* memory allowed for any file [B] */
#define MEMORY_PER_BYTE 150.0          /* more memory for each byte of the file [-] */
#define CPU_LEAST 4.0                  /* processor time allowed for any file [s] */
#define CPU_PER_BYTE 1e-6              /* more processor time for each byte of the file [s] */
#define WALL_PER_CPU 10.0              /* wall time over CPU time; other processes run too [-] */
#define WALL_LEAST 60.0                /* wall time allowed for any file [s] */
#define SLICE 0.1                      /* time between two polls for Ctrl-C [s] */
#define MOST_ITEMS ((uint64_t)1 << 28) /* most points or triangles in a reply [-] */

typedef struct reply {
  uint32_t word; /* REPLY; any other value is not from this code */
  int32_t status;
  uint64_t vertex_count, triangle_count;
  uint64_t requests; /* memory requests of the child, added to the parent's count [-] */
  sw_error err;
} reply;

enum { REPLY = 0x534d4553 };

typedef struct limits {
  double memory; /* [B] */
  double cpu;    /* [s] */
  double wall;   /* only time in which this process runs counts [s] */
} limits;

static limits limits_of(const sw_mesh_file *file) {
  const double size = (double)file->byte_count;
  const double cpu = SLOWER * (CPU_LEAST + CPU_PER_BYTE * size);
  return (limits){SLOWER * (MEMORY_LEAST + MEMORY_PER_BYTE * size), cpu,
                  WALL_LEAST + WALL_PER_CPU * cpu};
}

/* --- the child ------------------------------------------------------------ */

static void set_limits(const limits *most) {
  lsw_process_limit_memory(most->memory);
  lsw_process_limit(RLIMIT_CPU, ceil(most->cpu), ceil(most->cpu) + 1);
  lsw_process_limit(RLIMIT_CORE, 0, 0);
}

static int send_all(int fd, const void *bytes, size_t count) {
  const char *at = bytes;
  while (count > 0) {
    const ssize_t n = write(fd, at, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return 0;
    at += n, count -= (size_t)n;
  }
  return 1;
}

/* Makes malloc use huge pages. Assimp's buffer for OBJ files has 16 MB for any size of file;
 * getting it in small pages takes twenty times as long as reading a small mesh. */
static void widen_pages(void) {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
  enum { ROOM = 1 << 25, PAGE = 1 << 21 }; /* [B] */
  mallopt(M_MMAP_THRESHOLD, 2 * ROOM);
  mallopt(M_TRIM_THRESHOLD, 2 * ROOM);
  char *room = malloc(ROOM); /* stays in the heap when freed */
  if (room) madvise(room + (PAGE - (uintptr_t)room % PAGE), ROOM - PAGE, MADV_HUGEPAGE);
  free(room);
#endif
}

static void child(const sw_mesh_file *file, const limits *most, int fd, pid_t parent) {
  sw_mesh_data data = {0};
  reply r = {.word = REPLY};
  lsw_process_follow(parent);
  lsw_process_silence(0, 2, fd);
  set_limits(most);
  lsw_process_reset_signals();
  widen_pages();
  const size_t before = sw_alloc_count();
  r.status = (int32_t)sw_mesh_read(file, &data, &r.err);
  if (strstr(r.err.text, "bad_alloc")) r.status = SW_ELIMIT;
  r.requests = sw_alloc_count() - before;
  r.vertex_count = data.vertex_count, r.triangle_count = data.triangle_count;
  _exit(send_all(fd, &r, sizeof r) &&
                send_all(fd, data.vertices, 3 * data.vertex_count * sizeof *data.vertices) &&
                send_all(fd, data.indices, 3 * data.triangle_count * sizeof *data.indices)
            ? 0
            : 1);
}

/* --- the parent ----------------------------------------------------------- */

typedef enum outcome { WHOLE, SHORT, LATE, STOPPED } outcome;

static lua_State *asking; /* main thread of the Lua state that asked for the file, or NULL */

void lsw_mesh_child_for(lua_State *L) {
  lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_MAINTHREAD);
  asking = lua_tothread(L, -1);
  lua_pop(L, 1);
}

typedef struct reading {
  pid_t pid;
  int fd;        /* the pipe's reading end */
  double waited; /* so far [s] */
  double most;   /* longest wait [s] */
  lua_Hook hook; /* hook of the asking Lua at the start of the reading */
} reading;

/* 1 if the user wants to stop. Stock Lua sets a hook at Ctrl-C, which the terminal sends to
 * the child too. */
static int stop_wanted(const reading *r) {
  return sw_interrupted() || (asking && lua_gethook(asking) != r->hook);
}

/* Waits until there is something to read. Time in which this process was stopped (Ctrl-Z) does not
 * count. */
static outcome wait_for_bytes(reading *r) {
  for (;;) {
    struct pollfd p = {r->fd, POLLIN, 0};
    const double start = sw_wall_clock();
    const int n = poll(&p, 1, (int)(1e3 * SLICE));
    r->waited += fmin(sw_wall_clock() - start, 2 * SLICE);
    if (stop_wanted(r)) return STOPPED;
    if (n > 0) return WHOLE;
    if (r->waited > r->most) return LATE;
  }
}

static outcome receive(reading *r, void *bytes, size_t count) {
  char *at = bytes;
  while (count > 0) {
    const outcome o = wait_for_bytes(r);
    if (o != WHOLE) return o;
    const ssize_t n = read(r->fd, at, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return SHORT;
    at += n, count -= (size_t)n;
  }
  return WHOLE;
}

/* Checks the data from the pipe like a file's, since the child's heap may have been corrupted. */
static int sensible(const sw_mesh_data *data) {
  for (size_t k = 0; k < 3 * data->triangle_count; k++)
    if (data->indices[k] < 0 || (size_t)data->indices[k] >= data->vertex_count) return 0;
  return 1;
}

static outcome receive_data(reading *r, const reply *from, sw_mesh_data *out) {
  if (from->vertex_count > MOST_ITEMS || from->triangle_count > MOST_ITEMS) return SHORT;
  out->vertex_count = (size_t)from->vertex_count;
  out->triangle_count = (size_t)from->triangle_count;
  out->vertices = sw_alloc(3 * out->vertex_count, sizeof *out->vertices);
  out->indices = sw_alloc(3 * out->triangle_count, sizeof *out->indices);
  if (!out->vertices || !out->indices) return WHOLE; /* the caller reports SW_ENOMEM */
  outcome o = receive(r, out->vertices, 3 * out->vertex_count * sizeof *out->vertices);
  if (o == WHOLE) o = receive(r, out->indices, 3 * out->triangle_count * sizeof *out->indices);
  if (o == WHOLE && !sensible(out)) o = SHORT;
  return o;
}

/* Waits for the child's end and returns its exit status; kills it first if kill_it. -1: no status,
 * as in a program that ignores its children. */
static int bury(const reading *r, int kill_it) {
  int status = -1;
  if (kill_it) kill(r->pid, SIGKILL);
  close(r->fd);
  while (waitpid(r->pid, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

static sw_status too_much(const sw_mesh_file *file, const limits *most, sw_error *err) {
  return sw_fail(
      err, SW_ELIMIT,
      "%s: reading data as %s takes more than %.0f MB of memory, which is too much for a "
      "file of %zu bytes; write the file anew, with fewer triangles if it is whole",
      file->object, file->format, most->memory / 1e6, file->byte_count);
}

static sw_status too_long(const sw_mesh_file *file, const limits *most, sw_error *err) {
  return sw_fail(err, SW_ELIMIT,
                 "%s: reading data as %s takes more than %.0f s, which is too much for a file of "
                 "%zu bytes; write the file anew, with fewer triangles if it is whole",
                 file->object, file->format, most->cpu, file->byte_count);
}

static sw_status broken(const sw_mesh_file *file, const limits *most, int status, sw_error *err) {
  if (status != -1 && WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGINT) return sw_fail(err, SW_EINTR, "interrupted");
    if (WTERMSIG(status) == SIGXCPU) return too_long(file, most, err);
    if (WTERMSIG(status) == SIGKILL)
      return sw_fail(err, SW_ELIMIT,
                     "%s: reading data as %s was ended by the system, which has too little memory "
                     "or time for it; write the file anew, with fewer triangles if it is whole",
                     file->object, file->format);
  }
  return sw_fail(
      err, SW_EFORMAT,
      "%s: data is not readable as %s: it is damaged, and reading it failed; write the file anew",
      file->object, file->format);
}

static sw_status converse(reading *r, const sw_mesh_file *file, const limits *most,
                          sw_mesh_data *out, sw_error *err) {
  reply from = {.word = 0};
  outcome o = receive(r, &from, sizeof from);
  if (o == WHOLE && from.word != REPLY) o = SHORT;
  if (o == WHOLE) sw_alloc_passed((size_t)from.requests);
  if (o == WHOLE && from.status == SW_OK) o = receive_data(r, &from, out);
  const int status = bury(r, o != WHOLE && o != SHORT);
  if (o == STOPPED) return sw_fail(err, SW_EINTR, "interrupted");
  if (o == LATE) return too_long(file, most, err);
  if (o == SHORT) return broken(file, most, status, err);
  if (from.status == SW_ELIMIT) return too_much(file, most, err);
  from.err.text[sizeof from.err.text - 1] = '\0';
  if (from.status != SW_OK) return sw_fail(err, (sw_status)from.status, "%s", from.err.text);
  if (out->vertices && out->indices) return SW_OK;
  return sw_fail(err, SW_ENOMEM, "%s: out of memory", file->object);
}

static sw_status read_in_child(const sw_mesh_file *file, sw_mesh_data *out, sw_error *err) {
  const limits most = limits_of(file);
  reading r = {.most = most.wall, .hook = asking ? lua_gethook(asking) : NULL};
  int ends[2];
  *out = (sw_mesh_data){0};
  if (pipe2(ends, O_CLOEXEC) != 0)
    return sw_fail(err, SW_ELIMIT, "%s: no pipe for reading it (%s); close some files",
                   file->object, strerror(errno));
  const pid_t parent = getpid();
  r.pid = lsw_process_fork();
  if (r.pid == 0) child(file, &most, ends[1], parent);
  const int why = errno;
  close(ends[1]);
  r.fd = ends[0];
  if (r.pid < 0) {
    close(ends[0]);
    return sw_fail(err, SW_ELIMIT, "%s: no process for reading it (%s); end some others",
                   file->object, strerror(why));
  }
  const sw_status status = converse(&r, file, &most, out, err);
  if (status == SW_OK) return SW_OK;
  sw_free(out->vertices), sw_free(out->indices);
  *out = (sw_mesh_data){0};
  return status;
}

void lsw_mesh_child_open(void) { sw_mesh_set_reader(read_in_child); }
