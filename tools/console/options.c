/* options.c - the words that select a way of testing, and what else commands share. */
#include "options.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "message.h"
#include "output.h"
#include "progress.h"

int options_answer(const options_command *of, int count, char **words, void *request)
{
    options_found found;
    const int code = options_read(count, words, of->table, of->take, request, &found);
    for (int i = 0; !code && of->table[i].name; i++)
        if (options_has(&found, i) && !strcmp(of->table[i].name, "quiet"))
            progress_silence();
    return code ? code : found.wants_help ? output_text(of->help) : of->answer(request, &found);
}

int options_take_mesh(const char *operand, const char **mesh_path)
{
    if (*mesh_path)
        return message_usage("one mesh at a time: '%s' is one file too many", operand);
    *mesh_path = operand;
    return EXIT_CODE_OK;
}

static int read_accuracy(const char *text, tribox_accuracy *accuracy)
{
    return accuracy_of_word(text, accuracy) ? EXIT_CODE_OK
                                            : message_usage("--accuracy: '%s' is none of exact, conservative, fast", text);
}

static const struct {
    const char *word;
    unsigned bit;
} axes_groups[OPTIONS_AXES_GROUPS] = {{"box", TRIBOX_AXES_BOX}, {"plane", TRIBOX_AXES_PLANE}, {"edges", TRIBOX_AXES_EDGES}};

const char *options_axes_word(int i, unsigned *bit)
{
    *bit = axes_groups[i].bit;
    return axes_groups[i].word;
}

static unsigned find_axes(const char *word, size_t length)
{
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++)
        if (strlen(axes_groups[i].word) == length && !memcmp(axes_groups[i].word, word, length))
            return axes_groups[i].bit;
    return 0;
}

static int read_axes(const char *text, unsigned *axes)
{
    *axes = 0;
    for (const char *word = text;; word++) {
        const size_t length = strcspn(word, ",");
        const unsigned bit = find_axes(word, length);
        if (!bit)
            return message_usage("--axes: '%.*s' is none of box, plane, edges", (int)length, word);
        *axes |= bit;
        word += length;
        if (!*word)
            return EXIT_CODE_OK;
    }
}

static int read_order(const char *text, unsigned *order)
{
    static const struct {
        const char *word;
        unsigned order;
    } orders[] = {{"123", 123}, {"132", 132}, {"213", 213}, {"231", 231}, {"312", 312}, {"321", 321}};
    for (size_t i = 0; i < sizeof orders / sizeof orders[0]; i++)
        if (!strcmp(text, orders[i].word)) {
            *order = orders[i].order;
            return EXIT_CODE_OK;
        }
    return message_usage("--order: '%s' is none of 123, 132, 213, 231, 312, 321", text);
}

static int read_kernel(const char *text, const char **kernel)
{
    char list[128] = "";
    for (size_t i = 0; (*kernel = tribox_kernel_list(i)) != NULL; i++) {
        if (!strcmp(text, *kernel))
            return EXIT_CODE_OK;
        const size_t length = strlen(list);
        snprintf(list + length, sizeof list - length, "%s%s", i ? ", " : "", *kernel);
    }
    return message_usage("--kernel: '%s' does not run here; choose one of %s", text, list);
}

int options_read_test(const char *name, const char *value, tribox_options *test)
{
    if (!strcmp(name, "accuracy"))
        return read_accuracy(value, &test->accuracy);
    if (!strcmp(name, "axes"))
        return read_axes(value, &test->axes);
    if (!strcmp(name, "order"))
        return read_order(value, &test->axis_order);
    return read_kernel(value, &test->kernel);
}
