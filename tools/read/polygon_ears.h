/* polygon_ears.h - cuts a polygon that is no fan: ear after ear. */
#ifndef POLYGON_EARS_H
#define POLYGON_EARS_H

#include "indexed_mesh.h"

/*
 * Adds the triangles of m->face, whose corners are vertices that there are, where ears can be cut off until a triangle is left: a
 * polygon that does not cross itself. normal: of its plane, roughly. *is_cut receives whether it did. Returns an exit_code.
 */
int polygon_ears_cut(const char *path, size_t corners, const double normal[3], indexed_mesh *m, bool *is_cut);

#endif
