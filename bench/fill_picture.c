/*
 * fill_picture.c - draws cuts through bodies made of formulas: their surface, what tribox_fill_outside and what tribox_fill_parity
 * fill, beside each other in a picture for each body.
 *
 *     build/bench/fill-picture examples/insides
 *
 * Dark: the surface. Blue: filled. White: free.
 */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "console/message.h"
#include "picture/preview.h"

enum { FILL_TRIANGLES = 20000 };

/* Within x 0 .. 64, y 0 .. 48 and z 0 .. 48. */
typedef struct fill_body {
    float stream[9][FILL_TRIANGLES]; /* x_0 x_1 x_2 y_0 y_1 y_2 z_0 z_1 z_2 */
    size_t count;
} fill_body;

enum { AROUND = 72, ACROSS = 36 };

typedef struct ball {
    double centre[3], radius;
    /* The part left out: from this step on, and so many. */
    int around, arounds, across, acrosses;
} ball;

/* Poles on the z axis. */
static void ball_vertex(const ball *b, int i, int j, float v[3])
{
    const double turn = 8 * atan(1), p = turn * (i % AROUND) / AROUND, q = turn / 2 * j / ACROSS;
    const double ring = j % ACROSS ? b->radius * sin(q) : 0;
    v[0] = (float)(b->centre[0] + ring * cos(p));
    v[1] = (float)(b->centre[1] + ring * sin(p));
    v[2] = (float)(b->centre[2] + b->radius * cos(q));
}

static void put(fill_body *body, float v[3][3])
{
    for (int n = 0; n < 9; n++)
        body->stream[n][body->count] = v[n % 3][n / 3];
    body->count += body->count < FILL_TRIANGLES - 1;
}

static void put_ball(fill_body *body, const ball *b)
{
    for (int i = 0; i < AROUND; i++)
        for (int j = 0; j < ACROSS; j++) {
            const bool is_out = (i + AROUND - b->around) % AROUND < b->arounds && j >= b->across && j < b->across + b->acrosses;
            float v[3][3];
            for (int half = 0; half < 2 && !is_out; half++) {
                ball_vertex(b, i, j, v[0]);
                ball_vertex(b, i + 1, j + half, v[1]);
                ball_vertex(b, i + half, j + 1, v[2]);
                if (half) {
                    ball_vertex(b, i + 1, j + 1, v[1]);
                    ball_vertex(b, i, j, v[0]);
                    ball_vertex(b, i, j + 1, v[2]);
                } else
                    ball_vertex(b, i + 1, j + 1, v[2]);
                put(body, v);
            }
        }
}

static void make_closed(fill_body *body) { put_ball(body, &(ball){.centre = {32.1, 24.2, 24.3}, .radius = 21}); }

/* One surface in another: a wall with a hollow in it. */
static void make_hollow(fill_body *body)
{
    make_closed(body);
    put_ball(body, &(ball){.centre = {32.1, 24.2, 24.3}, .radius = 12});
}

/* A hole of many cells. */
static void make_open(fill_body *body)
{
    put_ball(body,
             &(ball){.centre = {32.1, 24.2, 24.3}, .radius = 21, .around = AROUND - 3, .arounds = 6, .across = 15, .acrosses = 6});
}

/* Two halves that are half a cell apart: the middle of a row of cells looks through the crack. */
static void make_cracked(fill_body *body)
{
    ball half = {.centre = {32.1, 23.9, 24.3}, .radius = 21, .around = AROUND / 8, .arounds = AROUND / 2, .acrosses = ACROSS};
    put_ball(body, &half);
    half.around += AROUND / 2;
    half.centre[0] += 0.35;
    half.centre[1] -= 0.35;
    put_ball(body, &half);
}

static void make_doubled(fill_body *body)
{
    make_closed(body);
    make_closed(body);
}

static void make_crossing(fill_body *body)
{
    put_ball(body, &(ball){.centre = {23.1, 24.2, 24.3}, .radius = 17});
    put_ball(body, &(ball){.centre = {41.2, 24.1, 24.2}, .radius = 17});
}

