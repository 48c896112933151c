/*
 * cell_numbers.h - the set cells of a window of bits, as three numbers each. After: kernel.h. Needs: the words of integers.
 *
 * Long runs of cells, V_LANES at a time, are three registers. What these write past the end of a run is written over by what
 * follows: so the cells of the last rows are written one by one. So are those of words without such runs, where nothing is faster.
 */

/* The cells from `first` on of row (j, k), so many, and then up to V_LANES - 1 more. */
TRIBOX_INLINE void number_run(uint32_t (*to)[3], const uint32_t j_and_k[2], uint32_t first, unsigned length)
{
    static const int32_t along[3 * TRIBOX_LANES_MAX] = {
        0, 0, 0, 1, 0, 0, 2,  0, 0, 3,  0, 0, 4,  0, 0, 5,  0, 0, 6,  0, 0, 7,  0, 0,
        8, 0, 0, 9, 0, 0, 10, 0, 0, 11, 0, 0, 12, 0, 0, 13, 0, 0, 14, 0, 0, 15, 0, 0,
    };
    static const int32_t third[3 * TRIBOX_LANES_MAX + 2] = {
        -1, 0, 0,  -1, 0, 0,  -1, 0, 0,  -1, 0, 0,  -1, 0, 0,  -1, 0, 0,  -1, 0, 0,  -1, 0, 0,  -1,
        0,  0, -1, 0,  0, -1, 0,  0, -1, 0,  0, -1, 0,  0, -1, 0,  0, -1, 0,  0, -1, 0,  0, -1, 0,
    };
    vint number[3], step[3];
    for (int n = 0; n < 3; n++) {
        const vint is_x = i_load(third + n * V_LANES), is_y = i_load(third + n * V_LANES + 2),
                   is_z = i_load(third + n * V_LANES + 1);
        const vint x = i_add(i_load(along + n * V_LANES), i_and(is_x, i_splat((int32_t)first)));
        const vint y = i_and(is_y, i_splat((int32_t)j_and_k[0])), z = i_and(is_z, i_splat((int32_t)j_and_k[1]));
        number[n] = i_or(x, i_or(y, z));
        step[n] = i_and(is_x, i_splat(V_LANES));
    }
    for (unsigned at = 0; at < length; at += V_LANES)
        for (int n = 0; n < 3; n++) {
            i_write((int32_t *)to[at] + n * V_LANES, number[n]);
            number[n] = i_add(number[n], step[n]);
        }
}

TRIBOX_NOINLINE size_t number_runs(uint32_t (*to)[3], const uint32_t j_and_k[2], uint32_t first, uint64_t bits)
{
    size_t count = 0;
    while (bits) {
        const unsigned from = tribox_lowest_bit(bits);
        const uint64_t clear = ~(bits >> from); /* 0 of all 64 */
        const unsigned length = clear ? tribox_lowest_bit(clear) : 64;
        number_run(to + count, j_and_k, first + from, length);
        count += length;
        bits &= bits + (UINT64_C(1) << from);
    }
    return count;
}

/* Whether runs are long, on the whole. */
TRIBOX_INLINE bool has_long_runs(uint64_t bits)
{
    const unsigned count = tribox_count_bits(bits);
    return count >= 16 && count >= 4 * tribox_count_bits(bits & ~(bits << 1));
}

/* The cells of a word, the first of which is `first`. Returns how many. */
TRIBOX_INLINE size_t number_word(uint32_t (*to)[3], const uint32_t j_and_k[2], uint32_t first, uint64_t bits, bool is_last)
{
    size_t count = 0;
    if (!is_last && has_long_runs(bits))
        return number_runs(to, j_and_k, first, bits);
    for (; bits; bits &= bits - 1, count++) {
        to[count][0] = first + tribox_lowest_bit(bits);
        to[count][1] = j_and_k[0];
        to[count][2] = j_and_k[1];
    }
    return count;
}

/* Rows of bits. */
typedef struct bit_rows {
    const uint64_t *bits;
    size_t rows, words;
    uint32_t of_layer;
    uint64_t in_last; /* the bits of the last word of a row that are cells */
} bit_rows;

TRIBOX_INLINE size_t count_row(const bit_rows *r, size_t row)
{
    const uint64_t *const bits = r->bits + row * r->words;
    size_t count = tribox_count_bits(bits[r->words - 1] & r->in_last);
    for (size_t w = 0; w + 1 < r->words; w++)
        count += tribox_count_bits(bits[w]);
    return count;
}

/* Rows `from` to before `end`. */
TRIBOX_INLINE size_t number_rows(uint32_t (*to)[3], const bit_rows *r, size_t from, size_t end, bool is_last)
{
    const size_t last = r->words - 1;
    const uint64_t *bits = r->bits + from * r->words;
    size_t count = 0;
    uint32_t j_and_k[2] = {(uint32_t)(from % r->of_layer), (uint32_t)(from / r->of_layer)};
    for (size_t row = from; row < end; row++, bits++) {
        for (size_t w = 0; w < last; w++, bits++)
            if (*bits)
                count += number_word(to + count, j_and_k, (uint32_t)(64 * w), *bits, is_last);
        if (*bits & r->in_last)
            count += number_word(to + count, j_and_k, (uint32_t)(64 * last), *bits & r->in_last, is_last);
        if (++j_and_k[0] == r->of_layer) {
            j_and_k[0] = 0;
            j_and_k[1]++;
        }
    }
    return count;
}

static size_t number_cells(const uint64_t *occupied, const uint32_t size[3], uint32_t (*cells)[3])
{
    const bit_rows r = {.bits = occupied,
                        .rows = (size_t)size[1] * size[2],
                        .words = tribox_words_of(size[0]),
                        .of_layer = size[1],
                        .in_last = ~UINT64_C(0) >> (64 - size[0] % 64) % 64};
    size_t found = 0, rows = r.words ? r.rows : 0, before_last = rows;
    for (size_t row = 0; !cells && row < rows; row++)
        found += count_row(&r, row);
    if (!cells || !rows)
        return found;
    for (size_t left = 0; before_last && left < V_LANES; left += count_row(&r, before_last))
        before_last--;
    found = number_rows(cells, &r, 0, before_last, false);
    return found + number_rows(cells + found, &r, before_last, rows, true);
}
