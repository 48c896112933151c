/* box_scenes.c - soups to be asked about many boxes, in order by cuts, and the forms in which an index answers, verified. */
#include "box_scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "files/files.h"
#include "read/mesh.h"
#include "rivals.h"

/* ---- soups and boxes --------------------------------------------------------------------------------------------------------- */

enum { TORUS_LONG = 500, TORUS_AROUND = 200 };

bool scene_read(const char *path, scene *made)
{
    mesh m;
    if (!mesh_list_read(path, &m))
        return false;
    *made = (scene){.name = path + named_file_folder(path), .what = "a mesh"};
    const bool is_made = scene_room(made, m.soup.count);
    size_t kept = 0;
    for (size_t i = 0; is_made && i < m.soup.count; i++) {
        float(*const u)[3] = made->work.triangles[kept], sum = 0;
        for (int v = 0; v < 3; v++)
            memcpy(u[v], (const float[3]){m.soup.x[v][i], m.soup.y[v][i], m.soup.z[v][i]}, sizeof u[v]);
        for (int k = 0; k < 9; k++)
            sum += u[k / 3][k % 3] - u[k / 3][k % 3];
        kept += sum == 0; /* the peers know finite ones alone */
    }
    if (is_made)
        scene_add(made, kept, 1);
    mesh_free(&m);
    return is_made;
}

/* Places are jittered, and what hills there are has no preferred size. */
static void terrain_vertex(generator *g, size_t i, size_t j, size_t side, float u[3])
{
    const double turn = 6.283185307179586 / (double)side;
    const double x = (double)i + (double)random_between(g, -0.3f, 0.3f), y = (double)j + (double)random_between(g, -0.3f, 0.3f);
    double z = (double)random_between(g, 0, 0.3f), height = 0.06 * (double)side;
    for (int waves = 1; waves < 200; waves *= 2, height /= 2.1)
        z += height * sin(turn * waves * x + waves) * cos(turn * 1.1 * waves * y + 2 * waves);
    u[0] = (float)x;
    u[1] = (float)y;
    u[2] = (float)z;
}

static bool make_terrain(size_t triangles, uint64_t seed, scene *made)
{
    const size_t side = triangles > 2 ? (size_t)sqrt((double)triangles / 2) : 1, count = 2 * side * side;
    *made = (scene){.name = "terrain", .what = "a height field"};
    if (!scene_room(made, count) || !draw_field(side, side, terrain_vertex, &(generator){seed}, made->work.triangles))
        return false;
    scene_add(made, count, 1);
    return true;
}

/* Around a ring, two triangles a patch. */
static void torus_vertex(float u[3], int along, int around)
{
    const double turn = 6.283185307179586, s = turn * along / TORUS_LONG, t = turn * around / TORUS_AROUND, r = 1 + 0.4 * cos(t);
    u[0] = (float)(r * cos(s));
    u[1] = (float)(r * sin(s));
    u[2] = (float)(0.4 * sin(t));
}

static void draw_reach(generator *g, float reach, float u[3][3])
{
    for (int a = 0; a < 3; a++) {
        const float lo = random_between(g, 0, 1 - reach);
        for (int v = 0; v < 3; v++)
            u[v][a] = random_between(g, lo, lo + reach);
    }
}

/* A torus of 200,000 triangles; as many anywhere, a hundredth of the whole long; twelve across the whole. */
enum { SCENE_TORUS, SCENE_SMALL, SCENE_HUGE, MADE_SCENES };

static bool make_shape(size_t which, uint64_t seed, scene *made)
{
    const size_t count = which == SCENE_HUGE ? 12 : 2 * TORUS_LONG * TORUS_AROUND;
    generator g = {seed};
    *made = (scene){.name = (const char *[]){"torus", "small", "huge"}[which], .what = "made here"};
    if (!scene_room(made, count))
        return false;
    for (size_t i = 0; i < count; i++) {
        const int along = (int)(i / 2 / TORUS_AROUND), around = (int)(i / 2 % TORUS_AROUND), half = (int)(i % 2);
        float(*const u)[3] = made->work.triangles[i];
        if (which == SCENE_TORUS) {
            torus_vertex(u[0], along, around + half);
            torus_vertex(u[1], along + 1, around);
            torus_vertex(u[2], along + half, around + 1);
        } else
            draw_reach(&g, which == SCENE_SMALL ? 0.01f : 1, u);
    }
    scene_add(made, count, 1);
    return true;
}

