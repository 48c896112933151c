/* fill_case.h - meshes and grids whose insides are asked for, of floats or doubles, and the calls about them by one name. */
#ifndef TRIBOX_TESTS_FILL_CASE_H
#define TRIBOX_TESTS_FILL_CASE_H

#include <stddef.h>

#include "common/guard.h"
#include "common/random_draws.h"
#include "crossing_oracle.h"
#include "tribox.h"

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

const uint32_t *fill_case_size(const fill_case *c);
size_t fill_case_words(const fill_case *c);

/* The triangles as a mesh of doubles or as nine streams of floats, which end at a page that cannot be touched. */
typedef struct fill_mesh {
    guarded pages;
    tribox_mesh mesh;
    tribox_soup soup;
} fill_mesh;

fill_mesh fill_mesh_make(const fill_case *c);
static inline void fill_mesh_free(fill_mesh m) { guarded_free(m.pages); }

/* The call. */
tribox_status fill_case_parity(const fill_case *c, const fill_mesh *m, const uint64_t *occupied, uint64_t *solid, void *scratch,
                               size_t *inside, size_t *odd_rows);

/* Triangles in another order, each with its vertices in another order. */
void fill_case_shuffle(random_source *r, fill_case *c);

#endif
