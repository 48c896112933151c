/*
 * test_indexed.c - a mesh of any layout is the streams of its triangles: the same numbers bit for bit, and the same answers.
 *
 * Positions and indices end at a page that cannot be touched, or begin at one.
 */
#include <math.h>

#include "common/harness.h"
#include "fences.h"
#include "mesh_layout.h"
#include "pair_list.h"

static mesh_fences fences;

static float numbers[9][LAID_TRIANGLES];
static float *const expected[9] = {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4],
                                   numbers[5], numbers[6], numbers[7], numbers[8]};

static const tribox_box boxes[] = {{{-1, -1, -1}, {1, 1, 1}}, {{-0.75f, -2, 0}, {0.5f, 0.25f, 0}}, {{0, 1, 0}, {1, 0, 1}}};

static void say(const char *call, const tribox_mesh *mesh, const tribox_options *options, size_t first, size_t count)
{
    char text[MESH_TEXT];
    static const char *const accuracy[] = {"EXACT", "CONSERVATIVE", "FAST"};
    const char *const kernel = options->kernel ? options->kernel : "the best kernel";
    snprintf(doing, sizeof doing, "%s, %s, triangles %zu + %zu of %s", call, kernel, first, count, mesh_text(mesh, text));
    const size_t length = strlen(doing);
    snprintf(doing + length, sizeof doing - length, ", %s %u %u", accuracy[options->accuracy], options->axes, options->axis_order);
}

/* Some triangles as streams, each at a place of its own. `expected` holds those of the whole mesh. */
static void check_streams(const tribox_mesh *mesh, const tribox_options *options, size_t first, size_t count, int place)
{
    fenced stream[9];
    float *to[9];
    for (int s = 0; s < 9; s++) {
        stream[s] = fenced_place(fences.stream[s], count * sizeof(float), place == AT_END ? AT_END : 4 * ((place + s) % 16));
        to[s] = (float *)(void *)stream[s].at;
    }
    say("tribox_mesh_to_soup", mesh, options, first, count);
    const tribox_status status = tribox_mesh_to_soup(mesh, NULL, first, count, options, to, to + 3, to + 6);
    if (status)
        fail_msg("%s: %s", doing, tribox_status_text(status));
    for (int s = 0; s < 9; s++) {
        if (count && memcmp(to[s], expected[s] + first, count * sizeof(float)))
            fail_msg("%s: stream %d differs", doing, s);
        assert_nothing_beside(&stream[s]);
    }
}

static tribox_soup expected_soup(size_t count)
{
    return (tribox_soup){{expected[0], expected[1], expected[2]},
                         {expected[3], expected[4], expected[5]},
                         {expected[6], expected[7], expected[8]},
                         count};
}

/* What is undecided may depend on the blocks, and hardly does. Ties of a soup may be known at EXACT. */
static bool is_about(size_t undecided, size_t wanted, tribox_accuracy accuracy)
{
    return undecided + 8 >= wanted - wanted / 8 && (accuracy == TRIBOX_EXACT || undecided <= wanted + wanted / 8 + 8);
}

static void check_answers(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, int place)
{
    const tribox_soup soup = expected_soup(mesh->count);
    const size_t bytes = tribox_mask_words(mesh->count) * sizeof(uint64_t);
    uint64_t want[LAID_WORDS];
    tribox_report wanted;
    assert_int_equal(tribox_overlap(&soup, box, options, want, &wanted), TRIBOX_OK);

    const fenced mask = fenced_place(fences.mask, bytes, place == AT_END ? AT_END : 8 * (place % 8));
    const fenced report = fenced_place(fences.report, sizeof wanted, place == AT_END ? AT_END : 0);
    say("tribox_mesh_overlap", mesh, options, 0, mesh->count);
    const tribox_status status =
        tribox_mesh_overlap(mesh, box, options, (uint64_t *)(void *)mask.at, (tribox_report *)(void *)report.at);
    if (status)
        fail_msg("%s: %s", doing, tribox_status_text(status));
    if (bytes && memcmp(mask.at, want, bytes))
        fail_msg("%s: the mask differs", doing);
    const tribox_report *const got = (const tribox_report *)(const void *)report.at;
    if (got->overlapping != wanted.overlapping || !is_about(got->undecided, wanted.undecided, options->accuracy))
        fail_msg("%s: reports %zu of %zu, %zu of about %zu undecided", doing, got->overlapping, wanted.overlapping, got->undecided,
                 wanted.undecided);
    assert_nothing_beside(&mask);
    assert_nothing_beside(&report);

    tribox_report alone;
    assert_int_equal(tribox_mesh_overlap(mesh, box, options, NULL, &alone), TRIBOX_OK);
    assert_memory_equal(&alone, got, sizeof alone);
}

