/*
 * index_picture.c - draws what one question asks of an index: the knot of tribox demo, in order by cuts, and a box.
 *
 *     build/bench/index-picture bench/results/index.png
 *
 * Each patch is the 64 triangles of a word, between thicker lines lie the 4096 of a node. Grey: never looked at; darker, their
 * bounds are looked at and miss the box; blue: their bounds lie in the box, so all of them overlap it; orange: these are tested.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "demo/scene.h"
#include "index_canvas.h"
#include "node_bounds.h"
#include "ordered_soup.h"
#include "picture/picture_png.h"

enum { WIDTH = 760, HEIGHT = 540, SHADES = 20, STEPS = 16 /* of colours and light: few, so that the file is small */ };

typedef enum word_state { WORD_UNSEEN, WORD_BESIDE, WORD_ASKED, WORD_INSIDE } word_state;

static const float colours[][3] = {[WORD_UNSEEN] = {0.92f, 0.92f, 0.92f},
                                   [WORD_BESIDE] = {0.68f, 0.68f, 0.68f},
                                   [WORD_ASKED] = {0.98f, 0.62f, 0.18f},
                                   [WORD_INSIDE] = {0.36f, 0.62f, 0.90f}};
/* Two arms of the knot run through it. */
static const tribox_box box = {{0.9f, -2.9f, -0.4f}, {3, -0.8f, 1.4f}};
static const double from[2] = {28, 50};

static const float line_colour[3] = {0.1f, 0.1f, 0.1f};

typedef struct picture {
    index_scene scene;
    ordered_soup ordered;
    node_bounds bounds;
    node_visits visits;
    unsigned char *state; /* of each word */
    canvas canvas;
    float (*colour)[3]; /* of each sample */
} picture;

static int make_scene(index_scene *made)
{
    timing_work knot;
    int code = scene_make_knot(&knot);
    if (code)
        return code;
    const timing_job *const job = &knot.jobs[0];
    code = soup_room_make(job->soup.count, &made->room) ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
    for (size_t i = 0; !code && i < job->soup.count; i++)
        soup_room_put(&made->room, i, job->triangles[i]);
    timing_work_free(&knot);
    return code;
}

static bool is_apart(const tribox_box *p, const tribox_box *q)
{
    bool is_beside = false;
    for (int a = 0; a < 3; a++)
        is_beside = is_beside || p->lo[a] > q->hi[a] || p->hi[a] < q->lo[a];
    return is_beside;
}

/* The words that a question comes by, as node_bounds counts them. */
static bool find_states(picture *p)
{
    const size_t words = p->bounds.count[0];
    uint32_t *const asked = malloc((words + 1) * sizeof *asked);
    p->state = calloc(words + 1, 1);
    if (!asked || !p->state) {
        free(asked);
        return false;
    }
    p->visits = node_bounds_visit(&p->bounds, &box, asked);
    for (size_t i = 0; i < words; i++) {
        const bool is_missed = is_apart(&p->bounds.level[0][i], &box), is_unseen = is_apart(&p->bounds.level[1][i / 64], &box);
        p->state[i] = is_unseen ? WORD_UNSEEN : is_missed ? WORD_BESIDE : WORD_INSIDE;
    }
    for (size_t k = 0; k < p->visits.asked; k++)
        p->state[asked[k]] = WORD_ASKED;
    free(asked);
    return true;
}

/* How bright a triangle is: of both sides the one that is seen, in light that comes over the left shoulder. */
static float brightness(const canvas *c, const tribox_soup *soup, size_t i)
{
    float corners[3][3], seen[3][3];
    double u[3], v[3];
    soup_triangle(soup, i, corners);
    for (int k = 0; k < 3; k++)
        canvas_place(c, corners[k], seen[k]);
    for (int a = 0; a < 3; a++) {
        const double turn = a == 1 ? -1 : 1; /* rows are counted from above */
        u[a] = turn * (double)(seen[1][a] - seen[0][a]);
        v[a] = turn * (double)(seen[2][a] - seen[0][a]);
    }
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), flip = n[2] < 0 ? -1 : 1;
    const double light = flip * (-0.4 * n[0] + 0.55 * n[1] + 0.73 * n[2]) / (length > 0 ? length : 1);
    return 0.42f + 0.58f * roundf(STEPS * (float)fmax(light, 0)) / STEPS;
}

static void mix(float colour[3], const float with[3], float part)
{
    for (int k = 0; k < 3; k++)
        colour[k] += part * (with[k] - colour[k]);
}

/* The same node or word in all of a square around a sample; the surface's own outline counts as a border of both. */
static bool is_on_border(const canvas *c, unsigned x, unsigned y, unsigned reach, uint32_t triangles)
{
    const uint32_t own = c->triangle[(size_t)y * c->width + x] / triangles;
    for (unsigned j = y < reach ? 0 : y - reach; j <= y + reach && j < c->height; j++)
        for (unsigned i = x < reach ? 0 : x - reach; i <= x + reach && i < c->width; i++)
            if (c->triangle[(size_t)j * c->width + i] / triangles != own)
                return true;
    return false;
}