tribox_grid scene_grid(const scene *at, uint32_t along)
{
    const tribox_box *const box = &at->work.jobs[0].box;
    const double cell = (double)(float)(scene_extent(at) / along * 1.0001); /* what lies on the far side lies inside */
    tribox_grid grid;
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = box->lo[a];
        grid.cell[a] = cell;
        grid.size[a] = (uint32_t)fmax(1, ceil((box->hi[a] - box->lo[a]) / cell));
    }
    return grid;
}

static mesh_list usual_meshes(void)
{
    static const char *const usual[] = {"dragon_vrip.ply", "buildings.ply", "SainteHelens.ply", "sponza.ply"};
    const char *const folder = getenv("TRIBOX_MESHES");
    if (folder && *folder)
        return (mesh_list){usual, sizeof usual / sizeof usual[0]};
    message_say("no meshes: name some, or a folder with them in TRIBOX_MESHES; skipped");
    return (mesh_list){NULL, 0};
}

const char *const scenes_compared[] = {"paper",        "sparse", "cad",     "cad-tenths", "touching",
                                       "touching-ulp", "offset", "needles", "caps",       "thin"};

bool scenes_ask_named(asked *q, const char *const *names, size_t count, bool has_boxes, scene_answer *ask)
{
    const char *const only = q->text[OPTION_SCENE], *name;
    bool is_right = true;
    for (size_t k = 0; is_right && k < (only ? 1 : count) && (name = only ? only : names ? names[k] : scene_usual(k)); k++) {
        void *const mark = asked_mark();
        scene at;
        q->scenes++;
        is_right = scene_make(name, q->seed, has_boxes, &at) && ask(q, &at);
        scene_free(&at);
        asked_release(mark);
    }
    return is_right;
}

bool scenes_ask(asked *q, unsigned kinds, size_t terrain, scene_answer *ask)
{
    if (kinds & SCENES_USUAL && !q->meshes.count && !asked_has(q, OPTION_QUICK))
        q->meshes = usual_meshes();
    const size_t made = kinds & SCENES_MADE && !asked_has(q, OPTION_NO_SCENES) ? MADE_SCENES : 0, named = made + q->meshes.count;
    bool is_right = true;
    for (size_t k = 0; is_right && k < named + (terrain > 0); k++) {
        void *const mark = asked_mark();
        scene at = {.name = NULL};
        q->scenes++;
        is_right = (k < made    ? make_shape(k, q->seed, &at)
                    : k < named ? scene_read(q->meshes.path[k - made], &at)
                                : make_terrain(terrain, q->seed, &at)) &&
                   ask(q, &at);
        scene_free(&at);
        asked_release(mark);
    }
    return is_right;
}

double scene_extent(const scene *at)
{
    const tribox_box *const box = &at->work.jobs[0].box;
    return fmax(fmax(box->hi[0] - box->lo[0], box->hi[1] - box->lo[1]), box->hi[2] - box->lo[2]);
}

size_t scene_boxes_within(const scene *at, size_t pairs, size_t most)
{
    const size_t boxes = pairs / at->work.pairs;
    return boxes == 0 ? 1 : boxes < most ? boxes : most;
}

/* By way of memory: gcc 12 leaves out the rounding where it takes several such numbers at once. */
static double as_float(double number)
{
    const volatile float nearest = (float)number;
    return nearest;
}

void scene_boxes(const scene *at, double part, size_t count, uint64_t seed, tribox_box *boxes)
{
    generator g = {seed};
    const double half = scene_extent(at) * part / 2;
    for (size_t b = 0; b < count; b++) {
        float(*const u)[3] = at->work.triangles[random_below(&g, at->work.pairs)];
        double p = (double)random_between(&g, 0, 1), q = (double)random_between(&g, 0, 1);
        if (p + q > 1) {
            p = 1 - p;
            q = 1 - q;
        }
        for (int a = 0; a < 3; a++) {
            const double middle = (double)u[0][a] * (1 - p - q) + (double)u[1][a] * p + (double)u[2][a] * q;
            boxes[b].lo[a] = as_float(middle - half);
            boxes[b].hi[a] = as_float(middle + half);
        }
    }
}

