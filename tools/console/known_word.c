/* known_word.c - how far words are from each other, and the one line that refuses a word. */
#include "known_word.h"

#include <stdio.h>
#include <string.h>

#include "message.h"

enum { LONGEST = 24 };

static unsigned least_of(unsigned a, unsigned b) { return a < b ? a : b; }

/* A letter that is missing costs 1; one that is wrong or too much costs 2. */
static unsigned cost(const char *from, size_t from_length, const char *to, size_t to_length)
{
    unsigned at[LONGEST + 1][LONGEST + 1];
    for (size_t i = 0; i <= from_length; i++)
        for (size_t j = 0; j <= to_length; j++) {
            if (!i || !j) {
                at[i][j] = (unsigned)(2 * i + j);
                continue;
            }
            const unsigned same = at[i - 1][j - 1] + (from[i - 1] == to[j - 1] ? 0 : 2);
            at[i][j] = least_of(same, least_of(at[i][j - 1] + 1, at[i - 1][j] + 2));
        }
    return at[from_length][to_length];
}

guess guess_at(const char *word, size_t length)
{
    enum { MOST = 4 };
    const unsigned half = length > LONGEST ? 0 : (unsigned)length / 2 + 2;
    return (guess){.word = word, .length = length, .least = length ? least_of(half, MOST + 1) : 0};
}

/* What it begins with costs least. */
void guess_try(guess *g, const char *choice, size_t length)
{
    if (!g->least || length > LONGEST || g->length > LONGEST)
        return;
    const unsigned own = length > g->length && !memcmp(choice, g->word, g->length) ? 1 : cost(g->word, g->length, choice, length);
    if (own < g->least) {
        g->least = own;
        g->best = choice;
        g->best_length = length;
    }
}

const char *guess_text(const guess *g, const char *dashes, char text[GUESS_TEXT])
{
    text[0] = '\0';
    if (g->best)
        snprintf(text, GUESS_TEXT, " (did you mean '%s%.*s'?)", dashes, (int)g->best_length, g->best);
    return text;
}

int choice_read(const char *option, const char *value, size_t length, const char *words, const char *note, unsigned *which)
{
    char list[256] = "", text[GUESS_TEXT];
    guess g = guess_at(value, length);
    size_t used = 0;
    *which = 0;
    for (const char *word = words; *word; ++*which) {
        const size_t size = strcspn(word, " ");
        if (size == length && !memcmp(word, value, size))
            return EXIT_CODE_OK;
        guess_try(&g, word, size);
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%.*s", used ? ", " : "", (int)size, word);
        word += size + (word[size] == ' ');
    }
    return message_usage("%s: '%.*s' is none of %s%s%s", option, (int)length, value, list, note ? note : "",
                         guess_text(&g, "", text));
}
