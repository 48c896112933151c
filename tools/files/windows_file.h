/* windows_file.h - files of Windows as streams, and its errors as errno. */
#ifndef WINDOWS_FILE_H
#define WINDOWS_FILE_H

#include <stdbool.h>
#include <stdio.h>
#include <windows.h>

/* How CreateFileW is called; others may always read, rename and remove the file. */
typedef struct windows_way {
    DWORD access, disposition, flags;
    const char *mode; /* of the stream */
} windows_way;

/* NULL with errno. */
FILE *windows_file_open(const char *path, const windows_way *way);

/*
 * What stands under a name or, if that is a link, where it leads: to be asked about, then closed. INVALID_HANDLE_VALUE with
 * errno.
 */
HANDLE windows_file_behind(const char *path);

/* Sets errno by GetLastError. Returns false. */
bool windows_file_failed(void);

#endif
