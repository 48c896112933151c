/* option_reader.c - makes getopt_long's tables from ours, and its errors into lines that name the word. */
#include "option_reader.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>

#include "known_word.h"
#include "message.h"
#include "numbers.h"
#include "system.h"

static bool has_value(const option_entry *entry) { return entry->takes % 2; }

/* getopt_long returns FIRST + i for the long form of option i, its letter for the short one, and OPERAND. */
enum { TABLE_MAX = 64, NAME_MAX_BYTES = 32, OPERAND = 1, FIRST = 256 };

typedef struct getopt_tables {
    char letters[2 * TABLE_MAX + 4];
    struct option names[2 * TABLE_MAX + 2];
    char respelled[TABLE_MAX][NAME_MAX_BYTES];
} getopt_tables;

/* "colors" of "colours": whoever writes so means the same. */
static const char *respell(const char *name, char to[NAME_MAX_BYTES])
{
    const char *const colour = strstr(name, "colour");
    if (!colour || strlen(name) >= NAME_MAX_BYTES)
        return NULL;
    snprintf(to, NAME_MAX_BYTES, "%.*s%s", (int)(colour + 4 - name), name, colour + 5);
    return to;
}

static void make_tables(const option_entry *table, getopt_tables *made)
{
    char *letter = made->letters;
    struct option *name = made->names;
    *letter++ = '-'; /* operands come in their order */
    *letter++ = ':'; /* a missing value differs from an unknown option, and getopt_long prints nothing */
    for (int i = 0; table[i].name; i++) {
        const struct option own = {table[i].name, has_value(&table[i]) ? required_argument : no_argument, NULL, FIRST + i};
        *name++ = own;
        if (respell(own.name, made->respelled[i]))
            *name++ = (struct option){made->respelled[i], own.has_arg, own.flag, own.val};
        if (table[i].letter)
            *letter++ = table[i].letter;
        if (table[i].letter && has_value(&table[i]))
            *letter++ = ':';
    }
    *name++ = (struct option){"help", no_argument, NULL, 'h'};
    *name = (struct option){NULL, 0, NULL, 0};
    *letter++ = 'h';
    *letter = '\0';
}

/* The option that getopt_long calls by this number, or -1. */
static int option_of(const option_entry *table, int number)
{
    for (int i = 0; table[i].name; i++)
        if (number == FIRST + i || number == table[i].letter)
            return i;
    return -1;
}

static int refuse_option(const option_entry *table, int number, const char *what)
{
    const int i = option_of(table, number);
    if (number >= FIRST)
        return message_usage("option --%s %s", table[i].name, what);
    return number == 'h' ? message_usage("option --help %s", what) : message_usage("option -%c %s", number, what);
}

/* How many options begin as the word does. */
static int count_beginning(const option_entry *table, const char *word)
{
    int count = 0;
    for (int i = 0; table[i].name; i++)
        count += !strncmp(table[i].name, word + 2, strcspn(word + 2, "="));
    return count;
}

/* Without a guess where more than one begins so. */
static int refuse_long(const option_entry *table, const char *word)
{
    char text[GUESS_TEXT];
    if (count_beginning(table, word) > 1)
        return message_usage("option '%s' is ambiguous; write more of it", word);
    guess g = guess_at(word + 2, strcspn(word + 2, "="));
    guess_try(&g, "help", 4);
    for (int i = 0; table[i].name; i++)
        guess_try(&g, table[i].name, strlen(table[i].name));
    return message_usage("unknown option '%s'%s", word, guess_text(&g, "--", text));
}

/* number: the option in question, 0 for a long one that is not in the table. */
static int refuse_unknown(const option_entry *table, int number, const char *word)
{
    if (number && (number == 'h' || option_of(table, number) >= 0))
        return refuse_option(table, number, "takes no value");
    if (number)
        return message_usage("unknown option '-%c'", number);
    return refuse_long(table, word);
}

/* A value is missing or, as some getopt_long call that as well, too much. */
static int refuse_value(const option_entry *table, int number)
{
    const int i = number == 'h' ? -1 : option_of(table, number);
    return refuse_option(table, number, i >= 0 && has_value(&table[i]) ? "needs a value" : "takes no value");
}

/* "--json", where it stands for a value: a name that begins so is given as "./--json" or "--csv=--json". */
static bool is_option(const option_entry *table, const char *word)
{
    return !strncmp(word, "--", 2) && word[2] && count_beginning(table, word);
}

/* Into the request by the table, or as the command takes it. */
static int take_option(const option_entry *table, int i, option_taker *take, void *request)
{
    const size_t takes = table[i].takes, kind = takes % OPTION_KINDS;
    if (takes <= true)
        return take(request, i, optarg);
    void *const member = (char *)request + takes / OPTION_KINDS - 1;
    if (kind == OPTION_IS_THREADS)
        return numbers_read_whole(optarg, "--threads", THREADS_MAX, member);
    if (kind == OPTION_IS_NAME)
        *(const char **)member = optarg;
    else
        *(bool *)member = true;
    return EXIT_CODE_OK;
}

/* The words before it have been read. */
static int take_operand(char **words, char *operand, option_taker *take, void *request, options_found *found)
{
    words[1 + found->count++] = operand;
    return take(request, OPTION_OPERAND, operand);
}

static int take_one(const option_entry *table, int number, const char *word, option_taker *take, void *request,
                    options_found *found)
{
    const int i = option_of(table, number);
    if (options_has(found, i))
        return refuse_option(table, number, "is given twice");
    if (has_value(&table[i]) && optarg == word && is_option(table, word))
        return message_usage("option --%s needs a value, and '%s' is an option", table[i].name, word);
    found->seen |= UINT64_C(1) << i;
    return take_option(table, i, take, request);
}

int options_read(int count, char **words, const option_entry *table, option_taker *take, void *request, options_found *found)
{
    getopt_tables tables;
    int code = EXIT_CODE_OK, number;
    *found = (options_found){.operands = (const char *const *)(words + 1)};
    make_tables(table, &tables);
    optind = 0; /* begin afresh, even after an earlier call */
    while (!code && (number = getopt_long(count, words, tables.letters, tables.names, NULL)) != -1) {
        found->wants_help = number == 'h';
        if (found->wants_help)
            return EXIT_CODE_OK;
        code = number == '?'       ? refuse_unknown(table, optopt, words[optind - 1])
               : number == ':'     ? refuse_value(table, optopt)
               : number == OPERAND ? take_operand(words, optarg, take, request, found)
                                   : take_one(table, number, words[optind - 1], take, request, found);
    }
    for (; !code && optind < count; optind++)
        code = take_operand(words, words[optind], take, request, found);
    return code;
}
