/* crop_ply.c - opens a PLY file: one as text is read as a whole, of a binary one the header. */
#include "crop_ply.h"

#include <stdlib.h>

#include "console/message.h"
#include "read/plain.h"

/* Of the header alone a copy is made, as its reader looks for the end of a text. Longer ones are read with the whole file. */
static int read_head(crop_ply_file *f)
{
    plain_file file = {.path = f->c->path};
    const bool is_open = plain_file_open(f->c->path, &file);
    const bool is_short = is_open && ply_header_read(NULL, &file.head, &f->header) == EXIT_CODE_OK && f->header.format != PLY_ASCII;
    if (is_short) {
        f->head = file.head;
        file.head = (whole_file){NULL, 0};
    }
    plain_file_close(&file);
    const int code = is_short ? EXIT_CODE_OK : whole_file_read(f->c->path, &f->head);
    return code || is_short ? code : ply_header_read(f->c->path, &f->head, &f->header);
}

void crop_ply_count(crop_ply_file *f)
{
    for (int s = 0; s < CROP_SIDES; s++) {
        kept_numbers_count(&f->kept[s]);
        f->c->counts[s].vertices = f->kept[s].kept;
    }
}

static int make_kept(crop_ply_file *f)
{
    int code = EXIT_CODE_OK;
    for (int e = 0; e < f->header.element_count; e++)
        if (f->header.elements[e].kind == PLY_VERTICES)
            f->vertices = f->header.elements[e].count;
    for (int s = 0; !code && s < CROP_SIDES; s++)
        code = kept_numbers_make(f->c->path, f->vertices, &f->kept[s]);
    return code;
}

int crop_ply(crop *c)
{
    crop_ply_file *const f = calloc(1, sizeof *f);
    if (!f)
        return message_failure("%s: out of memory", c->path);
    f->c = c;
    int code = read_head(f);
    if (!code)
        code = crop_ply_check(f);
    if (!code)
        code = make_kept(f);
    if (!code && f->header.format != PLY_ASCII)
        code = crop_ply_binary(f);
    else if (!code)
        crop_ply_text(f);
    for (int s = 0; s < CROP_SIDES; s++)
        kept_numbers_free(&f->kept[s]);
    whole_file_free(&f->head);
    free(f);
    return code;
}
