/*
 * middles.h - where triangles and boxes lie: the middles of their bounding boxes.
 * After: axes.h. Needs: v_load_up_to.
 */

static const int32_t LANE_NUMBERS[TRIBOX_LANES_MAX] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/* Half way between two numbers, rounded once: only where the sum overflows are they halved first, which is exact there. */
TRIBOX_INLINE vnum half_way(vnum lo, vnum hi)
{
    const vnum half = v_splat(0.5f), sum = v_add(lo, hi);
    const vnum middle = v_select(v_gt(v_abs(sum), v_splat(FLT_MAX)), v_add(v_mul(half, lo), v_mul(half, hi)), v_mul(half, sum));
    return v_add(middle, v_splat(0)); /* one sign of zero */
}

/* The middles of a packet, or of as much of it as is there, `count` lanes; and in which lanes all is finite. */
TRIBOX_INLINE vmask middles_of_triangles(const tribox_soup *soup, size_t at, size_t count, vnum middle[3])
{
    vnum sum = v_splat(0);
    for (int a = 0; a < 3; a++) {
        const float *const *const stream = tribox_soup_axis(soup, a);
        const vnum u = v_load_up_to(stream[0] + at, count), v = v_load_up_to(stream[1] + at, count),
                   w = v_load_up_to(stream[2] + at, count);
        middle[a] = half_way(lane_min3(u, v, w), lane_max3(u, v, w));
        sum = v_add(sum, lane_lost3(u, v, w));
    }
    return v_is_zero(sum);
}

TRIBOX_INLINE vmask middles_of_boxes(const tribox_boxes *boxes, size_t at, size_t count, vnum middle[3])
{
    vnum sum = v_splat(0);
    for (int a = 0; a < 3; a++) {
        const vnum lo = v_load_up_to(boxes->lo[a] + at, count), hi = v_load_up_to(boxes->hi[a] + at, count);
        middle[a] = half_way(lo, hi);
        sum = v_add(sum, v_add(v_sub(lo, lo), v_sub(hi, hi)));
    }
    return v_is_zero(sum);
}

/* Those of a whole packet, numbered from `number` on. */
TRIBOX_INLINE void write_places(const tribox_sort_keys *keys, size_t at, vmask is_finite, const vnum middle[3], size_t number)
{
    for (int a = 0; a < 3; a++)
        v_write(keys->middle[a] + at, v_select(is_finite, middle[a], v_splat(INFINITY)));
    i_write((int32_t *)keys->number + at, i_add(i_splat((int32_t)(uint32_t)number), i_load(LANE_NUMBERS)));
}

TRIBOX_INLINE vmask middles_at(const tribox_soup *soup, const tribox_boxes *boxes, size_t at, size_t count, vnum middle[3])
{
    return soup ? middles_of_triangles(soup, at, count, middle) : middles_of_boxes(boxes, at, count, middle);
}

static void find_middles(const tribox_soup *soup, const tribox_boxes *boxes, size_t first, size_t count, size_t number,
                         const tribox_sort_keys *keys)
{
    float few_middles[3][V_LANES];
    uint32_t few_numbers[V_LANES];
    const tribox_sort_keys partial = {{few_middles[0], few_middles[1], few_middles[2]}, few_numbers};
    const size_t last = count - count % V_LANES;
    vnum middle[3];
    for (size_t i = 0; i < last; i += V_LANES) {
        const vmask is_finite = middles_at(soup, boxes, first + i, V_LANES, middle);
        write_places(keys, i, is_finite, middle, number + i);
    }
    if (last == count)
        return;
    const vmask is_finite = middles_at(soup, boxes, first + last, count - last, middle);
    write_places(&partial, 0, is_finite, middle, number + last);
    for (int a = 0; a < 3; a++)
        memcpy(keys->middle[a] + last, partial.middle[a], (count - last) * sizeof(float));
    memcpy(keys->number + last, partial.number, (count - last) * sizeof(uint32_t));
}
