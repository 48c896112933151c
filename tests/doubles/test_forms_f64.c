/*
 * test_forms_f64.c - a mesh of doubles of any layout gives the answers of nine doubles a triangle: every call, every length,
 * nothing read outside it and nothing written outside the answers. Floats, widened or not, give those of the calls about floats.
 */
#include "common/harness.h"
#include "common/ask.h"
#include "common/scenes.h"
#include "inputs/fences.h"
#include "laid_mesh.h"

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
    for (int s = 0; s < 9; s++)
        stream_fence[s] = guarded_make(LAID_MOST * sizeof(float) + 64);
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

/* Of the straightforward layout. */
static void want(size_t count, tribox_accuracy accuracy, unsigned axes, const char *kernel)
{
    const tribox_mesh mesh = {.positions = triangles, .vertices = 3 * count, .count = count, .position_bytes = 8};
    const tribox_options options = {.accuracy = accuracy, .axes = axes, .kernel = kernel};
    say("nine doubles", &mesh, &options);
    assert_int_equal(tribox_mesh_overlap(&mesh, &box, &options, wanted_mask, NULL), TRIBOX_OK);
    memset(wanted_inside, 0, sizeof wanted_inside);
    for (size_t i = 0; i < count; i++) {
        bool is_inside = true;
        for (int k = 0; k < 9; k++) {
            const double x = triangles[i][k / 3][k % 3];
            is_inside = is_inside && x >= box.lo[k % 3] && x <= box.hi[k % 3];
        }
        wanted_inside[i / 64] |= (uint64_t)is_inside << i % 64;
    }
}

static size_t first_bit(const uint64_t *mask, size_t count, bool is_set)
{
    size_t i = 0;
    while (i < count && bit_of(mask, i) != is_set)
        i++;
    return i;
}

static size_t population(const uint64_t *mask, size_t count)
{
    size_t bits = 0;
    for (size_t i = 0; i < count; i++)
        bits += bit_of(mask, i);
    return bits;
}

static void expect_mask(const fenced *got, const uint64_t *wanted, const char *which)
{
    if (got->bytes && memcmp(got->at, wanted, got->bytes))
        fail_msg("%s: the %s differs", doing, which);
    assert_nothing_beside(got);
}

