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

/* Reads a regular file that is not empty. Returns an exit_code; whole_file_free may follow in any case. */
int whole_file_read(const char *path, whole_file *file);

void whole_file_free(whole_file *file);

/* OTHER: libassimp may know it. Binary STL is a matter of triangle_file.h. */
typedef enum mesh_kind { MESH_PLY, MESH_OFF, MESH_STL_TEXT, MESH_OBJ, MESH_OTHER } mesh_kind;

/* The same of a file, from its beginning; OTHER where it cannot be read. */
mesh_kind mesh_kind_of(const char *path);

bool mesh_kind_has_ending(const char *path, const char *ending);

/* The bar of a file that is read for more than a moment; tests and benchmarks show none. */

/* From now on where standard error is a terminal; or not, as at first. */
void reading_show(bool is_wanted);

/* One file after another. Any thread tells what share is done, 0 to 1: cheap, but not for every triangle. */
void reading_begin(void);
void reading_tell(double done);
void reading_end(void);

#endif
