/* crop_faces.h - the faces of a mesh file, one after another, and the side to which each goes: for the writers of formats. */
#ifndef CROP_FACES_H
#define CROP_FACES_H

#include "console/progress.h"
#include "crop.h"

enum { CROP_BUFFER = 1 << 16 };

typedef struct crop {
    const char *path; /* of the mesh */
    crop_choice choice;
    FILE *to[CROP_SIDES];              /* NULL: not wanted */
    unsigned char *buffer[CROP_SIDES]; /* what is written next */
    size_t filled[CROP_SIDES];
    crop_counts counts[CROP_SIDES];
    uint64_t next;    /* triangle, of the face that comes next */
    bool is_changed;  /* the file has not the triangles that it had */
    int pass, passes; /* over all faces */
    uint64_t told;    /* faces */
    progress *bar;
    int failed, reason; /* whether a write failed, its side + 1, and why */
} crop;

/* Begins with the first face again. */
void crop_begin(crop *c);

/* The side of the next face, of so many corners. Of fewer than three it has no triangle, and goes with the rest. */
crop_side crop_next(crop *c, uint64_t corners);

/* Whether there is no use in going on. */
static inline bool crop_is_over(const crop *c) { return c->is_changed || c->failed; }

/* Writes to a side, or to both; nothing to one that is not wanted. */
void crop_put(crop *c, crop_side side, const void *bytes, size_t size);
void crop_put_both(crop *c, const void *bytes, size_t size);

/* Writes all of a mesh file, until crop_is_over. Returns an exit_code, of other failures than that of a write or a change. */
int crop_scanned(crop *c, mesh_kind kind);

#endif
