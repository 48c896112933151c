/*
 * rank.h - which of many keys has a given rank, in time that grows with their number whatever they are.
 * After: a vocabulary. Needs: v_pack, i_pack.
 *
 * A key is a middle and a number, compared in this order; no two are the same. A large range of them is narrowed, by limits from a
 * sample, until it fits a list. The first sample is drawn in the same way each time, and from everywhere, so that sorted, repeated
 * and periodic keys are not special; the next ones are kept of the keys that are counted between the limits, however few of all
 * keys these are. Should a range not narrow all the same, bits are counted.
 */

enum { LISTED = 2048, FEW_KEYS = 16, ROUNDS_MOST = 8, SPLITS_MOST = 40 };

typedef struct place_key {
    float middle;
    uint32_t number;
} place_key;

typedef struct key_list {
    float middle[LISTED + V_LANES];
    uint32_t number[LISTED + V_LANES];
    size_t count;
} key_list;

/* Keys from `least` to `most`, both included. */
typedef struct key_range {
    place_key least, most;
} key_range;

/* The same order among integers. A zero has one sign. */
TRIBOX_INLINE uint64_t image_of_key(place_key key)
{
    uint32_t bits;
    memcpy(&bits, &key.middle, sizeof bits);
    return (uint64_t)(bits >> 31 ? ~bits : bits | UINT32_C(0x80000000)) << 32 | key.number;
}

TRIBOX_INLINE place_key key_of_image(uint64_t image)
{
    const uint32_t high = (uint32_t)(image >> 32), bits = high >> 31 ? high & UINT32_C(0x7fffffff) : ~high;
    place_key key = {.number = (uint32_t)image};
    memcpy(&key.middle, &bits, sizeof bits);
    return key;
}

/* Lanes in which a < b as numbers without sign: in which a - b borrows. */
TRIBOX_INLINE vmask is_number_less(vint a, vint b)
{
    const vint borrows = i_or(i_andnot(b, a), i_andnot(i_sub(a, b), i_andnot(a, b)));
    return m_has_bits(i_shr(borrows, i_splat(31)));
}

/* Which keys of a packet come before `key`. Equal middles are rare, but where there are many. */
TRIBOX_INLINE vmask is_before(const float *middle, const uint32_t *number, place_key key)
{
    const vnum m = v_load(middle), limit = v_splat(key.middle);
    const vmask less = v_gt(limit, m), same = m_not(m_or(less, v_gt(m, limit)));
    if (!m_bits(same))
        return less;
    return m_or(less, m_and(same, is_number_less(i_load((const int32_t *)number), i_splat((int32_t)key.number))));
}

TRIBOX_INLINE vmask is_after(const float *middle, const uint32_t *number, place_key key)
{
    const vnum m = v_load(middle), limit = v_splat(key.middle);
    const vmask greater = v_gt(m, limit), same = m_not(m_or(greater, v_gt(limit, m)));
    if (!m_bits(same))
        return greater;
    return m_or(greater, m_and(same, is_number_less(i_splat((int32_t)key.number), i_load((const int32_t *)number))));
}

/* The next of a fixed sequence, below `count`. */
TRIBOX_INLINE size_t draw_below(uint64_t *state, size_t count)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (size_t)((*state >> 32) * count >> 32);
}

TRIBOX_INLINE uint64_t median_of(uint64_t a, uint64_t b, uint64_t c)
{
    const uint64_t lesser = a < b ? a : b, greater = a < b ? b : a;
    return c < lesser ? lesser : c < greater ? c : greater;
}

TRIBOX_INLINE uint64_t image_at(const key_list *list, size_t i)
{
    return image_of_key((place_key){list->middle[i], list->number[i]});
}

/* The median of three draws, or of three medians of three where that pays. */
TRIBOX_INLINE uint64_t draw_median(const key_list *list, uint64_t *state)
{
    uint64_t drawn[9];
    const int draws = list->count < 256 ? 3 : 9;
    for (int k = 0; k < draws; k++)
        drawn[k] = image_at(list, draw_below(state, list->count));
    for (int k = 0; draws == 9 && k < 3; k++)
        drawn[k] = median_of(drawn[k], drawn[3 + k], drawn[6 + k]);
    return median_of(drawn[0], drawn[1], drawn[2]);
}

