/*
 * doubles/main.c - what do meshes of doubles cost, against the same triangles as floats, against reading their bytes, and against
 * CGAL?
 *
 * Nine numbers a triangle, and indices of 32 bits into half as many vertices as triangles. All of a scene are timed in the same
 * rounds; figures are of the least times. The stages that settle what floats leave open are timed on triangles that reach them.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/entries.h"
#include "common/goal.h"
#include "common/header.h"
#include "common/loads.h"
#include "common/whole.h"
#include "console/message.h"
#include "console/option_reader.h"
#include "double_peer.h"
#include "double_scenes.h"

enum { PEER_TRIANGLES = 16384 };

/* What a contestant answers: a form of the scene. */
typedef struct asked {
    const double_scene *at;
    const tribox_mesh *mesh;
    const double_peer *peer;
} asked;

static const asked *question_of(const contestant *self) { return self->question; }

static bool run_floats(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const asked *const q = question_of(self);
    return !tribox_mesh_overlap(q->mesh, &q->at->single_box, &self->options, mask, report);
}

static bool run_doubles(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const asked *const q = question_of(self);
    return !tribox_mesh_overlap(q->mesh, &q->at->box, &self->options, mask, report);
}

static bool run_reading(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const tribox_mesh *const mesh = question_of(self)->mesh;
    (void)report;
    mask[0] = loads_words(mesh->positions, 6 * mesh->vertices);
    if (mesh->indices)
        mask[0] ^= loads_words(mesh->indices, 3 * mesh->count);
    return true;
}

static bool run_peer(const contestant *self, uint64_t *mask, tribox_report *report)
{
    (void)report;
    double_peer_answer(question_of(self)->peer, mask);
    return true;
}

static bool find_truth(const void *question, unsigned axes, uint64_t *mask)
{
    const asked *const q = question;
    return !tribox_mesh_overlap(q->mesh, &q->at->box, &(tribox_options){.axes = axes, .kernel = "scalar"}, mask, NULL);
}

static uint64_t *make_mask(size_t count)
{
    uint64_t *const mask = calloc(tribox_mask_words(count) + 1, sizeof *mask);
    if (!mask)
        exit(message_failure("out of memory"));
    return mask;
}

/* Whom each is held against. */
enum { FLOAT_NINE, FLOAT_INDEXED, DOUBLE_NINE, DOUBLE_INDEXED, READ_NINE, READ_INDEXED, PEER, ENTRIES };

static size_t enter(const double_scene *at, const double_peer *peer, const char *kernel, asked questions[ENTRIES], contestant *list)
{
    const struct {
        const char *name;
        bool (*run)(const contestant *, uint64_t *, tribox_report *);
        const tribox_mesh *mesh;
        answer_promise promise;
    } all[ENTRIES] = {
        [FLOAT_NINE] = {"nine floats", run_floats, &at->single_nine, PROMISE_NOTHING},
        [FLOAT_INDEXED] = {"indexed floats", run_floats, &at->single_indexed, PROMISE_NOTHING},
        [DOUBLE_NINE] = {"nine doubles", run_doubles, &at->nine, PROMISE_EXACT},
        [DOUBLE_INDEXED] = {"indexed doubles", run_doubles, &at->indexed, PROMISE_EXACT},
        [READ_NINE] = {"reading nine doubles", run_reading, &at->nine, PROMISE_NOTHING},
        [READ_INDEXED] = {"reading indexed doubles", run_reading, &at->indexed, PROMISE_NOTHING},
        [PEER] = {"CGAL's Epick", run_peer, &at->nine, PROMISE_NOTHING},
    };
    const size_t count = peer ? ENTRIES : PEER, asked_of_peer = at->count < PEER_TRIANGLES ? at->count : PEER_TRIANGLES;
    for (size_t k = 0; k < count; k++) {
        questions[k] = (asked){at, all[k].mesh, peer};
        list[k] = (contestant){.run = all[k].run,
                               .question = &questions[k],
                               .options = {.kernel = kernel},
                               .promise = all[k].promise,
                               .pairs = (double)(k == PEER ? asked_of_peer : at->count)};
        snprintf(list[k].name, sizeof list[k].name, "%s", all[k].name);
    }
    return count;
}

/* Whether CGAL says the same of every triangle that is not degenerate. */
static bool is_peer_of_one_mind(const double_scene *at, const double_peer *peer)
{
    const size_t count = at->count < PEER_TRIANGLES ? at->count : PEER_TRIANGLES;
    uint64_t *const exact = make_mask(at->count), *const other = make_mask(count);
    size_t unlike = 0;
    find_truth(&(asked){at, &at->nine, NULL}, TRIBOX_AXES_ALL, exact);
    double_peer_answer(peer, other);
    for (size_t i = 0; i < count; i++)
        unlike += ((exact[i / 64] ^ other[i / 64]) >> i % 64 & 1) && !double_peer_is_degenerate(peer, i);
    if (unlike)
        message_failure("%s: CGAL's answer differs on %zu triangles that are not degenerate", at->name, unlike);
    free(exact);
    free(other);
    return !unlike;
}

