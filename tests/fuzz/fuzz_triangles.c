/*
 * fuzz_triangles.c - one box or oriented box and triangles in any layout, or one triangle and boxes: every question about them, of
 * every kernel, and all that is promised of the answers.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/oracle.h"
#include "things.h"

enum { BOX, ORIENTED, BOXES, FORMS };

/* Of a pair: what EXACT says, and whether any accuracy may say that it overlaps. */
typedef struct truth {
    bool overlaps, may_overlap;
} truth;

typedef struct fuzz_case {
    unsigned form, kind;
    things t; /* about boxes: the first of them */
    tribox_region region;
    tribox_box box[DRAWN_MAX];
    tribox_oriented_box oriented;
    tribox_boxes boxes;
    float triangle[9];
    size_t count, first, part; /* pairs; triangles, of which some are taken out */
    unsigned drawn;
    tribox_options options;
    unsigned wrong;
    bool is_lattice; /* FAST is exact */
    truth truth[DRAWN_MAX];
} fuzz_case;

static tribox_status ask(const fuzz_case *q, const tribox_options *o, uint64_t *mask, tribox_report *report)
{
    return q->form == BOXES ? tribox_overlap_boxes(q->triangle, &q->boxes, o, mask, report)
                            : things_overlap(&q->t, &q->region, o, mask, report);
}

static pair_f64 pair_of(const fuzz_case *q, unsigned i)
{
    pair_f64 pair = {.box = q->box[q->form == BOXES ? i : 0]};
    memcpy(pair.u, q->t.u[q->form == BOXES ? 0 : i], sizeof pair.u);
    return pair;
}

/* FAST errs either way about floats, within rounding of what is not bounded here. */
static bool is_of_floats(const fuzz_case *q) { return q->kind <= OF_FLOATS && q->t.mesh.axis_stride <= sizeof(float); }

static bool is_empty(const tribox_oriented_box *box) { return box->half[0] < 0 || box->half[1] < 0 || box->half[2] < 0; }

static void find_truths(fuzz_case *q)
{
    const unsigned axes = q->options.axes ? q->options.axes : TRIBOX_AXES_ALL;
    for (unsigned i = 0; i < q->drawn; i++) {
        const pair_f64 pair = pair_of(q, i);
        const corners u = (corners)pair.u;
        if (q->form == ORIENTED && are_finite(u[0], 9) && !is_empty(&q->oriented)) {
            const bool bounds = oriented_oracle(u, &q->oriented, true), all = oriented_oracle(u, &q->oriented, false);
            ensure(bounds || !all, "the two oracles contradict each other");
            q->truth[i] = (truth){axes == TRIBOX_AXES_BOX ? bounds : all, true};
        } else if (q->form != ORIENTED && pair_f64_is_finite(&pair)) {
            const oracle_axes apart = oracle_separating(&pair);
            q->truth[i].overlaps = oracle_pair_overlaps(&pair, apart, axes);
            q->truth[i].may_overlap = is_of_floats(q)
                                          ? !box_is_empty(&pair.box)
                                          : q->truth[i].overlaps || oracle_is_near(&pair, apart, axes, ORACLE_NEAR_BITS);
        }
    }
}

static bool is_right(const fuzz_case *q, const tribox_options *o, const truth *t, bool bit)
{
    const bool is_fast = o->accuracy == TRIBOX_FAST && (q->form == ORIENTED || is_of_floats(q));
    if (o->accuracy == TRIBOX_EXACT || (is_fast && q->is_lattice))
        return bit == t->overlaps;
    return bit ? t->may_overlap : is_fast || !t->overlaps;
}

static void check_mask(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    for (size_t i = 0; i < q->count; i++) {
        const unsigned k = (unsigned)(i / q->t.run % q->drawn);
        if (is_right(q, o, &q->truth[k], bit_of(mask, i)))
            continue;
        const pair_f64 pair = pair_of(q, k);
        if (q->form == ORIENTED && are_finite(pair.u[0], 9))
            oriented_explain(stderr, (corners)pair.u, &q->oriented);
        else if (pair_f64_is_finite(&pair))
            oracle_explain(stderr, &pair);
        ensure(false, "form %u, kind %u: bit %zu of %zu is wrong", q->form, q->kind, i, q->count);
    }
}

