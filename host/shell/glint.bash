# Completion for bash: asks `glint complete` what may stand next.

# Folders, and the files whose names begin so and end in one of these; without endings all.
_glint_files() {
    local begin=$1 ending
    shift
    compgen -d -- "$begin"
    for ending in "$@"; do compgen -f -X "!*$ending" -- "$begin"; done
}

_glint() {
    local words=() current cut='' rest=$COMP_LINE bare word line endings i

    # bash cuts words at = and :, which belong to them here: what stands without a gap is one word.
    for ((i = 0; i <= COMP_CWORD; i++)); do
        bare=${rest#"${rest%%[![:space:]]*}"}
        word=${COMP_WORDS[i]}
        if ((i > 0)) && [[ $bare == "$rest" ]]; then
            words[-1]+=$word
        else
            words+=("$word")
        fi
        rest=${bare#"$word"}
    done
    words=("${words[@]//[\\\'\"]/}")
    current=${words[-1]}
    [[ $COMP_WORDBREAKS != *=* || $current != *=* ]] || cut=${current%=*}=
    words=("${words[@]/#\~\//$HOME/}")

    while IFS= read -r line; do
        case $line in
        :*)
            compopt -o filenames
            case $line in
            :folders) endings=() ;;
            :files) endings=("") ;;
            *) read -ra endings <<<"${line#:files}" ;;
            esac
            mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(_glint_files "${current#"$cut"}" "${endings[@]}")
            ;;
        *)
            line=${line%%$'\t'*}
            [[ $line != *= ]] || compopt -o nospace
            COMPREPLY+=("${line#"$cut"}")
            ;;
        esac
    done < <("${words[0]}" complete -- "${words[@]:1}" 2>/dev/null)
}
complete -F _glint glint
