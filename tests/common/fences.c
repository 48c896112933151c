#include "fences.h"

#include "common/harness.h"

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
