/*
 * answers.c - what the library answers here, for its packages in other languages to be compared with: a line of JSON for each batch
 * of triangles, of floats and again of doubles, on standard output. Numbers are 32-bit words, those of doubles and masks the lower
 * one first.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/arguments.h"
#include "common/scenes.h"
#include "common/soup_or_mesh.h"

enum { BATCHES = 2, MANY = 30, COUNT_MAX = MANY * SCENE_TRIANGLES, WORDS_MAX = (COUNT_MAX + 63) / 64 };
enum { GRID_X = 70, GRID_Y = 9, GRID_Z = 5, GRID_WORDS = (GRID_X + 63) / 64 * GRID_Y * GRID_Z };
enum { TILE = 8, TILES = 9 * 2 * 1, WINDOW_CELLS = 60 * 7 * 2, LIST_MAX = WINDOW_CELLS * COUNT_MAX };

static const tribox_window window = {.first = {5, 1, 2}, .size = {60, 7, 2}};

/* A batch, as floats or as doubles, which are moved in their last bits. */
typedef struct question {
    tribox_box box;
    tribox_oriented_box oriented;
    tribox_grid grid;
    soup_or_mesh of;
    size_t count;
    float streams[9][COUNT_MAX], corners[COUNT_MAX][3][3];
    double positions[COUNT_MAX][3][3];
} question;

static void write_words(const char *name, const void *words, size_t bytes)
{
    printf(", \"%s\": [", name);
    for (size_t i = 0; i < bytes / sizeof(uint32_t); i++) {
        uint32_t word;
        memcpy(&word, (const char *)words + sizeof word * i, sizeof word);
        printf("%s%" PRIu32, i ? "," : "", word);
    }
    printf("]");
}

static void write_number(const char *name, size_t number) { printf(", \"%s\": %zu", name, number); }

static void need(tribox_status status)
{
    if (!status)
        return;
    fprintf(stderr, "the library refuses a question: %s\n", tribox_status_text(status));
    exit(1);
}

/* Turned about z by the angle of 3, 4, 5 and then about x by that of 5, 12, 13: directions that doubles have to round. */
static tribox_oriented_box oriented_box(const tribox_box *box)
{
    static const double axis[3][3] = {
        {0.6, 0.8, 0}, {-0.8 * 5 / 13, 0.6 * 5 / 13, 12.0 / 13}, {0.8 * 12 / 13, -0.6 * 12 / 13, 5.0 / 13}};
    tribox_oriented_box oriented;
    for (int a = 0; a < 3; a++) {
        oriented.center[a] = box->lo[a] / 2 + box->hi[a] / 2;
        oriented.half[a] = box->hi[a] / 2 - box->lo[a] / 2;
    }
    memcpy(oriented.axis, axis, sizeof axis);
    return oriented;
}

/* Some cells that begin at the box. */
static tribox_grid grid_at(const tribox_box *box)
{
    tribox_grid grid = {.size = {GRID_X, GRID_Y, GRID_Z}};
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = box->lo[a];
        grid.cell[a] = (box->hi[a] - box->lo[a]) / (grid.size[a] - 2);
    }
    return grid;
}

/* The last bits of its doubles are drawn. */
static void add_triangle(question *q, random_source *r, float u[3][3])
{
    const size_t i = q->count++;
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++) {
            q->streams[3 * a + v][i] = q->corners[i][v][a] = u[v][a];
            q->positions[i][v][a] = (double)u[v][a] * (1 + 0x1p-50 * random_int_between(r, -1, 1));
        }
}

/* In some of the triangles. */
static void put_not_finite(random_source *r, scene_batch *batch)
{
    for (int k = 0; k < SCENE_TRIANGLES; k += 1 + random_int(r, 20))
        batch->u[k][random_int(r, 3)][random_int(r, 3)] = k % 2 ? NAN : -INFINITY;
}

/* Asks about the box of the first batch. */
static void draw(const scene *s, random_source *r, int batches, bool is_finite, question *q)
{
    scene_batch batch;
    q->count = 0;
    for (int k = 0; k < batches; k++) {
        scene_draw_batch(s, r, &batch);
        if (!is_finite)
            put_not_finite(r, &batch);
        q->box = k ? q->box : batch.box;
        for (int i = 0; i < SCENE_TRIANGLES; i++)
            add_triangle(q, r, batch.u[i]);
    }
    q->of.soup = soup_of_rows(*q->streams, COUNT_MAX, q->count);
    q->of.mesh = mesh_of_corners(q->positions, q->count, sizeof(double));
    q->oriented = oriented_box(&q->box);
    q->grid = grid_at(&q->box);
}

static void write_question(const scene *s, const question *q)
{
    const bool is_mesh = q->of.is_mesh;
    const void *positions = is_mesh ? (const void *)q->positions : (const void *)q->corners;
    printf("{\"scene\": \"%s\", \"isDouble\": %s", s->name, is_mesh ? "true" : "false");
    write_words("positions", positions, q->count * (is_mesh ? sizeof *q->positions : sizeof *q->corners));
    write_words("box", &q->box, sizeof q->box);
    write_words("oriented", &q->oriented, sizeof q->oriented);
    write_words("grid", &q->grid, sizeof q->grid);
}

static void write_mask(const char *name, const uint64_t *mask, const question *q)
{
    write_words(name, mask, tribox_mask_words(q->count) * sizeof *mask);
}

