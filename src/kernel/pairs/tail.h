/*
 * tail.h - pairs that fill no packet: the last ones of a call, and all of a call that has fewer than V_LANES.
 * After: a vocabulary. Needs: v_load_few.
 *
 * The last packet ends with the last pair, so it repeats pairs that the packet before it has. A walk of few reads what there is
 * (WALK_FEW); for others, fewer pairs than V_LANES are spread over a packet before (tribox_partial_packet).
 */

/* Packets that begin at pair `at`; the first lanes repeat pairs that come before those that are asked about. */
typedef struct packet_run {
    size_t at;
    size_t lanes;    /* of all its packets */
    size_t repeated; /* lanes */
    size_t pairs;    /* answered: the lanes that are not repeated, without those past the last pair */
} packet_run;

/* The packets that answer pair `first` and as many as come after it, `most` at the most, of `end` in all. */
TRIBOX_INLINE packet_run run_of_packets(size_t first, size_t end, size_t most)
{
    const size_t left = end - first;
    if (left >= most)
        return (packet_run){first, most, 0, most};
    if (left >= V_LANES)
        return (packet_run){first, left - left % V_LANES, 0, left - left % V_LANES};
    const size_t missing = V_LANES - left, repeated = missing < first ? missing : first;
    return (packet_run){first - repeated, V_LANES, repeated, left};
}

/* Of the bits of a run's lanes, those of its pairs. */
TRIBOX_INLINE uint64_t bits_of_run(uint64_t bits, const packet_run *run)
{
    return bits >> run->repeated & ~UINT64_C(0) >> (64 - run->pairs);
}

/* The same, added to a word that has bits below `at` already, and is new if that is 0. */
TRIBOX_INLINE void put_run(uint64_t *word, size_t at, uint64_t bits, const packet_run *run)
{
    if (run->pairs == 64)
        *word = bits;
    else
        *word = (at ? *word : 0) | bits_of_run(bits, run) << at;
}

static void spread_triangles(const tribox_soup *soup, tribox_partial_packet *partial)
{
    const size_t count = soup->count;
    vnum number[9]; /* all loaded before one is written, so that stores cannot alias the streams */
    for (int k = 0; k < 9; k++)
        number[k] = v_load_few(tribox_soup_axis(soup, k / 3)[k % 3], count);
    partial->soup = tribox_soup_of(&partial->number[0][0], TRIBOX_LANES_MAX, count);
    for (int k = 0; k < 9; k++)
        v_write(partial->number[k], number[k]);
}

static void spread_boxes(const tribox_boxes *boxes, tribox_partial_packet *partial)
{
    const size_t count = boxes->count;
    vnum number[6];
    for (int a = 0; a < 3; a++) {
        number[a] = v_load_few(boxes->lo[a], count);
        number[3 + a] = v_load_few(boxes->hi[a], count);
    }
    for (int a = 0; a < 3; a++) {
        partial->boxes.lo[a] = partial->number[a];
        partial->boxes.hi[a] = partial->number[3 + a];
    }
    partial->boxes.count = count;
    for (int k = 0; k < 6; k++)
        v_write(partial->number[k], number[k]);
}
