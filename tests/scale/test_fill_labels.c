/*
 * test_fill_labels.c - what is filled are the cells that a plain search from outside does not find, whatever the walls: of a whole
 * grid, and part by part, however it is cut.
 */
#include "common/harness.h"
#include "common/window_bits.h"
#include "tribox_threads.h"

enum { PAIRS = 100000, ROUNDS = 1200, PARTS_MAX = 4096 };

/* ----------------------------------------------------------------------------------------- walls that are hard to flood */

enum { WALLS_CELLS = 40000 };

typedef struct walls {
    const char *kind;
    uint32_t size[3];
    unsigned char is_wall[WALLS_CELLS];
} walls;

static size_t walls_at(const walls *w, uint32_t i, uint32_t j, uint32_t k) { return ((size_t)k * w->size[1] + j) * w->size[0] + i; }

static void draw_size(random_source *r, walls *w)
{
    static const uint32_t words[] = {1, 2, 3, 62, 63, 64, 65, 66, 127, 128, 129, 130, 192, 193};
    w->size[0] = random_int(r, 2) ? words[random_int(r, sizeof words / sizeof words[0])] : (uint32_t)random_int_between(r, 1, 130);
    for (int a = 1; a < 3; a++)
        w->size[a] = random_int(r, 5) ? (uint32_t)random_int_between(r, 2, 14) : 1;
}

static size_t cells_of(const walls *w) { return (size_t)w->size[0] * w->size[1] * w->size[2]; }

/* Walls with a chance, each of eight by itself. */
static void draw_noise(random_source *r, walls *w)
{
    const int of_eight = random_int_between(r, 0, 8);
    for (size_t n = 0; n < cells_of(w); n++)
        w->is_wall[n] = random_int(r, 8) < of_eight;
}

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

/* Shells in each other, every other one a wall. */
static void draw_shells(random_source *r, walls *w)
{
    const uint32_t first = (uint32_t)random_int(r, 2);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const uint32_t x = least(i, w->size[0] - 1 - i), y = least(j, w->size[1] - 1 - j), z = least(k, w->size[2] - 1 - k);
                const uint32_t depth = w->size[2] > 2 ? least(x, least(y, z)) : least(x, y);
                w->is_wall[walls_at(w, i, j, k)] = depth % 2 == first;
            }
}

/* A hole through each shell, at either end in turn: spirals. */
static void draw_spiral(random_source *r, walls *w)
{
    draw_shells(r, w);
    const uint32_t j = w->size[1] / 2, k = w->size[2] / 2;
    for (uint32_t i = 0; i < w->size[0]; i++)
        if (i / 2 % 2)
            w->is_wall[walls_at(w, least(i, w->size[0] - 1 - i), j, k)] = 0;
        else
            w->is_wall[walls_at(w, w->size[0] - 1 - least(i, w->size[0] - 1 - i), j, k)] = 0;
}

/* Walls across axis a, open at the ends of axis b in turn. */
static void draw_comb(random_source *r, walls *w)
{
    const int a = random_int(r, 3), b = (a + random_int_between(r, 1, 2)) % 3;
    const bool is_open = random_int(r, 2);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++) {
                const uint32_t at[3] = {i, j, k};
                const uint32_t end = at[a] / 2 % 2 ? 0 : w->size[b] - 1, other = 3 - (uint32_t)a - (uint32_t)b;
                const bool is_rim = at[b] == 0 || at[b] + 1 == w->size[b] || at[other] == 0 || at[other] + 1 == w->size[other];
                w->is_wall[walls_at(w, i, j, k)] = (at[a] % 2 && at[b] != end) || (!is_open && is_rim && at[b] != end);
            }
}

