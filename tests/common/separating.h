/*
 * separating.h - the textbook separating-axis test: project both bodies on an axis, compare the two intervals.
 *
 * This text is included after a type of integers: `num`, an array of one element, and NUM(name), the operations of GMP by their
 * names there.
 */

/* The bodies as points: the three vertices, then the eight corners. */
enum { FIRST_VERTEX = 0, VERTICES = 3, FIRST_CORNER = 3, CORNERS = 8, POINTS = 11 };

static struct {
    num point[POINTS][3];
    num unit[3][3];
    num edge[3][3];
    num axis[3];
    num least[2], most[2];
    num scratch;
} w;

static void prepare(void)
{
    static bool is_ready;
    if (is_ready)
        return;
    is_ready = true;
    for (int a = 0; a < 3; a++) {
        for (int k = 0; k < POINTS; k++)
            NUM(init)(w.point[k][a]);
        for (int k = 0; k < 3; k++) {
            NUM(init)(w.edge[k][a]);
            NUM(init)(w.unit[k][a]);
            NUM(set_si)(w.unit[k][a], k == a);
        }
        NUM(init)(w.axis[a]);
    }
    for (int body = 0; body < 2; body++) {
        NUM(init)(w.least[body]);
        NUM(init)(w.most[body]);
    }
    NUM(init)(w.scratch);
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
            load_number(w.point[FIRST_VERTEX + j][a], in, 3 * j + a);
        for (int c = 0; c < CORNERS; c++)
            load_number(w.point[FIRST_CORNER + c][a], in, (c >> a & 1 ? 12 : 9) + a);
        for (int j = 0; j < 3; j++)
            NUM(sub)(w.edge[j][a], w.point[(j + 1) % 3][a], w.point[j][a]);
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

/* The interval that some points span on the axis. */
static void project(int first, int count, num least, num most)
{
    for (int k = first; k < first + count; k++) {
        NUM(mul)(w.scratch, w.axis[0], w.point[k][0]);
        NUM(addmul)(w.scratch, w.axis[1], w.point[k][1]);
        NUM(addmul)(w.scratch, w.axis[2], w.point[k][2]);
        if (k == first || NUM(cmp)(w.scratch, least) < 0)
            NUM(set)(least, w.scratch);
        if (k == first || NUM(cmp)(w.scratch, most) > 0)
            NUM(set)(most, w.scratch);
    }
}

static void compare_on_axis(int number, oracle_axes *result)
{
    if (!NUM(sgn)(w.axis[0]) && !NUM(sgn)(w.axis[1]) && !NUM(sgn)(w.axis[2]))
        return;
    project(FIRST_VERTEX, VERTICES, w.least[0], w.most[0]);
    project(FIRST_CORNER, CORNERS, w.least[1], w.most[1]);
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
