/*
 * replay.c - runs a fuzz target once on each given file and on each file of the given folders: known inputs as a test, with any
 * compiler.
 */
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ensure.h"

static void fail(const char *path)
{
    perror(path);
    exit(1);
}

/* The memory is exactly as large as the input, so that a sanitizer sees a read past its end. */
static void replay_file(const char *path)
{
    enum { INPUT_MAX = 1 << 20 };
    static uint8_t buffer[INPUT_MAX];
    FILE *const file = fopen(path, "rb");
    if (!file)
        fail(path);
    const size_t size = fread(buffer, 1, sizeof buffer, file);
    if (ferror(file))
        fail(path);
    fclose(file);
    uint8_t *const data = malloc(size);
    if (!data && size)
        fail(path);
    memcpy(data ? data : buffer, buffer, size);
    LLVMFuzzerTestOneInput(data ? data : buffer, size);
    free(data);
}

/* Prints each name before its turn: a signal would not say which file it was. */
static int replay_folder(const char *path, DIR *folder)
{
    int files = 0;
    for (const struct dirent *entry; (entry = readdir(folder));) {
        char name[4096];
        if (entry->d_name[0] == '.')
            continue;
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        fprintf(stderr, "%s\n", entry->d_name);
        replay_file(name);
        files++;
    }
    closedir(folder);
    return files;
}

int main(int count, char **arguments)
{
    int files = 0;
    for (int i = 1; i < count; i++) {
        DIR *const folder = opendir(arguments[i]);
        if (folder)
            files += replay_folder(arguments[i], folder);
        else
            replay_file(arguments[i]);
        files += !folder;
    }
    fprintf(stderr, "%d inputs\n", files);
    return files ? 0 : 1;
}
