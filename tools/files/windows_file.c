/* windows_file.c - opens files by CreateFileW, and says by errno what Windows says otherwise. */
#include "windows_file.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdint.h>
#include <stdlib.h>

#include "console/wide_text.h"

bool windows_file_failed(void)
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

FILE *windows_file_open(const char *path, const windows_way *way)
{
    const HANDLE file = open_by(path, way, FILE_SHARE_READ | FILE_SHARE_DELETE);
    return file == INVALID_HANDLE_VALUE ? NULL : stream_of(file, way->mode);
}

HANDLE windows_file_behind(const char *path)
{
    static const windows_way asking = {0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL}; /* folders, too */
    return open_by(path, &asking, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE);
}