tribox_oriented_box scene_turned(const tribox_box *box, float e, float d)
{
    const float c = 0.76484219f, s = 0.64421769f;
    tribox_oriented_box turned = {.axis = {{c, s * e, s * d}, {-s, c * e, c * d}, {0, -d, e}}};
    for (int a = 0; a < 3; a++) {
        turned.center[a] = (float)box->lo[a] / 2 + (float)box->hi[a] / 2;
        turned.half[a] = (float)box->hi[a] / 2 - (float)box->lo[a] / 2;
    }
    return turned;
}

/* ---- order by cuts ----------------------------------------------------------------------------------------------------------- */

bool ordered_soup_make(const scene *at, const char *kernel, ordered_soup *made)
{
    const size_t count = at->work.pairs, stride = timing_work_room(count) + 32; /* not the same place of a page */
    float *const streams = asked_allocate(9 * stride, sizeof *streams), **const to = made->to;
    *made = (ordered_soup){.file = &at->work.jobs[0].soup,
                           .soup = {.count = count},
                           .ids = asked_allocate(count, sizeof *made->ids),
                           .memory = asked_allocate(tribox_index_bytes(count), 1),
                           .scratch = asked_allocate(count, 16)};
    for (size_t v = 0; v < 3; v++) {
        made->soup.x[v] = to[v] = streams + v * stride;
        made->soup.y[v] = to[3 + v] = streams + (3 + v) * stride;
        made->soup.z[v] = to[6 + v] = streams + (6 + v) * stride;
    }
    made->index = (tribox_index){.nodes = made->memory, .soup = &made->soup, .ids = made->ids};
    return (!tribox_soup_sort(made->file, made->ids, made->scratch) &&
            !tribox_soup_gather(made->file, made->ids, 0, count, to, to + 3, to + 6) &&
            !tribox_index_build(&made->index, &(tribox_options){.kernel = kernel}, made->memory)) ||
           message_failure("%s cannot be ordered or indexed", at->name) == EXIT_CODE_OK;
}

/* ---- forms of answers -------------------------------------------------------------------------------------------------------- */

static const char *const names[FORMS] = {"list", "count", "any", "words", "mask", "linear"};

const char *index_form_name(index_form form) { return names[form]; }

void answer_room_make(size_t triangles, size_t elsewhere_bytes, answer_room *made)
{
    const size_t words = tribox_mask_words(triangles) + 1;
    uint64_t *const storage = asked_allocate(words, 3 * sizeof(uint64_t) + 65 * sizeof(uint32_t));
    *made = (answer_room){.bits = storage,
                          .mask = storage + words,
                          .linear = storage + 2 * words,
                          .number = (uint32_t *)(storage + 3 * words),
                          .elsewhere = asked_allocate(elsewhere_bytes, 1),
                          .elsewhere_bytes = elsewhere_bytes};
    made->list = made->number + words;
}

/* Reports how many overlap; of any, whether there is one, which then stands in number[0]; of words, how many there are. */
static bool ask_form(const index_question *q, index_form form, size_t b, const tribox_options *options, tribox_report *report)
{
    const tribox_region region = q->boxes ? (tribox_region){.box = &q->boxes[b]} : (tribox_region){.oriented = &q->turned[b]};
    const answer_room *const room = q->room;
    size_t *const found = &report->overlapping;
    bool is_refused;
    switch (form) {
    case FORM_LIST:
        return !tribox_index_list(q->index, &region, options, q->triangles, room->list, found);
    case FORM_ANY:
        is_refused = tribox_index_any(q->index, &region, options, found);
        room->number[0] = (uint32_t)*found;
        *found = *found < q->triangles;
        return !is_refused;
    case FORM_WORDS:
        return !tribox_index_words(q->index, &region, options, tribox_mask_words(q->triangles), room->number, room->bits, NULL,
                                   found, NULL);
    case FORM_LINEAR:
        return !(!q->boxes        ? tribox_overlap_oriented(q->index->soup, region.oriented, options, room->linear, report)
                 : q->index->soup ? tribox_overlap(q->index->soup, region.box, options, room->linear, report)
                                  : tribox_mesh_overlap(q->index->mesh, region.box, options, room->linear, report));
    default:
        return !tribox_index_overlap(q->index, &region, options, form == FORM_MASK ? room->mask : NULL, report);
    }
}

