/* cmd_merge.c - tribox merge: the parts that tribox voxelize --shard wrote become the whole, bit for bit. */
#include "cmd.h"

#include <stdlib.h>

#include "console/message.h"
#include "console/numbers.h"
#include "console/options.h"
#include "console/output.h"
#include "console/processors.h"
#include "merge/merge_work.h"

static const char help[] =
    "tribox merge - join the parts of a voxelization into one file\n"
    "\n"
    "Usage: tribox merge PART... -o FILE [OPTION...]\n"
    "\n"
    "PART... are the .npz files of 'tribox voxelize --shard I/N' for all shards, in any order. The\n"
    "result is that of a voxelization in one piece, bit for bit. If FILE is sparse, little memory is\n"
    "needed. For .npz without --deflate threads read several parts at once.\n"
    "\n" RESULT_HELP "  -t, --threads T         1 to 256; default: one for each processor. The file is the same\n" OPTIONS_HELP_HELP
    "\n"
    "Exit codes: 0 success; 1 failure (a file, parts that do not fit together); 2 wrong command line.\n"
    "\n"
    "Example:\n"
    "  tribox merge big.*.npz -o big.npz\n";

enum { OPTION_THREADS = RESULT_END };

static const option_entry options[] = {RESULT_ENTRIES, [OPTION_THREADS] = {"threads", 't', true}, {NULL, 0, false}};

static int take(void *context, int which, const char *value)
{
    merge_request *const r = context;
    if (which == OPTION_THREADS)
        return numbers_read_whole(value, "--threads", THREADS_MAX, &r->threads);
    if (which != OPTION_OPERAND)
        return result_take(&r->result, which, value);
    r->parts[r->count++] = value;
    return EXIT_CODE_OK;
}

static int check_request(merge_request *r, const options_found *found)
{
    if (!r->count)
        return message_usage("no parts given");
    if (!r->result.out_path)
        return message_usage("no output given; give -o FILE");
    return result_check(&r->result, found, "part", r->parts, r->count);
}

int cmd_merge(int count, char **words)
{
    merge_request r = {
        .parts = malloc((size_t)(count + 1) * sizeof *r.parts), .threads = processors_here(), .result.look = PREVIEW_LOOK_DEFAULT};
    if (!r.parts)
        return message_failure("out of memory for %d arguments", count);
    options_found found;
    int code = options_read(count, words, options, take, &r, &found);
    if (!code && found.wants_help)
        code = output_text(help);
    else if (!code)
        code = check_request(&r, &found);
    if (!code && !found.wants_help)
        code = merge_work(&r);
    free(r.parts);
    return code;
}
