/*
 * system.h - stands for every header of macOS that the library and the program include: what they use of it, with macOS's types.
 * macos.sh cuts it at the comments that name headers; what stands before the first is part of all. What macOS lacks, such as
 * sched_getaffinity and pthread_barrier_t, must not be here.
 */
#pragma once
#include <stddef.h>
#include <stdint.h>

typedef long ssize_t;
typedef long long off_t;
typedef int32_t pid_t;
typedef uint16_t mode_t;
typedef uint32_t socklen_t;
typedef uint64_t rlim_t;
struct timespec {
    long tv_sec, tv_nsec;
};

/* inttypes.h: numbers of 64 bits are long long, but size_t is long */
#define PRIu64 "llu"
#define SCNu64 "llu"
#define PRIu32 "u"

/* errno.h */
int *__error(void);
#define errno (*__error())
enum { ENOENT = 2, EINTR = 4, EIO = 5, ENOMEM = 12, EACCES = 13, EEXIST = 17, ENOTDIR = 20, EISDIR = 21, EINVAL = 22, EFBIG = 27,
       ENOSPC = 28, EROFS = 30, EPIPE = 32, ERANGE = 34, ENOTEMPTY = 66, EDQUOT = 69 };

/* string.h, strings.h */
void *memcpy(void *to, const void *from, size_t size);
void *memmove(void *to, const void *from, size_t size);
void *memset(void *to, int byte, size_t size);
void *memchr(const void *in, int byte, size_t size);
int memcmp(const void *a, const void *b, size_t size);
char *strcpy(char *to, const char *from);
char *strcat(char *to, const char *from);
char *strncat(char *to, const char *from, size_t most);
char *strncpy(char *to, const char *from, size_t size);
char *strchr(const char *in, int byte);
char *strrchr(const char *in, int byte);
char *strstr(const char *in, const char *what);
char *strpbrk(const char *in, const char *bytes);
char *strdup(const char *from);
char *strndup(const char *from, size_t most);
char *strerror(int number);
size_t strlen(const char *from);
size_t strspn(const char *in, const char *bytes);
size_t strcspn(const char *in, const char *bytes);
int strcmp(const char *a, const char *b);
int strncmp(const char *a, const char *b, size_t most);
int strcasecmp(const char *a, const char *b);
int strncasecmp(const char *a, const char *b, size_t most);

/* ctype.h */
int isspace(int byte);

/* stdlib.h */
enum { EXIT_SUCCESS, EXIT_FAILURE };
void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *room, size_t size);
int posix_memalign(void **room, size_t alignment, size_t size);
void free(void *room);
_Noreturn void abort(void);
_Noreturn void exit(int code);
int atoi(const char *text);
char *getenv(const char *name);
int mkstemp(char *name);
char *realpath(const char *path, char *resolved);
void qsort(void *base, size_t count, size_t size, int (*compare)(const void *, const void *));
double strtod(const char *text, char **end);
float strtof(const char *text, char **end);
long strtol(const char *text, char **end, int base);

/* stdio.h */
typedef struct __sFILE FILE;
extern FILE *__stdinp, *__stdoutp, *__stderrp;
#define stdin __stdinp
#define stdout __stdoutp
#define stderr __stderrp
#define EOF (-1)
enum { SEEK_SET, SEEK_CUR, SEEK_END, _IOFBF = 0, _IOLBF, _IONBF };
FILE *fopen(const char *path, const char *mode);
FILE *fdopen(int file, const char *mode);
int fclose(FILE *stream);
int ferror(FILE *stream);
int fflush(FILE *stream);
int fileno(FILE *stream);
int getc(FILE *stream);
char *fgets(char *line, int size, FILE *stream);
int putc(int byte, FILE *stream);
int putchar(int byte);
int fputs(const char *text, FILE *stream);
int puts(const char *text);
size_t fread(void *to, size_t size, size_t count, FILE *stream);
size_t fwrite(const void *from, size_t size, size_t count, FILE *stream);
int fseek(FILE *stream, long offset, int whence);
int fseeko(FILE *stream, off_t offset, int whence);
off_t ftello(FILE *stream);
int remove(const char *path);
int rename(const char *from, const char *to);
int setvbuf(FILE *stream, char *room, int mode, size_t size);
__attribute__((format(printf, 1, 2))) int printf(const char *format, ...);
__attribute__((format(printf, 2, 3))) int fprintf(FILE *stream, const char *format, ...);
__attribute__((format(printf, 3, 4))) int snprintf(char *to, size_t size, const char *format, ...);
__attribute__((format(scanf, 2, 3))) int sscanf(const char *text, const char *format, ...);
__attribute__((format(printf, 2, 0))) int vfprintf(FILE *stream, const char *format, __builtin_va_list arguments);

