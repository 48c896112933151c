/*
 * test_margins.c - what the margins of src/kernel/pairs/margin.h rest on, term by term: pairs for which a term left out is a wrong
 * answer.
 *
 * Far away, for sets of axes without the box normals: a triangle of which an edge axis or the plane all but touches the box, far
 * off compared with the sizes of both. What is lost there grows with the distance, and the slack does not.
 * Vanishing: triangles so small that their normal is a few multiples of the least float, or none; then its sign is anybody's guess.
 */
#include "common/ask.h"

#include <math.h>

#include "common/contact.h"
#include "common/harness.h"

/* So many bits has the distance of a triangle far away, in units of the last one. */
enum { UNIT_BITS = 23 };

typedef void pair_draw(random_source *r, pair_f64 *pair);

/* Any of about `size`, of either sign. */
static double any_of(random_source *r, double size) { return size * random_double(r, -1, 1); }

/* To 22 bits, three times which is a float too. */
static double nearest_short(double number)
{
    int exponent;
    const double part = frexp(number, &exponent);
    return ldexp(round(ldexp(part, 22)), exponent - 22);
}

static int longest_of(const double m[3])
{
    const int longer = fabs(m[0]) < fabs(m[1]);
    return fabs(m[longer]) < fabs(m[2]) ? 2 : longer;
}

static void cross(const double f[3], const double g[3], double n[3])
{
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        n[i] = f[a] * g[b] - f[b] * g[a];
    }
}

static double dot(const double f[3], const double g[3]) { return f[0] * g[0] + f[1] * g[1] + f[2] * g[2]; }

/*
 * A box of about `size` near a place, whose corner farthest along m lies in the plane m.x = m.p, but for the rounding and the slip.
 */
static void put_box(random_source *r, const double m[3], const double p[3], const double place[3], double size, double slip,
                    tribox_box *box)
{
    double corner[3], off = dot(m, p);
    const int last = longest_of(m);
    for (int a = 0; a < 3; a++)
        if (a != last) {
            corner[a] = (float)(place[a] + any_of(r, size));
            off -= m[a] * corner[a];
        }
    corner[last] = off / m[last] + any_of(r, slip);
    for (int a = 0; a < 3; a++) {
        const double length = size * random_double(r, 0.5, 4);
        box->lo[a] = (float)(m[a] < 0 ? corner[a] : corner[a] - length);
        box->hi[a] = (float)(m[a] > 0 ? corner[a] : corner[a] + length);
    }
}

/* A vector of whole numbers that is not zero. */
static void draw_whole(random_source *r, int most, int w[3])
{
    do {
        for (int a = 0; a < 3; a++)
            w[a] = random_int(r, 3) ? random_int_between(r, -most, most) : 0;
    } while (!w[0] && !w[1] && !w[2]);
}

static int longest_component(const int w[3])
{
    const double m[3] = {w[0], w[1], w[2]};
    return abs(w[longest_of(m)]);
}

/*
 * A segment, or a needle, that points at the box from afar, and one of its edge axes in contact. Its vertices are multiples of the
 * last bit that such far numbers have, the bounds of the box are not.
 */
static void draw_edge_far_away(random_source *r, pair_f64 *pair)
{
    int w[3];
    draw_whole(r, 1 << random_int_between(r, 0, 12), w);
    const double unit = ldexp(1, random_int_between(r, -40, 12)), size = unit * ldexp(1, random_int_between(r, -2, 12));
    const int far = (1 << UNIT_BITS) / (2 * longest_component(w));
    const int steps = random_int_between(r, far, 2 * far - 4) * (random_int(r, 2) ? 1 : -1), noise = random_int(r, 2);
    double place[3], f[3], m[3] = {0, 0, 0};
    for (int a = 0; a < 3; a++)
        place[a] = unit * round(any_of(r, size / unit));
    for (int j = 0; j < 3; j++)
        for (int a = 0, at = steps + random_int_between(r, -2, 2); a < 3; a++)
            pair->u[j][a] = (float)(place[a] + unit * (w[a] * at + random_int_between(r, -noise, noise)));
    const int i = random_int(r, 3), b = (i + 1) % 3, c = (i + 2) % 3, j = random_int(r, 3), sign = random_int(r, 2) ? 1 : -1;
    for (int a = 0; a < 3; a++)
        f[a] = pair->u[(j + 1) % 3][a] - pair->u[j][a];
    m[b] = sign * f[c];
    m[c] = -sign * f[b];
    if (m[b] == 0 && m[c] == 0)
        m[b] = sign;
    const double *const p = pair->u[j], *const q = pair->u[(j + 2) % 3];
    put_box(r, m, dot(m, p) < dot(m, q) ? p : q, place, size, random_int(r, 2) * unit, &pair->box);
}

