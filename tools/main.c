/* main.c - tribox: finds the command and hands it the other arguments. */
#include <stddef.h>
#include <string.h>

#include "cmd.h"
#include "console/message.h"
#include "console/output.h"

/* The program never calls setlocale: numbers are read and written with a point everywhere. */

static const struct {
    const char *name;
    int (*run)(int count, char **arguments);
} commands[] = {{"overlap", cmd_overlap}, {"voxelize", cmd_voxelize}, {"merge", cmd_merge},
                {"sweep", cmd_sweep},     {"info", cmd_info},         {"demo", cmd_demo}};

static const char help[] = "tribox - which triangles of a mesh overlap an axis-aligned box, and which cells of a grid?\n"
                           "\n"
                           "Usage: tribox COMMAND [ARGUMENT...]\n"
                           "       tribox --help | --version\n"
                           "\n"
                           "Commands:\n"
                           "  overlap    test the triangles of a mesh file against one box or many\n"
                           "  voxelize   the cells of a grid that a mesh overlaps, as a file and a picture\n"
                           "  merge      join the parts of a voxelization that was done in shards\n"
                           "  sweep      which order of the axes is the fastest for a mesh, and why\n"
                           "  info       version, processor, and the kernels that it can run\n"
                           "  demo       speed and answers on two built-in scenes; needs no file\n"
                           "\n"
                           "'tribox COMMAND --help' tells all about a command.\n"
                           "\n"
                           "Exit codes:\n"
                           "  0  success\n"
                           "  1  failure: a file, memory or the processor refused\n"
                           "  2  the command line is wrong\n"
                           "\n"
                           "Example:\n"
                           "  tribox overlap bunny.ply --box -0.05,0.05,-0.05,0.05,0.15,0.05\n"
                           "  tribox voxelize bunny.ply --resolution 256 -o bunny.npy --preview bunny.png --up y\n";

int main(int argc, char **argv)
{
    const char *word = argc > 1 ? argv[1] : NULL;
    if (!word)
        return message_usage("no command given");
    if (!strcmp(word, "--help") || !strcmp(word, "-h"))
        return output_text(help);
    if (!strcmp(word, "--version"))
        return output_text("tribox " CMD_VERSION "\n");
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        if (!strcmp(word, commands[i].name)) {
            message_set_command(word);
            return commands[i].run(argc - 2, argv + 2);
        }
    return message_usage(word[0] == '-' ? "unknown option '%s'" : "'%s' is not a command", word);
}
