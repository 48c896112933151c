/* assimp_plugin.h - what the program asks of the plugin that knows libassimp, which is loaded when a file needs it. */
#ifndef ASSIMP_PLUGIN_H
#define ASSIMP_PLUGIN_H

#include <stddef.h>

typedef struct assimp_counts {
    size_t triangles;        /* polygons are cut */
    size_t points_and_lines; /* left out */
    size_t uncut;            /* triangles missing, since a polygon that crosses itself could not be cut */
} assimp_counts;

/* Room for why a file cannot be read. */
enum { ASSIMP_REASON = 300 };

/* What triangles have for colours. */
typedef struct assimp_colours {
    size_t of_vertices, of_materials; /* so many have them from there, or from both */
    size_t textured;                  /* so many have a texture, and so none that is known here */
} assimp_colours;

typedef struct assimp_plugin {
    /*
     * The scene in a file, and what is in it; NULL if it fails, with the reason. *opened: the names of all files that were opened
     * for it, each with its end, and then an empty one; NULL where memory fails before the first. For free().
     */
    const void *(*open)(const char *path, assimp_counts *counts, char **opened, char *reason);

    /* Writes its triangles, so many, as nine streams, one after another: x of the three vertices, then y, then z. */
    void (*put)(const void *scene, size_t triangles, float *streams);

    /*
     * Writes red, green and blue of each of its triangles, 1 the most: the mean of its corners where vertices have colours, times
     * that of its material if there is one. NaN where it has none.
     */
    assimp_colours (*colour)(const void *scene, float (*of)[3]);

    void (*close)(const void *scene);
} assimp_plugin;

/* Its file, and its one symbol. */
#define ASSIMP_PLUGIN_FILE "tribox_assimp.so"
#define ASSIMP_PLUGIN_SYMBOL "tribox_assimp_plugin"
extern const assimp_plugin tribox_assimp_plugin;

#endif
