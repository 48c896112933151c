/* calls.c - the calls, a row each, and arguments for them. */
#include "calls.h"

#include <assert.h>
#include <string.h>

#define WINDOW " grid window occupied cells test"
#define TILED " grid tiles test many "
#define BRICKS " grid tiles lists scratch test"
#define FILLED " surface scratch solid cells"

/*
 * S(function, of, what it takes, arguments) for those with a status: `vertices` where a mesh is refused that lacks one, `many`
 * where more than 2^32 triangles are, `cells` where a grid of too many words is. V(function, takes, where its value goes,
 * arguments) for others, T(function, takes, argument, status if there are any) for those whose refusal is a count of nothing.
 */
#define EACH(S, V, T) \
    S(overlap, , "soup box test", a->soup, a->box, a->options, a->mask, a->report) \
    S(mesh_overlap, , "mesh box test vertices", a->mesh, a->box, a->options, a->mask, a->report) \
    S(find, , "soup box test found what", a->soup, a->box, a->options, a->what, a->found) \
    S(mesh_find, , "mesh box test found what tested", a->mesh, a->box, a->options, a->what, a->found) \
    S(classify, , "soup box test", a->soup, a->box, a->options, a->mask, a->inside, a->report) \
    S(mesh_classify, , "mesh box test vertices", a->mesh, a->box, a->options, a->mask, a->inside, a->report) \
    S(overlap_oriented, , "soup oriented test", a->soup, a->oriented, a->options, a->mask, a->report) \
    S(mesh_overlap_oriented, , "mesh oriented test vertices", a->mesh, a->oriented, a->options, a->mask, a->report) \
    S(split, , "soup box test split", a->soup, a->order_in, a->the_soup.count, a->box, a->middle, a->options, a->children, \
      a->report) \
    S(mesh_split, , "mesh box test split vertices", a->mesh, a->order_in, a->the_mesh.count, a->box, a->middle, a->options, \
      a->children, a->report) \
    S(overlap_boxes, , "triangle boxes test", a->triangle, a->boxes, a->options, a->mask, a->report) \
    S(mesh_to_soup, , "mesh range streams origin kernel vertices", a->mesh, a->origin, a->first, a->count, a->options, a->x, a->y, \
      a->z) \
    OF_INDEX(S, soup_index, "in_soup") \
    OF_INDEX(S, mesh_index, "in_mesh") \
    S(soup_sort, , "soup order sorted many", a->soup, a->order, a->scratch) \
    S(mesh_sort, , "mesh order sorted many vertices", a->mesh, a->order, a->scratch) \
    S(boxes_sort, , "boxes order sorted many", a->boxes, a->order, a->scratch) \
    S(soup_sort_start, , "soup sorted range many", a->soup, a->first, a->count, a->scratch) \
    S(mesh_sort_start, , "mesh sorted range many vertices", a->mesh, a->first, a->count, a->scratch) \
    S(boxes_sort_start, , "boxes sorted range many", a->boxes, a->first, a->count, a->scratch) \
    S(sort_cut, , "sorted range many found", a->scratch, a->total, a->first, a->count, a->found) \
    S(sort_finish, , "sorted range many order", a->scratch, a->total, a->first, a->count, a->order) \
    S(soup_gather, , "soup order_in streams", a->soup, a->order_in, a->first, a->count, a->x, a->y, a->z) \
    S(mesh_gather, , "mesh order_in streams origin vertices", a->mesh, a->origin, a->order_in, a->first, a->count, a->x, a->y, \
      a->z) \
    S(voxelize, , "soup" WINDOW, a->soup, a->grid, a->window, a->options, a->occupied, a->report) \
    S(mesh_voxelize, , "mesh vertices" WINDOW, a->mesh, a->grid, a->window, a->options, a->occupied, a->report) \
    S(voxelize_ids, , "soup ids" WINDOW, a->soup, a->first_id, a->grid, a->window, a->options, a->occupied, a->ids, a->report) \
    S(mesh_voxelize_ids, , "mesh ids vertices" WINDOW, a->mesh, a->first_id, a->grid, a->window, a->options, a->occupied, a->ids, \
      a->report) \
    S(voxelize_thin, , "soup thin" WINDOW, a->soup, a->grid, a->window, a->options, a->occupied, a->report) \
    S(mesh_voxelize_thin, , "mesh thin vertices" WINDOW, a->mesh, a->grid, a->window, a->options, a->occupied, a->report) \
    S(tile_lists, , "soup start" TILED, a->soup, a->grid, a->tiles, a->options, a->start, NULL) \
    S(mesh_tile_lists, , "mesh vertices start" TILED, a->mesh, a->grid, a->tiles, a->options, a->start, NULL) \
    S(tile_lists_part, , "soup range start" TILED, a->soup, a->first, a->count, a->grid, a->tiles, a->options, a->start, NULL) \
    S(mesh_tile_lists_part, , "mesh vertices range start" TILED, a->mesh, a->first, a->count, a->grid, a->tiles, a->options, \
      a->start, NULL) \
    S(tile_lists, with_list, "soup places" TILED, a->soup, a->grid, a->tiles, a->options, a->places, a->listed) \
    S(mesh_tile_lists, with_list, "mesh vertices places" TILED, a->mesh, a->grid, a->tiles, a->options, a->places, a->listed) \
    S(tile_lists_part, with_list, "soup range places" TILED, a->soup, a->first, a->count, a->grid, a->tiles, a->options, \
      a->places, a->listed) \
    S(mesh_tile_lists_part, with_list, "mesh vertices range places" TILED, a->mesh, a->first, a->count, a->grid, a->tiles, \
      a->options, a->places, a->listed) \
    S(cell_lists, , "soup grid window start test many uncounted", a->soup, a->grid, a->window, a->options, a->start, NULL) \
    S(mesh_cell_lists, , "mesh vertices grid window start test many uncounted", a->mesh, a->grid, a->window, a->options, a->start, \
      NULL) \
    S(bricks, , "soup sink" BRICKS, a->soup, a->grid, a->tiles, a->starts_in, a->list_in, a->options, a->scratch, a->sink, \
      a->report) \
    S(mesh_bricks, , "mesh sink listed" BRICKS, a->mesh, a->grid, a->tiles, a->starts_in, a->list_in, a->options, a->scratch, \
      a->sink, a->report) \
    S(bricks_ids, , "soup ids_sink" BRICKS, a->soup, a->grid, a->tiles, a->starts_in, a->list_in, a->options, a->scratch, \
      a->ids_sink, a->report) \
    S(mesh_bricks_ids, , "mesh ids_sink listed" BRICKS, a->mesh, a->grid, a->tiles, a->starts_in, a->list_in, a->options, \
      a->scratch, a->ids_sink, a->report) \
    S(bricks_lists, , "soup lists_sink many" BRICKS, a->soup, a->grid, a->tiles, a->starts_in, a->list_in, a->options, a->scratch, \
      a->lists_sink, a->report) \
    S(mesh_bricks_lists, , "mesh lists_sink many listed" BRICKS, a->mesh, a->grid, a->tiles, a->starts_in, a->list_in, a->options, \
      a->scratch, a->lists_sink, a->report) \
    S(fill_outside, , "size" FILLED, a->size, a->surface, a->scratch, a->solid, a->found) \
    S(fill_parity, , "soup grid" FILLED, a->soup, a->grid, a->surface, a->scratch, a->solid, a->found, a->odd_rows) \
    S(mesh_fill_parity, , "mesh vertices grid" FILLED, a->mesh, a->grid, a->surface, a->scratch, a->solid, a->found, a->odd_rows) \
    S(fill_parity_window, , "soup grid window" FILLED, a->soup, a->grid, a->window, a->surface, a->scratch, a->solid, a->found, \
      a->odd_rows) \
    S(mesh_fill_parity_window, , "mesh vertices grid window" FILLED, a->mesh, a->grid, a->window, a->surface, a->scratch, \
      a->solid, a->found, a->odd_rows) \
    S(fill_labels, , "size surface runs cells faces", a->size, a->surface, a->runs, a->faces, a->label_count) \
    S(fill_labelled, , "size surface runs cells solid outside", a->size, a->surface, a->runs, a->outside, a->solid, a->found) \
    S(fill_join, , "joins", a->parents, a->side_a, 0, a->side_b, ROWS, ROWS) \
    V(fill_root, "", value, a->parents ? a->parents : a->out->parents, 2 * ROWS - 1) \
    V(fill_bytes, "", value, a->the_grid.size) \
    V(fill_labels_bytes, "", value, a->the_grid.size) \
    V(bricks_bytes, "", value, TILE) \
    V(bricks_ids_bytes, "", value, TILE) \
    V(bricks_lists_bytes, "", value, TILE, COUNT) \
    V(tile_count, "", value, a->the_grid.size, TILE) \
    V(window_words, "", value, a->the_grid.size) \
    V(window_cells, "", value, a->surface ? a->surface : a->cells, a->the_grid.size, NULL) \
    V(grid_cell, "", cell, &a->the_grid, 1, 2, SIDE - 1) \
    V(index_bytes, "", value, a->count) \
    V(mask_words, "", value, a->count) \
    V(mask_indices, "", value, a->mask_in, a->count, a->list) \
    V(kernel_name, "", text, a->options) \
    V(kernel_list, "", text, 0) \
    V(status_text, "", text, TRIBOX_BAD_BOX) \
    V(version, "", text, ) \
    T(soup_not_finite, "any_soup counted", a->soup, TRIBOX_OK) \
    T(mesh_not_finite, "mesh counted", a->mesh, TRIBOX_OK) \
    T(mesh_bad_vertices, "mesh vertices counted", a->mesh, TRIBOX_BAD_VERTEX)

