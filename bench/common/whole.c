/* whole.c - reads whole numbers. */
#include "whole.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>

#include "console/message.h"

int whole_read(const char *text, const char *option, uint64_t least, uint64_t most, uint64_t *number)
{
    char *end;
    errno = 0;
    const unsigned long long read = strtoull(text, &end, 0);
    if (text[0] < '0' || text[0] > '9' || *end || errno || read < least || read > most)
        return message_usage("--%s: '%s' is not a whole number from %" PRIu64 " to %" PRIu64, option, text, least, most);
    *number = read;
    return EXIT_CODE_OK;
}
