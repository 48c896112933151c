#include "stored_soup.h"

#include "common/harness.h"

#include "common/guarded_pages.h"

enum { POISONED = 0xa5 };

stored_soup stored_soup_make(size_t room)
{
    stored_soup s;
    memset(&s, 0, sizeof s);
    for (int k = 0; k < STORED_STREAMS; k++)
        s.stream_fence[k] = guarded_make((room + STORED_SHIFTS) * sizeof(float));
    s.ids_fence = guarded_make((room + STORED_SHIFTS) * sizeof(uint32_t));
    s.nodes_fence = guarded_make(tribox_index_bytes(room) + STORED_SHIFTS);
    return s;
}

static void *placed(guarded fence, size_t bytes, int shift, size_t unit)
{
    return shift == STORED_AT_END ? guarded_tail(fence, bytes) : fence.first + (size_t)shift * unit;
}

void stored_soup_lay(stored_soup *s, size_t count, int shift)
{
    for (int k = 0; k < STORED_STREAMS; k++) {
        s->stream[k] = placed(s->stream_fence[k], count * sizeof(float), shift, sizeof(float));
        (k < 3 ? s->soup.x : k < 6 ? s->soup.y : s->soup.z)[k % 3] = s->stream[k];
    }
    s->ids = placed(s->ids_fence, count * sizeof(uint32_t), shift, sizeof(uint32_t));
    for (size_t i = 0; i < count; i++)
        s->ids[i] = (uint32_t)i * 2654435761u ^ 0x9e3779b9u;
    s->soup.count = count;
    s->nodes = placed(s->nodes_fence, tribox_index_bytes(count), shift, 1);
    s->index = s->with_ids = (tribox_index){.nodes = s->nodes, .soup = &s->soup};
    s->with_ids.ids = s->ids;
}

void stored_soup_build(stored_soup *s, const char *kernel)
{
    memset(s->nodes, POISONED, stored_index_bytes(s));
    assert_int_equal(tribox_index_build(&s->index, &(tribox_options){.kernel = kernel}, s->nodes), TRIBOX_OK);
}

void stored_soup_hide(const stored_soup *s, bool is_hidden)
{
    for (int k = 0; k < STORED_STREAMS; k++) {
        const guarded fence = s->stream_fence[k];
        assert_true(!fence.size || pages_allow(fence.first, fence.size, is_hidden ? PAGES_HIDDEN : PAGES_OPEN));
    }
}
