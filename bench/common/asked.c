/* asked.c - reads command lines and the meshes that they name, says what may stand in them, and times contestants. */
#include "asked.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "console/option_reader.h"
#include "files/files.h"
#include "read/mesh.h"
#include "read/scan.h"
#include "soups.h"

enum { FOR_ALL = 1u << OPTION_ROUNDS | 1u << OPTION_SEED | 1u << OPTION_JSON | 1u << OPTION_CSV };

#define OPTION_ROW(option, ...) {__VA_ARGS__},
static const struct {
    const char *name, *value, *what;
    uint64_t least, most;
} table[OPTIONS] = {ASKED_OPTIONS(OPTION_ROW)};

enum { PATH_ROOM = 4096 };

static const char *find(const char *path, char whole[PATH_ROOM])
{
    const char *const folder = strchr(path, '/') ? NULL : getenv("TRIBOX_MESHES");
    snprintf(whole, PATH_ROOM, "%s%s%s", folder ? folder : "", folder ? "/" : "", path);
    return whole;
}

bool mesh_list_read(const char *path, mesh *m)
{
    char whole[PATH_ROOM];
    return mesh_read(find(path, whole), m) == EXIT_CODE_OK;
}

/* In place: number i of the floats ends before number i + 1 of the doubles begins. */
static void narrow(const indexed_mesh *m)
{
    unsigned char *const bytes = m->positions.of;
    for (size_t i = 0; m->position_bytes == sizeof(double) && i < 3 * m->positions.count; i++) {
        double number;
        memcpy(&number, bytes + i * sizeof number, sizeof number);
        const float nearest = (float)number;
        memcpy(bytes + i * sizeof nearest, &nearest, sizeof nearest);
    }
}

bool mesh_list_read_indexed(const char *path, indexed_mesh *m)
{
    char whole[PATH_ROOM];
    whole_file file;
    const mesh_kind kind = mesh_kind_of(find(path, whole));
    *m = (indexed_mesh){.position_bytes = 0};
    if (kind == MESH_STL_TEXT || kind == MESH_OTHER)
        return message_failure("%s: not read: a PLY, OFF or OBJ file is wanted, which has indices", path) == EXIT_CODE_OK;
    const bool is_read = !whole_file_read(whole, kind, &file) && !scan_read(whole, kind, &file, m);
    whole_file_free(&file);
    if (!is_read)
        return false;
    if (!indexed_mesh_cut(1, m) || !m->corners.count || (m->position_bytes == sizeof(double) && m->fit == FLOAT_FIT_NONE))
        return message_failure("%s: no triangles of floats", path) == EXIT_CODE_OK;
    narrow(m);
    return true;
}

static int whole_read(const char *text, asked_option o, uint64_t *number)
{
    char *end;
    errno = 0;
    const unsigned long long read = strtoull(text, &end, 0);
    if (text[0] < '0' || text[0] > '9' || *end || errno || read < table[o].least || read > table[o].most)
        return message_usage("--%s: '%s' is not a whole number from %" PRIu64 " to %" PRIu64, table[o].name, text, table[o].least,
                             table[o].most);
    *number = read;
    return EXIT_CODE_OK;
}

/* Numbers with commas between them. */
int asked_cells(asked *q, const char *value)
{
    for (q->cell_counts = 0; q->cell_counts < ASKED_CELLS; value++) {
        const size_t length = strcspn(value, ",");
        char number[16];
        uint64_t cells = 0;
        snprintf(number, sizeof number, "%.*s", (int)length, value);
        if (whole_read(number, OPTION_CELLS, &cells))
            return EXIT_CODE_USAGE;
        q->cells[q->cell_counts++] = (uint32_t)cells;
        value += length;
        if (!*value)
            return EXIT_CODE_OK;
    }
    return message_usage("--cells: give %d at most", ASKED_CELLS);
}

static int take(void *into, int which, const char *value)
{
    asked *const q = into;
    if (which == OPTION_OPERAND)
        return q->of->takes_meshes ? EXIT_CODE_OK : message_usage("unexpected '%s'", value);
    if (!((FOR_ALL | q->of->options) >> which & 1))
        return message_usage("unknown option '--%s'", table[which].name);
    q->given |= UINT64_C(1) << which;
    q->number[which] = 1;
    q->text[which] = value;
    if (which == OPTION_CELLS)
        return asked_cells(q, value);
    if (which == OPTION_KERNEL) {
        q->kernel = tribox_kernel_name(&(tribox_options){.kernel = value});
        return q->kernel ? EXIT_CODE_OK : message_usage("--kernel: there is no '%s' here; see tribox info", value);
    }
    if (which == OPTION_SCENE)
        return scene_is_known(value) ? EXIT_CODE_OK : EXIT_CODE_USAGE;
    return table[which].most ? whole_read(value, (asked_option)which, &q->number[which]) : EXIT_CODE_OK;
}

static void print_option(const bench_question *of, asked_option o)
{
    char option[32];
    if (!((FOR_ALL | of->options) >> o & 1))
        return;
    snprintf(option, sizeof option, "--%s %s", table[o].name, table[o].value ? table[o].value : "");
    printf("  %-16s %s\n", option, table[o].what);
}