/* math.h */
#define INFINITY __builtin_inff()
#define NAN __builtin_nanf("")
#define isfinite(a) __builtin_isfinite(a)
#define isinf(a) __builtin_isinf(a)
#define isnan(a) __builtin_isnan(a)
#define signbit(a) __builtin_signbit(a)
#define FOR_BOTH(name) \
    double name(double a); \
    float name##f(float a);
FOR_BOTH(fabs) FOR_BOTH(sqrt) FOR_BOTH(floor) FOR_BOTH(ceil) FOR_BOTH(trunc) FOR_BOTH(round)
FOR_BOTH(log2) FOR_BOTH(log10) FOR_BOTH(sin) FOR_BOTH(cos)
#undef FOR_BOTH
#define FOR_BOTH(name) \
    double name(double a, double b); \
    float name##f(float a, float b);
FOR_BOTH(copysign) FOR_BOTH(fmax) FOR_BOTH(fmin) FOR_BOTH(fmod) FOR_BOTH(nextafter) FOR_BOTH(pow)
double fma(double a, double b, double c);
double ldexp(double a, int exponent);

/* assert.h */
_Noreturn void abort(void);
#define assert(a) ((a) ? (void)0 : abort())

/* fenv.h, sys/types.h, wchar.h */

/* time.h */
typedef enum { CLOCK_MONOTONIC = 6, CLOCK_THREAD_CPUTIME_ID = 16 } clockid_t;
int clock_getres(clockid_t clock, struct timespec *step);
int clock_gettime(clockid_t clock, struct timespec *now);
long time(long *now);

/* signal.h */
#define SIG_DFL ((void (*)(int))0)
#define SIG_IGN ((void (*)(int))1)
enum { SIGHUP = 1, SIGINT, SIGKILL = 9, SIGBUS, SIGPIPE = 13, SIGTERM = 15, SIGXFSZ = 25 };
enum { SA_RESTART = 2, SA_SIGINFO = 0x40, SIG_BLOCK = 1, SIG_SETMASK = 3 };
typedef uint32_t sigset_t;
typedef struct siginfo {
    void *si_addr;
} siginfo_t;
struct sigaction {
    union {
        void (*one)(int);
        void (*told)(int, siginfo_t *, void *);
    } handler;
    sigset_t sa_mask;
    int sa_flags;
};
#define sa_handler handler.one
#define sa_sigaction handler.told
int sigaction(int number, const struct sigaction *action, struct sigaction *before);
int sigaddset(sigset_t *set, int number);
int sigemptyset(sigset_t *set);
void (*signal(int number, void (*handler)(int)))(int);
int raise(int number);

/* sched.h */
int sched_yield(void);

/* pthread.h, which has neither barriers nor spinning locks */
typedef struct _opaque_pthread_t *pthread_t;
typedef struct {
    long signature;
    char opaque[56];
} pthread_mutex_t;
typedef struct {
    long signature;
    char opaque[40];
} pthread_cond_t;
typedef struct pthread_attr pthread_attr_t;
typedef struct pthread_mutexattr pthread_mutexattr_t;
typedef struct pthread_condattr pthread_condattr_t;
#define PTHREAD_MUTEX_INITIALIZER {0x32AAABA7, {0}}
int pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*start)(void *), void *data);
int pthread_detach(pthread_t thread);
int pthread_mutex_init(pthread_mutex_t *mutex, const pthread_mutexattr_t *how);
int pthread_mutex_destroy(pthread_mutex_t *mutex);
int pthread_mutex_lock(pthread_mutex_t *mutex);
int pthread_mutex_trylock(pthread_mutex_t *mutex);
int pthread_mutex_unlock(pthread_mutex_t *mutex);
int pthread_cond_init(pthread_cond_t *cond, const pthread_condattr_t *how);
int pthread_cond_destroy(pthread_cond_t *cond);
int pthread_cond_wait(pthread_cond_t *cond, pthread_mutex_t *mutex);
int pthread_cond_signal(pthread_cond_t *cond);
int pthread_cond_broadcast(pthread_cond_t *cond);

