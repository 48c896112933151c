/* cmd_demo.c - tribox demo: every kernel and the paper's algorithm on two generated scenes, and the voxels of one. */
#define _POSIX_C_SOURCE 200809L
#include "cmd.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/clock.h"
#include "console/message.h"
#include "console/options.h"
#include "console/output.h"
#include "console/system.h"
#include "files/files.h"
#include "paper/paper.h"
#include "picture/preview.h"
#include "read/mesh.h"
#include "timing/timing.h"
#include "voxelize/grid_options.h"
#include "voxelize/voxel_task.h"

static const char help[] = "tribox demo - speed and answers on two built-in scenes; needs no file\n"
                           "\n"
                           "Usage: tribox demo [OPTION...]\n"
                           "\n"
                           "Tests 100,000 random triangles (the paper's experiment) and a mesh of 200,000 triangles, each\n"
                           "against a box: with the paper's own algorithm, and with every kernel that runs here, from nine\n"
                           "arrays of floats; 'mesh' reads vertices by indices. Then voxelizes the mesh and draws the voxels.\n"
                           "\n"
                           "  --quick              3 rounds instead of 15: for a first look\n"
                           "  --picture FILE.png   writes the picture of the voxels here; default: tribox-demo.png, or no\n"
                           "                       picture with --quick\n"
                           "  -q, --quiet          print no progress\n"
                           "  --help               this text\n"
                           "\n"
                           "ns/triangle is the median of the rounds, on one thread. 'x paper' says how many times as fast as\n"
                           "the paper's algorithm that is, and 'unlike exact' how many triangles get a wrong answer.\n"
                           "The kernels and the algorithm take turns, after a first round that is not counted.\n"
                           "\n"
                           "Exit codes: 0 success; 1 failure (memory, output); 2 wrong command line.\n"
                           "\n"
                           "Example:\n"
                           "  tribox demo --quick\n";

enum { ROUNDS = 15, QUICK_ROUNDS = 3, VOXEL_ROUNDS = 5, RESOLUTION = 128 };

typedef struct request {
    bool is_quick, is_quiet;
    const char *picture_path; /* NULL for none */
    file_out picture;
} request;

static const option_entry options[] = {{"quick", 0, OPTION_SETS(request, is_quick)},
                                       {"quiet", 'q', OPTION_SETS(request, is_quiet)},
                                       {"picture", 0, OPTION_NAMES(request, picture_path)},
                                       {NULL, 0, false}};

/* ---- scenes ------------------------------------------------------------------------------------------------------------------ */

enum { SCENE_SEED = 2001, RANDOM_TRIANGLES = 100000, KNOT_RINGS = 1000, KNOT_CORNERS = 100 };

static const double pi = 3.14159265358979323846;

/* One job, the same on every machine. */
static int make(timing_work *work, size_t count, const tribox_box *box, void (*draw)(float (*triangle)[3][3]))
{
    if (timing_work_make(work, 1, timing_work_room(count))) {
        draw(work->triangles);
        const timing_job job = timing_work_soup(work, count);
        timing_work_add(work, &job, box);
        if (timing_work_mesh(work))
            return EXIT_CODE_OK;
    }
    return message_failure("out of memory for a scene of %zu triangles", count);
}

static void draw_random(float (*triangle)[3][3])
{
    generator g = {SCENE_SEED};
    for (size_t n = 0; n < 9 * RANDOM_TRIANGLES; n++)
        triangle[n / 9][n / 3 % 3][n % 3] = random_between(&g, -2, 2);
}

/* The paper's: vertices uniform in a cube. */
static int make_random(timing_work *work)
{
    return make(work, RANDOM_TRIANGLES, &(tribox_box){{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}}, draw_random);
}

/*
 * A point of the tube. The knot winds twice around the axis of a torus and three times through its hole; `outward` is normal to the
 * torus and so to the knot, and with `sideward` spans the plane of the ring.
 */
