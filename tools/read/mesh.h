/* mesh.h - a mesh file as a triangle soup of floats or, where float does not hold its numbers, as a mesh of doubles. */
#ifndef MESH_H
#define MESH_H

#include <stdbool.h>

#include "console/written_number.h"
#include "triangle_file.h"
#include "tribox.h"

/* A list that grows, in rooms of pages_take. */
typedef struct page_list {
    void *of;
    size_t count, room;
} page_list;

/* Adds so many, of `each` bytes: returns where they go; NULL where there is no memory. */
void *page_list_add(size_t count, size_t each, page_list *list);

/* What a reader finds in a file: vertices, and faces that refer to them. */
typedef struct indexed_mesh {
    page_list positions;      /* x, y, z of each vertex */
    unsigned position_bytes;  /* 4: floats, 8: doubles, of which each is a float if `fit` says so */
    float_fit fit;            /* the worst of all coordinates */
    page_list corners, sizes; /* of all faces, one after another, and how many each has */
    bool is_soup;             /* there are no faces: each three vertices are a triangle */
    size_t left_out;          /* points and lines */
    size_t miscut;            /* polygons whose triangles cover more than they do */
} indexed_mesh;

/* Makes triangles of all faces, in `corners`; those of one corner or two are left out. False where there is no memory. */
bool indexed_mesh_cut(unsigned threads, indexed_mesh *m);

/*
 * Cuts a face, whose corners are vertices that there are, into as many triangles as it has corners beyond two: a fan around its
 * first corner that sees all of it, where there is one, else by cutting off its ears. False where they cover more than it does.
 */
bool polygon_cut(const indexed_mesh *m, const uint32_t *face, size_t corners, uint32_t *triangles);

void indexed_mesh_free(indexed_mesh *m);

/* Nine streams, each so far behind the one before: x of the three vertices, then y, then z. */
static inline tribox_soup soup_of_streams(const float *first, size_t apart, size_t count)
{
    tribox_soup soup = {.count = count};
    for (size_t k = 0; k < 9; k++)
        (k < 3 ? soup.x : k < 6 ? soup.y : soup.z)[k % 3] = first + k * apart;
    return soup;
}

/* What a look at triangles finds, whichever their order. */
typedef struct triangles_seen {
    uint64_t not_finite, first_not_finite; /* how many have a NaN or infinite coordinate; UINT64_MAX for none */
    tribox_box bounds;                     /* of the others; lo > hi where there are none */
} triangles_seen;

extern const triangles_seen no_triangles_seen;
void triangles_seen_add(const triangles_seen *from, triangles_seen *to);

static inline bool triangle_is_finite(const double u[9])
{
    double zero = 0; /* or NaN */
    for (int k = 0; k < 9; k++)
        zero += 0 * u[k];
    return zero == 0;
}

static inline double least_number(double a, double b) { return a < b ? a : b; }
static inline double most_number(double a, double b) { return a > b ? a : b; }

/* Looks at one: x, y, z of each vertex. Returns whether it is finite. */
static inline bool triangles_see(uint64_t number, const double u[9], triangles_seen *s)
{
    if (!triangle_is_finite(u)) {
        s->not_finite++;
        s->first_not_finite = number < s->first_not_finite ? number : s->first_not_finite;
        return false;
    }
    for (int a = 0; a < 3; a++) {
        s->bounds.lo[a] = least_number(s->bounds.lo[a], least_number(least_number(u[a], u[3 + a]), u[6 + a]));
        s->bounds.hi[a] = most_number(s->bounds.hi[a], most_number(most_number(u[a], u[3 + a]), u[6 + a]));
    }
    return true;
}

typedef struct mesh {
    size_t triangles;    /* all of them, in the order of the file; polygons are cut, degenerate triangles stay */
    tribox_soup soup;    /* as floats; empty if is_double */
    tribox_mesh doubles; /* as doubles if is_double */
    bool is_double;      /* a coordinate is no float, nor a decimal that the nearest float gives back, as it does 0.1; or .f64 */
    size_t left_out;     /* points and lines of the file */
    size_t uncut;        /* triangles missing, since libassimp could not cut a polygon that crosses itself */
    size_t miscut;       /* polygons whose triangles cover more than they do */
    size_t rounded;      /* vertices of which mesh_to_floats has moved a coordinate */
    double moved;        /* the most that it has moved one */
    triangles_seen seen; /* of all, but that the first that is not finite is `triangles` where all are */
    size_t capacity;     /* triangles that the streams have room for */
    float *coordinates;  /* what the streams point into, from pages_take */
    void *positions;     /* and what `doubles` does */
    uint32_t *corners;
    size_t position_room, corner_room; /* bytes of these from pages_take; 0: from malloc */
    char *opened;                      /* by libassimp: names of files, each with its end, and then an empty one; or NULL */
} mesh;

/* Where the triangles of a stream go that are more than memory is to hold. */
typedef struct mesh_overflow {
    uint64_t memory;                                                        /* bytes that they may take before */
    int (*put)(void *data, bool is_double, const void *bytes, size_t size); /* takes what .f32 or .f64 has; returns an exit_code */
    void *data;
    bool is_used; /* all of them went there, and the mesh has none */
} mesh_overflow;

/* Which file is read, and how. */
typedef struct mesh_request {
    const char *path;       /* "-" is stdin */
    triangle_format format; /* in place of the name, also of a stream, for which the memory grows */
    bool is_wide;           /* numbers of a text stay doubles even where floats would do */
    bool may_be_empty;      /* or a file without a triangle is a failure */
    unsigned threads;       /* that work on it, 1 to THREADS_MAX; the mesh is the same for any number */
    mesh_overflow *over;    /* NULL for none; only a stream of triangles uses it */
} mesh_request;

