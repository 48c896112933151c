/*
 * test_forms.c - all forms of a question answer alike, and as the calls without an index do, bit by bit: soups, and meshes of
 * floats and of doubles in every layout, anywhere; hostile triangles and boxes, every kernel, accuracy and set of axes. An index's
 * bytes do not hang on layout and kernel; what is apart or inside is not read; a mesh that has changed since is safe.
 */
#include <math.h>

#include "common/harness.h"
#include "common/fences.h"
#include "hostile.h"
#include "forms.h"
#include "index/local_bounds.h"

enum { TRIANGLES = 2000, LARGE = 64 * TRIBOX_INDEX_BLOCK + 100, BOXES = 20, PAIRS_A_QUESTION = 5 };

static int make_all(void)
{
    stored_mesh_make(LARGE);
    return index_fixture_make(LARGE, BOXES);
}

static void draw_mesh(random_source *r, const soup_kind *kind, size_t count)
{
    draw_stored(r, kind, count);
    const mesh_layout layout = draw_layout(r, count);
    stored_mesh_lay(r, &layout);
    stored_build(names[random_int(r, kernels)]);
}

static void ask_all(random_source *r, const tribox_box *about, const char *name)
{
    const tribox_box box = box_in_place(r, about);
    const tribox_options options = any_index_options(r);
    char what[128];
    snprintf(what, sizeof what, "%s, %s of %u bytes, numbers of %u, scale %g, offset %g", name, stored.index.mesh ? "mesh" : "soup",
             stored.layout.form.position_bytes, stored.layout.form.index_bytes, stored.layout.place.scale,
             stored.layout.place.offset[0]);
    check_forms(&box, &options, what);
}

/* Boxes as streams, valid until the next. */
static tribox_boxes streams_of(const tribox_box *box, size_t count)
{
    static float bound[6][BOXES];
    tribox_boxes boxes = {.count = count};
    for (int k = 0; k < 6; k++) {
        for (size_t b = 0; b < count; b++)
            bound[k][b] = (float)(k < 3 ? box[b].lo[k] : box[b].hi[k - 3]);
        (k < 3 ? boxes.lo : boxes.hi)[k % 3] = bound[k];
    }
    return boxes;
}

/* Mostly some words: a question about them has all there is, but for a second level of nodes. Some boxes, and the same at once. */
CASE(test_hostile)
{
    const size_t rounds = arguments_rounds(&args, soup_kind_count() * BOXES * PAIRS_A_QUESTION);
    for (size_t k = 0; k < soup_kind_count(); k++) {
        random_source r = random_named(args.seed, soup_kind_at(k)->name);
        for (size_t round = 0; round < rounds; round++) {
            tribox_box box[BOXES];
            draw_stored_form(&r, soup_kind_at(k), (size_t)random_int(&r, random_int(&r, 12) ? 301 : TRIANGLES + 1));
            for (int b = 0; b < BOXES; b++) {
                box[b] = draw_box(&r);
                ask_all(&r, &box[b], soup_kind_at(k)->name);
            }
            const tribox_boxes boxes = streams_of(box, BOXES);
            const tribox_options options = any_index_options(&r);
            check_lists(&boxes, &options, soup_kind_at(k)->name);
        }
    }
}

/* Scenes of pairs that are hard to tell, with every option there is, as soups and as meshes. */
CASE(test_scenes)
{
    for (size_t i = 0; i < 2 * scene_count(); i++) {
        const scene *const drawn = scene_at(i / 2);
        scene_batch batch;
        random_source r = random_named(args.seed, drawn->name);
        scene_draw_batch(drawn, &r, &batch);
        stored_soup_lay(SCENE_TRIANGLES, STORED_AT_END);
        put_batch(0, &batch);
        const mesh_layout layout = draw_layout(&r, SCENE_TRIANGLES);
        if (i % 2)
            stored_mesh_lay(&r, &layout);
        stored_build(names[i % (size_t)kernels]);
        for (int n = 0; n < 12 * kernels; n++) {
            const tribox_box box = i % 2 ? box_in_place(&r, &batch.box) : batch.box;
            const tribox_options options = {
                .accuracy = (tribox_accuracy)(n % 3), .axes = TRIBOX_AXES_BOX + 2 * (unsigned)(n / 3 % 4), .kernel = names[n / 12]};
            check_forms(&box, &options, drawn->name);
        }
    }
}

