/* vdb_process.c - forks, sends bricks in blocks, and hears how it went. */
#define _POSIX_C_SOURCE 200809L
#include "vdb_process.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "console/interrupt.h"
#include "files/new_file.h"

#ifndef MSG_NOSIGNAL /* macOS has it as an option of the socket */
#define MSG_NOSIGNAL 0
#endif

enum { BLOCK = 512, BRICK_CELLS = 512 };

/* What has a value for each cell goes with fewer bricks. */
enum { BLOCK_VALUES = 32 * BRICK_CELLS };

typedef struct block {
    uint32_t count;  /* 0: these are all, write them */
    uint32_t values; /* of all bricks together; 0: they have none */
    struct {
        uint32_t at[3];
        uint32_t cells; /* that have a value */
        uint64_t bits[8];
    } brick[BLOCK];
    union {
        float colour[BLOCK_VALUES][3];
        int32_t id[BLOCK_VALUES];
    } of;
    uint64_t inside[BLOCK][8]; /* sent of a grid of labels alone */
} block;

/* A grid to make a tree for; where it is only tried, no file comes with it. */
typedef struct order {
    vdb_grid grid;
    bool has_file, can_seek;
} order;

/* After each order, after the last block, and wherever it fails. */
typedef struct answer {
    bool is_done;
    int error; /* of the stream */
    char reason[VDB_PROCESS_REASON];
} answer;

struct vdb_process {
    pid_t child;
    int socket;
    vdb_grid grid;
    block next;
};

/* Where nobody listens any more this is no signal, but false. */
static bool send_all(int to, const void *from, size_t size)
{
    for (size_t done = 0; done < size;) {
        const ssize_t sent = send(to, (const char *)from + done, size - done, MSG_NOSIGNAL);
        if (sent < 0 && errno != EINTR)
            return false;
        done += sent > 0 ? (size_t)sent : 0;
    }
    return true;
}

static bool receive_all(int from, void *to, size_t size)
{
    for (size_t done = 0; done < size;) {
        const ssize_t got = recv(from, (char *)to + done, size - done, 0);
        if (!got || (got < 0 && errno != EINTR))
            return false;
        done += got > 0 ? (size_t)got : 0;
    }
    return true;
}

/* A file goes along with a byte of its own. */
static bool send_file(int to, int file)
{
    char byte = 0, room[CMSG_SPACE(sizeof file)] = {0};
    struct iovec one = {&byte, 1};
    struct msghdr message = {.msg_iov = &one, .msg_iovlen = 1, .msg_control = room, .msg_controllen = sizeof room};
    struct cmsghdr *const head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof file);
    memcpy(CMSG_DATA(head), &file, sizeof file);
    ssize_t sent;
    while ((sent = sendmsg(to, &message, MSG_NOSIGNAL)) < 0 && errno == EINTR)
        continue;
    return sent == 1;
}

/* As a stream to write to; NULL if none comes. */
static FILE *receive_file(int from)
{
    int file = -1;
    char byte, room[CMSG_SPACE(sizeof file)];
    struct iovec one = {&byte, 1};
    struct msghdr message = {.msg_iov = &one, .msg_iovlen = 1, .msg_control = room, .msg_controllen = sizeof room};
    ssize_t got;
    while ((got = recvmsg(from, &message, 0)) < 0 && errno == EINTR)
        continue;
    const struct cmsghdr *const head = got == 1 ? CMSG_FIRSTHDR(&message) : NULL;
    if (head && head->cmsg_type == SCM_RIGHTS)
        memcpy(&file, CMSG_DATA(head), sizeof file);
    return file < 0 ? NULL : fdopen(file, "wb");
}

static size_t value_bytes(const vdb_grid *grid) { return grid->has_colours ? 3 * sizeof(float) : sizeof(int32_t); }

static bool send_block(int to, const block *b, const vdb_grid *grid)
{
    const uint32_t counts[2] = {b->count, b->values};
    return send_all(to, counts, sizeof counts) && send_all(to, b->brick, b->count * sizeof b->brick[0]) &&
           send_all(to, &b->of, b->values * value_bytes(grid)) &&
           (!grid->has_labels || send_all(to, b->inside, b->count * sizeof b->inside[0]));
}

static bool receive_block(int from, block *b, const vdb_grid *grid)
{
    uint32_t counts[2];
    if (!receive_all(from, counts, sizeof counts))
        return false;
    b->count = counts[0];
    b->values = counts[1];
    return receive_all(from, b->brick, b->count * sizeof b->brick[0]) && receive_all(from, &b->of, b->values * value_bytes(grid)) &&
           (!grid->has_labels || receive_all(from, b->inside, b->count * sizeof b->inside[0]));
}

/*
 * The part stands beside the program's libraries. It is loaded for this format alone: OpenVDB takes four times as long to load as
 * all the rest, and three times the memory.
 */
static const vdb_part *load(answer *a)
{
    void *const library = dlopen(VDB_PART_FILE, RTLD_NOW | RTLD_LOCAL);
    const vdb_part *const part = library ? dlsym(library, VDB_PART_SYMBOL) : NULL;
    if (!part)
        snprintf(a->reason, sizeof a->reason, "cannot load what writes .vdb: %s", dlerror());
    return part;
}

static void say_failed(answer *a, const char *why) { snprintf(a->reason, sizeof a->reason, "OpenVDB failed: %s", why); }

static bool put_block(const vdb_part *part, void *tree, const block *b, const vdb_grid *grid, char *why)
{
    bool is_put = true;
    const unsigned char *values = (const unsigned char *)&b->of;
    for (uint32_t i = 0; i < b->count && is_put; i++) {
        is_put = part->put(tree, b->brick[i].at, b->brick[i].bits, grid->has_labels ? b->inside[i] : NULL, values, why);
        values += b->brick[i].cells * value_bytes(grid);
    }
    return is_put;
}

