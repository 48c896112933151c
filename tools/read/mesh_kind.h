/* mesh_kind.h - which reader takes a mesh file. */
#ifndef MESH_KIND_H
#define MESH_KIND_H

#include <stdbool.h>

struct words;

/* OTHER: libassimp may know it. Binary STL is a matter of triangle_file.h. */
typedef enum mesh_kind { MESH_PLY, MESH_OFF, MESH_STL_TEXT, MESH_OBJ, MESH_OTHER } mesh_kind;

/* By the first word of its text, which may be none: what a file says of itself counts for more than its name. */
mesh_kind mesh_kind_by(const char *path, const struct words *first);

/* The same of a file, from its beginning; OTHER where it cannot be read. */
mesh_kind mesh_kind_of(const char *path);

bool mesh_kind_has_ending(const char *path, const char *ending);

#endif
