/*
 * rays.h - an axis, seen from its box: u_j = (V_j + H) / 2 + lo. After: claims.h, axes.h, bounds.h.
 *
 * V_i = V_j, V_i = -V_j and V_i = +-H, where |f|, H, F and m have kinks, cut (V_0, V_1, V_2, H) into 192 cones: by the order of the
 * |V_j| and H, and by the signs of the V_j. These are the edges of all cones.
 */
enum { RAYS = 53, ORDERS = 24 };
typedef struct ray {
    int V[3], H;
} ray;
static ray rays[RAYS];

static inline void find_rays(void)
{
    int count = 0;
    for (int k = 0; k < 54; k++) {
        const ray r = {{k % 3 - 1, k / 3 % 3 - 1, k / 9 % 3 - 1}, k / 27};
        if (r.V[0] || r.V[1] || r.V[2] || r.H)
            rays[count++] = r;
    }
    COUNT_MUST(count == RAYS);
}

static lane_triangle t;
static lane_box box;   /* as a walk has it */
static lane_box truth; /* the bounds themselves */
static lane_shape s;

/*
 * How an axis is given. Numbers of the input are places, of which only differences count; or, relative to the origin that V_0 is
 * taken from, differences that round nothing. The origin is lo; of a box of doubles it is a float next to it, `moved` times m_a
 * away, and H and C are rounded on their own (PROOFS.md 3.9).
 */
typedef struct axis_form {
    bool is_relative, has_doubles;
    double moved;
} axis_form;

/* Of doubles: an origin as far away as it can be where u_0 less it is exact; and next to lo, where that is rounded. */
#define OF_FLOATS \
    { \
        false, false, 0 \
    }
#define NEAR \
    { \
        true, false, 0 \
    }
#define FAR_ORIGIN(side) \
    { \
        true, true, (side) \
    }
#define NEXT_ORIGIN(side) \
    { \
        false, true, (side)*8 * V_UNIT \
    }

static inline vnum given_length(int a, double x)
{
    count_here = COUNT_HERE;
    return count_rounded(count_input(a, x, false), 1);
}

static inline void set_axis(int a, const ray *r, axis_form form)
{
    const double m = most_of(abs(r->V[0]), most_of(abs(r->V[1]), abs(r->V[2]))) + r->H, origin = form.moved * m;
    const double from = form.is_relative ? origin : 0;
    const vnum zero = form.is_relative ? v_splat(0) : count_input(a, origin, true);
    for (int j = 0; j < 3; j++)
        t.u[j][a] = count_input(a, r->V[j] + r->H - from, !form.is_relative);
    truth.hi[a] = count_input(a, 2 * r->H - from, !form.is_relative);
    truth.lo[a] = form.has_doubles ? count_input(a, -from, !form.is_relative) : zero;
    if (form.has_doubles) {
        box.lo[a] = box.origin[a] = zero;
        box.H[a] = given_length(a, 2 * r->H);
        box.C[a] = given_length(a, 2 * r->H - 2 * origin);
    } else {
        set_bounds(&box, a, zero, truth.hi[a]);
    }
    shape_axis(&s, &t, &box, a);
}

static inline double exact_f(int j, int a) { return count_of(t.u[(j + 1) % 3][a])->x - count_of(t.u[j][a])->x; }
static inline double exact_H(int a) { return count_of(truth.hi[a])->x - count_of(truth.lo[a])->x; }
static inline double exact_V(int j, int a) { return 2 * (count_of(t.u[j][a])->x - count_of(truth.lo[a])->x) - exact_H(a); }
static inline double exact_F(int a) { return most_of(fabs(exact_f(0, a)), most_of(fabs(exact_f(1, a)), fabs(exact_f(2, a)))); }
static inline double exact_M(int a)
{
    return most_of(fabs(exact_V(0, a)), most_of(fabs(exact_V(1, a)), fabs(exact_V(2, a)))) + exact_H(a);
}
/* The sizes of PROOFS.md 0, exact. */
static inline double exact_B(int a, int b) { return exact_M(a) * exact_F(b) + exact_M(b) * exact_F(a); }
static inline double exact_own_B(int j, int a, int b)
{
    return exact_M(a) * fabs(exact_f(j, b)) + exact_M(b) * fabs(exact_f(j, a));
}

static inline double exact_S(void)
{
    double S = 0;
    for (int i = 0; i < 3; i++)
        S += exact_F((i + 1) % 3) * exact_F((i + 2) % 3) * exact_M(i) / 2;
    return S;
}

/* The k-th of 24 orders of four. */
static inline void order_of(int k, int order[4])
{
    int left[4] = {0, 1, 2, 3};
    for (int p = 0; p < 4; p++) {
        const int at = k % (4 - p);
        k /= 4 - p;
        order[p] = left[at];
        memmove(left + at, left + at + 1, sizeof *left * (size_t)(3 - at));
    }
}

/* Ray g of a cone: the numbers from place g of the order on are 1, with these signs. */
static inline ray ray_of_cone(const int order[4], int signs, int g)
{
    ray r = {{0, 0, 0}, 0};
    for (int p = g; p < 4; p++) {
        if (order[p] == 3)
            r.H = 1;
        else
            r.V[order[p]] = signs >> order[p] & 1 ? -1 : 1;
    }
    return r;
}

/* Whether each comparison of one axis has one sign at all edges of a cone, and so within it: of rays in each of the forms. */
static inline void check_cone(const int order[4], int signs, const axis_form *forms, int count)
{
    double sign[COUNT_COMPARISONS] = {0};
    for (int k = 0; k < 4 * count; k++) {
        const ray r = ray_of_cone(order, signs, k % 4);
        count_start(0);
        for (int a = 0; a < 3; a++)
            set_axis(a, &r, forms[k / 4]);
        bounds_of(&t, &truth);
        shape_normal(&s);
        plane_slack(&s, plane_reach(&s));
        for (int i = 0; i < 3; i++) {
            edge_slacks_along(&s, i, true);
            edge_slacks_along(&s, i, false);
        }
        COUNT_MUST(count_comparisons < COUNT_COMPARISONS);
        for (int c = 0; c < count_comparisons; c++) {
            COUNT_MUST(sign[c] * count_compared[c] >= 0);
            sign[c] = fabs(count_compared[c]) > 0 ? count_compared[c] : sign[c];
        }
    }
}

static inline void check_cones(const axis_form *forms, int count)
{
    int order[4];
    count_signs_tried = COUNT_NUMBERS; /* no sign of them is a comparison on one axis */
    for (int k = 0; k < ORDERS; k++)
        for (int signs = 0; signs < 8; signs++) {
            order_of(k, order);
            check_cone(order, signs, forms, count);
        }
}

static inline int drawn_below(int end)
{
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (int)((state >> 33) % (uint64_t)end);
}

/* Anywhere, and often where numbers are alike or nearly so. */
static inline ray drawn_ray(void)
{
    const int size = 1 << drawn_below(9);
    ray r;
    for (int j = 0; j < 3; j++)
        r.V[j] = j && drawn_below(3) == 0 ? r.V[drawn_below(j)] + drawn_below(3) - 1 : drawn_below(2 * size + 1) - size;
    r.H = drawn_below(3) ? drawn_below(size + 1) : abs(r.V[drawn_below(3)]);
    return r;
}

/* The origin anywhere between. */
static inline axis_form drawn_form(axis_form form)
{
    form.moved *= drawn_below(1025) / 1024.0;
    return form;
}
