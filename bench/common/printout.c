/* printout.c - prints what was measured, and on what. */
#include "printout.h"

#include <stdarg.h>
#include <string.h>

#include "build.h"
#include "commit.h"
#include "console/system.h"
#include "paper/paper.h"

enum { LINE = PRINTOUT_LINE };

/* Processes that wanted to run in the last minute; negative if unknown. */
static double read_load(void)
{
    double load = -1;
    FILE *const file = fopen("/proc/loadavg", "r");
    if (file && fscanf(file, "%lf", &load) != 1)
        load = -1;
    if (file)
        fclose(file);
    return load;
}

/* An absolute path says nothing on another machine: its last part stands for it. */
void printout_keep_command(printout *r, int argc, char **argv)
{
    char *const line = r->command;
    line[0] = 0;
    for (int i = 0; i < argc; i++) {
        const char *const slash = strrchr(argv[i], '/');
        const size_t length = strlen(line);
        snprintf(line + length, LINE - length, "%s%s", i ? " " : "", argv[i][0] == '/' && slash[1] ? slash + 1 : argv[i]);
    }
}

static void tell(printout *r, const char *name, const char *value)
{
    if (r->is_json)
        json_string(&r->to, name, value);
    else
        printf("%-10s %s\n", name, value);
    if (r->csv)
        fprintf(r->csv, "# %-10s %s\n", name, value);
}

void printout_begin(printout *r, uint64_t seed, const char *kernel)
{
    char line[LINE];
    processors_name(line, sizeof line);
    const bool is_virtual = strstr(line, ", virtual");
    r->to = json_to(stdout);
    if (r->is_json)
        json_open_object(&r->to, NULL);
    tell(r, "processor", line);
    tell(r, "compiler", BENCH_COMPILER);
    snprintf(line, sizeof line, "%s; baseline for: %s", BENCH_FLAGS, paper_instruction_set());
    tell(r, "flags", line);
    tell(r, "commit", BENCH_COMMIT);
    tell(r, "command", r->command);
    snprintf(line, sizeof line, "%llu", (unsigned long long)seed);
    tell(r, "seed", line);
    tell(r, "kernel", kernel);
    snprintf(line, sizeof line,
             "one thread, not pinned; processor time, no hardware counters; load average %.2f before the start%s", read_load(),
             is_virtual ? "; a virtual machine, whose host may be shared" : "");
    tell(r, "limits", line);
    if (r->is_json)
        json_open_rows(&r->to, "tables");
}

static void close_table(printout *r)
{
    if (r->is_json && r->is_table_open) {
        json_close(&r->to);
        json_close(&r->to);
    }
    r->is_table_open = r->has_rows = false;
}

void printout_end(printout *r)
{
    close_table(r);
    if (r->is_json) {
        json_close(&r->to);
        json_close(&r->to);
    }
}

void printout_table(printout *r, const char *title, ...)
{
    char line[LINE];
    va_list values;
    va_start(values, title);
    vsnprintf(line, sizeof line, title, values);
    va_end(values);
    close_table(r);
    r->is_table_open = true;
    if (r->is_json) {
        json_open_object(&r->to, NULL);
        json_string(&r->to, "title", line);
        json_open_rows(&r->to, "rows");
    } else
        printf("\n%s\n", line);
}

void printout_add(printout *r, const printout_column *columns)
{
    for (; columns->name && r->columns < PRINTOUT_COLUMNS; columns++)
        r->row[r->columns++] = *columns;
}

void printout_times(printout *r, const samples *taken, size_t c)
{
    const spread ns = measure_spread(taken, c);
    ADD(r, NUMBER("ns_median", 3, ns.median), NUMBER("ns_least", 3, ns.least), DATA("ns_lower_quartile", ns.lower_quartile),
        DATA("ns_upper_quartile", ns.upper_quartile), DATA("rounds", taken->rounds));
}

/* Text is on the left of its column, the first one wide enough for names. */
static int width_of(const printout_column *c, bool is_first)
{
    const int least = !c->text ? 9 : is_first ? 24 : 12, length = (int)strlen(c->name);
    return length > least ? length : least;
}

static void print_text(const printout *r, bool is_head)
{
    bool is_first = true;
    for (size_t k = 0; k < r->columns; k++) {
        const printout_column *const c = &r->row[k];
        char text[LINE];
        if (c->is_data)
            continue;
        snprintf(text, sizeof text, "%s", is_head ? c->name : c->text ? c->text : "-");
        for (char *at = text; is_head && *at; at++)
            *at = (char)(*at == '_' ? ' ' : *at);
        if (!is_head && !c->text && !isnan(c->number))
            snprintf(text, sizeof text, "%.*f", c->decimals, c->number);
        const int width = k + 1 < r->columns || !c->text ? width_of(c, is_first) : 0;
        printf("%s%*s", is_first ? "" : "  ", c->text ? -width : width, text);
        is_first = false;
    }
    printf("\n");
}

static void print_json(printout *r)
{
    json_open_object(&r->to, NULL);
    for (size_t k = 0; k < r->columns; k++)
        if (r->row[k].text)
            json_string(&r->to, r->row[k].name, r->row[k].text);
        else
            json_number(&r->to, r->row[k].name, r->row[k].decimals ? 7 : 15, r->row[k].number);
    json_close(&r->to);
}

/* Names of columns are in the file where they are others than before. */
static void print_csv(printout *r)
{
    char head[sizeof r->csv_head] = "";
    for (size_t k = 0; k < r->columns; k++) {
        const size_t length = strlen(head);
        snprintf(head + length, sizeof head - length, "%s%s", k ? "," : "", r->row[k].name);
    }
    if (strcmp(head, r->csv_head) != 0)
        fprintf(r->csv, "%s\n", head);
    memcpy(r->csv_head, head, sizeof head);
    for (size_t k = 0; k < r->columns; k++)
        if (r->row[k].text || isnan(r->row[k].number))
            fprintf(r->csv, "%s%s", k ? "," : "", r->row[k].text ? r->row[k].text : "");
        else
            fprintf(r->csv, "%s%.*g", k ? "," : "", r->row[k].decimals ? 7 : 15, r->row[k].number);
    fprintf(r->csv, "\n");
}

void printout_row(printout *r)
{
    if (r->csv)
        print_csv(r);
    if (r->is_json)
        print_json(r);
    else if (!r->has_rows)
        print_text(r, true);
    if (!r->is_json)
        print_text(r, false);
    fflush(stdout);
    r->has_rows = true;
    r->columns = 0;
}

void printout_note(printout *r, const char *text, ...)
{
    char line[LINE];
    va_list values;
    va_start(values, text);
    vsnprintf(line, sizeof line, text, values);
    va_end(values);
    if (!r->is_json) {
        printf("%s\n", line);
        return;
    }
    close_table(r);
    json_open_object(&r->to, NULL);
    json_string(&r->to, "note", line);
    json_close(&r->to);
}

void printout_disturbed(printout *r, const samples *taken)
{
    const size_t disturbed = measure_disturbed(taken);
    if (disturbed)
        printout_note(r,
                      "disturbed: %zu of %zu have a median more than 10 %% above their least; trust the least times, or run again",
                      disturbed, taken->contestants);
}
