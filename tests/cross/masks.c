/*
 * masks.c - digests of the answers to every scene: what is EXACT has the same ones on every processor, whatever compiled it.
 *
 * After each round the kernels that run here have the same digests: of EXACT all, of FAST and CONSERVATIVE those of one rounding.
 * Depends on nothing.
 *
 *   masks [options of arguments.h]          prints a line for each scene: digests of what is drawn, of EXACT, and of CONSERVATIVE
 *                                           and FAST, of kernels that round twice and of those that round once
 *   masks FILE [options of arguments.h]     compares them with the lines of the file instead
 *   masks parts [options of arguments.h]    prints besides the digests of every call and kernel, after each round: where a line of
 *                                           the file differs, the first difference from what this prints elsewhere, or of an older
 *                                           library, tells round and call; `--scenes NAME` keeps it short
 *
 * The first form, and after it the first form with --short, write masks.txt: emulated processors take a tenth of the pairs. Other
 * scenes or tighter margins need it rewritten; but a new margin may change the last two digests of a line alone.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/arguments.h"
#include "drawn_pairs.h"
#include "index/kernel_nodes.h"
#include "masks_f64.h"
#include "common/kernels_here.h"

enum { PAIRS_A_ROUND = 10000, SELDOM = 5 /* rounds to those that ask what takes long */ };

static const unsigned orders[] = {123, 132, 213, 231, 312, 321};
enum { ORDERS = sizeof orders / sizeof orders[0] };

static const char *names[KERNELS_MAX]; /* the scalar kernel first */
static int kernels;

/* What is digested of a scene. The last four are the same only among kernels of one rounding. */
typedef enum part {
    DRAWN, /* what is asked, not an answer */
    EXACT,
    AXES, /* the fewer axes */
    MESHES,
    ORIENTED,
    VOXELS,
    IDS,
    INDEX,
    CONSERVATIVE_TWICE, /* rounded twice: scalar */
    FAST_TWICE,
    CONSERVATIVE_ONCE,
    FAST_ONCE,
    PARTS
} part;

static const char *const part_names[PARTS] = {"drawn", "exact", "axes",          "meshes", "oriented",      "voxels",
                                              "ids",   "index", "conservative2", "fast2",  "conservative1", "fast1"};

/* One round of a scene. */
typedef struct round_of_scene {
    drawn_numbers numbers[2]; /* many triangles and a box; a triangle and many boxes */
    tribox_soup soup;
    tribox_box box;
    tribox_boxes boxes;
    const float (*triangle)[3];
    tribox_oriented_box oriented;
    tribox_grid grid;
} round_of_scene;

static void put_status(digest *to, tribox_status status) { digest_add(to, &(uint64_t){(uint64_t)status}, 1); }

/* A grid about the box, whose rows take two words. Where it is too fine for double, the answer is TRIBOX_BAD_GRID. */
static tribox_grid grid_about(const tribox_box *box)
{
    tribox_grid grid = {.size = {70, 6, 5}};
    for (int a = 0; a < 3; a++) {
        const float length = (float)box->hi[a] - (float)box->lo[a];
        const float cell = length > 0 ? length / (a ? 3 : 32) : 0.125f;
        grid.cell[a] = cell;
        grid.origin[a] = (float)box->lo[a] - cell * (a ? 1 : 8);
    }
    return grid;
}

/* The middle of the box, and axes that are neither quite perpendicular nor quite of length one. */
static tribox_oriented_box oriented_about(random_source *r, const tribox_box *box)
{
    tribox_oriented_box oriented;
    for (int k = 0; k < 3; k++) {
        oriented.center[k] = (float)box->lo[k] / 2 + (float)box->hi[k] / 2;
        oriented.half[k] = (float)box->hi[k] / 2 - (float)box->lo[k] / 2;
        for (int a = 0; a < 3; a++)
            oriented.axis[k][a] = (float)(k == a) + (float)random_int_between(r, -64, 64) / 256;
    }
    return oriented;
}