static tribox_options draw_options(random_source *r, const char *kernel)
{
    static const unsigned orders[] = {0, 123, 132, 213, 231, 312, 321};
    return (tribox_options){.accuracy = (tribox_accuracy)random_int(r, 3),
                            .axes = (unsigned)random_int(r, 8),
                            .axis_order = orders[random_int(r, 7)],
                            .kernel = kernel};
}

static void check_mesh(random_source *r, const tribox_mesh *mesh, int place)
{
    size_t first_bad = 12345;
    mesh_expect(mesh, 0, mesh->count, expected);
    say("tribox_mesh_bad_vertices", mesh, &(tribox_options){0}, 0, mesh->count);
    assert_int_equal(tribox_mesh_bad_vertices(mesh, &first_bad), 0);
    assert_int_equal(first_bad, 3 * mesh->count);
    for (int k = 0; k < kernels; k++) {
        const size_t first = mesh->count ? (size_t)random_int(r, (int)mesh->count) : 0,
                     count = (size_t)random_int(r, (int)(mesh->count - first) + 1);
        check_streams(mesh, &(tribox_options){.kernel = names[k]}, 0, mesh->count, place);
        check_streams(mesh, &(tribox_options){.kernel = names[k]}, first, count, place);
        check_streams(mesh, &(tribox_options){.kernel = names[k]}, first, mesh->count - first, place);
        check_answers(mesh, &boxes[0], &(tribox_options){.kernel = names[k]}, place);
        const tribox_options any = draw_options(r, names[k]);
        check_answers(mesh, &boxes[random_int(r, sizeof boxes / sizeof boxes[0])], &any, place);
    }
}

static const unsigned index_sizes[] = {0, 2, 4};

/* Every small count in every stride; patterns, places and alignments change from one to the next. */
CASE(test_small_counts)
{
    static const size_t strides[] = {0, 12, 13, 15, 16, 20, 24, 32, 36, 4096, 4099};
    const size_t step = arguments_are_short(&args) ? 7 : 1; /* 33 starts of every seven: every count all the same */
    random_source r = random_named(args.seed, "small counts");
    for (size_t s = 0; s < sizeof strides / sizeof strides[0]; s++)
        for (int b = 0; b < 3; b++)
            for (size_t count = (s + (size_t)b) % step; count <= 200; count += step) {
                const int turn = random_int(&r, 16);
                const layout l = {count,
                                  index_sizes[b],
                                  strides[s],
                                  (index_pattern)random_int(&r, INDEX_PATTERNS),
                                  random_int(&r, 2) ? 0 : random_int_between(&r, 1, 3),
                                  turn % 2};
                const tribox_mesh mesh = mesh_lay(&r, &l, fences);
                check_mesh(&r, &mesh, turn < 4 ? AT_END : turn);
            }
}

/* Each pattern with nothing between the last vertex, the last index and the page after them. */
CASE(test_patterns)
{
    static const size_t counts[] = {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 80, 127, 128, 129, 200};
    static const size_t strides[] = {12, 13, 16, 36};
    const size_t step = arguments_are_short(&args) ? 3 : 1;
    random_source r = random_named(args.seed, "patterns");
    for (size_t s = 0; s < sizeof strides / sizeof strides[0]; s++)
        for (index_pattern pattern = 0; pattern < INDEX_PATTERNS; pattern++)
            for (int b = 1; b < 3; b++)
                for (size_t c = (size_t)pattern % step; c < sizeof counts / sizeof counts[0]; c += step)
                    for (int is_at_end = 0; is_at_end < 2; is_at_end++) {
                        const layout l = {counts[c], index_sizes[b], strides[s], pattern, 0, is_at_end};
                        const tribox_mesh mesh = mesh_lay(&r, &l, fences);
                        check_mesh(&r, &mesh, AT_END);
                    }
}

/* Blocks of any power of two up to 4096, less one and more one. */
CASE(test_edges_of_blocks)
{
    random_source r = random_named(args.seed, "edges of blocks");
    for (size_t block = 256; block <= 4096; block *= 2)
        for (size_t count = block - 1; count <= block + 1; count++)
            for (int b = 0; b < 3; b++)
                for (int is_at_end = 0; is_at_end < 2; is_at_end++) {
                    const layout l = {count,
                                      index_sizes[b],
                                      (size_t)random_int_between(&r, 12, 40),
                                      (index_pattern)random_int(&r, INDEX_PATTERNS),
                                      random_int(&r, 4),
                                      is_at_end};
                    const tribox_mesh mesh = mesh_lay(&r, &l, fences);
                    check_mesh(&r, &mesh, is_at_end ? AT_END : 3);
                }
}