/* The calls about an index over a soup or a mesh. */
#define OF_INDEX(S, of, over) \
    S(index_build, of, over " nodes kernel vertices", a->of, a->options, a->nodes) \
    S(index_update, of, over " nodes kernel vertices range", a->of, a->first, a->count, a->options, a->nodes) \
    S(index_overlap, of, over " asked test region", a->of, a->region, a->options, a->mask, a->report) \
    S(index_words, of, over " asked test region found list bits inside", a->of, a->region, a->options, a->room, a->list, \
      a->bits_out, a->inside, a->found, a->report) \
    S(index_list, of, over " asked test region found list many", a->of, a->region, a->options, a->room, a->list, a->found) \
    S(index_lists, of, over " asked test boxes start list many", a->of, a->boxes, a->options, a->room, a->list, a->start) \
    S(index_any, of, over " asked test region found", a->of, a->region, a->options, a->found) \
    S(index_overlap, turned_##of, over " asked test turned", a->of, a->turned, a->options, a->mask, a->report) \
    S(index_words, turned_##of, over " asked test turned found list bits", a->of, a->turned, a->options, a->room, a->list, \
      a->bits_out, NULL, a->found, a->report) \
    S(index_list, turned_##of, over " asked test turned found list many", a->of, a->turned, a->options, a->room, a->list, \
      a->found) \
    S(index_any, turned_##of, over " asked test turned found", a->of, a->turned, a->options, a->found)

#define WITH_STATUS(name, of, takes, ...) \
    static tribox_status ask_##name##_##of(const asked *a) { return tribox_##name(__VA_ARGS__); }
#define WITH_VALUE(name, takes, to, ...) \
    static tribox_status ask_##name(const asked *a) \
    { \
        (void)a; \
        a->out->to = tribox_##name(__VA_ARGS__); \
        return TRIBOX_OK; \
    }
#define WITH_COUNT(name, takes, of, found_any) \
    static tribox_status ask_##name(const asked *a) \
    { \
        size_t first = 1; \
        const size_t found = tribox_##name(of, &first); \
        if (found ? found_any : !first) \
            return found ? found_any : TRIBOX_BAD_ARGUMENT; \
        if (tribox_##name(of, NULL) != found) \
            return TRIBOX_STOPPED; \
        a->out->value = found; \
        return TRIBOX_OK; \
    }
EACH(WITH_STATUS, WITH_VALUE, WITH_COUNT)

#define ROW_OF_STATUS(name, of, takes, ...) {"tribox_" #name, #of, " " takes " ", ask_##name##_##of},
#define ROW(name, takes, ...) {"tribox_" #name, "", " " takes " ", ask_##name},
const call calls[] = {EACH(ROW_OF_STATUS, ROW, ROW)};
const size_t call_count = sizeof calls / sizeof calls[0];

static bool has_word(const call *c, const char *word, size_t length)
{
    for (const char *at = strchr(c->takes, ' '); at && at[1]; at = strchr(at + 1, ' '))
        if (!strncmp(at + 1, word, length) && at[1 + length] == ' ')
            return true;
    return false;
}

bool call_takes(const call *c, const char *words)
{
    bool does = true;
    for (const char *word = words;; word++) {
        const size_t length = strcspn(word, "& ");
        does &= has_word(c, word, length);
        word += length;
        if (*word == '&')
            continue;
        if (does || !*word)
            return does;
        does = true;
    }
}

static int take_brick(void *bricks, const uint32_t at[3], const uint64_t bits[8])
{
    (void)at, (void)bits;
    return ++*(size_t *)bricks, 0;
}

static int take_ids(void *bricks, const uint32_t at[3], const uint64_t bits[8], const uint32_t ids[512])
{
    return (void)ids, take_brick(bricks, at, bits);
}

static int take_lists(void *bricks, const uint32_t at[3], const uint64_t bits[8], const uint32_t starts[513], const uint32_t *list)
{
    return (void)starts, (void)list, take_brick(bricks, at, bits);
}

/* Small triangles all over the grid. */
static void draw(asked *a)
{
    for (int i = 0; i < COUNT; i++)
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++) {
                const int places[3] = {i % SIDE, i / SIDE % SIDE, (5 * i + i / SIDE) % SIDE};
                const float at = 0.75f * (float)places[k] + (v == k ? 2 : 0) + (float)(i + k) / 256;
                a->corner[i][v][k] = a->floats[i][v][k] = a->number[3 * k + v][i] = at;
                a->index[3 * i + v] = (uint32_t)(3 * i + v);
            }
    for (uint32_t i = 0; i < COUNT; i++)
        a->orders[i] = COUNT - 1 - i;
    for (uint32_t i = 0; i < ROWS; i++) { /* a wall across z, and some cells */
        a->cells[i] = i / SIDE == SIDE / 2 ? (1 << SIDE) - 1 : i % 3 ? 0 : 16;
        a->labels[0][i] = i % 5 ? i : TRIBOX_NO_LABEL;
        a->labels[1][i] = i % 7 ? ROWS - 1 - i : TRIBOX_NO_LABEL;
    }
}

static void point(asked *a)
{
    for (int v = 0; v < 3; v++) {
        a->the_soup.x[v] = a->number[v];
        a->the_soup.y[v] = a->number[3 + v];
        a->the_soup.z[v] = a->number[6 + v];
        a->the_boxes.lo[v] = a->number[3 * v];
        a->the_boxes.hi[v] = a->number[3 * v + 1];
    }
    a->the_soup_index = (tribox_index){.nodes = a->built[0], .soup = &a->the_soup};
    a->the_mesh_index = (tribox_index){.nodes = a->built[1], .mesh = &a->the_mesh, .ids = a->orders};
    a->the_region.box = &a->the_box, a->the_turned.oriented = &a->the_oriented;
    a->soup = &a->the_soup, a->mesh = &a->the_mesh, a->box = &a->the_box, a->oriented = &a->the_oriented, a->boxes = &a->the_boxes;
    a->triangle = a->the_triangle, a->soup_index = &a->the_soup_index, a->mesh_index = &a->the_mesh_index;
    a->region = &a->the_region, a->turned = &a->the_turned, a->options = &a->the_options, a->grid = &a->the_grid;
    a->window = &a->the_window, a->tiles = &a->the_tiles, a->sink = &a->the_sink, a->ids_sink = &a->the_ids_sink;
    a->lists_sink = &a->the_lists_sink;
    a->size = a->the_grid.size, a->order_in = a->orders, a->list_in = a->numbers, a->starts_in = a->tile_starts;
    a->origin = a->the_origin, a->middle = a->the_middle, a->surface = a->cells, a->mask_in = a->bits, a->outside = a->joined;
    a->side_a = a->labels[0], a->side_b = a->labels[1];
}

void ask_into(asked *a, outputs *to)
{
    a->out = to;
    for (int s = 0; s < 9; s++)
        a->to[s] = to->stream[s];
    for (int f = 0; f < 6; f++)
        a->face[f] = to->face[f];
    a->x = a->to, a->y = a->to + 3, a->z = a->to + 6, a->faces = a->face;
    a->mask = to->mask, a->inside = to->inside, a->bits_out = to->bits, a->occupied = to->occupied, a->solid = to->solid;
    a->report = &to->report, a->found = &to->found, a->start = to->start, a->odd_rows = &to->odd_rows, a->places = to->places;
    a->list = to->list, a->order = to->order, a->ids = to->ids, a->listed = to->listed, a->label_count = &to->labels;
    a->parents = to->parents, a->children = to->children, a->nodes = to->nodes, a->scratch = to->scratch, a->runs = to->runs;
    a->the_sink = (tribox_sink){take_brick, &to->bricks};
    a->the_ids_sink = (tribox_ids_sink){take_ids, &to->bricks};
    a->the_lists_sink = (tribox_lists_sink){take_lists, &to->bricks};
}

void ask_follow(asked *a)
{
    memset(a->tile_starts, 0, sizeof a->tile_starts);
    tribox_tile_lists(a->soup, a->grid, a->tiles, NULL, a->tile_starts, NULL);
    assert(a->tile_starts[TILES] <= TILES * COUNT);
    tribox_tile_lists(a->soup, a->grid, a->tiles, NULL, a->tile_starts, a->numbers);
    tribox_index_build(a->soup_index, NULL, a->built[0]);
    tribox_index_build(a->mesh_index, NULL, a->built[1]);
}

void outputs_prepare(const asked *a, int byte, outputs *to)
{
    tribox_soup other = *a->soup; /* whose keys no call writes that starts an order */
    memcpy(other.x, a->soup->y, sizeof other.x);
    memset(to, byte, sizeof *to);
    to->bricks = 0;
    memcpy(to->places, a->tile_starts, sizeof to->places);
    for (uint32_t n = 0; n < 2 * ROWS; n++)
        to->parents[n] = n / 2;
    tribox_soup_sort_start(&other, 0, COUNT, to->scratch);
    tribox_fill_labels(a->the_grid.size, a->cells, to->runs, (uint32_t *const[6]){NULL}, &to->labels);
}

void ask_rightly(unsigned position_bytes, asked *a, outputs *to)
{
    *a =
        (asked){.the_box = {{0, 0, 0}, {SIDE, SIDE, SIDE}},
                .the_oriented = {{SIDE / 2, SIDE / 2, SIDE / 2}, {SIDE / 2, SIDE / 2, SIDE / 2}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                .the_triangle = {1, 1, 1, 5, 5, 6, 8, 1, 2},
                .the_grid = {{0, 0, 0}, {1, 1, 1}, {SIDE, SIDE, SIDE}},
                .the_window = {{0, 0, 0}, {SIDE, SIDE, SIDE}},
                .the_tiles = {TILE, 0, TILES},
                .the_middle = {1, SIDE / 2, SIDE},
                .the_soup.count = COUNT,
                .the_boxes.count = COUNT,
                .count = COUNT,
                .total = COUNT,
                .room = COUNT,
                .bits = {UINT64_C(0x8000000000000001), UINT64_C(0xffffff000000000e)},
                .joined = {1}};
    assert(tribox_index_bytes(COUNT) == NODES);
    assert(tribox_bricks_lists_bytes(TILE, COUNT) <= sizeof to->scratch &&
           tribox_fill_labels_bytes(a->the_grid.size) <= sizeof to->runs);
    a->the_mesh = (tribox_mesh){.positions = position_bytes == 8 ? (const void *)a->corner : a->floats,
                                .vertices = 3 * COUNT,
                                .indices = a->index,
                                .index_bytes = 4,
                                .count = COUNT,
                                .position_bytes = position_bytes};
    draw(a);
    point(a);
    ask_into(a, to);
    ask_follow(a);
    outputs_prepare(a, 0, to);
}
