/* materials.h - the materials of the faces of OBJ. */
#ifndef MATERIALS_H
#define MATERIALS_H

#include "read/words.h"
#include "rgb.h"
#include "write/file_out.h"

typedef struct material {
    char *name;
    rgb colour;
    bool has_colour;
} material;

typedef struct materials {
    const char *path;              /* of the mesh */
    const file_out_names *outputs; /* none of which may be a file of materials */
    material *of;
    size_t count, room;
    const material *now; /* of the faces that follow; NULL for none */
    uint64_t missing;    /* lines that use a material that there is not */
} materials;

/* Takes a line, of which `line` has the first word, for what it says of materials. Returns an exit_code; materials_end follows. */
int materials_take(materials *m, words line);
void materials_end(materials *m);

#endif