/* Two and three levels of nodes; boxes about parts of them. */
CASE(test_levels)
{
    static const size_t counts[] = {TRIBOX_INDEX_BLOCK, TRIBOX_INDEX_BLOCK + 1, 3 * TRIBOX_INDEX_BLOCK - 64, 50000, LARGE};
    random_source r = random_named(args.seed, "levels");
    for (size_t c = 0; c < (arguments_are_short(&args) ? 3 : 5); c++) {
        draw_mesh(&r, soup_kind_at(0), counts[c]);
        for (int b = 0; b < 6; b++) {
            const size_t part = b % 2 ? TRIBOX_INDEX_BLOCK : counts[c];
            const tribox_box box = b < 4 ? draw_box(&r) : bounds_of(0, part);
            ask_all(&r, &box, "cells");
        }
    }
}

/* A build of these triangles by a kernel, to be compared with that of the stored index. */
static void expect_same_bytes(const tribox_index *index, const char *kernel, const char *what)
{
    const size_t bytes = stored_index_bytes();
    unsigned char *const again = malloc(bytes);
    assert_non_null(again);
    assert_int_equal(tribox_index_build(index, &(tribox_options){.kernel = kernel}, again), TRIBOX_OK);
    if (memcmp(again, stored.nodes, bytes) != 0)
        fail_msg("%zu triangles, kernel %s: %s has other bytes", stored.soup.count, kernel, what);
    free(again);
}

/* Of floats, those of the soup; of doubles, the same in every layout; each by every kernel. */
CASE(test_bytes)
{
    for (size_t k = 0; k < soup_kind_count(); k++) {
        random_source r = random_named(args.seed, soup_kind_at(k)->name);
        for (int round = 0; round < 4; round++) {
            draw_mesh(&r, soup_kind_at(k), (size_t)random_int(&r, round ? 600 : 2 * TRIBOX_INDEX_BLOCK));
            for (int n = 0; n < kernels; n++) {
                mesh_layout other = stored.layout;
                other.form.order = (vertex_order)random_int(&r, VERTEX_ORDERS);
                other.form.gap = random_int(&r, 2) ? 8 : 0;
                stored_mesh_lay(&r, &other);
                expect_same_bytes(&stored.index, names[n], "another layout");
                if (stored.layout.form.position_bytes != 8)
                    expect_same_bytes(&(tribox_index){.soup = &stored.soup}, names[n], "the soup");
            }
        }
    }
}

/* Triangles of 4 units about 500 units apart, word by word, wherever they are. */
static void draw_words(random_source *r)
{
    for (size_t i = 0; i < stored.soup.count; i++)
        for (int k = 0; k < STORED_STREAMS; k++)
            stored.stream[k][i] = (float)(k < 3   ? 500 * (i / 64 % 50)
                                          : k < 6 ? 500 * (i / 3200 % 50)
                                                  : 500 * (i / 160000)) +
                                  (float)random_int_between(r, 0, 4);
}

/* A thousandth of a unit beside a word, and about it: nothing is read, far from zero too, where floats are units apart. */
CASE(test_unseen)
{
    static const double far[] = {0, 5123456.7, 0x1p36};
    random_source r = random_named(args.seed, "unseen");
    for (size_t n = 0; n < 3 * (size_t)kernels; n++) {
        const double at = far[n % 3];
        const mesh_layout layout = {.form = {.position_bytes = 8, .index_bytes = 4, .is_at_end = true},
                                    .place = {1, {at, -at, at}}};
        stored_soup_lay(64 * 300, STORED_AT_END);
        draw_words(&r);
        stored_mesh_lay(&r, &layout);
        const tribox_options options = {.kernel = names[n / 3]};
        stored_build(options.kernel);
        for (int word = 0; word < 300; word += 7) {
            const tribox_box of_word = bounds_of(64 * (size_t)word, 64);
            tribox_box about, beside;
            for (int a = 0; a < 3; a++) {
                about.lo[a] = of_word.lo[a] + layout.place.offset[a] - 0.001;
                about.hi[a] = of_word.hi[a] + layout.place.offset[a] + 0.001;
            }
            beside = about;
            beside.lo[word % 3] = about.hi[word % 3] + 0.001;
            beside.hi[word % 3] = beside.lo[word % 3] + 100;
            assert_int_equal(count_unseen(&(tribox_region){.box = &about}, &options, "about a word"), 64);
            assert_int_equal(count_unseen(&(tribox_region){.box = &beside}, &options, "beside a word"), 0);
        }
    }
}

static bool has_vertices(size_t i)
{
    for (size_t v = 0; v < 3; v++)
        if (mesh_index(&stored.mesh, 3 * i + v) >= stored.mesh.vertices)
            return false;
    return true;
}

