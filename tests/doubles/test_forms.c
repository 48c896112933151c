/*
 * test_forms.c - a mesh of any layout gives the answers of nine doubles a triangle: every call, every length, nothing read outside
 * it and nothing written outside the answers. Floats, widened or not, give those of the calls about floats; and rows of floats are
 * the streams of their triangles, bit for bit, at every accuracy.
 */
#include <math.h>

#include "common/ask.h"
#include "common/fences.h"
#include "common/harness.h"
#include "common/laid_mesh.h"
#include "common/scenes.h"
#include "common/soup_or_mesh.h"
#include "scenes_f64.h"

enum { WORDS = LAID_MOST / 64 + 1, PLACES = 8 };

static laid_fences fences;
static guarded mask_fence, inside_fence, report_fence, stream_fence[9];

static double triangles[LAID_MOST][3][3];
static tribox_box box;
static uint64_t wanted_mask[WORDS], wanted_inside[WORDS];

static int set_up(void)
{
    fences = laid_fences_make(args.seed);
    mask_fence = guarded_make(WORDS * sizeof(uint64_t) + 64);
    inside_fence = guarded_make(WORDS * sizeof(uint64_t) + 64);
    report_fence = guarded_make(sizeof(tribox_report) + 64);
    stream_fences_make(LAID_MOST, stream_fence);
    return 0;
}

static void say(const char *call, const tribox_mesh *mesh, const tribox_options *options)
{
    char text[LAID_TEXT];
    snprintf(doing, sizeof doing, "%s, %s, accuracy %d, axes %u, %s", call, options->kernel, (int)options->accuracy, options->axes,
             laid_mesh_text(mesh, text));
}

/* Triangles of any scene, some of them with a number that is none; their box is that of the first batch. */
static void draw_triangles(random_source *r, size_t count)
{
    static batch_f64 batch;
    const scene_f64 *const drawn = scene_f64_at(random_below(r, scene_f64_count()));
    for (size_t i = 0; i < count; i++) {
        if (i % BATCH_F64 == 0)
            drawn->draw(r, &batch);
        if (i == 0)
            box = batch.box;
        memcpy(triangles[i], batch.u[i % BATCH_F64], sizeof triangles[i]);
    }
    for (int times = random_int(r, 3) ? 0 : 3; count && times > 0; times--)
        triangles[random_below(r, count)][random_int(r, 3)][random_int(r, 3)] = random_int(r, 2) ? (double)NAN : (double)-INFINITY;
}

/* Floats on a lattice about a box, so that contact is common; now and then any bits at all. */
static void draw_floats(random_source *r, size_t count)
{
    static const tribox_box boxes[] = {{{-1, -1, -1}, {1, 1, 1}}, {{-0.75, -2, 0}, {0.5, 0.25, 0}}, {{0, 1, 0}, {1, 0, 1}}};
    box = boxes[random_int(r, 3)];
    for (size_t n = 0; n < 9 * count; n++) {
        const uint32_t bits = (uint32_t)random_bits(r);
        float any;
        memcpy(&any, &bits, sizeof any);
        triangles[n / 9][n / 3 % 3][n % 3] = random_int(r, 100) ? 0.25 * random_int_between(r, -9, 9) : (double)any;
    }
}

/* Of the straightforward layout. */
static void want(size_t count, tribox_accuracy accuracy, unsigned axes, const char *kernel)
{
    const tribox_mesh mesh = {.positions = triangles, .vertices = 3 * count, .count = count, .position_bytes = 8};
    const tribox_options options = {.accuracy = accuracy, .axes = axes, .kernel = kernel};
    say("nine doubles", &mesh, &options);
    assert_int_equal(tribox_mesh_overlap(&mesh, &box, &options, wanted_mask, NULL), TRIBOX_OK);
    memset(wanted_inside, 0, sizeof wanted_inside);
    for (size_t i = 0; i < count; i++)
        wanted_inside[i / 64] |= (uint64_t)triangle_is_inside((const double(*)[3])triangles[i], &box) << i % 64;
}

