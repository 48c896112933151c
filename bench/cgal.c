/*
 * cgal.c - the peer that is exact too: CGAL, on the same pairs. Answers have to be equal for all triangles but degenerate ones,
 * which CGAL does not take; then the speeds are compared, interleaved in one process. Its triangles and boxes are made before the
 * clock runs.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cgal_peer.h"
#include "common/soups.h"
#include "common/asked.h"

#ifndef HAVE_CGAL /* nobody stands for the peer */
const char *cgal_version(void) { return NULL; }

cgal_peer *cgal_peer_make(cgal_way way, const double *nine, size_t count, const tribox_box *box)
{
    (void)way, (void)nine, (void)count, (void)box;
    return NULL;
}

void cgal_peer_free(cgal_peer *peer) { (void)peer; }

void cgal_peer_answer(const cgal_peer *peer, uint64_t *mask) { (void)peer, (void)mask; }

bool cgal_peer_is_degenerate(const cgal_peer *peer, size_t i)
{
    (void)peer, (void)i;
    return true;
}
#endif

/* Of a scene the first triangles: CGAL takes seconds for all of them where it needs exact numbers. */
enum { TRIANGLES = 16384 };

static const char *const names[CGAL_WAYS] = {"cgal-epick-bbox", "cgal-epick-cuboid", "cgal-epeck-bbox", "cgal-epeck-cuboid"};

CONTESTANT_RUN(run_peer)
{
    cgal_peer_answer(self->question, mask);
    return true;
}

/* EXACT of every kernel, then the peers. */
static size_t enter(const timing_work *work, contestant *list)
{
    const timing_job *const job = work->jobs;
    double *const nine = asked_allocate(9 * work->pairs, sizeof *nine);
    size_t count = 0;
    const char *kernel;
    for (size_t k = 0; k < 9 * work->pairs; k++)
        nine[k] = (double)job->triangles[k / 9][k / 3 % 3][k % 3];
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++)
        list[count++] = contestant_kernel(work, &(tribox_options){.kernel = kernel});
    for (cgal_way way = CGAL_EPICK_BBOX; way < CGAL_WAYS; way++) {
        list[count] = (contestant){.run = run_peer,
                                   .question = cgal_peer_make(way, nine, work->pairs, &job->box),
                                   .promise = PROMISE_ROUNDED, /* of degenerate triangles CGAL promises nothing */
                                   .pairs = (double)work->pairs};
        snprintf(list[count].name, sizeof list[count].name, "%s", names[way]);
        count++;
    }
    free(nine);
    return count;
}

/* How many triangles CGAL answers otherwise that are degenerate, or are not. */
static size_t count_unlike(const cgal_peer *peer, const uint64_t *exact, const uint64_t *other, size_t count, bool degenerate)
{
    size_t unlike = 0;
    for (size_t i = 0; i < count; i++)
        unlike += ((exact[i / 64] ^ other[i / 64]) >> i % 64 & 1) && cgal_peer_is_degenerate(peer, i) == degenerate;
    return unlike;
}

static size_t index_of(const contestant *list, size_t count, const char *name)
{
    for (size_t c = 0; c < count; c++)
        if (!strcmp(list[c].name, name))
            return c;
    return 0;
}

static bool ask_about(asked *q, const scene *at, const contestant *list, size_t count)
{
    const size_t pairs = at->work.pairs, kernels = count - CGAL_WAYS, avx2 = index_of(list, count, "avx2-exact");
    uint64_t *const exact = asked_allocate(at->work.words, sizeof *exact), *const other =
                                                                               asked_allocate(at->work.words, sizeof *other);
    const truth from = truth_of_work(&at->work);
    const bool is_timed = !asked_has(q, OPTION_VERIFY);
    bool is_right = asked_verify(q, at->name, list, count, &from) && from.find(&at->work, TRIBOX_AXES_ALL, exact);
    if (is_right && is_timed)
        asked_measure(q, at->name, list, count, NULL, asked_effort(q, 15, 3, 2e-3), at->work.words);
    printout_table(&q->out, "scene %s: %zu triangles, %s", at->name, pairs, at->what);
    for (size_t c = 0; is_right && c < count; c++) {
        const cgal_peer *const peer = c < kernels ? NULL : list[c].question;
        if (peer)
            cgal_peer_answer(peer, other);
        const size_t proper = peer ? count_unlike(peer, exact, other, pairs, false) : 0;
        ADD(&q->out, TEXT("contestant", list[c].name), TEXT_DATA("scene", at->name), NUMBER("unlike_EXACT", 0, (double)proper),
            NUMBER("of_degenerate", 0, peer ? (double)count_unlike(peer, exact, other, pairs, true) : 0));
        if (is_timed) {
            printout_times(&q->out, &q->taken, c);
            ADD(&q->out, NUMBER("times_the_widest", 1, measure_ratio(&q->taken, c, 0).median),
                NUMBER("times_avx2", 1, measure_ratio(&q->taken, c, avx2).median));
        }
        printout_row(&q->out);
        is_right = !proper || message_failure("%s: CGAL answers otherwise on triangles that are not degenerate", at->name) == 0;
    }
    if (is_timed)
        printout_disturbed(&q->out, &q->taken);
    free(exact);
    free(other);
    return is_right;
}

static bool answer(asked *q)
{
    static const char *const scenes[] = {"paper",        "sparse", "cad",     "cad-tenths", "touching",
                                         "touching-ulp", "offset", "needles", "caps"};
    const char *const only = q->text[OPTION_SCENE];
    bool is_right = true;
    if (!cgal_version())
        return message_failure("built without CGAL (Debian: libcgal-dev)") == EXIT_CODE_OK;
    printout_note(&q->out, "CGAL       %s, in C++17 with -O3 and without its assertions", cgal_version());
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
        contestant list[CONTESTANTS_MAX];
        scene at;
        size_t index;
        if (only && strcmp(only, scenes[k]) != 0)
            continue;
        if (!scene_find(scenes[k], &index) || !scene_make(index, q->seed, &at))
            return false;
        timing_work_shorten(&at.work, TRIANGLES);
        const size_t count = enter(&at.work, list);
        is_right = ask_about(q, &at, list, count) && is_right;
        for (size_t c = count - CGAL_WAYS; c < count; c++)
            cgal_peer_free((cgal_peer *)(uintptr_t)list[c].question);
        scene_free(&at);
    }
    return is_right;
}

const bench_question question_cgal = {.name = "cgal",
                                      .asks = "Is CGAL's exact answer the same, and how long does it take?",
                                      .options = 1u << OPTION_VERIFY | 1u << OPTION_SCENE | 1u << OPTION_QUICK,
                                      .answer = answer};
