#!/bin/bash
# scripts/campaign ($1) counts nothing for a fuzzer that could not be built, although the log of an earlier run is there.
set -eu
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
mkdir -p scripts docs/evidence build/fuzz src
cp "$1" scripts/campaign
cp "$(dirname "$1")/usage" scripts
printf '#!/bin/sh\nexit 1\n' >scripts/fuzz
chmod +x scripts/campaign scripts/fuzz
echo "check,cases,reached,findings,date,commit" >docs/evidence/reliability.csv
printf '<!-- results -->\n<!-- end of results -->\n' >docs/evidence/reliability.md
echo "stat::number_of_executed_units: 12345" >build/fuzz/scene.log
git init -q .
git add .
git -c user.name=test -c user.email=test@localhost commit -q -m start

output=$(scripts/campaign 5 fuzz_scene 2>&1)
case $output in *"fuzz_scene: could not run"*) ;; *) echo "not reported: $output" >&2 && exit 1 ;; esac
if grep fuzz_scene docs/evidence/reliability.csv; then
  echo "runs of an earlier log were counted" >&2
  exit 1
fi

# those of a fuzzer that ran are counted
printf '#!/bin/sh\necho "stat::number_of_executed_units: 7" >"build/fuzz/$2.log"\n' >scripts/fuzz
scripts/campaign 5 fuzz_scene >/dev/null 2>&1
grep -q '^fuzz_scene,1,7,0,' docs/evidence/reliability.csv

# A wrong name or time is refused, before anything runs.
for wrong in "5 fuzz_scenes" "5 R13" "soon" "-5 R1"; do
  code=0
  scripts/campaign $wrong 2>refused || code=$?
  [ "$code $(wc -l <refused)" = "2 1" ]
done

# A test that has run is not run again when others are added, and what failed is not counted.
mkdir programs
printf '#!/bin/sh\n' >programs/cmake
cat >programs/ctest <<'END'
#!/bin/sh
if [ "$3" = --show-only=json-v1 ]; then
  cat tests.json
else
  echo "run $4" >>runs
  grep -q 'a.Fails' tests.json && echo "3/3 Test #3: a.Fails ...***Failed" || true
fi
END
chmod +x programs/*
PATH=$PWD/programs:$PATH
echo '{"tests": [{"name": "a.First # GetParam() = 0x1", "command": ["a"]}, {"name": "b.Second", "command": ["lab_test"]}]}' >tests.json
scripts/campaign 5 tests_tsan >/dev/null 2>&1
grep -q '^tests_tsan,2,2,0,' docs/evidence/reliability.csv
echo '{"tests": [{"name": "a.Zeroth"}, {"name": "a.First # GetParam() = 0x2"}, {"name": "a.Fails"}, {"name": "b.Second"}]}' >tests.json
scripts/campaign 5 tests_tsan >/dev/null 2>&1
grep -q '^tests_tsan,4,3,1,' docs/evidence/reliability.csv
[ "$(cat runs)" = "run 0,0,0,2,1
run 0,0,0,1,3" ]

# Hashes that were compared at a commit are compared again when they have changed since, on another machine too.
mkdir -p tests/golden build/release/tests/campaign
printf '#!/bin/sh\necho "compared" >>comparisons\necho "1 0"\n' >build/release/tests/campaign/golden
chmod +x build/release/tests/campaign/golden
printf 'scene,hash\na,1\n' >tests/golden/hashes.csv
git add tests && git -c user.name=test -c user.email=test@localhost commit -q -m hashes
echo "hashes_gcc_O3,1,1,0,2000-01-02,$(git rev-parse --short HEAD)" >>build/campaign/results.csv
scripts/campaign 5 hashes_gcc_O3 >/dev/null 2>&1
[ ! -e comparisons ]
printf 'scene,hash\na,2\n' >tests/golden/hashes.csv
git add tests && git -c user.name=test -c user.email=test@localhost commit -q -m changed
scripts/campaign 5 hashes_gcc_O3 >/dev/null 2>&1
[ -s comparisons ]
grep -q "^hashes_gcc_O3,[12],[12],0,$(date +%F)" docs/evidence/reliability.csv
