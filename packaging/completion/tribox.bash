# tribox.bash - completes the commands, options and words of tribox, which it reads from what the program says of itself.
_tribox()
{
    local word=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} command=${COMP_WORDS[1]} at=$((COMP_CWORD - 1)) choices=
    [[ $word == = ]] && word= && at=$((at + 1))
    [[ ${COMP_WORDS[at]} == = ]] && at=$((at - 1))
    if ((COMP_CWORD == 1)) || [[ $command == help ]]; then
        choices=$("$program" --help 2>/dev/null | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
        ((COMP_CWORD == 1)) && choices+=' help --help --version'
    else
        # What refuses an empty value lists the words.
        [[ ${COMP_WORDS[at]} == -* ]] &&
            choices=$("$program" "$command" "${COMP_WORDS[at]}" '' 2>&1 | sed -n "s/.*: '' is none of \([^;(]*\).*/\1/p" | tr -d ,)
        [[ -z $choices && $word == -* ]] &&
            choices=$("$program" "$command" --help 2>/dev/null | sed -nE 's/^ +(-[a-zA-Z], )?(--[a-z-]+).*/\2/p')
    fi
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
}
complete -o default -F _tribox tribox
