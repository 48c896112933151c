/* sweep_advice.c - EXACT with the default kernel: the fastest order, or axes that may be left out at no false report. */
#include "sweep_advice.h"

#include <stdio.h>
#include <string.h>

#include "console/options.h"

/* The fastest of those that answer exactly as all axes do. */
static const contestant *fastest_right(const sweep *s, const char *kernel, const contestant *best)
{
    for (int x = 0; x < SWEEP_AXES; x++) {
        const contestant *const one = sweep_find(s, kernel, TRIBOX_EXACT, sweep_axes[x], SWEEP_DEFAULT);
        if (!score_unlike(sweep_score(s, one)) && sweep_beats(s, one, best))
            best = one;
    }
    return best;
}

sweep_advice sweep_advise(const sweep *s)
{
    const char *const kernel = tribox_kernel_name(NULL);
    const contestant *const plain = sweep_find(s, kernel, TRIBOX_EXACT, TRIBOX_AXES_ALL, SWEEP_DEFAULT);
    const contestant *const best = sweep_best(s, kernel, TRIBOX_EXACT);
    const contestant *const advised = fastest_right(s, kernel, sweep_beats(s, best, plain) ? best : plain);
    return (sweep_advice){.kernel = kernel,
                          .order = advised->options.axis_order,
                          .axes = advised->options.axes,
                          .gain = 1 - sweep_time(s, advised) / sweep_time(s, plain)};
}

void sweep_advice_text(const sweep_advice *advice, char *text, size_t size)
{
    char axes[32] = "";
    for (int i = 0; i < OPTIONS_AXES_GROUPS; i++) {
        unsigned bit;
        const char *const word = options_axes_word(i, &bit);
        const size_t length = strlen(axes);
        if (advice->axes & bit)
            snprintf(axes + length, sizeof axes - length, "%s%s", length ? "," : "", word);
    }
    if (advice->axes != TRIBOX_AXES_ALL)
        snprintf(text, size,
                 "Use the axes %s here, in the default order: with kernel %s they report nothing false on these pairs and take "
                 "%.1f %% less time than all axes.",
                 axes, advice->kernel, 100 * advice->gain);
    else if (advice->gain > 0)
        snprintf(text, size, "Use order %u and all axes here: with kernel %s it takes %.1f %% less time than the default.",
                 advice->order, advice->kernel, 100 * advice->gain);
    else
        snprintf(
            text, size,
            "Use the default here, which finds the order as it goes, and all axes: with kernel %s no fixed order, and no choice "
            "of axes that reports nothing false, is faster beyond the spread.",
            advice->kernel);
}