static void expect_mask(const fenced *got, const uint64_t *wanted, const char *which)
{
    if (got->bytes && memcmp(got->at, wanted, got->bytes))
        fail_msg("%s: the %s differs", doing, which);
    assert_nothing_beside(got);
}

static void expect_report(const fenced *report, size_t count)
{
    assert_report((const tribox_report *)(const void *)report->at, wanted_mask, count, TRIBOX_EXACT);
    assert_nothing_beside(report);
}

static void check_overlap(const tribox_mesh *mesh, const tribox_options *options, int where)
{
    const fenced mask = fenced_place(mask_fence, 8 * tribox_mask_words(mesh->count), where),
                 report = fenced_place(report_fence, sizeof(tribox_report), where);
    say("tribox_mesh_overlap", mesh, options);
    assert_int_equal(tribox_mesh_overlap(mesh, &box, options, (uint64_t *)(void *)mask.at, (tribox_report *)(void *)report.at),
                     TRIBOX_OK);
    expect_mask(&mask, wanted_mask, "mask");
    expect_report(&report, mesh->count);
    tribox_report alone;
    assert_int_equal(tribox_mesh_overlap(mesh, &box, options, NULL, &alone), TRIBOX_OK);
    assert_int_equal(alone.overlapping, bits_set(wanted_mask, tribox_mask_words(mesh->count)));
}

static void check_classify(const tribox_mesh *mesh, const tribox_options *options, int where)
{
    const size_t bytes = 8 * tribox_mask_words(mesh->count);
    const fenced mask = fenced_place(mask_fence, bytes, where), inside = fenced_place(inside_fence, bytes, where),
                 report = fenced_place(report_fence, sizeof(tribox_report), where);
    say("tribox_mesh_classify", mesh, options);
    assert_int_equal(tribox_mesh_classify(mesh, &box, options, (uint64_t *)(void *)mask.at, (uint64_t *)(void *)inside.at,
                                          (tribox_report *)(void *)report.at),
                     TRIBOX_OK);
    expect_mask(&mask, wanted_mask, "mask");
    expect_mask(&inside, wanted_inside, "mask of those inside");
    expect_report(&report, mesh->count);
}

static void check_searches(const tribox_mesh *mesh, const tribox_options *options)
{
    size_t first = SIZE_MAX;
    say("tribox_mesh_find, a hit", mesh, options);
    assert_int_equal(tribox_mesh_find(mesh, &box, options, TRIBOX_FIRST_HIT, &first), TRIBOX_OK);
    if (first != first_bit(wanted_mask, mesh->count, true))
        fail_msg("%s: finds %zu", doing, first);
    say("tribox_mesh_find, a miss", mesh, options);
    assert_int_equal(tribox_mesh_find(mesh, &box, options, TRIBOX_FIRST_MISS, &first), TRIBOX_OK);
    if (first != first_bit(wanted_mask, mesh->count, false))
        fail_msg("%s: finds %zu", doing, first);
}

static double draw_from(random_source *r, const tribox_mesh *mesh, int a)
{
    const double numbers[] = {0, -0.0, box.lo[a], 4.6e6, 1e-300, -1.7e308, triangles[mesh->count / 2][1][a], 0.1};
    const double x = numbers[random_int(r, 8)];
    return isfinite(x) ? x : 0;
}

static float numbers[9][LAID_MOST];

/* Some triangles as streams: from an origin the one-line definition, where a NaN is any NaN; without one `numbers`, bit for bit. */
static void check_streams(const tribox_mesh *mesh, const double *from, const char *kernel, size_t first, size_t count, int where)
{
    const tribox_options options = {.kernel = kernel};
    fenced stream[9];
    float *to[9];
    streams_place(stream_fence, count, where, stream, to);
    say("tribox_mesh_to_soup", mesh, &options);
    assert_int_equal(tribox_mesh_to_soup(mesh, from, first, count, &options, to, to + 3, to + 6), TRIBOX_OK);
    for (int s = 0; s < 9; s++) {
        for (size_t i = 0; i < count; i++) {
            const size_t corner = 3 * (first + i) + (size_t)s % 3;
            const float wanted = from ? (float)(mesh_number(mesh, corner, s / 3) - from[s / 3]) : numbers[s][first + i];
            if (from && isnan(wanted) ? !isnan(to[s][i]) : memcmp(&wanted, &to[s][i], sizeof wanted) != 0)
                fail_msg("%s: from %zu, stream %d is %a at %zu, not %a", doing, first, s, (double)to[s][i], i, (double)wanted);
        }
        assert_nothing_beside(&stream[s]);
    }
}