/* A triangle of edges up to `most` units, far away in a plane that all but touches the box; vertices as above. */
static void draw_plane_at(random_source *r, int most, double unit, double size, pair_f64 *pair)
{
    int w[2][3];
    double f[2][3], n[3], place[3];
    do {
        for (int k = 0; k < 2; k++) {
            draw_whole(r, most, w[k]);
            for (int a = 0; a < 3; a++)
                f[k][a] = w[k][a];
        }
        cross(f[0], f[1], n);
    } while (dot(n, n) == 0);
    const int far = (1 << UNIT_BITS) / (2 * (longest_component(w[0]) + longest_component(w[1])));
    const int steps[2] = {random_int_between(r, -2 * far, 2 * far), random_int_between(r, -2 * far, 2 * far)};
    for (int a = 0; a < 3; a++) {
        place[a] = unit * round(any_of(r, size / unit));
        pair->u[0][a] = (float)(place[a] + unit * (steps[0] * w[0][a] + steps[1] * w[1][a]));
        pair->u[1][a] = (float)(pair->u[0][a] + unit * w[0][a]);
        pair->u[2][a] = (float)(pair->u[0][a] + unit * w[1][a]);
    }
    const int sign = random_int(r, 2) ? 1 : -1;
    for (int a = 0; a < 3; a++)
        n[a] *= sign;
    put_box(r, n, pair->u[0], place, size, random_int(r, 2) * unit, &pair->box);
}

static void draw_plane_far_away(random_source *r, pair_f64 *pair)
{
    const double unit = ldexp(1, random_int_between(r, -40, 12));
    draw_plane_at(r, 1 << random_int_between(r, 0, 11), unit, unit * ldexp(1, random_int_between(r, -2, 12)), pair);
}

/* So far away that the distance from the plane overflows on the way, from a triangle and a box that are in range. */
static void draw_plane_past_range(random_source *r, pair_f64 *pair)
{
    const double unit = ldexp(1, random_int_between(r, 32, 35));
    draw_plane_at(r, 2, unit, unit / 16, pair);
}

static void draw_vanishing(random_source *r, double u[3][3])
{
    const int exponent = random_int_between(r, -76, -72);
    for (int j = 0; j < 3; j++)
        for (int a = 0; a < 3; a++)
            u[j][a] = (float)ldexp(any_of(r, 1), exponent);
}

/*
 * A vanishing triangle at the origin, and a box far away that is a point of its plane, but for the rounding, or a few ulps about
 * it.
 */
static void draw_vanishing_far_away(random_source *r, pair_f64 *pair)
{
    double f[2][3], n[3], place[3];
    do {
        draw_vanishing(r, pair->u);
        for (int k = 0; k < 2; k++)
            for (int a = 0; a < 3; a++)
                f[k][a] = pair->u[k + 1][a] - pair->u[k][a];
        cross(f[0], f[1], n);
    } while (dot(n, n) == 0);
    const double distance = ldexp(1, random_int_between(r, 30, 35));
    for (int a = 0; a < 3; a++)
        place[a] = any_of(r, distance);
    put_box(r, n, pair->u[0], place, 0, 0, &pair->box);
    for (int a = 0, is_point = random_int(r, 2); a < 3 && !is_point; a++) {
        pair->box.lo[a] = nextafterf((float)pair->box.lo[a], -INFINITY);
        pair->box.hi[a] = nextafterf((float)pair->box.hi[a], INFINITY);
    }
}

/*
 * A vanishing triangle outside of an edge of a large box, where one edge axis alone decides. Seen along the box edge, the nearest
 * edge of the triangle rises to the right below the corner of the box, whose rest is above it to the left; the third vertex is
 * lower and farther right. Then the wrong sign of the normal leaves all slacks positive. The corner is at zero, or at numbers as
 * fine as the triangle.
 */
