/* cmd_info.c - tribox info: what this library is and what this processor runs. */
#include "cmd.h"

#include <stdio.h>
#include <string.h>

#include "console/kernels.h"
#include "console/message.h"
#include "console/options.h"
#include "console/output.h"

static const char help[] = "tribox info - version, processor, and the kernels that it can run\n"
                           "\n"
                           "Usage: tribox info [--json]\n"
                           "\n"
                           "  --json    the same as a JSON object\n"
                           "  --help    this text\n"
                           "\n"
                           "A kernel is the test compiled for one instruction set. EXACT answers are the same with every\n"
                           "kernel; 'tribox overlap --kernel NAME' selects one.\n"
                           "\n"
                           "Exit codes: 0 success; 1 the output cannot be written; 2 wrong command line.\n"
                           "\n"
                           "Example:\n"
                           "  tribox info --json\n";

static const option options[] = {{"--json", false}, {NULL, false}};

/* The processor's model as Linux names it, "unknown" elsewhere. */
static void read_processor(char *name, size_t size)
{
    FILE *file = fopen("/proc/cpuinfo", "r");
    char line[256];
    snprintf(name, size, "unknown");
    while (file && fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) || !colon)
            continue;
        colon += strspn(colon, ": \t");
        snprintf(name, size, "%.*s", (int)strcspn(colon, "\n"), colon);
        break;
    }
    if (file)
        fclose(file);
}

static int print_json(const char *processor, const char *const *names, int count)
{
    printf("{\"version\": \"%s\", \"processor\": ", CMD_VERSION);
    output_json_string(processor);
    printf(", \"kernels\": [");
    for (int i = 0; i < count; i++)
        printf("%s\"%s\"", i ? ", " : "", names[i]);
    printf("], \"default_kernel\": \"%s\"}\n", tribox_kernel_name(NULL));
    return output_flush();
}

static int print_text(const char *processor, const char *const *names, int count)
{
    printf("version         %s\n", CMD_VERSION);
    printf("processor       %s\n", processor);
    printf("kernels        ");
    for (int i = 0; i < count; i++)
        printf(" %s", names[i]);
    printf("\ndefault kernel  %s\n", tribox_kernel_name(NULL));
    return output_flush();
}

static int take(void *request, int which, const char *value)
{
    bool *const wants_json = request;
    *wants_json = true;
    return which == ARGUMENT_OPERAND ? message_usage("'%s' is too much: info takes no file", value) : EXIT_CODE_OK;
}

int cmd_info(int count, char **words)
{
    bool wants_json = false;
    arguments walk = {.count = count, .next = words, .options = options};
    const int code = arguments_read(&walk, take, &wants_json);
    if (code)
        return code;
    if (walk.wants_help)
        return output_text(help);
    char processor[200];
    const char *names[KERNELS_MAX];
    read_processor(processor, sizeof processor);
    const int kernels = kernels_here(names);
    return wants_json ? print_json(processor, names, kernels) : print_text(processor, names, kernels);
}
