/* comparison.c - times a scene of tribox demo, and prints what came of it. */
#include "comparison.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/terminal.h"
#include "paper/paper.h"

/* Of the rows of meshes those of the two widest kernels: the table is to fit a screen. */
static size_t enter(const timing_work *work, contestant *list)
{
    contestant all[CONTESTANTS_MAX];
    const size_t entered = contestants_enter(work, all);
    size_t count = 0, meshes = 0;
    list[count++] = contestant_paper(work, PAPER_ORDER);
    for (size_t c = 0; c < entered; c++)
        if (!strstr(all[c].name, "-mesh") || meshes++ < 2)
            list[count++] = all[c];
    return count;
}

int comparison_make(const scene *at, size_t rounds, comparison *c)
{
    char wrong[VERIFY_TEXT];
    const truth from = truth_of_work(&at->work);
    generator order = {SCENE_SEED};
    c->at = at;
    c->count = enter(&at->work, c->list);
    if (!verify(c->list, c->count, &from, c->scores, wrong))
        return message_failure("%s; nothing is timed", wrong);
    uint64_t *const mask = malloc(at->work.words * sizeof *mask);
    if (!mask)
        return message_failure("out of memory for the answers");
    measure(c->list, c->count, (effort){.rounds = rounds, .seconds = 1e9, .sample = 2e-3}, &order, mask, &c->taken);
    free(mask);
    return EXIT_CODE_OK;
}

/* How many times as fast as the paper's test. */
static double speed_of(const comparison *c, size_t i) { return measure_ratio(&c->taken, 0, i).median; }

static const char *kernel_of(const contestant *one) { return one->options.kernel ? one->options.kernel : one->name; }

/* The last word of its name; a mesh is answered exactly. */
static const char *accuracy_of(const contestant *one) { return one->options.kernel ? strchr(one->name, '-') + 1 : "-"; }

static bool is_bold_wanted(void)
{
    const char *terminal = getenv("TERM");
    return terminal_is(stdout) && !getenv("NO_COLOR") && terminal && strcmp(terminal, "dumb");
}

static void print_bold(const char *text)
{
    const bool is_bold = is_bold_wanted();
    printf("%s%s%s\n", is_bold ? "\x1b[1m" : "", text, is_bold ? "\x1b[0m" : "");
}

/* The accuracy that has no errors is the last of a kernel. */
static size_t overlapping(const comparison *c) { return c->scores[c->count - 1].overlapping; }

void comparison_print(const comparison c[2])
{
    static const int width[2] = {34, 0};
    printf("%22s", "");
    for (int s = 0; s < 2; s++)
        printf("    %-*s", width[s], c[s].at->title);
    printf("\n%22s", "");
    for (int s = 0; s < 2; s++) {
        char counts[64];
        snprintf(counts, sizeof counts, "%zu, %zu overlap", c[s].at->work.pairs, overlapping(&c[s]));
        printf("    %-*s", width[s], counts);
    }
    printf("\n");
    print_bold("kernel    accuracy        ns/triangle  x paper  unlike exact    ns/triangle  x paper  unlike exact");
    for (size_t i = 0; i < c->count; i++) {
        printf("%-8s  %-12s", kernel_of(&c->list[i]), accuracy_of(&c->list[i]));
        for (int s = 0; s < 2; s++)
            printf("    %11.2f %8.2f %13zu", measure_spread(&c[s].taken, i).median, speed_of(&c[s], i),
                   score_unlike(&c[s].scores[i]));
        putchar('\n');
    }
}

static void print_json_row(json *to, const comparison *c, size_t i)
{
    const double ns = measure_spread(&c->taken, i).median;
    json_open_object(to, NULL);
    json_string(to, "kernel", kernel_of(&c->list[i]));
    json_string(to, "accuracy", c->list[i].options.kernel ? accuracy_of(&c->list[i]) : NULL);
    json_number(to, "ns_per_triangle", 6, ns);
    json_number(to, "million_triangles_per_second", 6, 1e3 / ns);
    json_number(to, "times_paper", 6, speed_of(c, i));
    json_whole(to, "overlapping", c->scores[i].overlapping);
    json_whole(to, "unlike_exact", score_unlike(&c->scores[i]));
    json_close(to);
}

void comparison_print_json(json *to, const comparison *c)
{
    const tribox_box *const box = &c->at->work.jobs[0].box;
    json_open_object(to, NULL);
    json_string(to, "title", c->at->title);
    json_whole(to, "triangles", c->at->work.pairs);
    json_open_object(to, "box");
    json_doubles(to, "lo", box->lo, 3, true);
    json_doubles(to, "hi", box->hi, 3, true);
    json_close(to);
    json_open_rows(to, "rows");
    for (size_t i = 0; i < c->count; i++)
        print_json_row(to, c, i);
    json_close(to);
    json_close(to);
}