/* unistd.h */
enum { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO, F_OK = 0, X_OK = 1, W_OK = 2, R_OK = 4 };
enum { _SC_PAGESIZE = 29, _SC_NPROCESSORS_ONLN = 58 };
_Noreturn void _exit(int code);
int access(const char *path, int how);
int close(int file);
int dup2(int file, int as);
int isatty(int file);
int pause(void);
int rmdir(const char *path);
int unlink(const char *path);
long sysconf(int name);
char *mkdtemp(char *name);
pid_t fork(void);
ssize_t pread(int file, void *to, size_t size, off_t offset);
ssize_t pwrite(int file, const void *from, size_t size, off_t offset);
ssize_t write(int file, const void *from, size_t size);

/* fcntl.h */
enum { O_RDONLY, O_WRONLY };
int open(const char *path, int how, ...);

/* dlfcn.h */
enum { RTLD_NOW = 2, RTLD_LOCAL = 4 };
void *dlopen(const char *path, int how);
void *dlsym(void *library, const char *name);
char *dlerror(void);

/* getopt.h */
struct option {
    const char *name;
    int has_arg, *flag, val;
};
enum { no_argument, required_argument, optional_argument };
extern char *optarg;
extern int optind, opterr, optopt;
int getopt_long(int count, char *const *words, const char *letters, const struct option *names, int *index);

/* sys/stat.h */
struct stat {
    int32_t st_dev;
    mode_t st_mode;
    uint16_t st_nlink;
    uint64_t st_ino;
    struct timespec st_mtimespec;
    off_t st_size;
};
#define st_mtime st_mtimespec.tv_sec
#define S_ISREG(mode) (((mode) & 0170000) == 0100000)
#define S_ISDIR(mode) (((mode) & 0170000) == 0040000)
#define S_ISLNK(mode) (((mode) & 0170000) == 0120000)
int chmod(const char *path, mode_t mode);
int fchmod(int file, mode_t mode);
int fstat(int file, struct stat *about);
int lstat(const char *path, struct stat *about);
int stat(const char *path, struct stat *about);
mode_t umask(mode_t mask);

/* sys/mman.h */
#define MAP_FAILED ((void *)-1)
enum { PROT_READ = 1, PROT_WRITE, MAP_PRIVATE = 2, MAP_ANON = 0x1000, MAP_ANONYMOUS = MAP_ANON };
void *mmap(void *at, size_t size, int protection, int how, int file, off_t offset);
int munmap(void *at, size_t size);

/* sys/resource.h */
struct rlimit {
    rlim_t rlim_cur, rlim_max;
};
#define RLIM_INFINITY (((uint64_t)1 << 63) - 1)
enum { RLIMIT_AS = 5 };
int getrlimit(int what, struct rlimit *limit);

/* sys/wait.h */
pid_t waitpid(pid_t process, int *status, int how);

/* sys/socket.h, which has no MSG_NOSIGNAL before macOS 15 */
struct iovec {
    void *iov_base;
    size_t iov_len;
};
struct msghdr {
    void *msg_name;
    socklen_t msg_namelen;
    struct iovec *msg_iov;
    int msg_iovlen;
    void *msg_control;
    socklen_t msg_controllen;
    int msg_flags;
};
struct cmsghdr {
    socklen_t cmsg_len;
    int cmsg_level, cmsg_type;
};
#define CMSG_LEN(size) (sizeof(struct cmsghdr) + (size))
#define CMSG_SPACE(size) (sizeof(struct cmsghdr) + (((size) + 3) & ~(size_t)3))
#define CMSG_DATA(head) ((unsigned char *)(head) + sizeof(struct cmsghdr))
#define CMSG_FIRSTHDR(message) \
    ((message)->msg_controllen >= sizeof(struct cmsghdr) ? (struct cmsghdr *)(message)->msg_control : NULL)
#define SO_NOSIGPIPE 0x1022
enum { AF_UNIX = 1, SOCK_STREAM = 1, SCM_RIGHTS = 1, SOL_SOCKET = 0xffff };
int socketpair(int domain, int type, int protocol, int ends[2]);
int setsockopt(int socket, int level, int option, const void *value, socklen_t size);
ssize_t recv(int socket, void *to, size_t size, int flags);
ssize_t recvmsg(int socket, struct msghdr *message, int flags);
ssize_t send(int socket, const void *from, size_t size, int flags);
ssize_t sendmsg(int socket, const struct msghdr *message, int flags);
