/*
 * nine.h - nine numbers a triangle into nine registers, V_LANES triangles at a time, from registers read as they lie in memory.
 * After: axes.h. Needs: v_permute, v_local.
 *
 * V_LANES and nine have no common factor, so at each place the nine registers hold nine different numbers of a triangle. Numbers
 * follow each other within a register: number k at place p is in the one that begins with number k - p, modulo nine. Ordered by
 * what they begin with, the registers move up by p at place p, which takes a blend for each bit of p. Each then holds one number of
 * all the triangles, that of triangle i at place 9 i + k modulo V_LANES; the last blend and this order are one permutation of two
 * registers.
 */

/* A place in two registers: the second one, where the last bit of the place is set. */
#define NINE_PLACE(p) ((p) % V_LANES + ((p) % V_LANES < V_LANES / 2 ? 0 : V_LANES))
#define NINE_PLACES(k) \
    { \
        NINE_PLACE(k), NINE_PLACE(9 + k), NINE_PLACE(18 + k), NINE_PLACE(27 + k), NINE_PLACE(36 + k), NINE_PLACE(45 + k), \
            NINE_PLACE(54 + k), NINE_PLACE(63 + k), NINE_PLACE(72 + k), NINE_PLACE(81 + k), NINE_PLACE(90 + k), \
            NINE_PLACE(99 + k), NINE_PLACE(108 + k), NINE_PLACE(117 + k), NINE_PLACE(126 + k), NINE_PLACE(135 + k) \
    }
static const int32_t nine_places[9][TRIBOX_LANES_MAX] = {NINE_PLACES(0), NINE_PLACES(1), NINE_PLACES(2),
                                                         NINE_PLACES(3), NINE_PLACES(4), NINE_PLACES(5),
                                                         NINE_PLACES(6), NINE_PLACES(7), NINE_PLACES(8)};
#undef NINE_PLACES
#undef NINE_PLACE

/* Negative at the places that have bit 0, 1, 2. */
static const float nine_bits[3][TRIBOX_LANES_MAX] = {{1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1},
                                                     {1, 1, -1, -1, 1, 1, -1, -1, 1, 1, -1, -1, 1, 1, -1, -1},
                                                     {1, 1, 1, 1, -1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1, -1}};

/* What is read: floats as they are, or doubles less near[k], of axis k % 3, rounded (kernel.h). */
typedef struct lane_numbers {
    bool are_doubles; /* a constant of an instance */
    const double *origin;
} lane_numbers;

TRIBOX_INLINE int bytes_of(lane_numbers numbers) { return numbers.are_doubles ? (int)sizeof(double) : (int)sizeof(float); }

/* Numbers k to k + V_LANES - 1, which lie at `from`; number 0 is on axis 0. */
TRIBOX_INLINE vnum load_numbers(const char *from, int k, lane_numbers numbers)
{
    return numbers.are_doubles ? v_local(from, numbers.origin + k % 3) : v_load((const float *)(const void *)from);
}

/* The V_LANES triangles at `from`. */
TRIBOX_INLINE void load_nine(lane_triangle *t, const char *from, lane_numbers numbers)
{
    vnum begins_with[9];
    for (int r = 0; r < 9; r++)
        begins_with[V_LANES * r % 9] = load_numbers(from + V_LANES * r * bytes_of(numbers), V_LANES * r, numbers);
    for (int b = 0; 2 << b < V_LANES; b++) {
        const vmask is_moved = m_signs(v_load(nine_bits[b]));
        vnum moved[9];
        for (int k = 0; k < 9; k++)
            moved[k] = v_select(is_moved, begins_with[(k + 9 - (1 << b)) % 9], begins_with[k]);
        for (int k = 0; k < 9; k++)
            begins_with[k] = moved[k];
    }
    for (int k = 0; k < 9; k++) {
        const vnum moved = begins_with[(k + 9 - V_LANES / 2) % 9];
        t->u[k / 3][k % 3] = v_permute(begins_with[k], moved, nine_places[k]);
    }
}
