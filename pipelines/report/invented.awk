# Sentences of a case and its READMEs that call it invented: awk -f invented.awk case.yaml README.md ...
# In a case only comments are prose. Where the case lies on another map than its own (-v terrain=replaced), what calls its
# terrain invented and nothing else is left out.
function invented(words) { return words ~ /synthetic|hypothetical|fictitious|invented/ }
function of_terrain(words) {
  return words ~ /terrain|relief|topograph|valley|canyon|gorge|elevation/ && words !~ /slide|lake|reservoir|dam|soil|water/
}
# Whether a sentence calls the terrain invented and nothing but the terrain, clause by clause.
function of_terrain_alone(sentence,   n, i, clauses) {
  n = split(sentence, clauses, /[,;:]| and /)
  for (i = 1; i <= n; ++i)
    if (invented(clauses[i]) && !of_terrain(clauses[i])) return 0
  return 1
}
function tell(   n, i, sentences, small) {
  gsub(/[*`]/, "", prose)
  n = split(prose, sentences, /[.!?] +/)
  for (i = 1; i <= n; ++i) {
    small = tolower(sentences[i])
    if (!invented(small) || (terrain == "replaced" && of_terrain_alone(small))) continue
    sub(/[ .:]+$/, "", sentences[i])
    print sentences[i] "."
  }
  prose = ""
}
FNR == 1 { tell() }
/^#+ / && FILENAME !~ /yaml$/ { tell() }
{
  line = $0
  if (FILENAME !~ /yaml$/) sub(/^#+ */, "", line)
  else if (!sub(/^[^#]*#+ */, "", line)) line = ""
  if (line ~ /^ *$/ || line ~ /^\|/) tell()
  else prose = prose (prose == "" ? "" : " ") line
}
END { tell() }
