/* reading.c - one bar for all readers. */
#include "mesh_file.h"

#include "console/progress.h"

static progress bar;

void reading_begin(void) { bar = progress_start("reading"); }

void reading_tell(double done) { progress_tell(&bar, done); }

void reading_end(void) { progress_end(&bar); }
