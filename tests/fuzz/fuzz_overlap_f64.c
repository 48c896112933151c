/*
 * fuzz_overlap_f64.c - the calls about meshes of doubles: every layout, in memory of exactly the size that the layout promises;
 * answers against the oracle. Numbers are written in ways of their own (input.h has those of floats).
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "answers.h"
#include "common/oracle_f64.h"
#include "ensure.h"
#include "target.h"
#include "tight_memory.h"

/* The ways in which a number is written; ROUNDED is a known one, off by some of what a float of it rounds. */
enum { EIGHT_BYTES, UNITS, FAR_UNITS, STEPPED, BETWEEN, SPECIAL, EXPONENT, ROUNDED, WAYS, KNOWN = 18 };

typedef struct numbers {
    input *in;
    double unit, known[KNOWN];
    unsigned knowns;
} numbers;

/* A mesh, its triangles as they are meant, and what is wrong with it. */
typedef struct fuzz_case {
    tribox_mesh mesh;
    tribox_box box;
    tribox_options options;
    double u[PAIRS_DRAWN][3][3];
    unsigned drawn, wrong;
} fuzz_case;

static double few(numbers *n) { return ((double)(input_byte(n->in) & 31) - 16) * n->unit; }

static double any_bits(input *in)
{
    uint64_t bits = 0;
    double number;
    for (int k = 0; k < 8; k++)
        bits |= (uint64_t)input_byte(in) << 8 * k;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static double stepped(double number, int steps)
{
    for (; steps > 0; steps--)
        number = nextafter(number, INFINITY);
    for (; steps < 0; steps++)
        number = nextafter(number, -INFINITY);
    return number;
}

static double special(input *in)
{
    static const double table[] = {0,       DBL_MIN, 0x1p-1074, DBL_MAX,  DBL_MAX / 2, 0x1p-36,  0x1p36,   0x1p-200,
                                   0x1p200, 0x1p127, 0x1p-149,  0x1p-150, 1,           0x1p1023, INFINITY, NAN};
    const unsigned choice = input_byte(in);
    const double number = table[choice & 15];
    return choice & 16 ? -number : number;
}

static double far_units(numbers *n)
{
    static const double offsets[] = {0x1p52, 1e7, 0x1p30, 4.6e6, 0x1p24, 0.1, 1e9, 0x1p40};
    const double offset = offsets[input_byte(n->in) & 7];
    return offset + few(n);
}

static double between(numbers *n, double from)
{
    const double to = n->known[input_below(n->in, n->knowns)];
    return from + (to - from) * ((double)input_below(n->in, 9) * 0.25 - 0.5);
}

static double of_exponent(input *in)
{
    const double digits = 1 + (double)(input_byte(in) & 15) / 16;
    return ldexp(digits, (int)(8 * input_byte(in)) - 1022);
}

static double one_number(numbers *n, unsigned way)
{
    const double known = n->known[input_below(n->in, n->knowns)];
    switch (way) {
    case EIGHT_BYTES:
        return any_bits(n->in);
    case UNITS:
        return few(n);
    case FAR_UNITS:
        return far_units(n);
    case STEPPED:
        return stepped(known, (int)input_below(n->in, 7) - 3);
    case BETWEEN:
        return between(n, known);
    case SPECIAL:
        return special(n->in);
    case EXPONENT:
        return of_exponent(n->in);
    default:
        return known + known * ((double)input_below(n->in, 7) - 3) * 0x1p-25;
    }
}

static void draw_numbers(numbers *n, double *to, int count)
{
    const unsigned way = input_below(n->in, WAYS);
    for (int k = 0; k < count; k++) {
        to[k] = one_number(n, way);
        if (n->knowns < KNOWN && isfinite(to[k]))
            n->known[n->knowns++] = to[k];
    }
}

/* Mostly lo <= hi. */
static tribox_box draw_box(numbers *n)
{
    double bound[6];
    tribox_box box;
    draw_numbers(n, bound, 6);
    const unsigned shape = input_byte(n->in);
    for (int a = 0; a < 3; a++) {
        const bool is_turned = bound[a] > bound[3 + a] && shape < 240;
        box.lo[a] = bound[is_turned ? 3 + a : a];
        box.hi[a] = shape >> a & 8 ? box.lo[a] : bound[is_turned ? a : 3 + a];
    }
    return box;
}

static bool is_finite_box(const tribox_box *box)
{
    bool is = true;
    for (int a = 0; a < 3; a++)
        is = is && isfinite(box->lo[a]) && isfinite(box->hi[a]);
    return is;
}

/* The triangles' numbers where the layout has them. With indices vertices are in reverse. */
static void lay_positions(fuzz_case *q, size_t vertices, unsigned choice)
{
    tribox_mesh *const mesh = &q->mesh;
    const bool are_columns = choice % 4 == 3;
    const size_t size = mesh->position_bytes == 8 ? 8 : 4, gap = choice / 4 % 8 * 3;
    mesh->vertices = vertices;
    mesh->stride = are_columns ? size : choice % 4 ? 3 * size + gap : 0;
    mesh->axis_stride = are_columns ? (vertices ? vertices : 1) * size + gap : 0;
    const size_t stride = mesh->stride ? mesh->stride : 3 * size, axis = mesh->axis_stride ? mesh->axis_stride : size;
    unsigned char *const positions = tight_memory(vertices ? (vertices - 1) * stride + 2 * axis + size : 0, choice / 32);
    for (size_t v = 0; v < vertices; v++)
        for (size_t a = 0; a < 3; a++) {
            const size_t from = mesh->index_bytes ? vertices - 1 - v : v;
            const double wide = q->u[from / 3 % q->drawn][from % 3][a];
            const float narrow = (float)wide;
            memcpy(positions + v * stride + a * axis, size == 8 ? (const void *)&wide : &narrow, size);
        }
    mesh->positions = positions;
}

/* Triangle i is drawn triangle i modulo their number. Returns whether one corner names no vertex. */
static bool lay_indices(fuzz_case *q, unsigned choice)
{
    tribox_mesh *const mesh = &q->mesh;
    const size_t corners = 3 * mesh->count, last = 3 * (size_t)q->drawn - 1;
    const bool has_bad = corners && choice >= 250;
    unsigned char *const indices = tight_memory(corners * mesh->index_bytes, choice % 8);
    for (size_t k = 0; k < corners; k++) {
        const uint32_t wide = (uint32_t)(has_bad && k == choice % corners ? last + 1 + choice % 3 : last - k % (last + 1));
        const uint16_t narrow = (uint16_t)wide;
        memcpy(indices + mesh->index_bytes * k, mesh->index_bytes == 2 ? (const void *)&narrow : &wide, mesh->index_bytes);
    }
    mesh->indices = indices;
    return has_bad;
}

/* Floats are what they were rounded to. */
static void round_triangles(fuzz_case *q)
{
    for (unsigned k = 0; k < 9 * q->drawn; k++) {
        double *const x = &q->u[k / 9][k / 3 % 3][k % 3];
        *x = (double)(float)*x;
    }
}

static fuzz_case draw_case(input *in)
{
    static const int exponents[] = {0, -3, 10, -40, 36, -36, 600, -1074};
    static const unsigned widths[] = {0, 2, 4};
    fuzz_case q = {.drawn = 1};
    numbers n = {.in = in, .knowns = 1};
    n.unit = ldexp(1, exponents[input_byte(in) & 7]);
    const drawn_options how = input_options(in);
    q.options = how.options;
    q.box = draw_box(&n);
    q.drawn = 1 + input_below(in, PAIRS_DRAWN);
    for (unsigned i = 0; i < q.drawn; i++)
        draw_numbers(&n, q.u[i][0], 9);
    const unsigned choice = input_byte(in);
    q.mesh.position_bytes = choice % 5 == 4 ? 4 : choice == 255 ? 6 : 8;
    q.mesh.index_bytes = widths[input_below(in, 3)];
    q.mesh.count = q.mesh.index_bytes ? input_count(in) : q.drawn;
    if (q.mesh.position_bytes == 4)
        round_triangles(&q);
    lay_positions(&q, 3 * (size_t)q.drawn, input_byte(in));
    const bool has_bad = q.mesh.index_bytes && lay_indices(&q, input_byte(in));
    q.wrong = how.wrong | (q.mesh.position_bytes == 6 ? 1u << TRIBOX_BAD_ARGUMENT : 0) |
              (is_finite_box(&q.box) ? 0 : 1u << TRIBOX_BAD_BOX) | (has_bad ? 1u << TRIBOX_BAD_VERTEX : 0);
    return q;
}

static void check_refusal(const fuzz_case *q)
{
    const size_t bytes = tribox_mask_words(q->mesh.count) * sizeof(uint64_t);
    uint64_t *const mask = tight_mask(q->mesh.count);
    tribox_report report;
    memset(&report, POISON, sizeof report);
    status_fits("tribox_mesh_overlap", q->wrong, tribox_mesh_overlap(&q->mesh, &q->box, &q->options, mask, &report));
    ensure(is_poisoned(mask, bytes) && is_poisoned(&report, sizeof report), "tribox_mesh_overlap writes although it refuses");
}

static pair_f64 pair_of(const fuzz_case *q, size_t i)
{
    pair_f64 pair = {.box = q->box};
    memcpy(pair.u, q->u[i % q->drawn], sizeof pair.u);
    return pair;
}

/* What one kernel answers at one accuracy, triangle by triangle. */
static void check_mask(const fuzz_case *q, const tribox_options *o, const oracle_axes *truth, const uint64_t *mask)
{
    const bool are_floats = q->mesh.position_bytes != sizeof(double) && q->mesh.axis_stride <= sizeof(float);
    if (o->accuracy == TRIBOX_FAST && are_floats) /* as of a soup: it errs either way */
        return;
    for (size_t i = 0; i < q->mesh.count; i++) {
        const pair_f64 pair = pair_of(q, i);
        const bool overlaps = oracle_overlaps_f64(&pair, truth[i % q->drawn], o->axes ? o->axes : TRIBOX_AXES_ALL);
        const bool is_right =
            mask_bit(mask, i) == overlaps || (o->accuracy != TRIBOX_EXACT && !overlaps &&
                                              oracle_is_near_f64(&pair, truth[i % q->drawn], o->axes ? o->axes : TRIBOX_AXES_ALL));
        if (!is_right)
            oracle_explain_f64(stderr, &pair);
        ensure(is_right, "kernel %s, accuracy %d, axes %u: the answer for triangle %zu is wrong", o->kernel, (int)o->accuracy,
               o->axes, i);
    }
}

/* Searches and those inside agree with the mask. */
static void check_others(const fuzz_case *q, const tribox_options *o, const uint64_t *mask)
{
    const size_t count = q->mesh.count;
    uint64_t *const again = tight_mask(count), *const inside = tight_mask(count);
    size_t set = 0, clear = 0, first;
    while (set < count && !mask_bit(mask, set))
        set++;
    while (clear < count && mask_bit(mask, clear))
        clear++;
    status_fits("tribox_mesh_find", 0, tribox_mesh_find(&q->mesh, &q->box, o, TRIBOX_FIRST_HIT, &first));
    ensure(first == set, "tribox_mesh_find finds %zu, not %zu", first, set);
    status_fits("tribox_mesh_find", 0, tribox_mesh_find(&q->mesh, &q->box, o, TRIBOX_FIRST_MISS, &first));
    ensure(first == clear, "tribox_mesh_find finds %zu, not %zu", first, clear);
    status_fits("tribox_mesh_classify", 0, tribox_mesh_classify(&q->mesh, &q->box, o, again, inside, NULL));
    ensure(!memcmp(again, mask, 8 * tribox_mask_words(count)), "tribox_mesh_classify has another mask");
    for (size_t i = 0; i < count; i++) {
        const pair_f64 pair = pair_of(q, i);
        bool is_inside = true;
        for (int k = 0; k < 9; k++)
            is_inside = is_inside && pair.u[k / 3][k % 3] >= pair.box.lo[k % 3] && pair.u[k / 3][k % 3] <= pair.box.hi[k % 3];
        ensure(mask_bit(inside, i) == is_inside, "tribox_mesh_classify: triangle %zu is %sinside", i, is_inside ? "" : "not ");
    }
}

static void check_streams(const fuzz_case *q, const char *kernel)
{
    const size_t count = q->mesh.count;
    float *to[9];
    for (int s = 0; s < 9; s++)
        to[s] = tight_memory(count * sizeof(float), 0);
    status_fits("tribox_mesh_to_soup", 0,
                tribox_mesh_to_soup(&q->mesh, q->box.lo, 0, count, &(tribox_options){.kernel = kernel}, to, to + 3, to + 6));
    for (size_t k = 0; k < 9 * count; k++) {
        const size_t i = k / 9, s = k % 9;
        const float wanted = (float)(q->u[i % q->drawn][s % 3][s / 3] - q->box.lo[s / 3]);
        ensure(isnan(wanted) ? isnan(to[s][i]) : !memcmp(&wanted, &to[s][i], sizeof wanted),
               "kernel %s: stream %zu of triangle %zu is %a, not %a", kernel, s, i, (double)to[s][i], (double)wanted);
    }
}

static void check_answers(const fuzz_case *q)
{
    oracle_axes truth[PAIRS_DRAWN];
    tribox_options o = q->options;
    for (unsigned i = 0; i < q->drawn; i++) {
        const pair_f64 pair = pair_of(q, i);
        truth[i] = pair_f64_is_finite(&pair) ? oracle_separating_f64(&pair) : (oracle_axes){0, 0};
    }
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++) {
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            uint64_t *const mask = tight_mask(q->mesh.count);
            tribox_report report;
            o.kernel = *kernel;
            o.accuracy = (tribox_accuracy)accuracy;
            status_fits("tribox_mesh_overlap", 0, tribox_mesh_overlap(&q->mesh, &q->box, &o, mask, &report));
            check_mask(q, &o, truth, mask);
            ensure(report.overlapping == mask_population("tribox_mesh_overlap", mask, q->mesh.count) &&
                       report.undecided <= q->mesh.count,
                   "reports %zu, %zu undecided", report.overlapping, report.undecided);
            if (accuracy == TRIBOX_EXACT)
                check_others(q, &o, mask);
        }
        check_streams(q, *kernel);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    const fuzz_case q = draw_case(&in);
    if (q.wrong)
        check_refusal(&q);
    else
        check_answers(&q);
    tight_memory_free_all();
    return 0;
}
