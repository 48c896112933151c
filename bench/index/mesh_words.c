/* mesh_words.c - welds a soup to a mesh, and asks about words of both. */
#include "mesh_words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"

/* Vertices by what they are: a table with open places. */
typedef struct weld {
    uint32_t *place; /* vertex + 1; 0 where none is */
    size_t mask;
    float (*positions)[3];
    size_t vertices;
} weld;

static uint32_t vertex_of(weld *w, const float p[3])
{
    uint32_t bits[3];
    memcpy(bits, p, sizeof bits);
    uint64_t hash = (bits[0] * UINT64_C(0x9e3779b97f4a7c15)) ^ (bits[1] * UINT64_C(0xbf58476d1ce4e5b9)) ^
                    (bits[2] * UINT64_C(0x94d049bb133111eb));
    for (size_t at = (size_t)(hash ^ hash >> 29) & w->mask;; at = (at + 1) & w->mask) {
        if (!w->place[at]) {
            memcpy(w->positions[w->vertices++], p, sizeof w->positions[0]);
            w->place[at] = (uint32_t)w->vertices;
        }
        if (!memcmp(w->positions[w->place[at] - 1], p, sizeof w->positions[0]))
            return w->place[at] - 1;
    }
}

/* Vertices are numbered in the order of the file; then the triangles are put into theirs. */
static bool make_mesh(const tribox_soup *file, const uint32_t *ids, mesh_words *made)
{
    size_t places = 64;
    while (places < 6 * file->count)
        places *= 2;
    weld w = {.place = calloc(places, sizeof *w.place), .mask = places - 1};
    uint32_t(*const corners)[3] = malloc(file->count * sizeof *corners);
    made->positions = malloc(9 * file->count * sizeof *made->positions);
    made->indices = malloc(3 * file->count * sizeof *made->indices);
    w.positions = (float(*)[3])made->positions;
    const bool is_made = w.place && corners && made->positions && made->indices;
    for (size_t i = 0; is_made && i < file->count; i++) {
        float u[3][3];
        soup_triangle(file, i, u);
        for (int v = 0; v < 3; v++)
            corners[i][v] = vertex_of(&w, u[v]);
    }
    for (size_t i = 0; is_made && i < file->count; i++)
        memcpy(made->indices + 3 * i, corners[ids[i]], sizeof corners[0]);
    made->mesh = (tribox_mesh){
        .positions = made->positions, .vertices = w.vertices, .indices = made->indices, .index_bytes = 4, .count = file->count};
    free(w.place);
    free(corners);
    return is_made;
}

bool mesh_words_make(const tribox_soup *file, const ordered_soup *soup, const node_bounds *bounds, const tribox_box *boxes,
                     size_t count, mesh_words *made)
{
    *made = (mesh_words){.soup = &soup->room.soup, .boxes = boxes, .count = count};
    size_t all = 0;
    for (size_t b = 0; b < count; b++)
        all += node_bounds_visit(bounds, &boxes[b], NULL).asked;
    made->asked = malloc((all + 1) * sizeof *made->asked);
    made->start = malloc((count + 1) * sizeof *made->start);
    if (!made->asked || !made->start || !make_mesh(file, soup->ids, made)) {
        mesh_words_free(made);
        return message_failure("out of memory for a mesh") == EXIT_CODE_OK;
    }
    made->start[0] = 0;
    for (size_t b = 0; b < count; b++)
        made->start[b + 1] = made->start[b] + node_bounds_visit(bounds, &boxes[b], made->asked + made->start[b]).asked;
    return true;
}

void mesh_words_free(mesh_words *made)
{
    free(made->positions);
    free(made->indices);
    free(made->asked);
    free(made->start);
}

static size_t triangles_from(size_t first, size_t count) { return count - first < 64 ? count - first : 64; }

static bool ask_streams(const mesh_words *q, size_t first, const tribox_box *box, const tribox_options *options, uint64_t *bits)
{
    tribox_soup word = {.count = triangles_from(first, q->soup->count)};
    for (int v = 0; v < 3; v++) {
        word.x[v] = q->soup->x[v] + first;
        word.y[v] = q->soup->y[v] + first;
        word.z[v] = q->soup->z[v] + first;
    }
    return !tribox_overlap(&word, box, options, bits, NULL);
}

static bool ask_mesh(const mesh_words *q, size_t first, const tribox_box *box, const tribox_options *options, uint64_t *bits)
{
    tribox_mesh word = q->mesh;
    word.indices = q->indices + 3 * first;
    word.count = triangles_from(first, q->mesh.count);
    return !tribox_mesh_overlap(&word, box, options, bits, NULL);
}

typedef bool ask_word(const mesh_words *q, size_t first, const tribox_box *box, const tribox_options *options, uint64_t *bits);

/* The exclusive or of all words is the answer: that of streams and mesh has to be the same. */
static inline bool run_words(const contestant *self, ask_word *ask, uint64_t *mask)
{
    const mesh_words *const q = self->question;
    mask[0] = 0;
    for (size_t b = 0; b < q->count; b++)
        for (size_t k = q->start[b]; k < q->start[b + 1]; k++) {
            uint64_t bits;
            if (!ask(q, (size_t)64 * q->asked[k], &q->boxes[b], &self->options, &bits))
                return false;
            mask[0] = (mask[0] << 1 | mask[0] >> 63) ^ bits;
        }
    return true;
}

static bool run_streams(const contestant *self, uint64_t *mask, tribox_report *report)
{
    (void)report;
    return run_words(self, ask_streams, mask);
}

static bool run_mesh(const contestant *self, uint64_t *mask, tribox_report *report)
{
    (void)report;
    return run_words(self, ask_mesh, mask);
}

contestant mesh_words_contestant(const mesh_words *question, bool has_streams, const char *kernel)
{
    contestant made = {.run = has_streams ? run_streams : run_mesh,
                       .question = question,
                       .options = {.kernel = kernel},
                       .pairs = (double)question->start[question->count]};
    snprintf(made.name, sizeof made.name, "%s", has_streams ? "words of streams" : "words of a mesh");
    return made;
}
