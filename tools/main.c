/* main.c - tribox: finds the command and hands it the other arguments. */
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "cmd.h"
#include "console/known_word.h"
#include "console/message.h"
#include "console/output.h"
#include "console/system.h"

/* The program never calls setlocale: numbers are read and written with a point everywhere. */

static const struct {
    const char *name;
    int (*run)(int count, char **words);
} commands[] = {{"overlap", cmd_overlap}, {"voxelize", cmd_voxelize}, {"partition", cmd_partition},
                {"merge", cmd_merge},     {"sweep", cmd_sweep},       {"info", cmd_info},
                {"demo", cmd_demo}};

static const char help[] = "tribox - which triangles of a mesh overlap a box, and which cells of a grid they touch\n"
                           "\n"
                           "Usage: tribox COMMAND [ARGUMENT...]\n"
                           "       tribox help [COMMAND]\n"
                           "       tribox --help | --version\n"
                           "\n"
                           "Commands:\n"
                           "  overlap    test the triangles of a mesh file against one box or many\n"
                           "  voxelize   write the cells of a grid that a mesh overlaps, as a file or a picture\n"
                           "  partition  sort the triangles of a mesh into tiles, for shards that read their own\n"
                           "  merge      join the parts of a voxelization that was done in shards\n"
                           "  sweep      find out which order of the axes is fastest for a mesh, and why\n"
                           "  info       version, processor, and the kernels that it can run\n"
                           "  demo       speed and answers on two built-in scenes; needs no file\n"
                           "\n"
                           "'tribox help COMMAND' describes a command; 'man tribox' has the details.\n"
                           "\n"
                           "Exit codes:\n"
                           "  0  success\n"
                           "  1  failure: a file, memory or the processor refused\n"
                           "  2  the command line is wrong\n"
                           "\n"
                           "Example:\n"
                           "  tribox overlap bunny.ply --box -0.05,0.05,-0.05,0.05,0.15,0.05\n"
                           "  tribox voxelize bunny.ply --resolution 256 -o bunny.npy --preview bunny.png --up y\n";

static int run_command(int count, char **words)
{
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        if (!strcmp(words[0], commands[i].name)) {
            message_set_command(words[0]);
            return commands[i].run(count, words);
        }
    if (!strcmp(words[0], "-V") || !strcmp(words[0], "version"))
        return message_usage("'%s' is written --version", words[0]);
    char text[GUESS_TEXT];
    const size_t dashes = strspn(words[0], "-");
    guess g = guess_at(words[0] + dashes, strlen(words[0] + dashes));
    if (dashes) {
        guess_try(&g, "help", 4);
        guess_try(&g, "version", 7);
        return message_usage("unknown option '%s'%s", words[0], guess_text(&g, "--", text));
    }
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        guess_try(&g, commands[i].name, strlen(commands[i].name));
    return message_usage("'%s' is not a command%s", words[0], guess_text(&g, "", text));
}

int main(int count, char **given)
{
    static char help_option[] = "--help";
    char **const words = terminal_begin(&count, given);
    if (count < 2)
        return message_usage("no command given");
    const bool is_help = !strcmp(words[1], "help");
    if (!strcmp(words[1], "--help") || !strcmp(words[1], "-h") || (is_help && count == 2))
        return output_text(help);
    if (!strcmp(words[1], "--version"))
        return output_text("tribox " CMD_VERSION "\n");
    return is_help ? run_command(2, (char *[]){words[2], help_option, NULL}) : run_command(count - 1, words + 1);
}
