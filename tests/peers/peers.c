/*
 * peers.c - an index over a soup against other libraries that answer the same question: are the answers the same, and who is how
 * fast?
 *
 * Exact peers have to agree on every triangle and box, or the program fails and times nothing more. Those that round are counted.
 */
#include <stdio.h>
#include <string.h>

#include "common/header.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "peers_report.h"

enum { MESHES_MAX = 16, RESULTS_MAX = MESHES_MAX + 1, SKIPPED = 77, BOXES = 50, BOXES_OF_TEST = 5, TRIANGLES_OF_TEST = 20000 };

/* A linear pass has as many boxes as there is time for. */
static const size_t linear_pairs = 100000000, verified_pairs = 5000000;

typedef struct settings {
    uint64_t seed, boxes, rounds, terrain;
    bool is_timed;
    const char *csv;
    const char *mesh[MESHES_MAX];
    size_t meshes;
} settings;

static const char usage[] =
    "Usage: peers [--verify] [--terrain N] [--boxes N] [--rounds N] [--seed N] [--csv FILE] [MESH...]\n"
    "Compares an index over a soup with CGAL, Embree and Bullet, those of them that were found: answers, then times.\n"
    "  MESH             a mesh file; $TRIBOX_MESHES may name a folder to look in. Without one dragon_vrip, buildings, "
    "SainteHelens\n"
    "                   and sponza (.ply) of that folder\n"
    "  --verify         answers alone, about few boxes\n"
    "  --terrain N      triangles of a terrain that is made here; without it 20000 to verify, else 0\n"
    "  --boxes N        boxes of each size; without it 50, to verify 5\n"
    "  --rounds N       rounds, 3 to 101; without it 9\n"
    "  --seed N         of the terrain, the boxes and the order within the rounds\n"
    "  --csv FILE       writes the times for the chart\n";

enum { OPTION_VERIFY, OPTION_TERRAIN, OPTION_BOXES, OPTION_ROUNDS, OPTION_SEED, OPTION_CSV };

