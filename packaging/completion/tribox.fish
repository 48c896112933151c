# tribox.fish - completes the commands, options and formats of tribox, which it reads from what the program says of itself.
function __tribox_options
    set -l words (commandline -opc)
    $words[1] $words[2] --help 2>/dev/null | sed -nE 's/^ +(-[a-zA-Z], )?(--[a-z-]+).*/\2/p'
end
function __tribox_commands
    tribox --help 2>/dev/null | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\)  *\(.*\)/\1\t\2/p'
end
function __tribox_formats
    tribox info 2>/dev/null | string replace -rf '^formats *' '' | string split -n ' '
end
complete -c tribox -n 'string match -q -- --out-format (commandline -opc)[-1]' -f -a '(__tribox_formats)'
complete -c tribox -n '__fish_is_nth_token 1' -f -a '(__tribox_commands) help'
complete -c tribox -n '__fish_seen_subcommand_from help' -f -a '(__tribox_commands)'
complete -c tribox -n 'not __fish_is_nth_token 1; and string match -q -- "-*" (commandline -ct)' -f -a '(__tribox_options)'
