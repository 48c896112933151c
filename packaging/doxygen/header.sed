# tribox.h in the words of Doxygen: sed -E -f header.sed tribox.h
# The comment at the top is about the file; its table becomes headed paragraphs.
1,/^#ifndef/ {
    1s!^/\*$!/** @file!
    s!^ \* tribox\.h - (.*)$! * @brief tribox: \1!
    s!^ \*   ([A-Z][A-Za-z, ]*[a-z]) {2,}(.*)$! * @par \1\n * \2!
}
# "name: what it is" is about a parameter, "Returns ..." about the result.
/^#ifndef TRIBOX_H/,$ {
    s!^ \* ([a-z]+), ([a-z]+), ([a-z]+): ! * @param \1,\2,\3 !
    s!^ \* ([a-z]+), ([a-z]+): ! * @param \1,\2 !
    s!^ \* ([a-z]+): ! * @param \1 !
    s!^ \* Returns ! * @return !
}
# A comment after a member is about that member; the version needs no other words than its name.
s!^( +[^ *].*) /\* (.*\*/)$!\1 /**< \2!
s!^#define TRIBOX_VERSION_([A-Z]+) .*$!/** The version of this header: \L\1\E. */\n&!
