/* ordered_soup.c - orders a soup, gathers it and builds its index, by the clock. */
#define _POSIX_C_SOURCE 200809L
#include "ordered_soup.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "console/message.h"
#include "morton_order.h"

static const char *const names[ORDERS] = {"file", "Morton", "cuts"};

/* Of the processor, as in timing/measure.c. */
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

static bool find_order(const index_scene *scene, soup_order order, void *scratch, uint32_t *ids)
{
    if (order == ORDER_MORTON)
        return morton_order(&scene->room.soup, &scene->bounds, ids);
    return tribox_soup_sort(&scene->room.soup, ids, scratch) == TRIBOX_OK;
}

static bool gather(const index_scene *scene, ordered_soup *to)
{
    const tribox_soup *const soup = &scene->room.soup;
    return tribox_soup_gather(soup, to->ids, 0, soup->count, to->room.x, to->room.y, to->room.z) == TRIBOX_OK;
}

/* In the order of the file nothing is sorted, and the streams are copied. */
static bool try_once(const index_scene *scene, soup_order order, const char *kernel, void *scratch, ordered_soup *made)
{
    const size_t count = scene->room.soup.count;
    double begin = seconds_now();
    if (made->ids) {
        if (!find_order(scene, order, scratch, made->ids))
            return false;
        begin = keep_least(&made->cost.order, begin, count);
        if (!gather(scene, made))
            return false;
        begin = keep_least(&made->cost.gather, begin, count);
    }
    made->index = (tribox_index){.nodes = made->memory, .soup = &made->room.soup, .ids = made->ids};
    if (tribox_index_build(&made->index, &(tribox_options){.kernel = kernel}, made->memory) != TRIBOX_OK)
        return false;
    keep_least(&made->cost.build, begin, count);
    return true;
}

static void copy_streams(const index_scene *scene, ordered_soup *made)
{
    for (size_t i = 0; i < scene->room.soup.count; i++) {
        float u[3][3];
        soup_triangle(&scene->room.soup, i, u);
        soup_room_put(&made->room, i, (const float(*)[3])u);
    }
}

static bool make_room(size_t count, soup_order order, ordered_soup *made)
{
    const size_t bytes = tribox_index_bytes(count);
    if (!soup_room_make(count, &made->room))
        return false;
    made->memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    made->ids = order == ORDER_FILE ? NULL : malloc(count * sizeof *made->ids);
    if (made->memory)
        memset(made->memory, 0, bytes);
    return made->memory && (order == ORDER_FILE || made->ids);
}

bool ordered_soup_make(const index_scene *scene, soup_order order, int tries, const char *kernel, ordered_soup *made)
{
    const size_t count = scene->room.soup.count;
    *made = (ordered_soup){.name = names[order]};
    void *const scratch = malloc(16 * count + 1);
    bool is_made = scratch && make_room(count, order, made);
    made->cost = order == ORDER_FILE ? (order_cost){0, 0, INFINITY} : (order_cost){INFINITY, INFINITY, INFINITY};
    if (is_made && order == ORDER_FILE)
        copy_streams(scene, made);
    for (int t = 0; is_made && t < tries; t++)
        is_made = try_once(scene, order, kernel, scratch, made);
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
    *made = (ordered_soup){.name = NULL};
}
