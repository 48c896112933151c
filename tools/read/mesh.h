/* mesh.h - a mesh file as a triangle soup of floats or, where float does not hold its numbers, as a mesh of doubles. */
#ifndef MESH_H
#define MESH_H

#include <stdbool.h>

#include "console/written_number.h"
#include "triangle_file.h"
#include "tribox.h"

/* What a reader finds in a file: vertices, and triangles that refer to them. Polygons are cut as they come. */
typedef struct indexed_mesh {
    void *positions;         /* x, y, z of each vertex */
    unsigned position_bytes; /* 4: floats, 8: doubles, of which each is a float if `fit` says so */
    float_fit fit;           /* the worst of all coordinates */
    size_t vertices, vertices_max;
    uint32_t *corners; /* three vertices of each triangle */
    size_t triangles, triangles_max;
    uint32_t *face; /* the corners of the face that is being read */
    size_t face_max;
    size_t left_out; /* points and lines */
    size_t miscut;   /* polygons whose triangles cover more than they do */
} indexed_mesh;

/* Makes room for as many vertices at least, of floats or doubles. Returns an exit_code; path is for the message. */
int indexed_mesh_reserve(const char *path, uint64_t vertices, unsigned position_bytes, indexed_mesh *m);

/* Adds a vertex, for which there is room. */
void indexed_mesh_add_vertex(const double position[3], indexed_mesh *m);

/* Doubles that are floats, or decimals that floats give back, become floats. Others stay. */
void indexed_mesh_narrow(indexed_mesh *m);

/* Makes room for the corners of a face, in m->face. Returns an exit_code. */
int indexed_mesh_reserve_face(const char *path, uint64_t corners, indexed_mesh *m);

void indexed_mesh_position(const indexed_mesh *m, uint32_t vertex, double position[3]);

/*
 * Adds m->face, whose corners are vertices that there are: cut into a fan around its first corner that sees all of it, where there
 * is one, else by cutting off its ears. Returns an exit_code.
 */
int indexed_mesh_add_face(const char *path, size_t corners, indexed_mesh *m);

/* Adds one triangle. Returns an exit_code. */
int indexed_mesh_add_triangle(const char *path, uint32_t a, uint32_t b, uint32_t c, indexed_mesh *m);

void indexed_mesh_free(indexed_mesh *m);

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
    size_t not_finite;   /* triangles with a NaN or infinite coordinate */
    size_t first_not_finite; /* the first of them */
    tribox_box bounds;       /* of its finite triangles; lo > hi where there are none */
    size_t capacity;         /* triangles that the streams have room for */
    float *coordinates;      /* what the streams point into, from pages_take */
    void *positions;         /* and what `doubles` does */
    uint32_t *corners;
    char *opened; /* by libassimp: names of files, each with its end, and then an empty one; or NULL */
} mesh;

/*
 * Reads a mesh file: PLY, OFF, OBJ, STL and raw triangles here, others by libassimp. Coordinates are those of the file, bit for bit
 * where it holds floats or doubles, otherwise the nearest. libassimp may be an ulp of float off, and applies the transforms of
 * scenes. format: in place of the name, also of a stream, for which the memory grows; "-" is stdin.
 * threads: that work on it, 1 to THREADS_MAX; the mesh is the same for any number. Returns an exit_code; a file without a triangle
 * is a failure. On success mesh_free gives the memory back.
 */
int mesh_read_as(const char *path, triangle_format format, unsigned threads, mesh *m);

/* Where the triangles of a stream go that are more than memory is to hold. */
typedef struct mesh_overflow {
    uint64_t memory;                                                        /* bytes that they may take before */
    int (*put)(void *data, bool is_double, const void *bytes, size_t size); /* takes what .f32 or .f64 has; returns an exit_code */
    void *data;
    bool is_used; /* all of them went there, and the mesh has none */
} mesh_overflow;

/*
 * mesh_read_as; is_wide: numbers of a text stay doubles even where floats would do. over: NULL for none; only a stream of triangles
 * uses it.
 */
int mesh_read_over(const char *path, triangle_format format, bool is_wide, unsigned threads, mesh_overflow *over, mesh *m);

/* mesh_read_as, by its name and one thread, as floats in any case. */
int mesh_read(const char *path, mesh *m);

/* Makes a mesh of doubles one of floats, rounded once after the origin is subtracted. Returns an exit_code. */
int mesh_to_floats(const char *path, const double origin[3], mesh *m);

/* Makes room for triangles as floats, for which the readers ask. No triangles at all are a failure. Returns an exit_code. */
int mesh_make_room(const char *path, uint64_t count, mesh *m);

/* The same in silence: for at least one triangle. Returns false where there is no memory. */
bool mesh_take_room(uint64_t count, mesh *m);

