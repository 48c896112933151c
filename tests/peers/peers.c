/*
 * peers.c - an index over a soup against other libraries that answer the same question: are the answers the same, and who is how
 * fast?
 *
 * Exact peers have to agree on every triangle and box, or the program fails and times nothing more. Those that round are counted.
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/box_scenes.h"
#include "console/clock.h"
#include "console/message.h"
#include "peer.h"

/* The peers that the build has found. */
static const peer *const peers_here[] = {
#if HAVE_CGAL
    &peer_cgal,
#endif
#if HAVE_EMBREE
    &peer_embree, &peer_embree_boxes,
#endif
#if HAVE_BULLET
    &peer_bullet,
#endif
    NULL,
};

enum { PEERS_MAX = 4, FIELD_MAX = 3 + 2 * PEERS_MAX };

/* A peer over the soup. */
typedef struct peer_field {
    const peer *peer;
    void *tree;          /* NULL if the soup has too many triangles for it */
    double seconds;      /* to build it */
    double list_seconds; /* for the lists of all boxes, when they were compared */
    peer_lists lists;
} peer_field;

/* Answers of a peer that are not those of the index, over boxes. */
typedef struct peer_errors {
    size_t missing, extra, any;
    size_t candidates; /* triangles that had to be tested */
    size_t near;       /* of the missing and the extra: within 2^-18 of the greatest coordinate of contact */
} peer_errors;

typedef struct field {
    const scene *scene;
    ordered_soup soup;
    double seconds; /* to order and build it */
    answer_room room;
    const float (*triangles)[3][3];
    peer_field peers[PEERS_MAX];
    size_t peer_count;
    const tribox_box *boxes;
    size_t box_count;
    uint32_t *list; /* of the index: that of box b, sorted, begins at start[b] */
    size_t *start;
} field;

/* Who can be timed, and what each is called in tables. */
typedef struct entrant {
    char name[32];
    const peer_field *peer; /* NULL for the index */
    bool is_any;
} entrant;

enum { ENTRANT_LIST, ENTRANT_ANY, ENTRANT_LINEAR, ENTRANTS_OF_INDEX };

/* ---- who is asked ---- */

static const double once_seconds = 1, warm_seconds = 0.1; /* a pass of more than so long fills the caches by itself */

/* False, with a message, if memory or the library fails. */
static bool field_make(const scene *at, size_t boxes_most, field *made)
{
    const size_t count = at->work.pairs;
    *made = (field){.scene = at, .triangles = at->work.jobs[0].triangles};
    made->start = malloc((boxes_most + 1) * sizeof *made->start);
    answer_room_make(count, 1, &made->room);
    const double start = clock_seconds();
    if (!made->start || !ordered_soup_make(at, NULL, &made->soup))
        return false;
    made->seconds = clock_seconds() - start;
    for (size_t p = 0; peers_here[p]; p++) {
        const double begin = clock_seconds();
        peer_field *const to = &made->peers[made->peer_count++];
        *to = (peer_field){.peer = peers_here[p], .tree = peers_here[p]->make(made->triangles, count)};
        to->seconds = clock_seconds() - begin;
        to->lists.start = malloc((boxes_most + 1) * sizeof *to->lists.start);
        if (!to->lists.start)
            return message_failure("out of memory for lists") == EXIT_CODE_OK;
    }
    return true;
}

static void field_free(field *f)
{
    for (size_t p = 0; p < f->peer_count; p++) {
        if (f->peers[p].tree)
            f->peers[p].peer->release(f->peers[p].tree);
        free(f->peers[p].lists.list);
        free(f->peers[p].lists.start);
    }
    free(f->list);
    free(f->start);
}

/* ---- answers ---- */

static int by_number(const void *a, const void *b)
{
    const uint32_t p = *(const uint32_t *)a, q = *(const uint32_t *)b;
    return (p > q) - (p < q);
}

static bool answer_by_index(field *f)
{
    size_t found = 0, room = 0;
    free(f->list);
    f->list = NULL;
    for (size_t b = 0; b < f->box_count; b++) {
        f->start[b] = found;
        if (tribox_index_list(&f->soup.index, &(tribox_region){.box = &f->boxes[b]}, NULL, f->soup.soup.count, f->room.list, &room))
            return message_failure("the index refuses a question") == EXIT_CODE_OK;
        uint32_t *const list = realloc(f->list, (found + room + 1) * sizeof *list);
        if (!list)
            return message_failure("out of memory for lists") == EXIT_CODE_OK;
        f->list = list;
        memcpy(list + found, f->room.list, room * sizeof *list);
        qsort(list + found, room, sizeof *list, by_number);
        found += room;
    }
    f->start[f->box_count] = found;
    return true;
}