/* Corridors of one cell through a block, each on from where one was, and one that leads out of it. */
static void draw_labyrinth(random_source *r, walls *w)
{
    memset(w->is_wall, 1, sizeof w->is_wall);
    uint32_t at[3];
    for (int a = 0; a < 3; a++)
        at[a] = (uint32_t)random_int(r, (int)w->size[a]);
    for (size_t step = 0; step < cells_of(w); step++) {
        const int a = random_int(r, 3), length = random_int_between(r, 1, a ? 4 : 70);
        const bool is_up = random_int(r, 2);
        for (int n = 0; n < length; n++) {
            w->is_wall[walls_at(w, at[0], at[1], at[2])] = 0;
            if (is_up ? at[a] + 1 == w->size[a] : at[a] == 0)
                break;
            at[a] += is_up ? 1 : UINT32_MAX;
        }
        step += (size_t)length * 3;
    }
}

static bool is_border(const walls *w, uint32_t i, uint32_t j, uint32_t k)
{
    return !i || !j || !k || i + 1 == w->size[0] || j + 1 == w->size[1] || k + 1 == w->size[2];
}

/* A block whose border is a wall, with corridors or noise in it. */
static void close_border(walls *w)
{
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++)
                if (is_border(w, i, j, k))
                    w->is_wall[walls_at(w, i, j, k)] = 1;
}