static void expect_report(const fenced *report, size_t count)
{
    const tribox_report *const got = (const tribox_report *)(const void *)report->at;
    if (got->overlapping != population(wanted_mask, count) || got->undecided > count)
        fail_msg("%s: reports %zu, %zu undecided", doing, got->overlapping, got->undecided);
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
    assert_int_equal(alone.overlapping, population(wanted_mask, mesh->count));
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

/* Each stream is the one-line definition; a NaN is any NaN. */
static void check_local_streams(random_source *r, const tribox_mesh *mesh, const char *kernel, int where)
{
    const double from[3] = {draw_from(r, mesh, 0), draw_from(r, mesh, 1), draw_from(r, mesh, 2)};
    const size_t first = random_below(r, mesh->count + 1),
                 count = random_int(r, 2) ? mesh->count - first : random_below(r, mesh->count - first + 1);
    const tribox_options options = {.kernel = kernel};
    fenced stream[9];
    float *to[9];
    for (int s = 0; s < 9; s++) {
        stream[s] = fenced_place(stream_fence[s], count * sizeof(float), where == AT_END ? AT_END : 4 * ((where + s) % 16));
        to[s] = (float *)(void *)stream[s].at;
    }
    say("tribox_mesh_to_soup", mesh, &options);
    assert_int_equal(tribox_mesh_to_soup(mesh, from, first, count, &options, to, to + 3, to + 6), TRIBOX_OK);
    for (int s = 0; s < 9; s++) {
        for (size_t i = 0; i < count; i++) {
            const float wanted = (float)(laid_mesh_number(mesh, 3 * (first + i) + (size_t)s % 3, s / 3) - from[s / 3]);
            if (isnan(wanted) ? !isnan(to[s][i]) : memcmp(&wanted, &to[s][i], sizeof wanted) != 0)
                fail_msg("%s: from %zu, stream %d is %a at %zu, not %a", doing, first, s, (double)to[s][i], i, (double)wanted);
        }
        assert_nothing_beside(&stream[s]);
    }
}

static bool are_floats(size_t count)
{
    for (size_t k = 0; k < 9 * count; k++) {
        const double x = triangles[k / 9][k / 3 % 3][k % 3];
        if ((double)(float)x != x)
            return false;
    }
    return true;
}

/* Every call about one layout of the triangles that were drawn. */
static void check_form(random_source *r, size_t count)
{
    const mesh_form form = mesh_form_draw(r, are_floats(count));
    const int where = random_int(r, 2) ? AT_END : 8 * random_int(r, PLACES);
    const tribox_mesh mesh = laid_mesh_of(r, &form, (const double(*)[3][3])triangles, count, permutations[0], fences);
    for (int k = 0; k < kernels; k++) {
        const unsigned axes = random_int(r, 3) ? TRIBOX_AXES_ALL : (unsigned)random_int_between(r, 1, AXIS_SETS);
        const tribox_options options = {.axes = axes, .kernel = names[k]};
        want(count, TRIBOX_EXACT, axes, names[0]);
        check_overlap(&mesh, &options, where);
        check_classify(&mesh, &options, where);
        check_searches(&mesh, &options);
        check_local_streams(r, &mesh, names[k], where);
    }
}

CASE(test_lengths)
{
    random_source r = random_named(args.seed, "lengths");
    for (int round = arguments_are_short(&args) ? 2 : 0; round < 3; round++)
        for (size_t count = 0; count <= 200; count += count < 140 ? 1 : 7) {
            draw_triangles(&r, count);
            check_form(&r, count);
        }
}

/* About the ends of blocks of any size. */
CASE(test_blocks)
{
    random_source r = random_named(args.seed, "blocks");
    for (size_t block = 256; block <= 4096; block *= 2)
        for (size_t count = block - 1; count <= block + 1; count++) {
            draw_triangles(&r, count);
            check_form(&r, count);
        }
    draw_triangles(&r, LAID_MOST);
    check_form(&r, LAID_MOST);
}

/* Runs of triangles apart from the box, of which one here and there is not. */
CASE(test_beside)
{
    random_source r = random_named(args.seed, "beside");
    for (int round = 0; round < 40; round++) {
        const size_t count = 1 + random_below(&r, round % 4 ? 700 : LAID_MOST);
        draw_triangles(&r, count);
        for (size_t from = 0, end; from < count; from = end) {
            const int a = random_int(&r, 3), side = random_int(&r, 2);
            const double face = side ? box.hi[a] : box.lo[a], beyond = nextafter(face, side ? INFINITY : -INFINITY);
            end = from + 1 + random_below(&r, 300);
            for (size_t i = from; i < end && i < count; i++)
                for (int j = 0; j < 3 && random_int(&r, 150); j++)
                    triangles[i][j][a] = beyond;
        }
        check_form(&r, count);
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

/* A search ends where it has found something, or at the index that names no vertex; for the empty box before it has begun. */
static void check_search_that_may_stop(const tribox_mesh *mesh, const tribox_options *options, tribox_find_what what)
{
    const bool is_empty = box.lo[0] > box.hi[0] || box.lo[1] > box.hi[1] || box.lo[2] > box.hi[2];
    size_t first = 12345;
    const tribox_status status = tribox_mesh_find(mesh, &box, options, what, &first);
    if (status == TRIBOX_BAD_VERTEX)
        assert_int_equal(first, 12345);
    else if (status || first != first_bit(wanted_mask, mesh->count, what == TRIBOX_FIRST_HIT) ||
             (first == mesh->count && !is_empty))
        fail_msg("%s: a search returns %s and finds %zu", doing, tribox_status_text(status), first);
}

/* Indices that reach a part of the vertices, the last of them at the end of memory; others that name one that is not there. */
CASE(test_bad_indices)
{
    random_source r = random_named(args.seed, "bad indices");
    for (int round = 0; round < 100; round++) {
        const size_t count = 1 + random_below(&r, round % 3 ? 150 : LAID_MOST);
        mesh_form form = mesh_form_draw(&r, false);
        form.index_bytes = form.index_bytes ? form.index_bytes : 4;
        form.is_shared = false;
        draw_triangles(&r, count);
        tribox_mesh mesh = laid_mesh_of(&r, &form, (const double(*)[3][3])triangles, count, permutations[0], fences);
        const tribox_options options = {.accuracy = (tribox_accuracy)(round % 3), .kernel = names[round % kernels]};
        want(count, options.accuracy, TRIBOX_AXES_ALL, options.kernel);
        mesh.vertices--;
        const fenced mask = fenced_place(mask_fence, 8 * tribox_mask_words(count), AT_END),
                     inside = fenced_place(inside_fence, 8 * tribox_mask_words(count), AT_END),
                     report = fenced_place(report_fence, sizeof(tribox_report), AT_END);
        uint64_t *const to = (uint64_t *)(void *)mask.at, *const also = (uint64_t *)(void *)inside.at;
        tribox_report *const counts = (tribox_report *)(void *)report.at;
        say("a vertex too few", &mesh, &options);
        assert_int_equal(tribox_mesh_overlap(&mesh, &box, &options, to, counts), TRIBOX_BAD_VERTEX);
        assert_int_equal(tribox_mesh_overlap(&mesh, &box, &options, NULL, counts), TRIBOX_BAD_VERTEX);
        assert_int_equal(tribox_mesh_classify(&mesh, &box, &options, to, also, counts), TRIBOX_BAD_VERTEX);
        check_search_that_may_stop(&mesh, &options, TRIBOX_FIRST_HIT);
        check_search_that_may_stop(&mesh, &options, TRIBOX_FIRST_MISS);
        assert_nothing_written(&mask);
        assert_nothing_written(&inside);
        assert_nothing_written(&report);
    }
}

PROGRAM_AFTER(set_up, RUN(test_lengths), RUN(test_blocks), RUN(test_beside), RUN(test_floats), RUN(test_bad_indices))
