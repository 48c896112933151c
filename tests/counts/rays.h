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
static lane_box box;
static lane_shape s;

/*
 * Where `is_near`, the box begins at 0 and numbers of the input are relative to it: u - 0 and hi - 0 round nothing (near.h). Else
 * they are places, of which only differences count.
 */
static inline void set_axis(int a, const ray *r, bool is_near)
{
    for (int j = 0; j < 3; j++)
        t.u[j][a] = count_input(a, r->V[j] + r->H, !is_near);
    set_bounds(&box, a, is_near ? v_splat(0) : count_input(a, 0, true), count_input(a, 2 * r->H, !is_near));
    shape_axis(&s, &t, &box, a);
}

static inline double exact_f(int j, int a) { return count_of(t.u[(j + 1) % 3][a])->x - count_of(t.u[j][a])->x; }
static inline double exact_H(int a) { return count_of(box.hi[a])->x - count_of(box.lo[a])->x; }
static inline double exact_V(int j, int a) { return 2 * (count_of(t.u[j][a])->x - count_of(box.lo[a])->x) - exact_H(a); }
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

/* Whether each comparison of one axis has one sign at all edges of a cone, and so within it. */
static inline void check_cone(const int order[4], int signs)
{
    double sign[COUNT_COMPARISONS] = {0};
    for (int g = 0; g < 4; g++) {
        const ray r = ray_of_cone(order, signs, g);
        count_start(0);
        for (int a = 0; a < 3; a++)
            set_axis(a, &r, false);
        bounds_of(&t, &box);
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

static inline void check_cones(void)
{
    int order[4];
    count_signs_tried = COUNT_NUMBERS; /* no sign of them is a comparison on one axis */
    for (int k = 0; k < ORDERS; k++)
        for (int signs = 0; signs < 8; signs++) {
            order_of(k, order);
            check_cone(order, signs);
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