static void check_local_streams(random_source *r, const tribox_mesh *mesh, const char *kernel, int where)
{
    const double from[3] = {draw_from(r, mesh, 0), draw_from(r, mesh, 1), draw_from(r, mesh, 2)};
    const size_t first = random_below(r, mesh->count + 1),
                 count = random_int(r, 2) ? mesh->count - first : random_below(r, mesh->count - first + 1);
    check_streams(mesh, from, kernel, first, count, where);
}

static bool are_floats(size_t count)
{
    bool are = true;
    for (size_t k = 0; k < 9 * count; k++) {
        const double x = triangles[k / 9][k / 3 % 3][k % 3];
        are = are && (isnan(x) || (double)(float)x == x);
    }
    return are;
}

/* What is undecided may depend on the blocks, and hardly does. Ties of a soup may be known at EXACT. */
static bool is_about(size_t undecided, size_t wanted, tribox_accuracy accuracy)
{
    return undecided + 8 >= wanted - wanted / 8 && (accuracy == TRIBOX_EXACT || undecided <= wanted + wanted / 8 + 8);
}

/* The same mask as of the streams, and nearly the same report. */
static void check_as_soup(const tribox_mesh *mesh, const tribox_options *options)
{
    const tribox_soup soup = soup_of_rows(numbers[0], LAID_MOST, mesh->count);
    const size_t bytes = 8 * tribox_mask_words(mesh->count);
    const fenced mask = fenced_place(mask_fence, bytes, AT_END);
    uint64_t wanted[WORDS];
    tribox_report due, got, alone;
    assert_int_equal(tribox_overlap(&soup, &box, options, wanted, &due), TRIBOX_OK);
    say("tribox_mesh_overlap", mesh, options);
    assert_int_equal(tribox_mesh_overlap(mesh, &box, options, (uint64_t *)(void *)mask.at, &got), TRIBOX_OK);
    expect_mask(&mask, wanted, "mask of the soup");
    if (got.overlapping != due.overlapping || !is_about(got.undecided, due.undecided, options->accuracy))
        fail_msg("%s: reports %zu of %zu, %zu of about %zu undecided", doing, got.overlapping, due.overlapping, got.undecided,
                 due.undecided);
    assert_int_equal(tribox_mesh_overlap(mesh, &box, options, NULL, &alone), TRIBOX_OK);
    assert_memory_equal(&alone, &got, sizeof alone);
}

static void check_rows_of_floats(random_source *r, const tribox_mesh *mesh, int where)
{
    const size_t count = mesh->count;
    for (size_t n = 0; n < 9 * count; n++)
        numbers[n % 9][n / 9] = mesh_float(mesh, n / 9 * 3 + n % 3, (int)(n % 9 / 3));
    for (int k = 0; k < kernels; k++) {
        const size_t first = random_below(r, count + 1), part = random_below(r, count - first + 1);
        check_streams(mesh, NULL, names[k], 0, count, where);
        check_streams(mesh, NULL, names[k], first, part, where);
        check_streams(mesh, NULL, names[k], first, count - first, where);
        check_as_soup(mesh, &(tribox_options){.kernel = names[k]});
        check_as_soup(mesh, &(tribox_options){.accuracy = (tribox_accuracy)random_int(r, 3),
                                              .axes = (unsigned)random_int(r, 8),
                                              .axis_order = axis_order_at(random_int(r, AXIS_ORDERS)),
                                              .kernel = names[k]});
    }
}