/* Counts alone, and a mask alone, are those of both. */
static void check_halves(const fuzz_case *q, const tribox_options *o, const uint64_t *mask, const tribox_report *report)
{
    tribox_report alone;
    uint64_t *const again = tight_mask(q->count);
    ensure_status(0, ask(q, o, NULL, &alone));
    ensure(alone.overlapping == report->overlapping && (q->form == ORIENTED || alone.undecided == report->undecided),
           "without a mask it counts otherwise");
    ensure_status(0, ask(q, o, again, NULL));
    ensure(is_same_mask(again, mask, q->count), "without a report it answers otherwise");
}

static void check_find(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    for (int what = TRIBOX_FIRST_HIT; what <= TRIBOX_FIRST_MISS; what++) {
        size_t found;
        ensure_status(0, CALL(find, &q->t, &q->box[0], o, (tribox_find_what)what, &found));
        ensure(found == first_bit(mask, q->count, what == TRIBOX_FIRST_HIT), "kind %u: find %d finds %zu", q->kind, what, found);
    }
}

/*
 * Once with all outputs, once with the masks each alone. What is inside overlaps, even where FAST alone has lost it; FAST may
 * answer words exactly.
 */
static void check_classify(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    const bool is_fast = o->accuracy == TRIBOX_FAST;
    uint64_t *const set = tight_mask(q->count), *const inside = tight_mask(q->count), *const again = tight_mask(q->count);
    tribox_report report;
    ensure_status(0, CALL(classify, &q->t, &q->box[0], o, set, inside, &report));
    ensure(report.overlapping == mask_population(set, q->count), "classify reports %zu overlapping", report.overlapping);
    for (size_t i = 0; i < q->count; i++) {
        const bool is_inside = triangle_is_inside(things_triangle(&q->t, i), &q->box[0]), bit = bit_of(set, i);
        ensure(bit_of(inside, i) == is_inside && (bit || !is_inside), "kind %u: triangle %zu is %sinside", q->kind, i,
               is_inside ? "" : "not ");
        ensure(bit == bit_of(mask, i) || (is_fast && (is_inside || bit == q->truth[i / q->t.run % q->drawn].overlaps)),
               "kind %u: classify and overlap differ about triangle %zu", q->kind, i);
    }
    if (o->kernel != runnable_kernels()[0])
        return;
    ensure_status(0, CALL(classify, &q->t, &q->box[0], o, NULL, again, NULL));
    ensure(is_same_mask(again, inside, q->count), "classify without a mask answers otherwise");
    ensure_status(0, CALL(classify, &q->t, &q->box[0], o, again, NULL, NULL));
    ensure(is_same_mask(again, set, q->count), "classify without inside answers otherwise");
}

static void check_indices(const uint64_t *mask, size_t count)
{
    size_t population = 0, listed = 0;
    for (size_t i = 0; i < count; i++)
        population += bit_of(mask, i);
    uint32_t *const indices = tight_memory(population * sizeof *indices, 0);
    ensure(tribox_mask_indices(mask, count, NULL) == population, "tribox_mask_indices does not count %zu bits", population);
    ensure(tribox_mask_indices(mask, count, indices) == population, "tribox_mask_indices does not list %zu bits", population);
    for (size_t i = 0; i < count; i++)
        if (bit_of(mask, i))
            ensure(indices[listed++] == i, "bit %zu is not listed", i);
}