/* Makes room for more floats than there is, and keeps those that are there. False without memory. */
bool mesh_grow(uint64_t count, mesh *m);

/* Where triangle `first` goes: x of the three vertices, then y, then z. */
void mesh_streams(const mesh *m, size_t first, float *to[9]);

/* Gives the room back. */
void mesh_drop_floats(mesh *m);

/* Makes it a mesh of doubles. Memory for free() goes over to it; corners: NULL for 0, 1, 2, ... */
void mesh_set_doubles(double *positions, size_t vertices, uint32_t *corners, size_t triangles, mesh *m);

/* Fills room that there is for them with all triangles of `from`, rounded to floats. False where that fails. */
bool mesh_fill(const tribox_mesh *from, unsigned threads, mesh *m);

/*
 * Makes what a reader has found a mesh of floats, where these or decimals that they give back are all its numbers; or of doubles,
 * which go over to it. False where there is no memory.
 */
bool mesh_take(indexed_mesh *from, bool is_wide, unsigned threads, mesh *m);

/* Rounds the doubles to floats, in place, after the origin is subtracted, and counts those that this has moved. */
void mesh_round(const double origin[3], mesh *m);

/* Reads a file of a format that libassimp knows, and applies the transforms of its scene. Returns an exit_code. */
int read_by_assimp(const char *path, mesh *m);

/* The colours of such a file's triangles, so many, as assimp_plugin.h has them. Returns an exit_code. */
struct assimp_colours;
int read_colours_by_assimp(const char *path, size_t triangles, float (*of)[3], struct assimp_colours *found);

/* Reads all triangles of an open file into an empty mesh, a regular one by threads. over: as above. Returns an exit_code. */
int mesh_read_triangles(triangle_file *file, unsigned threads, mesh_overflow *over, mesh *m);

/*
 * The two ways to read a whole file, which tests compare. The fast one returns false, with nothing said and nothing to be freed,
 * where the file is not plain (plain.h); the other knows every spelling, and says what is wrong with a file.
 */
bool mesh_read_plain(const char *path, bool is_wide, unsigned threads, size_t chunk_bytes, mesh *m);
int mesh_read_slowly(const char *path, bool is_wide, unsigned threads, mesh *m);

/* The bounds of its finite triangles; false where there are none. */
static inline bool mesh_bounds(const mesh *m, tribox_box *bounds)
{
    *bounds = m->bounds;
    return bounds->lo[0] <= bounds->hi[0];
}

/* Says on standard error which triangles are not finite, missing or cut badly, and which vertices are rounded. */
void mesh_warn(const char *path, const mesh *m);

/* Says the last of these alone. */
void mesh_warn_rounded(const char *path, const mesh *m);

/* Says the first of these, for triangles that are in no mesh; silent if there are none. */
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

/* What one look at all triangles finds: those that are not finite, and the box around the others. */
typedef struct mesh_look {
    size_t not_finite, first; /* the first that is not, or SIZE_MAX */
    tribox_box bounds;        /* lo > hi where none is finite */
} mesh_look;

mesh_look mesh_look_none(void);

/* Adds triangles first .. first + count - 1. Small blocks are looked at best just after they were written. */
void mesh_look_at(const mesh *m, size_t first, size_t count, mesh_look *look);

/* The same of threads that look at parts of a mesh at once. */
void mesh_look_add(const mesh *m, size_t first, size_t count, mesh_look *all);

/* Puts so many triangles of `from`, from `begin` on, in the streams, from `first` on, and adds them. False where it fails. */
bool mesh_look_put(const tribox_mesh *from, size_t begin, size_t count, size_t first, mesh *m, mesh_look *all);

/* Keeps what was found in the mesh. */
void mesh_look_keep(const mesh_look *all, mesh *m);

/* All of it, by threads. */
void mesh_look_all(unsigned threads, mesh *m);

/* What --shift subtracts from a mesh. */
typedef struct mesh_shift {
    bool is_wanted;
    bool is_auto; /* `by` is chosen when the mesh is read */
    double by[3];
} mesh_shift;

/* Reads the value of --shift, X,Y,Z or "auto". Returns an exit_code. */
int mesh_shift_read(const char *text, mesh_shift *shift);

/*
 * mesh_read_as, and subtracts the shift from all positions, in double; the mesh is one of floats where float holds the differences.
 * auto: round numbers near the lower corner of the mesh, in units of a power of ten that its longest side does not exceed.
 */
int mesh_read_shifted(const char *path, triangle_format format, mesh_shift *shift, unsigned threads, mesh_overflow *over, mesh *m);

/* What auto chooses for a mesh of these bounds. */
void mesh_shift_choose(const tribox_box *bounds, double by[3]);

#endif