static const struct {
    const char *name;
    void (*draw)(random_source *r, walls *w);
} kinds[] = {
    {"noise", draw_noise}, {"shells", draw_shells}, {"spiral", draw_spiral}, {"comb", draw_comb}, {"labyrinth", draw_labyrinth}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* Of any size, often one row, one layer or a word and a few cells; of kind `number`, or of some with a hole in it. */
static void walls_draw(random_source *r, size_t number, walls *w)
{
    draw_size(r, w);
    w->kind = kinds[number].name;
    kinds[number].draw(r, w);
    if (!random_int(r, 3))
        close_border(w);
    for (int holes = random_int(r, 3); holes > 0; holes--)
        w->is_wall[random_below(r, cells_of(w))] = 0;
}

/* Which free cells are reached from outside, cell by cell from all that lies on the border. Returns the number of cells reached. */
static size_t walls_search(const walls *w, unsigned char is_reached[WALLS_CELLS])
{
    static uint32_t queue[WALLS_CELLS][3];
    size_t head = 0, tail = 0;
    memset(is_reached, 0, WALLS_CELLS);
    for (uint32_t k = 0; k < w->size[2]; k++)
        for (uint32_t j = 0; j < w->size[1]; j++)
            for (uint32_t i = 0; i < w->size[0]; i++)
                if (is_border(w, i, j, k) && !w->is_wall[walls_at(w, i, j, k)]) {
                    is_reached[walls_at(w, i, j, k)] = 1;
                    memcpy(queue[tail++], (uint32_t[3]){i, j, k}, sizeof queue[0]);
                }
    for (; head < tail; head++)
        for (int side = 0; side < 6; side++) {
            uint32_t to[3];
            memcpy(to, queue[head], sizeof to);
            to[side / 2] += side % 2 ? 1 : UINT32_MAX;
            if (to[side / 2] >= w->size[side / 2])
                continue;
            const size_t at = walls_at(w, to[0], to[1], to[2]);
            if (!w->is_wall[at] && !is_reached[at]) {
                is_reached[at] = 1;
                memcpy(queue[tail++], to, sizeof to);
            }
        }
    return tail;
}

/* ------------------------------------------------------------------------------------------------------------------------ parts */

static walls drawn;
static unsigned char is_reached[WALLS_CELLS];

/* A part: where it begins, its cells, and what is kept of it. */
typedef struct part {
    uint32_t first[3], size[3];
    uint32_t from, labels; /* its labels among all */
    uint32_t *faces[6];
    guarded face_pages[6], words, solid, scratch;
    uint32_t off;  /* of its scratch from an aligned place */
    bool is_empty; /* taken as one label, without a call */
} part;

/* A grid cut into parts by planes on each axis: parts are numbered along x, then y, then z. */
typedef struct cut_grid {
    uint32_t border[3][WALLS_CELLS + 1];
    uint32_t along[3];
    part parts[PARTS_MAX];
    uint32_t *parents;
    uint32_t labels;
} cut_grid;

static cut_grid cut;

/* Tiles of one side, or any borders. */
static void cut_axis(random_source *r, uint32_t size, uint32_t side, uint32_t *border, uint32_t *along)
{
    *along = 0;
    for (uint32_t at = 0; at < size; at += side ? side : (uint32_t)random_int_between(r, 1, (int)size))
        border[(*along)++] = at;
    border[*along] = size;
}

static void cut_all(random_source *r, uint32_t side)
{
    for (int a = 0; a < 3; a++)
        cut_axis(r, drawn.size[a], side, cut.border[a], &cut.along[a]);
}

static size_t parts_of(void) { return (size_t)cut.along[0] * cut.along[1] * cut.along[2]; }

static bool cut_walls(random_source *r)
{
    static const uint32_t sides[] = {0, 0, 3, 8, 16, 64, 128};
    const uint32_t side = sides[random_int(r, sizeof sides / sizeof sides[0])];
    cut_all(r, side);
    return parts_of() <= PARTS_MAX;
}

static size_t bytes_of(const part *p) { return tribox_window_words(p->size) * sizeof(uint64_t); }

/* With bits of any kind past the end of each row. */
static void set_words(random_source *r, part *p)
{
    uint64_t *const words = guarded_room(&p->words, bytes_of(p));
    p->is_empty = true;
    for (uint32_t k = 0; k < p->size[2]; k++)
        for (uint32_t j = 0; j < p->size[1]; j++)
            for (uint32_t i = 0; i < 64 * window_row(p->size); i++) {
                const bool is_cell = i < p->size[0];
                const bool is =
                    is_cell ? drawn.is_wall[walls_at(&drawn, p->first[0] + i, p->first[1] + j, p->first[2] + k)] : random_int(r, 2);
                window_put(p->size, words, i, j, k, is);
                p->is_empty = p->is_empty && !(is_cell && is);
            }
    guarded_read_only(p->words, true);
}

static const uint64_t *words_of(const part *p) { return guarded_tail(p->words, bytes_of(p)); }

static size_t face_cells(const part *p, int face) { return (size_t)p->size[face < 2 ? 1 : 0] * p->size[face < 4 ? 2 : 1]; }

static void label(random_source *r, part *p)
{
    const size_t bytes = tribox_fill_labels_bytes(p->size);
    p->off = random_int(r, 2) ? (uint32_t)random_int(r, 8) : 0;
    unsigned char *const scratch = guarded_room(&p->scratch, bytes + p->off);
    const int any = random_int(r, 256);
    memset(p->scratch.first, any, p->scratch.size);
    for (int face = 0; face < 6; face++)
        p->faces[face] = guarded_room(&p->face_pages[face], face_cells(p, face) * sizeof(uint32_t));
    assert_int_equal(tribox_fill_labels(p->size, words_of(p), scratch, p->faces, &p->labels), TRIBOX_OK);
    for (size_t n = 0; n < p->off; n++)
        assert_int_equal(scratch[bytes + n], any);
    p->from = cut.labels;
    cut.labels += p->labels;
}

/* One label does for a part without walls: every other one of these is taken so. */
static void label_all(random_source *r)
{
    cut.labels = 1;
    for (size_t n = 0; n < parts_of(); n++) {
        part *const p = &cut.parts[n];
        const uint32_t at[3] = {(uint32_t)(n % cut.along[0]), (uint32_t)(n / cut.along[0] % cut.along[1]),
                                (uint32_t)(n / cut.along[0] / cut.along[1])};
        for (int a = 0; a < 3; a++) {
            p->first[a] = cut.border[a][at[a]];
            p->size[a] = cut.border[a][at[a] + 1] - p->first[a];
        }
        set_words(r, p);
        label(r, p);
        if (p->is_empty)
            assert_int_equal(p->labels, 1);
        p->is_empty = p->is_empty && random_int(r, 2);
    }
}

static void join(uint32_t number_a, int face, const part *b)
{
    const part *const a = &cut.parts[number_a];
    const uint32_t *const of_a = a->is_empty ? NULL : a->faces[face];
    const uint32_t *const of_b = !b || b->is_empty ? NULL : b->faces[face ^ 1];
    const uint32_t from_b = b ? b->from : 0;
    if (of_a)
        assert_int_equal(tribox_fill_join(cut.parents, of_a, a->from, of_b, from_b, face_cells(a, face)), TRIBOX_OK);
    else
        assert_int_equal(tribox_fill_join(cut.parents, of_b ? of_b : (const uint32_t[1]){0}, from_b, NULL, a->from,
                                          of_b ? face_cells(a, face) : 1),
                         TRIBOX_OK);
}

/* In any order: from a part on, then from the first. */
static void join_all(random_source *r)
{
    const uint32_t parts = (uint32_t)parts_of(), first = (uint32_t)random_int(r, (int)parts);
    const uint32_t step[3] = {1, cut.along[0], cut.along[0] * cut.along[1]};
    cut.parents = malloc(cut.labels * sizeof *cut.parents);
    for (uint32_t n = 0; n < cut.labels; n++)
        cut.parents[n] = n;
    for (uint32_t m = 0; m < parts; m++) {
        const uint32_t n = (first + m) % parts;
        for (int a = 0; a < 3; a++) {
            const uint32_t at = n / step[a] % cut.along[a];
            if (!at)
                join(n, 2 * a, NULL);
            join(n, 2 * a + 1, at + 1 < cut.along[a] ? &cut.parts[n + step[a]] : NULL);
        }
    }
}

/* Scratch is moved to an address of another alignment, and cannot be written there. */
static size_t fill_part(part *p, uint32_t off)
{
    static guarded moved;
    const size_t scratch_bytes = tribox_fill_labels_bytes(p->size);
    void *const scratch = guarded_room(&moved, scratch_bytes + off);
    memcpy(scratch, guarded_tail(p->scratch, scratch_bytes + p->off), scratch_bytes);
    guarded_read_only(moved, true);
    uint64_t outside[WALLS_CELLS / 64 + 1] = {0};
    size_t inside = SIZE_MAX;
    const size_t bytes = bytes_of(p);
    for (uint32_t n = 0; n < p->labels; n++)
        outside[n / 64] |= (uint64_t)(tribox_fill_root(cut.parents, p->from + n) == tribox_fill_root(cut.parents, 0)) << n % 64;
    guarded_room(&p->solid, bytes);
    memset(p->solid.first, 0x5a, p->solid.size);
    assert_int_equal(tribox_fill_labelled(p->size, words_of(p), scratch, outside, guarded_tail(p->solid, bytes), &inside),
                     TRIBOX_OK);
    return inside;
}

static void check_part(const part *p)
{
    const uint64_t *const solid = guarded_tail(p->solid, bytes_of(p));
    for (uint32_t k = 0; k < p->size[2]; k++)
        for (uint32_t j = 0; j < p->size[1]; j++)
            for (uint32_t i = 0; i < 64 * window_row(p->size); i++) {
                const bool is = window_bit(p->size, solid, i, j, k);
                const bool is_right =
                    i < p->size[0] && !is_reached[walls_at(&drawn, p->first[0] + i, p->first[1] + j, p->first[2] + k)];
                if (is != is_right)
                    fail_msg("%s: cell %u, %u, %u of the part at %u, %u, %u is %s", doing, i, j, k, p->first[0], p->first[1],
                             p->first[2], is ? "filled" : "not filled");
            }
}

/* The whole as one part. Scratch is at any address, and no byte past what was asked for is written. */
static size_t fill_whole(random_source *r)
{
    static part whole;
    memcpy(whole.size, drawn.size, sizeof whole.size);
    set_words(r, &whole);
    const size_t bytes = bytes_of(&whole);
    const size_t scratch_bytes = tribox_fill_bytes(drawn.size), after = random_below(r, 8);
    unsigned char *const scratch = guarded_room(&whole.scratch, scratch_bytes + after);
    const int any = random_int(r, 256);
    size_t inside = SIZE_MAX;
    memset(whole.scratch.first, any, whole.scratch.size);
    guarded_room(&whole.solid, bytes);
    memset(whole.solid.first, random_int(r, 256), whole.solid.size);
    assert_int_equal(tribox_fill_outside(drawn.size, words_of(&whole), scratch, guarded_tail(whole.solid, bytes),
                                         random_int(r, 4) ? &inside : NULL),
                     TRIBOX_OK);
    for (size_t n = 0; n < after; n++)
        assert_int_equal(scratch[scratch_bytes + n], any);
    check_part(&whole);
    return inside;
}

static void check_drawn(random_source *r)
{
    const size_t reached = walls_search(&drawn, is_reached);
    size_t free_cells = 0, inside = 0;
    for (size_t n = 0; n < cells_of(&drawn); n++)
        free_cells += !drawn.is_wall[n];
    const size_t of_whole = fill_whole(r);
    label_all(r);
    join_all(r);
    for (size_t n = 0; n < parts_of(); n++) {
        inside += fill_part(&cut.parts[n], (uint32_t)random_int(r, 8));
        check_part(&cut.parts[n]);
    }
    free(cut.parents);
    if (inside != free_cells - reached || (of_whole != SIZE_MAX && of_whole != inside))
        fail_msg("%s: %zu are inside, not %zu, nor %zu", doing, free_cells - reached, inside, of_whole);
}

CASE(test_parts)
{
    random_source r = random_named(args.seed, "fill labels");
    for (size_t round = 0; round < ROUNDS * arguments_rounds(&args, PAIRS) / (arguments_are_short(&args) ? 10 : 1); round++) {
        walls_draw(&r, round % KINDS, &drawn);
        if (!cut_walls(&r))
            continue;
        snprintf(doing, sizeof doing, "round %zu, %s in %u x %u x %u, %u x %u x %u parts", round, drawn.kind, drawn.size[0],
                 drawn.size[1], drawn.size[2], cut.along[0], cut.along[1], cut.along[2]);
        check_drawn(&r);
    }
}

/* Walls at every other cell: the most labels, and not one more run than there is scratch for. */
CASE(test_checkerboard)
{
    memset(&drawn, 0, sizeof drawn);
    memcpy(drawn.size, (uint32_t[3]){129, 17, 17}, sizeof drawn.size);
    drawn.kind = "checkerboard";
    for (uint32_t k = 0; k < drawn.size[2]; k++)
        for (uint32_t j = 0; j < drawn.size[1]; j++)
            for (uint32_t i = 0; i < drawn.size[0]; i++)
                drawn.is_wall[walls_at(&drawn, i, j, k)] = (i + j + k) % 2;
    static const uint32_t sides[] = {8, 16, 64, 128};
    random_source r = random_named(1, "fill checkerboard");
    for (size_t n = 0; n < 4; n++) {
        cut_all(&r, sides[n]);
        snprintf(doing, sizeof doing, "checkerboard, parts of %u", sides[n]);
        check_drawn(&r);
    }
}

/* A corridor of rows that repeat each other, all bits of them, which one cell of another layer opens. */
CASE(test_repeated_rows)
{
    random_source r = random_named(1, "fill repeated rows");
    memset(&drawn, 0, sizeof drawn);
    memcpy(drawn.size, (uint32_t[3]){64, 9, 3}, sizeof drawn.size);
    drawn.kind = "corridor";
    for (uint32_t hole = 1; hole < 8; hole++) {
        memset(drawn.is_wall, 1, sizeof drawn.is_wall);
        for (uint32_t j = 1; j < 8; j++)
            drawn.is_wall[walls_at(&drawn, 2, j, 1)] = 0;
        drawn.is_wall[walls_at(&drawn, 2, hole, 0)] = 0;
        cut_all(&r, 64);
        snprintf(doing, sizeof doing, "corridor open at %u", hole);
        check_drawn(&r);
    }
}

PROGRAM(RUN(test_parts), RUN(test_checkerboard), RUN(test_repeated_rows))
