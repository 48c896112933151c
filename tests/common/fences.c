#include "fences.h"

#include "common/harness.h"
#include "common/window_bits.h"

/* Far enough to be no neighbour: a fence may be large, and is looked at very often. */
enum { NEIGHBOURS = 1024 };

static unsigned char *lower_end(const fenced *place)
{
    const size_t before = (size_t)(place->at - place->fence.first);
    return place->at - (before < NEIGHBOURS ? before : NEIGHBOURS);
}

static unsigned char *upper_end(const fenced *place)
{
    unsigned char *const end = place->at + place->bytes;
    const size_t behind = (size_t)(place->fence.first + place->fence.size - end);
    return end + (behind < NEIGHBOURS ? behind : NEIGHBOURS);
}

fenced fenced_place(guarded fence, size_t bytes, int offset)
{
    unsigned char *const at = offset == AT_END ? guarded_tail(fence, bytes) : fence.first + offset;
    const fenced place = {fence, at, bytes};
    unsigned char *const from = lower_end(&place);
    memset(from, POISON, (size_t)(upper_end(&place) - from));
    return place;
}

static void assert_poisoned(const unsigned char *from, const unsigned char *end)
{
    for (; from < end; from++)
        if (*from != POISON)
            fail_msg("%s: written where nothing may be", doing);
}

void assert_nothing_beside(const fenced *place)
{
    assert_poisoned(lower_end(place), place->at);
    assert_poisoned(place->at + place->bytes, upper_end(place));
}

void assert_nothing_written(const fenced *place) { assert_poisoned(lower_end(place), upper_end(place)); }

void assert_report(const tribox_report *report, const uint64_t *mask, size_t count, tribox_accuracy accuracy)
{
    const size_t set = bits_set(mask, tribox_mask_words(count));
    if (report->overlapping != set || report->undecided > (accuracy == TRIBOX_FAST ? 0 : count))
        fail_msg("%s: reports %zu of %zu, %zu undecided", doing, report->overlapping, set, report->undecided);
}

void stream_fences_make(size_t most, guarded fence[9])
{
    for (int s = 0; s < 9; s++)
        fence[s] = guarded_make((most + STREAM_SHIFTS) * sizeof(float));
}

tribox_soup streams_lay(const guarded fence[9], size_t count, int shift, float *to[9])
{
    tribox_soup soup = {.count = count};
    for (int s = 0; s < 9; s++) {
        const size_t bytes = count * sizeof(float);
        to[s] = shift == AT_END ? guarded_tail(fence[s], bytes) : (float *)(void *)fence[s].first + shift;
        (s < 3 ? soup.x : s < 6 ? soup.y : soup.z)[s % 3] = to[s];
    }
    return soup;
}

tribox_soup streams_of_triangles(const guarded fence[9], int shift, const double (*u)[3][3], size_t count)
{
    float *to[9];
    const tribox_soup soup = streams_lay(fence, count, shift, to);
    for (size_t n = 0; n < 9 * count; n++)
        to[n % 9][n / 9] = (float)u[n / 9][n % 3][n % 9 / 3];
    return soup;
}

void streams_place(const guarded fence[9], size_t count, int shift, fenced place[9], float *to[9])
{
    for (int s = 0; s < 9; s++) {
        const int offset = (int)sizeof(float) * ((shift + s) % STREAM_SHIFTS);
        place[s] = fenced_place(fence[s], count * sizeof(float), shift == AT_END ? AT_END : offset);
        to[s] = (float *)(void *)place[s].at;
    }
}
