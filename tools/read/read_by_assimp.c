/* read_by_assimp.c - reads a file by the plugin of the program that knows libassimp. */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <stddef.h>
#include <stdlib.h>

#include "assimp_plugin.h"
#include "console/message.h"
#include "mesh.h"
#include "mesh_file.h"

/*
 * The plugin stands beside the program's libraries. It is loaded for these files alone: libassimp takes twice as long
 * to load as all the rest.
 */
static const assimp_plugin *load(void)
{
    void *const library = dlopen(ASSIMP_PLUGIN_FILE, RTLD_NOW | RTLD_LOCAL);
    return library ? dlsym(library, ASSIMP_PLUGIN_SYMBOL) : NULL;
}

/* NULL after a line. */
static const void *open_scene(const char *path, const assimp_plugin **plugin, assimp_counts *counts, char **opened)
{
    char reason[ASSIMP_REASON];
    *plugin = load();
    if (!*plugin) {
        message_failure("%s: not a file of " MESH_ENDINGS ", and what reads others cannot be loaded: %s", path, dlerror());
        return NULL;
    }
    const void *const scene = (*plugin)->open(path, counts, opened, reason);
    if (!scene)
        message_failure("%s: %s", path, reason);
    return scene;
}

int read_colours_by_assimp(const char *path, size_t triangles, float (*of)[3], assimp_colours *found)
{
    const assimp_plugin *plugin;
    assimp_counts counts;
    char *opened = NULL;
    const void *const scene = open_scene(path, &plugin, &counts, &opened);
    free(opened);
    if (!scene)
        return EXIT_CODE_FAILURE;
    if (counts.triangles == triangles)
        *found = plugin->colour(scene, of);
    plugin->close(scene);
    return counts.triangles == triangles ? EXIT_CODE_OK : message_failure("%s: has changed while it was read", path);
}

int read_by_assimp(const char *path, mesh *m)
{
    const assimp_plugin *plugin;
    assimp_counts counts;
    const void *const scene = open_scene(path, &plugin, &counts, &m->opened);
    if (!scene)
        return EXIT_CODE_FAILURE;
    m->left_out = counts.points_and_lines;
    m->uncut = counts.uncut;
    const int code = mesh_make_room(path, counts.triangles, m);
    if (!code) {
        plugin->put(scene, counts.triangles, m->coordinates);
        m->triangles = m->soup.count = counts.triangles;
    }
    plugin->close(scene);
    return code;
}