static void paint_surface(picture *p)
{
    const canvas *const c = &p->canvas;
    for (unsigned y = 0; y < c->height; y++)
        for (unsigned x = 0; x < c->width; x++) {
            const size_t at = (size_t)y * c->width + x;
            const uint32_t i = c->triangle[at];
            float *const colour = p->colour[at];
            colour[0] = colour[1] = colour[2] = 1;
            if (i == CANVAS_NOTHING)
                continue;
            const float light = brightness(c, &p->ordered.room.soup, i);
            for (int k = 0; k < 3; k++)
                colour[k] = colours[p->state[i / 64]][k] * light;
            if (is_on_border(c, x, y, 2, 4096))
                mix(colour, line_colour, 0.75f);
            else if (is_on_border(c, x, y, 1, 64))
                mix(colour, line_colour, 0.30f);
        }
}

/* A dot of the box's outline: strong in front of the surface, weak behind it. */
static void paint_dot(picture *p, const float at[3])
{
    const canvas *const c = &p->canvas;
    const int reach = 2;
    for (int j = -reach; j <= reach; j++)
        for (int i = -reach; i <= reach; i++) {
            const int x = (int)at[0] + i, y = (int)at[1] + j;
            if (x < 0 || y < 0 || x >= (int)c->width || y >= (int)c->height || i * i + j * j > reach * reach + 1)
                continue;
            const size_t sample = (size_t)y * c->width + (size_t)x;
            const bool is_hidden = at[2] < c->depth[sample];
            if (!is_hidden)
                memcpy(p->colour[sample], line_colour, sizeof line_colour);
        }
}

static void paint_box(picture *p)
{
    enum { DOTS = 4000 };
    for (int edge = 0; edge < 12; edge++)
        for (int d = 0; d <= DOTS; d++) {
            const int along = edge / 4;
            float point[3], at[3];
            for (int a = 0; a < 3; a++) {
                const bool is_high = edge >> (a == (along + 1) % 3 ? 0 : 1) & 1;
                point[a] = is_high ? (float)box.hi[a] : (float)box.lo[a];
            }
            point[along] = (float)box.lo[along] + ((float)box.hi[along] - (float)box.lo[along]) * (float)d / DOTS;
            canvas_place(&p->canvas, point, at);
            paint_dot(p, at);
        }
}

static void average(const picture *p, unsigned char *pixels)
{
    for (size_t y = 0; y < HEIGHT; y++)
        for (size_t x = 0; x < WIDTH; x++)
            for (size_t k = 0; k < 3; k++) {
                float sum = 0;
                for (size_t s = 0; s < CANVAS_FINE * CANVAS_FINE; s++)
                    sum += p->colour[(CANVAS_FINE * y + s / CANVAS_FINE) * p->canvas.width + CANVAS_FINE * x + s % CANVAS_FINE][k];
                *pixels++ = (unsigned char)(lroundf(sum * SHADES / (CANVAS_FINE * CANVAS_FINE)) * 255 / SHADES);
            }
}

static int draw(picture *p, const char *path)
{
    static unsigned char pixels[WIDTH * HEIGHT * 3];
    if (!canvas_make(WIDTH, HEIGHT, &p->scene.room.soup, &box, from, &p->canvas) ||
        !(p->colour = malloc((size_t)p->canvas.width * p->canvas.height * sizeof *p->colour)))
        return message_failure("out of memory for the picture");
    canvas_draw(&p->canvas, &p->ordered.room.soup);
    paint_surface(p);
    paint_box(p);
    average(p, pixels);
    FILE *const to = fopen(path, "wb");
    const bool is_written = to && picture_png_write(to, pixels, WIDTH, HEIGHT) && !ferror(to);
    if ((to && fclose(to)) || !is_written)
        return message_failure("%s: cannot be written%s", path, picture_png_is_there ? "" : ": built without libpng");
    return EXIT_CODE_OK;
}

static int ask(picture *p)
{
    tribox_report report;
    if (!ordered_soup_make(&p->scene, ORDER_CUTS, 1, NULL, &p->ordered) || !node_bounds_make(&p->ordered.room.soup, &p->bounds) ||
        !find_states(p))
        return message_failure("out of memory for the index");
    if (tribox_index_overlap(&p->ordered.index, &(tribox_region){.box = &box}, NULL, NULL, &report))
        return EXIT_CODE_FAILURE;
    printf("%zu triangles, %zu nodes, %zu words; %zu overlap the box\n", p->ordered.room.soup.count, p->bounds.count[1],
           p->bounds.count[0], report.overlapping);
    printf("%zu nodes looked at, %zu words tested, %zu wholly inside\n", p->visits.nodes, p->visits.asked, p->visits.inside);
    return EXIT_CODE_OK;
}

int main(int argc, char **argv)
{
    picture p = {.state = NULL};
    message_set_program("index-picture");
    if (argc != 2)
        return message_usage("name the PNG file to write");
    int code = make_scene(&p.scene);
    if (!code)
        code = ask(&p);
    if (!code)
        code = draw(&p, argv[1]);
    canvas_free(&p.canvas);
    free(p.colour);
    free(p.state);
    node_bounds_free(&p.bounds);
    ordered_soup_free(&p.ordered);
    index_scene_free(&p.scene);
    return code;
}
