#include "compare.h"

#include <stdlib.h>
#include <string.h>

#include "zeroed.h"

/* The candidates of one triangle, as the library takes them, and room for the answers. */
typedef struct candidate_boxes {
    size_t t;
    tribox_boxes boxes;
    float *bound[6]; /* lo, then hi */
    uint64_t *mask;
    size_t capacity;
} candidate_boxes;

static void candidate_boxes_free(candidate_boxes *q)
{
    for (int k = 0; k < 6; k++)
        free(q->bound[k]);
    free(q->mask);
}

static void reserve(candidate_boxes *q, size_t count)
{
    if (count <= q->capacity)
        return;
    candidate_boxes_free(q);
    q->capacity = 2 * count;
    q->mask = memory_of(tribox_mask_words(q->capacity), sizeof *q->mask);
    for (int k = 0; k < 6; k++) {
        q->bound[k] = memory_of(q->capacity, sizeof *q->bound[k]);
        *(k < 3 ? &q->boxes.lo[k] : &q->boxes.hi[k - 3]) = q->bound[k];
    }
}

static void ask_about(candidate_boxes *q, const grid_planes *p, const block *candidates, size_t t)
{
    q->t = t;
    q->boxes.count = block_cells(candidates);
    reserve(q, q->boxes.count);
    size_t number = 0;
    int at[3];
    for (at[2] = 0; at[2] < candidates->count[2]; at[2]++)
        for (at[1] = 0; at[1] < candidates->count[1]; at[1]++)
            for (at[0] = 0; at[0] < candidates->count[0]; at[0]++, number++)
                for (int a = 0; a < 3; a++) {
                    const double *const plane = &p->plane[a][candidates->first[a] + at[a]];
                    q->bound[a][number] = (float)plane[0];
                    q->bound[3 + a][number] = (float)plane[1];
                }
}

static void breach(const witness *w, answerer *who, size_t t, const int cell[3], bool answer)
{
    pair_f32 pair = {.box = grid_planes_cell(w->planes, cell[0], cell[1], cell[2])};
    memcpy(pair.u, w->model->triangles[t].u, sizeof pair.u);
    *(answer ? &who->unfounded : &who->missed) += 1;
    if (who->breach)
        who->breach(who, &pair, answer);
}

static size_t bits_of(uint64_t word)
{
    size_t count = 0;
    for (; word; word &= word - 1)
        count++;
    return count;
}

static int lowest_bit(uint64_t word)
{
    int bit = 0;
    while (!(word >> bit & 1))
        bit++;
    return bit;
}

static void compare_masks(const witness *w, answerer *who, const candidate_boxes *q)
{
    for (size_t k = 0; k < tribox_mask_words(q->boxes.count); k++) {
        const uint64_t certain = w->certain[w->first_word[q->t] + k], possible = w->possible[w->first_word[q->t] + k];
        who->overlapping += bits_of(q->mask[k]);
        for (uint64_t wrong = (certain & ~q->mask[k]) | (q->mask[k] & ~possible); wrong; wrong &= wrong - 1) {
            const int bit = lowest_bit(wrong);
            int cell[3];
            block_cell(&w->candidates[q->t], 64 * k + (size_t)bit, cell);
            breach(w, who, q->t, cell, q->mask[k] >> bit & 1);
        }
    }
}

static void set_occupied(const witness *w, const candidate_boxes *q, uint64_t *occupied)
{
    for (size_t k = 0; k < tribox_mask_words(q->boxes.count); k++)
        for (uint64_t rest = q->mask[k]; rest; rest &= rest - 1) {
            int cell[3];
            block_cell(&w->candidates[q->t], 64 * k + (size_t)lowest_bit(rest), cell);
            const size_t bit = planes_bit(w->planes, cell);
            occupied[bit / 64] |= UINT64_C(1) << bit % 64;
        }
}

size_t compare(const witness *w, answerer *const *answerers, int count, uint64_t *occupied)
{
    candidate_boxes q = {0};
    size_t pairs = 0;
    for (size_t t = 0; t < w->model->count; t++) {
        ask_about(&q, w->planes, &w->candidates[t], t);
        pairs += q.boxes.count;
        for (int k = 0; k < count; k++) {
            answerers[k]->answer(answerers[k], t, &w->model->triangles[t], &q.boxes, q.mask);
            compare_masks(w, answerers[k], &q);
            if (k == 0 && occupied)
                set_occupied(w, &q, occupied);
        }
    }
    candidate_boxes_free(&q);
    return pairs;
}

void compare_pair(const witness *w, answerer *who, size_t t, const int cell[3], bool answer)
{
    bool is_certain = false, is_possible = false;
    if (block_has(&w->candidates[t], cell)) {
        const size_t number = block_number(&w->candidates[t], cell), word = w->first_word[t] + number / 64;
        is_certain = w->certain[word] >> number % 64 & 1;
        is_possible = w->possible[word] >> number % 64 & 1;
    }
    who->overlapping += answer;
    if ((is_certain && !answer) || (answer && !is_possible))
        breach(w, who, t, cell, answer);
}