/* A triangle that has lost a vertex overlaps nothing, unless it is in a word that was inside. Others are answered as ever. */
static void check_lost(const tribox_region *region, const uint64_t *before, const tribox_options *options)
{
    const size_t words = tribox_mask_words(stored.soup.count);
    const fenced place = fenced_place(fences.mask, words * sizeof(uint64_t), AT_END);
    uint64_t *const mask = (uint64_t *)(void *)place.at;
    snprintf(doing, sizeof doing, "a mesh that has changed, kernel %s, accuracy %d", options->kernel, (int)options->accuracy);
    assert_int_equal(tribox_index_overlap(&stored.index, region, options, mask, NULL), TRIBOX_OK);
    for (size_t i = 0; i < stored.soup.count; i++) {
        const bool bit = bit_of(mask, i), is_whole = i / 64 < stored.soup.count / 64 && mask[i / 64] == ~UINT64_C(0);
        if (has_vertices(i) ? bit != bit_of(before, i) : bit && !is_whole)
            fail_msg("%s: bit %zu is %d", doing, i, bit);
    }
    check_damaged(region, options, "changed");
}

/* A mesh with vertex numbers, and its index. */
static void draw_numbered(random_source *r, size_t round, size_t count, bool is_at_end)
{
    draw_stored(r, soup_kind_at(round % soup_kind_count()), count);
    mesh_layout layout = draw_layout(r, count);
    layout.form.index_bytes = layout.form.index_bytes ? layout.form.index_bytes : 4;
    layout.form.is_at_end = is_at_end || layout.form.is_at_end;
    stored_mesh_lay(r, &layout);
    stored_build(NULL);
}

CASE(test_changed)
{
    random_source r = random_named(args.seed, "changed");
    for (size_t round = 0; round < arguments_rounds(&args, 1000); round++) {
        const size_t count = 1 + random_below(&r, 1000), words = tribox_mask_words(count);
        draw_numbered(&r, round, count, false);
        const tribox_box about = draw_box(&r), box = box_in_place(&r, &about);
        tribox_options options = any_index_options(&r);
        options.accuracy = options.accuracy == TRIBOX_FAST ? TRIBOX_EXACT : options.accuracy;
        const tribox_oriented_box turned = draw_oriented(&r, &box);
        uint64_t *const before = malloc((words + 1) * sizeof *before), *const oriented = malloc((words + 1) * sizeof *before);
        assert_int_equal(tribox_mesh_overlap(&stored.mesh, &box, &options, before, NULL), TRIBOX_OK);
        assert_int_equal(tribox_mesh_overlap_oriented(&stored.mesh, &turned, NULL, oriented, NULL), TRIBOX_OK);
        for (size_t lost = random_below(&r, 1 + count / 3); lost > 0; lost--) {
            const size_t corner = random_below(&r, 3 * count);
            mesh_set_index(&stored.mesh, corner, stored.mesh.vertices + random_below(&r, 3));
        }
        check_lost(&(tribox_region){.box = &box}, before, &options);
        check_lost(&(tribox_region){.oriented = &turned}, oriented, &(tribox_options){.kernel = options.kernel});
        options.accuracy = TRIBOX_FAST; /* for what it reads */
        assert_int_equal(tribox_index_overlap(&stored.index, &(tribox_region){.box = &box}, &options, before, NULL), TRIBOX_OK);
        free(before);
        free(oriented);
    }
}

/* In the word before the last, which is asked alone but is read in a packet with triangles of that word. */
CASE(test_changed_before)
{
    random_source r = random_named(args.seed, "changed before");
    for (size_t round = 0; round < arguments_rounds(&args, 1000); round++) {
        const size_t tail = 1 + random_below(&r, 7), first = 64 * (1 + random_below(&r, 9));
        draw_numbered(&r, round, first + tail, true);
        const tribox_box about = bounds_of(first, tail), box = box_in_place(&r, &about);
        const tribox_oriented_box turned = draw_oriented(&r, &box);
        mesh_set_index(&stored.mesh, 3 * (first - 1 - random_below(&r, 8)) + random_below(&r, 3), stored.mesh.vertices);
        for (int k = 0; k < kernels; k++)
            check_damaged(&(tribox_region){.oriented = &turned}, &(tribox_options){.kernel = names[k]}, "changed before");
    }
}

/* A mesh that has lost its vertices, all of them or the last: what it has no room for is not read. */
CASE(test_shrunk)
{
    random_source r = random_named(args.seed, "shrunk");
    for (int round = 0; round < 100; round++) {
        draw_mesh(&r, soup_kind_at((size_t)round % soup_kind_count()), 1 + random_below(&r, 500));
        const tribox_box about = draw_box(&r), box = box_in_place(&r, &about);
        const tribox_options options = any_index_options(&r);
        tribox_report report;
        stored.mesh.vertices = random_below(&r, 2) ? random_below(&r, 3 * stored.soup.count) : 0;
        if (stored.layout.form.order != ROWS)
            continue;
        const size_t left = mesh_bytes(&stored.mesh);
        void *const kept = guarded_tail(stored.mesh_fences.positions, left);
        stored.mesh.positions = memmove(kept, stored.mesh.positions, left);
        assert_int_equal(tribox_index_overlap(&stored.index, &(tribox_region){.box = &box}, &options, NULL, &report), TRIBOX_OK);
        assert_int_equal(tribox_index_build(&stored.index, &options, stored.nodes), TRIBOX_BAD_VERTEX);
    }
}

