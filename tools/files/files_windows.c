/* files_windows.c - files by CreateFileW, which others may rename and remove while they are open, as interrupt_windows.c does. */
#define _WIN32_WINNT 0x0601
#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#include "console/system.h"
#include "files.h"

/* How CreateFileW is called; others may always read, rename and remove the file. */
typedef struct windows_way {
    DWORD access, disposition, flags;
    const char *mode; /* of the stream */
} windows_way;

/* Sets errno by GetLastError. Returns false. */
static bool windows_file_failed(void)
{
    static const struct {
        DWORD error;
        int number;
    } known[] = {{ERROR_FILE_NOT_FOUND, ENOENT},      {ERROR_PATH_NOT_FOUND, ENOENT},
                 {ERROR_INVALID_NAME, ENOENT},        {ERROR_BAD_NETPATH, ENOENT},
                 {ERROR_DIRECTORY, ENOTDIR},          {ERROR_ACCESS_DENIED, EACCES},
                 {ERROR_SHARING_VIOLATION, EACCES},   {ERROR_WRITE_PROTECT, EROFS},
                 {ERROR_FILE_EXISTS, EEXIST},         {ERROR_ALREADY_EXISTS, EEXIST},
                 {ERROR_DISK_FULL, ENOSPC},           {ERROR_NOT_ENOUGH_MEMORY, ENOMEM},
                 {ERROR_TOO_MANY_OPEN_FILES, EMFILE}, {ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG}};
    const DWORD error = GetLastError();
    errno = EIO;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (known[i].error == error)
            errno = known[i].number;
    return false;
}

static FILE *stream_of(HANDLE file, const char *mode)
{
    const int number = _open_osfhandle((intptr_t)file, _O_BINARY);
    if (number < 0) {
        CloseHandle(file);
        return NULL;
    }
    FILE *const stream = _fdopen(number, mode);
    if (!stream)
        _close(number);
    return stream;
}

static HANDLE open_by(const char *path, const windows_way *way, DWORD shared)
{
    wchar_t *const wide = wide_of_utf8(path);
    if (!wide)
        return INVALID_HANDLE_VALUE;
    const HANDLE file = CreateFileW(wide, way->access, shared, NULL, way->disposition, way->flags, NULL);
    if (file == INVALID_HANDLE_VALUE)
        windows_file_failed();
    const int reason = errno;
    free(wide);
    errno = reason;
    return file;
}

/* NULL with errno. */
static FILE *windows_file_open(const char *path, const windows_way *way)
{
    const HANDLE file = open_by(path, way, FILE_SHARE_READ | FILE_SHARE_DELETE);
    return file == INVALID_HANDLE_VALUE ? NULL : stream_of(file, way->mode);
}

/*
 * What stands under a name or, if that is a link, where it leads: to be asked about, then closed. INVALID_HANDLE_VALUE with
 * errno.
 */
static HANDLE windows_file_behind(const char *path)
{
    static const windows_way asking = {0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL}; /* folders, too */
    return open_by(path, &asking, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE);
}

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

/* They come from the folder. */
void new_file_take_rights(FILE *to, const char *of) { (void)to, (void)of; }

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

static bool map_open(file_map *map, FILE *stream)
{
    file_about about;
    if (!named_file_about_open(stream, &about) || about.kind != FILE_KIND_REGULAR)
        return false;
    if (!about.size)
        return true;
    const HANDLE mapping = CreateFileMappingW((HANDLE)_get_osfhandle(_fileno(stream)), NULL, PAGE_READONLY, 0, 0, NULL);
    if (!mapping)
        return false;
    map->bytes = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
    map->size = map->bytes ? (size_t)about.size : 0;
    CloseHandle(mapping); /* the view keeps it */
    return map->bytes;
}

file_map_result file_map_open(file_map *map, const char *path)
{
    *map = (file_map){.bytes = NULL};
    FILE *const stream = named_file_open(path, "rb");
    if (!stream)
        return FILE_MAP_NOT_OPENED;
    const bool is_mapped = map_open(map, stream);
    fclose(stream);
    return is_mapped ? FILE_MAP_OK : FILE_MAP_REFUSED;
}

bool file_map_of_stream(file_map *map, FILE *stream)
{
    *map = (file_map){.bytes = NULL};
    return map_open(map, stream);
}

void file_map_close(file_map *map)
{
    if (map->bytes)
        UnmapViewOfFile(map->bytes);
    *map = (file_map){.bytes = NULL};
}