/*
 * Reads a mesh file: PLY, OFF, OBJ, STL and raw triangles here, others by libassimp. Coordinates are those of the file, bit for bit
 * where it holds floats or doubles, otherwise the nearest. libassimp may be an ulp of float off, and applies the transforms of
 * scenes. Returns an exit_code; on success mesh_free gives the memory back.
 */
int mesh_read_over(const mesh_request *r, mesh *m);

/* mesh_read_over, by its name and one thread, as floats in any case. */
int mesh_read(const char *path, mesh *m);

/* Makes a mesh of doubles one of floats, rounded once after the origin is subtracted. Returns an exit_code. */
int mesh_to_floats(const char *path, const double origin[3], mesh *m);

/* Makes room for triangles as floats. Returns an exit_code; path: NULL to say nothing, and to fail for none. */
int mesh_make_room(const char *path, uint64_t count, mesh *m);

void mesh_drop_floats(mesh *m);
void mesh_drop_corners(mesh *m);
void mesh_drop_doubles(mesh *m);

/* Where triangle `first` goes: x of the three vertices, then y, then z. */
void mesh_streams(const mesh *m, size_t first, float *to[9]);

/* Makes it a mesh of doubles. Memory for free() goes over to it; corners: NULL for 0, 1, 2, ... */
void mesh_set_doubles(double *positions, size_t vertices, uint32_t *corners, size_t triangles, mesh *m);

/*
 * Makes what a reader has found a mesh of floats, where these or decimals that they give back are all its numbers; or of doubles.
 * Returns an exit_code; path: for messages, NULL for none.
 */
int mesh_take(const char *path, indexed_mesh *from, bool is_wide, unsigned threads, mesh *m);

/* Reads a file of a format that libassimp knows, and applies the transforms of its scene. Returns an exit_code. */
int read_by_assimp(const char *path, mesh *m);

/* The colours of such a file's triangles, so many, as assimp_plugin.h has them. Returns an exit_code. */
struct assimp_colours;
int read_colours_by_assimp(const char *path, size_t triangles, float (*of)[3], struct assimp_colours *found);

/* Reads all triangles of an open file into an empty mesh, a regular one by threads. over: as above. Returns an exit_code. */
int mesh_read_triangles(triangle_file *file, unsigned threads, mesh_overflow *over, mesh *m);

/*
 * The two ways to read a whole file, which tests compare. The fast one returns false, with nothing said and nothing to be freed,
 * where the file is not plain (plain.h); the other knows every spelling, and says what is wrong with a file. kind: OTHER for what
 * the file says itself.
 */
bool mesh_read_plain(const char *path, bool is_wide, unsigned threads, size_t chunk_bytes, mesh *m);
int mesh_read_slowly(const char *path, mesh_kind kind, bool is_wide, unsigned threads, mesh *m);

/* The bounds of its finite triangles; false where there are none. */
static inline bool mesh_bounds(const mesh *m, tribox_box *bounds)
{
    *bounds = m->seen.bounds;
    return bounds->lo[0] <= bounds->hi[0];
}

/* Say on standard error which triangles are not finite, missing or cut badly, and which vertices are rounded; or one of these. */
void mesh_warn(const char *path, const mesh *m);
void mesh_warn_rounded(const char *path, const mesh *m);
void mesh_warn_not_finite(const char *path, uint64_t not_finite, uint64_t count, uint64_t first);

/* The coordinates of triangle t: x, y, z of each vertex. */
static inline void mesh_triangle(const mesh *m, size_t t, double u[9])
{
    const double *const positions = m->positions;
    const float *const *const streams[3] = {m->soup.x, m->soup.y, m->soup.z};
    for (size_t k = 0; k < 9; k++)
        u[k] = m->is_double ? positions[3 * (m->corners ? m->corners[3 * t + k / 3] : 3 * t + k / 3) + k % 3]
                            : (double)streams[k % 3][k / 3][t];
}

void mesh_free(mesh *m);

/* Begins and ends a look for triangles that are not finite, and for the box around the others. */
void mesh_look_begin(mesh *m);
void mesh_look_end(mesh *m);

/* Any thread adds triangles first .. first + count - 1. Small blocks are looked at best just after they were written. */
void mesh_look_add(size_t first, size_t count, mesh *m);

/* Puts so many triangles of `from`, from `begin` on, in the streams, from `first` on, and adds them. False where it fails. */
bool mesh_look_put(const tribox_mesh *from, size_t begin, size_t count, size_t first, mesh *m);

/*
 * All of it, by threads. from: what fills the room that there is with all of its triangles, rounded to floats; NULL where they are
 * there. False where that fails.
 */
bool mesh_look_all(const tribox_mesh *from, unsigned threads, mesh *m);

/* What --shift subtracts from a mesh. */
typedef struct mesh_shift {
    bool is_wanted;
    bool is_auto; /* `by` is chosen when the mesh is read */
    double by[3];
} mesh_shift;

/* Reads the value of --shift, X,Y,Z or "auto". Returns an exit_code. */
int mesh_shift_read(const char *text, mesh_shift *shift);

/*
 * mesh_read_over, wide if the shift is wanted, which is subtracted from all positions, in double; the mesh is one of floats where
 * float holds these.
 * auto: round numbers near the lower corner of the mesh, in units of a power of ten that its longest side does not exceed.
 */
int mesh_read_shifted(const mesh_request *r, mesh_shift *shift, mesh *m);

/* What auto chooses for a mesh of these bounds. */
void mesh_shift_choose(const tribox_box *bounds, double by[3]);

#endif
