/* mesh_npz.c - a mesh as arrays for numpy.load: the vertices, each place once, the faces, and their colours. */
#include "mesh_npz.h"

#include <stdlib.h>
#include <string.h>

#include "checksum.h"
#include "console/message.h"
#include "read/little.h"
#include "zip.h"

enum { NUMBERS = 3, CORNERS = 3, INDEX = 4 };
static const uint32_t none = UINT32_MAX;

typedef struct merging {
    const mesh *m;
    size_t vertex;           /* bytes */
    unsigned char *vertices; /* little-endian, as they come */
    size_t count;
    uint32_t *places; /* a vertex or none each, from where the checksum says on */
    size_t mask;      /* how many there are, less one */
    unsigned char *faces;
} merging;

static bool make_room(merging *g)
{
    const size_t corners = CORNERS * g->m->triangles;
    size_t places = 4;
    while (places < corners + corners / 2)
        places *= 2;
    g->mask = places - 1;
    g->vertices = malloc(corners * g->vertex);
    g->places = malloc(places * sizeof *g->places);
    g->faces = malloc(corners * INDEX);
    if (g->places)
        memset(g->places, 0xff, places * sizeof *g->places);
    return g->vertices && g->places && g->faces;
}

/* 0 and -0 are one place: a sum with 0 is never -0. */
static void put_vertex(unsigned char *to, const double u[NUMBERS], bool is_double)
{
    const double wide[NUMBERS] = {u[0] + 0, u[1] + 0, u[2] + 0};
    const float narrow[NUMBERS] = {(float)wide[0], (float)wide[1], (float)wide[2]};
    memcpy(to, is_double ? (const void *)wide : narrow, NUMBERS * (is_double ? sizeof *wide : sizeof *narrow));
    little_turn(to, NUMBERS, is_double ? sizeof *wide : sizeof *narrow);
}

/* The number of the vertex that lies behind all others: that of one before it, or a new one. */
static uint32_t find_vertex(merging *g)
{
    const unsigned char *const last = g->vertices + g->count * g->vertex;
    size_t place = (size_t)checksum_bytes(CHECKSUM_EMPTY, last, g->vertex) & g->mask;
    for (; g->places[place] != none; place = (place + 1) & g->mask)
        if (!memcmp(g->vertices + g->places[place] * g->vertex, last, g->vertex))
            return g->places[place];
    return g->places[place] = (uint32_t)g->count++;
}

static void merge(merging *g)
{
    double u[NUMBERS * CORNERS];
    for (size_t t = 0; t < g->m->triangles; t++) {
        mesh_triangle(g->m, t, u);
        for (size_t v = 0; v < CORNERS; v++) {
            put_vertex(g->vertices + g->count * g->vertex, u + NUMBERS * v, g->m->is_double);
            little_put32(g->faces + INDEX * (CORNERS * t + v), find_vertex(g));
        }
    }
}

static int write_arrays(const file_out *out, const merging *g, const rgb *colours)
{
    static const npy_array faces = {"faces.npy", "<u4", CORNERS, CORNERS * INDEX}, of_faces = {"colours.npy", "|u1", 3, 3};
    const npy_array vertices = {"vertices.npy", g->m->is_double ? "<f8" : "<f4", NUMBERS, (unsigned)g->vertex};
    zip_out zip;
    const bool is_open = zip_begin(&zip, out->stream, false);
    if (is_open) {
        zip_add_array(&zip, &vertices, g->count, g->vertices);
        zip_add_array(&zip, &faces, g->m->triangles, g->faces);
        if (colours)
            zip_add_array(&zip, &of_faces, g->m->triangles, colours);
        zip_end(&zip);
    }
    zip_free(&zip);
    if (!is_open)
        return message_failure("%s: out of memory", out->path);
    return ferror(out->stream) ? file_out_failure(out) : EXIT_CODE_OK;
}

int mesh_npz_write(const file_out *out, const mesh *m, const rgb *colours)
{
    merging g = {.m = m, .vertex = NUMBERS * (m->is_double ? sizeof(double) : sizeof(float))};
    if (m->triangles >= none / CORNERS)
        return message_failure("%s: too many triangles for numbers of 32 bits: %zu; crop the mesh first", out->path, m->triangles);
    int code = make_room(&g) ? EXIT_CODE_OK : message_failure("%s: out of memory for %zu triangles", out->path, m->triangles);
    if (!code) {
        merge(&g);
        code = write_arrays(out, &g, colours);
    }
    free(g.vertices);
    free(g.places);
    free(g.faces);
    return code;
}
