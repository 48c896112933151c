/* test_bad_indices.c - an index that names no vertex is reported, counted and found wherever it stands, and nothing is written. */
#include "common/fences.h"
#include "common/guarded_pages.h"
#include "common/harness.h"
#include "common/laid_mesh.h"
#include "common/window_bits.h"
#include "dispatch.h"

static laid_fences fences;
static guarded stream_fence[9], mask_fence, inside_fence;

static const tribox_box cube = {{-1, -1, -1}, {1, 1, 1}}, far = {{1e37f, 1e37f, 1e37f}, {2e37f, 2e37f, 2e37f}};

static const tribox_oriented_box turned = {{0, 0, 0}, {1, 1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                                 empty = {{0, 0, 0}, {1, -1, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

static void say(const char *call, const char *kernel, const tribox_mesh *mesh)
{
    char text[LAID_TEXT];
    snprintf(doing, sizeof doing, "%s, %s, %s", call, kernel, laid_mesh_text(mesh, text));
}

static void expect_refusal(tribox_status status)
{
    if (status != TRIBOX_BAD_VERTEX)
        fail_msg("%s: %s", doing, tribox_status_text(status));
}

static tribox_status make_streams(const tribox_mesh *mesh, size_t first, size_t count, const char *kernel, fenced stream[9])
{
    float *to[9];
    streams_place(stream_fence, count, AT_END, stream, to);
    say("tribox_mesh_to_soup", kernel, mesh);
    return tribox_mesh_to_soup(mesh, NULL, first, count, &(tribox_options){.kernel = kernel}, to, to + 3, to + 6);
}

static void check_streams_refused(const tribox_mesh *mesh, size_t first, size_t count, const char *kernel)
{
    fenced stream[9];
    expect_refusal(make_streams(mesh, first, count, kernel, stream));
    for (int s = 0; s < 9; s++)
        assert_nothing_written(&stream[s]);
}

/* The indices outside of the range are not read. */
static void check_streams_made(const tribox_mesh *mesh, size_t first, size_t count, const char *kernel)
{
    fenced stream[9];
    if (make_streams(mesh, first, count, kernel, stream))
        fail_msg("%s: triangles %zu + %zu are refused", doing, first, count);
}

static void check_answers_refused(const tribox_mesh *mesh, const char *kernel)
{
    static const tribox_report poison = {12345, 67890};
    const size_t bytes = tribox_mask_words(mesh->count) * sizeof(uint64_t);
    const fenced mask = fenced_place(mask_fence, bytes, AT_END), inside = fenced_place(inside_fence, bytes, AT_END);
    uint64_t *const to = (uint64_t *)(void *)mask.at, *const also = (uint64_t *)(void *)inside.at;
    const tribox_options options = {.accuracy = (tribox_accuracy)(mesh->count % 3), .kernel = kernel};
    tribox_report report = poison;
    say("an answer", kernel, mesh);
    expect_refusal(tribox_mesh_overlap(mesh, &cube, &options, to, &report));
    expect_refusal(tribox_mesh_overlap(mesh, &cube, &options, NULL, NULL));
    expect_refusal(tribox_mesh_overlap(mesh, &far, &options, NULL, NULL));
    expect_refusal(tribox_mesh_classify(mesh, &cube, &options, to, also, &report));
    expect_refusal(tribox_mesh_overlap_oriented(mesh, &turned, &options, to, &report));
    expect_refusal(tribox_mesh_overlap_oriented(mesh, &empty, &options, NULL, NULL));
    assert_nothing_written(&mask);
    assert_nothing_written(&inside);
    assert_memory_equal(&report, &poison, sizeof poison);
}

/* A search ends at the index, unless it has found something before it. */
static void check_searches(const tribox_mesh *mesh, const uint64_t *wanted, size_t bad, const char *kernel)
{
    for (int what = TRIBOX_FIRST_HIT; what <= TRIBOX_FIRST_MISS; what++) {
        size_t found = 12345;
        const size_t due = first_bit(wanted, mesh->count, what == TRIBOX_FIRST_HIT);
        say("tribox_mesh_find", kernel, mesh);
        const tribox_status status =
            tribox_mesh_find(mesh, &cube, &(tribox_options){.kernel = kernel}, (tribox_find_what)what, &found);
        if (status == TRIBOX_BAD_VERTEX ? found != 12345 : status || found != due || due >= bad)
            fail_msg("%s: %s, %zu found", doing, tribox_status_text(status), found);
    }
}

static void check_found(const tribox_mesh *mesh, size_t count, size_t first)
{
    size_t found = 12345;
    say("tribox_mesh_bad_vertices", "any kernel", mesh);
    assert_int_equal(tribox_mesh_bad_vertices(mesh, &found), count);
    assert_int_equal(found, first);
    assert_int_equal(tribox_mesh_bad_vertices(mesh, NULL), count);
}

/* One bad index, at `corner`. */
static void check_corner(const tribox_mesh *mesh, size_t corner, size_t number)
{
    const size_t right = mesh_index(mesh, corner), triangle = corner / 3;
    uint64_t wanted[LAID_MOST / 64 + 1];
    assert_int_equal(tribox_mesh_overlap(mesh, &cube, NULL, wanted, NULL), TRIBOX_OK);
    mesh_set_index(mesh, corner, number);
    check_found(mesh, 1, corner);
    for (int k = 0; k < kernels; k++) {
        check_answers_refused(mesh, names[k]);
        check_searches(mesh, wanted, triangle, names[k]);
        check_streams_refused(mesh, 0, mesh->count, names[k]);
        check_streams_refused(mesh, triangle, 1, names[k]);
        check_streams_made(mesh, 0, triangle, names[k]);
        check_streams_made(mesh, triangle + 1, mesh->count - triangle - 1, names[k]);
    }
    mesh_set_index(mesh, corner, right);
}

/* Numbers that are just too large, and as large as they can be; also where the sign bit of a narrower number would be. */
static size_t draw_bad_number(random_source *r, const tribox_mesh *mesh)
{
    static const size_t wide[] = {65536, 0x7fffffff, 0x80000000u, 0x80000001u, 0xffff0000u, 0xfffffffeu, 0xffffffffu};
    static const size_t narrow[] = {0x7fff, 0x8000, 0x8001, 0xff00, 0xfffe, 0xffff};
    const size_t any = mesh->index_bytes == 2 ? narrow[random_int(r, 6)] : wide[random_int(r, 7)];
    return random_int(r, 2) || any < mesh->vertices ? mesh->vertices : any;
}

/* On a lattice about the box, in any layout. */
static tribox_mesh any_mesh(random_source *r, size_t count, unsigned index_bytes)
{
    static double u[LAID_MOST][3][3];
    mesh_form form = mesh_form_draw(r, true);
    form.index_bytes = index_bytes;
    form.pattern = (index_pattern)random_int(r, INDEX_PATTERNS);
    form.is_shared = false;
    for (size_t n = 0; n < 9 * count; n++)
        u[n / 9][n / 3 % 3][n % 3] = 0.25 * random_int_between(r, -9, 9);
    return laid_mesh_of(r, &form, (const double(*)[3][3])u, count, (const int[]){0, 1, 2}, fences);
}

/* Each corner in turn. */
CASE(test_each_corner)
{
    static const size_t counts[] = {1, 2, 3, 17, 63, 64, 65, 66, 130};
    random_source r = random_named(args.seed, "each corner");
    for (unsigned bytes = 2; bytes <= 4; bytes += 2)
        for (size_t c = 0; c < sizeof counts / sizeof counts[0]; c++) {
            const tribox_mesh mesh = any_mesh(&r, counts[c], bytes);
            for (size_t corner = 0; corner < 3 * mesh.count; corner++)
                check_corner(&mesh, corner, draw_bad_number(&r, &mesh));
        }
}

/* About the ends of blocks, whatever they are. */
CASE(test_edges_of_blocks)
{
    random_source r = random_named(args.seed, "edges of blocks");
    for (unsigned bytes = 2; bytes <= 4; bytes += 2)
        for (size_t block = 256; block <= 4096; block *= 2) {
            const tribox_mesh mesh = any_mesh(&r, block + 1 + (size_t)random_int(&r, 70), bytes);
            for (size_t triangle = block - 1; triangle <= block; triangle++)
                check_corner(&mesh, 3 * triangle + (size_t)random_int(&r, 3), draw_bad_number(&r, &mesh));
            check_corner(&mesh, 3 * mesh.count - 1, draw_bad_number(&r, &mesh));
        }
}

/* Any number of bad indices, all of them included. */
CASE(test_many)
{
    random_source r = random_named(args.seed, "many");
    for (unsigned bytes = 2; bytes <= 4; bytes += 2)
        for (int times = 0; times < 200; times++) {
            const tribox_mesh mesh = any_mesh(&r, 1 + (size_t)random_int(&r, 200), bytes);
            const int share = random_int(&r, 5);
            size_t count = 0, first = 0;
            for (size_t corner = 3 * mesh.count; corner-- > 0;)
                if (random_int(&r, 4) < share) {
                    mesh_set_index(&mesh, corner, draw_bad_number(&r, &mesh));
                    count++;
                    first = corner;
                }
            check_found(&mesh, count, count ? first : 3 * mesh.count);
            if (count)
                check_answers_refused(&mesh, names[times % kernels]);
        }
}

/* Without indices it is the vertices that are too few. */
CASE(test_too_few_vertices)
{
    random_source r = random_named(args.seed, "too few");
    for (size_t count = 1; count <= 200; count++) {
        tribox_mesh mesh = any_mesh(&r, count, 0);
        const size_t missing = count % 2 ? 1 + count % 5 % 3 : 1 + (size_t)random_int(&r, (int)(3 * count));
        mesh.vertices = 3 * count - missing;
        check_found(&mesh, missing, mesh.vertices);
        for (int k = 0; k < kernels; k++) {
            check_answers_refused(&mesh, names[k]);
            check_streams_refused(&mesh, mesh.vertices / 3, count - mesh.vertices / 3, names[k]);
            check_streams_made(&mesh, 0, mesh.vertices / 3, names[k]);
        }
    }
}

/* The answers of whole words, from calls that ask few triangles each. */
static void answer_in_parts(const tribox_mesh *mesh, const char *kernel, uint64_t *mask)
{
    enum { PART = 4096 };
    for (size_t first = 0; first < mesh->count; first += PART) {
        tribox_mesh part = *mesh;
        part.indices = (const uint16_t *)mesh->indices + 3 * first;
        part.count = mesh->count - first < PART ? mesh->count - first : PART;
        assert_int_equal(tribox_mesh_overlap(&part, &cube, &(tribox_options){.kernel = kernel}, mask + first / 64, NULL),
                         TRIBOX_OK);
    }
}

/* So many triangles that all indices are checked before any is answered, and one less: nothing is written either way. */
CASE(test_very_many)
{
    enum { VERTICES = 999, MANY = 131072, WORDS = MANY / 64 + 2 };
    static uint64_t mask[WORDS], want[WORDS], poison[WORDS];
    static uint16_t indices[3 * (MANY + 65)];
    static float positions[VERTICES][3];
    random_source r = random_named(args.seed, "very many");
    memset(poison, 0xa5, sizeof poison);
    for (int v = 0; v < VERTICES; v++)
        for (int a = 0; a < 3; a++)
            positions[v][a] = 0.25f * (float)random_int_between(&r, -9, 9);
    for (size_t corner = 0; corner < sizeof indices / sizeof indices[0]; corner++)
        indices[corner] = (uint16_t)random_int(&r, VERTICES);
    for (size_t count = MANY - 1; count <= MANY + 65; count += count == MANY + 1 ? 64 : 1) {
        const tribox_mesh mesh = {
            .positions = positions, .vertices = VERTICES, .indices = indices, .index_bytes = 2, .count = count};
        const size_t bytes = tribox_mask_words(count) * sizeof *mask, corner = 3 * count - 1 - (size_t)random_int(&r, 300);
        for (int k = 0; k < kernels; k++) {
            say("tribox_mesh_overlap", names[k], &mesh);
            memcpy(mask, poison, sizeof mask);
            indices[corner] = VERTICES;
            expect_refusal(tribox_mesh_overlap(&mesh, &cube, &(tribox_options){.kernel = names[k]}, mask, NULL));
            assert_memory_equal(mask, poison, sizeof mask);
            indices[corner] = VERTICES - 1;
            assert_int_equal(tribox_mesh_overlap(&mesh, &cube, &(tribox_options){.kernel = names[k]}, mask, NULL), TRIBOX_OK);
            answer_in_parts(&mesh, names[k], want);
            assert_memory_equal(mask, want, bytes);
            assert_memory_equal((char *)mask + bytes, (char *)poison + bytes, sizeof mask - bytes);
        }
    }
}

/* No vertex at all: every index is bad. */
CASE(test_no_vertices)
{
    random_source r = random_named(args.seed, "no vertices");
    for (unsigned bytes = 0; bytes <= 4; bytes += 2) {
        tribox_mesh mesh = any_mesh(&r, 70, bytes);
        mesh.vertices = 0;
        check_found(&mesh, 210, 0);
        for (int k = 0; k < kernels; k++) {
            check_answers_refused(&mesh, names[k]);
            check_streams_refused(&mesh, 69, 1, names[k]);
            check_streams_made(&mesh, 70, 0, names[k]);
        }
    }
}

/* A count that is garbage, without indices: what is missing can be told without a look at each corner. */
CASE(test_garbage_count)
{
    random_source r = random_named(args.seed, "garbage count");
    tribox_mesh mesh = any_mesh(&r, 10, 0);
    mesh.vertices = 30;
    mesh.count = PTRDIFF_MAX / 36;
    check_found(&mesh, 3 * mesh.count - 30, 30);
}

#if SIZE_MAX > 0xffffffffu
/* Corners without indices whose numbers are those of vertices but for what 32 bits cut off: an index may lead to any triangle. */
CASE(test_corners_beyond_32_bits)
{
    static const float positions[4 * 80];
    for (unsigned bytes = 4; bytes <= 8; bytes += 4)
        for (size_t first = ((size_t)1 << 32) / 3 - 1; first < ((size_t)1 << 32) / 3 + 2; first++) {
            const tribox_mesh mesh = {
                .positions = positions, .stride = 4 * bytes, .vertices = 40, .count = first + 9, .position_bytes = bytes};
            for (int k = 0; k < kernels; k++) {
                uint32_t offset[27];
                tribox_corners corners;
                assert_int_equal(tribox_kernel_find(names[k])->find_corners(&mesh, first, 9, offset, &corners), 3 * first + 26);
            }
        }
}

static size_t page_of(size_t byte, size_t page) { return byte / page * page; }

/*
 * As many vertices as 32 bits can name, of which a few lie in memory that may be touched: neither numbers nor places are ever taken
 * for signed, or for narrower than they are.
 */
CASE(test_greatest_numbers)
{
    static const uint32_t number[] = {0,          1,          0x15555555, 0x2aaaaaaa, 0x55555555, 0x7fffffff,
                                      0x80000000, 0x80000001, 0xaaaaaaaa, 0xd5555555, 0xfffffffe, 0xffffffff};
    enum { NUMBERS = sizeof number / sizeof number[0], CORNERS = 3 * 150 };
    const size_t page = page_size(), vertices = (size_t)1 << 32, bytes = 12 * vertices;
    unsigned char *const all = pages_reserve(bytes);
    if (!all) {
        print_message("no %zu bytes of addresses here\n", bytes);
        skip();
    }
    random_source r = random_named(args.seed, "greatest");
    for (int n = 0; n < NUMBERS; n++) {
        const size_t at = 12 * (size_t)number[n], from = page_of(at, page), end = page_of(at + 15, page) + page;
        assert_true(pages_allow(all + from, (end < bytes ? end : bytes) - from, PAGES_OPEN));
        const float position[3] = {(float)n, 0, random_int(&r, 2) ? 2 : 0};
        memcpy(all + at, position, sizeof position);
    }
    uint32_t indices[CORNERS];
    const tribox_mesh mesh = {
        .positions = all, .stride = 12, .vertices = vertices, .indices = indices, .index_bytes = 4, .count = CORNERS / 3};
    for (int round = 0; round < 20; round++) {
        for (int c = 0; c < CORNERS; c++)
            indices[c] = number[random_int(&r, NUMBERS - (round % 2))];
        check_found(&mesh, 0, CORNERS);
        for (int k = 0; k < kernels; k++) {
            float got[9][CORNERS / 3], want[9][CORNERS / 3];
            float *const x[3] = {got[0], got[1], got[2]}, *const y[3] = {got[3], got[4], got[5]},
                         *const z[3] = {got[6], got[7], got[8]};
            for (size_t n = 0; n < 3 * CORNERS; n++)
                want[n % 9][n / 9] = (float)mesh_number(&mesh, n / 9 * 3 + n % 3, (int)(n % 9 / 3));
            say("tribox_mesh_to_soup", names[k], &mesh);
            assert_int_equal(tribox_mesh_to_soup(&mesh, NULL, 0, mesh.count, &(tribox_options){.kernel = names[k]}, x, y, z),
                             TRIBOX_OK);
            assert_memory_equal(got, want, sizeof got);
        }
        tribox_mesh less = mesh;
        less.vertices--;
        indices[random_int(&r, CORNERS)] = 0xffffffff;
        for (int k = 0; k < kernels; k++)
            check_answers_refused(&less, names[k]);
    }
    pages_release(all, bytes);
}
#else
CASE(test_corners_beyond_32_bits) { skip(); }

CASE(test_greatest_numbers) { skip(); }
#endif

static int set_up(void)
{
    fences = laid_fences_make(args.seed);
    stream_fences_make(LAID_MOST, stream_fence);
    mask_fence = guarded_make((LAID_MOST / 64 + 1) * sizeof(uint64_t));
    inside_fence = guarded_make((LAID_MOST / 64 + 1) * sizeof(uint64_t));
    return 0;
}

PROGRAM_AFTER(set_up, RUN(test_each_corner), RUN(test_edges_of_blocks), RUN(test_many), RUN(test_too_few_vertices),
              RUN(test_no_vertices), RUN(test_greatest_numbers), RUN(test_garbage_count), RUN(test_very_many),
              RUN(test_corners_beyond_32_bits))
