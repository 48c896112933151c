/* plain_ply.c - tells the two kinds of PLY files apart. */
#include "plain_ply.h"

#include "console/message.h"

bool plain_ply(const plain_file *file, mesh *m)
{
    ply_header h;
    if (ply_header_read(NULL, &file->head, &h) != EXIT_CODE_OK || h.element_count < 2)
        return false;
    if (h.elements[0].kind != PLY_VERTICES || h.elements[1].kind != PLY_FACES || h.elements[0].count > UINT32_MAX)
        return false;
    for (int i = 2; i < h.element_count; i++)
        if (h.elements[i].count)
            return false;
    return h.format == PLY_ASCII ? plain_ply_text(file, &h, m) : plain_ply_binary(file, &h, m);
}
