/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions for files that Lua's io lacks: temporary files with a lock of their owner, locks,
 * syncing to the disk, and the kind of file that a path names. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <lauxlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bind/process.h"

/* --- locks ---------------------------------------------------------------- */

/* A process locks its temporary files as long as it runs. The system removes the lock when the
 * process ends in any way. So a file without a lock was left by a process that was killed. */
static const char lock_name[] = "softworld.part";

typedef struct part_lock {
  int fd;        /* -1: unlocked */
  int part;      /* 1: of a temporary file or folder, whose path is the user value */
  pid_t process; /* that made it: one forked from it must not remove its files */
} part_lock;

static int unlock(lua_State *L) {
  part_lock *lock = luaL_checkudata(L, 1, lock_name);
  if (lock->fd >= 0) close(lock->fd);
  lock->fd = -1;
  return 0;
}

static int forget(lua_State *L); /* with what removes files, below */

static part_lock *new_lock(lua_State *L) {
  part_lock *lock = lua_newuserdatauv(L, sizeof *lock, 1);
  lock->fd = -1, lock->part = 0, lock->process = getpid();
  if (luaL_newmetatable(L, lock_name)) {
    lua_pushcfunction(L, forget), lua_setfield(L, -2, "__gc");
    lua_pushcfunction(L, unlock), lua_setfield(L, -2, "__close");
    lua_pushcfunction(L, unlock), lua_setfield(L, -2, "__call");
  }
  lua_setmetatable(L, -2);
  return lock;
}

/* --- removing files that were left ----------------------------------------- */

static size_t digits_before(const char *text, size_t end) {
  size_t at = end;
  while (at > 0 && text[at - 1] >= '0' && text[at - 1] <= '9') at--;
  return end - at;
}

/* 1 if name is as of core.part: ".name.123-4.tmp". */
static int is_part(const char *name) {
  const size_t length = strlen(name);
  if (name[0] != '.' || length < 4 || strcmp(name + length - 4, ".tmp") != 0) return 0;
  size_t end = length - 4;
  const size_t number = digits_before(name, end);
  if (number == 0 || end < number + 1 || name[end - number - 1] != '-') return 0;
  end -= number + 1;
  const size_t process = digits_before(name, end);
  return process > 0 && end > process + 1 && name[end - process - 1] == '.';
}

static void remove_folder(int parent, int fd, const char *name) {
  DIR *folder = fdopendir(dup(fd));
  if (!folder) return;
  for (struct dirent *entry; (entry = readdir(folder)) != NULL;)
    unlinkat(fd, entry->d_name, 0); /* files only: our folders have no subfolders */
  closedir(folder);
  unlinkat(parent, name, AT_REMOVEDIR);
}