/* Every call about one layout of the triangles that were drawn, or by some patterns of those that their vertices make. */
static void check_laid(random_source *r, size_t count, const mesh_form *form)
{
    const int where = random_int(r, 2) ? AT_END : 8 * random_int(r, PLACES);
    const tribox_mesh mesh = laid_mesh_of(r, form, (const double(*)[3][3])triangles, count, permutations[0], fences);
    size_t first_bad = 12345;
    for (size_t n = 0; n < 9 * count; n++)
        triangles[n / 9][n / 3 % 3][n % 3] = mesh_number(&mesh, n / 3, (int)(n % 3));
    assert_int_equal(tribox_mesh_bad_vertices(&mesh, &first_bad), 0);
    assert_int_equal(first_bad, 3 * count);
    for (int k = 0; k < kernels; k++) {
        const unsigned axes = random_int(r, 3) ? TRIBOX_AXES_ALL : (unsigned)random_int_between(r, 1, AXIS_SETS);
        const tribox_options options = {.axes = axes, .kernel = names[k]};
        want(count, TRIBOX_EXACT, axes, names[0]);
        check_overlap(&mesh, &options, where);
        check_classify(&mesh, &options, where);
        check_searches(&mesh, &options);
        check_local_streams(r, &mesh, names[k], where);
    }
    if (mesh.position_bytes != 8 && mesh.axis_stride <= sizeof(float) && (!mesh.axes || mesh.axes == 123))
        check_rows_of_floats(r, &mesh, where);
}

static void check_form(random_source *r, size_t count)
{
    mesh_form form = mesh_form_draw(r, are_floats(count));
    form.pattern = random_int(r, 2) ? PATTERN_EACH : (index_pattern)random_int(r, INDEX_PATTERNS);
    check_laid(r, count, &form);
}

static void draw_any(random_source *r, size_t count)
{
    if (random_int(r, 2))
        draw_triangles(r, count);
    else
        draw_floats(r, count);
}

CASE(test_lengths)
{
    random_source r = random_named(args.seed, "lengths");
    for (int round = arguments_are_short(&args) ? 2 : 0; round < 6; round++)
        for (size_t count = 0; count <= 200; count += count < 140 ? 1 : 7) {
            draw_any(&r, count);
            check_form(&r, count);
        }
}

/* Rows of floats of every stride and number of bytes between them. */
CASE(test_strides)
{
    static const size_t gaps[] = {0, 1, 3, 4, 8, 12, 20, 24, 4084, 4087};
    const size_t step = arguments_are_short(&args) ? 7 : 1; /* each count with some of them all the same */
    random_source r = random_named(args.seed, "strides");
    for (size_t g = 0; g < sizeof gaps / sizeof gaps[0]; g++)
        for (unsigned index_bytes = 0; index_bytes <= 4; index_bytes += 2)
            for (size_t count = (g + index_bytes) % step; count <= 200; count += step) {
                const mesh_form form = {.position_bytes = 4,
                                        .index_bytes = index_bytes,
                                        .gap = gaps[g],
                                        .pattern = (index_pattern)random_int(&r, INDEX_PATTERNS),
                                        .shift = random_int(&r, 2) ? 0 : random_int_between(&r, 1, 3),
                                        .is_at_end = random_int(&r, 2)};
                draw_floats(&r, count);
                check_laid(&r, count, &form);
            }
}

/* Each pattern with nothing between the last vertex, the last index and the page after them. */
CASE(test_patterns)
{
    static const size_t counts[] = {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 80, 127, 128, 129, 200};
    static const size_t gaps[] = {0, 1, 4, 24};
    const size_t step = arguments_are_short(&args) ? 3 : 1;
    random_source r = random_named(args.seed, "patterns");
    for (int n = 0; n < 4 * 2 * 2 * INDEX_PATTERNS; n++)
        for (size_t c = (size_t)n % step; c < sizeof counts / sizeof counts[0]; c += step) {
            const mesh_form form = {.position_bytes = 4,
                                    .index_bytes = n / 4 % 2 ? 2 : 4,
                                    .gap = gaps[n % 4],
                                    .pattern = (index_pattern)(n / 16),
                                    .is_at_end = n / 8 % 2};
            draw_floats(&r, counts[c]);
            check_laid(&r, counts[c], &form);
        }
}