static void answer_boxes(const question *q)
{
    uint64_t mask[WORDS_MAX], inside[WORDS_MAX];
    char name[] = "axes0";
    size_t first;
    for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
        need(CALL(overlap, &q->of, &q->box, &(tribox_options){.axes = axes}, mask, NULL));
        name[4] = (char)('0' + axes);
        write_mask(name, mask, q);
    }
    need(CALL(classify, &q->of, &q->box, NULL, mask, inside, NULL));
    write_mask("inside", inside, q);
    need(CALL(find, &q->of, &q->box, NULL, TRIBOX_FIRST_HIT, &first));
    write_number("first", first);
    need(CALL(find, &q->of, &q->box, NULL, TRIBOX_FIRST_MISS, &first));
    write_number("firstMiss", first);
    need(CALL(overlap_oriented, &q->of, &q->oriented, NULL, mask, NULL));
    write_mask("oriented7", mask, q);
    need(CALL(overlap_oriented, &q->of, &q->oriented, &(tribox_options){.axes = TRIBOX_AXES_BOX}, mask, NULL));
    write_mask("oriented1", mask, q);
}

/* Where the box has a middle that floats tell; of the second, that is the lower corner but for y. */
static void answer_children(const question *q)
{
    static uint8_t children[COUNT_MAX];
    const double middle[3] = {q->box.lo[0], q->box.hi[1], q->box.lo[2]};
    for (int a = 0; a < 3; a++)
        if (!(q->box.lo[a] <= q->box.hi[a] && isfinite(q->box.lo[a] + q->box.hi[a])))
            return;
    need(CALL(split, &q->of, NULL, q->count, &q->box, NULL, NULL, children, NULL));
    write_words("children", children, q->count);
    need(CALL(split, &q->of, NULL, q->count, &q->box, middle, &(tribox_options){.axes = TRIBOX_AXES_BOX}, children, NULL));
    write_words("childrenAt", children, q->count);
}

static void answer_fills(const question *q, const uint64_t *cells)
{
    static unsigned char scratch[4096];
    uint64_t solid[GRID_WORDS];
    size_t inside, odd;
    if (tribox_fill_bytes(q->grid.size) > sizeof scratch) {
        fprintf(stderr, "more scratch is needed than is here\n");
        exit(1);
    }
    need(tribox_fill_outside(q->grid.size, cells, scratch, solid, &inside));
    write_words("outside", solid, sizeof solid);
    write_number("outsideInside", inside);
    need(CALL(fill_parity, &q->of, &q->grid, cells, scratch, solid, &inside, &odd));
    write_words("parity", solid, sizeof solid);
    write_number("parityInside", inside);
    write_number("parityOdd", odd);
}

static void write_lists(const char *name, const size_t *starts, int count, const uint32_t *list)
{
    printf(", \"%sStarts\": [0", name);
    for (int n = 1; n <= count; n++)
        printf(",%zu", starts[n]);
    printf("]");
    write_words(name, list, starts[count] * sizeof *list);
}

static void answer_lists(const question *q)
{
    static uint32_t list[LIST_MAX];
    size_t starts[WINDOW_CELLS + 1];
    const tribox_tiles tiles = {.side = TILE, .count = TILES};
    need(CALL(tile_lists, &q->of, &q->grid, &tiles, NULL, starts, NULL));
    need(CALL(tile_lists, &q->of, &q->grid, &tiles, NULL, starts, list));
    write_lists("tiles", starts, TILES, list);
    need(CALL(cell_lists, &q->of, &q->grid, &window, NULL, starts, NULL));
    need(CALL(cell_lists, &q->of, &q->grid, &window, NULL, starts, list));
    write_lists("window", starts, WINDOW_CELLS, list);
}

/* Where the library serves the grid. */
static void answer_cells(const question *q)
{
    uint64_t cells[GRID_WORDS] = {0}, thin[GRID_WORDS] = {0}, some[WINDOW_CELLS] = {0};
    if (CALL(voxelize, &q->of, &q->grid, NULL, NULL, cells, NULL))
        return;
    write_words("cells", cells, sizeof cells);
    answer_fills(q, cells);
    need(CALL(voxelize_thin, &q->of, &q->grid, NULL, NULL, thin, NULL));
    write_words("thin", thin, sizeof thin);
    need(CALL(voxelize_thin, &q->of, &q->grid, &window, NULL, some, NULL));
    write_words("windowThin", some, tribox_window_words(window.size) * sizeof *some);
    need(CALL(voxelize, &q->of, &q->grid, &window, NULL, some, NULL));
    write_words("windowCells", some, tribox_window_words(window.size) * sizeof *some);
    answer_lists(q);
}

static void answer_order(const question *q)
{
    static uint32_t order[COUNT_MAX];
    static float scratch[4 * COUNT_MAX];
    need(q->of.is_mesh ? tribox_mesh_sort(&q->of.mesh, order, scratch) : tribox_soup_sort(&q->of.soup, order, scratch));
    write_words("order", order, q->count * sizeof *order);
}

static void answer(const scene *s, random_source *r, int batches, bool is_finite)
{
    static question q;
    draw(s, r, batches, is_finite, &q);
    for (int form = 0; form < 2; form++) {
        q.of.is_mesh = form;
        write_question(s, &q);
        answer_boxes(&q);
        answer_children(&q);
        answer_order(&q);
        answer_cells(&q);
        printf("}\n");
    }
}

int main(int argc, char **argv)
{
    const arguments args = arguments_parse(argc, argv);
    for (size_t i = 0; i < scene_count(); i++) {
        const scene *const s = scene_at(i);
        random_source r = random_named(args.seed, s->name);
        if (!scene_is_called(s, args.scenes))
            continue;
        for (int k = 0; k < BATCHES; k++)
            answer(s, &r, 1, k != 1);
        if (i % 7 == 0)
            answer(s, &r, MANY, true);
    }
    return 0;
}
