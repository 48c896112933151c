#include "order_kinds.h"

#include "common/fences.h"
#include "common/harness.h"

#include <float.h>
#include <math.h>

const char *const order_kind_names[ORDER_KINDS] = {"random", "sorted",    "reversed", "organ pipe", "sawtooth",  "equal",   "few",
                                                   "zeros",  "subnormal", "greatest", "all scales", "half wild", "all wild"};

static float draw_number(random_source *r, order_kind kind, size_t i, size_t count)
{
    const float any = (float)random_double(r, -1, 1);
    switch (kind) {
    case KIND_SORTED:
        return (float)i;
    case KIND_REVERSED:
        return -(float)i;
    case KIND_ORGAN_PIPE:
        return (float)(i < count / 2 ? i : count - i);
    case KIND_SAWTOOTH:
        return (float)(i % 100);
    case KIND_EQUAL:
        return 7;
    case KIND_FEW_VALUES:
        return (float)random_int(r, 3);
    case KIND_ZEROS_OF_BOTH_SIGNS:
        return random_int(r, 9) ? random_sign_of_zero(r, 0) : any;
    case KIND_SUBNORMAL:
        return (float)random_int_between(r, -1000, 1000) * 0x1p-149f;
    case KIND_GREATEST:
        return random_int(r, 2) ? FLT_MAX * any : any < 0 ? -FLT_MAX : FLT_MAX;
    case KIND_ALL_SCALES:
        return ldexpf(any, random_int_between(r, -148, 127));
    default:
        return any;
    }
}

static void spoil(random_source *r, const order_room *room, order_kind kind)
{
    static const float wild[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < room->soup.count; i++)
        if (kind == KIND_ALL_WILD || random_int(r, 2))
            room->stream[random_int(r, 9)][i] = wild[random_int(r, 3)];
}

order_room order_room_make(random_source *r, order_kind kind, size_t count)
{
    order_room room;
    stream_fences_make(count, room.stream_fence);
    room.soup = streams_lay(room.stream_fence, count, AT_END, room.stream);
    for (size_t n = 0; n < 9 * count; n++)
        room.stream[n / count][n % count] = draw_number(r, kind, n % count, count);
    if (kind >= KIND_HALF_WILD)
        spoil(r, &room, kind);
    for (int k = 0; k < 9; k++)
        guarded_read_only(room.stream_fence[k], true);
    room.scratch_fence = guarded_make(16 * count + 1);
    room.scratch = guarded_tail(room.scratch_fence, 16 * count);
    room.order_fence = guarded_make(sizeof(uint32_t) * count + 1);
    room.order = guarded_tail(room.order_fence, sizeof(uint32_t) * count);
    return room;
}

void order_room_free(order_room *room)
{
    for (int k = 0; k < 9; k++)
        guarded_free(room->stream_fence[k]);
    guarded_free(room->scratch_fence);
    guarded_free(room->order_fence);
}

/* What the order goes by. */
typedef struct middle {
    double at[3];
    bool is_wild;
    uint32_t number;
} middle;

static middle middle_of(const tribox_soup *soup, uint32_t i)
{
    middle m = {.number = i};
    for (int a = 0; a < 3; a++) {
        const float *const *const stream = a == 0 ? soup->x : a == 1 ? soup->y : soup->z;
        const float u = stream[0][i], v = stream[1][i], w = stream[2][i];
        m.at[a] = (float)((fmin(fmin(u, v), w) + fmax(fmax(u, v), w)) / 2); /* in double, then rounded once */
        m.is_wild |= !isfinite(u) || !isfinite(v) || !isfinite(w);
    }
    return m;
}

static int sorted_axis;

static int by_number(const void *one, const void *other)
{
    const middle *const a = one, *const b = other;
    return a->is_wild != b->is_wild ? a->is_wild - b->is_wild : a->number < b->number ? -1 : a->number > b->number;
}

static int by_middle(const void *one, const void *other)
{
    const middle *const a = one, *const b = other;
    const double p = a->at[sorted_axis], q = b->at[sorted_axis];
    return a->is_wild || b->is_wild || p == q ? by_number(one, other) : p < q ? -1 : 1;
}

static int longest_axis(const middle *m, size_t count)
{
    double length[3];
    int longest = 0;
    for (int a = 0; a < 3; a++) {
        double lo = INFINITY, hi = -INFINITY;
        for (size_t i = 0; i < count; i++)
            if (!m[i].is_wild) {
                lo = fmin(lo, m[i].at[a]);
                hi = fmax(hi, m[i].at[a]);
            }
        length[a] = hi - lo;
        longest = length[a] > length[longest] ? a : longest;
    }
    return longest;
}

static void cut(middle *m, size_t count)
{
    if (count <= 64) {
        qsort(m, count, sizeof *m, by_number);
        return;
    }
    size_t unit = 64;
    while (unit * 64 < count)
        unit *= 64;
    const size_t before = (count / unit + 1) / 2 * unit;
    sorted_axis = longest_axis(m, count);
    qsort(m, count, sizeof *m, by_middle);
    cut(m, before);
    cut(m + before, count - before);
}

void expect_order(const tribox_soup *soup, uint32_t *order)
{
    middle *const m = malloc((soup->count + 1) * sizeof *m);
    assert_non_null(m);
    for (size_t i = 0; i < soup->count; i++)
        m[i] = middle_of(soup, (uint32_t)i);
    cut(m, soup->count);
    for (size_t i = 0; i < soup->count; i++)
        order[i] = m[i].number;
    free(m);
}

void sort_words(const tribox_soup *soup, uint32_t *order)
{
    for (size_t first = 0; first < soup->count; first += 64) {
        const size_t count = soup->count - first < 64 ? soup->count - first : 64;
        middle word[64];
        for (size_t i = 0; i < count; i++) {
            assert_true(order[first + i] < soup->count);
            word[i] = middle_of(soup, order[first + i]);
            assert_true(i == 0 || word[i].is_wild >= word[i - 1].is_wild);
        }
        qsort(word, count, sizeof *word, by_number);
        for (size_t i = 0; i < count; i++)
            order[first + i] = word[i].number;
    }
}