/* Every range of a mesh that starts and ends anywhere in the first words. */
CASE(test_ranges)
{
    enum { COUNT = 150 };
    const size_t step = arguments_are_short(&args) ? 7 : 1;
    random_source r = random_named(args.seed, "ranges");
    for (int b = 0; b < 3; b++) {
        const layout l = {COUNT, index_sizes[b], 12 + 4 * (size_t)b, PATTERN_ANY, b, b % 2};
        const tribox_mesh mesh = mesh_lay(&r, &l, fences);
        mesh_expect(&mesh, 0, COUNT, expected);
        for (size_t first = 0; first <= COUNT; first += step)
            for (size_t count = 0; count <= COUNT - first; count += count < 70 ? 1 : 7)
                check_streams(&mesh, &(tribox_options){.kernel = names[(first + count) % (size_t)kernels]}, first, count,
                              count % 2 ? AT_END : (int)(first % 16));
    }
}

/* Words of triangles apart from the box, and others of which one vertex alone is not: nothing may be left out too much. */
CASE(test_beside)
{
    random_source r = random_named(args.seed, "beside");
    for (int round = 0; round < (arguments_are_short(&args) ? 24 : 120); round++) {
        const layout l = {round % 4 ? (size_t)random_int_between(&r, 1, 700) : (size_t)random_int_between(&r, 4000, LAID_TRIANGLES),
                          index_sizes[round % 3],
                          round % 8 ? 12 : 16,
                          random_int(&r, 3) ? PATTERN_NEAR : (index_pattern)random_int(&r, INDEX_PATTERNS),
                          round % 5 ? 0 : 2,
                          random_int(&r, 2)};
        const tribox_mesh mesh = mesh_lay(&r, &l, fences);
        mesh_move_beside(&r, &mesh, &boxes[0]);
        check_mesh(&r, &mesh, AT_END);
        for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++)
            check_answers(&mesh, &boxes[0],
                          &(tribox_options){.accuracy = (tribox_accuracy)(axes % 3),
                                            .axes = axes,
                                            .axis_order = 0,
                                            .kernel = names[(axes + (size_t)round) % (size_t)kernels]},
                          AT_END);
    }
}

/* A mesh without indices may have more vertices than it needs; 2-byte indices reach a part of a larger mesh. */
CASE(test_more_vertices_than_named)
{
    random_source r = random_named(args.seed, "more vertices");
    for (int b = 0; b < 3; b++) {
        const layout l = {LAID_TRIANGLES, index_sizes[b], 12, PATTERN_ANY, 0, false};
        tribox_mesh mesh = mesh_lay(&r, &l, fences);
        mesh.vertices = 70000;
        for (size_t corner = 0; b && corner < 3 * mesh.count; corner++)
            mesh_set_number(&mesh, corner, (size_t)random_int(&r, 65536));
        if (b)
            mesh_set_number(&mesh, 3 * mesh.count - 1, 65535);
        check_mesh(&r, &mesh, AT_END);
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
static void check_window(const tribox_soup *soup, tribox_mesh mesh, const tribox_box *box, const tribox_options *options)
{
    say("a mesh of many vertices", &mesh, options, 0, mesh.count);
    size_t at[2];
    assert_int_equal(tribox_classify(soup, box, options, window.mask[0], window.inside[0], NULL), TRIBOX_OK);
    assert_int_equal(tribox_mesh_classify(&mesh, box, options, window.mask[1], window.inside[1], NULL), TRIBOX_OK);
    assert_memory_equal(window.inside[1], window.inside[0], sizeof window.inside[0]);
    if (options->accuracy != TRIBOX_FAST) /* which may answer parts as EXACT does */
        assert_memory_equal(window.mask[1], window.mask[0], sizeof window.mask[0]);
    for (int what = 0; what < 2; what++) {
        assert_int_equal(tribox_find(soup, box, options, (tribox_find_what)what, &at[0]), TRIBOX_OK);
        assert_int_equal(tribox_mesh_find(&mesh, box, options, (tribox_find_what)what, &at[1]), TRIBOX_OK);
        assert_int_equal(at[0], at[1]);
    }
    memset(window.mask[1], POISON, sizeof window.mask[1]);
    memcpy(window.inside[0], window.mask[1], sizeof window.inside[0]);
    window.indices[WINDOW_TRIANGLES - 1][1] += WINDOW_VERTICES;
    if (mesh.index_bytes == 4)
        assert_int_equal(tribox_mesh_overlap(&mesh, box, options, window.mask[1], NULL), TRIBOX_BAD_VERTEX);
    assert_memory_equal(window.mask[1], window.inside[0], sizeof window.mask[1]);
    window.indices[WINDOW_TRIANGLES - 1][1] -= WINDOW_VERTICES;
    assert_int_equal(tribox_overlap(soup, box, options, window.mask[0], NULL), TRIBOX_OK);
    assert_int_equal(tribox_mesh_overlap(&mesh, box, options, window.mask[1], NULL), TRIBOX_OK);
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

static int set_up(void)
{
    fences = mesh_fences_make(args.seed);
    return 0;
}

PROGRAM_AFTER(set_up, RUN(test_small_counts), RUN(test_patterns), RUN(test_edges_of_blocks), RUN(test_ranges),
              RUN(test_more_vertices_than_named), RUN(test_beside), RUN(test_windows))
