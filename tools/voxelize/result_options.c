/* result_options.c - the options that voxelize and merge share. */
#include "result_options.h"

#include <stddef.h>

#include "console/message.h"

int result_take(result_request *r, int which, const char *value)
{
    switch (which) {
    case RESULT_OUT:
        r->out_path = value;
        return EXIT_CODE_OK;
    case RESULT_PREVIEW:
        r->preview_path = value;
        return EXIT_CODE_OK;
    case RESULT_UP:
        return preview_read_up(value, &r->look.up);
    case RESULT_VIEW:
        return preview_read_view(value, &r->look);
    case RESULT_PICTURE_SIZE:
        return preview_read_size(value, &r->look);
    case RESULT_JSON:
        r->wants_json = true;
        return EXIT_CODE_OK;
    default:
        r->is_quiet = true;
        return EXIT_CODE_OK;
    }
}

int result_check(result_request *r, const options_found *found, bool takes_part)
{
    const bool has_look =
        options_has(found, RESULT_UP) || options_has(found, RESULT_VIEW) || options_has(found, RESULT_PICTURE_SIZE);
    if (has_look && !r->preview_path)
        return message_usage("--up, --view and --picture-size need --preview");
    if (r->wants_json && r->is_quiet)
        return message_usage("--json and --quiet exclude each other");
    r->format = takes_part ? NULL : volume_format_of(r->out_path);
    return takes_part || r->format ? preview_check(r->preview_path, "--preview") : EXIT_CODE_USAGE;
}
