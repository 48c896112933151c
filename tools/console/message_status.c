/* message_status.c - the line of a status. */
#include "message.h"

int message_status(tribox_status status)
{
    return status ? message_failure("%s", status == MESSAGE_NO_MEMORY ? "out of memory" : tribox_status_text(status))
                  : EXIT_CODE_OK;
}
