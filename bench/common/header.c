/* header.c - prints what a report begins with. */
#include "header.h"

#include <string.h>

#include "paper/paper.h"

/* An absolute path says nothing on another machine: its last part stands for it. */
static const char *argument_of(const run *r, int i)
{
    const char *const text = r->argv[i], *const slash = strrchr(text, '/');
    return text[0] == '/' && slash[1] ? slash + 1 : text;
}

void header_text(FILE *to, const char *mark, const run *r)
{
    fprintf(to, "%sprocessor  %s%s\n", mark, r->on.processor, r->on.is_virtual ? ", virtual" : "");
    fprintf(to, "%scompiler   %s\n", mark, r->on.compiler);
    fprintf(to, "%sflags      %s; baseline for: %s\n", mark, r->on.flags, paper_instruction_set());
    fprintf(to, "%scommit     %s\n", mark, r->on.commit);
    fprintf(to, "%scommand   ", mark);
    for (int i = 0; i < r->argc; i++)
        fprintf(to, " %s", argument_of(r, i));
    fprintf(to, "\n%sseed       %llu\n", mark, (unsigned long long)r->seed);
    fprintf(to, "%slimits     one thread, not pinned; processor time, no hardware counters; one process", mark);
    if (r->on.is_virtual)
        fprintf(to, "; a virtual machine, whose host may be shared");
    if (r->on.load >= 0)
        fprintf(to, "; load average %.2f before the start", r->on.load);
    fprintf(to, "\n");
}

void header_json(json *to, const run *r)
{
    json_string(to, "processor", r->on.processor);
    json_bool(to, "virtual", r->on.is_virtual);
    json_number(to, "load_average", 4, r->on.load);
    json_string(to, "compiler", r->on.compiler);
    json_string(to, "flags", r->on.flags);
    json_string(to, "instruction_set_of_baseline", paper_instruction_set());
    json_string(to, "commit", r->on.commit);
    json_open_array(to, "command");
    for (int i = 0; i < r->argc; i++)
        json_string(to, NULL, argument_of(r, i));
    json_close(to);
    json_whole(to, "seed", r->seed);
}