/* About some of the triangles: streams hold differences from an origin, rounded. With all, a mesh of floats is as its streams. */
static void check_streams(const fuzz_case *q, const tribox_options *o, size_t first, size_t count, unsigned wrong,
                          const uint64_t *mask)
{
    const double *const origin = q->kind >= OF_NARROW ? q->box[0].lo : NULL;
    float *to[9];
    for (int s = 0; s < 9; s++)
        to[s] = tight_stream(count, first % 4);
    ensure_status(wrong, tribox_mesh_to_soup(&q->t.mesh, origin, first, count, o, to, to + 3, to + 6));
    for (size_t s = 0; s < 9; s++) {
        if (wrong)
            ensure_poisoned(to[s], count * sizeof(float));
        for (size_t i = 0; i < count && !wrong; i++) {
            const float is = to[s][i],
                        wanted = (float)(things_triangle(&q->t, first + i)[s % 3][s / 3] - (origin ? origin[s / 3] : 0));
            ensure(isnan(wanted) ? isnan(is) : !memcmp(&wanted, &is, sizeof is), "stream %zu of triangle %zu is %a, not %a", s,
                   first + i, (double)is, (double)wanted);
        }
    }
    if (!mask || q->kind != OF_FLOATS || q->t.mesh.axis_stride > sizeof(float) || q->t.mesh.axes > 123)
        return;
    const tribox_soup soup = {{to[0], to[1], to[2]}, {to[3], to[4], to[5]}, {to[6], to[7], to[8]}, count};
    uint64_t *const again = tight_mask(count);
    ensure_status(0, tribox_overlap(&soup, &q->box[0], o, again, NULL));
    ensure(is_same_mask(again, mask, count), "the answers about a mesh and its streams differ");
}

/* What is counted whatever is wrong. */
static void check_counts(const fuzz_case *q)
{
    const bool is_unknown = q->t.wrong >> TRIBOX_BAD_ARGUMENT & 1;
    size_t dirty = 0, lowest = q->t.count, first;
    if (q->t.is_mesh) {
        const size_t found = tribox_mesh_bad_vertices(&q->t.mesh, &first);
        ensure(found == (is_unknown ? 0 : q->t.bad) && found == tribox_mesh_bad_vertices(&q->t.mesh, NULL) &&
                   first == (is_unknown ? 0 : q->t.first_bad),
               "%zu corners that are no vertices, the first is %zu", found, first);
    }
    if (q->t.wrong)
        return;
    for (size_t i = q->t.count; i-- > 0;)
        if (!are_finite(things_triangle(&q->t, i)[0], 9)) {
            dirty++;
            lowest = i;
        }
    const size_t found = q->t.is_mesh ? tribox_mesh_not_finite(&q->t.mesh, &first) : tribox_soup_not_finite(&q->t.soup, &first);
    ensure(found == dirty && first == lowest, "%zu triangles are not finite, the first is %zu", found, first);
}

static void check_parts(const fuzz_case *q)
{
    const unsigned argument = q->t.wrong & 1u << TRIBOX_BAD_ARGUMENT;
    for (const char *const *kernel = runnable_kernels(); *kernel && q->t.is_mesh && box_is_finite(&q->box[0]); kernel++) {
        const tribox_options o = {.kernel = *kernel};
        bool is_bad = false;
        for (size_t i = q->first; i < q->first + q->part; i++)
            is_bad = is_bad || q->t.is_bad[i / q->t.run % q->t.drawn] || (!q->t.mesh.indices && 3 * i + 3 > q->t.mesh.vertices);
        check_streams(q, &o, q->first, q->part, argument ? argument : is_bad ? 1u << TRIBOX_BAD_VERTEX : 0, NULL);
        check_streams(q, &o, 0, q->t.count, argument ? argument : q->t.wrong, NULL);
    }
}

/* EXACT knows no other unions of axes about an oriented box. */
static bool is_open(const fuzz_case *q, const tribox_options *o)
{
    return q->form == ORIENTED && o->accuracy == TRIBOX_EXACT && o->axes % TRIBOX_AXES_ALL && o->axes != TRIBOX_AXES_BOX;
}

static void check(const void *about, const tribox_options *o)
{
    const fuzz_case *const q = about;
    tribox_report report;
    uint64_t *const mask = tight_mask(q->count);
    if (is_open(q, o)) {
        ensure_status(1u << TRIBOX_BAD_OPTION, ask(q, o, mask, &report));
        return;
    }
    ensure_status(0, ask(q, o, mask, &report));
    ensure(report.overlapping == mask_population(mask, q->count), "%zu overlapping are reported", report.overlapping);
    ensure(report.undecided <= (o->accuracy == TRIBOX_FAST ? 0 : q->count), "%zu of %zu undecided", report.undecided, q->count);
    check_mask(q, o, mask);
    if (o->kernel == runnable_kernels()[0])
        check_halves(q, o, mask, &report);
    if (o->accuracy == TRIBOX_EXACT)
        check_indices(mask, q->count);
    if (q->form == BOX && (!q->t.is_mesh || o->accuracy == TRIBOX_EXACT)) {
        check_find(q, o, mask);
        check_classify(q, o, mask);
    }
    if (q->form == BOX && q->t.is_mesh)
        check_streams(q, o, 0, q->count, 0, mask);
}

