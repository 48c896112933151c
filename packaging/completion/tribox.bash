# tribox.bash - completes the commands and options of tribox, which it reads from the program's own help.
_tribox()
{
    local word=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} command=${COMP_WORDS[1]} choices=
    if ((COMP_CWORD == 1)) || [[ $command == help ]]; then
        choices=$("$program" --help 2>/dev/null | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
        ((COMP_CWORD == 1)) && choices+=' help --help --version'
    elif [[ $word == -* ]]; then
        choices=$("$program" "$command" --help 2>/dev/null | sed -nE 's/^ +(-[a-zA-Z], )?(--[a-z-]+).*/\2/p')
    fi
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
}
complete -o default -F _tribox tribox
