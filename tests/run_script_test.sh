# scripts/run refuses what is no scene before it builds anything: run_script_test.sh SCRIPT.
set -u
script=$1 failed=0

expect() { # CODE TEXT ARGUMENT...
  code=$1 text=$2 && shift 2
  said=$("$script" "$@" 2>&1 </dev/null)
  is=$?
  if [ "$is" != "$code" ] || [[ $said != *"$text"* ]] || [ "$(echo "$said" | wc -l)" != 1 ]; then
    echo "scripts/run $*: exit code $is, not $code, or not one line with \"$text\": $said" >&2
    failed=1
  fi
}

expect 0 "usage: scripts/run [SCENE]" --help
expect 2 "--wrong: no such option" --wrong
expect 2 "trampoline: more than one scene" cloth trampoline
expect 5 "nosuch: no such file or shipped scene" nosuch
exit $failed
