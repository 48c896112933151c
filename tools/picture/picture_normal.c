/* picture_normal.c - fits a plane to depths, again and again, each time with less regard for what is far from the last one. */
#include "picture_normal.h"

/* A column more than are looked at, with a weight of 0, makes sums over rows fit vectors. */
enum { REACH = 3, ROWS = 2 * REACH + 1, COLUMNS = ROWS + 1, ROUNDS = 3 };

static const float column[COLUMNS] = {-3, -2, -1, 0, 1, 2, 3, 4};

typedef struct around {
    float depth[ROWS][COLUMNS]; /* less that of the middle */
    float is_there[ROWS][COLUMNS];
} around;

/* depth = x column + y row + middle */
typedef struct plane {
    float x, y, middle;
} plane;

static int clamp(int i, int size) { return i < 0 ? 0 : i < size ? i : size - 1; }

static void look_around(around *a, const picture_view *v, const uint32_t *seen, int x, int y, int step)
{
    const float here = picture_seen_depth(seen[y * v->width + x]);
    for (int j = 0; j < ROWS; j++) {
        const uint32_t *row = seen + clamp(y + step * (j - REACH), v->height) * v->width;
        for (int i = 0; i < COLUMNS; i++) {
            const uint32_t there = i < ROWS ? row[clamp(x + step * (i - REACH), v->width)] : 0;
            a->is_there[j][i] = there ? 1.0f : 0;
            a->depth[j][i] = there ? picture_seen_depth(there) - here : 0;
        }
    }
}

/* Sums over each column; depths at reach from the plane or farther have no weight. */
static void add_columns(const around *restrict a, plane p, float reach, float (*restrict columns)[COLUMNS])
{
    const float scale = 1 / (reach * reach);
    for (int i = 0; i < COLUMNS; i++) {
        float w = 0, y = 0, yy = 0, z = 0, yz = 0;
        for (int j = 0; j < ROWS; j++) {
            const float depth = a->depth[j][i], off = depth - p.x * column[i] - p.y * column[j] - p.middle;
            const float near = 1 - off * off * scale, share = 0.5f * (near + fabsf(near)); /* near, or 0: without a branch */
            const float weight = share * share * a->is_there[j][i];
            w += weight;
            y += weight * column[j];
            yy += weight * column[j] * column[j];
            z += weight * depth;
            yz += weight * depth * column[j];
        }
        columns[0][i] = w;
        columns[1][i] = y;
        columns[2][i] = yy;
        columns[3][i] = z;
        columns[4][i] = yz;
    }
}

/* Least squares. Returns the sum of the weights. */
static float fit(const around *a, plane *p, float reach)
{
    float columns[5][COLUMNS], w = 1e-3f, x = 0, y = 0, z = 0, xx = 1e-3f, xy = 0, yy = 1e-3f, xz = 0, yz = 0;
    add_columns(a, *p, reach, columns);
    for (int i = 0; i < COLUMNS; i++) {
        w += columns[0][i];
        x += columns[0][i] * column[i];
        y += columns[1][i];
        z += columns[3][i];
        xx += columns[0][i] * column[i] * column[i];
        xy += columns[1][i] * column[i];
        yy += columns[2][i];
        xz += columns[3][i] * column[i];
        yz += columns[4][i];
    }
    xx -= x * x / w;
    xy -= x * y / w;
    yy -= y * y / w;
    xz -= x * z / w;
    yz -= y * z / w;
    const float area = xx * yy - xy * xy, by_x = (xz * yy - yz * xy) / area, by_y = (yz * xx - xz * xy) / area;
    *p = (plane){by_x, by_y, (z - by_x * x - by_y * y) / w};
    return w;
}

vec picture_normal(const picture_view *v, const uint32_t *seen, int x, int y, vec face)
{
    const float cell = v->scale;
    const int step = (int)greatest(1.1f * cell + 0.6f, 1);
    around a;
    plane p = {0, 0, 0};
    float sum = 0;
    look_around(&a, v, seen, x, y, step);
    for (int round = 0; round < ROUNDS; round++) {
        const float slope = least(sqrtf(1 + (p.x * p.x + p.y * p.y) / (float)(step * step)), 4);
        sum = fit(&a, &p, (round ? 1.7f : 5.0f) * cell * slope);
    }
    const vec n = vec_unit(vec_sum((float)step, v->axis[2], -1, vec_sum(p.x, v->axis[0], p.y, v->axis[1])));
    const float trust = least(greatest(sum / (ROWS * ROWS) * 6 - 0.5f, 0), 1);
    return vec_unit(vec_sum(trust, n, 1 - trust + 1e-3f, face));
}