static int print_help(const char *program, const bench_question *of)
{
    printf("Usage: %s %s [OPTION...]%s\n%s\n", program, of->name,
           of->needs_meshes   ? " MESH..."
           : of->takes_meshes ? " [MESH...]"
                              : "",
           of->asks);
    for (asked_option o = OPTION_ROUNDS; o < OPTIONS; o++)
        print_option(of, o);
    if (of->takes_meshes)
        printf("  MESH             a PLY, OFF, OBJ or STL file; $TRIBOX_MESHES may name a folder to look in\n");
    return ferror(stdout) != 0;
}

static int print_questions(const char *program, const bench_question *const *questions, size_t count)
{
    printf("Usage: %s QUESTION [OPTION...] [MESH...]\n'%s QUESTION --help' says more.\n", program, program);
    for (size_t k = 0; k < count; k++)
        printf("  %-10s %s\n", questions[k]->name, questions[k]->asks);
    return ferror(stdout) != 0;
}

static int answer(const bench_question *of, asked *q)
{
    const char *const csv = q->text[OPTION_CSV];
    q->out.is_json = asked_has(q, OPTION_JSON);
    q->out.csv = csv ? fopen(csv, "w") : NULL;
    if (csv && !q->out.csv)
        return message_failure("cannot write '%s'; does its folder exist?", csv);
    printout_begin(&q->out, q->seed, q->kernel);
    const bool is_right = of->answer(q);
    printout_end(&q->out);
    const bool is_lost = csv && ferror(q->out.csv), is_closed = !csv || !fclose(q->out.csv);
    if (is_lost || !is_closed || fflush(stdout) || ferror(stdout))
        return message_failure("the output is not complete; is the disk full?");
    return is_right ? EXIT_CODE_OK : EXIT_CODE_FAILURE;
}

static const bench_question *named(const bench_question *const *questions, size_t count, const char *name)
{
    for (size_t k = 0; name && k < count; k++)
        if (!strcmp(name, questions[k]->name))
            return questions[k];
    return NULL;
}

int asked_main(int argc, char **argv, const bench_question *const *questions, size_t count, asked *q)
{
    const char *const program = argv[0] + named_file_folder(argv[0]);
    const int skipped = count > 1;
    const bench_question *const of = skipped ? named(questions, count, argc > 1 ? argv[1] : NULL) : questions[0];
    option_entry options[OPTIONS + 1] = {{NULL, 0, false}};
    options_found found;
    message_set_program(program);
    if (!of && (argc < 2 || !strcmp(argv[1], "--help") || !strcmp(argv[1], "-h")))
        return print_questions(program, questions, count);
    if (!of)
        return message_usage("there is no question '%s'", argv[1]);
    for (int o = 0; o < OPTIONS; o++)
        options[o] = (option_entry){table[o].name, 0, table[o].value != NULL};
    q->of = of;
    q->kernel = tribox_kernel_name(NULL);
    printout_keep_command(&q->out, argc, argv);
    const int code = options_read(argc - skipped, argv + skipped, options, take, q, &found);
    if (code)
        return code;
    if (found.wants_help)
        return print_help(program, of);
    q->meshes = (mesh_list){found.operands, found.count};
    if (of->needs_meshes && !found.count)
        return message_usage("name a mesh file");
    q->seed = asked_number(q, OPTION_SEED, 1);
    q->order = (generator){~q->seed};
    return answer(of, q);
}

uint64_t asked_number(const asked *q, asked_option option, uint64_t otherwise)
{
    return asked_has(q, option) ? q->number[option] : otherwise;
}

effort asked_effort(const asked *q, size_t rounds, double seconds, double sample)
{
    if (asked_has(q, OPTION_ROUNDS))
        return (effort){.rounds = (size_t)q->number[OPTION_ROUNDS], .seconds = 1e9, .sample = sample};
    return asked_has(q, OPTION_QUICK) ? (effort){.rounds = MEASURE_LEAST, .seconds = 0, .sample = sample / 2}
                                      : (effort){.rounds = rounds, .seconds = seconds, .sample = sample};
}

bool asked_verify(asked *q, const char *name, const contestant *list, size_t count, const truth *from)
{
    char wrong[VERIFY_TEXT];
    const bool is_right = verify(list, count, from, q->scores, wrong);
    if (!is_right)
        message_say("scene %s: %s; nothing is timed", name, wrong);
    return is_right;
}

bool asked_measure(asked *q, const char *name, const contestant *list, size_t count, const truth *from, effort how,
                   size_t mask_words)
{
    if (from && !asked_verify(q, name, list, count, from))
        return false;
    return measure(list, count, how, &q->order, mask_words, &q->taken) ||
           message_failure("out of memory for answers") == EXIT_CODE_OK;
}

/* Each block begins with a cache line that knows the one before. */
static void *last;

void *asked_allocate(size_t count, size_t size)
{
    const size_t bytes = (count * size + 63) / 64 * 64 + 128;
    char *const memory = aligned_alloc(64, bytes);
    if (!memory)
        exit(message_failure("out of memory for %zu bytes", bytes));
    memset(memory, 0, bytes);
    *(void **)(void *)memory = last;
    last = memory;
    return memory + 64;
}

void *asked_mark(void) { return last; }

void asked_release(void *mark)
{
    while (last != mark) {
        void *const before = *(void **)last;
        free(last);
        last = before;
    }
}
