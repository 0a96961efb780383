/* Preloaded into a tool, makes the disk full, or kills the tool, at one of its calls that change a disk.
 *
 *   LGIW_FAULT=kill:N   SIGKILL right before the N-th such call (1, 2, ...)
 *   LGIW_FAULT=half:N   SIGKILL within the N-th, half of its bytes written
 *   LGIW_FAULT=full:N   from the N-th on, all calls that need room fail with ENOSPC
 *   LGIW_FAULT=once:N   only the N-th fails with ENOSPC
 *   LGIW_FAULT=count    nothing happens
 *   LGIW_FAULT_COUNT=FILE   how many calls there were is written there at the end
 *
 * Calls that count: write, pwrite, fwrite's and ofstream's among them; fsync, ftruncate, rename, unlink. Those on standard
 * output, standard error and pipes do not. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind { none, killing, half, full, once };
static enum kind kind = none;
static long at = 0;
static atomic_long calls;

__attribute__((constructor)) static void begin(void) {
  const char* fault = getenv("LGIW_FAULT");
  if (!fault) return;
  const char* names[] = {"", "kill:", "half:", "full:", "once:"};
  for (int k = 1; k < 5; ++k)
    if (strncmp(fault, names[k], 5) == 0) kind = (enum kind)k, at = atol(fault + 5);
}

__attribute__((destructor)) static void end(void) {
  const char* path = getenv("LGIW_FAULT_COUNT");
  if (!path) return;
  char text[32];
  const int n = snprintf(text, sizeof text, "%ld\n", atomic_load(&calls));
  const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file >= 0) syscall(SYS_write, file, text, (size_t)n), syscall(SYS_close, file);
}

/* What is to happen at this call: 0 nothing, 1 fail with ENOSPC, 2 die within it. */
static int event(int needs_room) {
  const long n = atomic_fetch_add(&calls, 1) + 1;
  if (kind == killing && n == at) raise(SIGKILL);
  if (kind == half && n == at) return 2;
  if (needs_room && ((kind == full && n >= at) || (kind == once && n == at))) {
    errno = ENOSPC;
    return 1;
  }
  return 0;
}

static int on_disk(int file) {
  struct stat status;
  return file > 2 && syscall(SYS_fstat, file, &status) == 0 && S_ISREG(status.st_mode);
}

ssize_t write(int file, const void* data, size_t size) {
  if (on_disk(file)) switch (event(1)) {
      case 1: return -1;
      case 2: syscall(SYS_write, file, data, size / 2), raise(SIGKILL);
    }
  return syscall(SYS_write, file, data, size);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  if (on_disk(file)) switch (event(1)) {
      case 1: return -1;
      case 2: raise(SIGKILL);
    }
  return syscall(SYS_writev, file, parts, count);
}

ssize_t pwrite(int file, const void* data, size_t size, off_t place) {
  if (on_disk(file)) switch (event(1)) {
      case 1: return -1;
      case 2: syscall(SYS_pwrite64, file, data, size / 2, place), raise(SIGKILL);
    }
  return syscall(SYS_pwrite64, file, data, size, place);
}
ssize_t pwrite64(int file, const void* data, size_t size, off64_t place) { return pwrite(file, data, size, place); }

int fsync(int file) {
  if (on_disk(file)) switch (event(1)) {
      case 1: return -1;
      case 2: raise(SIGKILL);
    }
  return (int)syscall(SYS_fsync, file);
}

int ftruncate(int file, off_t size) {
  struct stat status;
  if (on_disk(file)) switch (event(syscall(SYS_fstat, file, &status) == 0 && size > status.st_size)) {
      case 1: return -1;
      case 2: raise(SIGKILL);
    }
  return (int)syscall(SYS_ftruncate, file, size);
}
int ftruncate64(int file, off64_t size) { return ftruncate(file, size); }

int rename(const char* from, const char* to) {
  if (event(0)) raise(SIGKILL);
  return (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  if (event(0)) raise(SIGKILL);
  return (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, flags);
}

int unlink(const char* path) {
  if (event(0)) raise(SIGKILL);
  return (int)syscall(SYS_unlinkat, AT_FDCWD, path, 0);
}

/* The C library's own buffered streams do not come through write() above: without a buffer each fwrite would be a call of
 * its own inside the library. Their bytes count when the stream is closed. */
int fclose(FILE* stream) {
  static int (*real)(FILE*) = NULL;
  if (!real) *(void**)&real = dlsym(RTLD_NEXT, "fclose");
  const int file = fileno(stream);
  if (on_disk(file) && (fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY) switch (event(1)) {
      case 1:
        real(stream);
        errno = ENOSPC;
        return EOF;
      case 2: raise(SIGKILL);
    }
  return real(stream);
}