/* What the goals are about: least times, by scene and contestant. */
typedef struct figures {
    double ns[DOUBLE_SCENES][ENTRIES];
    double stage[STAGE_SCENES];
} figures;

static void print_scene(const double_scene *at, const char *kernel, const score *scores, const contestant *list, size_t count,
                        const samples *taken, double ns[ENTRIES])
{
    printf("\n%s: %zu triangles, %s; %s; %.3f %% left to slower stages\n", at->name, at->count, at->what, kernel,
           100 * (double)scores[DOUBLE_NINE].undecided / (double)at->count);
    printf("%-26s %10s %10s %13s %14s\n", "", "least ns", "median ns", "times floats", "times reading");
    for (size_t k = 0; k < count; k++) {
        const spread time = measure_spread(taken, k);
        ns[k] = time.least;
        printf("%-26s %10.3f %10.3f", list[k].name, time.least, time.median);
        if (k == DOUBLE_NINE || k == DOUBLE_INDEXED)
            printf(" %13.3f %14.3f", ns[k] / ns[k - DOUBLE_NINE + FLOAT_NINE],
                   ns[k] / measure_spread(taken, k - DOUBLE_NINE + READ_NINE).least);
        if (k == PEER)
            printf("   %.0f times the time of nine doubles", ns[k] / ns[DOUBLE_NINE]);
        printf("\n");
    }
    measure_warn_if_disturbed(stdout, taken);
    fflush(stdout);
}

typedef struct settings {
    const char *kernel;
    effort how;
    bool is_quick;
} settings;

static bool run_scene(size_t number, const settings *s, double ns[ENTRIES])
{
    static samples taken;
    double_scene at;
    asked questions[ENTRIES];
    contestant list[CONTESTANTS_MAX];
    score scores[CONTESTANTS_MAX];
    double_scene_make(number, &at);
    double_peer *const peer = double_peer_make(at.nine.positions, at.count < PEER_TRIANGLES ? at.count : PEER_TRIANGLES, &at.box);
    const size_t count = enter(&at, peer, s->kernel, questions, list);
    const truth from = {find_truth, &questions[DOUBLE_NINE], tribox_mask_words(at.count)};
    const bool is_right = entries_verify(list, count, at.name, &from, scores) && (!peer || is_peer_of_one_mind(&at, peer));
    if (is_right) {
        uint64_t *const mask = make_mask(at.count);
        generator order = {~UINT64_C(1)};
        measure(list, count, s->how, &order, mask, &taken);
        print_scene(&at, s->kernel, scores, list, count, &taken, ns);
        free(mask);
    }
    double_peer_free(peer);
    double_scene_free(&at);
    return is_right;
}

/*
 * What each triangle that the first stage leaves takes beyond those that it decides: the box normals of ordinary triangles, of the
 * first scene of these.
 */
static void run_stage(stage_scene which, const settings *s, double *ns)
{
    static samples taken;
    double_scene at[2];
    asked question[2];
    contestant list[2];
    tribox_report report = {0, 0};
    generator order = {~UINT64_C(1)};
    stage_scene_make(STAGE_NONE, &at[0]);
    stage_scene_make(which, &at[1]);
    for (int k = 0; k < 2; k++) {
        question[k] = (asked){&at[k], &at[k].nine, NULL};
        list[k] = (contestant){.name = "stage",
                               .run = run_doubles,
                               .question = &question[k],
                               .options = {.axes = k ? TRIBOX_AXES_ALL : TRIBOX_AXES_BOX, .kernel = s->kernel},
                               .pairs = (double)at[k].count};
    }
    uint64_t *const mask = make_mask(at[1].count);
    if (!list[1].run(&list[1], mask, &report))
        exit(message_failure("the library refuses a scene"));
    measure(list, 2, s->how, &order, mask, &taken);
    const double more = measure_spread(&taken, 1).least - measure_spread(&taken, 0).least;
    *ns = report.undecided ? more * (double)at[1].count / (double)report.undecided : 0;
    printf("%-26s %10zu %16.1f\n", stage_names[which], report.undecided, *ns);
    fflush(stdout);
    free(mask);
    double_scene_free(&at[0]);
    double_scene_free(&at[1]);
}

