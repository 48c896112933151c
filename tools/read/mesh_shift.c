/* mesh_shift.c - chooses a shift, and subtracts it from floats or doubles. */
#include "mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/numbers.h"

int mesh_shift_read(const char *text, mesh_shift *shift)
{
    shift->is_wanted = true;
    shift->is_auto = !strcmp(text, "auto");
    if (shift->is_auto)
        return EXIT_CODE_OK;
    return numbers_read(text, "--shift", "X,Y,Z or auto", 3, shift->by, NULL) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
}

/* The multiple of 10^exponent next to a number, on the side of 0. */
static double round_to(double number, double exponent)
{
    const double unit = pow(10, fabs(exponent));
    const double rounded = exponent < 0 ? trunc(number * unit) / unit : trunc(number / unit) * unit;
    return rounded != 0 && isfinite(rounded) ? rounded : 0;
}

void mesh_shift_choose(const tribox_box *bounds, double by[3])
{
    double longest = 0;
    if (bounds->lo[0] > bounds->hi[0])
        return;
    for (int a = 0; a < 3; a++)
        longest = fmax(longest, bounds->hi[a] - bounds->lo[a]);
    const double exponent = longest > 0 && isfinite(longest) ? ceil(log10(longest)) : 0;
    for (int a = 0; a < 3; a++)
        by[a] = round_to(bounds->lo[a], exponent);
}

/* Of floats each triangle gets nine doubles. */
static int subtract(const char *path, const double by[3], mesh *m)
{
    const size_t count = m->triangles;
    bool are_floats = true;
    if (!m->is_double) {
        double *const wide = count <= SIZE_MAX / sizeof(double[9]) ? malloc(count * sizeof(double[9])) : NULL;
        if (!wide)
            return message_failure("%s: out of memory for %zu triangles in double", path, count);
        for (size_t t = 0; t < count; t++)
            mesh_triangle(m, t, wide + 9 * t);
        mesh_set_doubles(wide, 3 * count, NULL, count, m);
    }
    double *const positions = m->positions;
    for (size_t i = 0; i < 3 * m->doubles.vertices; i++) {
        positions[i] -= by[i % 3];
        are_floats &= float_fit_of(positions[i]) == FLOAT_FIT_EXACT;
    }
    return are_floats ? mesh_to_floats(path, (const double[3]){0, 0, 0}, m) : EXIT_CODE_OK;
}

int mesh_read_shifted(const mesh_request *r, mesh_shift *shift, mesh *m)
{
    mesh_request own = *r;
    own.is_wide = shift->is_wanted;
    int code = mesh_read_over(&own, m);
    if (code || !shift->is_wanted || (r->over && r->over->is_used))
        return code;
    if (shift->is_auto)
        mesh_shift_choose(&m->seen.bounds, shift->by);
    code = subtract(r->path, shift->by, m);
    if (code)
        mesh_free(m);
    else
        mesh_look_all(NULL, r->threads, m);
    return code;
}
