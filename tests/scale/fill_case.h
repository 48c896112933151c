/* fill_case.h - meshes and grids whose insides are asked for, of floats or doubles, and the calls about them by one name. */
#ifndef TRIBOX_TESTS_FILL_CASE_H
#define TRIBOX_TESTS_FILL_CASE_H

#include "common/guard.h"
#include "common/random_draws.h"
#include "common/soup_or_mesh.h"
#include "crossing_oracle.h"

enum { CASE_WORDS_MAX = ORACLE_CELLS };

typedef struct fill_case {
    const char *scene, *body;
    bool is_double, is_closed;
    bool is_within; /* the mesh is in the grid */
    tribox_grid grid;
    crossing_case at; /* the triangles, and the middles by the definition */
    uint64_t occupied[CASE_WORDS_MAX];
} fill_case;

size_t fill_case_scenes(void);

/* A mesh in a grid of the scene `number`, and the cells of its surface. */
void fill_case_draw(random_source *r, size_t number, fill_case *c);

/* The triangles as a mesh of doubles or as nine streams of floats, which end at a page that cannot be touched. */
typedef struct fill_mesh {
    guarded pages;
    soup_or_mesh of;
} fill_mesh;

fill_mesh fill_mesh_make(const fill_case *c);
static inline void fill_mesh_free(fill_mesh m) { guarded_free(m.pages); }

/*
 * Fails where free cells that share a face are not both inside or both outside; and, of a mesh in the grid, where the outside
 * reaches what is inside.
 */
void fill_case_check_leaks(const fill_case *c, const uint64_t *walls, const bool *is_inside);

/* Triangles in another order, each with its vertices in another order. */
void fill_case_shuffle(random_source *r, fill_case *c);

#endif