static tribox_soup soup_of(const fill_body *body)
{
    tribox_soup soup = {.count = body->count};
    for (int v = 0; v < 3; v++) {
        soup.x[v] = body->stream[v];
        soup.y[v] = body->stream[3 + v];
        soup.z[v] = body->stream[6 + v];
    }
    return soup;
}

static const struct kind {
    const char *name;
    void (*make)(fill_body *body);
} kinds[] = {{"closed", make_closed},   {"hollow", make_hollow},   {"open", make_open},
             {"cracked", make_cracked}, {"doubled", make_doubled}, {"crossing", make_crossing}};

enum {
    CELL = 4,
    GAP = 12,
    PANELS = 3,
    NX = 64,
    NY = 48,
    NZ = 48,
    WIDTH = PANELS * NX * CELL + (PANELS - 1) * GAP,
    HEIGHT = NY * CELL
};

static const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {NX, NY, NZ}};

static fill_body body;
static uint64_t occupied[NY * NZ], solid[PANELS][NY * NZ];
static unsigned char pixels[HEIGHT][WIDTH][3];

/* Row (j, k) in a picture whose y is up. */
static void paint_cell(int panel, int i, int j, const unsigned char colour[3])
{
    for (int y = 0; y < CELL; y++)
        for (int x = 0; x < CELL; x++) {
            const bool is_line = !x || !y; /* between cells */
            unsigned char *const pixel = pixels[(NY - 1 - j) * CELL + y][panel * (NX * CELL + GAP) + i * CELL + x];
            for (int c = 0; c < 3; c++)
                pixel[c] = is_line ? (unsigned char)(colour[c] - colour[c] / 8) : colour[c];
        }
}

static void paint(void)
{
    static const unsigned char free_cell[3] = {250, 250, 250}, surface[3] = {50, 50, 60}, filled[3] = {110, 165, 230};
    memset(pixels, 255, sizeof pixels);
    for (int panel = 0; panel < PANELS; panel++)
        for (int j = 0; j < NY; j++)
            for (int i = 0; i < NX; i++) {
                const size_t row = NZ / 2 * NY + (size_t)j;
                paint_cell(panel, i, j, occupied[row] >> i & 1 ? surface : solid[panel][row] >> i & 1 ? filled : free_cell);
            }
}

static int write_picture(const char *folder, const char *name)
{
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s.png", folder, name) >= (int)sizeof path)
        return message_usage("the folder's name is too long");
    FILE *const to = fopen(path, "wb");
    const bool is_written = to && picture_png_write(to, &pixels[0][0][0], WIDTH, HEIGHT) && !ferror(to);
    if ((to && fclose(to)) || !is_written)
        return message_failure("%s: cannot be written%s", path, picture_png_is_there ? "" : ": built without libpng");
    return EXIT_CODE_OK;
}

static int show(const char *folder, const struct kind *kind)
{
    uint64_t scratch[2 * (NY * NZ) / 64 + 3];
    size_t outside, inside, odd_rows;
    body.count = 0;
    kind->make(&body);
    const tribox_soup soup = soup_of(&body);
    memset(occupied, 0, sizeof occupied);
    if (tribox_fill_bytes(grid.size) > sizeof scratch || tribox_voxelize(&soup, &grid, NULL, NULL, occupied, NULL) ||
        tribox_fill_outside(grid.size, occupied, scratch, solid[1], &outside) ||
        tribox_fill_parity(&soup, &grid, occupied, scratch, solid[2], &inside, &odd_rows))
        return message_failure("%s: cannot be filled", kind->name);
    memcpy(solid[0], occupied, sizeof occupied);
    printf("%-9s %5zu triangles: outside fills %6zu cells, parity %6zu; odd rows %4zu\n", kind->name, soup.count, outside, inside,
           odd_rows);
    paint();
    return write_picture(folder, kind->name);
}

int main(int argc, char **argv)
{
    message_set_program("fill-picture");
    if (argc != 2)
        return message_usage("name the folder to write pictures to");
    int code = EXIT_CODE_OK;
    for (size_t n = 0; !code && n < sizeof kinds / sizeof kinds[0]; n++)
        code = show(argv[1], &kinds[n]);
    return code;
}