/* Whether the answer changes where the box is a little larger or smaller: what float cannot tell. */
static bool is_near(const field *f, uint32_t triangle, const tribox_box *box, bool is_missing)
{
    const float(*const u)[3] = f->triangles[triangle];
    tribox_soup one = {.count = 1};
    float most = 0;
    tribox_box moved = *box;
    uint64_t mask = 0;
    for (int v = 0; v < 3; v++) {
        one.x[v] = &u[v][0];
        one.y[v] = &u[v][1];
        one.z[v] = &u[v][2];
    }
    for (int a = 0; a < 3; a++) {
        most = fmaxf(most, fmaxf(fabsf((float)box->lo[a]), fabsf((float)box->hi[a])));
        for (int v = 0; v < 3; v++)
            most = fmaxf(most, fabsf(u[v][a]));
    }
    for (int a = 0; a < 3; a++) {
        moved.lo[a] += (is_missing ? most : -most) * 0x1p-18f;
        moved.hi[a] -= (is_missing ? most : -most) * 0x1p-18f;
    }
    tribox_overlap(&one, &moved, NULL, &mask, NULL);
    return mask != is_missing;
}

/* Both lists sorted. */
static void compare_box(const field *f, size_t b, uint32_t *list, size_t count, peer_errors *unlike)
{
    const uint32_t *own = f->list + f->start[b], *const end = f->list + f->start[b + 1];
    qsort(list, count, sizeof *list, by_number);
    for (size_t i = 0; own < end || i < count;) {
        const bool is_missing = i == count || (own < end && *own < list[i]);
        const bool is_extra = own == end || (i < count && list[i] < *own);
        if (is_missing || is_extra) {
            unlike->missing += is_missing;
            unlike->extra += is_extra;
            unlike->near += is_near(f, is_missing ? *own : list[i], &f->boxes[b], is_missing);
        }
        own += !is_extra;
        i += !is_missing;
    }
}

static void compare(field *f, peer_field *with, peer_errors *unlike)
{
    size_t overlapped = 0;
    with->lists.count = with->lists.candidates = 0;
    if (with->peer->take_boxes)
        with->peer->take_boxes(with->tree, f->boxes, f->box_count);
    const double begin = clock_seconds();
    with->peer->list(with->tree, f->boxes, f->box_count, &with->lists);
    with->list_seconds = clock_seconds() - begin;
    for (size_t b = 0; b < f->box_count; b++) {
        const size_t first = with->lists.start[b];
        compare_box(f, b, with->lists.list + first, with->lists.start[b + 1] - first, unlike);
        overlapped += f->start[b + 1] > f->start[b];
    }
    unlike->candidates += with->lists.candidates;
    if (with->peer->any)
        unlike->any += with->peer->any(with->tree, f->boxes, f->box_count) != overlapped;
}

static index_question question_of(field *f, size_t linear_boxes)
{
    return (index_question){.name = "cuts",
                            .index = &f->soup.index,
                            .triangles = f->soup.soup.count,
                            .boxes = f->boxes,
                            .count = f->box_count,
                            .linear_count = linear_boxes,
                            .room = &f->room};
}

/*
 * Asks everyone, and adds to the errors. verified: so many of the boxes are asked of tribox_overlap, too. False, with a message, if
 * the index itself is wrong about them.
 */
static bool field_answer(field *f, const tribox_box *boxes, size_t count, size_t verified, peer_errors unlike[PEERS_MAX])
{
    f->boxes = boxes;
    f->box_count = count;
    const index_question question = question_of(f, count);
    if (!index_forms_verify(&question, verified, NULL) || !answer_by_index(f))
        return false;
    for (size_t p = 0; p < f->peer_count; p++)
        if (f->peers[p].tree)
            compare(f, &f->peers[p], &unlike[p]);
    return true;
}

/* ---- times ---- */

/* A peer, and what it is asked. */
typedef struct peer_question {
    peer_field *with;
    const tribox_box *boxes;
    size_t count;
} peer_question;

