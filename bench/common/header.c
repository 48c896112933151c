#include "header.h"

#include <string.h>

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
    fprintf(to, "%sflags      %s\n", mark, r->on.flags);
    fprintf(to, "%scommit     %s\n", mark, r->on.commit);
    fprintf(to, "%scommand   ", mark);
    for (int i = 0; i < r->argc; i++)
        fprintf(to, " %s", argument_of(r, i));
    fprintf(to, "\n%sseed       %llu\n", mark, (unsigned long long)r->seed);
    fprintf(to, "%slimits     one thread, not pinned; wall-clock time, no hardware counters; one process", mark);
    if (r->on.is_virtual)
        fprintf(to, "; a virtual machine, whose host may be shared");
    if (r->on.load >= 0)
        fprintf(to, "; load average %.2f before the start", r->on.load);
    fprintf(to, "\n");
}

void json_string(FILE *to, const char *text)
{
    putc('"', to);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            putc('\\', to);
        putc((unsigned char)*text < ' ' ? ' ' : *text, to);
    }
    putc('"', to);
}

void header_json(FILE *to, const run *r)
{
    fprintf(to, "\"processor\": ");
    json_string(to, r->on.processor);
    fprintf(to, ", \"virtual\": %s, \"load_average\": %.2f", r->on.is_virtual ? "true" : "false", r->on.load);
    fprintf(to, ",\n \"compiler\": ");
    json_string(to, r->on.compiler);
    fprintf(to, ", \"flags\": ");
    json_string(to, r->on.flags);
    fprintf(to, ", \"commit\": ");
    json_string(to, r->on.commit);
    fprintf(to, ",\n \"command\": [");
    for (int i = 0; i < r->argc; i++) {
        fprintf(to, i ? ", " : "");
        json_string(to, argument_of(r, i));
    }
    fprintf(to, "],\n \"seed\": %llu", (unsigned long long)r->seed);
}
