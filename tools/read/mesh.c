/* mesh.c - finds the reader of a file, and turns what it reads into streams. */
#define _POSIX_C_SOURCE 200809L
#include "mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "mesh_file.h"
#include "plain.h"
#include "scan.h"

/* Number i of the floats ends before number i + 1 of the doubles begins. */
static double round_number(unsigned char *bytes, size_t i, double origin)
{
    double number;
    memcpy(&number, bytes + i * sizeof number, sizeof number);
    const double relative = number - origin;
    const float nearest = (float)relative;
    memcpy(bytes + i * sizeof nearest, &nearest, sizeof nearest);
    return isfinite(nearest) ? fabs(relative - (double)nearest) : 0;
}

/* Rounds the doubles to floats, in place, after the origin is subtracted, and counts those that this has moved. */
static void round_all(const double origin[3], mesh *m)
{
    for (size_t v = 0; v < m->doubles.vertices; v++) {
        double most = 0;
        for (size_t a = 0; a < 3; a++)
            most = fmax(most, round_number(m->positions, 3 * v + a, origin[a]));
        m->rounded += most > 0;
        m->moved = fmax(m->moved, most);
    }
}

int mesh_to_floats(const char *path, const double origin[3], mesh *m)
{
    if (!m->is_double)
        return EXIT_CODE_OK;
    tribox_mesh all = m->doubles;
    round_all(origin, m);
    all.position_bytes = sizeof(float);
    all.stride = 0;
    int code = mesh_make_room(path, all.count, m);
    if (!code && !mesh_look_all(&all, 1, m))
        code = message_failure("%s: refers to vertices that there are not", path);
    mesh_drop_doubles(m);
    return code;
}

/* By gzip. libassimp reads some such files, with names of their own. */
static int refuse_compressed(const char *from, mesh_kind kind, const whole_file *file)
{
    if (file->size < 2 || memcmp(file->bytes, "\x1f\x8b", 2) || (kind == MESH_OTHER && !mesh_kind_has_ending(from, ".gz")))
        return EXIT_CODE_OK;
    if (!strcmp(from, "-"))
        return message_failure("stdin: is compressed; send it through zcat first");
    return message_failure("%s: is compressed; give it as in 'zcat FILE | tribox COMMAND - --format ply'", from);
}

int mesh_read_slowly(const char *from, mesh_kind kind, bool is_wide, unsigned threads, mesh *m)
{
    const char *const path = triangle_file_name(from);
    whole_file file;
    indexed_mesh indexed = {.position_bytes = 0};
    int code = whole_file_read(from, kind, &file);
    if (!code && kind == MESH_OTHER) {
        words first = words_of(path, &file, '#');
        words_next(&first);
        kind = mesh_kind_by(path, &first);
    }
    if (!code)
        code = refuse_compressed(from, kind, &file);
    if (!code && kind != MESH_OTHER)
        code = scan_read(path, kind, &file, &indexed);
    whole_file_free(&file);
    if (!code && kind != MESH_OTHER)
        code = mesh_take(path, &indexed, is_wide, threads, m);
    else if (!code && !(code = read_by_assimp(path, m)))
        mesh_look_all(NULL, threads, m);
    indexed_mesh_free(&indexed);
    return code;
}

bool mesh_read_plain(const char *path, bool is_wide, unsigned threads, size_t chunk_bytes, mesh *m)
{
    static plain_reader *const readers[MESH_OTHER + 1] = {
        [MESH_PLY] = plain_ply, [MESH_STL_TEXT] = plain_stl, [MESH_OBJ] = plain_obj};
    plain_file file = {.threads = threads, .is_wide = is_wide, .chunk_bytes = chunk_bytes};
    bool is_read = plain_file_open(path, &file);
    if (is_read) {
        words first = words_of(path, &file.head, '#');
        plain_reader *const read = words_next(&first) && !words_is_cut(&first) ? readers[mesh_kind_by(path, &first)] : NULL;
        is_read = read && read(&file, m);
    }
    plain_file_close(&file);
    if (!is_read)
        mesh_free(m);
    return is_read;
}

int mesh_read_over(const mesh_request *r, mesh *m)
{
    const char *const path = r->path;
    triangle_file file;
    *m = (mesh){.coordinates = NULL};
    int code = triangle_file_open(path, r->format, &file);
    const mesh_kind kind = triangle_format_kind(r->format);
    if (!code && file.stream) {
        code = mesh_read_triangles(&file, r->threads, r->over, m);
    } else if (!code) {
        const bool may_be_plain = strcmp(path, "-") && (kind == MESH_OTHER || kind == mesh_kind_of(path));
        if (!may_be_plain || !mesh_read_plain(path, r->is_wide, r->threads, PLAIN_CHUNK_BYTES, m))
            code = mesh_read_slowly(path, kind, r->is_wide, r->threads, m);
    }
    triangle_file_close(&file);
    if (!code && !m->triangles && !r->may_be_empty && !(r->over && r->over->is_used))
        code = message_failure("%s: contains no triangles (points or lines at most); give a mesh with faces",
                               triangle_file_name(path));
    if (code)
        mesh_free(m);
    return code;
}

int mesh_read(const char *path, mesh *m)
{
    int code = mesh_read_over(&(mesh_request){.path = path, .threads = 1}, m);
    if (code)
        return code;
    code = mesh_to_floats(path, (const double[3]){0, 0, 0}, m);
    if (code)
        mesh_free(m);
    return code;
}
