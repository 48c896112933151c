/* npy_header.c - NumPy's own format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html */
#include "npy_header.h"

#include <stdio.h>
#include <string.h>

/* Magic, version, length and text together are a multiple of 64, as the format demands. */
enum { BEFORE_TEXT = 10 };

void npy_header(unsigned char header[NPY_HEADER], const char *type, const char *shape)
{
    char *const text = (char *)header + BEFORE_TEXT;
    memcpy(header, "\x93NUMPY\x01\x00", 8);
    header[8] = NPY_HEADER - BEFORE_TEXT;
    header[9] = 0;
    memset(text, ' ', NPY_HEADER - BEFORE_TEXT);
    const int length =
        snprintf(text, NPY_HEADER - BEFORE_TEXT, "{'descr': '%s', 'fortran_order': False, 'shape': %s, }", type, shape);
    text[length] = ' ';
    header[NPY_HEADER - 1] = '\n';
}