static void draw_round(random_source *r, const scene *s, round_of_scene *round)
{
    const pair_list triangles = draw_pairs(r, s, true, &round->numbers[0]);
    const pair_list boxes = draw_pairs(r, s, false, &round->numbers[1]);
    round->soup.count = triangles.count;
    round->boxes.count = boxes.count;
    for (int k = 0; k < 3; k++) {
        round->soup.x[k] = triangles.stream[k];
        round->soup.y[k] = triangles.stream[3 + k];
        round->soup.z[k] = triangles.stream[6 + k];
        round->boxes.lo[k] = boxes.stream[k];
        round->boxes.hi[k] = boxes.stream[3 + k];
    }
    round->box = *triangles.box;
    round->triangle = boxes.triangle;
    round->grid = grid_about(&round->box);
    round->oriented = oriented_about(r, &round->box);
}

static void digest_numbers(digest *d, const float *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        digest_add(d, &(uint64_t){bits}, 1);
    }
}

/* Of doubles that are floats. */
static void digest_doubles_as_floats(digest *d, const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        digest_numbers(d, &(float){(float)numbers[i]}, 1);
}

static void digest_round(digest *d, const round_of_scene *round)
{
    for (int k = 0; k < 3; k++) {
        digest_numbers(d, round->soup.x[k], round->soup.count);
        digest_numbers(d, round->soup.y[k], round->soup.count);
        digest_numbers(d, round->soup.z[k], round->soup.count);
        digest_numbers(d, round->boxes.lo[k], round->boxes.count);
        digest_numbers(d, round->boxes.hi[k], round->boxes.count);
        digest_numbers(d, round->triangle[k], 3);
        digest_doubles_as_floats(d, round->oriented.axis[k], 3);
    }
    for (int k = 0; k < 6; k++)
        digest_numbers(d, &(float){(float)(k < 3 ? round->box.lo : round->box.hi)[k % 3]}, 1);
    digest_doubles_as_floats(d, round->oriented.center, 3);
    digest_doubles_as_floats(d, round->oriented.half, 3);
    digest_doubles_as_floats(d, round->grid.origin, 3);
    digest_doubles_as_floats(d, round->grid.cell, 3);
}

enum { MASK = (SCENE_TRIANGLES + 63) / 64 };

/* Triangles and boxes, and which triangles lie inside. */
static void ask_pairs(const round_of_scene *round, const tribox_options *options, digest *to)
{
    uint64_t mask[MASK] = {0}, inside[MASK] = {0}, boxes[MASK] = {0};
    const tribox_status status = tribox_classify(&round->soup, &round->box, options, mask, inside, NULL);
    digest_add(to, mask, tribox_mask_words(round->soup.count));
    digest_add(to, inside, tribox_mask_words(round->soup.count));
    put_status(to, status);
    const tribox_status of_boxes = tribox_overlap_boxes((const float *)round->triangle, &round->boxes, options, boxes, NULL);
    digest_add(to, boxes, tribox_mask_words(round->boxes.count));
    put_status(to, of_boxes);
}

/*
 * The same triangles by index, the last vertex first, or as nine floats each; a vertex is three floats, or four, one of them
 * unused.
 */
