/* mesh_file.h - the bytes of a whole file, and which reader takes it. */
#ifndef MESH_FILE_H
#define MESH_FILE_H

#include <stdbool.h>
#include <stddef.h>

/* A NUL byte follows the last byte of the file. */
typedef struct whole_file {
    char *bytes;
    size_t size;
} whole_file;

/*
 * Every format that scan.h reads, once: its name in scan_open_ply and scan_next_ply, the word that it begins with, its ending, and
 * what begins a comment. Binary STL is a matter of triangle_file.h.
 */
#define MESH_KINDS(ROW) \
    ROW(MESH_PLY, ply, "ply", ".ply", ' ') \
    ROW(MESH_OFF, off, "off", ".off", '#') \
    ROW(MESH_STL_TEXT, stl, "solid", ".stl", ' ') \
    ROW(MESH_OBJ, obj, "", ".obj", '#')

/* OTHER: libassimp may know it. */
#define MESH_KIND(kind, ...) kind,
typedef enum mesh_kind { MESH_KINDS(MESH_KIND) MESH_OTHER } mesh_kind;

/*
 * Reads a regular file that is not empty, or "-", standard input, to its end; of the latter only the beginning where no mesh of
 * this kind begins so. Returns an exit_code; whole_file_free may follow in any case.
 */
int whole_file_read(const char *path, mesh_kind kind, whole_file *file);

void whole_file_free(whole_file *file);

/* What is read here, for messages and help. */
#define MESH_KIND_ENDING(kind, name, word, ending, ...) ending ", "
#define MESH_ENDINGS MESH_KINDS(MESH_KIND_ENDING) ".f32 or .f64"
#define MESH_KIND_NAME(kind, name, ...) #name ", "
#define MESH_FORMATS MESH_KINDS(MESH_KIND_NAME) "f32 or f64"

/* What a line says that there is no memory for a mesh which has to be read as a whole. */
#define MESH_TO_SORT "; save it as binary .stl, .f32 or .f64, which 'tribox voxelize' and 'tribox partition' sort on the disk"

const char *mesh_kind_ending(mesh_kind kind);
bool mesh_kind_has_ending(const char *path, const char *ending);

/* The kind of a file, from its beginning; OTHER where it cannot be read. */
mesh_kind mesh_kind_of(const char *path);

/* Whether it is PLY that is not text, whose triangles need not be read all at once. */
bool mesh_is_binary_ply(const char *path);

/*
 * The bar of a file that is read for more than a moment. One file after another. Any thread tells what share is done, 0 to 1:
 * cheap, but not for every triangle.
 */
void reading_begin(void);
void reading_tell(double done);
void reading_end(void);

#endif
