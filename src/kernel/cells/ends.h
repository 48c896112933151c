/* ends.h - the least and the greatest of many numbers. After: kernel_voxels.h. Needs: nothing more. */

static void find_ends(const float *number, size_t count, tribox_ends *ends)
{
    float least[V_LANES], most[V_LANES];
    vnum low = v_splat(ends->least), high = v_splat(ends->most);
    for (size_t at = 0; at < count; at += V_LANES) {
        const vnum some = v_load(number + at);
        low = v_min(some, low); /* a NaN is dropped where it comes first */
        high = v_max(some, high);
    }
    v_write(least, low);
    v_write(most, high);
    for (int n = 0; n < V_LANES; n++) {
        ends->least = least[n] < ends->least ? least[n] : ends->least;
        ends->most = most[n] > ends->most ? most[n] : ends->most;
    }
}
