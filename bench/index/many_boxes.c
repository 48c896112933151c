/* many_boxes.c - boxes as streams, in two orders, and room for their lists. */
#include "many_boxes.h"

#include <stdlib.h>
#include <string.h>

static bool run_lists(const contestant *self, int which)
{
    const many_boxes *const m = self->question;
    return !tribox_index_lists(&m->soup->index, &m->boxes[which], &self->options, m->room, m->list, m->start);
}

static bool run_as_drawn(const contestant *self, uint64_t *mask, tribox_report *report)
{
    (void)mask;
    (void)report;
    return run_lists(self, 0);
}

static bool run_in_order(const contestant *self, uint64_t *mask, tribox_report *report)
{
    (void)mask;
    (void)report;
    return run_lists(self, 1);
}

static bool run_ordering(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const many_boxes *const m = self->question;
    (void)mask;
    (void)report;
    return !tribox_boxes_sort(&m->boxes[0], m->order, m->scratch);
}

void many_boxes_free(many_boxes *m)
{
    free(m->bounds[0][0]);
    free(m->order);
    free(m->list);
    free(m->scratch);
    free(m->start);
}

static bool many_make_room(size_t count, many_boxes *m)
{
    float *const bounds = malloc(12 * count * sizeof *bounds);
    m->bounds[0][0] = bounds;
    m->order = malloc(count * sizeof *m->order);
    m->scratch = malloc(16 * count);
    m->start = malloc((count + 1) * sizeof *m->start);
    for (size_t k = 0; k < 12; k++) {
        m->bounds[k / 6][k % 6] = bounds ? bounds + k * count : NULL;
        const float **const to = k % 6 < 3 ? m->boxes[k / 6].lo : m->boxes[k / 6].hi;
        to[k % 3] = m->bounds[k / 6][k % 6];
    }
    m->boxes[0].count = m->boxes[1].count = count;
    return bounds && m->order && m->scratch && m->start;
}

bool many_boxes_make(const ordered_soup *soup, const tribox_box *boxes, size_t count, const char *kernel, many_boxes *m)
{
    const tribox_options options = {.kernel = kernel};
    *m = (many_boxes){.soup = soup, .drawn = boxes};
    if (!many_make_room(count, m))
        return false;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 6; k++)
            m->bounds[0][k][i] = k < 3 ? (float)boxes[i].lo[k] : (float)boxes[i].hi[k - 3];
    if (tribox_boxes_sort(&m->boxes[0], m->order, m->scratch))
        return false;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 6; k++)
            m->bounds[1][k][i] = m->bounds[0][k][m->order[i]];
    if (tribox_index_lists(&m->soup->index, &m->boxes[0], &options, 0, NULL, m->start))
        return false;
    m->room = m->start[count];
    m->list = malloc((m->room + 1) * sizeof *m->list);
    return m->list;
}

bool many_boxes_are_right(const many_boxes *m, const char *kernel, uint32_t *list)
{
    const ordered_soup *const s = m->soup;
    const tribox_options options = {.kernel = kernel};
    if (tribox_index_lists(&s->index, &m->boxes[0], &options, m->room, m->list, m->start))
        return false;
    for (size_t i = 0; i < m->boxes[0].count; i++) {
        size_t found;
        if (tribox_index_list(&s->index, &(tribox_region){.box = &m->drawn[i]}, &options, s->room.soup.count, list, &found) ||
            found != m->start[i + 1] - m->start[i] || memcmp(list, m->list + m->start[i], found * sizeof *m->list) != 0)
            return false;
    }
    return true;
}

contestant many_boxes_contestant(const many_boxes *question, many_run run, const char *kernel)
{
    static bool (*const runs[MANY_RUNS])(const contestant *, uint64_t *, tribox_report *) = {run_as_drawn, run_in_order,
                                                                                             run_ordering};
    return (contestant){
        .run = runs[run], .question = question, .options = {.kernel = kernel}, .pairs = (double)question->boxes[0].count};
}
