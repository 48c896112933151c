/* shell_corners.h - the vertices of a shell where each has one colour: one that faces of several colours share is as many. */
#ifndef SHELL_CORNERS_H
#define SHELL_CORNERS_H

#include "shell/shell.h"

typedef struct shell_corner {
    uint32_t vertex; /* of the shell */
    uint32_t next;   /* another corner of that; UINT32_MAX: none */
    rgb colour;
} shell_corner;

typedef struct shell_corners {
    uint32_t (*places)[3]; /* of the shell's vertices, in halves of cells */
    uint32_t *first;       /* corner of each of them */
    shell_corner *of;      /* in the order in which triangles come to them */
    size_t count, room;
    bool lacks_memory;
} shell_corners;

/* Walks through the triangles. Returns false without memory, or where `tell` stops it; shell_corners_free is due in any case. */
bool shell_corners_make(shell_corners *c, const shell *s, bool (*tell)(void *data, double done), void *data);

/* The number of a corner that there is. */
uint32_t shell_corners_find(const shell_corners *c, uint32_t vertex, rgb colour);

void shell_corners_free(shell_corners *c);

#endif
