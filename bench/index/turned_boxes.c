/* turned_boxes.c - turns boxes and asks about them. */
#include "turned_boxes.h"

#include <stdlib.h>

#include "console/message.h"
#include "index_forms.h"

/* Turned by 0.5 about x, then by 0.7 about z. */
static tribox_oriented_box turn(const tribox_box *box)
{
    const float c = 0.76484219f, s = 0.64421769f, e = 0.87758256f, d = 0.47942554f;
    tribox_oriented_box turned = {.axis = {{c, s * e, s * d}, {-s, c * e, c * d}, {0, -d, e}}};
    for (int a = 0; a < 3; a++) {
        turned.center[a] = (float)box->lo[a] / 2 + (float)box->hi[a] / 2;
        turned.half[a] = (float)box->hi[a] / 2 - (float)box->lo[a] / 2;
    }
    return turned;
}

bool turned_boxes_make(const ordered_soup *soup, const tribox_box *boxes, size_t count, uint32_t *list, uint64_t *mask,
                       turned_boxes *made)
{
    *made = (turned_boxes){.soup = soup, .boxes = malloc(count * sizeof *made->boxes), .count = count, .list = list, .mask = mask};
    for (size_t b = 0; made->boxes && b < count; b++)
        made->boxes[b] = turn(&boxes[b]);
    return made->boxes || message_failure("out of memory for boxes") == EXIT_CODE_OK;
}

void turned_boxes_free(turned_boxes *made) { free(made->boxes); }

static bool ask_index(const turned_boxes *q, const tribox_oriented_box *box, const tribox_options *options, size_t *found)
{
    return !tribox_index_list(&q->soup->index, &(tribox_region){.oriented = box}, options, q->soup->room.soup.count, q->list,
                              found);
}

static bool ask_linear(const turned_boxes *q, const tribox_oriented_box *box, const tribox_options *options)
{
    return !tribox_overlap_oriented(&q->soup->room.soup, box, options, q->mask, NULL);
}

static bool is_list_right(const turned_boxes *q, size_t found)
{
    size_t at = 0;
    for (size_t i = 0; i < q->soup->room.soup.count; i++)
        if (q->mask[i / 64] >> i % 64 & 1) {
            if (at == found || q->list[at] != q->soup->ids[i])
                return false;
            at++;
        }
    return at == found;
}

bool turned_boxes_are_right(const turned_boxes *question, size_t boxes, const char *kernel)
{
    const tribox_options options = {.kernel = kernel};
    size_t found;
    for (size_t b = 0; b < boxes; b++)
        if (!ask_linear(question, &question->boxes[b], &options) || !ask_index(question, &question->boxes[b], &options, &found) ||
            !is_list_right(question, found))
            return message_failure("box %zu, turned: the list is wrong", b) == EXIT_CODE_OK;
    return true;
}

static bool run_index(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const turned_boxes *const q = self->question;
    size_t found;
    (void)mask;
    (void)report;
    for (size_t b = 0; b < q->count; b++)
        if (!ask_index(q, &q->boxes[b], &self->options, &found))
            return false;
    return true;
}

static bool run_linear(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const turned_boxes *const q = self->question;
    (void)mask;
    (void)report;
    for (size_t b = 0; b < (size_t)self->pairs; b++)
        if (!ask_linear(q, &q->boxes[b], &self->options))
            return false;
    return true;
}

contestant turned_boxes_by_index(const turned_boxes *question, const char *kernel)
{
    return (contestant){.name = "turned",
                        .run = run_index,
                        .prepare = index_warm_up,
                        .question = question,
                        .options = {.kernel = kernel},
                        .pairs = (double)question->count};
}

contestant turned_boxes_linear(const turned_boxes *question, size_t boxes, const char *kernel)
{
    return (contestant){
        .name = "turned, linear", .run = run_linear, .question = question, .options = {.kernel = kernel}, .pairs = (double)boxes};
}
