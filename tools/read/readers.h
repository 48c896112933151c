/* readers.h - the readers of mesh files, one for each format. */
#ifndef READERS_H
#define READERS_H

#include "indexed_mesh.h"
#include "mesh.h"
#include "whole_file.h"

/*
 * Each reads the bytes of a file into an empty mesh, or says what is wrong and where. What a file promises is not
 * believed: memory is in proportion to its size. path is for messages. Returns an exit_code; indexed_mesh_free follows in any case.
 */
int read_ply(const char *path, const whole_file *file, indexed_mesh *m);
int read_off(const char *path, const whole_file *file, indexed_mesh *m);
int read_obj(const char *path, const whole_file *file, indexed_mesh *m);

/* STL as text; triangle_file.h reads the binary kind. */
int read_stl_text(const char *path, const whole_file *file, indexed_mesh *m);

/* The formats that libassimp knows. Scene transforms are applied. Returns an exit_code; mesh_free may follow in any case. */
int read_by_assimp(const char *path, mesh *m);

/* The colours of such a file's triangles, so many, as assimp_part.h has them. Returns an exit_code. */
struct assimp_colours;
int read_colours_by_assimp(const char *path, size_t triangles, float (*of)[3], struct assimp_colours *found);

#endif