static void knot_point(int ring, int corner, float point[3])
{
    const double radius = 2, swing = 0.85, tube = 0.42;
    const double t = 2 * pi * (ring % KNOT_RINGS) / KNOT_RINGS, turn = 2 * pi * (corner % KNOT_CORNERS) / KNOT_CORNERS;
    const double cp = cos(2 * t), sp = sin(2 * t), cq = cos(3 * t), sq = sin(3 * t), rho = radius + swing * cq;
    const double center[3] = {rho * cp, rho * sp, swing * sq};
    const double outward[3] = {cq * cp, cq * sp, sq};
    const double along[3] = {-3 * swing * sq * cp - 2 * rho * sp, -3 * swing * sq * sp + 2 * rho * cp, 3 * swing * cq};
    const double length = sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const double sideward = (along[b] * outward[c] - along[c] * outward[b]) / length;
        point[a] = (float)(center[a] + tube * (cos(turn) * outward[a] + sin(turn) * sideward));
    }
}

static void draw_knot(float (*triangle)[3][3])
{
    for (int ring = 0; ring < KNOT_RINGS; ring++)
        for (int corner = 0; corner < KNOT_CORNERS; corner++, triangle += 2) {
            float quad[4][3];
            for (int k = 0; k < 4; k++)
                knot_point(ring + (k == 1 || k == 2), corner + k / 2, quad[k]);
            memcpy(triangle[0], quad, sizeof *triangle);
            memcpy(triangle[1][0], quad[0], sizeof quad[0]);
            memcpy(triangle[1][1], quad[2], 2 * sizeof quad[0]);
        }
}

/* A mesh: a tube along a trefoil knot, cut by the box. */
static int make_knot(timing_work *work)
{
    return make(work, 2 * KNOT_RINGS * KNOT_CORNERS, &(tribox_box){{0.2f, -0.6f, -1.0f}, {2.2f, 1.4f, 1.0f}}, draw_knot);
}

/* ---- times ------------------------------------------------------------------------------------------------------------------- */

/* The paper's test, and every kernel; of the rows of meshes those of the two widest kernels: the table is to fit a screen. */
static int compare(contest *c, const timing_work *work, size_t rounds)
{
    contestant all[CONTESTANTS_MAX];
    const size_t entered = contestants_enter(work, all);
    size_t meshes = 0;
    generator order = {SCENE_SEED};
    c->list[c->count++] = contestant_paper(work, PAPER_ORDER);
    for (size_t n = 0; n < entered; n++)
        if (!strstr(all[n].name, "-mesh") || meshes++ < 2)
            c->list[c->count++] = all[n];
    const char *const wrong = contest_run(c, work, (effort){.rounds = rounds, .seconds = 1e9, .sample = 2e-3}, &order);
    return wrong ? message_failure("%s; nothing is timed", wrong) : EXIT_CODE_OK;
}

/* The two scenes beside each other. */
static void print_table(const contest c[2], const timing_work work[2])
{
    printf("%22s    %-34s    %s\n%22s", "", "random triangles, as in the paper", "a mesh: a tube along a knot", "");
    for (int s = 0; s < 2; s++)
        printf("%*s%zu, %zu overlap", s ? 17 : 4, "", work[s].pairs, c[s].scores[c[s].count - 1].overlapping);
    printf("\nkernel    accuracy        ns/triangle  x paper  unlike exact    ns/triangle  x paper  unlike exact\n");
    for (size_t i = 0; i < c->count; i++) {
        const contestant *const one = &c->list[i];
        const char *const kernel = one->options.kernel; /* NULL of the paper's, which has no accuracy either */
        printf("%-8s  %-12s", kernel ? kernel : one->name, kernel ? strchr(one->name, '-') + 1 : "-");
        for (int s = 0; s < 2; s++)
            printf("    %11.2f %8.2f %13zu", measure_spread(&c[s].taken, i).median, measure_ratio(&c[s].taken, 0, i).median,
                   score_unlike(&c[s].scores[i]));
        putchar('\n');
    }
}

static bool voxelize(const tribox_soup *soup, const tribox_grid *grid, const char *kernel, unsigned threads, uint64_t *bits)
{
    const tribox_options how = {.kernel = kernel};
    const voxel_task task = voxel_task_of_soup(soup, grid, &how);
    memset(bits, 0, tribox_window_words(grid->size) * sizeof *bits);
    return !voxelize_in_threads(&task, threads, bits, NULL, NULL);
}

