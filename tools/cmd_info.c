/* cmd_info.c - tribox info: what this library is and what this processor runs. */
#include "cmd.h"

#include <stdio.h>

#include "console/json.h"
#include "console/message.h"
#include "console/options.h"
#include "console/output.h"
#include "console/system.h"
#include "write/volume.h"

static const char help[] = "tribox info - version, processor, and the kernels that it can run\n"
                           "\n"
                           "Usage: tribox info [--json]\n"
                           "\n"
                           "  -j, --json    print a JSON object\n"
                           "  -h, --help    print this text\n"
                           "\n"
                           "A kernel is the test compiled for one instruction set. EXACT answers are the same with every\n"
                           "kernel; 'tribox overlap --kernel NAME' selects one.\n"
                           "\n"
                           "Exit codes: 0 success; 1 the output cannot be written; 2 wrong command line.\n"
                           "\n"
                           "Example:\n"
                           "  tribox info --json\n";

typedef struct request {
    bool wants_json;
} request;

static const option_entry options[] = {{"json", 'j', OPTION_SETS(request, wants_json)}, {NULL, 0, false}};

/* What the manual page is made of, too. */
static void print_format(json *j, const volume_format *format)
{
    json_open_object(j, NULL);
    json_string(j, "word", format->word);
    json_string(j, "ending", format->ending);
    json_string(j, "kind", volume_kind(format));
    json_string(j, "about", format->about);
    json_string(j, "holds", format->holds);
    json_close(j);
}

static int print_json(const char *processor)
{
    json j = json_to(stdout);
    json_open_object(&j, NULL);
    json_string(&j, "version", CMD_VERSION);
    json_string(&j, "processor", processor);
    json_open_array(&j, "kernels");
    for (size_t i = 0; tribox_kernel_list(i); i++)
        json_string(&j, NULL, tribox_kernel_list(i));
    json_close(&j);
    json_string(&j, "default_kernel", tribox_kernel_name(NULL));
    json_open_array(&j, "positions");
    json_string(&j, NULL, "float32");
    json_string(&j, NULL, "float64");
    json_close(&j);
    json_open_rows(&j, "formats");
    for (size_t i = 0; volume_format_at(i); i++)
        print_format(&j, volume_format_at(i));
    json_close(&j);
    json_close(&j);
    return output_flush();
}

static int print_text(const char *processor)
{
    printf("version         %s\n", CMD_VERSION);
    printf("processor       %s\n", processor);
    printf("kernels        ");
    for (size_t i = 0; tribox_kernel_list(i); i++)
        printf(" %s", tribox_kernel_list(i));
    printf("\ndefault kernel  %s\n", tribox_kernel_name(NULL));
    printf("positions       float32, float64\nformats        ");
    for (size_t i = 0; volume_format_at(i); i++)
        printf(" %s", volume_format_at(i)->word);
    putchar('\n');
    return output_flush();
}

static int take(void *asked, int which, const char *value)
{
    (void)asked, (void)which;
    return message_usage("unexpected '%s': info takes no file", value);
}

static int answer(void *asked, const options_found *found)
{
    char processor[200];
    (void)found;
    processors_name(processor, sizeof processor);
    return ((const request *)asked)->wants_json ? print_json(processor) : print_text(processor);
}

int cmd_info(int count, char **words)
{
    return options_answer(&(options_command){help, options, take, answer}, count, words, &(request){.wants_json = false});
}
