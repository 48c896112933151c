/* mesh_warn.c - what a user should know of a mesh. */
#include <inttypes.h>

#include "console/message.h"
#include "mesh.h"

void mesh_warn_not_finite(const char *path, uint64_t not_finite, uint64_t count, uint64_t first)
{
    if (not_finite)
        message_say("warning: %s: %" PRIu64 " of %" PRIu64
                    " triangles have NaN or infinite coordinates and overlap nothing; the first is number %" PRIu64,
                    path, not_finite, count, first);
}

void mesh_warn_rounded(const char *path, const mesh *m)
{
    if (m->rounded)
        message_say("warning: %s: rounding to float moved coordinates of %zu vert%s by up to %.2g", path, m->rounded,
                    m->rounded == 1 ? "ex" : "ices", m->moved);
}

void mesh_warn(const char *path, const mesh *m)
{
    mesh_warn_not_finite(path, m->not_finite, m->triangles, m->first_not_finite);
    mesh_warn_rounded(path, m);
    if (m->uncut)
        message_say("warning: %s: %zu of %zu triangles are missing: libassimp cannot cut polygons that cross themselves", path,
                    m->uncut, m->soup.count + m->uncut);
    if (m->miscut)
        message_say("warning: %s: %zu polygon%s cannot be cut well, so the triangles cover too much; triangulate the mesh first",
                    path, m->miscut, m->miscut == 1 ? "" : "s");
}
