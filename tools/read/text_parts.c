/* text_parts.c - reads parts with a little of what follows, and finds the lines that begin in each. */
#include "text_parts.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "console/crew.h"
#include "files/named_file.h"
#include "reading.h"

typedef struct text_run {
    const plain_file *file;
    uint64_t from;
    text_order order;
    size_t count; /* of the parts */
    text_work *work;
    void *data;
    char *rooms[THREADS_MAX]; /* each for its thread alone */
    pthread_mutex_t lock;     /* of what follows */
    pthread_cond_t is_passed;
    size_t passed; /* parts, from the first on */
    uint64_t lines;
    bool is_failed;
} text_run;

size_t text_parts_count(const plain_file *file, uint64_t from)
{
    const uint64_t count = (file->size - from + file->part_bytes - 1) / file->part_bytes;
    return count < SIZE_MAX ? (size_t)count : SIZE_MAX;
}

static const char *after_line(const char *from, const char *end)
{
    const char *const found = from < end ? memchr(from, '\n', (size_t)(end - from)) : NULL;
    return found ? found + 1 : NULL;
}

static uint64_t count_lines(const char *c, const char *end)
{
    enum { AT_ONCE = 255 /* that a byte counts */ };
    uint64_t lines = 0;
    while (c < end) {
        const size_t left = (size_t)(end - c), count = left < AT_ONCE ? left : AT_ONCE;
        unsigned char here = 0;
        for (size_t i = 0; i < count; i++)
            here = (unsigned char)(here + (c[i] == '\n'));
        lines += here;
        c += count;
    }
    return lines;
}

/* A thread that waits here waits for one that works. */
bool text_part_await(text_part *part)
{
    text_run *const r = part->run;
    pthread_mutex_lock(&r->lock);
    while (r->passed < part->number && !r->is_failed)
        pthread_cond_wait(&r->is_passed, &r->lock);
    const bool is_sound = !r->is_failed;
    if (!is_sound)
        pthread_mutex_unlock(&r->lock);
    return is_sound;
}

void text_part_pass(text_part *part)
{
    text_run *const r = part->run;
    part->is_passed = true;
    r->passed++;
    pthread_cond_broadcast(&r->is_passed);
    pthread_mutex_unlock(&r->lock);
}

static bool add_lines(text_part *part)
{
    const uint64_t own = count_lines(part->begin, part->limit);
    if (!text_part_await(part))
        return false;
    part->first_line = part->run->lines;
    part->run->lines += own;
    text_part_pass(part);
    return true;
}

static bool pass_over(text_part *part)
{
    if (part->is_passed || part->run->order == TEXT_ANY_ORDER)
        return true;
    if (!text_part_await(part))
        return false;
    text_part_pass(part);
    return true;
}

static bool fail(text_run *r)
{
    pthread_mutex_lock(&r->lock);
    r->is_failed = true;
    pthread_cond_broadcast(&r->is_passed);
    pthread_mutex_unlock(&r->lock);
    return false;
}

/* The part begins a byte early, which says whether a line does. */
static bool read_part(const text_run *r, char *room, text_part *part)
{
    const plain_file *const file = r->file;
    const size_t early = part->number > 0, bytes = file->part_bytes;
    const uint64_t start = r->from + (uint64_t)part->number * bytes - early;
    size_t got;
    if (!named_file_read_at(file->stream, start, room, early + bytes + TEXT_OVERLAP, &got) || got < early)
        return false;
    part->is_last = start + got >= file->size;
    const char *const own_end = room + (got < bytes + early ? got : bytes + early), *begin = room;
    room[got] = '\n';
    part->end = room + got + (part->is_last && got && room[got - 1] != '\n');
    memset(room + got + 1, 0, TEXT_AHEAD);
    if (early)
        begin = after_line(room, own_end - 1);
    part->limit = after_line(own_end - 1, room + got);
    if (!part->limit && part->is_last)
        part->limit = part->end;
    part->begin = begin ? begin : part->limit;
    part->offset = part->begin ? start + (uint64_t)(part->begin - room) : 0;
    return part->limit || !begin;
}

static bool work_on_part(void *data, unsigned thread, size_t turn)
{
    text_run *const r = data;
    reading_tell((double)turn / (double)r->count);
    text_part part = {.number = turn, .run = r};
    if (!r->rooms[thread])
        r->rooms[thread] = malloc(1 + r->file->part_bytes + TEXT_OVERLAP + 1 + TEXT_AHEAD);
    if (!r->rooms[thread] || !read_part(r, r->rooms[thread], &part) || (r->order == TEXT_COUNTED && !add_lines(&part)))
        return fail(r);
    return ((part.begin == part.limit || r->work(r->data, thread, &part)) && pass_over(&part)) || fail(r);
}

bool text_parts_run(const plain_file *file, uint64_t from, text_order order, text_work *work, void *data)
{
    text_run r = {.file = file, .from = from, .order = order, .count = text_parts_count(file, from), .work = work, .data = data};
    pthread_mutex_init(&r.lock, NULL);
    pthread_cond_init(&r.is_passed, NULL);
    reading_begin();
    const bool is_done = crew_turns(file->threads, r.count, work_on_part, &r);
    reading_end();
    pthread_cond_destroy(&r.is_passed);
    pthread_mutex_destroy(&r.lock);
    for (int t = 0; t < THREADS_MAX; t++)
        free(r.rooms[t]);
    return is_done;
}
