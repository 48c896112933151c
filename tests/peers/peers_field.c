/* peers_field.c - asks everyone, compares the answers, and takes the times. */
#define _POSIX_C_SOURCE 200809L
#include "peers_field.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "console/clock.h"
#include "console/message.h"

static const double once_seconds = 1, warm_seconds = 0.1; /* a pass of more than so long fills the caches by itself */

bool field_make(const index_scene *scene, size_t boxes_most, field *made)
{
    const size_t count = scene->room.soup.count;
    *made = (field){.scene = scene};
    made->triangles = malloc(count * sizeof *made->triangles);
    made->start = malloc((boxes_most + 1) * sizeof *made->start);
    answer_room_make(count, 1, &made->room);
    if (!made->triangles || !made->start || !ordered_soup_make(scene, 1, NULL, &made->soup))
        return false;
    for (size_t i = 0; i < count; i++)
        soup_triangle(&scene->room.soup, i, made->triangles[i]);
    for (size_t p = 0; peers_here[p]; p++) {
        const double begin = clock_seconds();
        peer_field *const to = &made->peers[made->peer_count++];
        *to = (peer_field){.peer = peers_here[p], .tree = peers_here[p]->make((const float(*)[3][3])made->triangles, count)};
        to->seconds = clock_seconds() - begin;
        to->lists.start = malloc((boxes_most + 1) * sizeof *to->lists.start);
        if (!to->lists.start)
            return message_failure("out of memory for lists") == EXIT_CODE_OK;
    }
    return true;
}

void field_free(field *f)
{
    for (size_t p = 0; p < f->peer_count; p++) {
        if (f->peers[p].tree)
            f->peers[p].peer->release(f->peers[p].tree);
        free(f->peers[p].lists.list);
        free(f->peers[p].lists.start);
    }
    ordered_soup_free(&f->soup);
    answer_room_free(&f->room);
    free(f->triangles);
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
        if (tribox_index_list(&f->soup.index, &(tribox_region){.box = &f->boxes[b]}, NULL, f->soup.room.soup.count, f->room.list,
                              &room))
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
    const float(*const u)[3] = (const float(*)[3])f->triangles[triangle];
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
static void compare_box(const field *f, size_t b, uint32_t *list, size_t count, peer_errors *errors)
{
    const uint32_t *own = f->list + f->start[b], *const end = f->list + f->start[b + 1];
    qsort(list, count, sizeof *list, by_number);
    for (size_t i = 0; own < end || i < count;) {
        const bool is_missing = i == count || (own < end && *own < list[i]);
        const bool is_extra = own == end || (i < count && list[i] < *own);
        if (is_missing || is_extra) {
            errors->missing += is_missing;
            errors->extra += is_extra;
            errors->near += is_near(f, is_missing ? *own : list[i], &f->boxes[b], is_missing);
        }
        own += !is_extra;
        i += !is_missing;
    }
}

static void compare(field *f, peer_field *with, peer_errors *errors)
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
        compare_box(f, b, with->lists.list + first, with->lists.start[b + 1] - first, errors);
        overlapped += f->start[b + 1] > f->start[b];
    }
    errors->candidates += with->lists.candidates;
    if (with->peer->any)
        errors->any += with->peer->any(with->tree, f->boxes, f->box_count) != overlapped;
}

static index_question question_of(field *f, size_t linear_boxes)
{
    return (index_question){.name = "cuts",
                            .index = &f->soup.index,
                            .ids = f->soup.ids,
                            .triangles = f->soup.room.soup.count,
                            .soup = &f->soup.room.soup,
                            .boxes = f->boxes,
                            .count = f->box_count,
                            .linear_count = linear_boxes,
                            .room = &f->room};
}

bool field_answer(field *f, const tribox_box *boxes, size_t count, size_t verified, peer_errors errors[PEERS_MAX])
{
    f->boxes = boxes;
    f->box_count = count;
    const index_question question = question_of(f, count);
    if (!index_forms_verify(&question, verified, NULL) || !answer_by_index(f))
        return false;
    for (size_t p = 0; p < f->peer_count; p++)
        if (f->peers[p].tree)
            compare(f, &f->peers[p], &errors[p]);
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

size_t field_entrants(const field *f, entrant list[FIELD_MAX])
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

void field_time(field *f, size_t rounds, size_t linear_boxes, generator *order, double us[FIELD_MAX])
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
    measure(list, timed, (effort){.rounds = rounds, .seconds = 1e9, .sample = 2e-3}, order, f->room.mask, &taken);
    for (size_t c = 0; c < timed; c++)
        us[place[c]] = 1e-3 * measure_least(&taken, c);
}
