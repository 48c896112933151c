/* materials.h - the materials of OBJ files, by their names. */
#ifndef MATERIALS_H
#define MATERIALS_H

#include <stddef.h>

#include "rgb.h"

typedef struct material {
    char *name;
    rgb colour;
    bool has_colour;
} material;

typedef struct materials {
    material *of;
    size_t count, room;
} materials;

/* Adds those of a file. Returns an exit_code; materials_free may follow in any case. */
int materials_read(materials *m, const char *path);

/* The first of that name; NULL where there is none. */
const material *materials_find(const materials *m, const char *name, size_t length);

void materials_free(materials *m);

#endif
