/*
 * small_pairs.h - pairs in space of tiny floats, as whole numbers of steps: what separates them, and how they are drawn.
 * After: vec_small.h, small_draws.h.
 */

/* Are the pairs of doubles (local.h)? Or the boxes alone? */
#if !defined(SMALL_IS_NEAR)
#define SMALL_IS_NEAR 0
#endif
#if !defined(SMALL_IS_WIDE)
#define SMALL_IS_WIDE 0
#endif

enum {
    PAIRS_EACH = 20, /* 2 million by default */
    MORE_BITS = SMALL_IS_NEAR   ? 5
                : SMALL_IS_WIDE ? 2
                                : 0 /* so many more has a double than a tiny float */
};
#define STEP (SMALL_ONE / (1 << MORE_BITS))

/* Axis by axis, in steps. */
typedef struct whole_pair {
    small_axis of[3];
} whole_pair;

/* From one tiny float to the next, seen from a number of any length: those of a walk have a least one. */
static inline whole spacing(whole a)
{
    const whole least = SMALL_HAS_LEAST ? 1 << MORE_BITS : 1;
    return whole_most(small_spacing(a), least);
}

/* The least tiny float that is not below a number. */
static inline whole float_from(whole a)
{
    const whole cut = whole_size(a) & -spacing(a);
    return a < 0 ? -cut : cut < a ? cut + spacing(a) : cut;
}

/* A control forgets that V_0 is not taken from lo. */
#if !defined(SMALL_FORGETS_ORIGIN)
#define SMALL_FORGETS_ORIGIN 0
#endif

/* tribox_box_round, in tiny floats. */
static inline void put_box(tribox_rounded_box *to, const whole_pair *p, bool is_box_asked)
{
    for (int a = 0; a < 3; a++) {
        const whole lo = p->of[a].lo, hi = p->of[a].hi;
        const double l = is_box_asked ? (double)float_from(lo) * STEP : small_rounded((double)lo * STEP);
        to->lo[a] = (float)((double)float_from(lo) * STEP);
        to->hi[a] = (float)((double)-float_from(-hi) * STEP);
        to->of.origin[a] = (float)l;
        to->of.H[a] = (float)small_rounded((double)(hi - lo) * STEP);
        to->of.C[a] = SMALL_FORGETS_ORIGIN ? to->of.H[a] : (float)small_rounded((double)(hi + lo) * STEP - 2 * l);
    }
}

/* Groups of axes that separate a pair. */
typedef struct apart {
    bool by[4]; /* by the number of the paper's bullet: 1 the box normals, 2 the plane, 3 the edges */
} apart;

/* Do triangle and box cover nothing in common along w? */
static inline bool is_apart_along(const whole_pair *p, const whole w[3])
{
    whole least = 0, most = 0, first = INT64_MAX, last = INT64_MIN;
    for (int a = 0; a < 3; a++) {
        least += w[a] * (w[a] > 0 ? p->of[a].lo : p->of[a].hi);
        most += w[a] * (w[a] > 0 ? p->of[a].hi : p->of[a].lo);
    }
    for (int j = 0; j < 3; j++) {
        const whole at = w[0] * p->of[0].u[j] + w[1] * p->of[1].u[j] + w[2] * p->of[2].u[j];
        first = whole_least(first, at);
        last = whole_most(last, at);
    }
    return first > most || last < least;
}

/* Across the triangle. */
static inline void normal_of(const whole_pair *p, whole w[3])
{
    for (int i = 0; i < 3; i++) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        w[i] = (p->of[a].u[1] - p->of[a].u[0]) * (p->of[b].u[2] - p->of[b].u[0]) -
               (p->of[b].u[1] - p->of[b].u[0]) * (p->of[a].u[2] - p->of[a].u[0]);
    }
}

/* Across the edge from vertex j and axis i. */
static inline void across_edge(const whole_pair *p, int i, int j, whole w[3])
{
    const int a = (i + 1) % 3, b = (i + 2) % 3, k = (j + 1) % 3;
    w[i] = 0;
    w[a] = p->of[b].u[j] - p->of[b].u[k];
    w[b] = p->of[a].u[k] - p->of[a].u[j];
}

static inline apart apart_of(const whole_pair *p)
{
    apart is = {{false}};
    whole w[3];
    for (int i = 0; i < 3; i++) {
        const whole e[3] = {i == 0, i == 1, i == 2};
        is.by[1] |= is_apart_along(p, e);
        for (int j = 0; j < 3; j++) {
            across_edge(p, i, j, w);
            is.by[3] |= is_apart_along(p, w);
        }
    }
    normal_of(p, w);
    is.by[2] = is_apart_along(p, w);
    return is;
}

/* The vertices anywhere, or within a few steps of the first, and that often near zero, where the steps can be small. */
static inline void draw_vertices(random_source *r, whole_pair *p)
{
    const bool is_tiny = small_draw(r, 2);
    const int steps = is_tiny ? 2 << small_draw(r, SMALL_BITS) : 2 << small_draw(r, SMALL_BITS + SMALL_BINADES);
    for (int a = 0; a < 3; a++) {
        whole *const u = p->of[a].u;
        u[0] = small_one_of(r, is_tiny ? 2 * SMALL_HALF : SMALL_NUMBERS);
        for (int j = 1; j < 3; j++)
            u[j] = small_draw(r, 4) ? small_near(u[0] + small_draw(r, 2 * (unsigned)steps + 1) - steps)
                                    : u[small_draw(r, (unsigned)j)];
    }
}

