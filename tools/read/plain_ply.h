/* plain_ply.h - the two kinds of PLY files. */
#ifndef PLAIN_PLY_H
#define PLAIN_PLY_H

#include "plain.h"
#include "ply_header.h"

/* Each reads a file that has vertices, then faces, and nothing else: as a plain_reader. */
bool plain_ply_binary(const plain_file *file, const ply_header *header, mesh *m);
bool plain_ply_text(const plain_file *file, const ply_header *header, mesh *m);

#endif