static void draw_vanishing_at_corner(random_source *r, pair_f64 *pair)
{
    const int i = random_int(r, 3), b = (i + 1) % 3, c = (i + 2) % 3, turn = random_int(r, 3), is_beside = random_int(r, 2);
    const double unit = ldexp(1, random_int_between(r, -80, -71));
    const double right = unit * pow(2, random_double(r, -10, -1)), up = unit * pow(2, random_double(r, -10, -1));
    const double share = random_double(r, 0, 1), below = any_of(r, fmin(share * right, (1 - share) * up));
    double v[3][3];
    for (int j = 0; j < 3; j++)
        v[j][i] = any_of(r, unit);
    v[0][b] = below - share * right;
    v[0][c] = -below - share * up;
    v[1][b] = v[0][b] + right;
    v[1][c] = v[0][c] + up;
    v[2][b] = v[1][b] + random_double(r, 0, unit);
    v[2][c] = v[0][c] - random_double(r, 0, unit);
    for (int a = 0; a < 3; a++) {
        const int sign = random_int(r, 2) ? 1 : -1;
        const double corner = is_beside ? ldexp(random_int(r, 2) ? 1 : -1, random_int_between(r, -70, -52)) : 0;
        const double length = ldexp(random_double(r, 0.5, 1), random_int_between(r, 20, 37));
        const double before = a == c ? 0 : length, after = a == b ? 0 : length;
        pair->box.lo[a] = (float)(corner - (sign > 0 ? before : after));
        pair->box.hi[a] = (float)(corner + (sign > 0 ? after : before));
        for (int j = 0; j < 3; j++)
            pair->u[(j + turn) % 3][a] = (float)(corner + sign * v[j][a]);
    }
}

/*
 * A vanishing triangle that is edge-on along one axis: on the others its vertices are b and 3 b, so that this component of the
 * normal is zero. But the edges round, and where the two products of it lie on either side of half the least float, they leave one
 * of it. The plane passes an edge of a large box at a distance that is less still.
 */
static void draw_vanishing_edge_on(random_source *r, pair_f64 *pair)
{
    const int i = random_int(r, 3), b = (i + 1) % 3, c = (i + 2) % 3;
    double at[3];
    at[0] = -nearest_short(random_double(r, 0.5, 1) * ldexp(1, random_int_between(r, -80, -77)));
    at[1] = nearest_short(random_double(r, 0.5, 1) * 0x1p-75);
    const double first = at[1] - at[0];
    at[2] = nearest_short(at[1] + (random_int_between(r, 0, 4) + 0.5) * 0x1p-149 / (3 * first));
    for (int j = 0; j < 3; j++) {
        pair->u[j][i] = (float)ldexp(any_of(r, 1), -74);
        pair->u[j][b] = (float)at[j];
        pair->u[j][c] = (float)(3 * at[j]);
    }
    for (int a = 0; a < 3; a++) {
        const double length = ldexp(random_double(r, 0.5, 1), random_int_between(r, 30, 37));
        const double corner = a == c ? random_int_between(r, -1, 1) * 0x1p-120 : 0;
        pair->box.lo[a] = (float)(a == c ? corner : -length);
        pair->box.hi[a] = (float)(a == b ? corner : length);
    }
}

/*
 * The plane's slack and its margin at their most unlike, by a search over triangles and small boxes on their planes: as computed,
 * the slack has the wrong sign and is more than a 64th of the margin. The first where products round, the second where they are
 * fused.
 */
static const pair_f64 worst_planes[] = {
    {.u = {{-0x1.0930a8p-1f, -0x1.522aacp-1f, 0x1.d59e24p-1f},
           {0x1.b1c812p-1f, 0x1.177f32p-1f, 0x1.b66c34p-1f},
           {0x1.a89ccep-1f, 0x1.62d046p-1f, -0x1.40ff5p-1f}},
     .box = {{0x1.1ba3aep-1f, 0x1.73ab2p-2f, -0x1.abccc6p-4f}, {0x1.1caf2cp-1f, 0x1.91363cp-2f, -0x1.665054p-4f}}},
    {.u = {{-0x1.cc465cp-1f, -0x1.4d1baep-1f, -0x1.3e66d8p-2f},
           {-0x1.d2e60cp-1f, -0x1.39bbdap-5f, 0x1.4e1546p-2f},
           {-0x1.d1015p-4f, -0x1.a1ad66p-6f, 0x1.0fedcap-2f}},
     .box = {{-0x1.401502p-1f, -0x1.c0a826p-4f, 0x1.f703d6p-3f}, {-0x1.351024p-1f, -0x1.720f98p-4f, 0x1.0d66bap-2f}}},
};

/* One of them, mirrored and scaled, which changes no rounding. */
static void draw_worst_plane(random_source *r, pair_f64 *pair)
{
    const pair_f64 *const from = &worst_planes[random_int(r, 2)];
    const int exponent = random_int_between(r, -20, 10);
    for (int a = 0; a < 3; a++) {
        const bool is_mirrored = random_int(r, 2);
        const float scale = ldexpf(is_mirrored ? -1 : 1, exponent);
        pair->box.lo[a] = scale * (is_mirrored ? from->box.hi[a] : from->box.lo[a]);
        pair->box.hi[a] = scale * (is_mirrored ? from->box.lo[a] : from->box.hi[a]);
        for (int j = 0; j < 3; j++)
            pair->u[j][a] = scale * from->u[j][a];
    }
}