static inline void draw_box(random_source *r, whole_pair *p)
{
    const bool is_thin = small_draw(r, 2);
    for (int a = 0; a < 3; a++) {
        const whole x = small_draw(r, 2) ? small_any(r) : small_beside(r, p->of[a].u[small_draw(r, 3)]);
        whole y = small_beside(r, is_thin ? x : p->of[a].u[small_draw(r, 3)]);
        if (!is_thin && small_draw(r, 2))
            y = small_any(r);
        p->of[a].lo = whole_least(x, y);
        p->of[a].hi = whole_most(x, y);
    }
}

/* On which the triangle has no extent, and the box little. */
static inline void flatten(random_source *r, small_axis *x)
{
    x->u[1] = x->u[2] = x->lo = x->u[0];
    x->hi = whole_most(x->lo, small_beside(r, x->lo));
}

/* Numbers of more bits, of which those that were equal often stay so. */
static inline whole lengthened(random_source *r, whole a, whole more)
{
    return a * (1 << MORE_BITS) + (small_draw(r, 2) ? more : small_draw(r, 1 << MORE_BITS));
}

static inline void lengthen(random_source *r, whole_pair *p)
{
    for (int a = 0; a < 3; a++) {
        small_axis *const x = &p->of[a];
        const whole more = small_draw(r, 1 << MORE_BITS);
        for (int j = 0; j < 3; j++)
            x->u[j] = lengthened(r, x->u[j], more);
        const whole lo = lengthened(r, x->lo, more), hi = lengthened(r, x->hi, more);
        x->lo = whole_least(lo, hi);
        x->hi = whole_most(lo, hi);
    }
}
/* A tiny float, halfway from it to the next, a step from it, or anywhere near. */
static inline whole wider(random_source *r, whole a)
{
    const whole at = a * (1 << MORE_BITS), gap = small_spacing(a) << MORE_BITS;
    switch (small_draw(r, 4)) {
    case 0:
        return at;
    case 1:
        return at + (small_draw(r, 2) ? gap : -gap) / 2;
    case 2:
        return at + small_draw(r, 3) - 1;
    default:
        return at + small_draw(r, 2 * (unsigned)gap + 1) - gap;
    }
}

/* The box's numbers longer. Often thin, so that no float lies in it, or one. */
static inline void widen(random_source *r, whole_pair *p)
{
    for (int a = 0; a < 3; a++) {
        small_axis *const x = &p->of[a];
        for (int j = 0; j < 3; j++)
            x->u[j] *= 1 << MORE_BITS;
        const whole lo = wider(r, x->lo), hi = small_draw(r, 4) ? wider(r, x->hi) : lo + small_draw(r, 4);
        x->lo = whole_least(lo, hi);
        x->hi = whole_most(lo, hi);
    }
}

/* Moves one bound of the box so that the two all but touch along w, on the side that w or -w points to. */
static inline void let_touch(random_source *r, whole_pair *p, whole w[3])
{
    int last = 0;
    for (int a = 0; a < 3; a++)
        if (whole_size(w[a]) > whole_size(w[last]))
            last = a;
    if (w[last] == 0)
        return;
    const whole sign = small_draw(r, 2) ? 1 : -1;
    whole first = INT64_MAX;
    for (int a = 0; a < 3; a++)
        w[a] *= sign;
    for (int j = 0; j < 3; j++)
        first = whole_least(first, w[0] * p->of[0].u[j] + w[1] * p->of[1].u[j] + w[2] * p->of[2].u[j]);
    for (int a = 0; a < 3; a++)
        if (a != last)
            first -= w[a] * (w[a] > 0 ? p->of[a].hi : p->of[a].lo);
    const whole most = small_greatest() << MORE_BITS, touching = whole_most(whole_least(first / w[last], most), -most);
    const whole at = MORE_BITS ? touching + small_draw(r, 3) - 1 : small_beside(r, small_near(touching));
    whole *const lo = &p->of[last].lo, *const hi = &p->of[last].hi;
    *(w[last] > 0 ? hi : lo) = at;
    if (*lo > *hi || small_draw(r, 2))
        *lo = *hi = at;
}

/* All numbers anywhere: without the box normals, what has an edge along an axis is never certain. */
static inline small_axis loose_axis(random_source *r)
{
    small_axis x;
    for (int j = 0; j < 3; j++)
        x.u[j] = small_any(r);
    const whole y = small_any(r), z = small_any(r);
    x.lo = whole_least(y, z);
    x.hi = whole_most(y, z);
    return x;
}

static inline void draw_pair(random_source *r, whole_pair *p)
{
    whole w[3];
    const int form = small_draw(r, 6);
    draw_vertices(r, p);
    draw_box(r, p);
    for (int a = 0; a < 3 && form < 3; a++)
        p->of[a] = form == 0 ? loose_axis(r) : small_any_axis(r);
    if (form == 1)
        flatten(r, &p->of[small_draw(r, 3)]);
    if (SMALL_IS_NEAR)
        lengthen(r, p);
    if (SMALL_IS_WIDE)
        widen(r, p);
    const int touches = small_draw(r, 4), i = small_draw(r, 3), j = small_draw(r, 3);
    if (touches == 0) {
        normal_of(p, w);
        let_touch(r, p, w);
    } else if (touches == 1) {
        across_edge(p, i, j, w);
        let_touch(r, p, w);
    }
}
