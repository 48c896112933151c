/* mesh_file.h - a file as bytes, and whether it holds all that it promises. */
#ifndef MESH_FILE_H
#define MESH_FILE_H

#include <stdbool.h>
#include <stddef.h>

/* The bytes of a whole file, with a NUL byte behind the last. */
typedef struct mesh_file {
    char *bytes;
    size_t size;
} mesh_file;

/* Reads a regular, non-empty file. Returns an exit_code; on success mesh_file_free gives the bytes back. */
int mesh_file_read(const char *path, mesh_file *file);

void mesh_file_free(mesh_file *file);

/*
 * libassimp takes what a PLY, OFF or STL text file lacks for zeros, or hangs. These refuse a file that ends before it holds what it
 * promises, or whose faces refer to no vertex. Each returns an exit_code.
 */
int mesh_file_check_stl(const char *path, const mesh_file *file);
int mesh_file_check_off(const char *path, const mesh_file *file);

/*
 * The same for PLY, and ends its header in CR LF: behind a lone LF libassimp takes a first data byte of value 10 for part of the
 * line end, and reads all values shifted by one byte.
 */
int mesh_file_check_ply(const char *path, mesh_file *file);

/* Whether the file says of itself that it is PLY, whatever its name. */
bool mesh_file_is_ply(const mesh_file *file);

#endif