/* A kind of pairs, and the groups of axes that decide them; without BOX they are asked without it. */
typedef struct kind {
    const char *name;
    pair_draw *draw;
    unsigned axes;
} kind;

static const kind kinds[] = {
    {"edge far away", draw_edge_far_away, TRIBOX_AXES_EDGES},
    {"plane far away", draw_plane_far_away, TRIBOX_AXES_PLANE},
    {"plane past range", draw_plane_past_range, TRIBOX_AXES_PLANE},
    {"vanishing far away", draw_vanishing_far_away, TRIBOX_AXES_PLANE},
    {"vanishing at corner", draw_vanishing_at_corner, TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES},
    {"vanishing edge-on", draw_vanishing_edge_on, TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE},
    {"worst plane", draw_worst_plane, TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE},
};

/* One triangle in each order of its vertices, and one box. */
typedef struct test_run {
    origin where;
    pair_f64 pair;
    oracle_axes truth;
    float coordinate[3][3][ORDERS];
} test_run;

static void check_answer(const test_run *t, bool answer)
{
    const bool overlaps = oracle_overlaps(t->truth, t->where.options.axes);
    if (answer != overlaps && (overlaps || t->where.options.accuracy == TRIBOX_EXACT))
        fail_pair(&t->where, &t->pair, answer);
}

static void ask(test_run *t)
{
    tribox_soup soup = {.count = ORDERS};
    tribox_boxes boxes = {.count = 1};
    float bound[6], nine[9];
    uint64_t mask[1];
    for (int k = 0; k < 3; k++) {
        soup.x[k] = t->coordinate[k][0];
        soup.y[k] = t->coordinate[k][1];
        soup.z[k] = t->coordinate[k][2];
        bound[k] = (float)t->pair.box.lo[k];
        bound[3 + k] = (float)t->pair.box.hi[k];
        boxes.lo[k] = &bound[k];
        boxes.hi[k] = &bound[3 + k];
    }
    for (int n = 0; n < 9; n++)
        nine[n] = (float)t->pair.u[n / 3][n % 3];
    t->where.function = "tribox_overlap";
    ask_soup(&soup, &t->pair.box, &t->where.options, mask);
    for (size_t order = 0; order < ORDERS; order++)
        check_answer(t, bit_of(mask, order));
    t->where.function = "tribox_overlap_boxes";
    ask_boxes(nine, &boxes, &t->where.options, mask);
    check_answer(t, bit_of(mask, 0));
}

static void put_pair(test_run *t)
{
    t->truth = oracle_separating(&t->pair);
    for (int order = 0; order < ORDERS; order++)
        for (int j = 0; j < 3; j++)
            for (int a = 0; a < 3; a++)
                t->coordinate[j][a][order] = (float)t->pair.u[permutations[order][j]][a];
}

/* With the plane, with the edges and with both, from every kernel. */
static void ask_every_way(test_run *t, unsigned box, random_source *r)
{
    for (int kernel = 0; kernel < kernels; kernel++)
        for (unsigned axes = TRIBOX_AXES_PLANE; axes < TRIBOX_AXES_ALL; axes += TRIBOX_AXES_PLANE)
            for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_CONSERVATIVE; accuracy++) {
                t->where.options = (tribox_options){.accuracy = (tribox_accuracy)accuracy,
                                                    .axes = axes | box,
                                                    .axis_order = order_digits(random_int(r, ORDERS)),
                                                    .kernel = names[kernel]};
                ask(t);
            }
}

/* Each pair is asked in a hundred ways and more. */
enum { SHARE_OF_PAIRS = 50 };

CASE(test_margins)
{
    for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        const kind *const asked = &kinds[k];
        random_source r = random_named(args.seed, asked->name);
        test_run t = {.where = {.scene = asked->name, .seed = args.seed}};
        const size_t pairs = args.pairs / SHARE_OF_PAIRS;
        size_t overlaps = 0;
        for (size_t drawn = 0; drawn < pairs; drawn++) {
            asked->draw(&r, &t.pair);
            put_pair(&t);
            overlaps += oracle_overlaps(t.truth, asked->axes);
            ask_every_way(&t, asked->axes & TRIBOX_AXES_BOX, &r);
        }
        printf("%-20s %9zu pairs, %6.2f %% overlap\n", asked->name, pairs, 100 * (double)overlaps / (double)pairs);
        fflush(stdout);
        assert_in_range(overlaps, pairs / 20, pairs - pairs / 20);
    }
}

PROGRAM(RUN(test_margins))