static void ask_meshes(const round_of_scene *round, const tribox_options *options, digest *to)
{
    static float positions[12 * SCENE_TRIANGLES];
    uint16_t narrow[3 * SCENE_TRIANGLES];
    uint32_t wide[3 * SCENE_TRIANGLES];
    const size_t count = round->soup.count, corners = 3 * count;
    for (int floats = 3; floats <= 4; floats++)
        for (unsigned index_bytes = 0; index_bytes <= 4; index_bytes += 2) {
            for (size_t corner = 0; corner < corners; corner++) {
                const size_t number = index_bytes ? corners - 1 - corner : corner;
                const float at[3] = {round->soup.x[corner % 3][corner / 3], round->soup.y[corner % 3][corner / 3],
                                     round->soup.z[corner % 3][corner / 3]};
                memcpy(positions + (size_t)floats * number, at, sizeof at);
                wide[corner] = narrow[corner] = (uint16_t)number;
            }
            const tribox_mesh mesh = {.positions = positions,
                                      .stride = (size_t)floats * sizeof(float),
                                      .vertices = corners,
                                      .indices = index_bytes == 2 ? (void *)narrow
                                                 : index_bytes    ? (void *)wide
                                                                  : NULL,
                                      .index_bytes = index_bytes,
                                      .count = count};
            uint64_t mask[MASK] = {0};
            const tribox_status status = tribox_mesh_overlap(&mesh, &round->box, options, mask, NULL);
            digest_add(to, mask, tribox_mask_words(count));
            put_status(to, status);
        }
}

static void ask_oriented(const round_of_scene *round, const tribox_options *options, digest *to)
{
    uint64_t mask[MASK] = {0};
    const tribox_status status = tribox_overlap_oriented(&round->soup, &round->oriented, options, mask, NULL);
    digest_add(to, mask, tribox_mask_words(round->soup.count));
    put_status(to, status);
}

enum { CELLS = 70 * 6 * 5, GRID_WORDS = 2 * 6 * 5 };

static void ask_voxels(const round_of_scene *round, const tribox_options *options, digest *to)
{
    uint64_t occupied[GRID_WORDS] = {0};
    const tribox_status status = tribox_voxelize(&round->soup, &round->grid, NULL, options, occupied, NULL);
    digest_add(to, occupied, GRID_WORDS);
    put_status(to, status);
}

/* Of each cell that is set, two ids in a word. */
static void ask_ids(const round_of_scene *round, const tribox_options *options, digest *to)
{
    uint32_t ids[CELLS];
    uint64_t occupied[GRID_WORDS] = {0}, words[CELLS / 2] = {0};
    put_status(to, tribox_voxelize_ids(&round->soup, 0, &round->grid, NULL, options, occupied, ids, NULL));
    for (size_t n = 0; n < CELLS; n++)
        if (occupied[n / 70 * 2 + n % 70 / 64] >> n % 70 % 64 & 1)
            words[n / 2] |= (uint64_t)(ids[n] + 1) << n % 2 * 32;
    digest_add(to, words, CELLS / 2);
}

/* More triangles than a node of the lowest level has: those of the round, over and over, some of them with a NaN. */
enum { TURNS = 45, REPEATED = TURNS * SCENE_TRIANGLES, NODES = 3 };

static tribox_soup repeated(const round_of_scene *round)
{
    static float stream[9][REPEATED];
    tribox_soup soup = {.count = REPEATED};
    for (int k = 0; k < 9; k++) {
        const float *const from = (k < 3 ? round->soup.x : k < 6 ? round->soup.y : round->soup.z)[k % 3];
        for (size_t i = 0; i < REPEATED; i++)
            memcpy(&stream[k][i], &from[i % SCENE_TRIANGLES], sizeof(float));
        for (size_t turn = 0; turn < TURNS; turn += 9)
            stream[k][(turn + (size_t)k) * SCENE_TRIANGLES + turn] = NAN;
        (k < 3 ? soup.x : k < 6 ? soup.y : soup.z)[k % 3] = stream[k];
    }
    return soup;
}

/* The nodes over many triangles, number by number, as the order of their bytes is the processor's. */
static void build_index(const round_of_scene *round, const tribox_options *options, digest *to)
{
    static tribox_node nodes[NODES];
    const tribox_soup soup = repeated(round);
    if (tribox_index_bytes(REPEATED) != sizeof nodes) {
        fputs("masks.c: NODES is wrong\n", stderr);
        exit(2);
    }
    put_status(to, tribox_index_build(&(tribox_index){.soup = &soup}, options, nodes));
    for (size_t n = 0; n < NODES; n++) {
        uint64_t bounds[6 * 32] = {0}, whole = nodes[n].whole;
        for (size_t k = 0; k < 6 * 64; k++) {
            uint32_t bits;
            memcpy(&bits, &nodes[n].bound[k / 64][k % 64], sizeof bits);
            bounds[k / 2] |= (uint64_t)bits << 32 * (k % 2);
        }
        digest_add(to, bounds, 6 * 32);
        digest_add(to, &whole, 1);
    }
}

