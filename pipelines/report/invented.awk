# Sentences of a case and its READMEs that call it invented: awk -f invented.awk case.yaml README.md ...
# In a case only comments are prose.
function tell(   n, i, sentences) {
  gsub(/[*`]/, "", prose)
  n = split(prose, sentences, /[.!?] +/)
  for (i = 1; i <= n; ++i)
    if (tolower(sentences[i]) ~ /synthetic|hypothetical|fictitious|invented/) {
      sub(/[ .]+$/, "", sentences[i])
      print sentences[i] "."
    }
  prose = ""
}
FNR == 1 { tell() }
/^#+ / && FILENAME !~ /yaml$/ { tell() }
{
  line = $0
  if (FILENAME ~ /yaml$/ && !sub(/^[^#]*#+ */, "", line)) line = ""
  if (line ~ /^ *$/ || line ~ /^\|/) tell()
  else prose = prose (prose == "" ? "" : " ") line
}
END { tell() }
