/*
 * main.c - what does exactness cost, and what does it save one from? Every scene, accuracy, choice of axes and kernel: time,
 * errors against the true answer, and the stages in which EXACT and CONSERVATIVE come to theirs.
 *
 * The contestants of one choice of axes run interleaved in rounds; nothing is timed before EXACT is the same on every kernel.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy_options.h"
#include "leaves.h"
#include "read/mesh.h"
#include "trade.h"

static const char *const scenes_of_all[] = {"paper",        "sparse", "cad",     "cad-tenths", "touching",
                                            "touching-ulp", "offset", "needles", "caps"};
enum { SCENES = sizeof scenes_of_all / sizeof scenes_of_all[0] };

static const struct {
    const char *name;
    unsigned axes;
} choices[] = {
    {"all", TRIBOX_AXES_ALL},
    {"box", TRIBOX_AXES_BOX},
    {"box+plane", TRIBOX_AXES_BOX | TRIBOX_AXES_PLANE},
    {"box+edges", TRIBOX_AXES_BOX | TRIBOX_AXES_EDGES},
    {"plane+edges", TRIBOX_AXES_PLANE | TRIBOX_AXES_EDGES},
    {"edges", TRIBOX_AXES_EDGES},
};
enum { CHOICES = sizeof choices / sizeof choices[0] };

/* Where the rows go, and what was drawn so far. */
typedef struct output {
    FILE *csv, *json;
    bool is_first;
    generator order;
} output;

/* Kernels at every accuracy, the widest first; with all axes the paper's test in front of them. */
static size_t enter(contestant list[CONTESTANTS_MAX], unsigned axes)
{
    const size_t all = contest_enter(list);
    size_t count = 0;
    for (size_t c = 0; c < all; c++) {
        contestant one = list[c];
        if (one.kind == CONTESTANT_KERNEL)
            one.options.axes = axes;
        else if (one.kind != CONTESTANT_BASELINE || axes != TRIBOX_AXES_ALL)
            continue;
        list[count++] = one;
    }
    return count;
}

static void add_score(score *sum, const score *s)
{
    sum->overlapping += s->overlapping;
    sum->undecided += s->undecided;
    sum->of_accuracy.missed += s->of_accuracy.missed;
    sum->of_accuracy.untrue += s->of_accuracy.untrue;
    sum->of_all.missed += s->of_all.missed;
    sum->of_all.untrue += s->of_all.untrue;
}

static bool verify(const contestant *list, size_t count, const scene *at, size_t scenes, score *scores)
{
    memset(scores, 0, count * sizeof *scores);
    for (size_t s = 0; s < scenes; s++) {
        score of_one[CONTESTANTS_MAX];
        if (!contest_verify(list, count, &at[s], of_one))
            return false;
        for (size_t c = 0; c < count; c++)
            add_score(&scores[c], &of_one[c]);
    }
    return true;
}

static bool take_apart(const contestant *list, size_t count, const scene *at, size_t scenes, const settings *s, output *out,
                       stages *apart)
{
    for (size_t c = 0; c < count; c++)
        if (list[c].kind == CONTESTANT_KERNEL && list[c].options.accuracy != TRIBOX_FAST &&
            !stages_measure(&list[c].options, at, scenes, s->stage_rounds, &out->order, &apart[c]))
            return false;
    return true;
}

/* One choice of axes on scenes that share a soup. mask: room for the mask of any of them. */
static bool run_choice(size_t choice, const scene *at, size_t scenes, const settings *s, output *out, uint64_t *mask)
{
    static samples taken;
    contestant list[CONTESTANTS_MAX];
    score scores[CONTESTANTS_MAX];
    stages apart[CONTESTANTS_MAX];
    const size_t count = enter(list, choices[choice].axes);
    if (!verify(list, count, at, scenes, scores))
        return false;
    measure(list, count, at, scenes, s->how, &out->order, mask, &taken);
    if (!take_apart(list, count, at, scenes, s, out, apart))
        return false;
    const trade t = {at, scenes, choices[choice].name, list, scores, apart, &taken};
    if (choice == 0)
        trade_table_scene(&t);
    trade_table(&t);
    if (out->csv)
        trade_csv(out->csv, &t, out->is_first);
    if (out->json)
        trade_json(out->json, &t, out->is_first);
    out->is_first = false;
    return true;
}

