/*
 * separating.h - the textbook separating-axis test: project both bodies on an axis, compare the two intervals.
 *
 * This text is included after a type of integers: `num`, an array of one element, and NUM(name), the operations of GMP by their
 * names there.
 */

enum { VERTICES = 3, BODIES = 2 };

static struct {
    num vertex[VERTICES][3];
    num bound[2][3]; /* of the box: lo, hi */
    num unit[3][3];
    num edge[3][3];
    num axis[3];
    num least[BODIES], most[BODIES]; /* of the triangle, of the box */
    num scratch[2];
} w;

static void prepare(void)
{
    static bool is_ready;
    if (is_ready)
        return;
    is_ready = true;
    for (int a = 0; a < 3; a++) {
        for (int side = 0; side < 2; side++)
            NUM(init)(w.bound[side][a]);
        for (int k = 0; k < 3; k++) {
            NUM(init)(w.vertex[k][a]);
            NUM(init)(w.edge[k][a]);
            NUM(init)(w.unit[k][a]);
            NUM(set_si)(w.unit[k][a], k == a);
        }
        NUM(init)(w.axis[a]);
    }
    for (int k = 0; k < 2; k++) {
        NUM(init)(w.least[k]);
        NUM(init)(w.most[k]);
        NUM(init)(w.scratch[k]);
    }
}

static void load_number(num to, const oracle_integers *in, int k)
{
    NUM(set_d)(to, (double)in->odd[k]);
    NUM(mul_2exp)(to, to, in->shift[k]);
}

static void load_points(const oracle_integers *in)
{
    for (int a = 0; a < 3; a++) {
        for (int j = 0; j < VERTICES; j++)
            load_number(w.vertex[j][a], in, 3 * j + a);
        for (int side = 0; side < 2; side++)
            load_number(w.bound[side][a], in, 9 + 3 * side + a);
        for (int j = 0; j < 3; j++)
            NUM(sub)(w.edge[j][a], w.vertex[(j + 1) % 3][a], w.vertex[j][a]);
    }
}

static void axis_is_cross(num p[3], num q[3])
{
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        NUM(mul)(w.axis[i], p[a], q[b]);
        NUM(submul)(w.axis[i], p[b], q[a]);
    }
}

/* The interval that the vertices span on the axis. */
static void project_vertices(num least, num most)
{
    for (int j = 0; j < VERTICES; j++) {
        NUM(mul)(w.scratch[0], w.axis[0], w.vertex[j][0]);
        NUM(addmul)(w.scratch[0], w.axis[1], w.vertex[j][1]);
        NUM(addmul)(w.scratch[0], w.axis[2], w.vertex[j][2]);
        if (j == 0 || NUM(cmp)(w.scratch[0], least) < 0)
            NUM(set)(least, w.scratch[0]);
        if (j == 0 || NUM(cmp)(w.scratch[0], most) > 0)
            NUM(set)(most, w.scratch[0]);
    }
}

/* The interval that the corners span: each coordinate is the box's lo or hi, whatever the other two are. */
static void project_corners(num least, num most)
{
    NUM(set_si)(least, 0);
    NUM(set_si)(most, 0);
    for (int a = 0; a < 3; a++) {
        if (!NUM(sgn)(w.axis[a]))
            continue;
        for (int side = 0; side < 2; side++)
            NUM(mul)(w.scratch[side], w.axis[a], w.bound[side][a]);
        const int lesser = NUM(cmp)(w.scratch[0], w.scratch[1]) > 0;
        NUM(add)(least, least, w.scratch[lesser]);
        NUM(add)(most, most, w.scratch[!lesser]);
    }
}

static void compare_on_axis(int number, oracle_axes *result)
{
    if (!NUM(sgn)(w.axis[0]) && !NUM(sgn)(w.axis[1]) && !NUM(sgn)(w.axis[2]))
        return;
    project_vertices(w.least[0], w.most[0]);
    project_corners(w.least[1], w.most[1]);
    const int above = NUM(cmp)(w.least[0], w.most[1]), below = NUM(cmp)(w.least[1], w.most[0]);
    if (above > 0 || below > 0)
        result->apart |= 1u << number;
    else if (above == 0 || below == 0)
        result->touching |= 1u << number;
}

static oracle_axes separating(const oracle_integers *in)
{
    prepare();
    load_points(in);
    oracle_axes result = {0, 0};
    for (int i = 0; i < 3; i++) {
        axis_is_cross(w.unit[(i + 1) % 3], w.unit[(i + 2) % 3]);
        compare_on_axis(i, &result);
    }
    axis_is_cross(w.edge[0], w.edge[1]);
    compare_on_axis(ORACLE_PLANE, &result);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            axis_is_cross(w.unit[i], w.edge[j]);
            compare_on_axis(ORACLE_EDGES + 3 * i + j, &result);
        }
    return result;
}
