# Of values that are separated by commas, the last one; after NAME=VALUE, other values of this name.
function __hooke_list
    set -l token (string replace -r '^--[a-z-]+=' '' -- (commandline -ct))
    set -l start (string match -r '^.*,' -- $token; or echo)
    set -l words $argv
    if string match -q '*=*,*' -- $token
        set -l name (string split -m 1 = -- $token)[1]=
        set words (string replace $name '' -- (string match "$name*" -- $argv))
    end
    printf '%s\n' $start$words
end

