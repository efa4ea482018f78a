# Shortens what ctest prints: no line for a start, no row of dots. What failed is printed once more
# before the summary, for who sees only the end of a log; what passed only when it was run again is
# named, and what was skipped, with the reason that it gave, and which test by the wall clock was run
# again (-v whole=LastTest.log, complete when ctest has ended: so long the summary waits). Exit code 3
# where nothing failed but such tests that were late to the last.
# SPDX-License-Identifier: Apache-2.0

# Lines until the next test belong to the one that failed.
/^ +Start +[0-9]+: / { failing = ""; next }

/^ *([0-9]+\/[0-9]+ +)?Test +#[0-9]+: / {
  gsub(/ \.\.\.\.*/, " ...")
  sub(/  # GetParam\(\) = .* \.\.\./, " ...")
  failing = ""
  match($0, /#[0-9]+/)
  number = substr($0, RSTART, RLENGTH)
  if ($0 !~ /(Passed|Skipped|\(Disabled\)) +[0-9.]+ sec/) {
    failing = number
    if (!(number in said)) order[tests++] = number
    said[number] = said[number] $0 "\n"
  } else if (number in said) {
    again[number] = $0
  }
  print
  fflush()
  next
}

# The summary begins.
/^[0-9]+% tests passed/ {
  summary = 1
  for (i = 0; i < tests; ++i) if (!(order[i] in again)) printf "-- once more: %s\n", said[order[i]]
  for (i = 0; i < tests; ++i)
    if (order[i] in again) printf "-- only when run again: %s\n", again[order[i]]
  failing = ""
}

summary {
  held = held $0 "\n"
  next
}

{
  if (failing != "" && ++lines[failing] <= 400) said[failing] = said[failing] $0 "\n"
  print
}

END {
  while (whole != "" && (getline line < whole) > 0) {
    if (line ~ /^[0-9]+\/[0-9]+ Test: /) name = substr(line, index(line, ": ") + 2)
    if (giving) printf "-- skipped: %s: %s\n", name, line
    if (line ~ /^by_wall_clock: /) printf "-- %s: %s\n", name, line
    if (line ~ /^by_wall_clock: not judged/) ++unjudged
    giving = line ~ /^[^ ]+:[0-9]+: Skipped$/
  }
  printf "%s", held
  failed = tests
  for (i = 0; i < tests; ++i) if (order[i] in again) --failed
  if (failed > 0 && failed == unjudged) {
    print "not judged: what failed was late by the wall clock, and nothing else"
    exit 3
  }
}
