/* npy.h - the first bytes of an array as NumPy stores it, version 1.0. */
#ifndef NPY_H
#define NPY_H

enum { NPY_HEADER = 128 }; /* whatever the array */

/* type: such as "<u4". shape: as Python writes it, "(3, 4)". Both together are of at most 60 characters. */
void npy_header(unsigned char header[NPY_HEADER], const char *type, const char *shape);

#endif