static void put_numbers(digest *to, const uint32_t *numbers, size_t count)
{
    for (size_t k = 0; k < count; k++)
        digest_add(to, &(uint64_t){numbers[k]}, 1);
}

/* All forms of one question, and the starts of many lists. */
static void ask_index(const round_of_scene *round, const tribox_options *options, digest *to)
{
    static tribox_node nodes[NODES];
    uint32_t number[SCENE_TRIANGLES];
    uint64_t mask[MASK] = {0}, bits[MASK] = {0}, inside[MASK] = {0}, oriented[MASK] = {0};
    size_t found, start[SCENE_TRIANGLES + 1];
    const size_t words = tribox_mask_words(round->soup.count);
    const tribox_region box = {.box = &round->box}, turned = {.oriented = &round->oriented};
    const tribox_index index = {.nodes = nodes, .soup = &round->soup};
    build_index(round, options, to);
    put_status(to, tribox_index_build(&index, options, nodes));
    const tribox_status overlap = tribox_index_overlap(&index, &box, options, mask, NULL);
    const tribox_status of_words = tribox_index_words(&index, &box, options, words, number, bits, inside, &found, NULL);
    digest_add(to, mask, words);
    digest_add(to, bits, words);
    digest_add(to, inside, words);
    put_status(to, overlap);
    put_status(to, of_words);
    put_numbers(to, number, found);
    put_status(to, tribox_index_list(&index, &box, options, SCENE_TRIANGLES, number, &found));
    put_numbers(to, number, found);
    put_status(to, tribox_index_any(&index, &box, options, &found));
    digest_add(to, &(uint64_t){found}, 1);
    const tribox_status of_turned = tribox_index_overlap(&index, &turned, options, oriented, NULL);
    digest_add(to, oriented, words);
    put_status(to, of_turned);
    put_status(to, tribox_index_list(&index, &turned, options, SCENE_TRIANGLES, number, &found));
    put_numbers(to, number, found);
    put_status(to, tribox_index_lists(&index, &round->boxes, options, 0, NULL, start));
    for (size_t b = 0; b <= round->boxes.count; b++)
        digest_add(to, &(uint64_t){start[b]}, 1);
}

/* What is asked at the moment, for the message. */
static const char *scene_name;
static size_t round_number;

static void die(const char *kernel, const char *whom)
{
    fprintf(stderr, "scene %s, round %zu: kernel %s answers otherwise than %s\n", scene_name, round_number, kernel, whom);
    exit(1);
}

/* Every set of axes, in every order. */
static void ask_axes(const round_of_scene *round, const char *kernel, digest *d)
{
    for (unsigned axes = 1; axes <= TRIBOX_AXES_ALL; axes++) {
        digest expected = *d;
        ask_pairs(round, &(tribox_options){.axes = axes, .kernel = kernel}, &expected);
        for (size_t o = 0; o < ORDERS; o++) {
            digest got = *d;
            ask_pairs(round, &(tribox_options){.axes = axes, .axis_order = orders[o], .kernel = kernel}, &got);
            if (got != expected)
                die(kernel, "in another order of the axes");
        }
        *d = expected;
    }
}

/* FAST promises something for |coordinate| <= 2^40; beyond, what a NaN comes to depends on the kernel. */
static bool is_in_fast_range(const scene *s) { return !strcmp(s->family, "ordinary") || !strcmp(s->family, "contact"); }

