# tribox.fish - completes the commands, options and words of tribox, which it reads from what the program says of itself.
function __tribox_options
    set -l words (commandline -opc)
    $words[1] $words[2] --help 2>/dev/null | sed -nE 's/^ +(-[a-zA-Z], )?(--[a-z-]+).*/\2/p'
end
function __tribox_commands
    tribox --help 2>/dev/null | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\)  *\(.*\)/\1\t\2/p'
end
function __tribox_words # what refuses an empty value lists them
    set -l words (commandline -opc)
    string match -q -- '-*' $words[-1]
    and $words[1] $words[2] $words[-1] '' 2>&1 | sed -n "s/.*: '' is none of \([^;(]*\).*/\1/p" | tr -d , | string split -n ' '
end
complete -c tribox -n 'count (__tribox_words) >/dev/null' -f -a '(__tribox_words)'
complete -c tribox -n '__fish_is_nth_token 1' -f -a '(__tribox_commands) help'
complete -c tribox -n '__fish_seen_subcommand_from help' -f -a '(__tribox_commands)'
complete -c tribox -n 'not __fish_is_nth_token 1; and string match -q -- "-*" (commandline -ct)' -f -a '(__tribox_options)'
