/*
 * sweep.c - what does each accuracy, choice and order of the axes cost, how often does it err, and why? What tribox sweep says of a
 * mesh, for scenes too: all contestants of a scene run interleaved.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/box_scenes.h"
#include "console/accuracy.h"
#include "files/files.h"
#include "paper/paper.h"
#include "read/mesh.h"
#include "sweep/sweep.h"

static const char *const axes_names[] = {"", "box", "plane", "box+plane", "edges", "box+edges", "plane+edges", "all"};

static double share_of(size_t part, size_t of, double unit) { return of ? unit * (double)part / (double)of : (double)NAN; }

/* What a pair that float leaves undecided costs beyond one that FAST decides, in nanoseconds; NAN where there are next to none. */
static double undecided_ns(const contest *of, size_t c, size_t fast, double pairs)
{
    const double share = (double)of->scores[c].undecided / pairs, least_share = 5e-3;
    return share < least_share ? (double)NAN : (measure_least(&of->taken, c) - measure_least(&of->taken, fast)) / share;
}

static void tell_accuracy(printout *out, const char *name, size_t pairs, const contest *of, size_t c)
{
    const tribox_options *const own = &of->list[c].options;
    const score *const s = &of->scores[c];
    const size_t fast = contestant_fast_of(of->list, of->count, c);
    ADD(out, TEXT("kernel", own->kernel ? own->kernel : "paper"), TEXT("accuracy", own->kernel ? accuracy_word(own->accuracy) : ""),
        TEXT("axes", axes_names[own->axes]), TEXT_DATA("scene", name));
    printout_times(out, &of->taken, c);
    ROW(out, NUMBER_IF(fast != c, "times_fast", 2, measure_ratio(&of->taken, c, fast).median),
        NUMBER("missed_a_million", 1, share_of(s->of_accuracy.missed, pairs, 1e6)),
        NUMBER("untrue_a_million", 1, share_of(s->of_accuracy.untrue, pairs, 1e6)),
        NUMBER("extra_a_million", 1, share_of(s->of_all.untrue, pairs, 1e6)),
        NUMBER_IF(own->kernel, "undecided_%", 4, share_of(s->undecided, pairs, 100)),
        NUMBER_IF(fast != c, "ns_each", 1, undecided_ns(of, c, fast, (double)pairs)));
}

/* With all axes: the paper's test as published, and each kernel in the default order. */
static void tell_accuracies(printout *out, const char *name, size_t pairs, const sweep *s)
{
    for (size_t c = 0; c < s->count; c++) {
        const tribox_options *const own = &s->list[c].options;
        if (own->axes == TRIBOX_AXES_ALL && own->axis_order == (own->kernel ? SWEEP_DEFAULT : PAPER_ORDER))
            tell_accuracy(out, name, pairs, s, c);
    }
}

/* The other choices of them, with one kernel. Returns NULL, or what is wrong. */
static const char *tell_choices(asked *q, const char *name, const timing_work *work)
{
    static contest chosen;
    chosen.count = (size_t)SWEEP_AXES * SWEEP_ACCURACIES;
    for (size_t c = 0; c < chosen.count; c++)
        chosen.list[c] = contestant_kernel(work, &(tribox_options){.accuracy = sweep_accuracies[c % SWEEP_ACCURACIES],
                                                                   .axes = sweep_axes[c / SWEEP_ACCURACIES],
                                                                   .kernel = q->kernel});
    const char *const failure = contest_run(&chosen, work, asked_effort(q, SWEEP_ROUNDS, 2, 5e-4), &q->order);
    for (size_t c = 0; !failure && c < chosen.count; c++)
        tell_accuracy(&q->out, name, work->pairs, &chosen, c);
    return failure;
}

/* Nanoseconds, least of the rounds, of one kernel and accuracy. */
static void tell_order(printout *out, const sweep *s, const char *kernel, tribox_accuracy accuracy)
{
    const contestant *const best = sweep_best(s, kernel, accuracy);
    ADD(out, TEXT("kernel", kernel ? kernel : "paper"), TEXT("accuracy", kernel ? accuracy_word(accuracy) : ""));
    for (int o = 0; o < SWEEP_ORDERS; o++) {
        static const char *const names[SWEEP_ORDERS] = {"default", "123", "132", "213", "231", "312", "321"};
        const contestant *const one = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, sweep_orders[o]);
        ADD(out, NUMBER_IF(one, names[o], 3, sweep_time(s, one)));
    }
    const contestant *const plain = sweep_find(s, kernel, accuracy, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    const bool is_faster = plain && sweep_beats(s, best, plain);
    ROW(out, NUMBER_IF(is_faster, "faster_than_default", 0, best->options.axis_order));
}

