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

static bool describe(HANDLE file, file_about *about)
{
    BY_HANDLE_FILE_INFORMATION found;
    *about = (file_about){.kind = FILE_KIND_OTHER};
    if (GetFileType(file) != FILE_TYPE_DISK)
        return true;
    if (!GetFileInformationByHandle(file, &found))
        return windows_file_failed();
    about->kind = found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY ? FILE_KIND_FOLDER : FILE_KIND_REGULAR;
    about->size = (uint64_t)found.nFileSizeHigh << 32 | found.nFileSizeLow;
    about->changed = (uint64_t)found.ftLastWriteTime.dwHighDateTime << 32 | found.ftLastWriteTime.dwLowDateTime;
    return true;
}

/* By a handle: attributes asked for by name are those of a link itself, whose size is 0. */
bool named_file_about(const char *path, file_about *about)
{
    const HANDLE file = windows_file_behind(path);
    if (file == INVALID_HANDLE_VALUE)
        return false;
    const bool is_told = describe(file, about);
    const int reason = errno;
    CloseHandle(file);
    errno = reason;
    return is_told;
}

static bool identify(const char *path, BY_HANDLE_FILE_INFORMATION *found)
{
    const HANDLE file = windows_file_behind(path);
    if (file == INVALID_HANDLE_VALUE)
        return false;
    const bool is_found = GetFileInformationByHandle(file, found);
    CloseHandle(file);
    return is_found;
}

bool named_file_about_open(FILE *stream, file_about *about) { return describe((HANDLE)_get_osfhandle(_fileno(stream)), about); }

bool named_file_read_at(FILE *stream, uint64_t offset, void *to, size_t bytes, size_t *got)
{
    const HANDLE file = (HANDLE)_get_osfhandle(_fileno(stream));
    DWORD now = 1;
    for (*got = 0; *got < bytes && now; *got += now) {
        const uint64_t at = offset + *got;
        const size_t left = bytes - *got;
        OVERLAPPED place = {.Offset = (DWORD)at, .OffsetHigh = (DWORD)(at >> 32)};
        if (!ReadFile(file, (char *)to + *got, left < INT32_MAX ? (DWORD)left : INT32_MAX, &now, &place))
            return GetLastError() == ERROR_HANDLE_EOF || windows_file_failed();
    }
    return true;
}

bool named_file_write_at(FILE *stream, uint64_t offset, const void *from, size_t bytes)
{
    const HANDLE file = (HANDLE)_get_osfhandle(_fileno(stream));
    DWORD now;
    for (size_t done = 0; done < bytes; done += now) {
        const uint64_t at = offset + done;
        const size_t left = bytes - done;
        OVERLAPPED place = {.Offset = (DWORD)at, .OffsetHigh = (DWORD)(at >> 32)};
        if (!WriteFile(file, (const char *)from + done, left < INT32_MAX ? (DWORD)left : INT32_MAX, &now, &place))
            return windows_file_failed();
    }
    return true;
}

bool named_file_is_there(const char *path)
{
    wchar_t *const wide = wide_of_utf8(path);
    const bool is_there = wide && (GetFileAttributesW(wide) != INVALID_FILE_ATTRIBUTES || windows_file_failed() || errno != ENOENT);
    free(wide);
    return is_there;
}

static bool find_folder(const char *path, BY_HANDLE_FILE_INFORMATION *found)
{
    const size_t length = named_file_folder(path);
    char *const folder = malloc(length + 2);
    if (!folder)
        return false;
    memcpy(folder, path, length);
    memcpy(folder + length, ".", 2);
    const bool is_found = identify(folder, found);
    free(folder);
    return is_found;
}

bool named_file_is_same(const char *a, const char *b)
{
    BY_HANDLE_FILE_INFORMATION of_a, of_b;
    const bool has_a = identify(a, &of_a), has_b = identify(b, &of_b);
    if (has_a != has_b)
        return false;
    if (!has_a &&
        (_stricmp(a + named_file_folder(a), b + named_file_folder(b)) || !find_folder(a, &of_a) || !find_folder(b, &of_b)))
        return false;
    return of_a.dwVolumeSerialNumber == of_b.dwVolumeSerialNumber && of_a.nFileIndexHigh == of_b.nFileIndexHigh &&
           of_a.nFileIndexLow == of_b.nFileIndexLow;
}

size_t named_file_folder(const char *path)
{
    size_t length = strlen(path);
    while (length && !strchr("/\\:", path[length - 1]))
        length--;
    return length;
}

bool named_file_is_writable_here(void) { return !_waccess(L".", 2); }