/* Leaves in `list` those before a key and writes the others to `others`. What is past the end of either means nothing. */
static void split_list(key_list *list, place_key key, key_list *others)
{
    size_t before = 0, after = 0;
    v_write(list->middle + list->count, v_splat(INFINITY)); /* lanes past the last are not before the key */
    i_write((int32_t *)list->number + list->count, i_splat(-1));
    for (size_t at = 0; at < list->count; at += V_LANES) {
        const vnum middle = v_load(list->middle + at);
        const vint number = i_load((const int32_t *)list->number + at);
        const vmask is_less = is_before(list->middle + at, list->number + at, key), is_other = m_not(is_less);
        const size_t less = tribox_count_bits(m_bits(is_less));
        v_pack(list->middle + before, is_less, middle);
        i_pack((int32_t *)list->number + before, is_less, number);
        v_pack(others->middle + after, is_other, middle);
        i_pack((int32_t *)others->number + after, is_other, number);
        before += less;
        after += V_LANES - less;
    }
    others->count = list->count - before;
    list->count = before;
}

/* The image of that rank among few keys: the greatest of which no more are less. */
static uint64_t rank_few(const key_list *list, size_t rank)
{
    uint64_t image[FEW_KEYS], found = 0;
    for (size_t i = 0; i < FEW_KEYS; i++)
        image[i] = i < list->count ? image_at(list, i) : UINT64_MAX;
    for (size_t i = 0; i < FEW_KEYS; i++) {
        size_t less = 0;
        for (size_t k = 0; k < FEW_KEYS; k++)
            less += image[k] < image[i];
        found = less <= rank && image[i] > found ? image[i] : found;
    }
    return found;
}

/* The key of that rank by counting bits: for keys chosen so that all draws mislead. */
static place_key rank_by_bits(const float *middle, const uint32_t *number, size_t count, size_t rank)
{
    uint64_t found = 0;
    for (int shift = 56; shift >= 0; shift -= 8) {
        size_t have[256] = {0}, byte = 0;
        for (size_t i = 0; i < count; i++) {
            const uint64_t image = image_of_key((place_key){middle[i], number[i]});
            have[image >> shift & 255] += shift == 56 || (image ^ found) >> (shift + 8) == 0;
        }
        for (; rank >= have[byte]; byte++)
            rank -= have[byte];
        found |= (uint64_t)byte << shift;
    }
    return key_of_image(found);
}

/* The key of that rank in a list, which is spoilt. */
static place_key rank_list(key_list *list, size_t rank)
{
    key_list spare, *one = list, *other = &spare;
    uint64_t state = 1;
    for (int round = 0; one->count > FEW_KEYS; round++) {
        if (round == SPLITS_MOST)
            return rank_by_bits(one->middle, one->number, one->count, rank);
        split_list(one, key_of_image(draw_median(one, &state)), other);
        if (rank >= one->count) {
            key_list *const less = one;
            rank -= less->count;
            one = other;
            other = less;
        }
    }
    return key_of_image(rank_few(one, rank));
}

static void copy_list(key_list *list, const float *middle, const uint32_t *number, size_t count)
{
    memcpy(list->middle, middle, count * sizeof *middle);
    memcpy(list->number, number, count * sizeof *number);
    list->count = count;
}

/* How many keys come before a range, and how many are in it. */
typedef struct key_counts {
    size_t before, inside;
} key_counts;

/* Counts the keys of a range, and lists them as far as they fit: all, or a packet's now and then, about one key of `every`. */
static key_counts list_keys(const float *middle, const uint32_t *number, size_t count, const key_range *range, size_t every,
                            key_list *list)
{
    key_counts keys = {0, 0};
    size_t at = 0, listed = 0, next = 0;
    for (; at + V_LANES <= count; at += V_LANES) {
        const vmask is_less = is_before(middle + at, number + at, range->least);
        const vmask is_inside = m_not(m_or(is_less, is_after(middle + at, number + at, range->most)));
        const size_t found = tribox_count_bits(m_bits(is_inside));
        if (keys.inside >= next && listed <= LISTED) {
            v_pack(list->middle + listed, is_inside, v_load(middle + at));
            i_pack((int32_t *)list->number + listed, is_inside, i_load((const int32_t *)number + at));
            listed += found;
            next += found * every;
        }
        keys.before += tribox_count_bits(m_bits(is_less));
        keys.inside += found;
    }
    for (; at < count; at++) {
        const uint64_t image = image_of_key((place_key){middle[at], number[at]});
        const bool is_less = image<image_of_key(range->least), is_greater = image> image_of_key(range->most);
        if (!is_less && !is_greater && listed < LISTED) {
            list->middle[listed] = middle[at];
            list->number[listed++] = number[at];
        }
        keys.before += is_less;
        keys.inside += !is_less && !is_greater;
    }
    list->count = listed < LISTED ? listed : LISTED;
    return keys;
}

