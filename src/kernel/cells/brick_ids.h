/*
 * brick_ids.h - the ids of a brick, out of those of a window, with all bits set for each cell that is clear.
 * After: bricks.h. Needs: the words of integers.
 *
 * Rows of eight cells, with as many lanes as there are: the next row comes over those that are too many.
 */
static void take_ids(const tribox_brick_rows *rows, const uint64_t bits[BRICK], uint32_t *to)
{
    static const int32_t bit[TRIBOX_LANES_MAX] = {1,      1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                                                  1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
    const vint bit_of_lane = i_load(bit), none = i_splat(-1);
    for (size_t k = 0; k < BRICK; k++) {
        if (!bits[k]) {
            memset(to, 0xff, BRICK * BRICK * sizeof *to);
            to += BRICK * BRICK;
            continue;
        }
        for (size_t j = 0; j < BRICK; j++, to += BRICK) {
            const uint32_t in_row = (uint32_t)(bits[k] >> BRICK * j) & 0xff;
            const int32_t *const from = in_row ? (const int32_t *)rows->ids + k * rows->layer + j * rows->row : bit;
            for (unsigned i = 0; i < BRICK; i += V_LANES) {
                const vmask is_set = m_has_bits(i_and(bit_of_lane, i_splat((int32_t)(in_row >> i))));
                i_write((int32_t *)to + i, i_or(i_load(from + i), i_keep(m_not(is_set), none)));
            }
        }
    }
}
