/*
 * codes.h - vertices of a mesh compared with a box, each once: in float or in double. After: a vocabulary, CODED_NUMBER, the type
 * of its numbers, CODED_NUMBERS, the bounds of that type, and CODED_READ, the word that reads them.
 *
 * A byte has a bit for each face that the vertex lies beyond, and one that says that it lies in the box. The bits that three
 * vertices share tell of a triangle that it is apart, or inside (PROOFS.md 17).
 */

/* A bit in each byte: of eight vertices; and how often eight are compared before their bits are made bytes, many at once. */
#define EACH_BYTE UINT64_C(0x0101010101010101)
enum { EIGHTS = 16 };

/* Three bits of each of eight vertices, into the low ends of eight bytes. */
TRIBOX_INLINE uint64_t spread_threes(uint64_t bits)
{
    bits = (bits | bits << 20) & UINT64_C(0x00000fff00000fff);
    bits = (bits | bits << 10) & UINT64_C(0x003f003f003f003f);
    return (bits | bits << 5) & (7 * EACH_BYTE);
}

/* Eights of vertices: bit 3 * v + a of each says that vertex v is not beyond that face of axis a; a NaN is beyond both. */
typedef struct coded_eights {
    uint64_t below[EIGHTS], above[EIGHTS];
} coded_eights;

TRIBOX_INLINE void compare(const CODED_NUMBER *from, const tribox_coded_box *box, uint64_t *below, uint64_t *above)
{
    const CODED_NUMBER *const under = box->below.CODED_NUMBERS, *const over = box->above.CODED_NUMBERS;
    uint64_t is_above = 0, is_below = 0;
    for (int k = 0; k < 3 * TRIBOX_CODED; k += V_LANES) {
        const vnum u = CODED_READ(from + k);
        is_above |= m_bits(v_gt(u, CODED_READ(under + k % (3 * V_LANES)))) << k;
        is_below |= m_bits(v_gt(CODED_READ(over + k % (3 * V_LANES)), u)) << k;
    }
    for (int half = 0; half < 2; half++) {
        below[half] = ~(is_above >> 24 * half) & 0xffffff;
        above[half] = ~(is_below >> 24 * half) & 0xffffff;
    }
}

static void code_positions(const void *positions, size_t count, const tribox_coded_box *box, uint8_t *code)
{
    const CODED_NUMBER *from = positions;
    coded_eights bits;
    for (size_t left = count / 8, eights; left; left -= eights, code += 8 * eights) {
        eights = left < EIGHTS ? left : EIGHTS;
        for (size_t e = 0; e < eights; e += 2, from += 3 * TRIBOX_CODED)
            compare(from, box, bits.below + e, bits.above + e);
        for (size_t e = 0; e < eights; e++) {
            const uint64_t beyond = spread_threes(bits.below[e]) | spread_threes(bits.above[e]) << 3;
            const uint64_t inside = (TRIBOX_CODE_INSIDE * EACH_BYTE - beyond) & TRIBOX_CODE_INSIDE * EACH_BYTE;
            tribox_put_bytes(code + 8 * e, beyond | inside); /* inside where beyond is 0 */
        }
    }
}