static bool run_choices(const scene *at, size_t scenes, const settings *s, output *out)
{
    uint64_t *const mask = malloc(tribox_mask_words(at->soup.count) * sizeof *mask);
    bool is_right = mask;
    if (!mask)
        fprintf(stderr, "accuracy: out of memory for scene %s\n", at->name);
    for (size_t choice = 0; is_right && choice < CHOICES; choice++)
        is_right = run_choice(choice, at, scenes, s, out, mask);
    free(mask);
    return is_right;
}

static bool run_scene(size_t index, const settings *s, output *out)
{
    scene at;
    if (!scene_make(index, s->seed, &at))
        return false;
    if (at.soup.count > s->triangles_most)
        at.soup.count = s->triangles_most;
    const bool is_right = run_choices(&at, 1, s, out);
    scene_free(&at);
    return is_right;
}

static bool is_asked(const settings *s, const char *name)
{
    if (s->scene || !s->has_scenes)
        return s->scene && !strcmp(s->scene, name);
    for (size_t k = 0; k < SCENES; k++)
        if (!strcmp(scenes_of_all[k], name))
            return true;
    return false;
}

/* The name of a file without its folder and its ending. */
static void name_of_file(const char *path, char name[64])
{
    const char *const slash = strrchr(path, '/');
    snprintf(name, 64, "%s", slash ? slash + 1 : path);
    char *const dot = strrchr(name, '.');
    if (dot && dot != name)
        *dot = 0;
}

static bool run_mesh(const char *path, const settings *s, output *out)
{
    mesh read;
    cells made;
    char name[64];
    if (mesh_read(path, &read))
        return false;
    name_of_file(path, name);
    bool is_right = cells_make(name, s->cells, &read.soup, s->along, s->cells_most, s->seed, &made);
    if (is_right) {
        is_right = run_choices(made.at, made.count, s, out);
        cells_free(&made);
    }
    mesh_free(&read);
    return is_right;
}

static bool run_all(const settings *s, output *out)
{
    for (size_t i = 0; i < scene_count(); i++)
        if (is_asked(s, scene_name(i)) && !run_scene(i, s, out))
            return false;
    for (size_t m = 0; m < s->meshes; m++)
        if (!run_mesh(s->mesh[m], s, out))
            return false;
    return true;
}

static bool open_file(const char *path, FILE **file)
{
    *file = path ? fopen(path, "w") : NULL;
    if (path && !*file)
        fprintf(stderr, "accuracy: cannot write '%s'; is its folder there?\n", path);
    return !path || *file;
}

static bool close_file(const char *path, FILE *file)
{
    const bool is_written = !file || (!ferror(file) && !fclose(file));
    if (!is_written)
        fprintf(stderr, "accuracy: '%s' is not complete; is the disk full?\n", path);
    return is_written;
}

int main(int argc, char **argv)
{
    settings s;
    const int status = accuracy_options(argc, argv, &s);
    if (status >= 0)
        return status;
    const run r = {argc, argv, s.seed, machine_here()};
    output out = {.is_first = true, .order = {~s.seed}};
    if (!open_file(s.csv, &out.csv) || !open_file(s.json, &out.json))
        return 1;
    header_text(stdout, "", &r);
    if (out.csv)
        trade_csv_begin(out.csv, &r);
    if (out.json)
        trade_json_begin(out.json, &r);
    const bool is_right = run_all(&s, &out);
    if (out.json)
        trade_json_end(out.json);
    return close_file(s.csv, out.csv) && close_file(s.json, out.json) && is_right ? 0 : 1;
}
