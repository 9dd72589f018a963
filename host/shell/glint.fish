# Completion for fish: asks `glint complete` what may stand next.

function __glint_complete
    set -l words (commandline --tokenize --cut-at-cursor --current-process)
    set -l typed (commandline --cut-at-cursor --current-token)
    set -l current (string unescape -- $typed; or echo $typed)
    set -l glint $words[1]
    set -e words[1]
    set words (string replace --regex '^~/' "$HOME/" -- $words)
    for line in ($glint complete -- $words "$current" 2>/dev/null)
        switch $line
            case ':folders'
                __fish_complete_directories "$current" ''
            case ':files*'
                set -l endings (string split --no-empty ' ' -- (string sub --start 7 -- $line))
                set -l wanted '(/|'(string join '|' -- (string escape --style=regex -- $endings))')$'
                test -n "$endings"; or set wanted .
                for file in (__fish_complete_path "$current")
                    string match --quiet --regex -- $wanted (string split --field 1 \t -- $file); and echo $file
                end
            case '*'
                echo $line
        end
    end
end
complete --command glint --no-files --arguments '(__glint_complete)'
