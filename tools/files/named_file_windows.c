/* named_file_windows.c - files by their names in UTF-16. */
#include "named_file.h"

#include <errno.h>
#include <io.h>
#include <stdlib.h>
#include <string.h>

#include "console/wide_text.h"
#include "windows_file.h"

FILE *named_file_open(const char *path, const char *mode)
{
    static const windows_way reading = {GENERIC_READ, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, "rb"},
                             writing = {GENERIC_WRITE, CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL, "wb"};
    return windows_file_open(path, mode[0] == 'r' ? &reading : &writing);
}

bool named_file_about(const char *path, file_about *about)
{
    WIN32_FILE_ATTRIBUTE_DATA found;
    wchar_t *const wide = wide_of_utf8(path);
    const bool is_found = wide && GetFileAttributesExW(wide, GetFileExInfoStandard, &found);
    const DWORD error = GetLastError();
    free(wide);
    SetLastError(error);
    if (!is_found)
        return windows_file_failed();
    about->kind = found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY ? FILE_KIND_FOLDER
                  : found.dwFileAttributes & FILE_ATTRIBUTE_DEVICE  ? FILE_KIND_OTHER
                                                                    : FILE_KIND_REGULAR;
    about->size = (uint64_t)found.nFileSizeHigh << 32 | found.nFileSizeLow;
    return true;
}

bool named_file_about_open(FILE *stream, file_about *about)
{
    const HANDLE file = (HANDLE)_get_osfhandle(_fileno(stream));
    LARGE_INTEGER size = {.QuadPart = 0};
    about->kind = GetFileType(file) == FILE_TYPE_DISK ? FILE_KIND_REGULAR : FILE_KIND_OTHER;
    if (about->kind == FILE_KIND_REGULAR && !GetFileSizeEx(file, &size))
        return windows_file_failed();
    about->size = (uint64_t)size.QuadPart;
    return true;
}

bool named_file_is_there(const char *path)
{
    file_about about;
    return named_file_about(path, &about) || errno != ENOENT;
}

size_t named_file_folder(const char *path)
{
    size_t length = strlen(path);
    while (length && !strchr("/\\:", path[length - 1]))
        length--;
    return length;
}

bool named_file_is_writable_here(void) { return !_waccess(L".", 2); }
