# tribox.bash - completes the commands, options and formats of tribox, which it reads from what the program says of itself.
_tribox()
{
    local word=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} command=${COMP_WORDS[1]} choices=
    if ((COMP_CWORD == 1)) || [[ $command == help ]]; then
        choices=$("$program" --help 2>/dev/null | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
        ((COMP_CWORD == 1)) && choices+=' help --help --version'
    elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == --out-format ]]; then
        choices=$("$program" info 2>/dev/null | sed -n 's/^formats *//p')
    elif [[ $word == -* ]]; then
        choices=$("$program" "$command" --help 2>/dev/null | sed -nE 's/^ +(-[a-zA-Z], )?(--[a-z-]+).*/\2/p')
    fi
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
}
complete -o default -F _tribox tribox