static void remove_if_left(int parent, const char *name) {
  struct stat info;
  const int fd = openat(parent, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return;
  if (fstat(fd, &info) == 0 && (S_ISREG(info.st_mode) || S_ISDIR(info.st_mode)) &&
      flock(fd, LOCK_EX | LOCK_NB) == 0) {
    if (S_ISDIR(info.st_mode))
      remove_folder(parent, fd, name);
    else
      unlinkat(parent, name, 0);
  }
  close(fd);
}

/* The lock of a temporary file that nobody ended: Ctrl-C came between two steps of writing it. */
static int forget(lua_State *L) {
  const part_lock *lock = luaL_checkudata(L, 1, lock_name);
  if (lock->fd >= 0 && lock->part && lock->process == getpid()) {
    struct stat info;
    lua_getiuservalue(L, 1, 1);
    const char *path = lua_tostring(L, -1);
    if (path && fstat(lock->fd, &info) == 0) {
      if (S_ISDIR(info.st_mode))
        remove_folder(AT_FDCWD, lock->fd, path);
      else
        unlinkat(AT_FDCWD, path, 0);
    }
  }
  return unlock(L);
}

/* core.sweep(folder): removes temporary files of processes that have ended. */
static int mod_sweep(lua_State *L) {
  DIR *folder = opendir(luaL_checkstring(L, 1));
  if (!folder) return 0;
  for (struct dirent *entry; (entry = readdir(folder)) != NULL;)
    if (is_part(entry->d_name)) remove_if_left(dirfd(folder), entry->d_name);
  closedir(folder);
  return 0;
}

/* --- making --------------------------------------------------------------- */

static int make(const char *path, int folder) {
  if (!folder) return open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (mkdir(path, 0777) != 0) return -1;
  return open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

/* Locks the new file; 1 if it is still at its path. Before it was locked, another process may have
 * taken it for a file that was left, and removed it. */
static int keep(int fd, const char *path) {
  struct stat own, there;
  if (flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return 0;
  return fstat(fd, &own) == 0 && stat(path, &there) == 0 && own.st_ino == there.st_ino;
}

/* core.part(start, folder) -> path, lock: makes a new, empty file (or folder) whose path begins
 * with start, such as "here/.name". Call lock() to unlock it at the end. nil and the reason if it
 * cannot be made. */
static int mod_part(lua_State *L) {
  static unsigned number;
  const char *start = luaL_checkstring(L, 1);
  const int folder = lua_toboolean(L, 2);
  lua_settop(L, 2);
  part_lock *lock = new_lock(L);
  for (int tries = 0; tries < 1000; tries++) {
    lua_settop(L, 3);
    lua_pushfstring(L, "%s.%I-%I.tmp", start, (LUAI_UACINT)getpid(), (LUAI_UACINT)++number);
    const char *path = lua_tostring(L, -1);
    lock->fd = make(path, folder);
    if (lock->fd < 0 && errno != EEXIST) return lsw_failed(L);
    if (lock->fd >= 0 && keep(lock->fd, path)) {
      lua_pushvalue(L, -1), lua_setiuservalue(L, 3, 1);
      lock->part = 1;
      lua_insert(L, -2);
      return 2;
    }
    if (lock->fd >= 0) close(lock->fd);
    lock->fd = -1;
  }
  errno = EEXIST;
  return lsw_failed(L);
}

/* core.lock(path) -> lock: locks a file for this process alone; makes it if it does not exist. nil
 * and the reason, or nil and "busy" if another process has the lock. */
static int mod_lock(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  part_lock *lock = new_lock(L);
  lock->fd = open(path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666);
  if (lock->fd < 0) return lsw_failed(L);
  if (flock(lock->fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return 1;
  lua_pushnil(L);
  lua_pushliteral(L, "busy");
  return 2;
}

/* core.create(path, text) -> true: makes a new file with this text; safe on shared file systems
 * too. nil and the reason, or nil and "busy" if a file of this name exists. */
static int mod_create(lua_State *L) {
  size_t size;
  const char *path = luaL_checkstring(L, 1), *text = luaL_checklstring(L, 2, &size);
  const int fd = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0 && errno == EEXIST) {
    lua_pushnil(L);
    lua_pushliteral(L, "busy");
    return 2;
  }
  if (fd < 0) return lsw_failed(L);
  const int whole = write(fd, text, size) == (ssize_t)size, why = errno;
  if (close(fd) == 0 && whole) {
    lua_pushboolean(L, 1);
    return 1;
  }
  unlinkat(AT_FDCWD, path, 0);
  if (!whole) errno = why ? why : ENOSPC;
  return lsw_failed(L);
}

static int sync_path(const char *path, int flags) {
  const int fd = open(path, O_RDONLY | O_CLOEXEC | flags);
  if (fd < 0) return -1;
  const int done = fsync(fd), why = errno;
  close(fd);
  errno = why;
  return done == 0 || why == EINVAL || why == EROFS ? 0 : -1; /* EINVAL: it has nothing to sync */
}

/* core.sync(path, folder): waits until a file's content, or a folder's names, are on the disk.
 * true, or nil and the reason. */
static int mod_sync(lua_State *L) {
  const char *path = luaL_checkstring(L, 1);
  if (sync_path(path, lua_toboolean(L, 2) ? O_DIRECTORY : 0) != 0) return lsw_failed(L);
  lua_pushboolean(L, 1);
  return 1;
}

/* core.kind(path) -> "file", "folder", "pipe", "device" or "socket"; nil if nothing is there; nil
 * and the reason if it cannot be told. */
static int mod_kind(lua_State *L) {
  struct stat info;
  size_t length;
  const char *path = luaL_checklstring(L, 1, &length), *why = NULL;
  if (strlen(path) != length)
    why = "zero byte in the path";
  else if (stat(path, &info) != 0)
    why = errno == ENOENT || errno == ENOTDIR ? "" : strerror(errno);
  if (why) {
    lua_pushnil(L);
    return *why ? lua_pushstring(L, why), 2 : 1;
  }
  lua_pushstring(L, S_ISREG(info.st_mode)    ? "file"
                    : S_ISDIR(info.st_mode)  ? "folder"
                    : S_ISFIFO(info.st_mode) ? "pipe"
                    : S_ISSOCK(info.st_mode) ? "socket"
                                             : "device");
  return 1;
}

const luaL_Reg lsw_module_files[] = {
    {"part", mod_part},   {"lock", mod_lock}, {"create", mod_create},
    {"sweep", mod_sweep}, {"sync", mod_sync}, {"kind", mod_kind},
    {NULL, NULL}};
