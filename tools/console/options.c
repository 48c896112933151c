/* options.c - the arguments of a command, one by one, and the words that select a way of testing. */
#include "options.h"

#include <stddef.h>
#include <string.h>

#include "kernels.h"
#include "message.h"

static int find_option(const option *options, const char *argument, size_t length)
{
    for (int i = 0; options[i].name; i++)
        if (strlen(options[i].name) == length && !memcmp(options[i].name, argument, length))
            return i;
    return -1;
}

static char *pop(arguments *walk)
{
    walk->count--;
    return *walk->next++;
}

static int take_option(arguments *walk, const char *argument, const char **value)
{
    const char *equals = strchr(argument, '=');
    const int i = find_option(walk->options, argument, equals ? (size_t)(equals - argument) : strlen(argument));
    if (i < 0) {
        message_usage("unknown option '%s'", argument);
        return ARGUMENT_WRONG;
    }
    const option *found = &walk->options[i];
    const char *wrong = walk->seen & 1u << i                            ? "is given twice"
                        : equals && !found->takes_value                 ? "takes no value"
                        : found->takes_value && !equals && !walk->count ? "needs a value"
                                                                        : NULL;
    if (wrong) {
        message_usage("option %s %s", found->name, wrong);
        return ARGUMENT_WRONG;
    }
    walk->seen |= 1u << i;
    if (found->takes_value)
        *value = equals ? equals + 1 : pop(walk);
    return i;
}

int arguments_next(arguments *walk, const char **value)
{
    *value = NULL;
    if (walk->count && !walk->only_operands && !strcmp(*walk->next, "--")) {
        pop(walk);
        walk->only_operands = true;
    }
    if (!walk->count)
        return ARGUMENT_END;
    const char *argument = pop(walk);
    if (walk->only_operands || argument[0] != '-' || !argument[1]) {
        *value = argument;
        return ARGUMENT_OPERAND;
    }
    walk->wants_help = !strcmp(argument, "--help") || !strcmp(argument, "-h");
    return walk->wants_help ? ARGUMENT_HELP : take_option(walk, argument, value);
}

int arguments_read(arguments *walk, take_argument *take, void *request)
{
    const char *value;
    int which, code = EXIT_CODE_OK;
    while (!code && (which = arguments_next(walk, &value)) != ARGUMENT_END && which != ARGUMENT_HELP)
        code = which == ARGUMENT_WRONG ? EXIT_CODE_USAGE : take(request, which, value);
    return code;
}

int arguments_take_mesh(const char *operand, const char **mesh_path)
{
    if (*mesh_path)
        return message_usage("one mesh at a time: '%s' is one file too many", operand);
    *mesh_path = operand;
    return EXIT_CODE_OK;
}

static const struct {
    const char *word;
    tribox_accuracy accuracy;
} accuracies[] = {{"exact", TRIBOX_EXACT}, {"conservative", TRIBOX_CONSERVATIVE}, {"fast", TRIBOX_FAST}};

int options_read_accuracy(const char *text, tribox_accuracy *accuracy)
{
    for (size_t i = 0; i < sizeof accuracies / sizeof accuracies[0]; i++)
        if (!strcmp(text, accuracies[i].word)) {
            *accuracy = accuracies[i].accuracy;
            return EXIT_CODE_OK;
        }
    return message_usage("--accuracy: '%s' is none of exact, conservative, fast", text);
}

const char *options_accuracy_word(tribox_accuracy accuracy)
{
    size_t i = 0;
    while (accuracies[i].accuracy != accuracy)
        i++;
    return accuracies[i].word;
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

int options_read_axes(const char *text, unsigned *axes)
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

int options_read_order(const char *text, unsigned *order)
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

int options_read_kernel(const char *text, const char **kernel)
{
    for (int i = 0; i < KERNELS_MAX; i++)
        if (!strcmp(text, kernels_known[i])) {
            *kernel = kernels_known[i];
            return kernels_run_here(text)
                       ? EXIT_CODE_OK
                       : message_failure("--kernel: this processor cannot run %s; 'tribox info' lists what it can", text);
        }
    return message_usage("--kernel: '%s' is none of avx512, avx2, sse2, neon, scalar", text);
}

int options_read_test(const char *name, const char *value, tribox_options *test)
{
    if (!strcmp(name, "--accuracy"))
        return options_read_accuracy(value, &test->accuracy);
    if (!strcmp(name, "--axes"))
        return options_read_axes(value, &test->axes);
    if (!strcmp(name, "--order"))
        return options_read_order(value, &test->order);
    return options_read_kernel(value, &test->kernel);
}
