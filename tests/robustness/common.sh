# What the tests of robustness share; each is called TEST BIN WORK [COUNT] and prints one line of JSON. Sourced.
# BIN: the folder of the built tools. WORK: a folder for what is made, emptied first. COUNT: how many trials.
set -eu -o pipefail
export LC_ALL=C.UTF-8 OMP_NUM_THREADS=1
test=$(basename "$0")
[ $# -ge 2 ] || { echo "usage: $test BIN WORK [COUNT]" >&2; exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
bin=$(cd "$1" && pwd)
rm -rf "$2"
mkdir -p "$2"
work=$(cd "$2" && pwd)
PATH=$bin:$PATH
cd "$work"
failures=0

# fail WORDS...: one more failure; the words to stderr.
fail() {
  failures=$((failures + 1))
  echo "$test: $*" >&2
}

# report FIELD=VALUE...: the line of JSON, and the exit status.
report() {
  local field text="{\"test\":\"$test\""
  for field; do text+=",\"${field%%=*}\":${field#*=}"; done
  printf '%s,"failures":%d}\n' "$text" "$failures"
  [ "$failures" -eq 0 ]
}

# A wedge of soil that slides into water; tests/solver read it as well.
slide_case=$here/../data/slide.yaml

# slide_particles: slide.h5 of that case.
slide_particles() {
  cp "$slide_case" slide.yaml
  dem2particles slide.yaml -o slide.h5 -q --no-provenance
}

# run OUTPUT OPTIONS...: lgiw-run with a checkpoint after every few steps, the same bytes each time.
checkpoints=0.01
run() {
  local output=$1
  shift
  lgiw-run slide.h5 -o "$output" --backend cpu --no-provenance -q --set output.checkpoint_interval=$checkpoints "$@"
}

# start OUTPUT OPTIONS...: the same beside the script; its number is in `process`, its errors in run.err.
start() {
  local output=$1
  shift
  lgiw-run slide.h5 -o "$output" --backend cpu --no-provenance -q --set output.checkpoint_interval=$checkpoints "$@" 2> run.err &
  process=$!
}

# finish_and_compare OUTPUT REFERENCE WHAT: takes up the run or, where it had come to no checkpoint, starts it anew, and
# expects the bytes of REFERENCE and nothing left over. Sets `outcome` to resumed or anew.
finish_and_compare() {
  local output=$1 reference=$2 what=$3 status=0
  outcome=resumed
  if [ -e "$output" ]; then
    outcome=complete  # stopped behind the end
    rm -f "$output".checkpoint* ".${output%.h5}.partial.h5"
  elif [ -e "$output.checkpoint" ] || [ -e "$output.checkpoint.previous" ]; then
    run "$output" --resume 2> resume.err || status=$?
    [ $status -eq 0 ] || fail "$what: --resume ended with $status: $(cat resume.err)"
  else
    outcome=anew
    run "$output" -O 2> resume.err || status=$?
    [ $status -eq 0 ] || fail "$what: starting anew ended with $status: $(cat resume.err)"
  fi
  cmp -s "$output" "$reference" || fail "$what: the bytes differ from those of an uninterrupted run ($outcome)"
  [ $outcome = complete ] || [ -z "$(find . -maxdepth 1 -name '.*' -type f ! -name '.nfs*')" ] ||
    fail "$what: left over: $(find . -maxdepth 1 -name '.*' -type f | tr '\n' ' ')"
  find . -maxdepth 1 -name '.*' -type f -delete
  rm -f "$output" "$output".checkpoint* resume.err
}

# one_line FILE TOOL: whether FILE is one line in the form of our errors.
one_line() { [ "$(wc -l < "$1")" -eq 1 ] && grep -qE "^$2: .+ \(.+\) .+" "$1"; }