/* Counts that are the same on every machine. */
static void tell_packets(printout *out, const why *w)
{
    for (int o = 0; o < WHY_ORDERS; o++) {
        static const char *const names[WHY_WIDTHS] = {"1_lane", "4_lanes", "8_lanes", "16_lanes"};
        static const char *const bytes[WHY_WIDTHS] = {"bytes_of_1", "bytes_of_4", "bytes_of_8", "bytes_of_16"};
        ADD(out, NUMBER("order", 0, why_orders[o]));
        for (int l = 0; l < WHY_WIDTHS; l++)
            ADD(out, NUMBER(names[l], 1, share_of(w->order[o].packets_left[l][0], w->packets[l], 100)));
        for (int l = 0; l < WHY_WIDTHS; l++)
            ADD(out, NUMBER(bytes[l], 1, share_of(w->order[o].bytes[l], w->pairs, 1)));
        printout_row(out);
    }
}

static bool ask_about(asked *q, const char *name, const char *what, const timing_work *work)
{
    static sweep s;
    static why w;
    printout *const out = &q->out;
    const char *failure = sweep_run(&s, work, asked_effort(q, SWEEP_ROUNDS, 4, 5e-4), &q->order), *kernel;
    if (failure)
        return message_failure("scene %s: %s; nothing is reported", name, failure) == EXIT_CODE_OK;
    why_find(work, &w);
    printout_table(out, "scene %s: %s; %zu pairs in %zu soups, of which %.2f %% overlap; %zu rounds", name, what, work->pairs,
                   work->count, share_of(w.overlapping, w.pairs, 100), s.taken.rounds);
    tell_accuracies(out, name, work->pairs, &s);
    if ((failure = tell_choices(q, name, work)) != NULL)
        return message_failure("scene %s: %s", name, failure) == EXIT_CODE_OK;
    printout_disturbed(out, &s.taken);
    printout_table(out, "%s: ns a pair, least of the rounds, by order of the axes: 1 box normals, 2 plane, 3 edges", name);
    tell_order(out, &s, NULL, TRIBOX_FAST);
    for (size_t k = 0; (kernel = tribox_kernel_list(k)) != NULL; k++)
        for (int a = 0; a < SWEEP_ACCURACIES; a++)
            tell_order(out, &s, kernel, sweep_accuracies[a]);
    printout_table(out, "%s: percent of the packets left after the first group of axes; bytes loaded for a pair", name);
    tell_packets(out, &w);
    return true;
}

static bool ask_scene(asked *q, scene *at)
{
    timing_work_shorten(&at->work, (size_t)asked_number(q, OPTION_SIZE, asked_has(q, OPTION_QUICK) ? 65536 : SIZE_MAX));
    return ask_about(q, at->name, at->what, &at->work);
}

static bool ask_mesh(asked *q, const char *path)
{
    const bool has_grid = asked_has(q, OPTION_GRID);
    sweep_wish wish = {.kind = has_grid ? SWEEP_GRID : SWEEP_OCTREE,
                       .depth = (unsigned)asked_number(q, OPTION_OCTREE, 0),
                       .along = (unsigned)q->number[OPTION_GRID]};
    char what[128];
    timing_work work;
    mesh m;
    if (!mesh_list_read(path, &m))
        return false;
    const bool is_made = sweep_work_make(path, &m, &wish, &work) == EXIT_CODE_OK;
    mesh_free(&m);
    if (!is_made)
        return false;
    sweep_work_describe(&wish, &work, what, sizeof what);
    const bool is_right = ask_about(q, path + named_file_folder(path), what, &work);
    timing_work_free(&work);
    return is_right;
}

static bool answer(asked *q)
{
    const size_t count = asked_has(q, OPTION_NO_SCENES) ? 0 : SCENES_COMPARED + 1;
    bool is_right = scenes_ask_named(q, scenes_compared, count, true, ask_scene);
    for (size_t k = 0; is_right && k < q->meshes.count; k++)
        is_right = ask_mesh(q, q->meshes.path[k]);
    return is_right;
}

const bench_question question_sweep = {
    .name = "sweep",
    .asks = "What does each accuracy, choice and order of the axes cost, and how often does it err?",
    .options = 1u << OPTION_QUICK | 1u << OPTION_KERNEL | 1u << OPTION_SCENE | 1u << OPTION_NO_SCENES | 1u << OPTION_SIZE |
               1u << OPTION_OCTREE | 1u << OPTION_GRID,
    .takes_meshes = true,
    .answer = answer};