static void check_refusals(const fuzz_case *q)
{
    uint64_t *const mask = tight_mask(q->count), *const inside = tight_mask(q->count);
    const tribox_options *const o = &q->options;
    ensure_status(q->wrong | (is_open(q, o) ? 1u << TRIBOX_BAD_OPTION : 0), ask(q, o, mask, NULL));
    if (q->form == BOX)
        ensure_status(q->wrong, CALL(classify, &q->t, &q->box[0], o, mask, inside, NULL));
    ensure_poisoned(mask, tribox_mask_words(q->count) * sizeof *mask);
    ensure_poisoned(inside, tribox_mask_words(q->count) * sizeof *inside);
}

/* A triangle and many boxes. */
static void draw_boxes(input *in, size_t shift, fuzz_case *q)
{
    q->drawn = 1 + input_below(in, DRAWN_MAX);
    for (unsigned i = 1; i < q->drawn; i++)
        q->box[i] = input_box(in);
    q->boxes.count = q->count;
    for (int k = 0; k < 6; k++) {
        float *const stream = tight_stream(q->count, shift);
        for (size_t i = 0; i < q->count; i++)
            stream[i] = (float)(k < 3 ? q->box[i % q->drawn].lo[k] : q->box[i % q->drawn].hi[k - 3]);
        (k < 3 ? q->boxes.lo : q->boxes.hi)[k % 3] = stream;
    }
    for (int k = 0; k < 9; k++)
        q->triangle[k] = (float)q->t.u[0][k / 3][k % 3];
}

static void draw(input *in, fuzz_case *q)
{
    const tribox_options options = input_options(in);
    const unsigned form = input_byte(in);
    *q = (fuzz_case){.form = form % FORMS, .options = options};
    q->kind = q->form == BOXES ? OF_SOUP : form / FORMS % KINDS;
    q->count = q->form == ORIENTED ? input_count(in) % 75 : input_count(in); /* the integers of the library are slow there */
    in->is_wide = form >= FORMS * KINDS * 8 && q->form != BOXES;
    if (q->form == ORIENTED)
        q->oriented = input_oriented(in);
    else
        q->box[0] = input_box(in);
    q->region = q->form == ORIENTED ? (tribox_region){.oriented = &q->oriented} : (tribox_region){.box = &q->box[0]};
    things_draw(in, q->kind, q->count, q->form == ORIENTED ? &q->oriented : NULL, &q->t);
    q->drawn = q->t.drawn;
    if (q->form == BOXES)
        draw_boxes(in, form / FORMS % 4, q);
    q->is_lattice = in->is_lattice && q->form != ORIENTED;
    const bool is_finite = q->form == ORIENTED ? oriented_is_finite(&q->oriented) : q->form == BOXES || box_is_finite(&q->box[0]);
    q->wrong = q->t.wrong | (is_finite ? 0 : 1u << TRIBOX_BAD_BOX);
    q->first = q->t.count ? input_byte(in) % q->t.count : 0;
    q->part = q->t.count ? 1 + input_byte(in) % (q->t.count - q->first) : 0;
}

/* What lies past the count of a mask is ignored. */
static void check_any_indices(input *in)
{
    const size_t count = input_byte(in);
    uint64_t *const mask = tight_mask(count);
    for (size_t w = 0; w < tribox_mask_words(count); w++)
        for (int byte = 0; byte < 8; byte++)
            mask[w] = mask[w] << 8 | input_byte(in);
    check_indices(mask, count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static fuzz_case q;
    input in = input_of(data, size);
    draw(&in, &q);
    check_counts(&q);
    check_parts(&q);
    if (q.wrong)
        check_refusals(&q);
    else {
        find_truths(&q);
        ask_everywhere(q.options, check, &q);
    }
    check_any_indices(&in);
    tight_memory_free_all();
    return 0;
}