/* Numbers near one another and far apart, seen from one origin and then from another: bounds hold them on every level. */
CASE(test_bounds)
{
    random_source r = random_named(args.seed, "bounds");
    tribox_node below[2], above, wide;
    for (int round = 0; round < 200000; round++) {
        const double unit = ldexp(1, random_int_between(&r, -60, 160)), origin = unit * random_double(&r, -1, 1);
        const double number = random_int(&r, 3) ? origin + unit * random_double(&r, -1e-3, 1e-3) : unit * random_double(&r, -9, 9);
        memset(below, 0, sizeof below);
        memset(&above, 0, sizeof above);
        below[0].origin[0] = unit * random_double(&r, -9, 9);
        below[1].origin[0] = origin;
        for (int c = 0; c < 2; c++)
            above.bound[0][c] = above.bound[3][c] = tribox_number_seen(number, below[c].origin[0]);
        tribox_bounds_join(below, 2, &above);
        tribox_node_widen(&above, &wide);
        const float seen = tribox_number_seen(number, above.origin[0]);
        assert_true((double)wide.bound[0][1] + above.origin[0] <= number && number <= (double)wide.bound[3][1] + above.origin[0]);
        if (!(above.bound[0][1] <= seen && seen <= above.bound[3][1]))
            fail_msg("%a seen from %a, then from %a: %a is not between %a and %a", number, origin, above.origin[0], (double)seen,
                     (double)above.bound[0][1], (double)above.bound[3][1]);
    }
}

/* Boxes that are empty on an axis, by much or by an ulp, flat, or a point; about triangles that other boxes there would find. */
CASE(test_thin_boxes)
{
    random_source r = random_named(args.seed, "thin boxes");
    for (int k = 0; k < kernels; k++) {
        stored_soup_lay(4200, STORED_AT_END);
        draw_cells(&r);
        stored_build(names[k]);
        const tribox_box all = bounds_of(0, stored.soup.count);
        for (int turn = 0; turn < 60; turn++) {
            const size_t i = random_below(&r, stored.soup.count);
            const int a = turn % 3, v = random_int(&r, 3);
            tribox_box box = all;
            double *const lo = &box.lo[a], *const hi = &box.hi[a];
            *lo = *hi = stored.stream[3 * a + v][i];
            if (turn % 4 == 0)
                *lo = nextafterf((float)*lo, INFINITY);
            if (turn % 4 == 1) {
                *lo = all.hi[a];
                *hi = all.lo[a];
            }
            if (turn % 4 == 2)
                for (int b = 0; b < 3; b++)
                    box.lo[b] = box.hi[b] = stored.stream[3 * b + v][i];
            const tribox_options options = {.accuracy = (tribox_accuracy)(turn / 4 % 3), .kernel = names[k]};
            if (isfinite(*lo))
                check_forms(&box, &options, "thin boxes");
        }
    }
}

/* A bound that is NaN or infinite makes an empty list in between, and so does an empty box. */
CASE(test_boxes_without_lists)
{
    static const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    random_source r = random_named(args.seed, "boxes without lists");
    for (int k = 0; k < kernels; k++)
        for (int kind = 0; kind < 5 * 6; kind++) {
            tribox_box box[7];
            stored_soup_lay(300, STORED_AT_END);
            draw_cells(&r);
            stored_build(names[k]);
            for (int b = 0; b < 7; b++) {
                box[b] = bounds_of(0, 300);
                double *const bound = kind < 15 ? box[b].lo : box[b].hi;
                if (random_int(&r, 2))
                    bound[kind % 3] = kind / 3 % 5 < 4 ? bad[kind / 3 % 5] : kind < 15 ? INFINITY : -INFINITY;
                if (random_int(&r, 4) == 0)
                    box[b].lo[kind % 3] = nextafterf((float)box[b].hi[kind % 3], INFINITY);
            }
            for (size_t count = 0; count <= 7; count++) {
                const tribox_boxes boxes = streams_of(box, count);
                check_lists(&boxes, &(tribox_options){.accuracy = (tribox_accuracy)(count % 3), .kernel = names[k]}, "cells");
            }
        }
}

PROGRAM_AFTER(make_all, RUN(test_hostile), RUN(test_scenes), RUN(test_levels), RUN(test_bytes), RUN(test_unseen), RUN(test_changed),
              RUN(test_changed_before), RUN(test_shrunk), RUN(test_bounds), RUN(test_thin_boxes), RUN(test_boxes_without_lists))