static const option_entry options[] = {[OPTION_VERIFY] = {"verify", 0, false},
                                       [OPTION_TERRAIN] = {"terrain", 't', true},
                                       [OPTION_BOXES] = {"boxes", 'b', true},
                                       [OPTION_ROUNDS] = {"rounds", 0, true},
                                       [OPTION_SEED] = {"seed", 0, true},
                                       [OPTION_CSV] = {"csv", 0, true},
                                       {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    switch (which) {
    case OPTION_VERIFY:
        s->is_timed = false;
        return EXIT_CODE_OK;
    case OPTION_TERRAIN:
        return whole_read(value, "terrain", 0, UINT32_MAX, &s->terrain);
    case OPTION_BOXES:
        return whole_read(value, "boxes", 1, 100000, &s->boxes);
    case OPTION_ROUNDS:
        return whole_read(value, "rounds", 3, 101, &s->rounds);
    case OPTION_SEED:
        return whole_read(value, "seed", 0, UINT64_MAX, &s->seed);
    case OPTION_CSV:
        s->csv = value;
        return EXIT_CODE_OK;
    default:
        if (s->meshes == MESHES_MAX)
            return message_usage("'%s' is one mesh too many: give %d at most", value, MESHES_MAX);
        s->mesh[s->meshes++] = value;
        return EXIT_CODE_OK;
    }
}

/* Exact peers may not differ; the index has no excuse, as CGAL and Embree have none. */
static bool are_answers_right(const field *f, const peer_errors errors[PEERS_MAX])
{
    bool is_right = true;
    for (size_t p = 0; p < f->peer_count; p++)
        if (f->peers[p].tree && (errors[p].any || (f->peers[p].peer->is_exact && errors[p].missing + errors[p].extra))) {
            message_failure("%s: %s answers otherwise: missing %zu, extra %zu%s", f->scene->name, f->peers[p].peer->name,
                            errors[p].missing, errors[p].extra, errors[p].any ? ", and whether there is any" : "");
            is_right = false;
        }
    return is_right;
}

static bool run_size(field *f, int size, const settings *s, tribox_box *boxes, generator *order, peers_result *r,
                     peer_errors errors[PEERS_MAX])
{
    const size_t count = (size_t)s->boxes;
    index_scene_boxes(f->scene, peer_part[size], count, s->seed + (uint64_t)size, boxes);
    if (!field_answer(f, boxes, count, index_scene_boxes_within(f->scene, verified_pairs, count), errors))
        return false;
    if (s->is_timed) {
        field_time(f, (size_t)s->rounds, index_scene_boxes_within(f->scene, linear_pairs, count), order, r->us[size]);
        peers_print_row(r, size, (double)f->start[count] / (double)count);
    }
    return are_answers_right(f, errors);
}

static bool run_scene(const index_scene *at, const settings *s, generator *order, peers_result *r)
{
    field f;
    peer_errors errors[PEERS_MAX] = {{0}};
    size_t hits = 0;
    tribox_box *const boxes = malloc((size_t)s->boxes * sizeof *boxes);
    bool is_run = field_make(at, (size_t)s->boxes, &f) && boxes;
    *r = (peers_result){.triangles = at->room.soup.count};
    memcpy(r->name, at->name, sizeof r->name);
    r->entrant_count = field_entrants(&f, r->entrants);
    if (is_run && s->is_timed)
        peers_print_head(&f, r);
    else if (is_run)
        printf("\n%s: %zu triangles\n", at->name, r->triangles);
    for (int size = 0; is_run && size < PEER_SIZES; size++) {
        is_run = run_size(&f, size, s, boxes, order, r, errors);
        hits += is_run ? f.start[s->boxes] : 0;
    }
    if (is_run)
        peers_print_errors(&f, PEER_SIZES * (size_t)s->boxes, hits, errors);
    field_free(&f);
    free(boxes);
    return is_run;
}

static bool run_all(const settings *s, peers_result *results, size_t *count)
{
    generator order = {~s->seed};
    index_scene at;
    *count = 0;
    for (size_t i = 0; i < s->meshes + (s->terrain > 0); i++) {
        if (!(i < s->meshes ? index_scene_read(s->mesh[i], &at) : index_scene_terrain((size_t)s->terrain, s->seed, &at)))
            return false;
        const bool is_run = run_scene(&at, s, &order, &results[(*count)++]);
        index_scene_free(&at);
        if (!is_run)
            return false;
    }
    return true;
}

static int write_csv(const char *path, const peers_result *results, size_t count)
{
    FILE *const to = fopen(path, "w");
    if (!to)
        return message_failure("%s: cannot be written", path);
    peers_csv_head(to);
    for (size_t r = 0; r < count; r++)
        peers_csv(to, &results[r]);
    return fclose(to) ? message_failure("%s: cannot be written", path) : EXIT_CODE_OK;
}

int main(int argc, char **argv)
{
    static peers_result results[RESULTS_MAX];
    settings s = {.seed = 1, .rounds = 9, .is_timed = true, .boxes = 0};
    options_found found;
    size_t count;
    message_set_program("peers");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    if (!peers_here[0]) {
        printf("skipped: built without CGAL, Embree and Bullet (Debian: libcgal-dev, libembree-dev, libbullet-dev)\n");
        return SKIPPED;
    }
    s.boxes = s.boxes ? s.boxes : s.is_timed ? BOXES : BOXES_OF_TEST;
    s.terrain = options_has(&found, OPTION_TERRAIN) || s.is_timed ? s.terrain : TRIANGLES_OF_TEST;
    const char *const *usual;
    const size_t usual_count = s.meshes ? 0 : index_scene_usual(&usual);
    for (size_t k = 0; k < usual_count; k++)
        s.mesh[s.meshes++] = usual[k];
    const run r = {argc, argv, s.seed, machine_here()};
    header_text(stdout, "", &r);
    if (!run_all(&s, results, &count))
        return EXIT_CODE_FAILURE;
    if (s.is_timed)
        peers_print_goals(results, count);
    return s.csv ? write_csv(s.csv, results, count) : EXIT_CODE_OK;
}