/* The bricks of a tree, and its file. */
static void take_bricks(int parent, const vdb_part *part, void *tree, FILE *to, const order *o)
{
    block b;
    char why[VDB_REASON];
    answer a = {.is_done = true};
    bool goes_on = true;
    while (goes_on && receive_block(parent, &b, &o->grid)) {
        a.is_done = b.count ? put_block(part, tree, &b, &o->grid, why) : part->write(tree, to, o->can_seek, why);
        goes_on = b.count && a.is_done;
        if (!a.is_done)
            say_failed(&a, why);
        if (!b.count && (ferror(to) || fflush(to)))
            a.error = errno ? errno : EIO;
        if (!goes_on)
            send_all(parent, &a, sizeof a);
    }
}

/* The child's work. Its memory is freed when it ends: to take a large tree apart would be slow, and may throw. */
static void serve(int parent)
{
    order o;
    char why[VDB_REASON];
    answer a = {.is_done = false};
    const vdb_part *const part = load(&a);
    while (receive_all(parent, &o, sizeof o)) {
        FILE *const to = o.has_file ? receive_file(parent) : NULL;
        void *const tree = part ? part->make(&o.grid, why) : NULL;
        if (part && !tree)
            say_failed(&a, why);
        a.is_done = tree && (to || !o.has_file);
        if (tree && !a.is_done)
            say_failed(&a, "its file did not arrive");
        if (!send_all(parent, &a, sizeof a) || !a.is_done)
            return;
        if (to)
            take_bricks(parent, part, tree, to, &o);
    }
}

/* What libraries print when they break off is said by the parent, in one line. */
static void be_quiet(void)
{
    const int nothing = open("/dev/null", O_WRONLY);
    if (nothing >= 0)
        dup2(nothing, STDERR_FILENO);
}

static void run_child(int parent)
{
    interrupt_leave();
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* elsewhere it ends when it next hears or says something */
#endif
    be_quiet();
    new_file_fail_quietly(true); /* it began before the output was opened */
    serve(parent);
    _exit(0);
}

static bool hear(const vdb_process *p, answer *a, char *reason)
{
    if (!receive_all(p->socket, a, sizeof *a)) {
        *a = (answer){.is_done = false};
        say_failed(a, "it broke off, most likely for lack of memory");
    }
    if (!a->is_done)
        memcpy(reason, a->reason, sizeof a->reason);
    return a->is_done;
}

static bool fork_child(vdb_process *p)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends))
        return false;
#ifdef SO_NOSIGPIPE
    setsockopt(ends[0], SOL_SOCKET, SO_NOSIGPIPE, &(int){1}, sizeof(int));
#endif
    interrupt_hold(); /* until the child has left the parent's files to the parent */
    p->child = fork();
    if (!p->child) {
        close(ends[0]);
        run_child(ends[1]);
    }
    const int reason = errno;
    interrupt_release();
    close(ends[1]);
    if (p->child < 0)
        close(ends[0]);
    errno = reason;
    p->socket = ends[0];
    return p->child > 0;
}

vdb_process *vdb_process_begin(char *reason)
{
    vdb_process *const p = calloc(1, sizeof *p);
    if (p && fork_child(p))
        return p;
    snprintf(reason, VDB_PROCESS_REASON, "cannot start what writes .vdb: %s", strerror(p ? errno : ENOMEM));
    free(p);
    return NULL;
}

/* Whether an order arrives, the answer says. */
bool vdb_process_try(vdb_process *p, const vdb_grid *grid, char *reason)
{
    answer a;
    send_all(p->socket, &(order){.grid = *grid}, sizeof(order));
    return hear(p, &a, reason);
}

bool vdb_process_open(vdb_process *p, const vdb_grid *grid, FILE *to, bool can_seek, char *reason)
{
    answer a;
    p->grid = *grid;
    send_all(p->socket, &(order){.grid = *grid, .has_file = true, .can_seek = can_seek}, sizeof(order));
    send_file(p->socket, fileno(to));
    return hear(p, &a, reason);
}

bool vdb_process_put(vdb_process *p, const uint32_t at[3], const uint64_t bits[8], const uint64_t *inside, const void *values,
                     uint32_t cells, char *reason)
{
    answer a;
    block *const b = &p->next;
    memcpy(b->brick[b->count].at, at, sizeof b->brick->at);
    memcpy(b->brick[b->count].bits, bits, sizeof b->brick->bits);
    b->brick[b->count].cells = cells;
    if (cells)
        memcpy((unsigned char *)&b->of + b->values * value_bytes(&p->grid), values, cells * value_bytes(&p->grid));
    b->values += cells;
    if (p->grid.has_labels)
        memcpy(b->inside[b->count], inside, sizeof b->inside[0]);
    if (++b->count < BLOCK && b->values + BRICK_CELLS <= BLOCK_VALUES)
        return true;
    const bool is_sent = send_block(p->socket, b, &p->grid);
    b->count = b->values = 0;
    return is_sent || hear(p, &a, reason);
}

bool vdb_process_write(vdb_process *p, int *error, char *reason)
{
    answer a;
    block *const b = &p->next;
    if (b->count)
        send_block(p->socket, b, &p->grid); /* whether they arrive the answer says */
    b->count = b->values = 0;
    send_block(p->socket, b, &p->grid);
    const bool is_done = hear(p, &a, reason);
    *error = a.error;
    return is_done && !a.error;
}

void vdb_process_free(vdb_process *p)
{
    close(p->socket);
    while (waitpid(p->child, NULL, 0) < 0 && errno == EINTR)
        continue;
    free(p);
}
