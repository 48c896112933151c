/*
 * cut.h - places cut in two across their longest side.
 * After: rank.h.
 */

/* Places that are split at once: the first of them wait in a buffer. */
enum { SPLIT = 1024 };

typedef struct split_buffer {
    float middle[3][SPLIT + V_LANES];
    uint32_t number[SPLIT + V_LANES];
} split_buffer;

/* From the least of all lanes to the greatest. */
static double length_along(vnum lo, vnum hi)
{
    float least[V_LANES], most[V_LANES];
    v_write(least, lo);
    v_write(most, hi);
    for (int i = 1; i < V_LANES; i++) {
        least[0] = least[i] < least[0] ? least[i] : least[0];
        most[0] = most[i] > most[0] ? most[i] : most[0];
    }
    return (double)most[0] - (double)least[0];
}

/* The axis on which finite middles lie farthest apart, the first of several. At least V_LANES of them. */
static int longest_axis(const tribox_sort_keys *keys, size_t count)
{
    vnum lo[3], hi[3];
    int longest = 0;
    double length[3];
    for (int a = 0; a < 3; a++) {
        lo[a] = v_splat(INFINITY);
        hi[a] = v_splat(-INFINITY);
    }
    for (size_t start = 0; start < count; start += V_LANES) {
        const size_t at = start + V_LANES <= count ? start : count - V_LANES;
        for (int a = 0; a < 3; a++) {
            const vnum middle = v_load(keys->middle[a] + at);
            lo[a] = v_min(middle, lo[a]);
            hi[a] = v_max(v_drop(v_gt(middle, v_splat(FLT_MAX)), middle), hi[a]);
        }
    }
    for (int a = 0; a < 3; a++) {
        length[a] = length_along(lo[a], hi[a]);
        longest = length[a] > length[longest] ? a : longest;
    }
    return longest;
}

static void copy_place(const tribox_sort_keys *from, size_t i, const tribox_sort_keys *to, size_t k)
{
    for (int a = 0; a < 3; a++)
        to->middle[a][k] = from->middle[a][i];
    to->number[k] = from->number[i];
}

static void copy_places(const tribox_sort_keys *from, size_t first, size_t count, const tribox_sort_keys *to, size_t to_first)
{
    for (int a = 0; a < 3; a++)
        memcpy(to->middle[a] + to_first, from->middle[a] + first, count * sizeof(float));
    memcpy(to->number + to_first, from->number + first, count * sizeof(uint32_t));
}

/* Those of places first .. end - 1 that come before the key go aside, the others move up. Returns how many went. */
TRIBOX_INLINE size_t set_aside(const tribox_sort_keys *keys, size_t first, size_t end, int axis, place_key key,
                               const tribox_sort_keys *aside)
{
    size_t at = first, less = 0, others = first;
    for (; at + V_LANES <= end; at += V_LANES) {
        const vmask is_less = is_before(keys->middle[axis] + at, keys->number + at, key), is_other = m_not(is_less);
        const vnum x = v_load(keys->middle[0] + at), y = v_load(keys->middle[1] + at), z = v_load(keys->middle[2] + at);
        const vint number = i_load((const int32_t *)keys->number + at);
        const size_t found = tribox_count_bits(m_bits(is_less));
        v_pack(aside->middle[0] + less, is_less, x);
        v_pack(aside->middle[1] + less, is_less, y);
        v_pack(aside->middle[2] + less, is_less, z);
        i_pack((int32_t *)aside->number + less, is_less, number);
        v_pack(keys->middle[0] + others, is_other, x);
        v_pack(keys->middle[1] + others, is_other, y);
        v_pack(keys->middle[2] + others, is_other, z);
        i_pack((int32_t *)keys->number + others, is_other, number);
        less += found;
        others += V_LANES - found;
    }
    const uint64_t image = image_of_key(key);
    for (; at < end; at++) {
        const bool is_less = image_of_key((place_key){keys->middle[axis][at], keys->number[at]}) < image;
        copy_place(keys, at, is_less ? aside : keys, is_less ? less : others);
        less += is_less;
        others += !is_less;
    }
    return less;
}

/*
 * The places that come before the key before the others. Block by block, so the same on every processor: others of earlier blocks
 * make room for what was set aside of this one.
 */
static void split_places(const tribox_sort_keys *keys, size_t count, int axis, place_key key)
{
    split_buffer buffer;
    const tribox_sort_keys aside = {{buffer.middle[0], buffer.middle[1], buffer.middle[2]}, buffer.number};
    size_t before = 0;
    for (size_t first = 0; first < count; first += SPLIT) {
        const size_t end = count - first < SPLIT ? count : first + SPLIT;
        const size_t less = set_aside(keys, first, end, axis, key, &aside);
        const size_t others = end - less - before, moved = others < less ? others : less;
        copy_places(keys, before, moved, keys, end - moved);
        copy_places(&aside, 0, less, keys, before);
        before += less;
    }
}

static void cut(const tribox_sort_keys *keys, size_t count, size_t before)
{
    const int axis = longest_axis(keys, count);
    split_places(keys, count, axis, key_of_rank(keys->middle[axis], keys->number, count, before));
}
