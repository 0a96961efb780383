# bash completion of dem2particles, lgiw-run, gauges, deposit-volume, impulse-wave and convergence.
# Options, the values that they take and the kinds of files come from the --help of the very tool that is typed.

declare -gA _lgiw_help=() # what --help said, by command; asked for once a shell

# Endings of the files that a text of --help speaks of, one a line; none where it speaks of none.
_lgiw_endings() {
  case $1 in
    *GeoTIFF*) echo tif ;;
    *CSV*) echo csv ;;
    *JSON*) echo json ;;
    *netCDF*) echo nc ;;
    *Xdmf*) echo xmf ;;
    *YAML* | *[Cc]ase\ file*) printf '%s\n' yaml yml ;;
    *VTKHDF* | *.h5*) echo h5 ;;
  esac
}

# Files with these endings that begin with a word, and folders on the way to them; all files without endings.
_lgiw_files() {
  local word=$1 ending
  shift
  compgen -d -- "$word"
  [[ $# -gt 0 ]] || compgen -f -- "$word"
  for ending; do compgen -f -X "!*.$ending" -- "$word"; done
}

_lgiw() {
  local tool=${1/#\~/$HOME} word=$2 before=$3
  # --option=value comes as three words.
  if [[ $word == = ]]; then word=
  elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD - 2]}; fi
  [[ -n ${_lgiw_help[$tool]:-} ]] || _lgiw_help[$tool]=$("$tool" --help 2>/dev/null)

  # An entry of --help: two blanks, names or a positional, what it takes, what it is; the latter may stand on the next line.
  local line options=() about= positional= entry=
  while IFS= read -r line; do
    if [[ $line =~ ^\ \ (-[^\ ]+)(.*) ]]; then
      local names=,${BASH_REMATCH[1]},
      options+=(${names//,/ })
      entry=
      if [[ $names == *,"$before",* ]]; then entry=about about=${BASH_REMATCH[2]}; fi
    elif [[ $line =~ ^\ \ ([a-z]+\ [A-Z].*) ]]; then
      entry=positional positional=${BASH_REMATCH[1]}
    elif [[ $line =~ ^\ {20,}(.*) && -n $entry ]]; then
      printf -v "$entry" '%s  %s' "${!entry}" "${BASH_REMATCH[1]}"
    else
      entry=
    fi
  done <<<"${_lgiw_help[$tool]:-}"

  COMPREPLY=()
  local takes= files=+o
  [[ $about =~ ^\ ([A-Z][^\ ]*) && ${BASH_REMATCH[1]} != *: ]] && takes=${BASH_REMATCH[1]}
  if [[ $takes =~ \{(.*)\} ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${BASH_REMATCH[1]//,/ }" -- "$word")
  elif [[ $takes == FOLDER ]]; then
    files=-o
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
  elif [[ $takes == FILE ]]; then
    files=-o
    mapfile -t COMPREPLY < <(_lgiw_files "$word" $(_lgiw_endings "$about"))
  elif [[ -n $takes ]]; then
    : # a number or a name, which nobody can know
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${options[*]}" -- "$word")
  elif [[ -n $positional ]]; then
    files=-o
    mapfile -t COMPREPLY < <(_lgiw_files "$word" $(_lgiw_endings "$positional"))
  fi
  # Folders end in /, blanks are quoted; a test calls this where nothing is being completed.
  compopt $files filenames 2>/dev/null || :
}

complete -F _lgiw dem2particles lgiw-run gauges deposit-volume impulse-wave convergence