static void print_goals(const figures *f, const settings *s)
{
    enum { CACHE, WHOLE, OFFSET, MEMORY = 6 };
    const double *const cache = f->ns[CACHE], *const whole = f->ns[WHOLE], *const offset = f->ns[OFFSET],
                        *const memory = f->ns[MEMORY];
    const goal goals[] = {
        {"nine doubles, times nine floats, in the first caches", true, 1.6, cache[DOUBLE_NINE] / cache[FLOAT_NINE]},
        {"nine doubles, times nine floats, in the last cache", true, 1.6, whole[DOUBLE_NINE] / whole[FLOAT_NINE]},
        {"indexed doubles, times indexed floats, in the first caches", true, 1.6, cache[DOUBLE_INDEXED] / cache[FLOAT_INDEXED]},
        {"indexed doubles, times indexed floats, in the last cache", true, 1.6, whole[DOUBLE_INDEXED] / whole[FLOAT_INDEXED]},
        {"nine doubles far from the origin, times those near", true, 1.05, offset[DOUBLE_NINE] / whole[DOUBLE_NINE]},
        {"ns to settle a triangle in double", true, 40, f->stage[STAGE_DOUBLE]},
        {"ns to settle a triangle in integers", true, 500, f->stage[STAGE_SHORT]},
    };
    const goal beyond[] = {
        {"nine doubles, times reading them, beyond the caches", true, 1.15, memory[DOUBLE_NINE] / memory[READ_NINE]},
        {"indexed doubles, times reading them, beyond the caches", true, 1.15, memory[DOUBLE_INDEXED] / memory[READ_INDEXED]},
    };
    const goal peer = {"times the speed of CGAL's Epick", false, 50, whole[PEER] / whole[DOUBLE_NINE]};
    printf("\n%-62s %-8s %8s  %-11s %8s\n", "what is to be reached", "", "goal", "", "here");
    for (size_t k = 0; k < sizeof goals / sizeof goals[0]; k++)
        goal_print(&goals[k]);
    for (size_t k = 0; !s->is_quick && k < sizeof beyond / sizeof beyond[0]; k++)
        goal_print(&beyond[k]);
    if (whole[PEER] > 0)
        goal_print(&peer);
}

static const char usage[] = "Usage: doubles [--kernel NAME] [--quick] [--rounds N]\n"
                            "Times meshes of doubles, EXACT, against floats, reading and CGAL, on one thread.\n"
                            "  --kernel NAME  of the library; without it the best\n"
                            "  --quick        7 rounds at most, and nothing beyond the caches\n"
                            "  --rounds N     measure N rounds, 5 to 1000, however long they take\n";

enum { OPTION_KERNEL, OPTION_QUICK, OPTION_ROUNDS };

static const option_entry options[] = {[OPTION_KERNEL] = {"kernel", 'k', true},
                                       [OPTION_QUICK] = {"quick", 'q', false},
                                       [OPTION_ROUNDS] = {"rounds", 'r', true},
                                       {NULL, 0, false}};

static int take(void *request, int which, const char *value)
{
    settings *const s = request;
    uint64_t rounds;
    switch (which) {
    case OPTION_KERNEL:
        s->kernel = tribox_kernel_name(&(tribox_options){.kernel = value});
        return s->kernel ? EXIT_CODE_OK : message_usage("--kernel: there is no '%s' here; see tribox info", value);
    case OPTION_QUICK:
        s->how = (effort){.rounds = 7, .seconds = 1, .sample = 1e-3};
        s->is_quick = true;
        return EXIT_CODE_OK;
    case OPTION_ROUNDS:
        if (whole_read(value, "rounds", MEASURE_LEAST, MEASURE_MOST, &rounds))
            return EXIT_CODE_USAGE;
        s->how.rounds = (size_t)rounds;
        s->how.seconds = 1e9;
        return EXIT_CODE_OK;
    default:
        return message_usage("unexpected '%s'", value);
    }
}

int main(int argc, char **argv)
{
    static figures f;
    options_found found;
    settings s = {.kernel = tribox_kernel_name(NULL), .how = {.rounds = 51, .seconds = 8, .sample = 1e-3}};
    message_set_program("doubles");
    const int code = options_read(argc, argv, options, take, &s, &found);
    if (code)
        return code;
    if (found.wants_help)
        return fputs(usage, stdout) < 0;
    header_text(stdout, "", &(run){argc, argv, 1, machine_here()});
    for (size_t k = 0; k < DOUBLE_SCENES; k++)
        if (!(s.is_quick && double_scene_is_large(k)) && !run_scene(k, &s, f.ns[k]))
            return EXIT_CODE_FAILURE;
    printf("\n%-26s %10s %16s\n", "settled", "triangles", "ns a triangle");
    for (stage_scene which = STAGE_DOUBLE; which < STAGE_SCENES; which++)
        run_stage(which, &s, &f.stage[which]);
    print_goals(&f, &s);
    return EXIT_CODE_OK;
}
