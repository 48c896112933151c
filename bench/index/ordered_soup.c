/* ordered_soup.c - orders a soup, gathers it and builds its index, by the clock. */
#define _POSIX_C_SOURCE 200809L
#include "ordered_soup.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "console/message.h"

/* Of the processor, as in timing/timing.c. */
static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Keeps the lesser time; returns when the next step begins. */
static double keep_least(double *least, double begin, size_t count)
{
    const double now = seconds_now();
    *least = fmin(*least, 1e9 * (now - begin) / (double)count);
    return seconds_now();
}

static bool try_once(const index_scene *scene, const char *kernel, void *scratch, ordered_soup *made)
{
    const tribox_soup *const soup = &scene->room.soup;
    double begin = seconds_now();
    if (tribox_soup_sort(soup, made->ids, scratch))
        return false;
    begin = keep_least(&made->cost.order, begin, soup->count);
    if (tribox_soup_gather(soup, made->ids, 0, soup->count, made->room.x, made->room.y, made->room.z))
        return false;
    begin = keep_least(&made->cost.gather, begin, soup->count);
    made->index = (tribox_index){.nodes = made->memory, .soup = &made->room.soup, .ids = made->ids};
    if (tribox_index_build(&made->index, &(tribox_options){.kernel = kernel}, made->memory))
        return false;
    keep_least(&made->cost.build, begin, soup->count);
    return true;
}

void *index_room(size_t triangles)
{
    const size_t bytes = (tribox_index_bytes(triangles) + 63) / 64 * 64;
    void *const room = aligned_alloc(64, bytes);
    if (room)
        memset(room, 0, bytes);
    return room;
}

bool ordered_soup_make(const index_scene *scene, int tries, const char *kernel, ordered_soup *made)
{
    const size_t count = scene->room.soup.count;
    void *const scratch = malloc(16 * count + 1);
    *made = (ordered_soup){
        .ids = malloc(count * sizeof *made->ids), .memory = index_room(count), .cost = {INFINITY, INFINITY, INFINITY}};
    bool is_made = soup_room_make(count, &made->room) && scratch && made->ids && made->memory;
    for (int t = 0; is_made && t < tries; t++)
        is_made = try_once(scene, kernel, scratch, made);
    free(scratch);
    if (!is_made)
        ordered_soup_free(made);
    return is_made || message_failure("%s cannot be ordered or indexed", scene->name) == EXIT_CODE_OK;
}

void ordered_soup_free(ordered_soup *made)
{
    soup_room_free(&made->room);
    free(made->ids);
    free(made->memory);
    *made = (ordered_soup){.memory = NULL};
}
