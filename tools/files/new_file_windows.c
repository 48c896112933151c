/* new_file_windows.c - new files by CreateFileW, which others may remove while they are open, as interrupt_windows.c does. */
#define _WIN32_WINNT 0x0601
#include "new_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "console/wide_text.h"
#include "windows_file.h"

enum { LETTERS = 6, TRIES = 1000 };

/* Other letters each time, and in other processes. */
static void choose_letters(char *name)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz012345";
    static unsigned long long turn;
    LARGE_INTEGER now;
    QueryPerformanceCounter(&now);
    unsigned long long bits = (unsigned long long)now.QuadPart ^ (unsigned long long)GetCurrentProcessId() << 32;
    bits = (bits + ++turn) * 0x9e3779b97f4a7c15;
    char *const end = name + strlen(name);
    for (int i = 1; i <= LETTERS; i++, bits >>= 5)
        end[-i] = letters[bits >> 32 & 31];
}

static FILE *open_new(char *name, const windows_way *way)
{
    FILE *stream = NULL;
    errno = EEXIST;
    for (int i = 0; i < TRIES && !stream && errno == EEXIST; i++) {
        choose_letters(name);
        stream = windows_file_open(name, way);
    }
    return stream;
}

FILE *new_file_open(char *name)
{
    static const windows_way way = {GENERIC_WRITE, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, "wb"};
    return open_new(name, &way);
}

FILE *new_file_open_nameless(char *name)
{
    static const windows_way way = {GENERIC_READ | GENERIC_WRITE, CREATE_NEW, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE,
                                    "w+b"};
    return open_new(name, &way);
}

bool new_file_make_folder(char *name)
{
    bool is_made = false;
    errno = EEXIST;
    for (int i = 0; i < TRIES && !is_made && errno == EEXIST; i++) {
        choose_letters(name);
        wchar_t *const wide = wide_of_utf8(name);
        is_made = wide && CreateDirectoryW(wide, NULL);
        if (!is_made)
            windows_file_failed();
        free(wide);
    }
    return is_made;
}

static bool move(const char *from, const char *to, DWORD flags)
{
    wchar_t *const wide_from = wide_of_utf8(from), *const wide_to = wide_of_utf8(to);
    const bool is_moved = wide_from && wide_to && (MoveFileExW(wide_from, wide_to, flags) || windows_file_failed());
    const int reason = errno;
    free(wide_from);
    free(wide_to);
    errno = reason;
    return is_moved;
}

bool new_file_rename(const char *from, const char *to) { return move(from, to, MOVEFILE_REPLACE_EXISTING); }

bool new_file_rename_folder(const char *from, const char *to) { return move(from, to, 0); }

void new_file_remove(const char *name)
{
    wchar_t *const wide = wide_of_utf8(name);
    if (wide)
        DeleteFileW(wide);
    free(wide);
}

void new_file_remove_folder(const char *name)
{
    wchar_t *const wide = wide_of_utf8(name);
    if (wide)
        RemoveDirectoryW(wide);
    free(wide);
}

static bool is_link(const char *path)
{
    wchar_t *const wide = wide_of_utf8(path);
    const DWORD attributes = wide ? GetFileAttributesW(wide) : INVALID_FILE_ATTRIBUTES;
    free(wide);
    return attributes != INVALID_FILE_ATTRIBUTES && attributes & FILE_ATTRIBUTE_REPARSE_POINT;
}

static char *name_of(HANDLE file)
{
    const DWORD room = GetFinalPathNameByHandleW(file, NULL, 0, FILE_NAME_NORMALIZED);
    wchar_t *const wide = malloc((room + 1) * sizeof *wide);
    const DWORD length = wide && room ? GetFinalPathNameByHandleW(file, wide, room, FILE_NAME_NORMALIZED) : 0;
    char *const name = length && length < room ? utf8_of_wide(wide) : (windows_file_failed(), NULL);
    free(wide);
    return name;
}

/* Follows links. The name as given if there is no such file, or if the drive cannot tell. */
char *new_file_target(const char *path)
{
    const HANDLE file = windows_file_behind(path);
    char *const name = file == INVALID_HANDLE_VALUE ? NULL : name_of(file);
    const int reason = errno;
    if (file != INVALID_HANDLE_VALUE)
        CloseHandle(file);
    if (!name && !is_link(path))
        return _strdup(path);
    errno = reason;
    return name;
}

char *new_file_passing_folder(void)
{
    wchar_t folder[MAX_PATH + 1];
    return utf8_of_wide(GetTempPathW(MAX_PATH + 1, folder) ? folder : L".");
}

void new_file_fail_quietly(bool is_stdout) { (void)is_stdout; }