CONTESTANT_RUN(run_list)
{
    const peer_question *const q = self->question;
    q->with->lists.count = 0;
    q->with->peer->list(q->with->tree, q->boxes, q->count, &q->with->lists);
    return true;
}

CONTESTANT_RUN(run_any)
{
    const peer_question *const q = self->question;
    mask[0] = q->with->peer->any(q->with->tree, q->boxes, q->count);
    return true;
}

/* The index, its any and tribox_overlap without it, then the peers. Returns how many; of those that are absent the time is NaN. */
static size_t field_entrants(const field *f, entrant list[FIELD_MAX])
{
    static const char *const own[ENTRANTS_OF_INDEX] = {"list", "any", "linear"};
    size_t count = 0;
    for (; count < ENTRANTS_OF_INDEX; count++) {
        list[count] = (entrant){.is_any = count == ENTRANT_ANY};
        snprintf(list[count].name, sizeof list[count].name, "%s", own[count]);
    }
    for (size_t p = 0; p < f->peer_count; p++)
        for (int is_any = 0; is_any <= (f->peers[p].peer->any != NULL); is_any++) {
            list[count] = (entrant){.peer = &f->peers[p], .is_any = is_any};
            snprintf(list[count].name, sizeof list[count].name, "%s%s", f->peers[p].peer->name, is_any ? " any" : "");
            count++;
        }
    return count;
}

/*
 * Microseconds a box of every entrant, the least of some rounds. Whoever takes more than a second for all boxes is timed once.
 * linear_boxes: so many of the boxes for tribox_overlap alone.
 */
static void field_time(field *f, size_t rounds, size_t linear_boxes, generator *order, double us[FIELD_MAX])
{
    static samples taken;
    static const index_form forms[ENTRANTS_OF_INDEX] = {FORM_LIST, FORM_ANY, FORM_LINEAR};
    const index_question own = question_of(f, linear_boxes);
    peer_question questions[PEERS_MAX];
    entrant entrants[FIELD_MAX];
    contestant list[FIELD_MAX];
    size_t place[FIELD_MAX], timed = 0;
    const size_t count = field_entrants(f, entrants);
    for (size_t e = 0; e < count; e++) {
        us[e] = NAN;
        if (entrants[e].peer && !entrants[e].peer->tree)
            continue;
        if (e < ENTRANTS_OF_INDEX)
            list[timed] = index_contestant(&own, forms[e], false, NULL);
        else {
            peer_question *const q = &questions[entrants[e].peer - f->peers];
            *q = (peer_question){&f->peers[entrants[e].peer - f->peers], f->boxes, f->box_count};
            list[timed] = (contestant){.run = entrants[e].is_any ? run_any : run_list, .question = q, .pairs = (double)q->count};
            list[timed].prepare = q->with->list_seconds > warm_seconds ? NULL : index_warm_up;
            list[timed].is_timed_once = !entrants[e].is_any && q->with->list_seconds > once_seconds;
        }
        place[timed++] = e;
    }
    measure(list, timed, (effort){.rounds = rounds, .seconds = 1e9, .sample = 2e-3}, order, 1, &taken);
    for (size_t c = 0; c < timed; c++)
        us[place[c]] = 1e-3 * measure_least(&taken, c);
}

/* ---- tables ---- */

enum { SKIPPED = 77, PEER_SIZES = 7 };

/* Edges of the boxes, as parts of the greatest extent. */
static const double peer_part[PEER_SIZES] = {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 0.5};

/* A linear pass has as many boxes as there is time for. */
static const size_t linear_pairs = 100000000, verified_pairs = 5000000;

/* Exact peers may not differ; the index has no excuse, as CGAL and Embree have none. */
static bool are_answers_right(const field *f, const peer_errors unlike[PEERS_MAX])
{
    bool is_right = true;
    for (size_t p = 0; p < f->peer_count; p++)
        if (f->peers[p].tree && (unlike[p].any || (f->peers[p].peer->is_exact && unlike[p].missing + unlike[p].extra))) {
            message_failure("%s: %s answers otherwise: missing %zu, extra %zu%s", f->scene->name, f->peers[p].peer->name,
                            unlike[p].missing, unlike[p].extra, unlike[p].any ? ", and whether there is any" : "");
            is_right = false;
        }
    return is_right;
}

