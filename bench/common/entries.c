/* entries.c - makes the usual field. */
#include "entries.h"

#include <stdio.h>
#include <string.h>

#include "console/message.h"
#include "loads.h"
#include "paper/paper.h"

static bool run_loads(const contestant *self, uint64_t *mask, tribox_report *report)
{
    const timing_work *const work = self->question;
    (void)report;
    mask[0] = 0;
    for (size_t i = 0; i < work->count; i++)
        mask[0] ^= loads_all(&work->jobs[i].soup);
    return true;
}

size_t entries_make(const timing_work *work, contestant *list)
{
    list[0] = contestant_paper(work, PAPER_ORDER);
    snprintf(list[0].name, sizeof list[0].name, "baseline");
    list[1] =
        (contestant){.name = "loads", .run = run_loads, .question = work, .promise = PROMISE_NOTHING, .pairs = (double)work->pairs};
    return 2 + contestants_enter(work, &list[2]);
}

bool entry_is_baseline(const contestant *one) { return !one->options.kernel && one->promise == PROMISE_ROUNDED; }

size_t entry_fast_of(const contestant *list, size_t count, size_t c)
{
    const tribox_options *const own = &list[c].options;
    for (size_t f = 0; own->kernel && f < count; f++) {
        const tribox_options *const other = &list[f].options;
        if (other->kernel && other->accuracy == TRIBOX_FAST && other->axes == own->axes && !strcmp(own->kernel, other->kernel))
            return f;
    }
    return c;
}

bool entries_verify(const contestant *list, size_t count, const char *scene, const truth *from, score *scores)
{
    char wrong[VERIFY_TEXT];
    const bool is_right = verify(list, count, from, scores, wrong);
    if (!is_right)
        message_say("scene %s: %s; nothing is timed", scene, wrong);
    return is_right;
}
