/* options.c - the words that select a way of testing, and what else commands share. */
#include "options.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "known_word.h"
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

int options_refuse_file(const char *operand)
{
    const bool is_number = !operand[strspn(operand, "+-.,0123456789")];
    return message_usage("one mesh at a time: '%s' is one file too many%s", operand,
                         is_number ? "; the numbers of an option have commas, or blanks in quotes, between them" : "");
}

int options_take_mesh(const char *operand, const char **mesh_path)
{
    if (*mesh_path)
        return options_refuse_file(operand);
    *mesh_path = operand;
    return EXIT_CODE_OK;
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

static int read_axes(const char *text, unsigned *axes)
{
    *axes = 0;
    for (const char *word = text;; word++) {
        const size_t length = strcspn(word, ",");
        unsigned n;
        if (choice_read("--axes", word, length, "box plane edges", NULL, &n))
            return EXIT_CODE_USAGE;
        *axes |= axes_groups[n].bit;
        word += length;
        if (!*word)
            return EXIT_CODE_OK;
    }
}

static int read_accuracy(const char *text, tribox_accuracy *accuracy)
{
    static const tribox_accuracy accuracies[] = {TRIBOX_EXACT, TRIBOX_CONSERVATIVE, TRIBOX_FAST};
    unsigned n;
    const int code = choice_read("--accuracy", text, strlen(text), "exact conservative fast", NULL, &n);
    if (!code)
        *accuracy = accuracies[n];
    return code;
}

static int read_order(const char *text, unsigned *order)
{
    static const unsigned orders[] = {123, 132, 213, 231, 312, 321};
    unsigned n;
    const int code = choice_read("--order", text, strlen(text), "123 132 213 231 312 321", NULL, &n);
    if (!code)
        *order = orders[n];
    return code;
}

static int read_kernel(const char *text, const char **kernel)
{
    char list[128] = "";
    unsigned n;
    for (size_t i = 0; tribox_kernel_list(i); i++) {
        const size_t length = strlen(list);
        snprintf(list + length, sizeof list - length, "%s%s", i ? " " : "", tribox_kernel_list(i));
    }
    const int code = choice_read("--kernel", text, strlen(text), list, " (what runs here)", &n);
    if (!code)
        *kernel = tribox_kernel_list(n);
    return code;
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