/* Every range of a mesh that starts and ends anywhere in the first words. */
CASE(test_ranges)
{
    enum { COUNT = 150 };
    const size_t step = arguments_are_short(&args) ? 7 : 1;
    random_source r = random_named(args.seed, "ranges");
    for (unsigned b = 0; b < 3; b++) {
        const mesh_form form = {
            .position_bytes = 4, .index_bytes = 2 * b, .gap = 4 * b, .pattern = PATTERN_ANY, .shift = (int)b, .is_at_end = b % 2};
        draw_floats(&r, COUNT);
        const tribox_mesh mesh = laid_mesh_of(&r, &form, (const double(*)[3][3])triangles, COUNT, permutations[0], fences);
        check_rows_of_floats(&r, &mesh, AT_END);
        for (size_t first = 0; first <= COUNT; first += step)
            for (size_t count = 0; count <= COUNT - first; count += count < 70 ? 1 : 7)
                check_streams(&mesh, NULL, names[(first + count) % (size_t)kernels], first, count,
                              count % 2 ? AT_END : (int)(first % 16));
    }
}

/* So many vertices that what lies ahead is fetched; 2-byte indices reach a part of them. */
CASE(test_more_vertices_than_named)
{
    random_source r = random_named(args.seed, "more vertices");
    for (unsigned n = 0; n < 6; n++) {
        const mesh_form form = {.position_bytes = n % 2 ? 8 : 4, .index_bytes = n / 2 * 2, .pattern = PATTERN_ANY};
        draw_floats(&r, LAID_MOST);
        tribox_mesh mesh = laid_mesh_of(&r, &form, (const double(*)[3][3])triangles, LAID_MOST, permutations[0], fences);
        mesh.vertices = 1 << 20;
        if (form.index_bytes)
            mesh_set_index(&mesh, 3 * LAID_MOST - 1, 65535);
        for (size_t k = 0; k < 9 * LAID_MOST; k++)
            triangles[k / 9][k / 3 % 3][k % 3] = mesh_number(&mesh, k / 3, (int)(k % 3));
        for (int k = 0; k < kernels; k++) {
            want(LAID_MOST, TRIBOX_EXACT, TRIBOX_AXES_ALL, names[0]);
            check_overlap(&mesh, &(tribox_options){.axes = TRIBOX_AXES_ALL, .kernel = names[k]}, AT_END);
        }
        if (mesh.position_bytes == 4)
            check_rows_of_floats(&r, &mesh, AT_END);
    }
}

/* About the ends of blocks of any size. */
CASE(test_blocks)
{
    random_source r = random_named(args.seed, "blocks");
    for (size_t block = 256; block <= 4096; block *= 2)
        for (size_t n = 0; n < 18; n++) {
            const size_t count = block - 1 + n % 3;
            draw_any(&r, count);
            check_form(&r, count);
        }
    draw_triangles(&r, LAID_MOST);
    check_form(&r, LAID_MOST);
}

/* Runs of triangles apart from the box, of which one here and there is not. */
CASE(test_beside)
{
    random_source r = random_named(args.seed, "beside");
    for (int round = 0; round < (arguments_are_short(&args) ? 40 : 160); round++) {
        const size_t count = 1 + random_below(&r, round % 4 ? 700 : LAID_MOST);
        draw_any(&r, count);
        const bool is_float = are_floats(count);
        for (size_t from = 0, end; from < count; from = end) {
            const int a = random_int(&r, 3), side = random_int(&r, 2);
            const double face = side ? box.hi[a] : box.lo[a], out = side ? INFINITY : -INFINITY;
            const double beyond = is_float ? (double)nextafterf((float)face, (float)out) : nextafter(face, out);
            end = from + 1 + random_below(&r, 300);
            for (size_t i = from; i < end && i < count; i++)
                for (int j = 0; j < 3 && random_int(&r, 150); j++)
                    triangles[i][j][a] = random_int(&r, 900) ? beyond : (double)NAN;
        }
        mesh_form form = mesh_form_draw(&r, is_float);
        form.pattern = random_int(&r, 2) ? PATTERN_NEAR : PATTERN_ORDER;
        check_laid(&r, count, &form);
    }
}