/* Lists draws that are keys of the range, which has `inside`: more of them the more there are. */
static void draw_sample(const float *middle, const uint32_t *number, size_t count, const key_range *range, size_t inside,
                        uint64_t *state, key_list *list)
{
    const size_t room = inside / 32 < 256 ? 256 : inside / 32 < LISTED ? inside / 32 : LISTED;
    const uint64_t least = image_of_key(range->least), most = image_of_key(range->most);
    size_t listed = 0;
    for (size_t draws = 16 * room; draws > 0 && listed < room; draws--) {
        const size_t i = draw_below(state, count);
        const uint64_t image = image_of_key((place_key){middle[i], number[i]});
        list->middle[listed] = middle[i];
        list->number[listed] = number[i];
        listed += least <= image && image <= most;
    }
    list->count = listed;
}

/* The least number whose square is not below another: how far the place of a key in a sample may be off. */
static size_t slack_of_sample(size_t count)
{
    size_t slack = 1;
    while (slack * slack < count)
        slack++;
    return slack;
}

/* Limits between which the key of rank `rank` among `inside` keys of the range most likely lies. The sample is spoilt. */
static key_range narrowed(const key_range *range, key_list *sample, size_t rank, size_t inside)
{
    const size_t at = (size_t)((double)rank / (double)inside * (double)sample->count), slack = slack_of_sample(sample->count);
    key_list copy;
    key_range limits = *range;
    copy_list(&copy, sample->middle, sample->number, sample->count);
    if (at > slack)
        limits.least = rank_list(&copy, at - slack);
    if (at + slack < sample->count)
        limits.most = rank_list(sample, at + slack);
    return limits;
}

/* One of how many keys between such limits to list: of all of them where they most likely fit, else of three quarters of a list. */
static size_t spacing_between_limits(size_t inside, size_t sample)
{
    const size_t expected = sample ? inside / sample * (2 * slack_of_sample(sample) + 1) : inside, room = LISTED / 4 * 3;
    return expected <= room ? 1 : expected / room + 1;
}

/* The key that has `rank` keys before it, of more than a list holds. False if the rounds are too few. */
static bool find_by_samples(const float *middle, const uint32_t *number, size_t count, size_t rank, key_list *list, place_key *key)
{
    enum { SAMPLE_LEAST = 64 };
    key_range range = {{-INFINITY, 0}, {INFINITY, UINT32_MAX}};
    size_t before = 0, inside = count;
    uint64_t state = 1;
    list->count = 0;
    for (int round = 0; round < ROUNDS_MOST; round++) {
        key_range limits = range;
        size_t every = 1;
        if (inside > LISTED) {
            if (list->count < SAMPLE_LEAST)
                draw_sample(middle, number, count, &range, inside, &state, list);
            every = spacing_between_limits(inside, list->count);
            limits = narrowed(&range, list, rank - before, inside);
        }
        const key_counts keys = list_keys(middle, number, count, &limits, every, list);
        if (keys.before <= rank && rank < keys.before + keys.inside) {
            if (keys.inside == list->count) {
                *key = rank_list(list, rank - keys.before);
                return true;
            }
            range = limits;
            before = keys.before;
            inside = keys.inside;
            continue;
        }
        if (rank < keys.before) {
            range.most = limits.least;
            inside = keys.before - before + 1;
        } else {
            range.least = limits.most;
            inside += before + 1 - keys.before - keys.inside;
            before = keys.before + keys.inside - 1;
        }
        list->count = 0; /* keys of another range */
    }
    return false;
}

/* The key that has `rank` keys before it. */
static place_key key_of_rank(const float *middle, const uint32_t *number, size_t count, size_t rank)
{
    place_key key;
    key_list list;
    if (count > LISTED)
        return find_by_samples(middle, number, count, rank, &list, &key) ? key : rank_by_bits(middle, number, count, rank);
    copy_list(&list, middle, number, count);
    return rank_list(&list, rank);
}