/* List and linear are compared with the list of the index, any with its any. */
static void tell_size(printout *out, const field *f, int size, const double us[FIELD_MAX])
{
    entrant entrants[FIELD_MAX];
    const size_t count = field_entrants(f, entrants);
    const double hits = (double)f->start[f->box_count] / (double)f->box_count;
    for (size_t e = 0; e < count; e++)
        ROW(out, TEXT("contestant", entrants[e].name), TEXT_DATA("scene", f->scene->name),
            NUMBER("box_%", 1, 100 * peer_part[size]), NUMBER("hits", 1, hits), NUMBER("us", 2, us[e]),
            NUMBER("times", 1, us[e] / us[entrants[e].is_any ? ENTRANT_ANY : ENTRANT_LIST]));
}

static bool run_size(asked *q, field *f, int size, tribox_box *boxes, size_t count, peer_errors unlike[PEERS_MAX])
{
    double us[FIELD_MAX];
    scene_boxes(f->scene, peer_part[size], count, q->seed + (uint64_t)size, boxes);
    if (!field_answer(f, boxes, count, scene_boxes_within(f->scene, verified_pairs, count), unlike))
        return false;
    if (!asked_has(q, OPTION_VERIFY)) {
        field_time(f, (size_t)asked_number(q, OPTION_ROUNDS, 9), scene_boxes_within(f->scene, linear_pairs, count), &q->order, us);
        tell_size(&q->out, f, size, us);
    }
    return are_answers_right(f, unlike);
}

static void tell_errors(printout *out, const field *f, size_t boxes, size_t hits, const peer_errors unlike[PEERS_MAX])
{
    printout_table(out, "%s: answers about %zu boxes, %zu hits", f->scene->name, boxes, hits);
    for (size_t p = 0; p < f->peer_count; p++) {
        ROW(out, TEXT("peer", f->peers[p].peer->name), DATA("all_hits", hits),
            NUMBER_IF(f->peers[p].tree, "missing", 0, unlike[p].missing), NUMBER_IF(f->peers[p].tree, "extra", 0, unlike[p].extra),
            NUMBER("within_rounding", 0, unlike[p].near),
            NUMBER_IF(hits, "candidates_a_hit", 2, (double)unlike[p].candidates / (double)hits),
            NUMBER("seconds_to_build", 3, f->peers[p].seconds));
    }
}

static bool run_scene(asked *q, scene *at)
{
    const size_t count = (size_t)asked_number(q, OPTION_BOXES, asked_has(q, OPTION_VERIFY) ? 5 : 50);
    field f;
    peer_errors unlike[PEERS_MAX] = {{0}};
    size_t hits = 0;
    tribox_box *const boxes = asked_allocate(count, sizeof *boxes);
    bool is_run = field_make(at, count, &f);
    if (is_run && !asked_has(q, OPTION_VERIFY))
        printout_table(&q->out, "%s: %zu triangles; seconds to build the index %.3f", at->name, at->work.pairs, f.seconds);
    for (int size = 0; is_run && size < PEER_SIZES; size++) {
        is_run = run_size(q, &f, size, boxes, count, unlike);
        hits += is_run ? f.start[count] : 0;
    }
    if (is_run)
        tell_errors(&q->out, &f, PEER_SIZES * count, hits, unlike);
    field_free(&f);
    return is_run;
}

static bool answer(asked *q)
{
    const size_t terrain = (size_t)asked_number(q, OPTION_TERRAIN, asked_has(q, OPTION_VERIFY) ? 20000 : 0);
    return scenes_ask(q, SCENES_USUAL, terrain, run_scene);
}

int main(int argc, char **argv)
{
    static const bench_question peers = {
        .name = "",
        .asks = "Does an index answer as CGAL, Embree and Bullet do, and how many times as fast is it?",
        .options = 1u << OPTION_VERIFY | 1u << OPTION_TERRAIN | 1u << OPTION_BOXES,
        .takes_meshes = true,
        .answer = answer};
    static const bench_question *const all[] = {&peers};
    static asked q;
    if (!peers_here[0]) {
        printf("skipped: built without CGAL, Embree and Bullet (Debian: libcgal-dev, libembree-dev, libbullet-dev)\n");
        return SKIPPED;
    }
    return asked_main(argc, argv, all, 1, &q);
}