static const size_t laid_counts[] = {1, 5, 64, 100};

/* All scenes of floats: widened, and as they are, against the calls about floats. */
CASE(test_floats)
{
    static scene_batch batch;
    random_source r = random_named(args.seed, "floats");
    for (size_t s = 0; s < scene_count(); s++)
        for (int round = 0; round < (arguments_are_short(&args) ? 1 : 3); round++) {
            scene_draw_batch(scene_at(s), &r, &batch);
            const size_t count = laid_counts[random_int(&r, 4)];
            for (int a = 0; a < 3; a++) {
                box.lo[a] = (double)batch.box.lo[a];
                box.hi[a] = (double)batch.box.hi[a];
                for (size_t k = 0; k < 3 * count; k++)
                    triangles[k / 3][k % 3][a] = (double)batch.u[k / 3][k % 3][a];
            }
            const tribox_mesh floats = {.positions = batch.u, .vertices = 3 * count, .count = count};
            for (int k = 0; k < kernels; k++) {
                const tribox_options options = {.axes = (unsigned)random_int_between(&r, 1, AXIS_SETS), .kernel = names[k]};
                const mesh_form form = mesh_form_draw(&r, true);
                const tribox_mesh mesh = laid_mesh_of(&r, &form, (const double(*)[3][3])triangles, count, permutations[0], fences);
                assert_int_equal(tribox_mesh_overlap(&floats, &batch.box, &options, wanted_mask, NULL), TRIBOX_OK);
                check_overlap(&mesh, &options, AT_END);
                check_searches(&mesh, &options);
            }
        }
}

enum { WINDOW_TRIANGLES = 60000, WINDOW_VERTICES = 150000 };

/* Numbers that mostly grow, some behind by less than 2^16 or more, and runs from anywhere, above all about multiples of 2^16. */
static size_t draw_far_number(random_source *r, size_t i, size_t run)
{
    const size_t base = i * (WINDOW_VERTICES - 100) / WINDOW_TRIANGLES, behind = (size_t)random_int(r, 80000);
    if (run)
        return run - (size_t)random_int(r, 60);
    return random_int(r, 400) == 0 && behind < base ? base - behind : base + (size_t)random_int(r, 100);
}

static struct {
    float positions[WINDOW_VERTICES][3], apart[WINDOW_VERTICES][5], stream[9][WINDOW_TRIANGLES];
    double wide[WINDOW_VERTICES][3];
    uint32_t indices[WINDOW_TRIANGLES][3];
    uint16_t narrow[WINDOW_TRIANGLES][3];
    uint64_t mask[2][WINDOW_TRIANGLES / 64 + 1], inside[2][WINDOW_TRIANGLES / 64 + 1];
} window;

static void draw_window(random_source *r)
{
    for (size_t n = 0; n < 3 * (size_t)WINDOW_VERTICES; n++) {
        const float number = (float)(random_int_between(r, -9, 9) / 10.0), not_finite[] = {NAN, INFINITY, -INFINITY};
        window.positions[n / 3][n % 3] = random_int(r, 500) ? number : not_finite[random_int(r, 3)];
        window.wide[n / 3][n % 3] = window.apart[n / 3][n % 3] = window.positions[n / 3][n % 3];
    }
    for (size_t i = 0, run = 0; i < WINDOW_TRIANGLES; i++) {
        if (i % 512 == 0)
            run = random_int(r, 4) ? 0 : 60 + (size_t)random_int(r, 3) * 65536;
        else if (i % 512 == 256 && run)
            run += 4; /* to the end of the window, which is a multiple of 64 */
        for (size_t v = 0; v < 3; v++)
            window.narrow[i][v] = (uint16_t)(window.indices[i][v] = (uint32_t)draw_far_number(r, i, run));
    }
}