static void ask_round(const round_of_scene *round, const scene *s, const char *kernel, digest digests[PARTS])
{
    const tribox_options exact = {.kernel = kernel};
    const tribox_options conservative = {.accuracy = TRIBOX_CONSERVATIVE, .kernel = kernel};
    const tribox_options fast = {.accuracy = TRIBOX_FAST, .kernel = kernel};
    const bool is_fused = kernel_is_fused(kernel);
    digest_round(&digests[DRAWN], round);
    ask_pairs(round, &exact, &digests[EXACT]);
    ask_meshes(round, &exact, &digests[MESHES]);
    ask_voxels(round, &exact, &digests[VOXELS]);
    ask_ids(round, &exact, &digests[IDS]);
    ask_oriented(round, &exact, &digests[ORIENTED]);
    if (round_number % SELDOM == 0) {
        ask_index(round, &exact, &digests[INDEX]);
        ask_axes(round, kernel, &digests[AXES]);
    }
    ask_pairs(round, &conservative, &digests[is_fused ? CONSERVATIVE_ONCE : CONSERVATIVE_TWICE]);
    if (is_in_fast_range(s))
        ask_pairs(round, &fast, &digests[is_fused ? FAST_ONCE : FAST_TWICE]);
}

/* The file to compare with, if any, and what came of it. */
static const char *expected_text;
static size_t scenes_compared, drawn_otherwise, differing;

/* What the file has of a scene: digests of parts that come one after the other. The last two depend on who runs here. */
enum { GROUPS = 4 };
static const part group_start[GROUPS + 1] = {DRAWN, EXACT, CONSERVATIVE_TWICE, CONSERVATIVE_ONCE, PARTS};
static const char *const group_names[GROUPS] = {"drawn", "EXACT", "rounded twice", "rounded once"};

enum { DIGEST_ROOM = 17 };

static void write_group(const digest digests[PARTS], int g, char text[DIGEST_ROOM])
{
    bool has_answers = false;
    digest all = digest_start;
    for (part p = group_start[g]; p < group_start[g + 1]; p++) {
        has_answers |= digests[p] != digest_start;
        digest_add(&all, &digests[p], 1);
    }
    snprintf(text, DIGEST_ROOM, has_answers ? "%016" PRIx64 : "-", all);
}

/* Compares the digests of a scene. Where another libm drew its numbers otherwise there is nothing to compare. */
static void compare_scene(const char *name, char got[GROUPS][DIGEST_ROOM])
{
    char line[72], expected[GROUPS][DIGEST_ROOM] = {"none"};
    const int length = snprintf(line, sizeof line, "\n%s ", name);
    const char *const found = strstr(expected_text, line);
    if (found)
        sscanf(found + length, "%16s %16s %16s %16s", expected[0], expected[1], expected[2], expected[3]);
    for (int g = 0; g < GROUPS; g++) {
        if (!strcmp(got[g], expected[g]) || !strcmp(got[g], "-"))
            continue;
        fprintf(stderr, "%s, %s: the digest is %s, expected was %s\n", name, group_names[g], got[g], expected[g]);
        if (!g) {
            drawn_otherwise++;
            return;
        }
        differing++;
    }
    scenes_compared++;
}

static void tell_scene(const char *name, const digest digests[PARTS])
{
    char text[GROUPS][DIGEST_ROOM];
    for (int g = 0; g < GROUPS; g++)
        write_group(digests, g, text[g]);
    if (expected_text)
        compare_scene(name, text);
    else
        printf("%s %s %s %s %s\n", name, text[0], text[1], text[2], text[3]);
}

/* The digests so far, one a line. */
static bool has_parts;

static void tell_parts(const char *name, const char *kernel, const digest digests[PARTS])
{
    for (part p = 0; has_parts && p < PARTS; p++)
        if (digests[p] != digest_start)
            printf("%s round %zu %s %s %016" PRIx64 "\n", name, round_number, kernel, part_names[p], digests[p]);
}