/* bits: twice the words of the grid. Compares with the scalar kernel. Returns the seconds of the best round; 0 if they differ. */
static double time_voxels(const tribox_soup *soup, const tribox_grid *grid, unsigned threads, uint64_t *bits)
{
    const size_t words = tribox_window_words(grid->size);
    double seconds = INFINITY;
    bool is_right = voxelize(soup, grid, "scalar", 1, bits + words);
    for (int round = 0; round < VOXEL_ROUNDS && is_right; round++) {
        const double start = clock_seconds();
        is_right = voxelize(soup, grid, NULL, threads, bits);
        seconds = fmin(seconds, clock_seconds() - start);
        is_right = is_right && !memcmp(bits, bits + words, words * sizeof *bits);
    }
    return is_right ? seconds : 0;
}

static int show_voxels(request *r, const tribox_soup *soup)
{
    mesh m = {.soup = *soup, .triangles = soup->count};
    tribox_grid grid;
    const char *const path = r->picture.path;
    const unsigned threads = processors_here();
    mesh_look_all(NULL, threads, &m);
    int code = grid_choose(&(grid_choice){.resolution = RESOLUTION}, "the mesh of the demo", &m, &grid);
    if (code)
        return code;
    uint64_t *const bits = malloc(2 * tribox_window_words(grid.size) * sizeof *bits);
    if (!bits)
        return message_failure("out of memory for the voxels of the mesh");
    const double seconds = time_voxels(soup, &grid, threads, bits);
    const voxels v = {.grid = grid, .words = bits};
    code = seconds > 0 ? preview_draw(&r->picture, &v, &PREVIEW_LOOK_DEFAULT, threads)
                       : message_failure("the voxels of two kernels differ");
    if (!code) {
        printf("\nVoxels of the mesh: %u x %u x %u cells, %zu of them occupied; %.2f ms, %.1f ns per triangle\n", grid.size[0],
               grid.size[1], grid.size[2], (size_t)voxels_occupied(&v), 1e3 * seconds, 1e9 * seconds / (double)soup->count);
        printf("exact, %u thread%s%s%s\n", threads, threads == 1 ? "" : "s", path ? "; drawn in " : "", path ? path : "");
    }
    free(bits);
    return code ? code : output_flush();
}

static int show(request *r)
{
    static contest c[2];
    timing_work work[2] = {{.jobs = NULL}, {.jobs = NULL}};
    const size_t rounds = r->is_quick ? QUICK_ROUNDS : ROUNDS;
    int code = make_random(&work[0]);
    if (!code)
        code = make_knot(&work[1]);
    for (int s = 0; s < 2 && !code; s++)
        code = compare(&c[s], &work[s], rounds);
    if (!code) {
        print_table(c, work);
        printf("\nMedians of %zu rounds on one thread, in turns. 'paper' is the algorithm of Akenine-Moller (2001),\n"
               "a triangle at a time, compiled with -O3 -ffp-contract=fast for %s; see tribox demo --help.\n",
               rounds, strcmp(paper_instruction_set(), "any") ? paper_instruction_set() : "any processor of this architecture");
        code = show_voxels(r, &work[1].jobs[0].soup);
    }
    timing_work_free(&work[0]);
    timing_work_free(&work[1]);
    return code;
}

static int take(void *context, int which, const char *value)
{
    (void)context, (void)which;
    return message_usage("unexpected '%s': demo takes no file", value);
}

static int answer(void *asked, const options_found *found)
{
    request *const r = asked;
    int code = preview_check(r->picture_path, "--picture");
    (void)found;
    if (code)
        return code;
    if (!r->picture_path && !r->is_quick && picture_png_is_there) {
        if (named_file_is_writable_here())
            r->picture_path = "tribox-demo.png";
        else
            message_say("note: no picture of the voxels: this folder is not writable; choose another place with --picture");
    }
    code = file_out_open(&r->picture, r->picture_path);
    if (!code)
        code = show(r);
    file_out_drop(&r->picture);
    return code;
}

int cmd_demo(int count, char **words)
{
    return options_answer(&(options_command){help, options, take, answer}, count, words, &(request){.is_quick = false});
}