/* The streams' answers, and a mesh of which the last triangle names no vertex changes nothing. */
static void check_window(const tribox_soup *soup, tribox_mesh mesh, const tribox_box *asked, const tribox_options *options)
{
    say("a mesh of many vertices", &mesh, options);
    size_t at[2];
    assert_int_equal(tribox_classify(soup, asked, options, window.mask[0], window.inside[0], NULL), TRIBOX_OK);
    assert_int_equal(tribox_mesh_classify(&mesh, asked, options, window.mask[1], window.inside[1], NULL), TRIBOX_OK);
    assert_memory_equal(window.inside[1], window.inside[0], sizeof window.inside[0]);
    if (options->accuracy != TRIBOX_FAST) /* which may answer parts as EXACT does */
        assert_memory_equal(window.mask[1], window.mask[0], sizeof window.mask[0]);
    for (int what = 0; what < 2; what++) {
        assert_int_equal(tribox_find(soup, asked, options, (tribox_find_what)what, &at[0]), TRIBOX_OK);
        assert_int_equal(tribox_mesh_find(&mesh, asked, options, (tribox_find_what)what, &at[1]), TRIBOX_OK);
        assert_int_equal(at[0], at[1]);
    }
    memset(window.mask[1], POISON, sizeof window.mask[1]);
    memcpy(window.inside[0], window.mask[1], sizeof window.inside[0]);
    window.indices[WINDOW_TRIANGLES - 1][1] += WINDOW_VERTICES;
    if (mesh.index_bytes == 4)
        assert_int_equal(tribox_mesh_overlap(&mesh, asked, options, window.mask[1], NULL), TRIBOX_BAD_VERTEX);
    assert_memory_equal(window.mask[1], window.inside[0], sizeof window.mask[1]);
    window.indices[WINDOW_TRIANGLES - 1][1] -= WINDOW_VERTICES;
    assert_int_equal(tribox_overlap(soup, asked, options, window.mask[0], NULL), TRIBOX_OK);
    assert_int_equal(tribox_mesh_overlap(&mesh, asked, options, window.mask[1], NULL), TRIBOX_OK);
    assert_memory_equal(window.mask[1], window.mask[0], sizeof window.mask[0]);
}

/* Far more vertices than any room for what is known of each, or with 16-bit indices just as many. */
CASE(test_windows)
{
    random_source r = random_named(args.seed, "windows");
    const tribox_box boxes_asked[] = {{{-0.3F, -0.4F, -0.7F}, {0.3F, 0.6F, 0.7F}}, {{-0.8F, -0.8F, -0.9F}, {0.9F, 0.8F, 0.8F}}};
    draw_window(&r);
    for (int k = 0; k < 12 * kernels; k++) {
        const bool is_narrow = k / 6 % 2;
        const void *const positions[] = {window.positions, window.apart, window.wide};
        const tribox_options options = {.kernel = names[k / 12], .accuracy = (tribox_accuracy)(k % 3 < 2 ? random_int(&r, 3) : 0)};
        const tribox_mesh mesh = {.positions = positions[k % 3],
                                  .vertices = is_narrow ? 65536 : WINDOW_VERTICES,
                                  .indices = is_narrow ? (const void *)window.narrow : window.indices,
                                  .index_bytes = is_narrow ? 2 : 4,
                                  .count = WINDOW_TRIANGLES,
                                  .stride = k % 3 == 1 ? sizeof window.apart[0] : 0,
                                  .position_bytes = k % 3 == 2 ? 8 : 4};
        float *to[9];
        for (int s = 0; s < 9; s++)
            to[s] = window.stream[s];
        assert_int_equal(tribox_mesh_to_soup(&mesh, NULL, 0, mesh.count, NULL, to, to + 3, to + 6), TRIBOX_OK);
        const tribox_soup soup = {{to[0], to[1], to[2]}, {to[3], to[4], to[5]}, {to[6], to[7], to[8]}, mesh.count};
        check_window(&soup, mesh, &boxes_asked[k / 3 % 2], &options);
    }
}

PROGRAM_AFTER(set_up, RUN(test_lengths), RUN(test_strides), RUN(test_patterns), RUN(test_ranges),
              RUN(test_more_vertices_than_named), RUN(test_windows), RUN(test_blocks), RUN(test_beside), RUN(test_floats))