/* Those of a kernel that others have too are the same. */
static void join_digests(const char *kernel, const digest of_kernel[PARTS], digest digests[PARTS])
{
    for (part p = 0; p < PARTS; p++) {
        if (digests[p] == digest_start)
            digests[p] = of_kernel[p];
        if (of_kernel[p] != digest_start && of_kernel[p] != digests[p]) {
            fprintf(stderr, "%s: ", part_names[p]);
            die(kernel, "another one before it");
        }
    }
}

static void begin_digests(digest digests[PARTS])
{
    for (part p = 0; p < PARTS; p++)
        digests[p] = digest_start;
}

static void ask_scene(const scene *s, const arguments *args)
{
    static round_of_scene round;
    random_source r = random_named(args->seed, s->name);
    digest digests[PARTS], of_kernel[KERNELS_MAX][PARTS];
    begin_digests(digests);
    for (int k = 0; k < kernels; k++)
        begin_digests(of_kernel[k]);
    scene_name = s->name;
    for (round_number = 0; round_number < args->pairs / PAIRS_A_ROUND; round_number++) {
        draw_round(&r, s, &round);
        begin_digests(digests);
        for (int k = 0; k < kernels; k++) {
            ask_round(&round, s, names[k], of_kernel[k]);
            tell_parts(s->name, names[k], of_kernel[k]);
            join_digests(names[k], of_kernel[k], digests);
        }
    }
    tell_scene(s->name, digests);
}

/* Scenes of doubles have names of their own in the file. */
static void ask_doubles(const scene_f64 *s, const arguments *args)
{
    char name[64];
    digest digests[PARTS];
    begin_digests(digests);
    const digests_f64 of = digests_f64_of(s, args->seed, args->pairs / PAIRS_A_ROUND);
    digests[DRAWN] = of.drawn;
    digests[EXACT] = of.exact;
    digests[AXES] = of.axes;
    digests[MESHES] = of.meshes;
    snprintf(name, sizeof name, "f64-%s", s->name);
    tell_parts(name, "all", digests);
    tell_scene(name, digests);
}

enum { TEXT_MAX = 1 << 20 };

/* The text of a file, with a line's end before the first line. */
static const char *text_of(const char *path)
{
    static char text[TEXT_MAX] = "\n";
    FILE *const file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "%s: cannot be read; give a file that this program printed\n", path);
        exit(2);
    }
    text[1 + fread(text + 1, 1, TEXT_MAX - 2, file)] = 0;
    fclose(file);
    return text;
}

/* What the file has from these arguments on, or NULL. */
static const char *expected_for(const char *text, const arguments *args)
{
    char lines[64];
    snprintf(lines, sizeof lines, "\nseed %" PRIu64 "\npairs %zu\n", args->seed, args->pairs);
    return strstr(text, lines);
}

int main(int argc, char **argv)
{
    has_parts = argc > 1 && !strcmp(argv[1], "parts");
    const bool has_word = argc > 1 && argv[1][0] != '-', has_file = has_word && !has_parts;
    const char *const text = has_file ? text_of(argv[1]) : NULL;
    const arguments args = arguments_parse(argc - has_word, argv + has_word);
    printf("pairs %zu\n", args.pairs);
    if (!scene_name_is_known(args.scenes))
        return 2;
    expected_text = has_file ? expected_for(text, &args) : NULL;
    if (has_file && !expected_text) {
        printf("%s: of another seed, or of other pairs: skipped\n", argv[1]);
        return 77;
    }
    kernels = kernels_here(names);
    for (size_t i = 0; i < scene_count(); i++)
        if (scene_is_called(scene_at(i), args.scenes))
            ask_scene(scene_at(i), &args);
    for (size_t i = 0; !args.scenes && i < scene_f64_count(); i++)
        ask_doubles(scene_f64_at(i), &args);
    if (has_file)
        printf("%zu scenes compared, %zu drawn otherwise; %zu digests differ\n", scenes_compared, drawn_otherwise, differing);
    if (differing)
        fputs("'masks parts --scenes NAME' here and where they agree tells the round and the call\n", stderr);
    return differing || scenes_compared < drawn_otherwise;
}
