/* read_by_assimp.c - reads a file by the part of the program that knows libassimp. */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <stddef.h>

#include "assimp_part.h"
#include "console/message.h"
#include "readers.h"

/*
 * The part stands beside the program's libraries. It is loaded for these files alone: libassimp takes twice as long
 * to load as all the rest.
 */
static const assimp_part *load(void)
{
    void *const library = dlopen(ASSIMP_PART_FILE, RTLD_NOW | RTLD_LOCAL);
    return library ? dlsym(library, ASSIMP_PART_SYMBOL) : NULL;
}

int read_by_assimp(const char *path, mesh *m)
{
    const assimp_part *const part = load();
    if (!part)
        return message_failure("%s: not a PLY, OFF, OBJ, STL, .f32 or .f64 file, and what reads others cannot be loaded: %s", path,
                               dlerror());
    assimp_counts counts;
    char reason[ASSIMP_REASON];
    const void *const scene = part->open(path, &counts, reason);
    if (!scene)
        return message_failure("%s: %s", path, reason);
    m->left_out = counts.points_and_lines;
    m->uncut = counts.uncut;
    const int code = mesh_make_room(path, counts.triangles, m);
    if (!code) {
        part->put(scene, counts.triangles, m->coordinates);
        m->soup.count = counts.triangles;
    }
    part->close(scene);
    return code;
}
