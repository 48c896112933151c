/* mesh_tally.c - looks at every triangle once, by threads that take blocks. */
#include "mesh_tally.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>

#include "console/crew.h"
#include "console/message.h"
#include "console/progress.h"
#include "write/part.h"

tally tally_of_none(void)
{
    return (tally){.bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}},
                   .first_not_finite = UINT64_MAX,
                   .fits_float = true};
}

void tally_add(tally *to, const tally *from)
{
    for (int a = 0; a < 3; a++) {
        to->bounds.lo[a] = fmin(to->bounds.lo[a], from->bounds.lo[a]);
        to->bounds.hi[a] = fmax(to->bounds.hi[a], from->bounds.hi[a]);
    }
    to->triangles += from->triangles;
    to->not_finite += from->not_finite;
    to->first_not_finite = from->first_not_finite < to->first_not_finite ? from->first_not_finite : to->first_not_finite;
    mesh_sums_add(&to->sums, &from->sums, 0); /* numbered through */
    to->fits_float &= from->fits_float;
}

static double least(double a, double b) { return a < b ? a : b; }
static double most(double a, double b) { return a > b ? a : b; }

/* Returns whether it is finite. */
static bool add_triangle(tally *t, uint64_t number, const double u[9])
{
    double zero = 0; /* or NaN */
    for (int k = 0; k < 9; k++)
        zero += 0 * u[k];
    if (!(zero == 0)) {
        t->not_finite++;
        t->first_not_finite = number < t->first_not_finite ? number : t->first_not_finite;
        return false;
    }
    for (int a = 0; a < 3; a++) {
        t->bounds.lo[a] = least(t->bounds.lo[a], least(least(u[a], u[3 + a]), u[6 + a]));
        t->bounds.hi[a] = most(t->bounds.hi[a], most(most(u[a], u[3 + a]), u[6 + a]));
    }
    return true;
}

static bool fits(const double u[9])
{
    bool is_float = true;
    for (int k = 0; k < 9; k++)
        is_float &= float_fit_of(u[k]) == FLOAT_FIT_EXACT;
    return is_float;
}

tally tally_of_block(const pieces *all, const piece_block *block, const void *positions, bool has_sums)
{
    const bool is_double = all->write_bytes == sizeof(double);
    tally t = tally_of_none();
    for (size_t i = 0; i < block->count; i++) {
        double u[9];
        pieces_triangle(all, positions, i, u);
        if (add_triangle(&t, block->number + i, u) && has_sums)
            mesh_sums_add(&t.sums, &(mesh_sums){part_triangle_checksum(u), 0}, block->number + i);
        t.fits_float &= !is_double || fits(u);
    }
    t.triangles = block->count;
    return t;
}

/* What the threads share. */
typedef struct survey {
    const pieces *all;
    progress bar;
    pthread_mutex_t lock; /* of what follows */
    size_t next;          /* block */
    tally found;
    const piece *unread; /* that could not be read, for this reason */
    int reason;
    bool lacks_memory;
} survey;

static bool take_block(survey *s, piece_block *block)
{
    pthread_mutex_lock(&s->lock);
    const bool is_left = s->next < s->all->blocks && !s->unread && !s->lacks_memory;
    if (is_left)
        *block = pieces_block(s->all, s->next++);
    pthread_mutex_unlock(&s->lock);
    return is_left;
}

static void account(survey *s, const piece_block *block, const tally *found, int reason)
{
    pthread_mutex_lock(&s->lock);
    if (found) {
        tally_add(&s->found, found);
        progress_tell(&s->bar, (double)s->found.triangles / (double)s->all->triangles);
    } else if (!s->unread) {
        s->unread = block->from;
        s->reason = reason;
    }
    pthread_mutex_unlock(&s->lock);
}

static void work(void *data, unsigned thread)
{
    survey *const s = data;
    void *const room = malloc(s->all->block * pieces_room(s->all));
    (void)thread;
    if (!room) {
        pthread_mutex_lock(&s->lock);
        s->lacks_memory = true;
        pthread_mutex_unlock(&s->lock);
    }
    for (piece_block block; take_block(s, &block);) {
        tally found;
        const bool is_read = pieces_read(s->all, &block, room);
        const int reason = errno;
        if (is_read)
            found = tally_of_block(s->all, &block, room, false);
        account(s, &block, is_read ? &found : NULL, reason);
    }
    free(room);
}

int tally_read(const pieces *all, unsigned threads, bool is_quiet, tally *found)
{
    survey s = {.all = all, .found = tally_of_none()};
    s.bar = progress_start_of("reading", "triangles", (double)all->triangles, !is_quiet);
    pthread_mutex_init(&s.lock, NULL);
    crew_run(threads, work, &s);
    pthread_mutex_destroy(&s.lock);
    progress_end(&s.bar);
    *found = s.found;
    return s.unread         ? pieces_refuse(s.unread, s.reason)
           : s.lacks_memory ? message_failure("out of memory to read the mesh")
                            : EXIT_CODE_OK;
}
