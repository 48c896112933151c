/*
 * answers.c - what the library answers here, for the npm package to be compared with: a line of JSON a batch of triangles, on
 * standard output. Numbers are 32-bit words, those of doubles and masks the lower one first.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/arguments.h"
#include "common/scenes.h"
#include "tribox.h"

enum { BATCHES = 2, MANY = 30, COUNT_MAX = MANY * SCENE_TRIANGLES, WORDS_MAX = (COUNT_MAX + 63) / 64 };
enum { GRID_X = 70, GRID_Y = 9, GRID_Z = 5, GRID_WORDS = (GRID_X + 63) / 64 * GRID_Y * GRID_Z };
enum { TILE = 8, TILES = 9 * 2 * 1, LIST_MAX = TILES * COUNT_MAX };

/* A batch in every form that the package takes. */
typedef struct question {
    tribox_box box;
    tribox_oriented_box oriented;
    tribox_grid grid;
    tribox_soup soup;
    tribox_mesh mesh; /* the same triangles, moved in the last bits of doubles */
    float streams[9][COUNT_MAX];
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

/* Triangle i of the question. The last bits of its doubles are drawn. */
static void add_triangle(question *q, random_source *r, float u[3][3])
{
    const size_t i = q->soup.count++;
    for (int v = 0; v < 3; v++)
        for (int a = 0; a < 3; a++) {
            q->streams[3 * a + v][i] = u[v][a];
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
    q->soup.count = 0;
    for (int k = 0; k < batches; k++) {
        scene_draw_batch(s, r, &batch);
        if (!is_finite)
            put_not_finite(r, &batch);
        q->box = k ? q->box : batch.box;
        for (int i = 0; i < SCENE_TRIANGLES; i++)
            add_triangle(q, r, batch.u[i]);
    }
    for (int v = 0; v < 3; v++) {
        q->soup.x[v] = q->streams[v];
        q->soup.y[v] = q->streams[3 + v];
        q->soup.z[v] = q->streams[6 + v];
    }
    q->mesh = (tribox_mesh){.positions = q->positions, .vertices = 3 * q->soup.count, .count = q->soup.count, .position_bytes = 8};
    q->oriented = oriented_box(&q->box);
    q->grid = grid_at(&q->box);
}

static void write_question(const question *q)
{
    write_words("box", &q->box, sizeof q->box);
    for (int k = 0; k < 9; k++) {
        const char name[] = {'s', (char)('0' + k), 0};
        write_words(name, q->streams[k], q->soup.count * sizeof(float));
    }
    write_words("positions", q->positions, q->soup.count * sizeof *q->positions);
    write_words("oriented", &q->oriented, sizeof q->oriented);
    write_words("grid", &q->grid, sizeof q->grid);
}

static void write_mask(const char *name, const uint64_t *mask, const question *q)
{
    write_words(name, mask, tribox_mask_words(q->soup.count) * sizeof *mask);
}

static void answer_boxes(const question *q)
{
    uint64_t mask[WORDS_MAX], inside[WORDS_MAX];
    char name[] = "axes0";
    size_t first;
    for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
        need(tribox_overlap(&q->soup, &q->box, &(tribox_options){.axes = axes}, mask, NULL));
        name[4] = (char)('0' + axes);
        write_mask(name, mask, q);
    }
    need(tribox_classify(&q->soup, &q->box, NULL, mask, inside, NULL));
    write_mask("inside", inside, q);
    need(tribox_find(&q->soup, &q->box, NULL, TRIBOX_FIRST_HIT, &first));
    write_number("first", first);
    need(tribox_find(&q->soup, &q->box, NULL, TRIBOX_FIRST_MISS, &first));
    write_number("firstMiss", first);
}

static void answer_oriented(const question *q)
{
    uint64_t mask[WORDS_MAX];
    need(tribox_overlap_oriented(&q->soup, &q->oriented, NULL, mask, NULL));
    write_mask("orientedMask", mask, q);
    need(tribox_overlap_oriented(&q->soup, &q->oriented, &(tribox_options){.axes = TRIBOX_AXES_BOX}, mask, NULL));
    write_mask("orientedBounds", mask, q);
}

static void answer_doubles(const question *q)
{
    uint64_t mask[WORDS_MAX], inside[WORDS_MAX];
    size_t first;
    need(tribox_mesh_classify(&q->mesh, &q->box, NULL, mask, inside, NULL));
    write_mask("meshMask", mask, q);
    write_mask("meshInside", inside, q);
    need(tribox_mesh_overlap_oriented(&q->mesh, &q->oriented, NULL, mask, NULL));
    write_mask("meshOriented", mask, q);
    need(tribox_mesh_find(&q->mesh, &q->box, NULL, TRIBOX_FIRST_HIT, &first));
    write_number("meshFirst", first);
    need(tribox_mesh_find(&q->mesh, &q->box, NULL, TRIBOX_FIRST_MISS, &first));
    write_number("meshFirstMiss", first);
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
    need(tribox_fill_parity(&q->soup, &q->grid, cells, scratch, solid, &inside, &odd));
    write_words("parity", solid, sizeof solid);
    write_number("parityOdd", odd);
    need(tribox_mesh_fill_parity(&q->mesh, &q->grid, cells, scratch, solid, &inside, &odd));
    write_words("meshParity", solid, sizeof solid);
    write_number("meshParityInside", inside);
}

static void answer_tiles(const question *q)
{
    static uint32_t list[LIST_MAX];
    size_t starts[TILES + 1];
    const tribox_tiles tiles = {.side = TILE, .count = TILES};
    need(tribox_mesh_tile_lists(&q->mesh, &q->grid, &tiles, NULL, starts, NULL));
    need(tribox_mesh_tile_lists(&q->mesh, &q->grid, &tiles, NULL, starts, list));
    write_words("meshTiles", list, starts[TILES] * sizeof *list);
    need(tribox_tile_lists(&q->soup, &q->grid, &tiles, NULL, starts, NULL));
    need(tribox_tile_lists(&q->soup, &q->grid, &tiles, NULL, starts, list));
    write_words("tiles", list, starts[TILES] * sizeof *list);
    for (int t = 0; t <= TILES; t++)
        list[t] = (uint32_t)starts[t];
    write_words("tileStarts", list, (TILES + 1) * sizeof *list);
}

/* Where the library serves the grid. */
static void answer_cells(const question *q)
{
    uint64_t cells[GRID_WORDS] = {0}, some[GRID_WORDS] = {0};
    const tribox_window window = {.first = {5, 1, 2}, .size = {60, 7, 2}};
    if (tribox_voxelize(&q->soup, &q->grid, NULL, NULL, cells, NULL))
        return;
    write_words("cells", cells, sizeof cells);
    answer_fills(q, cells);
    need(tribox_mesh_voxelize(&q->mesh, &q->grid, &window, NULL, some, NULL));
    write_words("meshWindow", some, tribox_window_words(window.size) * sizeof *some);
    memset(cells, 0, sizeof cells);
    need(tribox_mesh_voxelize(&q->mesh, &q->grid, NULL, NULL, cells, NULL));
    write_words("meshCells", cells, sizeof cells);
    memset(cells, 0, sizeof cells);
    need(tribox_voxelize_thin(&q->soup, &q->grid, NULL, NULL, cells, NULL));
    write_words("thin", cells, sizeof cells);
    memset(some, 0, sizeof some);
    need(tribox_mesh_voxelize_thin(&q->mesh, &q->grid, &window, NULL, some, NULL));
    write_words("meshThinWindow", some, tribox_window_words(window.size) * sizeof *some);
    answer_tiles(q);
}

static void answer_order(const question *q)
{
    static uint32_t order[COUNT_MAX];
    static float scratch[4 * COUNT_MAX];
    need(tribox_soup_sort(&q->soup, order, scratch));
    write_words("order", order, q->soup.count * sizeof *order);
    need(tribox_mesh_sort(&q->mesh, order, scratch));
    write_words("meshOrder", order, q->soup.count * sizeof *order);
}

static void answer(const scene *s, random_source *r, int batches, bool is_finite)
{
    static question q;
    draw(s, r, batches, is_finite, &q);
    printf("{\"scene\": \"%s\"", s->name);
    write_question(&q);
    answer_boxes(&q);
    answer_oriented(&q);
    answer_doubles(&q);
    answer_order(&q);
    answer_cells(&q);
    printf("}\n");
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