/* contestant.which: a form; contestant.pairs: boxes. */
CONTESTANT_RUN(run_form)
{
    tribox_report one;
    for (size_t b = 0; b < (size_t)self->pairs; b++)
        if (!ask_form(self->question, (index_form)self->which, b, &self->options, &one))
            return false;
    return true;
}

void index_warm_up(const contestant *self, uint64_t *mask) { self->run(self, mask, NULL); }

static void empty_caches(const contestant *self, uint64_t *mask)
{
    const answer_room *const room = ((const index_question *)self->question)->room;
    mask[0] = loads_words(room->elsewhere, room->elsewhere_bytes / sizeof(uint32_t));
}

contestant index_contestant(const index_question *question, index_form form, bool is_cold, const char *kernel)
{
    const bool is_linear = form == FORM_LINEAR;
    contestant made = {.run = run_form, .question = question, .which = (int)form, .options = {.kernel = kernel}};
    made.pairs = (double)(is_linear ? question->linear_count : question->count);
    made.prepare = is_cold ? empty_caches : is_linear ? NULL : index_warm_up;
    snprintf(made.name, sizeof made.name, "%s", names[form]);
    return made;
}

double index_hits(const index_question *q, const char *kernel)
{
    double hits = 0;
    for (size_t b = 0; b < q->count; b++) {
        tribox_report one = {0, 0};
        ask_form(q, FORM_COUNT, b, &(tribox_options){.kernel = kernel}, &one);
        hits += (double)one.overlapping;
    }
    return hits / (double)q->count;
}

static bool is_set(const uint64_t *mask, size_t i) { return mask[i / 64] >> i % 64 & 1; }

/* The list is to be the set bits in ascending order, each by the number that it has in the file. */
static bool is_list_right(const index_question *q, size_t found)
{
    size_t at = 0;
    for (size_t i = 0; i < q->triangles; i++)
        if (is_set(q->room->linear, i) && (at == found || q->room->list[at++] != (q->index->ids ? q->index->ids[i] : (uint32_t)i)))
            return false;
    return at == found;
}

static bool are_words_right(const index_question *q, size_t found)
{
    const uint64_t *const linear = q->room->linear;
    size_t at = 0;
    for (size_t w = 0; w < tribox_mask_words(q->triangles); w++)
        if (linear[w] && (at == found || q->room->number[at] != w || q->room->bits[at++] != linear[w]))
            return false;
    return at == found;
}

/* Whether a form says of a box what the call without an index has just said; a refusal is wrong, too. */
static bool is_form_right(const index_question *q, index_form form, size_t b, const tribox_options *options, size_t overlapping)
{
    const size_t bytes = tribox_mask_words(q->triangles) * sizeof *q->room->mask;
    tribox_report own = {0, 0};
    memset(q->room->mask, 0xff, bytes);
    if (!ask_form(q, form, b, options, &own))
        return false;
    const size_t found = own.overlapping;
    return form == FORM_ANY     ? found == (overlapping > 0) && (!found || is_set(q->room->linear, q->room->number[0]))
           : form == FORM_WORDS ? are_words_right(q, found)
                                : found == overlapping && (form != FORM_LIST || is_list_right(q, found)) &&
                                      (form != FORM_MASK || !memcmp(q->room->mask, q->room->linear, bytes));
}

bool index_forms_verify(const index_question *question, size_t boxes, const char *kernel)
{
    const tribox_options options = {.kernel = kernel};
    for (size_t b = 0; b < boxes && b < question->count; b++) {
        tribox_report linear;
        bool is_right = ask_form(question, FORM_LINEAR, b, &options, &linear);
        index_form form = FORM_LINEAR;
        while (is_right && form > FORM_LIST)
            is_right = is_form_right(question, --form, b, &options, linear.overlapping);
        if (!is_right)
            return message_failure("%s, box %zu: %s is wrong", question->name, b, names[form]) == EXIT_CODE_OK;
    }
    return true;
}
